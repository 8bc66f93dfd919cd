#!/bin/sh
# batten vary: the variant it writes, what it reports, what it refuses.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/bsra_trawler.csv
mkdir place
cd place || exit 1

expect 0 vary --help
prints '^usage: batten vary'
prints '^example:'
for option in method out dcp dcb dlcb dcwp dlcf dp-fore dp-aft lcb-used lcf-used with weight lbd \
	targets middle move preset amount lattice solve by first-pass thesis threads max-memory json quiet; do
	prints "^  --$option"
done
expect 0 --help
prints 'vary .*'

# Asked, got and what else changed; the file says what the report says.
expect 0 vary "$hull" --method lackenby --dcp 5 --dlcb 2 --out fuller.csv --json
cp "$out" report.json
expect_json report.json
expect 0 measure fuller.csv --json
cp "$out" measures.json
for name in cp lcb_pct_lbp_fwd volume_m3 cwp; do
	holds "$name of the file" 'a - b < 1e-9 && b - a < 1e-9' \
		a="$(member report.json variant $name)" b="$(member measures.json $name)"
done
holds 'C_P' 'b / a - 1.05 < 1e-8 && b / a - 1.05 > -1e-8' \
	a="$(member report.json parent cp)" b="$(member measures.json cp)"
holds 'LCB' 'b - a - 2 < 1e-8 && b - a - 2 > -1e-8' \
	a="$(member report.json parent lcb_pct_lbp_fwd)" b="$(member measures.json lcb_pct_lbp_fwd)"
grep -q '^# source: .*; varied by batten' fuller.csv || fail 'the source does not say so'
expect 0 vary "$hull" --method lackenby --dcp 5 --dlcb 2 --out again.csv
prints '^ *parent  *asked  *got  *changed$'
prints '^cp '
prints '^parameters: '
cmp -s fuller.csv again.csv || fail 'two calls wrote different files'

# Every method; nothing asked gives the parent.
expect 0 vary "$hull" --method swing --dlcb 0 --out same.csv
same_form "$hull" same.csv
set -- $(change "$hull" same.csv)
holds 'nothing asked' 'd < 1e-12 && n > 100' d="$1" n="$3"
expect 0 vary "$hull" --method swing --dlcb -2 --thesis --first-pass --out swing.csv
expect 0 vary "$hull" --method one-minus-prismatic --dcp 5 --dlcb -2 --out one.csv
expect 0 vary "$hull" --method moor --dcb 5 --dlcb 1 --dcwp 5 --dlcf 1 --out moor.csv
expect 0 vary "$hull" --method average --with fuller.csv,swing.csv --weight 0.5,-0.1 --out mean.csv
expect 0 vary "$hull" --method affine --lbd 1.2,0.9,1.1 --out affine.csv
expect 0 vary "$hull" --method stretch --move 0:0,0.5:0.55,1:1 --out stretch.csv
expect 0 vary "$hull" --method three-body --middle 12.192,18.288 --targets volume_m3=260,cp=0.6 \
	--out three.csv
expect 0 measure three.csv --json
holds 'volume of three bodies' 'v > 259.999999 && v < 260.000001' v="$(member "$out" volume_m3)"
for preset in bilge-radius rise-of-floor u-ness v-ness flare; do
	expect 0 vary "$hull" --method nonlinear --preset $preset --amount 0.05 --out $preset.csv
done
expect 0 vary "$hull" --method free-form --lattice "$DATA/lattices/trawler_shoulder.json" --out ffd.csv
expect_json "$DATA/lattices/trawler_shoulder.json"
holds 'fuller by the lattice' 'b > a + 0.5' a="$(expect 0 measure "$hull" --json; member "$out" volume_m3)" \
	b="$(expect 0 measure ffd.csv --json; member "$out" volume_m3)"

# Form-parameter design: targets met by parameters of two methods.
expect 0 vary "$hull" --solve volume_m3=255,lcb_pct_lbp_fwd=-1,cb=0.53 \
	--by lackenby.dcp,lackenby.dlcb=-5:5,affine.y --out solved.csv
prints '^BSRA trawler, solve: '
prints '^parameters: lackenby.dcp '
expect 0 measure solved.csv --json
cp "$out" measures.json
holds 'volume solved' 'v > 254.99999 && v < 255.00001' v="$(member measures.json volume_m3)"
holds 'LCB solved' 'v > -1.00001 && v < -0.99999' v="$(member measures.json lcb_pct_lbp_fwd)"
holds 'C_B solved' 'v > 0.52999 && v < 0.53001' v="$(member measures.json cb)"

# A fraction where percent is meant is a warning, silent with --quiet.
expect 0 vary "$hull" --method swing --dlcb 0.02 --out small.csv
says 'is percent what is meant?'
expect 0 vary "$hull" --method one-minus-prismatic --dcp 31 --out large.csv
says 'dcp is 31 percent: is percent what is meant?'
expect 0 vary "$hull" --method swing --dlcb 0.02 --out small.csv --quiet
[ -s "$talk" ] && fail '--quiet talks'

