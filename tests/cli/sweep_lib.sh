# What the tests of sweeps share beside lib.sh, which they source first.

# plan NAME COUNT LINE...: a plan over the trawler with so many designs, and what the lines add.
plan()
{
	_name=$1
	_count=$2
	shift 2
	{
		cat <<END
{
 "batten_plan": 1,
 "name": "test",
 "parent": { "hull": "$hulls/bsra_trawler.csv" },
 "parameters": { "dcp": { "from": -4, "to": 4 }, "dlcb": { "from": -1.5, "to": 1.5 } },
 "sampling": { "method": "sobol", "count": $_count, "seed": 1 },
 "vary": { "method": "lackenby", "dcp_pct": "dcp", "dlcb_pct": "dlcb" }
END
		for _line in "$@"; do
			printf ' , %s\n' "$_line"
		done
		echo '}'
	} >"$_name"
}

faired='"fair": { "w2_over_w1": 1000 }'
kept='"keep": { "offsets": { "best": 7, "measure": "energy_bending", "goal": "min" } }'
judged='"objectives": [ { "measure": "energy_bending", "goal": "min" },
	{ "measure": "volume_m3", "goal": "max" } ], "measure": { "drafts_m": [1.5, 2.0, 2.5] },
	"reject": [ { "measure": "cp", "at_most": 0.6 }, { "name": "roll", "expression": "2.846 - kmt_m" } ]'

# rows DB: every row of every table but runs, whole numbers as they are.
rows()
{
	sqlite3 "$1" ".mode quote" "SELECT * FROM meta ORDER BY key" "SELECT * FROM designs ORDER BY id" \
		"SELECT * FROM parameters ORDER BY id" "SELECT * FROM measures ORDER BY id" \
		"SELECT * FROM hydrostatics ORDER BY id, draft_m" "SELECT * FROM geometry ORDER BY id"
}

# same_rows A B: both databases hold the same.
same_rows()
{
	rows "$1" >.rows_a || fail "$1 cannot be read"
	rows "$2" >.rows_b || fail "$2 cannot be read"
	[ -s .rows_a ] || fail "$1 has no rows"
	cmp -s .rows_a .rows_b || fail "$1 and $2 differ: $(diff .rows_a .rows_b | cut -c1-200 | head -n 4)"
}

# ask DB SQL: one value.
ask()
{
	sqlite3 "$1" "$2"
}

# begun LOG: how many designs a sweep had begun by the last line of its log.
begun()
{
	sed -n 's/.*"begun":\([0-9]*\),.*/\1/p' "$1" | tail -n 1
}

# equals WHAT FOUND EXPECTED
equals()
{
	[ "$2" = "$3" ] || fail "$1: found '$2', expected '$3'"
}
