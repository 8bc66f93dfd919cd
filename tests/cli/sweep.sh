# batten sweep: every design a row, the same whatever the block, the threads and the device; going on
# where it was stopped; what is refused, and that a refusal makes nothing.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/sweep_lib.sh"

# ---- rows ----
plan a.json 40 "$faired" "$kept" "$judged"
expect 0 sweep a.json --out a.db --log a.log
prints '^a.db: 40 designs: '
equals designs "$(ask a.db 'SELECT count(*), min(id), max(id) FROM designs')" '40|0|39'
equals parameters "$(ask a.db 'SELECT count(*) FROM parameters')" 40
equals complete "$(ask a.db "SELECT value FROM meta WHERE key = 'complete'")" 1
equals 'kept offsets' "$(ask a.db 'SELECT count(*) FROM geometry')" 7
equals 'the best are kept' "$(ask a.db "SELECT count(*) FROM geometry JOIN measures USING (id) WHERE
	energy_bending > (SELECT energy_bending FROM measures JOIN designs USING (id)
	WHERE status = 'done' ORDER BY 1 LIMIT 1 OFFSET 6)")" 0
equals 'drafts' "$(ask a.db 'SELECT count(*) FROM hydrostatics')" "$(ask a.db 'SELECT 3 * count(*) FROM measures')"
equals 'rejected is what breaks a constraint' "$(ask a.db "SELECT count(*) FROM designs JOIN measures
	USING (id) WHERE (status = 'rejected') <> (cp > 0.6 OR kmt_m < 2.846)")" 0
[ "$(ask a.db "SELECT count(*) FROM designs WHERE status = 'rejected' AND reason LIKE 'cp is %'")" -gt 0 ] ||
	fail 'no design was rejected for its cp'
equals 'the front, by every pair' "$(ask a.db "SELECT count(*) FROM designs d JOIN measures m USING (id)
	WHERE d.status = 'done' AND d.pareto <> NOT EXISTS (SELECT 1 FROM designs e JOIN measures n
	USING (id) WHERE e.status = 'done' AND n.energy_bending <= m.energy_bending AND
	n.volume_m3 >= m.volume_m3 AND (n.energy_bending < m.energy_bending OR n.volume_m3 > m.volume_m3))")" 0
equals 'cp as asked for' "$(ask a.db "SELECT count(*) FROM measures JOIN parameters USING (id) WHERE
	abs(cp / (SELECT cp / (1 + dcp / 100) FROM measures JOIN parameters USING (id) WHERE id = 0) -
	(1 + dcp / 100)) > 2e-3")" 0
equals 'blobs' "$(ask a.db 'SELECT count(*) FROM geometry WHERE length(y_m) <> 8 * length(nodes) OR
	length(varied_y_m) <> length(y_m) OR x_m IS NOT NULL')" 0
equals 'log lines' "$(grep -c '^{.*"stored":40' a.log)" 1

expect 0 export a.db --id 7 --out seven.csv
grep -q '^# source: .*; varied by batten ' seven.csv || fail 'an exported variant does not say that it is one'

# ---- the same rows ----
expect 0 sweep a.json --out b.db --block 7 --threads 1 --journal rollback
same_rows a.db b.db
[ "$(ls b.db*)" = b.db ] || fail "files beside the database: $(ls b.db*)"
expect 0 sweep a.json --out c.db --block 5 --device reference --quiet
same_rows a.db c.db

# ---- going on ----
expect 2 sweep a.json --out a.db
says 'a.db: is there already.*--resume'
one_line
before=$(cksum <b.db)
expect 0 sweep a.json --out b.db --resume
same_rows a.db b.db
equals runs "$(ask b.db 'SELECT count(*) FROM runs')" 2
# Cut short after two blocks: a finished database without its last designs is what a killed run leaves.
cp a.db cut.db
ask cut.db "DELETE FROM designs WHERE id >= 15; DELETE FROM parameters WHERE id >= 15;
	DELETE FROM measures WHERE id >= 15; DELETE FROM hydrostatics WHERE id >= 15;
	DELETE FROM geometry; UPDATE designs SET pareto = 0 WHERE pareto = 1;
	UPDATE meta SET value = 0 WHERE key = 'complete'"
plan all.json 40 "$faired" '"keep": { "offsets": "all" }' "$judged"
expect 3 sweep all.json --out cut.db --resume
says 'cut.db: belongs to another plan'
plan none.json 40 "$faired" "$judged"
expect 0 sweep none.json --out none.db
cp none.db cut.db
ask cut.db "DELETE FROM designs WHERE id >= 15; DELETE FROM parameters WHERE id >= 15;
	DELETE FROM measures WHERE id >= 15; DELETE FROM hydrostatics WHERE id >= 15;
	UPDATE designs SET pareto = 0 WHERE pareto = 1; UPDATE meta SET value = 0 WHERE key = 'complete'"
expect 0 sweep none.json --out cut.db --resume --block 4
same_rows none.db cut.db