# Parents that are none: no full section, an open one, one that crosses itself.
parent()
{
	name=$1
	layout=$2
	shift 2
	{
		printf '# %s\n' 'batten-offsets: 1' "name: $name" 'unit: m' 'frame: ap-fwd' 'lbp: 10' 'draft: 2' \
			"layout: $layout"
		printf '%s\n' "$@"
	} >"$name.csv"
}
parent hollow grid 'z\x,0,2.5,5,7.5,10' '0,0,0,0,0,0' '1,0,1,0,1,0' '2,0,1,0,1,0'
parent open grid 'z\x,0,2.5,5,7.5,10' '0,0,0,0,0,0' '1,0,1,,1,0' '2,0,1,1,1,0'
parent crossing long 'station,x,z,y' '0,0,0,0' '0,0,1,1' '0,0,0.5,2' '1,10,0,0' '1,10,2,1'

# refuses CODE PATTERN ARGUMENT...: one line that has this in it, and no file.
before=$(state_of .)
refuses()
{
	code_expected=$1
	pattern=$2
	shift 2
	expect "$code_expected" vary "$@"
	one_line
	says "$pattern"
}
refuses 3 'a full section amidships is expected' hollow.csv --method swing --dlcb 1 --out x.csv
refuses 3 'its section at x = 5 m is open, without a half-breadth at z = 1 m' open.csv --method swing \
	--dlcb 1 --out x.csv
refuses 3 "crossing.csv:11:5: found '0.5', expected z in ascending order" crossing.csv --method swing \
	--dlcb 1 --out x.csv
refuses 2 'an offsets file was expected' --method swing --out x.csv
refuses 2 '--method was expected' "$hull" --out x.csv
refuses 2 "--method: found 'swung'" "$hull" --method swung --out x.csv
refuses 2 '--out FILE.csv was expected' "$hull" --method swing --dlcb 1
refuses 2 '--dcp: method swing takes no such option' "$hull" --method swing --dcp 1 --out x.csv
refuses 2 "--lbd: found '1,2'" "$hull" --method affine --lbd 1,2 --out x.csv
refuses 2 "--lbd: found ''" "$hull" --method affine --out x.csv
refuses 2 'scale_y is -1' "$hull" --method affine --lbd 1,-1,1 --out x.csv
refuses 2 'average expects --with' "$hull" --method average --weight 1 --out x.csv
refuses 2 'expected 1 number' "$hull" --method average --with fuller.csv --weight 1,2 --out x.csv
for list in cb=1 cp= cp=x cp=0.6,cp=0.6 cp=0.6, 'cp=0.6 '; do
	refuses 2 "--targets: found '$list'" "$hull" --method three-body --targets "$list" --out x.csv
done
refuses 2 "--middle: found '12'" "$hull" --method three-body --middle 12 --out x.csv
for list in 0 0:0 0:0,1 0:0,1:1, 0-0,1:1; do
	refuses 2 "--move: found '$list'" "$hull" --method stretch --move "$list" --out x.csv
done
refuses 2 'would fold' "$hull" --method stretch --move 0:0,0.5:1.1,1:1 --out x.csv
refuses 2 "--preset: found 'u'" "$hull" --method nonlinear --preset u --amount 1 --out x.csv
refuses 2 "--amount was expected" "$hull" --method nonlinear --preset u-ness --out x.csv
refuses 2 "--lattice FILE was expected" "$hull" --method free-form --out x.csv
refuses 2 '--lattice: method swing takes no such option' "$hull" --method swing --lattice x --out x.csv
refuses 2 'were expected, without --method' "$hull" --method swing --solve cb=1 --by affine.y --out x.csv
refuses 2 'were expected, without --method' "$hull" --solve cb=1 --out x.csv
refuses 2 '--out FILE.csv was expected' "$hull" --solve cb=1 --by affine.y
for list in '' cb cb= cb=1, cb=x; do
	refuses 2 "--solve: found '$list'" "$hull" --solve "$list" --by affine.y --out x.csv
done
for list in '' affine.x,affine.y affine.x=1 affine.x=1:; do
	refuses 2 "--by: found '$list'" "$hull" --solve cb=1 --by "$list" --out x.csv
done
refuses 2 "parameter 'affine.w'" "$hull" --solve cb=1 --by affine.w --out x.csv
refuses 2 "target 'cd'" "$hull" --solve cd=1 --by affine.y --out x.csv
refuses 3 'no solution found within the ranges; nearest comes' "$hull" --solve cb=0.95 \
	--by nonlinear.u-ness --quiet --out x.csv
refuses 3 'would fold the hull' "$hull" --method nonlinear --preset u-ness --amount 0.2 --out x.csv
refuses 6 'none.json' "$hull" --method free-form --lattice none.json --out x.csv
refuses 3 'out of reach.*cp 0.4188 to 0.7575' "$hull" --method lackenby --dcp 50 --quiet --out x.csv
refuses 3 'told where its middle body is' "$hull" --method three-body --out x.csv
refuses 6 'none.csv' none.csv --method swing --out x.csv
refuses 6 'none.csv' "$hull" --method average --with none.csv --weight 1 --out x.csv
refuses 6 'none/x.csv' "$hull" --method swing --out none/x.csv
refuses 70 '1024' "$hull" --method swing --out x.csv --max-memory 1K
[ "$(state_of .)" = "$before" ] || fail 'a refused call wrote something'
finish
