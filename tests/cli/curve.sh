#!/bin/sh
# batten curve: representations of one line, its measures, its files, and what it refuses.
. "$(dirname "$0")/lib.sh"

ln -s "$DATA/lines" "$links/lines"
lines=$links/lines

expect 0 curve "$lines/quadratic.csv" --json --parameter x --as spline:not-a-knot,lagrange,least-squares:2
expect_json "$out"
expect_schema curve "$out"
cp "$out" three.json
[ "$(member three.json name)" = 'distorted quadratic' ] || fail 'the line is not named'
[ "$(grep -c '"as": ' three.json)" -eq 3 ] || fail 'not three representations'
for name in deviation_max_m length_m curvature_max_per_m inflections monotone_pieces \
	curvature_rate_max_per_m2 energy_bending_per_m energy_mvc_per_m3; do
	[ "$(grep -c "\"$name\": " three.json)" -eq 3 ] || fail "$name is not there three times"
done

# --out FILE.json keeps what --json prints, and nothing half-written.
expect 0 curve "$lines/quadratic.csv" --json --parameter x \
	--as spline:not-a-knot,lagrange,least-squares:2 --out kept.json
cmp "$out" kept.json || fail 'the file differs from what is printed'
expect 6 curve "$lines/quadratic.csv" --out missing/kept.json
one_line
says 'missing/kept.json: No such file'
mkdir folder.json
expect 6 curve "$lines/quadratic.csv" --out folder.json
[ ! -e folder.json.part ] || fail 'a half-written file is left'

# The table, and the default.
expect 0 curve "$lines/quadratic.csv"
prints '1  spline:natural'
prints '^length_m '
prints 'parameter chord'

# Sampled points are a line file again, whose polygon is no longer than the curve.
expect 0 curve "$lines/npl_waterline.csv" --points 500 --out sampled.csv --json
cp "$out" first.json
expect 0 curve sampled.csv --json
length()
{
	sed -n 's/^ *"length_m": \([-0-9.e+]*\),*$/\1/p' "$1"
}
holds 'length' 'a - b < 1e-6 && b - a < 1e-6' a="$(length first.json)" b="$(length "$out")"

# A picture, the same each time; a space curve has two views.
expect 0 curve "$lines/npl_waterline.csv" --as spline:natural,bspline:4 --out one.svg --quiet
expect 0 curve "$lines/npl_waterline.csv" --as spline:natural,bspline:4 --out two.svg --quiet
cmp one.svg two.svg || fail 'the picture differs from run to run'
printf 'x,y,z\n0,0,0\n1,0,0\n2,1,0.5\n3,1,1\n' >space.csv
expect 0 curve space.csv --json --out space.svg
expect_schema curve "$out"
prints '"torsion_per_m"'
for name in tangent normal binormal; do
	prints "\"$name\""
done
prints '"inflections": null'
[ -s space.svg ] || fail 'no picture of a space curve'

# Units: 1000 mm are 1 m, and a foot is 0.3048 m.
printf '# unit: mm\n0,0\n1000,0\n' >mm.csv
expect 0 curve mm.csv
prints '^mm.csv: 2 points'
expect 0 curve mm.csv --json
holds 'mm' 'a == 1' a="$(length "$out")"
printf '# unit: ft\n0,0\n10,0\n' >ft.csv
expect 0 curve ft.csv --json
holds 'ft' 'a - 3.048 < 1e-14 && 3.048 - a < 1e-14' a="$(length "$out")"

# refused TEXT PATTERN: a file of this text is refused with this talk.
refused()
{
	printf "$1" >bad.csv
	expect 3 curve bad.csv
	one_line
	says "bad.csv:$2"
}
refused '' '1:1: found an empty file'
refused 'x,y\n' '2\{0,1\}1\{0,1\}:1: found the end after 0 points'
refused 'x,y\n0,0\n' '.*found the end after 1 point'
refused 'x,y\n0,0\n1;5,2\n' '3:1: .*expected a number for x'
refused 'x,y\n0,0\n1,5,2\n' '3:1: found 3 cells, expected 2.*decimal comma'
refused '0,0\n1,nan\n' '2:3: '
refused '0,0\n1,1e400\n' '2:3: '
refused '0,0\n1,1e7\n' '2:3: .*within 1e+06 m'
refused '0,0\n1,1\n1,1\n' '3:1: found the point before it again'
refused 'x,z\n0,0\n1,1\n' "1:3: found 'z'"
refused '0\n1\n' '1:1: found 1 cells'
refused '# unit: inch\n0,0\n1,1\n' "1:9: found 'inch'"
refused '# name: a\n# name: b\n0,0\n1,1\n' '2:1: '
refused '0,0\n# unit: mm\n1,1\n' '2:1: .*after the table began'
refused '0,0\n1,\001\n' '2:3: found the byte'
awk 'BEGIN { for (i = 0; i <= 4096; i++) print i ",0" }' >many.csv
expect 3 curve many.csv
says 'many.csv:4097:1: .*at most 4096'
awk 'BEGIN { for (i = 0; i < 65; i++) print i "," i * i }' >long.csv
expect 2 curve long.csv --as lagrange
says '64 at most'
printf '0,0\n2,1\n1,2\n' >back.csv
expect 3 curve back.csv --parameter x
says 'x to ascend'
expect 6 curve absent.csv

# misused ARGUMENT...: usage.
misused()
{
	expect 2 curve "$lines/quadratic.csv" "$@"
	one_line
}
misused --as circle
misused --as ''
misused --as spline:loose
misused --as spline:clamped=
misused --as least-squares:x
misused --as bspline:4:5
misused --as lagrange:3
misused --parameter z
misused --out picture.png
misused --out both.csv --as lagrange,newton
misused --out few.csv --points 1
expect 2 curve
[ ! -e few.csv ] || fail 'a refused file is there'
finish
