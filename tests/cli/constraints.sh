#!/bin/sh
# What the user holds fixed stays fixed: --max-distance, --lock, --lower, --upper, --iterations.
# shellcheck disable=SC2086 # words without blanks are split on purpose
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley_noisy.csv
h=$(half_beam "$hull")
weights="--w1 1 --w2 100"

# moved FOLDER: its largest change.
moved()
{
	change "$hull" "$1/faired.csv" >.change
	read -r most rms count <.change
	[ "$count" -eq 420 ] || fail "$1: $count offsets"
	echo "$most"
}

# --max-distance, in percent of the half-beam and in units of length.
for pair in 1%:0.01*h 0.25%:0.0025*h 0.5mm:0.0005 0.002m:0.002 0.01ft:0.003048 0mm:0 0%:0; do
	distance=${pair%:*}
	expect 0 fair "$hull" $weights --max-distance $distance --device reference --out out
	most=$(moved out)
	# With these weights some offset goes as far as it may.
	holds "--max-distance $distance" \
		"most <= (${pair#*:}) * (1 + 1e-12) && most >= (${pair#*:}) * (1 - 1e-9)" most="$most" h="$h"
	holds "--max-distance $distance in the report" \
		"d <= (${pair#*:}) * (1 + 1e-9) && d >= (${pair#*:}) * (1 - 1e-9)" \
		d="$(member out/report.json method max_distance_m)" h="$h"
done
expect 0 fair "$hull" --max-distance 0% --out out
same_form "$hull" out/faired.csv
[ "$(moved out)" = 0 ] || fail 'moved though nothing may'

# --lock: a station, a waterline and a point stay to the last bit, their neighbours do not.
expect 0 fair "$hull" $weights --lock station:4.8,waterline:1,point:8@0.47368421052631576 --out out
for x in 0.8 4.8 8; do
	for z in 0.42105263157894735 0.47368421052631576 1; do
		old=$(cell "$hull" $x $z)
		new=$(cell out/faired.csv $x $z)
		case $x,$z in
		4.8,* | *,1 | 8,0.473*) holds "locked $x, $z" 'a == b' a="$old" b="$new" ;;
		*) holds "not locked $x, $z" 'a != b' a="$old" b="$new" ;;
		esac
	done
done
[ "$(member out/report.json method lock)" = station:4.8,waterline:1,point:8@0.47368421052631576 ] ||
	fail 'the locks are not in the report'

# --keep: measures of the hull stay within their tolerances, to the same bit on the C path.
keep=volume_m3=0.01%,lcb_pct_lbp_fwd=0.0005
soft="--w1 1 --w2 400 --max-distance 2%"
expect 0 fair "$hull" $soft --out free
expect 0 fair "$hull" $soft --keep $keep --out out
expect 0 fair "$hull" $soft --keep $keep --device reference --out known
cmp out/faired.csv known/faired.csv
for name in volume_m3:1e-4*a lcb_pct_lbp_fwd:0.0005; do
	old=$(member out/report.json smoothed ${name%:*})
	holds "${name%:*} kept" "b - a <= (${name#*:}) * (1 + 1e-9) && a - b <= (${name#*:}) * (1 + 1e-9)" \
		a="$old" b="$(member out/report.json after ${name%:*})"
done
holds 'the volume would not have stayed' 'b - a > 1e-4 * a || a - b > 1e-4 * a' \
	a="$(member free/report.json smoothed volume_m3)" b="$(member free/report.json after volume_m3)"
holds 'what it costs' 'c > f' c="$(member out/report.json search objective_after)" \
	f="$(member free/report.json search objective_after)"
grep -q '"measure": "volume_m3"' out/report.json || fail 'what was kept is not in the report'
expect_json out/report.json
expect 0 fair "$hull" $soft --precision f32 --polish 1e-12 --out out
holds 'polished' 'gap <= 1e-12 && steps > 0' gap="$(member out/report.json search gap_estimate)" \
	steps="$(member out/report.json search polish_steps)"
expect_json out/report.json
expect 2 fair "$hull" --polish 0 --out out
expect 2 fair "$hull" --polish 1e-9 --keep $keep --out out
for bad in volume=1% volume_m3 volume_m3= volume_m3=0 volume_m3=1x volume_m3=-1%; do
	expect 2 fair "$hull" --keep $bad --out out
