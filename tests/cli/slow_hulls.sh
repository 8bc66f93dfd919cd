#!/bin/sh
# Every shipped hull, faired as anybody would, with all its files.
. "$(dirname "$0")/lib.sh"

# is_picture FILE: a PNG from its first bytes to its last, 1600 x 900.
is_picture()
{
	[ "$(head -c 24 "$1" | od -An -v -tx1 | tr -d ' \n')" = \
		89504e470d0a1a0a0000000d494844520000064000000384 ] || fail "$1 does not begin as a PNG"
	[ "$(tail -c 12 "$1" | od -An -v -tx1 | tr -d ' \n')" = 0000000049454e44ae426082 ] ||
		fail "$1 does not end as a PNG"
	[ "$(wc -c <"$1")" -gt 20000 ] || fail "$1: a picture of nothing"
}

# measures FILE [OBJECT]: name and text of every measure in a JSON file, one a line.
measures()
{
	awk -v object="${2:-}" '
		object != "" && $0 ~ "^  \"" object "\": " { inside = 1; next }
		object != "" && inside && /^  }/ { exit }
		object == "" || inside {
			sub(/,$/, "")
			gsub(/[": ]+/, " ")
			if ($1 !~ /^(cn_.*|closeness_m4|name|frame|quadrature|[{}])$/ && NF == 2) print $1, $2
		}' "$1"
}

for name in npl_parent bsra_trawler highspeed_craft wigley wigley_noisy; do
	hull=$hulls/$name.csv
	expect 0 fair "$hull" --out $name
	report=$name/report.json
	[ "$(ls -A $name | tr '\n' ' ')" = 'after.png before.png faired.csv lines.svg report.json ' ] ||
		fail "$name: $(ls -A $name | tr '\n' ' ')"
	is_picture $name/before.png
	is_picture $name/after.png
	[ $name = wigley ] || ! cmp -s $name/before.png $name/after.png ||
		fail "$name: the same picture twice"
	head -c 5 $name/lines.svg | grep -q '^<?xml' || fail "$name/lines.svg does not begin as one"
	[ "$(tail -n 1 $name/lines.svg)" = '</svg>' ] || fail "$name/lines.svg does not end as one"

	# The report.
	expect_json $report
	for key in batten command hull before smoothed after replaced lines method search pictures \
		warnings; do
		grep -q "^  \"$key\": " $report || fail "$name: no '$key' in the report"
	done
	for key in status iterations probes objective_before objective_after device strict precision \
		seconds; do
		[ -n "$(member $report search $key)" ] || fail "$name: no search.$key in the report"
	done
	[ "$(member $report hull name)" = "$(sed -n 's/^# name: //p' "$hull")" ] ||
		fail "$name: another name"
	[ "$(member $report hull layout)" = "$(sed -n 's/^# layout: //p' "$hull")" ] ||
		fail "$name: another layout"
	[ "$(member $report search status)" = 'converged by step' ] || fail "$name: not converged"
	[ "$(member $report pictures)" != null ] || fail "$name: no driver of pictures"
	for kind in station waterline; do
		[ "$(grep -c "\"kind\": \"$kind\"" $report)" = "$(member $report hull ${kind}s)" ] ||
			fail "$name: not every $kind is in the report"
	done
	holds "$name: distance and energy" 'cn <= 1 + 1e-12 && after <= smoothed && to < from' \
		cn="$(member $report after cn_search_pct)" after="$(member $report after energy_bending)" \
		smoothed="$(member $report smoothed energy_bending)" \
		from="$(member $report search objective_before)" to="$(member $report search objective_after)"
	case $name in npl_parent) wrong=1 ;; *) wrong=0 ;; esac
	[ "$(grep -c '"old_m"' $report)" -eq $wrong ] || fail "$name: not $wrong offsets replaced"

	# What was written is the hull of the report, on the table it came on.
	same_form "$hull" $name/faired.csv
	measures $report before >before
	measures $report after >after
	[ "$(grep -c '' after)" -ge 37 ] || fail "$name: $(grep -c '' after) measures"
	for pair in "before:$hull" "after:$name/faired.csv"; do
		expect 0 measure "${pair#*:}" --json
		# measure tells more of the hydrostatics than a report of fairing does.
		measures "$out" >all
		awk 'NR == FNR { known[$1]; next } $1 in known' "${pair%%:*}" all >measured
		cmp -s "${pair%%:*}" measured || fail "$name: ${pair%%:*} in the report is not what is measured:
$(diff "${pair%%:*}" measured | head -n 6)"
	done
	# A point that stays is written as it was read: profile points and line ends.
	table_of "$hull" | tr ',' '\n' | grep -c '^0\(\.0*\)\{0,1\}$' >zeros
	table_of $name/faired.csv | tr ',' '\n' | grep -c '^0$' >faired_zeros
	cmp -s zeros faired_zeros || fail "$name: $(cat zeros) profile points, then $(cat faired_zeros)"
done
finish
