#!/bin/sh
# What is searched for and how: --fairness, --longitudinal, --transverse, --search, --front.
# shellcheck disable=SC2086 # words without blanks are split on purpose
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley_noisy.csv
weights="--w1 1 --w2 100"

# --fairness and the weights of directions: each lowers its own energy, and the report names them.
# |K| takes 406 iterations here.
for fairness in mean gauss; do
	expect 0 fair "$hull" $weights --fairness $fairness --iterations 1000 --device reference --out out
	holds "--fairness $fairness" 'after < before' \
		before="$(member out/report.json smoothed energy_$fairness)" \
		after="$(member out/report.json after energy_$fairness)"
	[ "$(member out/report.json method fairness)" = $fairness ] || fail 'the report names another'
done
expect 0 fair "$hull" $weights --longitudinal 4 --transverse 0.5 --device reference --out out
[ "$(member out/report.json method longitudinal_weight)" = 4.0 ] || fail 'weight along the hull'
[ "$(member out/report.json method transverse_weight)" = 0.5 ] || fail 'weight across the hull'
expect 2 fair "$hull" --longitudinal 0 --transverse 0 --out out
one_line
says 'transverse weight'

# --search textbook ends a little above what multilevel finds, and is named.
for search in textbook multilevel; do
	expect 0 fair "$hull" --w1 1 --w2 1e5 --search $search --device reference --out $search
	[ "$(member $search/report.json method search)" = $search ] || fail 'the report names another search'
done
holds '--search textbook' 'a >= b * (1 - 1e-9) && a <= b * (1 + 1e-4)' \
	a="$(member textbook/report.json search objective_after)" \
	b="$(member multilevel/report.json search objective_after)"
expect 2 fair "$hull" --search textbook --variables net --out out
one_line
says "'textbook'"

# --search block says what it cannot and what it found.
expect 2 fair "$hull" $weights --fairness mvc --search block --device reference --out out
one_line
says 'not mvc with 1 and 1'

# --front: fairness rises and closeness falls with w2/w1, and the ends are those of single runs.
expect 0 fair "$hull" --front 10:1e5:5 --device reference --out front
awk -F, '/^#/ { next }
	!head { head = 1; if ($1 != "ratio_w2_w1" || $2 != "fairness" || $3 != "closeness_m4") exit 1; next }
	n++ { if (!($1 > ratio && $2 > fair && $3 < close_ && $10 == 1 && $11 == 0)) exit 1 }
	{ ratio = $1; fair = $2; close_ = $3 }
	END { if (n != 5 || ratio != 100000) exit 1 }' front/front.csv || fail 'the front is none'
expect 0 fair "$hull" --w1 1 --w2 1e5 --device reference --out out
holds '--front and a single run' 'a - b <= 1e-9 * a && b - a <= 1e-9 * a' a="$(tail -1 front/front.csv | cut -d, -f2)" \
	b="$(member out/report.json after energy_bending)"
grep -q '<svg' front/front.svg || fail 'no picture of the front'
[ -s front/front.json ] || fail 'no front.json'
for front in 1 1:2 2:1:5 1:10:1 1:10:5x 0:10:5 a:b:c; do
	expect 2 fair "$hull" --front $front --out none
	one_line
	says '^batten fair: --front'
done
# Weights that f32 does not have are refused, by a front and by a single run.
expect 3 fair "$hull" --front 1e3:1e30:2 --precision f32 --device reference --out none
one_line
says 'w1 = 1, w2 = 1e+30: weights'
expect 3 fair "$hull" --w1 1 --w2 1e30 --precision f32 --device reference --out none
one_line
says 'w1 = 1, w2 = 1e+30: weights'
# A polish is one of every point.
expect 0 fair "$hull" --front 10:1e5:5 --precision f32 --polish 1e-10 --device reference --out front --quiet
awk -F, '/^#/ { next } n++ && !($9 <= 1e-10) { exit 1 } END { if (n != 6) exit 1 }' front/front.csv ||
	fail 'the front is not polished'
expect 2 fair "$hull" --front 1:10:5 --w1 1 --w2 2 --out none
[ -e none ] && fail 'something was written'
finish