# ---- databases of something else ----
expect 3 sweep a.json --out a.db --resume --shard 1/2
says 'a.db: belongs to another shard\|a.db: belongs to another number of shards'
cp a.db old.db
ask old.db 'PRAGMA user_version = 0'
expect 3 sweep a.json --out old.db --resume
says 'old.db: found a database of schema version 0, expected version 1'
echo 'no database, whatever it is, but long enough to be looked at' >text.db
cp text.db text.before
expect 3 sweep a.json --out text.db --resume
says 'text.db: is no SQLite database'
cmp -s text.db text.before || fail 'what was no database was changed'
ask other.db 'CREATE TABLE t (a)'
expect 3 sweep a.json --out other.db --resume
says 'other.db: is no database of a sweep'
expect 6 sweep a.json --out missing/a.db
says 'missing/a.db: cannot be made: No such file'
mkdir folder.db
expect 6 sweep a.json --out folder.db --resume
says 'folder.db: is no plain file'
expect 6 sweep missing.json --out m.db
[ -e m.db ] && fail 'a plan that is not there made a database'

# A reader that holds the file keeps a second writer out.
mkfifo hold
sqlite3 a.db <hold >held 2>&1 &
exec 3>hold
echo "BEGIN EXCLUSIVE; SELECT 'held';" >&3
while ! grep -q held held; do sleep 0.01; done
expect 6 sweep a.json --out a.db --resume
says 'a.db: is in use by another program'
exec 3>&-
wait
same_rows a.db c.db

# A file that may grow no further is a disk that is full: earlier rows stay, and it goes on.
plan big.json 160 '"keep": { "offsets": "all" }'
for journal in rollback wal; do
	rm -f big.db
	(ulimit -f 700 && "$BATTEN" sweep big.json --out big.db --block 10 --journal $journal >"$out" 2>"$talk")
	equals "exit code of a full disk, $journal" $? 6
	says 'big.db: .*\(disk\|I/O\)'
	stored=$(ask big.db 'SELECT count(*) FROM designs')
	[ "$stored" -gt 0 ] && [ "$stored" -lt 160 ] || fail "a full disk left $stored rows, some were expected"
	expect 0 sweep big.json --out big.db --resume
	equals 'all designs' "$(ask big.db 'SELECT count(*) FROM geometry')" 160
done

# A folder and a database that are not to be written, for one who may not write everything.
mkdir fixed
cp "$hulls/bsra_trawler.csv" .
sed "s,\"$hulls/,\"," none.json >fixed.json
expect 0 sweep fixed.json --out fixed/there.db
cp fixed/there.db there.db
cp "$BATTEN" fixed/batten
chmod 444 fixed/there.db
chmod 555 fixed fixed/batten
unprivileged()
{
	_program=./fixed/batten
	if [ "$(id -u)" = 0 ]; then
		chmod 755 .
		setpriv --reuid=65534 --regid=65534 --clear-groups "$_program" "$@"
	else
		"$_program" "$@"
	fi >"$out" 2>"$talk"
}
unprivileged sweep fixed.json --out fixed/new.db --device reference
equals 'exit code in a folder that is read-only' $? 6
says 'fixed/new.db: cannot be made: Permission denied'
one_line
[ -e fixed/new.db ] && fail 'a read-only folder got a database'
unprivileged sweep fixed.json --out fixed/there.db --resume --device reference
equals 'exit code of a database that is read-only' $? 6
says 'fixed/there.db: cannot be opened or written: .*read-only'
one_line
same_rows there.db fixed/there.db
chmod 755 fixed

# What a terminal sees.
script -qec "'$BATTEN' sweep a.json --out seen.db --block 9" seen >/dev/null </dev/null
grep -q '[1-9][0-9]* of 40 designs, [0-9.]*/s, [0-9]*:[0-5][0-9]:[0-5][0-9] left, 0 failed, [0-9]* rejected' seen ||
	fail "no line of progress on a terminal: $(tr '\r' '\n' <seen | tail -n 3)"
grep -q '40 of 40 designs' seen || fail 'the progress on a terminal does not end'
same_rows a.db seen.db

# ---- stopping ----
for name in TERM USR1; do
	rm -f stop.db stop.log
	plan stop.json 4000 "$faired"
	"$BATTEN" sweep stop.json --out stop.db --block 8 --log stop.log >stop.out 2>stop.talk &
	pid=$!
	while [ ! -s stop.log ] && kill -0 $pid 2>/dev/null; do sleep 0.02; done
	expect 6 sweep stop.json --out stop.db --resume
	says 'stop.db: is in use by another program'
	kill -s "$name" $pid
	wait $pid
	equals "exit code of SIG$name" $? 75
	cp stop.talk "$talk"
	says '^to go on: batten sweep .*--out stop.db .*stop.json.* --resume$'
	equals 'what was under way is stored' "$(ask stop.db 'SELECT count(*) FROM designs')" "$(begun stop.log)"
	[ "$(begun stop.log)" -lt 4000 ] || fail "SIG$name ended nothing"
	equals 'how it ended' "$(ask stop.db 'SELECT exit FROM runs')" interrupted
