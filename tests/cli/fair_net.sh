#!/bin/sh
# batten fair --variables net: what it writes, what it refuses.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley_noisy.csv
net="--variables net --net 8x7 --w1 1 --w2 1e4"

# shellcheck disable=SC2086 # words without blanks are split on purpose
expect 0 fair "$hull" $net --device reference --out plain --quiet
for name in faired.csv report.json surface.json lines.svg; do
	[ -s "plain/$name" ] || fail "plain/$name was not written"
done
same_form "$hull" plain/faired.csv
expect_json plain/report.json
expect_json plain/surface.json
report=plain/report.json
[ "$(member "$report" method variables)" = net ] || fail 'the report does not say: net'
[ "$(member "$report" surface count_u)" = 8 ] || fail 'the report has another net'
[ "$(member "$report" surface frame)" = ap-fwd ] || fail 'the frame of the surface is missing'
[ "$(member "$report" surface unit)" = m ] || fail 'the unit of the surface is missing'
holds 'fit of the noisy hull' 'rms > 0.3 && rms < 0.6' \
	"rms=$(member "$report" surface fit_deviation_rms_pct)"
holds 'objective' 'after < before' "before=$(member "$report" search objective_before)" \
	"after=$(member "$report" search objective_after)"
holds 'what the end is worth' 'gap >= 0 && gap <= 1e-6 && gradient > 0' \
	"gap=$(member "$report" search gap_estimate)" "gradient=$(member "$report" search gradient_per_m)"
# shellcheck disable=SC2086
expect 0 fair "$hull" $net --precision f32 --polish 1e-12 --device reference --out polished --quiet
holds 'polished' 'gap <= 1e-12 && steps > 0 && after <= plain' \
	"gap=$(member polished/report.json search gap_estimate)" \
	"steps=$(member polished/report.json search polish_steps)" \
	"after=$(member polished/report.json search objective_after)" \
	"plain=$(member "$report" search objective_after)"

# --keep: measures of the surface stay within their tolerances, whatever searches.
soft="--variables net --net 8x7 --w1 1 --w2 400 --max-distance 2%"
keep=volume_m3=0.01%,lcb_pct_lbp_fwd=0.0005
# shellcheck disable=SC2086
{
	expect 0 fair "$hull" $soft --out free --quiet
	expect 0 fair "$hull" $soft --keep $keep --out kept --quiet
	expect 0 fair "$hull" $soft --keep $keep --device reference --out known --quiet
}
cmp kept/surface.json known/surface.json || fail 'other poles on the C path'
expect_json kept/report.json
# surface_volume FOLDER: of its surface, at the draft of the hull.
surface_volume()
{
	expect 0 measure "$1/surface.json" --draft 1 --json
	member "$out" volume_m3
}
free=$(surface_volume free)
kept=$(surface_volume kept)
wanted=$(sed -n 's/.*"wanted": \([0-9.]*\).*/\1/p' kept/report.json | head -n 1)
holds 'the volume is kept' 'a - w <= 1.0001e-4 * w && w - a <= 1.0001e-4 * w' a="$kept" w="$wanted"
holds 'it would not have been' 'a - w > 1e-4 * w || w - a > 1e-4 * w' a="$free" w="$wanted"
holds 'what it costs' 'c > f' c="$(member kept/report.json search objective_after)" \
	f="$(member free/report.json search objective_after)"
# shellcheck disable=SC2086
expect 3 fair "$hull" $soft --keep gmt_m=0.1 --out none --quiet
one_line
says 'gmt_m is nan: it cannot be kept'

# --front: fairness rises and closeness falls with w2/w1; each row has its surface, that of a single run.
front="--variables net --net 8x7 --device reference --out front"
# shellcheck disable=SC2086
expect 0 fair "$hull" $front --front 100:1e5:4
prints '.*surface-0001.json to surface-0004.json'
awk -F, '/^#/ { next }
	!head { head = 1; if ($1 != "ratio_w2_w1" || $2 != "fairness" || $3 != "closeness_m4") exit 1; next }
	n++ { if (!($1 > ratio && $2 > fair && $3 < close_ && $10 == 1 && $11 == 0)) exit 1 }
	{ ratio = $1; fair = $2; close_ = $3 }
	END { if (n != 4 || ratio != 100000) exit 1 }' front/front.csv || fail 'the front over a net is none'
expect_json front/front.json
# What is searched and what is measured is integrated by other rules: each says which.
grep -q '^# quadrature: gauss, a knot span: points of the order, as searched$' front/front.csv ||
	fail 'the front does not say its rule'
