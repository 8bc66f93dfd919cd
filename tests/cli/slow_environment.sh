#!/bin/sh
# Wherever it is run: another folder, no home, no Vulkan, odd names, a reader that goes away.
# shellcheck disable=SC2086 # words without blanks are split on purpose
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley.csv
quick="--w1 1 --w2 1"

# Without --out, the files go to NAME-faired in the folder it is run from.
mkdir here here/below
cd here || exit 1
cp "$hull" 'below/a b.csv'
cp "$hull" below/hull
cp "$hull" "$(printf 'below/caf\303\251 %%s.csv')"
cp "$hull" ./-dash.csv
for name in 'a b.csv:a b' hull:hull "$(printf 'caf\303\251 %%s.csv:caf\303\251 %%s')"; do
	expect 0 fair "below/${name%:*}" $quick
	[ -s "${name#*:}-faired/report.json" ] || fail "nothing in ${name#*:}-faired"
	expect_json "${name#*:}-faired/report.json"
	prints "^written to ${name#*:}-faired: "
done
expect 0 fair $quick -- -dash.csv
[ -s ./-dash-faired/faired.csv ] || fail 'nothing in -dash-faired'
[ "$(ls below | wc -l)" -eq 3 ] || fail 'something was written beside the hull'
expect 0 fair below/hull $quick --out new/folders//below/
cmp hull-faired/faired.csv new/folders/below/faired.csv || fail 'another hull'
# From a pipe.
"$BATTEN" measure "$hull" --json >expected.json
"$BATTEN" measure /dev/stdin --json <"$hull" | cmp - expected.json || fail '/dev/stdin'
cd .. || exit 1

# --quiet: not a word; data all the same.
expect 0 fair "$hull" $quick --quiet --out quiet
[ -s "$talk" ] && fail "--quiet: $(cat "$talk")"
[ -s "$out" ] && fail "--quiet printed: $(head -n 1 "$out")"
# --json: the report, whole, on standard output.
expect 0 fair "$hull" $quick --json --out json
expect_json "$out"
cmp "$out" json/report.json || fail '--json is not the report'

# Without Vulkan: everything but the pictures, a warning, no older pictures beside the new hull.
mkdir plain
echo old | tee plain/before.png >plain/after.png
expect 0 fair "$hull" $quick --out plain
says '^warning: before.png and after.png are not drawn: '
sed -n '/"warnings"/,$p' plain/report.json | grep -q 'not drawn' || fail 'not in the report'
[ "$(member plain/report.json pictures)" = null ] || fail 'pictures in the report'
[ "$(ls -A plain | tr '\n' ' ')" = 'faired.csv lines.svg report.json ' ] ||
	fail "in the folder: $(ls -A plain | tr '\n' ' ')"

# A special character in a name stays what it is.
sed 's/^# name: .*/# name: "<b>\&amp; \\ %s '"$(printf '\303\251')"'/' "$hull" >name.csv
expect 0 fair name.csv $quick --out name
expect_json name/report.json
same_form name.csv name/faired.csv
grep -q '<b>' name/lines.svg && fail 'lines.svg: a name taken for a tag'
expect 0 measure name.csv --json
expect_json "$out"

# What a spreadsheet makes of a file is taken: a mark, ends of lines, commas after the header.
{ printf '\357\273\277' && sed "s/^# lbp.*/&,,,/; s/\$/$(printf '\r')/" "$hull"; } >sheet.csv
expect 0 fair sheet.csv $quick --out sheet
cmp quiet/faired.csv sheet/faired.csv || fail 'a spreadsheet changes the hull'

# No home, and one where nothing can be kept: compiled anew in a folder that is gone afterwards.
mkdir temporary
for home in unset /proc; do
	(
		unset HOME XDG_CACHE_HOME POCL_CACHE_DIR
		[ $home = unset ] || export HOME=$home
		export TMPDIR="$folder/temporary"
		"$BATTEN" fair "$hull" $quick --out home >"$out" 2>"$talk"
	)
	code=$?
	[ $code -eq 0 ] || fail "HOME $home: exit code $code: $(cat "$talk")"
	grep -q 'Sanitizer\|runtime error: ' "$talk" && fail "HOME $home: $(cat "$talk")"
	cmp quiet/faired.csv home/faired.csv || fail "HOME $home: another hull"
	[ "$(member home/report.json search device)" = "$(member quiet/report.json search device)" ] ||
		fail "HOME $home: on another device"
	[ -z "$(ls -A temporary)" ] || fail "HOME $home: left in TMPDIR: $(ls -A temporary)"
done

# A reader that goes away early harms no file.
"$BATTEN" fair "$hull" $quick --json --out gone 2>"$talk" | true
cmp quiet/faired.csv gone/faired.csv || fail 'not all written'
expect_json gone/report.json
finish
