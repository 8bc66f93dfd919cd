#!/bin/sh
# batten vary --rows: a table of many variants, its rows those of one call each, its failing rows beside.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/bsra_trawler.csv
mkdir place
cd place || exit 1

expect 0 vary --help
for option in rows drafts hulls device; do
	prints "^  --$option"
done

# cell FILE ID COLUMN [DRAFT]: of the first row with that id, and that draft where one is given.
cell()
{
	awk -F, -v id="$2" -v name="$3" -v draft="${4-}" '/^#/ { next }
		!n { n = NF; for (i = 1; i <= NF; i++) { if ($i == name) c = i; if ($i == "draft_m") d = i }; next }
		$1 == id && (draft == "" || $d == draft) { print $c; exit }' "$1"
}

# The example: a row of the table is what one call gives, and measures of it at another draft.
expect 0 vary "$hull" --method lackenby --rows "$DATA/examples/trawler-rows.csv" --drafts 2.515,2 \
	--hulls hulls --out table.csv --json
cp "$out" report.json
expect_json report.json
[ "$(member report.json rows)" = 5 ] || fail 'not five rows'
[ "$(member report.json failed)" = 0 ] || fail 'a row failed'
[ "$(grep -c '^both,ok,,' table.csv)" = 2 ] || fail 'not a row a draft'
expect 0 vary "$hull" --method lackenby --dcp 4 --dlcb 1 --out both.csv
for draft in 2.515 2; do
	expect 0 measure both.csv --draft $draft --json
	for name in volume_m3 wetted_surface_m2 kmt_m lcf_pct_lbp_fwd; do
		holds "$name at $draft" 'a - b < 1e-8 && b - a < 1e-8' \
			a="$(cell table.csv both $name $draft)" b="$(member "$out" $name)"
	done
done
holds 'what was asked is what was got' 'a - b < 1e-9 && b - a < 1e-9 && a > 0.6' \
	a="$(cell table.csv both asked_cp)" b="$(cell table.csv both got_cp)"
holds 'given' 'a == 4' a="$(cell table.csv both given_dcp)"
set -- $(change both.csv hulls/5.csv)
holds 'the hull of the row' 'd < 1e-9 && n > 100' d="$1" n="$3"
[ "$(ls hulls | wc -l)" = 5 ] || fail 'not five hulls'
# The same bits on the C path.
expect 0 vary "$hull" --method lackenby --rows "$DATA/examples/trawler-rows.csv" --drafts 2.515,2 \
	--device reference --out again.csv
cmp -s table.csv again.csv || fail 'the C path gives another table'

# Failing rows of each method: one good, one bad, the good one whole. METHOD HEADER GOOD BAD REASON OPTION...
both()
{
	method=$1
	printf '%s\n%s\n%s\n' "$2" "$3" "$4" >rows.csv
	reason=$5
	shift 5
	expect 1 vary "$hull" --method "$method" --rows rows.csv --out one.csv "$@"
	says '1 of 2 rows failed'
	[ "$(cell one.csv 1 status)" = ok ] || fail "$method: the good row failed"
	holds "$method: the volume" 'v > 100 && v < 400' v="$(cell one.csv 1 volume_m3)"
	[ "$(cell one.csv 2 status)" = failed ] || fail "$method: the bad row is good"
	grep "^2,failed,.*$reason" one.csv >/dev/null || fail "$method: no reason: $(grep ^2, one.csv)"
	grep '^2,.*,,,,,,,,,,$' one.csv >/dev/null || fail "$method: a failed row has numbers"
}
both swing dlcb 1 60 'swing: out of reach (sections would run into each other); in the proportion asked for lcb_pct_lbp_fwd '
both one-minus-prismatic dcp,dlcb 2,0.5 90, 'out of reach.*can be reached'
both lackenby dcp 2 50 'out of reach.*cp 0.4188 to 0.7575'
both lackenby dcp,dp-fore 2,1 2,200 'dp_fore is 200'
both moor dcb,dcwp 2,1 0,2000 'dcwp is 2000'
both affine x,y,z 1.2,0.9,1.1 1,-1,1 'scale_y is -1'
both stretch 0,0.5,1 0,0.52, 0,1.2,1 'would fold'
both nonlinear amount 0.1 0.2 'would fold' --preset u-ness
both three-body volume_m3,cp 255, 255,7 'cp is 7' --middle 12.192,18.288
both average weight 0.5 1000 'weight 1 is 1000' --with both.csv
printf 'lattice\n%s\n' "$DATA/lattices/trawler_shoulder.json" >rows.csv
expect 0 vary "$hull" --method free-form --rows rows.csv --out lattice.json
expect_json lattice.json
sed 's/\[3, 2, 3, 0,/[3, 2, 3, -20,/' "$DATA/lattices/trawler_shoulder.json" >folding.json
both free-form lattice "$DATA/lattices/trawler_shoulder.json" folding.json 'would fold'
# Empty cells take what the command line says; a fraction is warned of in its row.
printf 'dcp,dlcb\n0.03,\n' >rows.csv
expect 0 vary "$hull" --method lackenby --dlcb 1 --rows rows.csv --out one.csv
grep -q '^1,ok,,dcp is 0.03 percent: is percent what is meant?,1,' one.csv || fail 'no warning'
holds 'empty cell' 'a > -0.32 && a < -0.31' a="$(cell one.csv 1 got_lcb_pct_lbp_fwd)"

