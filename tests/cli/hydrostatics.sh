#!/bin/sh
# batten measure over drafts: displacement, curves of form, Bonjean's and section area curves, surfaces.
. "$(dirname "$0")/lib.sh"
hull=$hulls/wigley.csv
trawler=$hulls/bsra_trawler.csv
mkdir place
cd place || exit 1

# near WHAT VALUE EXPECTED TOLERANCE (relative)
near()
{
	holds "$1" 'x - v <= t * v && v - x <= t * v' x="$2" v="$3" t="$4"
}

expect 0 measure --help
for option in draft displacement curves-of-form bonjean section-areas out kg lbp quadrature; do
	prints "^  --$option"
done

# The draft at a displacement displaces it.
expect 0 measure "$hull" --draft 0.7 --json
cp "$out" ../draft.json
expect 0 measure "$hull" --displacement "$(member ../draft.json displacement_t)" --kg 0.25 --json
cp "$out" ../weight.json
expect_json ../weight.json
near 'draft' "$(member ../weight.json draft_m)" 0.7 1e-10
holds 'heights' 'gmt == kmt - 0.25 && (mt - d * gml / 1600)^2 < 1e-28' \
	gmt="$(member ../weight.json gmt_m)" kmt="$(member ../weight.json kmt_m)" \
	gml="$(member ../weight.json gml_m)" d="$(member ../weight.json displacement_t)" \
	mt="$(member ../weight.json mt1cm_t_m_per_cm)"
[ "$(member ../draft.json gmt_m)" = null ] || fail 'a metacentric height without a centre of gravity'

# A table over drafts, wherever it goes, says the same.
expect 0 measure "$hull" --curves-of-form 4 --out form.csv
[ -s "$out" ] && fail 'the table went to standard output too'
expect 0 measure "$hull" --draft 0.25,0.5,0.75,1 --out list.csv
cmp form.csv list.csv || fail 'curves of form and a list of drafts differ'
[ "$(grep -vc '^#' form.csv)" -eq 5 ] || fail 'not four rows'
column()
{
	awk -F, -v name="$1" '/^#/ { next } !at { for (i = 1; i <= NF; i++) if ($i == name) at = i; next }
		{ print $at }' form.csv
}
# shellcheck disable=SC2046
set -- $(column volume_m3)
holds 'volumes ascend' 'a < b && b < c && c < d' a="$1" b="$2" c="$3" d="$4"
expect 0 measure "$hull" --curves-of-form 4 --out form.json
expect_json form.json
expect 0 measure "$hull" --curves-of-form 4 --json
expect_json "$out"
expect 0 measure "$hull" --curves-of-form 4
prints '^volume_m3 '
expect 0 measure "$hull" --bonjean 5 --out bonjean.csv
[ "$(grep -vc '^#' bonjean.csv)" -eq 66 ] || fail "Bonjean's curves: not 5 x 13 rows"
expect 0 measure "$trawler" --section-areas --draft 1,2 --quiet
prints 'draft_m.*x_m.*section_area_m2'
for kind in '--curves-of-form 9' '--bonjean 9' '--section-areas'; do
	# shellcheck disable=SC2086
	expect 0 measure "$trawler" $kind --out chart.svg
	head -n 3 chart.svg | grep -q '<svg' || fail "$kind: no SVG"
	[ -x "$(command -v xmllint)" ] && { xmllint --noout --nonet chart.svg || fail "$kind: bad XML"; }
	cp chart.svg first.svg
	# shellcheck disable=SC2086
	expect 0 measure "$trawler" $kind --out chart.svg
	cmp first.svg chart.svg || fail "$kind: two calls drew different charts"
done

# A surface: the Wigley hull is one patch, whose numbers are known.
expect 0 surface "$hull" --net 3x3 --order 3x3 --out wigley.json
expect 0 measure wigley.json --draft 1 --json
[ -s "$talk" ] && fail "a closed surface is warned of: $(cat "$talk")"
cp "$out" ../surface.json
expect_json ../surface.json
[ "$(member ../surface.json quadrature)" = gauss ] || fail 'the rule of a surface is not named'
near 'cb of the surface' "$(member ../surface.json cb)" 0.44444444444444444 1e-11
near 'kb of the surface' "$(member ../surface.json kb_m)" 0.625 1e-11
[ "$(member ../surface.json fn_per_m2)" = null ] || fail 'a surface with a fairness number of tables'
expect 0 measure wigley.json --draft 1 --curves-of-form 3
expect 0 measure wigley.json --draft 1 --bonjean 3 --out b.svg
expect 0 measure wigley.json --draft 0.5,1 --section-areas --out a.csv
expect 0 measure wigley.json --displacement 5
prints '^displacement_t  *5 '