done
expect 0 fair "$hull" $soft --keep $keep --precision f32 --out out
holds 'kept in f32' 'b - a <= 1.001e-4 * a && a - b <= 1.001e-4 * a' \
	a="$(member out/report.json smoothed volume_m3)" b="$(member out/report.json after volume_m3)"
expect 0 fair "$hull" --max-distance 2% --keep $keep --front 100:1e4:3 --device reference --out front
awk -F, -v v="$(member out/report.json smoothed volume_m3)" '/^#/ { next }
	!head { head = 1; if ($12 != "volume_m3" || $13 != "lcb_pct_lbp_fwd") exit 1; next }
	{ n++; if ($12 - v > 1.001e-4 * v || v - $12 > 1.001e-4 * v) exit 1 }
	END { if (n != 3) exit 1 }' front/front.csv || fail 'the front keeps nothing'

# scaled FACTOR: the hull with every half-breadth times this.
scaled()
{
	awk -F, -v OFS=, -v factor="$1" '/^[#z]/ { print; next }
		{ for (i = 2; i <= NF; i++) if ($i != "") $i = sprintf("%.17g", $i * factor); print }' "$hull"
}

# Bounds: no offset is beyond, some are at them.
scaled 0.999 >lower.csv
scaled 1.0015 >upper.csv
expect 0 fair "$hull" $weights --lower lower.csv --upper upper.csv --out out
table_of lower.csv >.lower
table_of out/faired.csv >.faired
table_of upper.csv >.upper
paste -d, .lower .faired .upper | awk -F, '
	NR > 1 {
		n = NF / 3
		for (i = 2; i <= n; i++) {
			beyond += $(n + i) < $i || $(n + i) > $(2 * n + i)
			at += $i < $(2 * n + i) && ($(n + i) == $i || $(n + i) == $(2 * n + i))
			cells++
		}
	}
	END { print beyond + 0, at + 0, cells + 0 }' >.bounds
read -r beyond at cells <.bounds
holds 'bounds' 'beyond == 0 && at > 20 && cells == 420' beyond="$beyond" at="$at" cells="$cells"
for key in lower upper; do
	[ "$(member out/report.json method $key)" = $key.csv ] || fail "$key is not in the report"
done

# --interior-penalty: the minimum of the box, no offset at a bound, the same bits on the C path.
for run in "box:--search multilevel" "inside:--interior-penalty" "known:--interior-penalty --device reference"; do
	expect 0 fair "$hull" $weights --lock station:4.8 ${run#*:} --out "${run%%:*}"
done
cmp inside/faired.csv known/faired.csv
holds 'the same minimum' 'a - b <= 1e-9 * b && b - a <= 1e-7 * b' \
	a="$(member inside/report.json search objective_after)" \
	b="$(member box/report.json search objective_after)"
holds 'nothing at a bound' 'i == 0 && b > 20' i="$(member inside/report.json method at_limit_count)" \
	b="$(member box/report.json method at_limit_count)"
[ "$(member inside/report.json method search)" = multilevel ] || fail 'another search'
[ "$(member inside/report.json method interior_penalty)" = true ] || fail 'not in the report'
expect_json inside/report.json
for others in "--search block" "--search textbook" "--polish 1e-9" "--variables net" "--method inverse"; do
	expect 2 fair "$hull" --interior-penalty $others --out none
	one_line
	says 'interior-penalty'
done

# The iteration limit: exit code 1, said, and everything is written.
expect 1 fair "$hull" --iterations 1 --out short
says '^warning: .*iteration limit'
[ "$(member short/report.json search status)" = 'iteration limit' ] || fail 'another status'
[ "$(member short/report.json search iterations)" = 1 ] || fail 'not one iteration'
expect_json short/report.json
same_form "$hull" short/faired.csv
expect 1 fair "$hull" --iterations 1 --quiet --json --out short
[ -s "$talk" ] && fail 'talk in spite of --quiet'
cmp -s "$out" short/report.json || fail '--json prints another report than it writes'
expect_json "$out"

# All weight on closeness: nothing moves. None: nothing is left to gain by moving on.
expect 0 fair "$hull" --w1 0 --w2 1 --out out
[ "$(moved out)" = 0 ] || fail 'moved without any weight on fairness'
expect 0 fair "$hull" --w1 1 --w2 0 --out out
holds 'energy' 'a < b / 10' a="$(member out/report.json after energy_bending)" \
	b="$(member out/report.json before energy_bending)"
finish