# refuses CODE PATTERN ROWS ARGUMENT...: one line, and nothing written.
refuses()
{
	code_expected=$1
	pattern=$2
	printf "$3" >rows.csv
	shift 3
	before=$(state_of .)
	expect "$code_expected" vary "$@"
	one_line
	says "$pattern"
	[ "$(state_of .)" = "$before" ] || fail "wrote something: $pattern"
}
set -- "$hull" --rows rows.csv --out x.csv --hulls never
refuses 3 "rows.csv:1:1: found '', expected a first row of names" '' "$@" --method swing
refuses 3 "rows.csv:1:1: found 'dcp', expected a name that swing takes: dlcb$" 'dcp\n1\n' "$@" --method swing
refuses 3 "rows.csv:1:2: found 'dlcb', expected each name once" 'dlcb,dlcb\n1,1\n' "$@" --method swing
refuses 3 "rows.csv:1:1: found 'id', expected a column of numbers" 'id\n1\n' "$@" --method swing
refuses 3 "rows.csv:2:1: found '', expected a row" 'dlcb\n' "$@" --method swing
refuses 3 "rows.csv:3:1: found '1;5', expected a number" 'dlcb\n1\n1;5\n' "$@" --method swing
refuses 3 "rows.csv:2:1: found '0x1', expected a number" 'dlcb\n0x1\n' "$@" --method swing
refuses 3 "rows.csv:2:2: found '5', expected no more cells" 'dlcb\n1,5\n' "$@" --method swing
refuses 3 "rows.csv:2:2: found '', expected as many cells" 'dcp,dlcb\n1\n' "$@" --method lackenby
refuses 3 "rows.csv:1:1: found 'weight2', expected a name that average takes: weight$" 'weight2\n1\n' "$@" --method average --with "$hull"
refuses 3 "found 'dlcd', expected a name that lackenby takes: dcp, dlcb, dp-fore, dp-aft$" 'dlcd\n1\n' "$@" \
	--method lackenby
refuses 3 "found 'lattices', expected a name that free-form takes: lattice$" 'lattices\nx\n' "$@" \
	--method free-form
refuses 3 'zero byte' 'dlcb\n1\n\000' "$@" --method swing
refuses 6 'none.csv' '' "$hull" --method swing --rows none.csv --out x.csv
refuses 6 'none.json' 'lattice\nnone.json\n' "$@" --method free-form
refuses 6 'none/x.csv' 'dlcb\n1\n' "$hull" --method swing --rows rows.csv --out none/x.csv
refuses 2 'csv or .json was expected' 'dlcb\n1\n' "$hull" --method swing --rows rows.csv --out x.db
refuses 2 "--drafts: found '0'" 'dlcb\n1\n' "$@" --method swing --drafts 0
refuses 2 'draft 9 m' 'dlcb\n1\n' "$@" --method swing --drafts 9
refuses 2 '--drafts: of --rows only' '' "$hull" --method swing --out x.csv --drafts 1
refuses 2 '--hulls: of --rows only' '' "$hull" --method swing --out x.csv --hulls x
refuses 2 '--device: of --rows only' '' "$hull" --method swing --out x.csv --device reference
refuses 70 'the limit is 1024' 'dlcb\n1\n' "$@" --method swing --max-memory 1K
finish
