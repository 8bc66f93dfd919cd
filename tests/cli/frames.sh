#!/bin/sh
# The same hull in other units and frames: the same measures, the same fairing, and files out in
# the unit and frame they came in.
. "$(dirname "$0")/lib.sh"
without_pictures
hull=$hulls/npl_parent.csv

# in_frame UNIT UNITS-PER-METRE FRAME FILE: a file in metres and ap-fwd, put otherwise. All
# coordinates ascend in a file, so that x aft turns the rows around.
in_frame()
{
	awk -F, -v unit="$1" -v scale="$2" -v frame="$3" '
		function number(v) { return sprintf("%.15g", v * scale) }
		function length_of(line) { sub(/^[^:]*: /, "", line); return line + 0 }
		function x_of(x)
		{
			if (frame == "fp-aft") return lbp - x
			if (frame == "ghs") return lbp / 2 - x
			return frame == "ap-fwd" ? x : x - lbp / 2
		}
		/^# unit:/ { print "# unit: " unit; next }
		/^# frame:/ { print "# frame: " frame; next }
		/^# lbp:/ { lbp = length_of($0); print "# lbp: " number(lbp); next }
		/^# draft:/ { draft = length_of($0); print "# draft: " number(draft); next }
		/^#/ { print; next }
		{
			heading = /^z/
			line = heading ? $1 : number(frame == "waterline" ? $1 - draft : $1)
			for (i = 2; i <= NF; i++) {
				v = frame == "fp-aft" || frame == "ghs" ? $(NF + 2 - i) : $i
				line = line "," (heading ? number(x_of(v)) : v == "" ? v : number(v))
			}
			print line
		}' "$4"
}

expect 0 measure "$hull" --json
cp "$out" metres.json
expect 0 fair "$hull" --out metres
for case in mm:1000:ap-fwd ft:3.280839895013123:mid-fwd mm:1000:fp-aft m:1:ghs m:1:waterline; do
	unit=${case%%:*}
	frame=${case##*:}
	scale=${case#*:}
	scale=${scale%:*}
	in_frame "$unit" "$scale" "$frame" "$hull" >hull.csv
	expect 0 measure hull.csv --json
	for name in lbp_m draft_m half_beam_m volume_m3 wetted_surface_m2 cp lcb_pct_lbp_fwd xcf_from_ap_m \
		kb_m fn_per_m2 energy_bending noise_m; do
		holds "$unit $frame: $name" '(a - b)^2 <= (1e-10 * a)^2' a="$(member metres.json $name)" \
			b="$(member "$out" $name)"
	done
	expect 0 fair hull.csv --out faired
	same_form hull.csv faired/faired.csv
	[ "$(member faired/report.json hull unit_of_file)" = "$unit" ] || fail "$unit is not in the report"
	[ "$(member faired/report.json hull frame_of_file)" = "$frame" ] ||
		fail "$frame is not in the report"
	[ "$(grep -c '"old_m"' faired/report.json)" -eq 1 ] || fail "$unit $frame: not one offset replaced"
	# The search takes its steps from other last bits: to its last step, 2e-7 of the half-beam.
	in_frame "$unit" "$scale" "$frame" metres/faired.csv >expected.csv
	change expected.csv faired/faired.csv >.change
	read -r most rms count <.change
	holds "$unit $frame: faired" 'most <= 1e-6 * h && count == 275' most="$most" count="$count" \
		h="$(half_beam hull.csv)"
done

# Places in options are in the unit and frame of the file.
in_frame mm 1000 fp-aft "$hull" >hull.csv
expect 0 fair hull.csv --lock station:1524,point:1270@200 --out locked
for place in 1524:150 1524:220 1270:200; do
	x=${place%:*}
	z=${place#*:}
	holds "locked $place" 'a == b' a="$(cell hull.csv $x $z)" b="$(cell locked/faired.csv $x $z)"
done
holds 'not locked' 'a != b' a="$(cell hull.csv 1270 180)" b="$(cell locked/faired.csv 1270 180)"
expect 2 fair hull.csv --lock station:1.524 --out refused
# Bounds may come in another unit and frame than the hull.
expect 0 fair hull.csv --no-smooth --upper "$hull" --out bounded
change hull.csv bounded/faired.csv >.change
read -r most rms count <.change
holds 'bounded' 'most > 0.1' most="$most"
table_of hull.csv >.first
table_of bounded/faired.csv >.second
paste -d, .first .second | awk -F, 'NR > 1 { for (i = 2; i <= NF / 2; i++)
	if ($(NF / 2 + i) > $i + 1e-9) print $1, $i, $(NF / 2 + i) }' >above
[ -s above ] && fail "above its bound: $(head -n 1 above)"
finish
