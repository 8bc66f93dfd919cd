#!/bin/sh
# Devices: listed, tested, absent, without a library, with a compiler that fails, with other last
# bits.
# shellcheck disable=SC2086 # words without blanks are split on purpose
. "$(dirname "$0")/lib.sh"
without_pictures
hull="$hulls/wigley_noisy.csv --w1 1 --w2 1000" # one search

expect 0 devices
prints '^index '
prints '^0 '
prints 'device reference'
expect 0 devices --json
expect_json "$out"
grep -q '"name": "' "$out" || fail 'no OpenCL device: the tests need one (package pocl-opencl-icd)'
index=$(awk '
	$1 == "\"index\":" { i = $2 + 0 }
	/"platform": "Portable Computing Language"/ { print i; exit }' "$out")
if [ -z "$index" ]; then
	fail 'no device of PoCL'
	finish
fi
expect 0 selftest --device "$index"
for precision in f64 f32; do
	prints "^device $index  multilevel  *$precision  equal "
done
expect 0 selftest --device "$index" --json
expect_json "$out"
[ "$(grep -c '"result": "equal"' "$out")" -ge 2 ] || fail 'not equal in both precisions'
grep -q '"compared": 0,' "$out" && fail 'nothing was compared'
expect 0 fair $hull --device "$index" --out control
[ "$(member control/report.json search strict)" = true ] || fail 'not strict'

# An index that is not there.
for call in "fair $hull --out absent" selftest; do
	expect 4 $call --device 99
	one_line
	says 'device 99'
done
[ -e absent ] && fail 'a folder was made'

# falls_back PATTERN NAME=VALUE...: in this environment there is nothing but the plain C path:
# 'auto' takes it, with a warning, and the same hull; an index is refused with exit code $refusal,
# and the self-test ends with $selftest.
falls_back()
{
	pattern=$1
	shift
	for call in devices selftest "fair $hull --out fallen" \
		"fair $hull --device $index --out refused"; do
		env "$@" "$BATTEN" $call >"$out" 2>"$talk"
		code=$?
		grep -q 'Sanitizer\|runtime error: ' "$talk" && fail "$*: $call: $(cat "$talk")"
		case $call in
		*--device*)
			[ $code -eq "$refusal" ] || fail "$*: $call: exit code $code"
			one_line
			;;
		selftest) [ $code -eq "$selftest" ] || fail "$*: $call: exit code $code" ;;
		*) [ $code -eq 0 ] || fail "$*: $call: exit code $code" ;;
		esac
		case $call in
		devices) [ "$refusal" -eq 5 ] || says "$pattern" ;;
		selftest) grep -q "$pattern" "$out" "$talk" || fail "$*: selftest does not say '$pattern'" ;;
		*) says "$pattern" ;;
		esac
	done
	[ -e refused ] && fail "$*: a folder was made"
	[ "$(member fallen/report.json search device)" = reference ] || fail "$*: not on the plain C path"
	[ "$(member fallen/report.json search strict)" = true ] || fail "$*: not strict"
	sed -n '/"warnings"/,$p' fallen/report.json | grep -q "$pattern" ||
		fail "$*: '$pattern' is not among the warnings of the report"
	cmp control/faired.csv fallen/faired.csv || fail "$*: another hull"
}

refusal=4
selftest=0
falls_back 'no OpenCL driver' "OCL_ICD_VENDORS=$folder/none"
falls_back "library cannot be opened: $folder/none" "BATTEN_OPENCL_LIBRARY=$folder/none"
falls_back 'CL_DEVICE_NOT_FOUND' POCL_DEVICES=none
falls_back 'the linker ld' "PATH=$folder/none"
# A front says so too.
OCL_ICD_VENDORS=$folder/none
export OCL_ICD_VENDORS
expect 0 fair "$hulls/wigley_noisy.csv" --front 1e3:1e5:2 --out front
says 'no OpenCL driver'
unset OCL_ICD_VENDORS
# A build that fails: the compiler is given an option that it does not have.
refusal=5
selftest=5
falls_back 'CL_INVALID_BUILD_OPTIONS' POCL_EXTRA_BUILD_FLAGS=--no-such-option

# Arithmetic that is not strict: never taken by itself, only by its index, and the report says so.
POCL_EXTRA_BUILD_FLAGS=-cl-fast-relaxed-math
export POCL_EXTRA_BUILD_FLAGS
expect 0 selftest --device "$index" --kernel block_search
prints 'block_search .*different .* numbers differ from the C path'
expect 0 fair $hull --out auto
says 'differs from the C path: not used'
[ "$(member auto/report.json search device)" = reference ] || fail 'a device that differs was taken'
expect 0 fair $hull --device "$index" --out loose
[ "$(member loose/report.json search strict)" = false ] || fail 'strict in spite of loose arithmetic'
cmp control/faired.csv auto/faired.csv || fail 'the plain C path gives another hull'
finish
