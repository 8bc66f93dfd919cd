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
equals 'more closeness, less fairness' "$(ask front.db "SELECT count(*) FROM measures a JOIN measures b
	ON b.id = a.id + 1 WHERE b.closeness_m4 > a.closeness_m4 * (1 + 1e-6)")" 0
equals 'hulls of four parameters' "$(ask affine.db 'SELECT count(*) FROM pragma_table_info("parameters")')" 5

commands "$source/host/sweep/README.md" | grep '^sqlite3' >queries.sh
equals 'queries' "$(wc -l <queries.sh | tr -d ' ')" 5
while read -r query; do
	sh -ec "$query" >answer 2>&1 || fail "does not run as printed: $query"
	[ -s answer ] || fail "has no answer: $query"
done <queries.sh
finish