grep -q '<svg' front/front.svg || fail 'no picture of the front'
expect 0 fair "$hull" --variables net --net 8x7 --w1 1 --w2 1e5 --device reference --out single --quiet
grep -q 'a point more than the order a direction' single/report.json || fail 'the report does not say its rule'
cmp front/surface-0004.json single/surface.json || fail 'a point of the front is not its fairing'
# A shorter front, and one over offsets, leave no surfaces of this one behind.
# shellcheck disable=SC2086
expect 0 fair "$hull" $front --front 1e3:1e5:2 --keep $keep --quiet
[ "$(ls front)" = "$(printf '%s\n' front.csv front.json front.svg surface-0001.json surface-0002.json)" ] ||
	fail 'surfaces of an older front were left behind'
awk -F, '/^#/ { next } !head { head = 1; exit !($12 == "volume_m3" && $13 == "lcb_pct_lbp_fwd") }' \
	front/front.csv || fail 'the front does not say what it keeps'
expect 0 fair "$hull" --front 1e3:1e5:2 --device reference --out front --quiet
[ -e front/surface-0001.json ] && fail 'a front over offsets has a surface'

# Any device: the same bits.
# shellcheck disable=SC2086
expect 0 fair "$hull" $net --device auto --out auto --quiet
for name in faired.csv surface.json; do
	cmp -s "plain/$name" "auto/$name" || fail "$name differs between reference and auto"
done

# A locked waterline keeps its numbers; the file without the net leaves no older surface behind.
z=$(table_of "$hull" | awk -F, 'NR == 12 { print $1 }')
# shellcheck disable=SC2086
expect 0 fair "$hull" $net --lock "waterline:$z,row:3,edge:deck" --fix-tangent stem \
	--device reference --out plain --quiet
for x in 3.2 8 12.8; do
	[ "$(cell "$hull" $x "$z")" = "$(cell plain/faired.csv $x "$z")" ] ||
		fail "the locked offset at x $x, z $z changed"
done
expect 0 fair "$hull" --w1 1 --w2 1e4 --device reference --out plain --quiet
[ -e plain/surface.json ] && fail 'an older surface.json was left behind'

# The net is chosen from the table where nobody says, and a surface fits what it says.
expect 0 fair "$hulls/bsra_trawler.csv" --variables net --device reference --out trawler --quiet
[ "$(member trawler/report.json surface count_u)x$(member trawler/report.json surface count_v)" = 12x7 ] ||
	fail 'the trawler got another net'
expect 1 fair "$hull" --variables net --net 8x7 --w1 1 --w2 1 --iterations 1 --out few \
	--device reference
says 'iteration limit'

# refuses CODE PATTERN ARGUMENT...: one line, and nothing is written.
refuses()
{
	_expected=$1
	_pattern=$2
	shift 2
	expect "$_expected" fair "$hull" --out refused "$@"
	one_line
	says "$_pattern"
	[ -e refused ] && fail "batten fair $*: something was written"
}
refuses 2 '--net is about a net' --net 8x7
refuses 2 '--order is about a net' --order 4x4
refuses 2 '--fix-tangent is about a net' --fix-tangent stem
refuses 2 '--round is about a net' --round keel
refuses 2 'is about a net' --lock row:1
refuses 2 '--fairness mvc' --fairness mvc --longitudinal 2
refuses 2 '--longitudinal' --variables net --longitudinal 2
refuses 2 '--fairness: ' --variables net --fairness smooth
refuses 2 '--variables: ' --variables poles
refuses 2 '--net: ' --variables net --net 8
refuses 2 '--net: ' --variables net --net 0x7
refuses 2 '--order: ' --variables net --order 4,4
refuses 2 'order 9' --variables net --order 9x4 --net 12x9
refuses 2 '--fix-tangent: ' --variables net --fix-tangent bow
refuses 2 '--round: ' --variables net --round deck
refuses 2 'found row 7' --variables net --net 8x7 --lock row:7
refuses 2 'found column 8' --variables net --net 8x7 --lock column:8
refuses 2 '--lock: ' --variables net --lock pole:1
refuses 2 '--lock edge: ' --variables net --lock edge:bow
refuses 2 '--lower bounds' --variables net --lower "$hull"
refuses 2 'an interior penalty is\|--interior-penalty is about offsets' --variables net --front 1:10:3 --interior-penalty
refuses 2 '--front sweeps w2/w1' --variables net --front 1:10:3 --w1 1 --w2 1
refuses 2 'found row 7' --variables net --net 8x7 --front 1:10:3 --lock row:7
refuses 3 'w1 = 1, w2 = 1e+30: weights' --variables net --front 1e3:1e30:2 --precision f32
refuses 2 '--upper bounds' --variables net --upper "$hull"
hull=$hulls/bsra_trawler.csv
refuses 2 'cannot be rounded' --variables net --net 12x7 --round stem
hull=$hulls/wigley_noisy.csv
refuses 3 'expected at least 22' --variables net --net 22x7
finish
