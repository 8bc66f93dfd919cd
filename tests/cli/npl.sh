#!/bin/sh
# The demonstration: the NPL hull with the misprint of the printed table, 0.1192 at x 2.032, z
# 0.15.
. "$(dirname "$0")/lib.sh"
hull=$hulls/npl_parent.csv

# fn FILE WATERLINE: its fairness number, the sum of squared second derivatives at its inner
# points.
fn()
{
	table_of "$1" | awk -F, -v z="$2" '
		NR == 1 { for (i = 2; i <= NF; i++) station[i] = $i; next }
		$1 + 0 == z + 0 {
			for (i = 2; i <= NF; i++) if ($i != "") { x[++n] = station[i]; y[n] = $i }
			for (i = 2; i < n; i++) {
				before = (y[i] - y[i - 1]) / (x[i] - x[i - 1])
				after = (y[i + 1] - y[i]) / (x[i + 1] - x[i])
				d2 = (after - before) / ((x[i + 1] - x[i - 1]) / 2)
				sum += d2 * d2
			}
			printf "%.17g\n", sum
		}' -
}

# Everything but the offset that is replaced stays within one percent of the half-beam.
moved_little()
{
	table_of "$hull" | awk -F, -v OFS=, 'NR == 1 { for (i = 2; i <= NF; i++) if ($i == 2.032) at = i }
		$1 == 0.15 { $at = "-" } { print }' >.rest
	change .rest "$1" >.change
	read -r most rms count <.change
	holds "$1: change of the offsets not replaced" 'most <= 0.01 * h * (1 + 1e-12) && count == 274' \
		most="$most" h=0.2188 count="$count"
}

# demo FOLDER: what is asked of the hull and the report there.
demo()
{
	report=$1/report.json
	expect_json "$report"
	[ "$(grep -c '"old_m"' "$report")" -eq 1 ] || fail "$1: not one offset replaced"
	grep -A 8 '"replaced"' "$report" | tr -d ' ,\n' >.replaced
	holds "$1: where" 'x == 2.032 && z > 0.1499999 && z < 0.1500001 && old == 0.1192' \
		x="$(sed 's/.*"x_m":\([^"]*\)".*/\1/' .replaced)" \
		z="$(sed 's/.*"z_m":\([^"]*\)".*/\1/' .replaced)" \
		old="$(sed 's/.*"old_m":\([^"]*\)".*/\1/' .replaced)"
	holds "$1: replacement" 'y >= 0.108 && y <= 0.110' \
		y="$(sed 's/.*"new_m":\([0-9.]*\).*/\1/' .replaced)"
	holds "$1: the offset in the end" 'y >= 0.108 && y <= 0.110' y="$(cell "$1/faired.csv" 2.032 0.15)"
	holds "$1: fn of waterline 0.15 in the files" 'a >= 1.085 && a < 1.095 && b < 0.30' \
		a="$(fn "$hull" 0.15)" b="$(fn "$1/faired.csv" 0.15)"
	for end in before after; do
		case $end in before) file=$hull ;; *) file=$1/faired.csv ;; esac
		holds "$1: fn of waterline 0.15 in the report, $end" \
			'a - b <= 1e-9 * b && b - a <= 1e-9 * b' a="$(fn "$file" 0.15)" \
			b="$(line_member "$report" waterline 0.15 fn_${end}_per_m2)"
	done
	holds "$1: distance" 'cn <= 1 + 1e-12 && cn > 0' cn="$(member "$report" after cn_search_pct)"
	holds "$1: smoothing is no fairing" 's < b' s="$(member "$report" smoothed energy_bending)" \
		b="$(member "$report" before energy_bending)"
	moved_little "$1/faired.csv"
	same_form "$hull" "$1/faired.csv"
}

expect 0 fair "$hull" --out demo
demo demo
holds 'bending energy by default' 'after <= 0.88 * smoothed' \
	after="$(member demo/report.json after energy_bending)" \
	smoothed="$(member demo/report.json smoothed energy_bending)"
for file in faired.csv report.json before.png after.png lines.svg; do
	[ -s "demo/$file" ] || fail "demo/$file is not there"
done
[ "$(member demo/report.json search status)" = 'converged by step' ] || fail 'not converged'
# The table on the terminal, and the replacement in it.
prints '^replaced: x = 2.032 m, z = 0.15 m: half-breadth 0.1192 m by 0.109'
for name in volume_m3 cb cp lcb_pct_lbp_fwd fn_per_m2 energy_bending; do
	prints "^$name  *[-0-9.]*  *[-0-9.]*  *[-0-9.]*  *[-+]"
done
prints '^written to demo: '

holds 'the certificate' 'gap >= 0 && gap <= 1e-6 && g > 0' \
	gap="$(member demo/report.json search gap_estimate)" \
	g="$(member demo/report.json search gradient_per_m)"

without_pictures
expect 0 fair "$hull" --w1 1 --w2 1e4 --out given
demo given
holds 'bending energy by w2 = 1e4' 'after <= 0.80 * smoothed' \
	after="$(member given/report.json after energy_bending)" \
	smoothed="$(member given/report.json smoothed energy_bending)"
holds 'weights as given' 'a == 1 && b == 10000' a="$(member given/report.json method w1)" \
	b="$(member given/report.json method w2)"

# Left as it is when asked.
expect 0 fair "$hull" --no-smooth --max-distance 0.1mm --out rough
tr -d ' \n' <rough/report.json | grep -q '"replaced":\[\]' || fail 'replaced all the same'
holds 'not smoothed' 'y >= 0.1191 && y <= 0.1193' y="$(cell rough/faired.csv 2.032 0.15)"

# A point that the user has locked is right, whatever it looks like.
for lock in point:2.032@0.15 station:2.032 waterline:0.15; do
	expect 0 fair "$hull" --lock $lock --out locked
	holds "--lock $lock" 'y == 0.1192' y="$(cell locked/faired.csv 2.032 0.15)"
done
# A faired table does not pass for the one it came from.
grep -q '^# source: .*; faired by batten [0-9.]*$' demo/faired.csv || fail 'the source does not say faired'
finish
