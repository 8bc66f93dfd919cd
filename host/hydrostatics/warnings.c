/* Quantities outside the ranges of usual ships (Letcher 10.2, 11), and hulls that are not closed. */
#include "batten.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

struct band {
	const char *name;
	size_t offset;
	double low, high;
	const char *of;
};

/* C_P is the range of least resistance, the metacentric height that of cargo and passenger ships. */
static const struct band bands[] = {
	{ "cb", offsetof(batten_hydrostatics, cb), 0.35, 1, "fast yachts to barges" },
	{ "cp", offsetof(batten_hydrostatics, cp), 0.48, 1, "least resistance is at 0.48 to 0.67" },
	{ "cv", offsetof(batten_hydrostatics, cv), 1, 20, "destroyers to tugs" },
	{ "cws", offsetof(batten_hydrostatics, cws), 2.6, 2.9, "usual ships at their design draft" },
	{ "lcb_pct_lbp_fwd", offsetof(batten_hydrostatics, lcb_pct_lbp_fwd), -5, 1, "usual ships" },
	{ "gmt_m", offsetof(batten_hydrostatics, gmt_m), 0.5, 1.5, "cargo and passenger ships" },
};

struct collector {
	batten_warning *warnings;
	size_t capacity, count;
};

static void add(struct collector *found, const char *name, const char *text)
{
	if (found->count < found->capacity) {
		batten_warning *warning = &found->warnings[found->count];
		(void)snprintf(warning->name, sizeof warning->name, "%s", name);
		(void)snprintf(warning->text, sizeof warning->text, "%s", text);
	}
	found->count++;
}

static void check_band(struct collector *found, const struct band *band, double value)
{
	char text[160];
	if (isnan(value) || (value >= band->low - 1e-9 && value <= band->high + 1e-9))
		return;
	(void)snprintf(text, sizeof text, "%s is %.4g, outside %g to %g (%s)", band->name, value,
	               band->low, band->high, band->of);
	add(found, band->name, text);
}

size_t batten_hydrostatics_warnings(const batten_hydrostatics *hydrostatics,
                                    batten_warning *warnings, size_t capacity)
{
	static const struct band heights = { "gml_m / gmt_m", 0, 10, 100, "usual ships" };
	struct collector found = { warnings, capacity, 0 };
	if (!(hydrostatics->volume_m3 > 0))
		return 0;
	for (size_t i = 0; i < sizeof bands / sizeof bands[0]; i++) {
		double value;
		memcpy(&value, (const char *)hydrostatics + bands[i].offset, sizeof value);
		/* an upright hull that is not stable is told of below */
		if (!(strcmp(bands[i].name, "gmt_m") == 0 && value <= 0))
			check_band(&found, &bands[i], value);
	}
	if (hydrostatics->gmt_m <= 0)
		add(&found, "gmt_m", "gmt_m is not positive: the hull does not float upright");
	else
		check_band(&found, &heights, hydrostatics->gml_m / hydrostatics->gmt_m);
	if (hydrostatics->volume_mismatch_pct > BATTEN_MISMATCH_LARGEST_PCT) {
		char text[160];
		(void)snprintf(text, sizeof text,
		               "volume_mismatch_pct is %.3g: open below the draft (keel, deck or a hole), "
		               "waterplane and wetted surface are not to be trusted",
		               hydrostatics->volume_mismatch_pct);
		add(&found, "volume_mismatch_pct", text);
	}
	if (hydrostatics->transom_area_m2 > 0) {
		char text[160];
		(void)snprintf(
			text, sizeof text,
			"transom_area_m2 is %.4g: a full end section, left out of the wetted surface",
			hydrostatics->transom_area_m2);
		add(&found, "transom_area_m2", text);
	}
	return found.count;
}