# Several surfaces of one topology in one go: what each has by itself, whatever runs them.
expect 0 surface "$trawler" --net 7x5 --out a.json
expect 0 measure a.json --draft 2.3,1.2 --out alone.csv
expect 0 measure a.json a.json --draft 2.3,1.2 --device reference --out both.csv
expect 0 measure a.json a.json --draft 2.3,1.2 --device reference --json
expect_json "$out"
[ "$(grep -c '^a.json,ok,' both.csv)" -eq 4 ] || fail 'not two surfaces at two drafts'
volume()
{
	awk -F, -v row="$2" '/^#/ { next } !at { for (i = 1; i <= NF; i++) if ($i == "volume_m3") at = i; next }
		++n == row { print $at }' "$1"
}
near 'one of several' "$(volume both.csv 4)" "$(volume alone.csv 2)" 1e-10
sed 's/^/ /' wigley.json >again.json
expect 1 measure wigley.json again.json --draft 1.5 --device reference
says '^batten measure: again.json: draft 1.5 m: the hull goes from .* to 1 m'
prints '^status  *failed  *failed'

# A mesh of triangles: the book's pyramid afloat on its base (Letcher 7.1), as OBJ and STL.
cat >pyramid.obj <<'END'
# counted from the front and from the back, with other numbers behind
v 0 -1 2
v 2 -1 2
v 1 0 0
v 0 1 2
v 2 1 2
vn 0 0 1
f 3/1 2/2/1 1//1
f 3 5 2
f 3 4 5
f -3 -5 -2
END
expect 0 measure pyramid.obj --draft 2 --quiet --json
expect_json "$out"
cp "$out" ../pyramid.json
[ "$(member ../pyramid.json quadrature)" = triangles ] || fail 'the rule of a mesh is not named'
near 'volume of the pyramid' "$(member ../pyramid.json volume_m3)" 2.6666666666666667 1e-14
near 'its centre' "$(member ../pyramid.json kb_m)" 1.5 1e-14
near 'its faces' "$(member ../pyramid.json wetted_surface_m2)" 8.9442719099991588 1e-14
near 'its waterplane' "$(member ../pyramid.json i_t_m4)" 1.3333333333333333 1e-14
{
	echo 'solid pyramid'
	for face in '1 0 0,2 -1 2,0 -1 2' '1 0 0,2 1 2,2 -1 2' '1 0 0,0 1 2,2 1 2' '1 0 0,0 -1 2,0 1 2'; do
		echo "facet normal 0 0 0,outer loop,vertex $face,endloop,endfacet" |
			sed 's/,\([0-9]\)/,vertex \1/g' | tr ',' '\n'
	done
	echo 'endsolid pyramid'
} >pyramid.stl
expect 0 measure pyramid.stl --draft 2 --quiet --json
sed 's/pyramid.stl/pyramid.obj/' "$out" | cmp - ../pyramid.json || fail 'STL and OBJ differ'
# Endings and words in capitals, as some programs write them.
tr 'a-z' 'A-Z' <pyramid.stl >PYRAMID.STL
expect 0 measure PYRAMID.STL --draft 2 --quiet --json
sed 's/PYRAMID.STL/pyramid.obj/' "$out" | cmp - ../pyramid.json || fail 'STL in capitals differs'
expect 0 measure pyramid.obj --draft 1,2 --out form.csv --quiet
expect 0 measure pyramid.obj --curves-of-form 3 --out form.svg
expect 0 measure pyramid.obj --draft 2 --bonjean 3 --out bonjean.json
expect 0 measure pyramid.obj --draft 2 --section-areas --out areas.csv
expect 0 measure pyramid.obj --displacement 1 --quiet
prints '^displacement_t  *1 '
# broken NAME COMMAND: the pyramid with its text changed.
broken()
{
	sed "$2" pyramid.obj >"$1.obj"
}
broken hole '/f 3 5 2/d'
broken inverted 's/^f \(.*\) \(.*\) \(.*\)/f \3 \2 \1/'
broken turned 's/^f 3 5 2/f 2 5 3/'
broken crowded '$a f 3 1 5'
broken twice 's/^f 3 5 2/f 3 5 5/'
broken far 's/^f 3 5 2/f 3 5 9/'
broken comma 's/^v 1 0 0/v 1,0 0 0/'
broken short 's/^v 1 0 0/v 1 0/'
broken line 's/^f 3 5 2/f 3 5/'
sed 4d pyramid.stl >facet.stl
printf 'solid' >empty.stl
printf 'binary' >binary.stl
: >empty.obj

