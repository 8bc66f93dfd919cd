#!/bin/sh
# Output that cannot be written: exit code 6, one line, nothing half-written, nothing overwritten.
# shellcheck disable=SC2086 # words without blanks are split on purpose
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley.csv
# The plain C path and given weights: quick, and nothing but the program itself writes.
quick="--device reference --w1 1 --w2 1 --iterations 400"
mkdir place place/results place/blocked place/blocked/report.json
cd place || exit 1
echo 'a file' >taken
for name in faired.csv report.json before.png after.png lines.svg; do
	echo "an older $name" >results/$name
done
echo 'an older faired.csv' >blocked/faired.csv
before=$(state_of .)

# unwritable PATH: asked to write into this folder, the program writes nothing at all.
unwritable()
{
	expect 6 fair "$hull" $quick --quiet --out "$1"
	one_line
	says "^batten fair: .*$2"
	[ "$(state_of .)" = "$before" ] || fail "--out $1: something was written or overwritten"
}

unwritable taken taken
unwritable taken/below taken
unwritable /dev/null /dev/null
unwritable /proc /proc
unwritable /proc/below/it /proc
unwritable blocked report.json
if [ "$(id -u)" -ne 0 ]; then # nothing is read-only for root
	chmod 555 results
	unwritable results results
	chmod 755 results
fi

# A full disk, as a limit on the size of a file: of 512 bytes, and of 8 and 64 kilobytes (some
# shells count in kilobytes, which is as good), so that it strikes in different files.
for limit in 1 16 128; do
	(
		ulimit -c 0
		ulimit -f $limit
		"$BATTEN" fair "$hull" $quick --quiet --out results >"$out" 2>"$talk"
	)
	code=$?
	[ $code -eq 6 ] || fail "files limited to $limit blocks: exit code $code"
	one_line
	says 'results.*cannot be written'
	[ "$(state_of .)" = "$before" ] || fail "files limited to $limit blocks: written or overwritten:
$(ls -A results)"
done

# Standard output that takes nothing.
for call in --help --version 'fair --help' "measure $hull" "measure $hull --json" devices \
	"fair $hull $quick --out ../elsewhere" "fair $hull $quick --json --out ../elsewhere"; do
	"$BATTEN" $call >/dev/full 2>"$talk"
	code=$?
	[ $code -eq 6 ] || fail "batten $call: exit code $code with a full standard output"
	says 'standard output'
	"$BATTEN" $call >&- 2>"$talk"
	code=$?
	[ $code -eq 6 ] || fail "batten $call: exit code $code with a closed standard output"
	says 'standard output'
done
# Its files are whole all the same, and so are they without any of the three streams.
expect 0 fair "$hull" $quick --out ../control
"$BATTEN" fair "$hull" $quick --quiet --out ../closed <&- >&- 2>&- ||
	fail "exit code $? without standard streams"
for other in elsewhere closed; do
	cmp ../control/faired.csv ../$other/faired.csv || fail "$other: faired.csv differs"
	cmp ../control/lines.svg ../$other/lines.svg || fail "$other: lines.svg differs"
	expect_json ../$other/report.json
done

# What was there is replaced, what else is in the folder stays, nothing is left behind.
mkdir ../again
echo 'not ours' >../again/notes.txt
for turn in 1 2; do
	expect 0 fair "$hull" $quick --out ../again
	cmp ../control/faired.csv ../again/faired.csv || fail 'faired.csv was not replaced'
done
[ "$(cat ../again/notes.txt)" = 'not ours' ] || fail 'a file of the user was touched'
[ "$(ls -A ../again | tr '\n' ' ')" = 'faired.csv lines.svg notes.txt report.json ' ] ||
	fail "left in the folder: $(ls -A ../again | tr '\n' ' ')"
[ "$(state_of .)" = "$before" ] || fail 'something was written elsewhere'
finish
