#!/bin/sh
# The other shipped hulls: an OpenCL device and the plain C path give the same bytes.
. "$(dirname "$0")/lib.sh"
without_pictures
for case in bsra_trawler:f64 bsra_trawler:f32 highspeed_craft:f64 highspeed_craft:f32 wigley:f64 \
	wigley_noisy:f64 wigley_noisy:f32; do
	hull=$hulls/${case%:*}.csv
	expect 0 fair "$hull" --precision ${case#*:} --quiet --out device
	[ "$(member device/report.json search strict)" = true ] || fail "$case: not strict"
	[ "$(member device/report.json search device)" != reference ] || fail "$case: on no OpenCL device"
	expect 0 fair "$hull" --precision ${case#*:} --device reference --quiet --out reference
	cmp device/faired.csv reference/faired.csv || fail "$case: faired.csv differs"
	for key in iterations probes objective_after last_step_m; do
		[ "$(member device/report.json search $key)" = \
			"$(member reference/report.json search $key)" ] || fail "$case: another $key"
	done
done
finish
