# The example plans and the queries of host/sweep/README.md, as they are printed.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/sweep_lib.sh"
source=$DATA/..

# The program by the name that the texts give it, and the data beside it.
mkdir bin
ln -s "$BATTEN" bin/batten
ln -s "$DATA" data
PATH=$folder/bin:$PATH

# Lines of a text that are commands: four blanks, then a word of the list.
commands()
{
	sed -n 's/^    \(batten sweep .*\|sqlite3 .*\)$/\1/p' "$1"
}

commands "$source/data/examples/README.md" >examples.sh
equals 'examples' "$(wc -l <examples.sh | tr -d ' ')" 3
# 1: some designs failed, as their rows say (Lackenby's method does not reach every pair of targets).
while read -r example; do
	sh -c "$example" >ran 2>&1 || [ $? -eq 1 ] || { fail "does not run as printed: $example"; cat ran; }
done <examples.sh
equals 'trawler' "$(ask trawler.db "SELECT count(*), sum(status LIKE '%failed') FROM designs")" '1000|0'
equals 'front' "$(ask front.db "SELECT count(*), sum(status = 'done') FROM designs")" '200|200'
equals 'affine' "$(ask affine.db "SELECT count(*), sum(status LIKE '%failed') < 20 FROM designs")" '1000|1'
# Of exact minimisers a higher weight brings one closer. Ends within a part e of the least objective F may
# differ in closeness c (times k in F) by (w_b - w_a) k (c_b - c_a) <= 2 e F; the search's is 1e-9.
equals 'more closeness, less fairness' "$(ask front.db "WITH front AS (SELECT id, weight,
	closeness_m4 AS c, objective_end AS f, (objective_end - energy_bending) / weight / closeness_m4 AS k
	FROM measures JOIN parameters USING (id))
	SELECT count(*), sum((b.weight - a.weight) * a.k * (b.c - a.c) > 2e-9 * a.f)
	FROM front a JOIN front b ON b.id = a.id + 1")" '199|0'
equals 'hulls of four parameters' "$(ask affine.db 'SELECT count(*) FROM pragma_table_info("parameters")')" 5

commands "$source/host/sweep/README.md" | grep '^sqlite3' >queries.sh
equals 'queries' "$(wc -l <queries.sh | tr -d ' ')" 5
while read -r query; do
	sh -ec "$query" >answer 2>&1 || fail "does not run as printed: $query"
	[ -s answer ] || fail "has no answer: $query"
done <queries.sh
finish
