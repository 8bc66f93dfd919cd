#!/bin/sh
# batten measure: every measure by its name, values that are known, and its options.
. "$(dirname "$0")/lib.sh"

expect 0 measure "$hulls/wigley.csv" --json
expect_json "$out"
cp "$out" wigley.json
[ -s "$talk" ] && fail "talk: $(cat "$talk")"
for name in lbp_m lwl_m beam_wl_m beam_max_m draft_m half_beam_m volume_m3 displacement_t \
	wetted_surface_m2 waterplane_area_m2 midship_area_m2 max_section_area_m2 cb cp cm cwp cv cws \
	lcb_pct_lbp_fwd xcb_from_ap_m lcf_pct_lbp_fwd xcf_from_ap_m kb_m bmt_m bml_m kmt_m kml_m i_t_m4 \
	i_l_m4 tpc_t_per_cm fn_per_m2 fn_sections_per_m2 energy_bending energy_mean energy_gauss \
	energy_mvc_per_m2 noise_m inflections; do
	holds "$name in JSON" 'x == x' x="$(member wigley.json $name)"
done
[ "$(member wigley.json frame)" = ap-fwd ] || fail 'the frame is not named'
[ "$(member wigley.json state)" = 'moulded, bare hull, upright' ] || fail 'the state is not named'
[ "$(member wigley.json transom)" = 'left out of wetted_surface_m2' ] || fail 'the transom is not tagged'
[ "$(member wigley.json name)" = 'Wigley hull' ] || fail 'the hull is not named'

# The table says the same as the JSON.
expect 0 measure "$hulls/wigley.csv"
awk 'FNR == NR { gsub(/[",:]/, ""); value[$1] = $2; next }
	$1 in value && NF > 2 {
		d = $2 - value[$1]
		if (d > 1e-7 * value[$1] + 1e-12 || -d > 1e-7 * value[$1] + 1e-12)
			print $1, $2, value[$1]
		seen++
	}
	END { if (seen < 38) print seen, "measures in the table" }' wigley.json "$out" >differences
[ -s differences ] && fail "the table differs from the JSON: $(cat differences)"

# near FILE NAME VALUE TOLERANCE
near()
{
	holds "$1: $2" 'x - v <= t && v - x <= t' x="$(member "$1" "$2")" v="$3" t="$4"
}

# Exact where the rules are: sections are parabolas, stations lie symmetrically.
near wigley.json lbp_m 16 0
near wigley.json beam_wl_m 1.6 1e-12
near wigley.json half_beam_m 0.8 1e-12
near wigley.json midship_area_m2 1.0666666666666667 1e-12
near wigley.json cm 0.66666666666666667 1e-12
near wigley.json kb_m 0.625 1e-12
near wigley.json lcb_pct_lbp_fwd 0 1e-10
near wigley.json lcf_pct_lbp_fwd 0 1e-10
near wigley.json xcb_from_ap_m 8 1e-10
near wigley.json inflections 0 0
near wigley.json noise_m 0 1e-12
# Splines through 13 stations, to their order.
near wigley.json cb 0.44444444444444444 1e-4
near wigley.json cwp 0.66666666666666667 1e-4
# What must follow from what.
holds 'relations' 'd == 1.025 * v && kmt == kb + bmt && kml == kb + bml &&
	(cb - v / (16 * 1.6))^2 < 1e-28 && (cp - v / (16 * a))^2 < 1e-28 && (tpc - 0.01025 * w)^2 < 1e-28' \
	d="$(member wigley.json displacement_t)" v="$(member wigley.json volume_m3)" \
	kmt="$(member wigley.json kmt_m)" kml="$(member wigley.json kml_m)" \
	kb="$(member wigley.json kb_m)" bmt="$(member wigley.json bmt_m)" \
	bml="$(member wigley.json bml_m)" cb="$(member wigley.json cb)" cp="$(member wigley.json cp)" \
	a="$(member wigley.json midship_area_m2)" tpc="$(member wigley.json tpc_t_per_cm)" \
	w="$(member wigley.json waterplane_area_m2)"

# Fairness numbers of the shipped hulls (data/README.md): wigley 731.04 with y in cm.
for pair in wigley:0.073104:5e-7 wigley_noisy:0.2847:5e-5 npl_parent:7.164:5e-4 \
	bsra_trawler:0.1511:5e-5 highspeed_craft:1.0840:5e-5; do
	name=${pair%%:*}
	rest=${pair#*:}
	expect 0 measure "$hulls/$name.csv" --json
	expect_json "$out"
	cp "$out" $name.json
	near $name.json fn_per_m2 "${rest%:*}" "${rest#*:}"
done
near npl_parent.json lbp_m 2.54 0
near npl_parent.json draft_m 0.24 0
holds 'misprint in the noise and the energy' 'noise > 0 && energy > 60' \
	noise="$(member npl_parent.json noise_m)" energy="$(member npl_parent.json energy_bending)"

# Another draft, between two waterlines; the fairness numbers are those of the table all the same.
expect 0 measure "$hulls/wigley.csv" --json --draft 0.5
cp "$out" half.json
near half.json draft_m 0.5 0
near half.json beam_wl_m 1.2 1e-12
near half.json midship_area_m2 0.33333333333333333 1e-12
near half.json fn_per_m2 "$(member wigley.json fn_per_m2)" 0
near half.json half_beam_m 0.8 1e-12
# Other water.
expect 0 measure "$hulls/wigley.csv" --json --density 1
cp "$out" fresh.json
near fresh.json displacement_t "$(member fresh.json volume_m3)" 0
# Other rules of quadrature, named in the output; the trapezoid lies below on a convex form.
for rule in spline trapezoid; do
	expect 0 measure "$hulls/wigley.csv" --json --quadrature $rule
	expect_json "$out"
	cp "$out" $rule.json
	[ "$(member $rule.json quadrature)" = $rule ] || fail "$rule is not named"
done
cmp spline.json wigley.json || fail 'spline is not the default'
holds 'trapezoid' 't < s && t > 0.98 * s' t="$(member trapezoid.json volume_m3)" \
	s="$(member spline.json volume_m3)"
finish
