#!/bin/sh
# IGES and STEP: every number survives the way through both, an independent program (gmsh) finds the same
# poles, and what is refused is refused in one line with nothing written.
. "$(dirname "$0")/lib.sh"
without_pictures
mkdir place
cd place || exit 1

expect 0 convert --help
prints '^usage: batten convert'
prints '^example:'
expect 0 surface "$hulls/npl_parent.csv" --net 13x11 --out npl.json
expect 0 convert npl.json npl.igs
expect 0 convert npl.igs npl.step --json
json_is_valid "$out" || fail 'the report is no JSON'
expect 0 convert npl.step back.json
cmp -s npl.json back.json || fail 'the surface changed on its way through IGES and STEP'
expect 0 surface "$hulls/npl_parent.csv" --net 13x11 --out direct.step
cmp -s npl.step direct.step || {
	# The time of writing stands in the head of the file.
	sed '/^FILE_NAME/,/;$/d' npl.step >"$folder/.a"
	sed '/^FILE_NAME/,/;$/d' direct.step >"$folder/.b"
	cmp -s "$folder/.a" "$folder/.b" || fail 'surface and convert write different STEP files'
}

# The poles as gmsh sees them, in millimetres: behind "9 ..." in the section of the surfaces.
poles_of()
{
	gmsh "$1" -0 -o "$folder/seen.brep" >"$folder/.gmsh" 2>&1 || {
		fail "gmsh does not open $1:"
		cat "$folder/.gmsh"
		return
	}
	awk '/^Surfaces/ { on = 1; next } on && /^9 / { on = 2; for (i = 12; i <= NF; i++) print $i; next }
	     on == 2 && NF == 0 { on = 3 } on == 2 { for (i = 1; i <= NF; i++) print $i }' "$folder/seen.brep"
}
# Three numbers a pole; the file of a hull lists them by rows, gmsh by columns.
sed -n '/"poles/,$p' npl.json | tr -c '0-9eE.+\n-' ' ' | tr -s ' ' '\n' | grep '[0-9]' >"$folder/.json"
for file in npl.igs npl.step; do
	poles_of "$file" >"$folder/.seen"
	count=$(wc -l <"$folder/.seen")
	[ "$count" -eq $((3 * 13 * 11)) ] || fail "$file: gmsh has $count numbers of poles"
	paste -d' ' - - - <"$folder/.seen" | sort -g >"$folder/.poles_seen"
	paste -d' ' - - - <"$folder/.json" | head -n $((13 * 11)) |
		awk '{ printf "%.17g %.17g %.17g\n", 1000 * $1, 1000 * $2, 1000 * $3 }' |
		sort -g >"$folder/.poles"
	awk 'NR == FNR { for (c = 1; c <= 3; c++) known[FNR, c] = $c; rows = FNR; next }
	     { best = 1e300
	       for (r = 1; r <= rows; r++) {
	         d = 0
	         for (c = 1; c <= 3; c++) { e = known[r, c] - $c; d += e * e }
	         if (d < best) best = d
	       }
	       if (best > 1e-18) { print "no pole within 1e-9 mm of " $0; bad = 1 } }
	     END { exit bad }' "$folder/.poles" "$folder/.poles_seen" || fail "$file: gmsh sees other poles"
done

# refuses CODE PATTERN ARGUMENT...: one line that has this in it, and nothing written.
refuses()
{
	_expected=$1
	_pattern=$2
	shift 2
	_before=$(state_of .)
	expect "$_expected" "$@"
	one_line
	says "$_pattern"
	[ "$(state_of .)" = "$_before" ] || fail "batten $*: something was written"
}
head -c 900 npl.igs >cut.igs
head -c 2000 npl.step >cut.step
: >empty.igs
cp npl.json foreign.igs
refuses 2 'expected' convert npl.json
refuses 2 'batten surface' convert "$hulls/wigley.csv" x.igs
refuses 2 'x.obj' convert npl.json x.obj
refuses 3 'cut.igs: ' convert cut.igs x.json
refuses 3 'cut.step: ' convert cut.step x.json
refuses 3 'empty.igs: ' convert empty.igs x.json
refuses 3 'foreign.igs: ' convert foreign.igs x.json
refuses 6 'absent.igs: ' convert absent.igs x.json
refuses 6 'nowhere/x.igs' convert npl.json nowhere/x.igs
BATTEN_MODULE_PATH=/nonexistent
export BATTEN_MODULE_PATH
refuses 6 'libocct-data-exchange-dev' convert npl.json x.igs
refuses 6 'libocct-data-exchange-dev' surface "$hulls/wigley.csv" --net 3x3 --order 3x3 --out x.step
finish
