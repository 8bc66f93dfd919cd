#include "io/offsets_frame.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double metres_per_foot = 0.3048;

static bool equals(const char *text, size_t length, const char *name)
{
	return strlen(name) == length && memcmp(text, name, length) == 0;
}

bool offsets_unit_named(const char *text, size_t length, hull_unit *out)
{
	for (int unit = HULL_UNIT_M; unit <= HULL_UNIT_FT; unit++) {
		if (equals(text, length, hull_unit_text((hull_unit)unit))) {
			*out = (hull_unit)unit;
			return true;
		}
	}
	return false;
}

bool offsets_frame_named(const char *text, size_t length, hull_frame *out)
{
	for (int frame = HULL_FRAME_AP_FWD; frame <= HULL_FRAME_WATERLINE; frame++) {
		if (equals(text, length, hull_frame_text((hull_frame)frame))) {
			*out = (hull_frame)frame;
			return true;
		}
	}
	return false;
}

bool offsets_frame_is_mirrored(hull_frame frame)
{
	return frame == HULL_FRAME_FP_AFT || frame == HULL_FRAME_GHS;
}

/* ------------------------------------------------------------------------------------------------
 * In. Adding 0 turns a negative zero into 0
 * --------------------------------------------------------------------------------------------- */

/* Division by 1000 is correctly rounded, a product with 0.001 is not: 1.234 must come of 1234. */
double offsets_length_in(const batten_hull *hull, double value)
{
	switch (hull->unit) {
	case HULL_UNIT_MM:
		return value / 1000 + 0.0;
	case HULL_UNIT_FT:
		return value * metres_per_foot + 0.0;
	case HULL_UNIT_M:
		break;
	}
	return value + 0.0;
}

double offsets_x_in(const batten_hull *hull, double value)
{
	double length = offsets_length_in(hull, value);
	switch (hull->frame) {
	case HULL_FRAME_MID_FWD:
	case HULL_FRAME_WATERLINE:
		return hull->lbp_m / 2 + length;
	case HULL_FRAME_FP_AFT:
		return hull->lbp_m - length;
	case HULL_FRAME_GHS:
		return hull->lbp_m / 2 - length;
	case HULL_FRAME_AP_FWD:
		break;
	}
	return length;
}

double offsets_z_in(const batten_hull *hull, double value)
{
	double length = offsets_length_in(hull, value);
	return hull->frame == HULL_FRAME_WATERLINE ? hull->draft_m + length : length;
}

/* ------------------------------------------------------------------------------------------------
 * Out
 * --------------------------------------------------------------------------------------------- */

static double length_estimate(const batten_hull *hull, double length_m)
{
	switch (hull->unit) {
	case HULL_UNIT_MM:
		return length_m * 1000;
	case HULL_UNIT_FT:
		return length_m / metres_per_foot;
	case HULL_UNIT_M:
		break;
	}
	return length_m;
}

static double x_estimate(const batten_hull *hull, double x_m)
{
	switch (hull->frame) {
	case HULL_FRAME_MID_FWD:
	case HULL_FRAME_WATERLINE:
		return length_estimate(hull, x_m - hull->lbp_m / 2);
	case HULL_FRAME_FP_AFT:
		return length_estimate(hull, hull->lbp_m - x_m);
	case HULL_FRAME_GHS:
		return length_estimate(hull, hull->lbp_m / 2 - x_m);
	case HULL_FRAME_AP_FWD:
		break;
	}
	return length_estimate(hull, x_m);
}

static double z_estimate(const batten_hull *hull, double z_m)
{
	return length_estimate(hull, hull->frame == HULL_FRAME_WATERLINE ? z_m - hull->draft_m : z_m);
}

typedef double conversion(const batten_hull *hull, double value);

/* Rounds to so many digits. Both ways through one locale, so its decimal point does not matter. */
static double round_to_digits(double value, int digits)
{
	char text[BATTEN_NUMBER_SIZE];
	(void)snprintf(text, sizeof text, "%.*e", digits - 1, value);
	return strtod(text, NULL);
}

/* The file's number with the fewest digits that in turns into exactly these metres. False where no
 * double near the estimate does: then the estimate. */
static bool find_file_number(const batten_hull *hull, double metres, double estimate,
                             conversion *in, double *out)
{
	/* A scale keeps all digits, so 15 find every shorter number too. A shifted origin makes the
	 * last digits meaningless: there the fewest are looked for. */
	int first = in == offsets_length_in ? 15 : 1;
	for (int digits = first; digits < 17; digits++) {
		*out = round_to_digits(estimate, digits);
		if (in(hull, *out) == metres)
			return true;
	}
	double below = estimate;
	double above = estimate;
	for (int step = 0; step < 4; step++) {
		*out = below;
		if (in(hull, *out) == metres)
			return true;
		*out = above;
		if (in(hull, *out) == metres)
			return true;
		below = nextafter(below, -INFINITY);
		above = nextafter(above, INFINITY);
	}
	*out = estimate;
	return false;
}

/* Metres that no number of the file gives are written as the nearest that one does, so that what is
 * read back is written as the same text again. */
static char *write_number(const batten_hull *hull, double metres, conversion *estimate,
                          conversion *in, char buffer[BATTEN_NUMBER_SIZE])
{
	double value = 0;
	if (!find_file_number(hull, metres, estimate(hull, metres), in, &value)) {
		double near = in(hull, value);
		(void)find_file_number(hull, near, estimate(hull, near), in, &value);
	}
	return batten_number_write(buffer, value + 0.0);
}

char *offsets_length_out(const batten_hull *hull, double length_m, char buffer[BATTEN_NUMBER_SIZE])
{
	if (hull->unit == HULL_UNIT_M)
		return batten_number_write(buffer, length_m + 0.0);
	return write_number(hull, length_m, length_estimate, offsets_length_in, buffer);
}

char *offsets_x_out(const batten_hull *hull, double x_m, char buffer[BATTEN_NUMBER_SIZE])
{
	if (hull->unit == HULL_UNIT_M && hull->frame == HULL_FRAME_AP_FWD)
		return batten_number_write(buffer, x_m + 0.0);
	return write_number(hull, x_m, x_estimate, offsets_x_in, buffer);
}

char *offsets_z_out(const batten_hull *hull, double z_m, char buffer[BATTEN_NUMBER_SIZE])
{
	if (hull->frame != HULL_FRAME_WATERLINE)
		return offsets_length_out(hull, z_m, buffer);
	return write_number(hull, z_m, z_estimate, offsets_z_in, buffer);
}
