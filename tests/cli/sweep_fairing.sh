# batten sweep: the ways to fair, and settings of them that are swept. One design of each is the hull that
# `batten fair` makes of the same variant.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/sweep_lib.sh"
without_pictures

# fairing NAME SETTINGS PARAMETERS: a plan that varies nothing but how $parent, the trawler, is faired.
fairing()
{
	printf '{ "batten_plan": 1, "name": "test", "parent": { "hull": "%s" },
	"parameters": { %s }, "sampling": { "method": "grid" }, "fair": { %s },
	"keep": { "offsets": "all" } }\n' "$parent" "$3" "$2" >"$1"
}
parent=$hulls/bsra_trawler.csv
smooth=--no-smooth
levels='{ "from": 1, "to": 100, "steps": 2, "scale": "log" }'

# like COMMAND_OPTIONS: design $id of way.db is what the command makes.
like()
{
	expect 0 export way.db --id "$id" --out design.csv
	rm -rf alone
	# shellcheck disable=SC2086
	"$BATTEN" fair "$parent" --device reference $smooth $1 --out alone >"$out" 2>"$talk" ||
		[ $? = 1 ] || fail "batten fair $1"
	grep -v '^#' design.csv >design.rows
	grep -v '^#' alone/faired.csv >alone.rows
	cmp -s design.rows alone.rows || fail "design $id of $way is not what batten fair $1 makes"
}

way='w2/w1 swept'
fairing way.json '"w2_over_w1": "w", "locks": [ { "waterline_m": 1.5085 } ]' "\"w\": $levels"
expect 0 sweep way.json --out way.db
id=1
like '--w1 1 --w2 100 --lock waterline:1.5085'
equals "$way" "$(ask way.db 'SELECT group_concat(w2_over_w1) FROM measures')" 1.0,100.0

way='a swept step'
rm way.db
fairing way.json '"w2_over_w1": 10, "first_step": "s", "longitudinal": 4' '"s": { "values": [0.01, 0.04] }'
expect 0 sweep way.json --out way.db
expect 0 sweep way.json --out other.db --block 1
same_rows way.db other.db
id=1
equals "$way" "$(ask way.db 'SELECT count(*) FROM designs WHERE status = '"'done'")" 2

way='weights by the noise'
rm way.db
fairing way.json '"w2_over_w1": "auto", "max_distance_part": "d"' '"d": { "values": [0.01, 0.02] }'
expect 0 sweep way.json --out way.db
id=0
like '--max-distance 1%'
equals "$way" "$(ask way.db 'SELECT count(*) FROM measures WHERE w2_over_w1 > 0')" 2

way='a net'
rm way.db
fairing way.json '"variables": "net", "w2_over_w1": "w"' "\"w\": $levels"
expect 0 sweep way.json --out way.db
id=1
like '--variables net --w1 1 --w2 100'

way='forward approximation'
rm way.db
fairing way.json '"method": "forward-approximation", "order": "o", "iterations": 2' '"o": { "values": [3, 4] }'
expect 0 sweep way.json --out way.db
id=1
like '--method forward-approximation --order 4 --iterations 2'
equals 'no weight' "$(ask way.db 'SELECT count(*) FROM measures WHERE w2_over_w1 IS NULL AND search_iterations = 2')" 2

way='forward fit'
rm way.db
fairing way.json '"method": "forward-fit", "order": "o", "iterations": 1' '"o": { "values": [3, 4] }'
expect 0 sweep way.json --out way.db
id=1
like '--method forward-fit --order 4 --iterations 1'

way='inverse'
rm way.db
fairing way.json '"method": "inverse", "order": 3, "iterations": "n"' '"n": { "values": [1, 2] }'
expect 0 sweep way.json --out way.db
id=1
like '--method inverse --order 3 --iterations 2'

way='smoothed, then searched'
rm way.db
# One offset is wrong, by a tenth: smoothing finds it.
awk -F, -v OFS=, '/^[0-9]/ && ++row == 6 { $7 *= 1.1 } { print }' "$hulls/wigley.csv" >wrong.csv
parent=wrong.csv
fairing way.json '"smooth": true, "w2_over_w1": "w"' "\"w\": $levels"
expect 0 sweep way.json --out way.db
id=0
smooth=
like '--w1 1 --w2 1'
grep -q '"replaced": \[\]' alone/report.json && fail "nothing was smoothed"

# What does not go together is refused, and nothing made.
refuse()
{
	fairing bad.json "$1" "\"w\": $levels"
	expect 3 sweep bad.json --out no.db
	one_line
	says "$2"
	[ -e no.db ] && fail "bad.json made a database: $1"
}
refuse '"method": "inverse", "w2_over_w1": "w"' 'bad.json: \$.fair.w2_over_w1: unknown key, expected method, smooth, '
refuse '"w2_over_w1": "w", "fairness": "mvc", "longitudinal": 2' 'bad.json: \$.fair.fairness: found "mvc", expected bending, mean or gauss'
refuse '"w2_over_w1": "w", "fairness": "mean", "search": "block"' 'bad.json: \$.fair.search: .*plain bending'
refuse '"w2_over_w1": "w", "first_step": 0.001, "last_step": 0.01' 'bad.json: \$.fair.last_step: .*below first_step'
refuse '"w2_over_w1": "w", "locks": [ { "deck": 1 } ]' 'bad.json: \$.fair.locks\[0\].deck: unknown key'
refuse '"method": "inverse", "order": "w"' 'bad.json: \$.fair.order: .*a parameter within 2 to 8'
finish
