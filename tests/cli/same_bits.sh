#!/bin/sh
# The faired hull is the same, byte for byte, whatever computed it and however often.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/npl_parent.csv

# faired FOLDER ARGUMENT...
faired()
{
	where=$1
	shift
	expect 0 fair "$hull" "$@" --quiet --out "$where"
}

faired auto
device=$(member auto/report.json search device)
case $device in
'' | reference) fail "the default ran on '$device', an OpenCL device was expected" ;;
esac
[ "$(member auto/report.json search strict)" = true ] || fail 'the default is not strict'
faired again
faired one --threads 1
faired two --threads 2
faired seed --seed 7
faired reference --device reference --threads 1
[ "$(member reference/report.json search device)" = reference ] || fail 'not on the plain C path'
for way in again one two seed reference; do
	cmp auto/faired.csv $way/faired.csv || fail "$way: faired.csv differs"
	cmp auto/lines.svg $way/lines.svg || fail "$way: lines.svg differs"
	for key in iterations probes objective_before objective_after last_step_m; do
		[ "$(member auto/report.json search $key)" = "$(member $way/report.json search $key)" ] ||
			fail "$way: another $key"
	done
done

# Single precision: other bits, the same on both; and nearly the same hull.
faired single --precision f32
[ "$(member single/report.json search precision)" = f32 ] || fail 'f32 is not in the report'
faired single.reference --precision f32 --device reference
cmp single/faired.csv single.reference/faired.csv || fail 'f32 differs from the C path in f32'
cmp -s single/faired.csv auto/faired.csv && fail 'f32 gives the bits of f64'
holds 'objective in f32' 'a <= b * (1 + 3e-4) && a >= b * (1 - 3e-4)' \
	a="$(member single/report.json search objective_after)" \
	b="$(member auto/report.json search objective_after)"
same_form "$hull" single/faired.csv
finish
