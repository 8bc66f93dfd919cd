#!/bin/sh
# Bad input: exit code 3 (6 where the file cannot be read), one line that names file, line and
# column, nothing written, nothing overwritten.
# shellcheck disable=SC2086 # words without blanks are split on purpose
. "$(dirname "$0")/lib.sh"
without_pictures
mkdir place place/results
cd place || exit 1
for name in faired.csv report.json before.png after.png lines.svg; do
	echo "an older $name" >results/$name
done
# The line numbers below are those of this file.
cat >good.csv <<'HULL'
# batten-offsets: 1
# name: trial
# unit: m
# frame: ap-fwd
# lbp: 4
# draft: 1
# layout: grid
z\x,0,1,2,3,4
0,0,0,0,0,0
0.5,0,0.31,0.42,0.33,0
1,0,0.54,0.65,0.51,0
HULL
cat >lines.csv <<'HULL'
# batten-offsets: 1
# name: trial
# unit: m
# frame: ap-fwd
# lbp: 4
# draft: 1
# layout: long
waterline,z,x,y
A,0.2,0,0
A,0.2,1,0.1
A,0.2,2,0
B,0.6,0,0.2
B,0.6,1,0.3
B,0.6,2,0.1
C,1,0,0.3
C,1,1,0.4
C,1,2,0.2
HULL
for hull in good lines; do
	expect 0 measure $hull.csv
	expect 0 fair $hull.csv --out ../control --device reference --w1 1 --w2 1
done

# refused PLACE WHAT: bad.csv is refused at PLACE, LINE:COLUMN; the message has WHAT in it. One reader
# serves all calls, so each fault meets the first of them and one more, in turn.
turn=0
refused()
{
	at=$1
	what=$2
	before=$(state_of .)
	turn=$((turn % 5 + 1))
	case $turn in
	1) other='fair bad.csv' ;;
	2) other='fair bad.csv --json --quiet --out results' ;;
	3) other='fair bad.csv --out new/folder' ;;
	4) other='fair good.csv --lower bad.csv --out results' ;;
	5) other='fair good.csv --upper bad.csv --out results' ;;
	esac
	for call in 'measure bad.csv --json' "$other"; do
		expect 3 $call
		one_line
		says "^batten [a-z]*: bad\\.csv:$at: found .*$what"
		says ', expected .'
	done
	[ "$(state_of .)" = "$before" ] || fail "$at, $what: something was written"
}

# with SED-SCRIPT PLACE WHAT: the good file so changed is refused.
with()
{
	sed "$1" good.csv >bad.csv
	cmp -s good.csv bad.csv && fail "$1 changes nothing"
	refused "$2" "$3"
}

with_lines()
{
	sed "$1" lines.csv >bad.csv
	cmp -s lines.csv bad.csv && fail "$1 changes nothing"
	refused "$2" "$3"
}

# The header.
for key in batten-offsets name unit frame lbp draft layout; do
	with "/^# $key:/d" 7:1 "'$key'"
done
with '3s/m$/cm/' 3:9 "'cm'"
with '4s/ap-fwd/sideways/' 4:10 "'sideways'"
with '5s/4/-4/' 5:8 "'-4'"
with '5s/4/4,5/' 5:8 "'4,5'"
with '6s/1/1 m/' 6:10 "'1 m'"
with '7s/grid/cloud/' 7:11 "'cloud'"
with '1s/1/2/' 1:19 "'2'"
with '5p' 6:1 "'lbp'"

# Rows and coordinates.
with '10s/$/,0/' 10:24 '7 cells'
with '10s/,0$//' '10:[0-9]*' '5 cells'
with '8s/3/2/' 8:11 "'2'"
with '8s/2,3/3,2/' 8:11 "'2'"
with '11s/^1/0.5/' 11:1 "'0.5'"
with '11s/^1/0.25/' 11:1 "'0.25'"
with '8s/4/four/' 8:13 "'four'"
with '9,$d' '[0-9]*:1' '0 waterlines'
with '8,$d' '[0-9]*:1' ''

