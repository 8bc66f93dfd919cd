#include "fairing/grid_lines.h"

#include <float.h>
#include <math.h>

void lines_first_differences(size_t count, const double *along_m, const double *value_m, double *d1)
{
	for (size_t i = 0; i + 1 < count; i++)
		d1[i] = (value_m[i + 1] - value_m[i]) / (along_m[i + 1] - along_m[i]);
}

/* The second difference at interior point i. */
static double second_difference(const double *along_m, const double *value_m, size_t i)
{
	double left = (value_m[i] - value_m[i - 1]) / (along_m[i] - along_m[i - 1]);
	double right = (value_m[i + 1] - value_m[i]) / (along_m[i + 1] - along_m[i]);
	return (right - left) / (0.5 * (along_m[i + 1] - along_m[i - 1]));
}

void lines_second_differences(size_t count, const double *along_m, const double *value_m,
                              double *d2_per_m)
{
	for (size_t i = 1; i + 1 < count; i++)
		d2_per_m[i - 1] = second_difference(along_m, value_m, i);
}

double lines_fairness(size_t count, const double *along_m, const double *value_m)
{
	if (count < 3)
		return NAN;
	double sum = 0;
	for (size_t i = 1; i + 1 < count; i++) {
		double d2 = second_difference(along_m, value_m, i);
		sum += d2 * d2;
	}
	return sum;
}

/* What a value of the line may be off by through rounding of its coordinates. */
static double value_rounding(size_t count, const double *along_m, const double *value_m)
{
	double along = 0, value = 0, slope = 0;
	for (size_t i = 0; i < count; i++) {
		along = fmax(along, fabs(along_m[i]));
		value = fmax(value, fabs(value_m[i]));
		if (i > 0)
			slope = fmax(slope,
			             fabs((value_m[i] - value_m[i - 1]) / (along_m[i] - along_m[i - 1])));
	}
	return 8 * DBL_EPSILON * (value + slope * along);
}

size_t lines_inflections(size_t count, const double *along_m, const double *value_m)
{
	if (count < 4)
		return 0;
	double rounding = value_rounding(count, along_m, value_m);
	size_t changes = 0;
	double last = 0;
	for (size_t i = 1; i + 1 < count; i++) {
		double left = along_m[i] - along_m[i - 1], right = along_m[i + 1] - along_m[i];
		double floor_per_m = rounding * ((1 / left + 1 / right) / (0.5 * (left + right)));
		double d2 = second_difference(along_m, value_m, i);
		if (fabs(d2) <= floor_per_m)
			continue;
		if (last != 0 && (d2 > 0) != (last > 0))
			changes++;
		last = d2;
	}
	return changes;
}

size_t lines_piece_end(const batten_hull *hull, bool waterline, size_t line,
                       const hull_line *points, size_t first, size_t *next)
{
	const double *table = waterline ? hull->x_m : hull->z_m;
	size_t count = waterline ? hull->station_count : hull->waterline_count;
	/* hull_knuckle_between() takes a knuckle within 1e-9 of the table for one at the end */
	double near = 4e-9 * (table[count - 1] - table[0]);
	for (size_t i = first; i + 1 < points->count; i++) {
		double here = points->along_m[i], there = points->along_m[i + 1];
		if (i > first && hull_knuckle_between(hull, waterline, line, here, here)) {
			*next = i;
			return i;
		}
		if (points->gap[i + 1] ||
		    hull_knuckle_between(hull, waterline, line, here + near, there - near)) {
			*next = i + 1;
			return i;
		}
	}
	*next = points->count;
	return points->count - 1;
}

static void add_piece(lines_sum *sum, size_t count, const double *along_m, const double *value_m)
{
	if (count < 3)
		return;
	sum->fn_per_m2 += lines_fairness(count, along_m, value_m);
	sum->interior_count += count - 2;
	sum->inflections += lines_inflections(count, along_m, value_m);
}

lines_sum lines_of_points(const batten_hull *hull, bool waterline, size_t line,
                          const hull_line *points)
{
	lines_sum sum = { 0 };
	for (size_t first = 0, next = 0; first < points->count; first = next) {
		size_t last = lines_piece_end(hull, waterline, line, points, first, &next);
		add_piece(&sum, last - first + 1, points->along_m + first, points->value_m + first);
	}
	return sum;
}

bool lines_are_of_grid(const batten_hull *hull)
{
	return hull->layout == HULL_LAYOUT_GRID && hull->end_count == 0 && hull->profile_count == 0 &&
	       hull->knuckle_count == 0;
}

static batten_status line_of_any(const batten_hull *hull, bool waterline, size_t line,
                                 lines_sum *sum)
{
	hull_line points;
	const batten_status status = hull_line_collect(hull, waterline, line, false, &points);
	if (status != BATTEN_OK)
		return status;
	*sum = lines_of_points(hull, waterline, line, &points);
	hull_line_release(hull, &points);
	return BATTEN_OK;
}

batten_status lines_of_hull(const batten_hull *hull, bool waterlines, lines_sum *out)
{
	lines_sum total = { 0 };
	const size_t count = waterlines ? hull->waterline_count : hull->station_count;
	grid_lines *table = NULL;
	batten_status status = lines_are_of_grid(hull)
	                           ? grid_lines_create(hull->context, hull, waterlines, &table)
	                           : BATTEN_OK;
	if (table) {
		*out = grid_lines_sum(table, hull->y_m);
		grid_lines_destroy(table);
		return BATTEN_OK;
	}
	for (size_t line = 0; line < count && status == BATTEN_OK; line++) {
		lines_sum sum = { 0 };
		status = line_of_any(hull, waterlines, line, &sum);
		total.fn_per_m2 += sum.fn_per_m2;
		total.interior_count += sum.interior_count;
		total.inflections += sum.inflections;
	}
	if (total.interior_count == 0)
		total.fn_per_m2 = NAN;
	if (status == BATTEN_OK)
		*out = total;
	return status;
}
