#!/bin/sh
# batten surface: the file it writes, what it reports, what it refuses.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley.csv
mkdir place
cd place || exit 1

expect 0 surface --help
prints '^usage: batten surface'
prints '^example:'
for option in net order out rounded corrections grid contours at points threads max-memory json quiet; do
	prints "^  --$option"
done
expect 0 --help
prints 'surface .*'

# The Wigley hull is biquadratic.
expect 0 surface "$hull" --net 3x3 --order 3x3 --out wigley.json --json
cp "$out" report.json
json_is_valid report.json || fail 'the report is no JSON'
json_is_valid wigley.json || fail 'wigley.json is no JSON'
holds 'Wigley, largest' 'd >= 0 && d < 1e-12' d="$(member report.json deviation_max_m)"
holds 'Wigley, rms' 'd >= 0 && d < 1e-12' d="$(member report.json deviation_rms_m)"
holds 'Wigley, points' 'n == 260' n="$(member report.json points)"
for name in name unit frame order_u order_v count_u count_v; do
	[ "$(member report.json $name)" = "$(member wigley.json $name)" ] ||
		fail "$name: '$(member report.json $name)' is reported, '$(member wigley.json $name)' written"
done
[ "$(member wigley.json frame)" = ap-fwd ] || fail 'the frame is not stated'
[ "$(member wigley.json unit)" = m ] || fail 'the unit is not stated'

# The same call writes the same bytes; without --json a table is printed.
expect 0 surface "$hull" --net 3x3 --order 3x3 --out again.json
cmp -s wigley.json again.json || fail 'two calls wrote different files'
prints 'Wigley hull: 3 x 3 poles of order 3 x 3, fitted to 260 points'
prints '^deviation, rms .* m .* % of the half-beam$'
prints '^deviation, largest .* m .* % of the half-beam$'

# A grid: K and H of the Wigley hull amidships at the waterline (a convex hull's curvatures are negative),
# the same of the surface that was written as of the one that was fitted.
expect 0 surface "$hull" --net 3x3 --order 3x3 --grid fitted.csv --points 5x3
expect 0 surface wigley.json --grid read.csv --points 5x3
cmp fitted.csv read.csv || fail 'the written surface has another grid'
[ "$(grep -vc '^#' read.csv)" -eq 16 ] || fail 'not a line of names and 15 points'
column()
{
	grep -v '^#' read.csv | awk -F, -v name="$1" -v row="$2" '
		NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i }
		NR == row + 1 { print $at }'
}
# Point 13 of 15: u = 1/2, v = 1; L 16, B 1.6, D 1: H = -(2 B / L^2 + B / (2 D^2)).
holds 'H' 'h + 0.8125 < 1e-12 && h + 0.8125 > -1e-12' h="$(column mean_per_m 13)"
holds 'K' 'k - 0.04 < 1e-12 && k - 0.04 > -1e-12' k="$(column gauss_per_m2 13)"
holds 'y' 'y - 0.8 < 1e-12 && y - 0.8 > -1e-12' y="$(column y_m 13)"
expect 0 surface wigley.json --grid grid.json
json_is_valid grid.json || fail 'grid.json is no JSON'

# Lines: a waterline of the Wigley hull, a section, and K = 0, which has two arms below the deck.
expect 0 surface wigley.json --contours lines.csv --at z=0.26,x=5,gauss=0 --points 11x7
tail -n +4 lines.csv | awk -F, '
	function off(a, b) { return a - b > 1e-12 || b - a > 1e-12 }
	{ n[$1]++; s = 1 - $7 / 8; d = 1 - $9; y = 0.8 * (1 - s * s) * (1 - d * d); q = d * d }
	off($8, y) || ($1 == "z" && off($9, 0.26)) || ($1 == "x" && off($7, 5)) { bad++ }
	$1 == "gauss" && (q * (1 + 3 * s * s) - (1 - s * s)) ^ 2 > 1e-18 { bad++ }
	END { exit bad || n["z"] < 11 || n["x"] != 7 || n["gauss"] < 20 }' ||
	fail 'lines are not where they belong'
expect 0 surface "$hull" --net 3x3 --order 3x3 --contours lines.json --at isophote=0.9
json_is_valid lines.json || fail 'lines.json is no JSON'

# Without --out nothing is written.
before=$(state_of .)
expect 0 surface "$hulls/npl_parent.csv" --net 13x13 --json
cp "$out" "$folder/.npl"
holds 'NPL, rms' 'd > 0 && d < 0.3' d="$(member "$folder/.npl" deviation_rms_pct)"
expect 0 surface "$hulls/highspeed_craft.csv" --net 13x13
prints 'fitted to 243 points'
expect 0 surface "$hulls/wigley_noisy.csv" --net 8x8 --rounded keel,stem,stern --free-edges
[ "$(state_of .)" = "$before" ] || fail 'without --out something was written'

# refuses CODE PATTERN ARGUMENT...: one line that has this in it.
refuses()
{
	code_expected=$1
	pattern=$2
	shift 2
	expect "$code_expected" surface "$@"
	one_line
	says "$pattern"
}
refuses 2 'an offsets file was expected'
refuses 2 '--net MxN' "$hull"
for net in 3 3x x3 3x3x3 axb -3x3 3X3 '' 12345x3; do
	refuses 2 "--net: found '$net'" "$hull" --net "$net"
done
refuses 2 'only --grid' wigley.json --net 3x3 --grid g.csv
refuses 2 '--grid FILE or --contours FILE was expected' wigley.json
refuses 2 '--grid FILE or --contours FILE was expected with it' "$hull" --net 3x3 --points 5x5
refuses 2 'expected together' wigley.json --contours l.csv
refuses 2 'expected together' wigley.json --at z=1 --grid g.csv
for list in '' z z= z=x z=1, ,z=1 =1 w=1 z=nan z=1x; do
	refuses 2 "--at: found '$list'" wigley.json --contours l.csv --at "$list"
done
refuses 2 "--points: found '1x5'" wigley.json --grid g.csv --points 1x5
refuses 2 'g.txt' wigley.json --grid g.txt
refuses 6 'none.json' none.json --grid g.csv
refuses 2 "--order: found '3'" "$hull" --net 3x3 --order 3
refuses 2 'order 9' "$hull" --net 12x12 --order 9x4
refuses 2 '3 poles along the hull' "$hull" --net 3x5
refuses 2 "--rounded: found 'deck'" "$hull" --net 5x5 --rounded deck
refuses 2 "--rounded: found 'keel,'" "$hull" --net 5x5 --rounded keel,
refuses 2 'the stern cannot be rounded' "$hulls/npl_parent.csv" --net 8x8 --rounded stern
refuses 2 "--out: found 's.stl'" "$hull" --net 5x5 --out s.stl
refuses 2 "--out: found '.json'" "$hull" --net 5x5 --out .json
refuses 3 'at least 14: one for each pole' "$hull" --net 14x5
refuses 3 'found 260 points, expected at least 400' "$hull" --net 20x20
refuses 6 'none.csv' none.csv --net 4x4
refuses 6 'none/s.json' "$hull" --net 4x4 --out none/s.json
refuses 70 '1024' "$hull" --net 4x4 --max-memory 1K
[ "$(state_of .)" = "$before" ] || fail 'a refused call wrote something'
finish