# Half-breadths.
for value in -0.31 nan NaN inf -inf 1e999 0x1 abc '"0.31"' '0.31 0.4' '0;31' 1e7; do
	with "10s/0.31/$value/" 10:7 "$value"
done
# A decimal comma makes a cell more; in every cell, it repeats coordinates.
with '10s/0.31/0,31/' '10:[0-9]*' '7 cells'
sed '8,$s/\([0-9]\)\.\([0-9]\)/\1,\2/g' good.csv >bad.csv
refused '10:[0-9]*' 'decimal comma'
sed '8,$s/,/;/g; 8,$s/\./,/g' good.csv >bad.csv
refused 8:1 'z.x;0;1'

# Layout long.
with_lines 's/long/grid/' 8:1 'waterline'
with_lines '10s/,0.1$//' '10:[0-9]*' ''
with_lines '10s/0.1$/-0.1/' 10:9 "'-0.1'"
with_lines '10s/,1,/,0,/' 10:7 "'0'"
with_lines '12,14s/0.6/0.2/' 12:1 "'B'"
with_lines '10s/0.1$/0,1/' '10:[0-9]*' ''

# No text at all.
: >bad.csv
refused 1:1 'an empty file'
printf '\n\n\n' >bad.csv
refused '[0-9]*:1' "'batten-offsets'"
printf '\211PNG\r\n\032\n\000\000\000\rIHDR' >bad.csv
refused 1:1 '0x89'
printf 'PK\003\004' >bad.csv
refused 1:3 '0x03'
head -c 4096 /dev/zero >bad.csv
refused 1:1 '0x00'
{ cat good.csv && printf '\000'; } >bad.csv
refused 12:1 '0x00'
sed "2s/trial/tri$(printf '\377')al/" good.csv >bad.csv
refused 2:12 '0xff'
head -c $(($(wc -c <good.csv) - 6)) good.csv >bad.csv
refused '11:[0-9]*' '5 cells'

# Too much of it.
{ sed -n 1,7p good.csv && awk 'BEGIN { printf "z\\x"; for (i = 0; i < 4097; i++) printf ",%d", i
	print ""; for (j = 0; j < 3; j++) { printf "%d", j
	for (i = 0; i < 4097; i++) printf ",0.5"; print "" } }'; } >bad.csv
refused '8:[0-9]*' '4096.*4096 stations'
{ sed -n 1,8p good.csv && awk 'BEGIN { for (j = 0; j < 4097; j++) print j ",0,1,1,1,0" }'; } >bad.csv
refused 4105:1 '4096.*4096 waterlines'
{ sed -n 1,9p good.csv && awk 'BEGIN { printf "1"; for (i = 0; i < 1000000; i++) printf ",0.1"
	print "" }'; } >bad.csv
refused '10:[0-9]*' '1000001 cells'
{ sed -n 1,7p good.csv && awk 'BEGIN { printf "z\\x"; for (i = 0; i < 1000000; i++) printf ",%d", i
	print "" }'; } >bad.csv
refused '8:[0-9]*' '4096 stations'

# A table that can be measured and not faired: one line, with the reason.
sed '9d' good.csv >few.csv
sed '10s/0.31/0.32/' good.csv >above.csv
expect 0 measure few.csv
before=$(state_of .)
expect 3 fair few.csv --out results
one_line
says '2 waterlines'
# Bounds that leave no room.
expect 3 fair good.csv --lower above.csv --upper good.csv --out results
one_line
# A rule of quadrature whose conditions do not hold.
expect 3 measure "$hulls/npl_parent.csv" --quadrature simpson
one_line
[ "$(state_of .)" = "$before" ] || fail 'something was written'

# What cannot be read.
for path in nowhere.csv nowhere/hull.csv good.csv/hull.csv results /proc/self/mem ''; do
	for call in measure 'fair --out results' 'fair good.csv --lower' 'fair good.csv --upper'; do
		expect 6 $call "$path"
		one_line
		says "^batten [a-z]*: $path: "
	done
done
[ "$(state_of .)" = "$before" ] || fail 'something was written'
finish
