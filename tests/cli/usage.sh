#!/bin/sh
# Help, version, and what is no proper call: exit code 2, one line, nothing written.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley.csv
mkdir place
cd place || exit 1
: >taken
before=$(state_of .)

expect 0 --version
prints '^batten [0-9][0-9]*\.[0-9][0-9]*\.[0-9][0-9]*$'
for word in --help -h help; do
	expect 0 "$word"
	prints 'fair .*'
	prints 'measure .*'
	prints 'convert .*'
	prints 'devices .*'
	prints 'selftest .*'
	prints 'bench .*'
	prints '^exit codes'
done
for command in fair measure convert devices selftest bench; do
	for word in --help -h; do
		expect 0 $command $word
		prints "^usage: batten $command"
		prints '^example:'
		prints "^  batten $command"
		for option in threads max-memory json quiet help; do
			prints "^  --$option"
		done
	done
done
expect 0 fair --help
for option in out method search variables fairness longitudinal transverse front w1 w2 max-distance lock lower upper interior-penalty no-smooth \
	iterations device precision seed; do
	prints "^  --$option "
done
# Help wins, whatever else is asked for.
expect 0 fair --w1 1 --help "$hull"

# refuses PATTERN ARGUMENT...: a usage error whose one line has this in it.
refuses()
{
	pattern=$1
	shift
	expect 2 "$@"
	one_line
	says "$pattern"
}

run
[ $code -eq 2 ] || fail "without arguments: exit code $code"
says '^usage: batten'
refuses "'frobnicate'" frobnicate
refuses "'--json'" --json
for command in fair measure; do
	refuses 'an offsets file was expected' $command
	refuses "'b'" $command a b
	refuses '--threads needs a value' $command --threads
	refuses "'--frobnicate'" $command --frobnicate "$hull"
	refuses "'-z'" $command "$hull" -z
	refuses "'-xyz'" $command -xyz "$hull"
	refuses '--threads.*5000' $command --threads 5000 "$hull"
	refuses "--threads.*'two'" $command --threads two "$hull"
	refuses "--threads.*'-1'" $command --threads -1 "$hull"
	refuses "--max-memory.*'4X'" $command --max-memory 4X "$hull"
	refuses "--max-memory.*'-1'" $command --max-memory -1 "$hull"
	refuses "--max-memory.*'99999999999999999999'" $command --max-memory 99999999999999999999 "$hull"
done
for command in devices selftest; do
	refuses "'surplus'" $command surplus
done
refuses "--device.*'gpu'" fair --device gpu "$hull"
refuses "--device.*'-1'" fair --device -1 "$hull"
refuses 'reference' selftest --device reference
refuses 'block_search' selftest --kernel block
refuses "--precision.*'f16'" fair --precision f16 "$hull"
refuses "--iterations.*'1.5'" fair --iterations 1.5 "$hull"
refuses '--iterations' fair --iterations 0 "$hull"
refuses "--iterations.*''" fair --iterations '' "$hull"
refuses "--method.*'lofting'.*search" fair --method lofting "$hull"
refuses "--search.*'lofting'.*multilevel" fair --search lofting "$hull"
refuses "--variables.*'lofting'.*offsets" fair --variables lofting "$hull"
refuses "--fairness.*'lofting'.*bending" fair --fairness lofting "$hull"
refuses "--out.*''" fair --out '' "$hull"
refuses '--w1.*--w2' fair --w1 1 "$hull"
refuses '--w1.*--w2' fair --w2 1 "$hull"
refuses '--w1.*--w2' fair --w1 1 --w2 -1 "$hull"
refuses '--w1.*--w2' fair --w1 -1 --w2 -1 "$hull"
refuses "--w1.*'nan'" fair --w1 nan --w2 1 "$hull"
refuses "--w2.*'inf'" fair --w1 1 --w2 inf "$hull"
refuses "--w2.*'1,5'" fair --w1 1 --w2 1,5 "$hull"
refuses 'w1 = 0, w2 = 0' fair --w1 0 --w2 0 "$hull"
for distance in 1 -1% '1 mm' 1furlong % nan% 1e999mm ''; do
	refuses "--max-distance.*'$distance'" fair --max-distance "$distance" "$hull"
done
for lock in frame:8 station: station:x point:8 point:8@ point:@1 station:8x, ,station:8; do
	refuses '--lock' fair --lock "$lock" "$hull"
done
refuses 'station.*3\.3' fair --lock station:3.3 "$hull"
refuses 'waterline.*77' fair --lock waterline:77 "$hull"
refuses '0\.333' fair --lock point:8@0.333 "$hull"
refuses 'lower' fair --lower "$hulls/npl_parent.csv" "$hull"
refuses 'upper' fair --upper "$hulls/npl_parent.csv" "$hull"
refuses "--quadrature.*'gauss'" measure --quadrature gauss "$hull"
refuses "--draft.*'deep'" measure --draft deep "$hull"
refuses '--draft' measure --draft 0 "$hull"
refuses '--draft.*-1' measure --draft -1 "$hull"
refuses '99.*0 to 1' measure --draft 99 "$hull"
refuses 'density' measure --density 0 "$hull"

# Asked for too much memory is no usage error.
for command in fair measure; do
	expect 70 $command --max-memory 1K "$hull"
	one_line
	says '1024'
done

[ "$(state_of .)" = "$before" ] || fail 'a refused call wrote something'
finish
