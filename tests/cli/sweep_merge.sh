# Shards put together, and single designs out of a database.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/sweep_lib.sh"

# ---- shards ----
plan a.json 25 "$faired" "$kept" "$judged"
expect 0 sweep a.json --out a.db
for part in 1 2 3; do
	expect 0 sweep a.json --out "part$part.db" --shard "$part/3" --block "$((part + 2))"
done
expect 0 merge whole.db part3.db part1.db part2.db
prints '^whole.db: 25 designs of 3 shards$'
same_rows a.db whole.db
equals runs "$(ask whole.db 'SELECT count(*) FROM runs')" 3
expect 0 merge whole.db part1.db part2.db part3.db --json
same_rows a.db whole.db

state=$(cksum <whole.db)
expect 3 merge whole.db part1.db part3.db
says 'part1.db: is shard 1 of 3, but 2 databases were given'
expect 3 merge whole.db part1.db part1.db part3.db
says 'part1.db and part1.db: both are shard 1 of 3'
cp part2.db torn.db
ask torn.db "UPDATE meta SET value = 0 WHERE key = 'complete'"
expect 3 merge whole.db part1.db torn.db part3.db
says 'torn.db: shard 2 is not complete'
cp part2.db torn.db
ask torn.db 'DELETE FROM designs WHERE id = 12'
expect 3 merge whole.db part1.db torn.db part3.db
says 'the shards have 24 designs, 25 were expected'
plan b.json 26 "$faired" "$kept" "$judged"
expect 0 sweep b.json --out other.db --shard 2/3
expect 3 merge whole.db part1.db other.db part3.db
says 'other.db: belongs to another plan'
expect 2 merge part1.db part1.db part2.db part3.db
says 'part1.db: is one of the shards'
expect 6 merge whole.db missing.db
expect 6 merge missing/whole.db part1.db part2.db part3.db
[ "$state" = "$(cksum <whole.db)" ] || fail 'a merge that failed changed what was there'
[ "$(find . -name '*.db.*' | wc -l)" -eq 0 ] || fail "a merge that failed left $(find . -name '*.db.*')"

# ---- single designs ----
kept_id=$(ask a.db 'SELECT min(id) FROM geometry')
dropped_id=$(ask a.db 'SELECT min(id) FROM designs WHERE id NOT IN (SELECT id FROM geometry)')
for id in $kept_id $dropped_id; do
	expect 0 export a.db --id "$id" --out design.csv
	expect 0 measure design.csv --json
	for name in volume_m3 cp lcb_pct_lbp_fwd energy_bending; do
		holds "$name of design $id" '(a - b) ^ 2 <= 1e-20 * b * b' a="$(member "$out" $name)" \
			b="$(sqlite3 a.db "SELECT printf('%!.17g', $name) FROM measures WHERE id = $id")"
	done
done
for ending in json igs step stl; do
	expect 0 export a.db --id "$kept_id" --out "design.$ending"
	prints 'the surface within '
done
holds 'the surface has the volume of its offsets' '(a - b) ^ 2 < 4e-4 * b * b' \
	a="$("$BATTEN" measure design.json --draft 2.5 --json >s.json && member s.json volume_m3)" \
	b="$(ask a.db "SELECT volume_m3 FROM hydrostatics WHERE id = $kept_id AND draft_m = 2.5")"
triangles=$(od -An -tu4 -j80 -N4 design.stl | tr -d ' ')
equals 'size of the triangles' "$(wc -c <design.stl | tr -d ' ')" $((84 + 50 * triangles))
[ "$triangles" -gt 1000 ] || fail "only $triangles triangles"
expect 2 export a.db --id 25 --out no.csv
says 'a.db: found design 25, expected 0 to 24'
expect 2 export a.db --id -1 --out no.csv
expect 2 export a.db --id 1 --out no.doc
expect 6 export missing.db --id 1 --out no.csv
sed 's/"from": -4/"from": -60/' a.json >steep.json
expect 1 sweep steep.json --out steep.db
says 'designs failed and'
failed=$(ask steep.db "SELECT min(id) FROM designs WHERE status = 'vary_failed'")
equals 'rows of the failed' "$(ask steep.db "SELECT count(*) FROM designs WHERE status = 'vary_failed' AND
	(reason = '' OR pareto IS NOT NULL OR id IN (SELECT id FROM measures))")" 0
expect 3 export steep.db --id "$failed" --out no.csv
says "steep.db: design $failed failed: "
[ -e no.csv ] && fail 'a refused export left a file'
finish
