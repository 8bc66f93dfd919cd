/* Moor's method: sectional areas and load waterline changed each in its own way (thesis 2.3.4). */
#include "variation/variation.h"

#include <math.h>

/* Steps a half body is searched in before the root is closed in on. */
enum { SEARCH_STEPS = 512, HALVINGS = 60 };

/* Proportions this near are the same: where the curve has an extreme there, no sign changes. */
#define SAME_PROPORTION 1e-12

static batten_status check_shift(batten_context *context, const char *what,
                                 const variation_shift *shift)
{
	double folds_m = 0;
	if (variation_shift_folds(shift, &folds_m))
		return batten_fail(context, BATTEN_INPUT,
		                   "ordinates of the %s about x = %.4g m would run into each other", what,
		                   folds_m);
	return BATTEN_OK;
}

batten_status variation_moor_create(const variation_parent *parent,
                                    const variation_shift *area_shift,
                                    const variation_shift *waterline_shift, variation_moor *out)
{
	batten_context *context = parent->context;
	*out = (variation_moor){ .context = context, .parent = parent };
	batten_status status = check_shift(context, "sectional area curve", area_shift);
	if (status == BATTEN_OK)
		status = check_shift(context, "load waterline", waterline_shift);
	if (status == BATTEN_OK)
		status = variation_shift_curve(context, area_shift, &parent->areas, &out->areas);
	if (status == BATTEN_OK)
		status = variation_shift_curve(context, waterline_shift, &parent->waterline,
		                               &out->waterline);
	if (status != BATTEN_OK)
		variation_moor_destroy(out);
	return status;
}

void variation_moor_destroy(variation_moor *moor)
{
	spline_destroy(&moor->areas);
	spline_destroy(&moor->waterline);
	*moor = (variation_moor){ 0 };
}

/* Area over breadth, each in parts of its value amidships; 0 where there is no breadth. */
static double proportion(const struct spline *areas, const struct spline *waterline,
                         double middle_m, double x_m)
{
	const double breadth = spline_value(waterline, x_m) / spline_value(waterline, middle_m);
	const double area = spline_value(areas, x_m) / spline_value(areas, middle_m);
	return breadth > 1e-9 ? area / breadth : 0;
}

static double parent_proportion(const variation_moor *moor, double x_m)
{
	const variation_parent *parent = moor->parent;
	return proportion(&parent->areas, &parent->waterline, parent->span.middle_m, x_m);
}

static double close_in(const variation_moor *moor, double from, double to, double asked)
{
	const bool rising = parent_proportion(moor, from) < asked;
	for (int i = 0; i < HALVINGS; i++) {
		const double middle = 0.5 * (from + to);
		if ((parent_proportion(moor, middle) < asked) == rising)
			from = middle;
		else
			to = middle;
	}
	return 0.5 * (from + to);
}

static bool stays(const variation_span *span, double x_m)
{
	const double near = 1e-9 * (span->fore_m - span->aft_m);
	return x_m <= span->aft_m + near || x_m >= span->fore_m - near ||
	       fabs(x_m - span->middle_m) <= near;
}

double variation_moor_place(const variation_moor *moor, double x_m, bool *found)
{
	const variation_span *span = &moor->parent->span;
	*found = true;
	if (stays(span, x_m))
		return x_m;
	const double asked = proportion(&moor->areas, &moor->waterline, span->middle_m, x_m);
	if (fabs(parent_proportion(moor, x_m) - asked) <= SAME_PROPORTION)
		return x_m;
	const double from = x_m < span->middle_m ? span->aft_m : span->middle_m;
	const double to = x_m < span->middle_m ? span->middle_m : span->fore_m;
	double root = NAN, nearest = x_m, least = INFINITY, before = 0;
	for (int i = 0; i <= SEARCH_STEPS; i++) {
		const double here = from + (to - from) * i / SEARCH_STEPS;
		const double off = parent_proportion(moor, here) - asked;
		if (fabs(off) < least) {
			least = fabs(off);
			nearest = here;
		}
		if (i > 0 && (off < 0) != (before < 0)) {
			const double place = close_in(moor, from + (to - from) * (i - 1) / SEARCH_STEPS, here,
			                              asked);
			if (isnan(root) || fabs(place - x_m) < fabs(root - x_m))
				root = place;
		}
		before = off;
	}
	*found = !isnan(root);
	return *found ? root : nearest;
}

/* Half-breadths of one waterline: those of the places, in proportion to the load waterline. */
static batten_status take_line(const variation_moor *moor, const variation_line *line,
                               const double *places, double *y_m)
{
	const variation_parent *parent = moor->parent;
	const batten_hull *hull = parent->hull;
	curve shape = { 0 };
	batten_status status = BATTEN_OK;
	if (line->count >= 2)
		status = variation_line_curve(parent->context, line, &shape);
	if (status != BATTEN_OK)
		return status;
	for (size_t s = 0; s < hull->station_count; s++) {
		const double x = hull->x_m[s], breadth = spline_value(&parent->waterline, places[s]);
		const double factor = stays(&parent->span, x) || !(breadth > 0)
		                          ? 1
		                          : fmax(spline_value(&moor->waterline, x), 0) / breadth;
		y_m[s] = line->count >= 2 ? fmax(curve_value(&shape, places[s]), 0) * factor : NAN;
	}
	curve_destroy(&shape);
	return BATTEN_OK;
}

batten_status variation_moor_apply(const variation_moor *moor, batten_hull *variant,
                                   size_t *unmatched)
{
	const size_t stations = variant->station_count;
	batten_context *context = moor->context;
	*unmatched = 0;
	if (variant->end_count > 0)
		return batten_fail(
			context, BATTEN_INPUT,
			"%s: its waterlines end off the grid, which Moor's method cannot take; a "
			"table of layout grid is expected",
			variant->name);
	double *y = batten_allocate(context, hull_node_count(variant), sizeof *y);
	double *places = batten_allocate(context, stations, sizeof *places);
	batten_status status = y && places ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t s = 0; s < stations && status == BATTEN_OK; s++) {
		bool found = true;
		places[s] = variation_moor_place(moor, variant->x_m[s], &found);
		*unmatched += !found;
	}
	for (size_t w = 0; w < variant->waterline_count && status == BATTEN_OK; w++)
		status = take_line(moor, &moor->parent->lines[w], places, y + w * stations);
	if (status == BATTEN_OK)
		status = variation_carry_chines(moor->parent->hull, variant->x_m, places, variant);
	if (status == BATTEN_OK)
		status = variation_set_offsets(variant, y);
	batten_release(context, places);
	batten_release(context, y);
	return status;
}
