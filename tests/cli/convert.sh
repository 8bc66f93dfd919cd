#!/bin/sh
# batten convert: endings, units, --surface, and files that another program (gmsh) wrote.
. "$(dirname "$0")/lib.sh"
without_pictures
mkdir place
cd place || exit 1

expect 0 convert --help
prints '^usage: batten convert'
prints '^example:'
prints 'metres'
for option in surface turn threads max-memory json quiet; do
	prints "^  --$option"
done

for ending in json igs iges stp step; do
	expect 0 surface "$hulls/npl_parent.csv" --net 13x9 --out "npl.$ending"
done

for ending in igs iges stp step; do
	expect 0 convert "npl.$ending" c.json
	cmp -s npl.json c.json || fail "npl.$ending holds another surface than npl.json"
	prints 'metres, frame ap-fwd'
	prints '13 x 9 poles of order 4 x 4  NPL parent hull'
done
grep -q 'frame ap-fwd' npl.igs || fail 'npl.igs does not name the frame'
grep -q 'frame ap-fwd' npl.step || fail 'npl.step does not name the frame'
grep -q ',6,1HM,' npl.igs || fail 'npl.igs is not in metres'
grep -q 'SI_UNIT(\$,.METRE.)' npl.step || fail 'npl.step is not in metres'

# poles FILE: the coordinates of the JSON file in mm, rounded to 1e-6 mm, sorted.
poles()
{
	awk '/"poles"/ { inside = 1 } inside && /\[[-0-9.e]+, [-0-9.e]+, [-0-9.e]+]/ {
		gsub(/[][,]/, ""); for (i = 1; i <= 3; i++) printf "%.6f\n", $i * 1000 + 0 }' "$1" |
		sed 's/^-\(0\.0*\)$/\1/' | sort
}

# Files of gmsh: a whole face in millimetres comes in, planes and what is cut off do not.
cat >whole.geo <<'END'
SetFactory("OpenCASCADE");
Merge "npl.igs";
Box(1) = {9000, -1000, -1000, 500, 3000, 3000};
END
gmsh whole.geo -0 -o foreign.step >"$folder/.gmsh" 2>&1 || fail 'gmsh writes no STEP file'
grep -q 'SI_UNIT(.MILLI.,.METRE.)' foreign.step || fail 'foreign.step is not in millimetres'
expect 0 convert foreign.step foreign.json
says 'warning: .*6 x Plane'
poles foreign.json >foreign.poles
poles npl.json >json.poles
[ "$(grep -c . json.poles)" -eq 351 ] || fail 'npl.json has not 351 coordinates'
cmp -s foreign.poles json.poles || fail 'the surface changes on its way through gmsh'
cat >cut.geo <<'END'
SetFactory("OpenCASCADE");
Merge "npl.igs";
Box(1) = {1000, -1000, -1000, 500, 3000, 3000};
BooleanDifference{ Surface{1}; Delete; }{ Volume{1}; Delete; }
END
gmsh cut.geo -0 -o cut.step >"$folder/.gmsh" 2>&1 || fail 'gmsh writes no STEP file'
expect 3 convert cut.step cut.json
one_line
says 'trimmed'
[ ! -e cut.json ] || fail 'a trimmed surface was written'

# refuses CODE PATTERN ARGUMENT...: one line that has this in it.
before=$(state_of .)
refuses()
{
	code_expected=$1
	pattern=$2
	shift 2
	expect "$code_expected" convert "$@"
	one_line
	says "$pattern"
}
refuses 2 'two files'
refuses 2 'two files' npl.json
refuses 2 "found 'x.stl'" npl.json x.stl
expect 0 convert npl.igs chosen.json --surface 1
cmp -s npl.json chosen.json || fail '--surface 1 is another surface'
expect 0 convert npl.igs chosen.json --surface 'NPL parent hull'
cmp -s npl.json chosen.json || fail '--surface by name is another surface'
rm chosen.json
# Several files in one, in their order, under their names; each comes out as it went in.
expect 0 surface "$hulls/wigley.csv" --net 4x4 --out wigley.json
expect 0 convert npl.json wigley.json both.step
prints '^npl.json, wigley.json -> both.step: 2 of 2 surfaces'
expect 0 convert both.step npl.stp both.igs --json
cp "$out" "$folder/.both"
json_is_valid "$folder/.both" || fail 'the report is no JSON'
grep -q '"count": 3' "$folder/.both" || fail 'three surfaces are not reported'
expect 0 convert both.igs chosen.json --surface 2
cmp -s wigley.json chosen.json || fail 'the second surface of several is another one'
refuses 2 "--surface: found 'NPL parent hull'" both.igs x.json --surface 'NPL parent hull'
refuses 2 '3 surfaces, a .json file holds one' both.igs x.json
refuses 2 '2 surfaces, a .json file holds one' npl.json wigley.json x.json
refuses 6 'none.igs' npl.json none.igs x.step
rm chosen.json both.step both.igs wigley.json
# A quarter turn and back loses nothing; x takes y to z.
expect 0 convert npl.igs turned.step --turn x:90
expect 0 convert turned.step back.json --turn x:-90
cmp -s npl.json back.json || fail 'a turn and its return change the surface'
expect 0 surface turned.step --grid turned.csv --points 3x3
expect 0 surface npl.json --grid whole.csv --points 3x3
grep -v '^#' whole.csv >whole
grep -v '^#' turned.csv | paste -d, whole - | awk -F, '
	NR == 1 { wide = NF / 2; next }
	function off(a, b) { return (a - b) ^ 2 > 1e-28 }
	off($3, $(wide + 3)) || off(-$5, $(wide + 4)) || off($4, $(wide + 5)) { bad++ }
	END { exit bad || NR != 10 }' || fail 'x:90 does not take y to z'
rm turned.step back.json turned.csv whole.csv whole
for turn in '' x x: x:a x:9z w:90 90 x:inf; do
	refuses 2 "--turn: found '$turn'" npl.igs x.json --turn "$turn"
done
refuses 2 "--surface: found '0'" npl.igs x.json --surface 0
refuses 2 "--surface: found '2'" npl.igs x.json --surface 2
refuses 2 "--surface: found 'hull'" npl.igs x.json --surface hull
[ "$(state_of .)" = "$before" ] || fail 'a refused call wrote something'
finish
