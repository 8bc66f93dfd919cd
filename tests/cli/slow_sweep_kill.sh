# SIGKILL at any moment, then --resume, until the sweep ends: the same rows as without, and no more than a
# block of designs begun in vain. KILLS says how many times, 5 without it.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/sweep_lib.sh"

plan a.json 150 "$faired" "$kept" "$judged"
expect 0 sweep a.json --out a.db
seconds=$(ask a.db 'SELECT max(seconds) FROM runs')

# Moments from 0 to the time of a whole run, by a generator that is the same every time.
moment=12345
kills=0
most=0
journal=wal
while [ "$kills" -lt "${KILLS:-5}" ]; do
	rm -f k.db k.db-*
	[ "$journal" = wal ] && journal=rollback || journal=wal
	while [ "$kills" -lt "${KILLS:-5}" ]; do
		moment=$(((moment * 1103515245 + 12345) % 2147483648))
		rm -f k.log
		"$BATTEN" sweep a.json --out k.db --block 6 --journal $journal --resume --log k.log \
			>"$out" 2>"$talk" &
		pid=$!
		sleep "$(awk "BEGIN { print $seconds * $moment / 2147483648 }")"
		kill -s KILL $pid 2>/dev/null || break
		wait $pid 2>/dev/null
		kills=$((kills + 1))
		[ -s k.log ] || continue
		# What was begun is told before it is; the database says what of it is there.
		stored=$(ask k.db 'SELECT count(*) FROM designs')
		lost=$(($(begun k.log) - stored))
		[ $lost -ge 0 ] && [ $lost -le 6 ] || fail "a kill lost $lost designs, at most a block of 6 was expected"
		most=$((lost > most ? lost : most))
	done
	wait
	expect 0 sweep a.json --out k.db --block 6 --journal $journal --resume
	same_rows a.db k.db
done
echo "begun in vain: at most $most designs of a block of 6"
finish
