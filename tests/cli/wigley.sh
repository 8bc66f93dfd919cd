#!/bin/sh
# The Wigley hulls: the exact form stays, the noisy one comes closer to it.
. "$(dirname "$0")/lib.sh"
without_pictures

expect 0 fair "$hulls/wigley.csv" --out exact
change "$hulls/wigley.csv" exact/faired.csv >.change
read -r most rms count <.change
holds 'the exact form' 'most <= 1e-6 * 0.8 && count == 260' most="$most" count="$count"
tr -d ' \n' <exact/report.json | grep -q '"replaced":\[\]' || fail 'exact offsets replaced'
same_form "$hulls/wigley.csv" exact/faired.csv

# y = B/2 (1 - (2x'/L)^2) (1 - (1 - z)^2), x' from amidships.
table_of "$hulls/wigley_noisy.csv" | awk -F, -v OFS=, '
	NR == 1 { for (i = 2; i <= NF; i++) x[i] = $i; print; next }
	{
		for (i = 2; i <= NF; i++)
			$i = sprintf("%.17g", 0.8 * (1 - ((x[i] - 8) / 8)^2) * (1 - (1 - $1)^2))
		print
	}' >form.csv
expect 0 fair "$hulls/wigley_noisy.csv" --out noisy
change "$hulls/wigley_noisy.csv" form.csv >.change
read -r most before count <.change
change noisy/faired.csv form.csv >.change
read -r most after count <.change
holds 'distance to the exact form' 'before >= 1.6 * after && before > 0.005 && count == 420' \
	before="$before" after="$after" count="$count"
h=$(half_beam "$hulls/wigley_noisy.csv")
change "$hulls/wigley_noisy.csv" noisy/faired.csv >.change
read -r most rms count <.change
holds 'default distance limit' 'most <= 0.01 * h * (1 + 1e-12)' most="$most" h="$h"
noise=$(member noisy/report.json method noise_m)
holds 'noise' 'noise > 0.0045 && noise < 0.0075' noise="$noise"
# The discrepancy principle: over the offsets that may move, not over the profile's zeros.
moving=$(member noisy/report.json method rms_change_m)
holds 'change against noise' 'moving <= 0.75 * noise && moving > 0.3 * noise' moving="$moving" \
	noise="$noise"
holds 'change in the report' 'd < 1e-12 && d > -1e-12' \
	d="$(awk -v a="$moving" -v b="$rms" -v n="$count" \
		-v m="$(member noisy/report.json method variable_count)" \
		'BEGIN { printf "%.17g", a - b * sqrt(n / m) }')"
same_form "$hulls/wigley_noisy.csv" noisy/faired.csv
finish
