# SIGKILL at any moment, then --resume, until the sweep ends: the same rows as without. KILLS says how
# many times, 5 without it.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/sweep_lib.sh"

plan a.json 150 "$faired" "$kept" "$judged"
expect 0 sweep a.json --out a.db
seconds=$(ask a.db 'SELECT max(seconds) FROM runs')

# Moments from 0 to the time of a whole run, by a generator that is the same every time.
moment=12345
kills=0
journal=wal
while [ "$kills" -lt "${KILLS:-5}" ]; do
	rm -f k.db k.db-*
	[ "$journal" = wal ] && journal=rollback || journal=wal
	while [ "$kills" -lt "${KILLS:-5}" ]; do
		moment=$(((moment * 1103515245 + 12345) % 2147483648))
		"$BATTEN" sweep a.json --out k.db --block 6 --journal $journal --resume >"$out" 2>"$talk" &
		pid=$!
		sleep "$(awk "BEGIN { print $seconds * $moment / 2147483648 }")"
		kill -s KILL $pid 2>/dev/null || break
		wait $pid 2>/dev/null
		kills=$((kills + 1))
	done
	wait
	expect 0 sweep a.json --out k.db --block 6 --journal $journal --resume
	same_rows a.db k.db
done
finish