done

# ---- refused, with the place and what was expected, and nothing made ----
refuse()
{
	rm -f no.db
	expect 3 sweep bad.json --out no.db
	one_line
	says "$1"
	[ -e no.db ] && fail "bad.json made a database: $1"
}
cp "$hulls/wigley.csv" bad.json
refuse "bad.json:1:1: .*; the JSON of a sweep's plan was expected"
plan bad.json 10 '"fairs": {}'
refuse 'bad.json: \$.fairs: unknown key, expected batten_plan, name, '
sed 's/"from": -4/"from": 5/' a.json >bad.json
refuse 'bad.json: \$.parameters.dcp.to: found 4, expected at least 5'
sed 's/"dcp_pct"/"scale_x"/' a.json >bad.json
refuse 'bad.json: \$.vary.scale_x: unknown key, expected method, dcp_pct, dlcb_pct, '
sed 's/"dcp_pct": "dcp"/"dcp_pct": 3/' a.json >bad.json
refuse 'bad.json: \$.parameters.dcp: .*expected a setting of \$.vary or \$.fair'
sed 's/"dcp_pct": "dcp"/"dcp_pct": "dcpp"/' a.json >bad.json
refuse 'bad.json: \$.vary.dcp_pct: found "dcpp", expected a number or the name of a parameter'
sed 's/"measure": "cp"/"measure": "cq"/' a.json >bad.json
refuse "bad.json: \\\$.reject\\[0\\].measure: found 'cq' at place 1 of it, expected the name of a measure"
sed 's/2.846 - kmt_m/2.846 - (kmt_m/' a.json >bad.json
refuse "bad.json: \\\$.reject\\[1\\].expression: found '' at place 15 of it, expected a closing bracket"
sed 's/"goal": "max"/"goal": "most"/' a.json >bad.json
refuse 'bad.json: \$.objectives\[1\].goal: found "most", expected min or max'
sed 's/"sobol"/"sobel"/' a.json >bad.json
refuse 'bad.json: \$.sampling.method: found "sobel", expected grid, latin-hypercube, sobol, random or rows'
sed 's/"w2_over_w1": 1000/"w2_over_w1": "dcp"/' a.json >bad.json
refuse 'bad.json: \$.fair.w2_over_w1: .*it goes from -4 to 4'
sed 's/"drafts_m": \[1.5, 2.0, 2.5\]/"drafts_m": [1.5, 2.6]/' a.json >bad.json
refuse 'bad.json: \$.measure.drafts_m\[1\]: found 2.6.*, expected a number from 0 to 2.515'
sed 's/"seed": 1/"seed": 1, "seed": 2/' a.json >bad.json
refuse 'bad.json:[0-9]*:[0-9]*: duplicate object key'
printf '{ "batten_plan": 1, ' >bad.json
refuse 'bad.json:1:[0-9]*: '
sed 's/"count": 40/"count": 1000000000000/; s/"sobol"/"random"/' a.json >bad.json
expect 2 sweep bad.json --out no.db
says 'the plan has 1000000000000 designs: .*--yes'
[ -e no.db ] && fail 'a sweep of 1e12 designs made a database'
expect 2 sweep a.json --out no.db --shard 3/2
expect 2 sweep a.json --out no.db --shard 0/2
expect 2 sweep a.json
[ -e no.db ] && fail 'a usage error made a database'

# ---- rows given one by one, and a grid ----
cat >rows.csv <<END
# two designs
dcp, dlcb
1.5, 0
-1, 0.25
END
sed 's/"parameters".*//; s/"sampling".*/"sampling": { "method": "rows", "file": "rows.csv" },/' a.json >rows.json
expect 0 sweep rows.json --out rows.db
equals 'rows of a file' "$(ask rows.db 'SELECT * FROM parameters ORDER BY id')" "0|1.5|0.0
1|-1.0|0.25"
printf 'dcp,dlcb\n1,2,3\n' >rows.csv
expect 3 sweep rows.json --out no.db
says "rows.csv:2:3: found '3', expected as many numbers"
printf 'dcp,dlcb\n1,two\n' >rows.csv
expect 3 sweep rows.json --out no.db
says "rows.csv:2:2: found 'two', expected a number"
sed 's/"to": 4 }/"to": 4, "step": 4 }/; s/"to": 1.5 }/"to": 1.5, "steps": 2 }/;
	s/"method": "sobol", "count": 40/"method": "grid"/' none.json >grid.json
expect 0 sweep grid.json --out grid.db
equals 'a grid' "$(ask grid.db "SELECT group_concat(dcp || ' ' || dlcb) FROM parameters")" \
	'-4.0 -1.5,-4.0 1.5,0.0 -1.5,0.0 1.5,4.0 -1.5,4.0 1.5'
finish
