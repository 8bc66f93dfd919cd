#!/bin/sh
# batten fair --method all, and batten curve --method.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley_noisy.csv

expect 0 fair "$hull" --method all --order 3 --w1 1 --w2 1e4 --out all
prints 'input .*smooth .*forward-approximation .*forward-fit .*inverse .*search'
for name in fn_per_m2 energy_bending inflections cn_pct volume_change_pct cpu_s; do
	prints "^$name  *[0-9-]"
done
for method in smooth forward-approximation forward-fit inverse search; do
	for file in faired.csv report.json lines.svg; do
		[ -s all/$method/$file ] || fail "all/$method/$file is missing"
	done
	expect_schema report all/$method/report.json
done
expect_json all/compare.json
expect_schema compare all/compare.json
[ "$(grep -c '"method"' all/compare.json)" -eq 6 ] || fail "not six columns"
grep -q '</svg>' all/compare.svg || fail "no whole sheet"
[ -z "$(find all -name '.*' ! -name .)" ] || fail "something is left behind"

# A method that does not suit is left out, the others stay.
expect 1 fair "$hull" --method all --vertices 30 --w1 1 --w2 1e4 --out part
says 'needs 30 points'
[ ! -e part/forward-fit ] || fail "part/forward-fit is there"
grep -q '"forward-fit"' part/compare.json || fail "forward-fit is not named"
expect_schema compare part/compare.json
sed 's/"cpu_s"/"time"/' all/compare.json >renamed.json
"$CHECK_SCHEMA" "$DATA/schema/compare.schema.json" renamed.json >.schema &&
	fail "a renamed member is taken for good"
grep -q '/columns/0/time: not in the schema' .schema || fail "the renamed member is not named"
[ -s part/inverse/faired.csv ] || fail "the others are missing"

# Table 7.1 of the thesis, right end 25: within 0.16 % of the printed 7.6176.
expect 0 curve "$DATA/lines/quadratic.csv" --method search --w1 0.5 --w2 0.5 --json
cp "$out" search.json
expect_json search.json
expect_schema curve search.json
holds "table 7.1" 'f > 7.6176 && f < 7.6176 * 1.0017' \
	f="$(sed -n 's/.*"objective": *\([0-9.]*\).*/\1/p' search.json)"
expect 0 curve "$DATA/lines/npl_waterline.csv" --method forward-fit --vertices 6 \
	--faired faired.csv
prints '^faired by forward-fit: '
expect 0 curve faired.csv
prints '^NPL round-bilge parent, waterline 0.15 m: 15 points'
expect 2 curve "$DATA/lines/npl_waterline.csv" --method forward-fit --vertices 2
says 'at least the order 3'
expect 2 curve "$DATA/lines/npl_waterline.csv" --method smooth
says "found 'smooth'"
expect 2 curve "$DATA/lines/npl_waterline.csv" --vertices 6
says 'need --method'
six=$DATA/lines/quadratic.csv
expect 2 curve "$six" --method forward-approximation --fair-order 7
says 'order 7 needs 7 points, the line has 6'
expect 2 curve "$six" --method inverse --fair-order 5
says 'order 5 needs 7 points, the line has 6'
expect 2 curve "$six" --method forward-fit --vertices 7
says 'order 3 with 7 vertices needs 7 points, the line has 6'
expect 2 curve "$six" --method inverse --iterations 0
says 'found 0 iterations'
expect 2 curve "$six" --method inverse --iterations 1000000000
says "found '1000000000'"
printf 'x,y\n0,0\n1,1\n1,1\n2,3\n3,3\n' >coincident.csv
expect 3 curve coincident.csv --method inverse
says 'coincident.csv:4:1: found the point before it again'
for n in 0 10001; do
	expect 2 fair "$hulls/wigley.csv" --method all --iterations $n --out none
	says "found $n, expected 1 to 10000"
	[ ! -e none ] || fail "--method all --iterations $n: something is written"
done
printf 'x,y\n0,0\n1,1\n' >two.csv
expect 2 curve two.csv --method inverse
says 'curve: a line of 2 points, expected 3'
finish