# Warnings are no errors, and silent when asked to be.
expect 0 measure "$hulls/npl_parent.csv"
says '^warning: transom_area_m2'
expect 0 measure "$hulls/npl_parent.csv" --quiet
[ -s "$talk" ] && fail "--quiet: $(cat "$talk")"

before=$(state_of .)
# refuses CODE PATTERN ARGUMENT...: one line that has this in it.
refuses()
{
	code_expected=$1
	pattern=$2
	shift 2
	expect "$code_expected" measure "$@"
	one_line
	says "$pattern"
}
refuses 2 'a surface has no draft' wigley.json
refuses 2 'device: found one file, expected several surfaces' wigley.json --draft 0.5 --device reference
refuses 2 'draft 1.5 m: the hull goes from .* to 1 m' wigley.json --draft 1.5
refuses 2 'draft 2 m: the hull goes from 0 to 1 m' "$hull" --draft 0.5,2
refuses 2 "found 'x'" "$hull" --draft 0.5,x
refuses 2 "found ''" "$hull" --draft 0.5,
refuses 2 'found 0, expected a draft above 0' "$hull" --draft 0.5,0
refuses 2 'nan' "$hull" --draft nan
refuses 2 'the hull displaces up to' "$hull" --displacement 1000
refuses 2 'displacement 0 t' "$hull" --displacement 0
refuses 2 'one of them' "$hull" --displacement 5 --draft 1
refuses 2 'one of them' "$hull" --bonjean 5 --curves-of-form 5
refuses 2 'expected the highest one' "$hull" --curves-of-form 3 --draft 0.5,1
refuses 2 '4096' "$hull" --curves-of-form 5000
refuses 2 '--out goes with' "$hull" --out x.csv
refuses 2 "found 'x.txt'" "$hull" --bonjean 3 --out x.txt
refuses 2 'two heights' "$hull" --bonjean 1 --out x.svg
refuses 2 'lbp' wigley.json --draft 1 --lbp -1
refuses 2 'a mesh has no draft' pyramid.obj
refuses 2 'draft 3 m: the hull goes from 0 to 2 m' pyramid.obj --draft 3 --section-areas --out x.csv
refuses 3 'triangle 0: its edge 2-1 borders a hole below the draft of 2 m' hole.obj --draft 2
refuses 3 'inverted.obj: triangle 0 and all others are inside out' inverted.obj --draft 2
refuses 3 'turned.obj: triangle 1: runs the other way round than triangle 0' turned.obj --draft 2
refuses 3 'crowded.obj: triangle .*: its edge .* belongs to 3 triangles' crowded.obj --draft 2
refuses 3 'twice.obj: triangle 1: a vertex twice' twice.obj --draft 2
refuses 3 "far.obj:9: found '9', expected the number of a vertex above" far.obj --draft 2
refuses 3 "comma.obj:4: found '1,0', expected a number" comma.obj --draft 2
refuses 3 "short.obj:4: found '', expected a number" short.obj --draft 2
refuses 3 'line.obj:9: .*expected three vertices of a face' line.obj --draft 2
refuses 3 'facet.stl:.*three vertices of the facet before' facet.stl --draft 2
refuses 3 'empty.stl: found no triangle' empty.stl --draft 2
refuses 3 'binary.stl: found 6 bytes, expected 84' binary.stl --draft 2
refuses 3 'empty.obj: found no triangle' empty.obj --draft 2
refuses 6 'none.stl' none.stl --draft 2
refuses 2 "'pyramid.obj' among them" wigley.json pyramid.obj --draft 1
refuses 2 'of several surfaces' wigley.json again.json
refuses 2 'a .csv or .json' wigley.json again.json --draft 0.5,1 --out x.svg
refuses 2 'other orders' wigley.json a.json --draft 1
refuses 4 'device' wigley.json again.json --draft 1 --device 99
refuses 6 'none/x.csv' "$hull" --bonjean 3 --out none/x.csv
refuses 6 'none/x.svg' "$hull" --bonjean 3 --out none/x.svg
[ "$(state_of .)" = "$before" ] || fail 'a refused call wrote something'
finish
