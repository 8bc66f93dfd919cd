#!/bin/sh
# batten fair --method: smoothing, forward and inverse fairing.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/wigley_noisy.csv

# One iteration more lowers fn further; the rows are in the report and on the terminal.
for method in forward-approximation forward-fit inverse; do
	expect 0 fair "$hull" --method $method --iterations 3 --out $method
	prints '^ *iteration .*beam_m .*cwp .*cb .*cm .*lcb_pct_lbp_fwd .*volume_m3 .*fn_per_m2 .*cn_pct'
	prints '^ *3 '
	expect_json $method/report.json
	[ "$(grep -c '"iteration"' $method/report.json)" -eq 4 ] || fail "$method: not four rows"
	holds "$method: fairer" 'a < 0.6 * b' a="$(member $method/report.json after fn_per_m2)" \
		b="$(member $method/report.json before fn_per_m2)"
	change "$hull" $method/faired.csv >.change
	read -r most rms count <.change
	holds "$method: change" 'most > 0 && most < 0.03' most="$most"
done
expect 0 fair "$hull" --method inverse --order 2 --iterations 4 --out same
table_of "$hull" >.before
table_of same/faired.csv >.after
change .before .after >.change
read -r most rms count <.change
holds "order 2 changes nothing" 'most == 0' most="$most"

expect 0 fair "$hulls/npl_parent.csv" --method smooth --out smooth
[ "$(grep -c '"old_m"' smooth/report.json)" -eq 1 ] || fail "smooth: not one offset replaced"
expect 0 fair "$hulls/npl_parent.csv" --method forward-fit --smooth --out fit
[ "$(grep -c '"old_m"' fit/report.json)" -eq 1 ] || fail "fit --smooth: not one offset replaced"
says 'too few points for the method and were passed over'
grep -q '"2 lines .* have too few points for the method and were passed over' fit/report.json ||
	fail "the report does not say what was passed over"

for restore in beam volume cp,lcb; do
	expect 0 fair "$hulls/bsra_trawler.csv" --method forward-approximation --iterations 2 \
		--restore $restore --out restored
	prints '^restored '
done
expect 0 fair "$hull" --method forward-approximation --max-cn 2 --iterations 50 --out stopped
grep -q '"ended_by": "max-cn"' stopped/report.json || fail "not stopped by --max-cn"
holds "max-cn" 'cn <= 2' cn="$(member stopped/report.json after cn_pct)"

# Named errors; nothing is written.
refuse()
{
	_says=$1
	shift
	expect 2 fair "$hull" --out refused "$@"
	says "$_says"
	[ ! -e refused ] || fail "fair $*: something is written"
}
refuse 'order 9' --method forward-approximation --order 9
refuse 'found order 1' --method inverse --order 1
refuse 'needs 22 points' --method forward-fit --vertices 22
refuse 'at least the order 4' --method forward-fit --order 4 --vertices 3
refuse 'found 0 iterations' --method inverse --iterations 0
refuse "found '1000000000'" --method inverse --iterations 1000000000
refuse 'found 10001 iterations' --method inverse --iterations 10001
refuse 'found 8 vertices' --method forward-approximation --vertices 8
refuse 'is about the search' --method inverse --lock station:8
refuse 'is about forward and inverse' --restore beam
refuse "found 'backward'" --method backward
refuse "expected beam, volume or cp,lcb" --method inverse --restore draft
{
	sed -n '/^#/p' "$hull"
	printf 'z\\x,0,1,2,3\n0,0,0.2,0.1,0\n1,0,1,1,0\n2,0,1.2,1.2,0\n'
} >small.csv
expect 2 fair small.csv --method forward-approximation --order 5 --out refused
says 'order 5 needs 5 points, the longest waterline has 4'
sed 's/,2,3$/,2,2/' small.csv >coincident.csv
expect 3 fair coincident.csv --method inverse --out refused
says "found '2', expected each x once"
sed '$a profile,stem,15.5,0,1' "$hull" >behind.csv
expect 3 fair behind.csv --method forward-approximation --out refused
says 'behind the end of the waterline'
finish
