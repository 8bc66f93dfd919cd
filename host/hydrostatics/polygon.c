/* Integrals over areas bounded by polygons, by Green's theorem (Letcher 9.4, equations 67 to 76; the fourth
 * term of 76 is x_b^2 y_a, where x_a^2 y_a is printed). */
#include "core/context.h"
#include "hull/hull.h"

#include <math.h>

/* The side from a to b. */
static void add_side(const double a[2], const double b[2], batten_polygon_integrals *sums)
{
	const double x = a[0], y = a[1], x_b = b[0], y_b = b[1], along = x_b - x;
	sums->area_m2 += (x + x_b) * (y_b - y) / 2;
	sums->moment_x_m3 -= along * (2 * x * y + x_b * y + x * y_b + 2 * x_b * y_b) / 6;
	sums->moment_y_m3 -= along * (y * y + y * y_b + y_b * y_b) / 6;
	sums->i_xx_m4 -= along * (y * y * y + y * y * y_b + y * y_b * y_b + y_b * y_b * y_b) / 12;
	sums->i_xy_m4 -= along *
	                 (3 * x * y * y + x_b * y * y + 2 * x * y * y_b + 2 * x_b * y * y_b +
	                  x * y_b * y_b + 3 * x_b * y_b * y_b) /
	                 24;
	sums->i_yy_m4 -= along *
	                 (3 * x * x * y + x * x * y_b + 2 * x * x_b * y + x_b * x_b * y +
	                  2 * x * x_b * y_b + 3 * x_b * x_b * y_b) /
	                 12;
}

batten_status batten_polygon_integrate(batten_context *context, size_t loop_count,
                                       const size_t *counts, const double *points_m,
                                       batten_polygon_integrals *out)
{
	batten_polygon_integrals sums = { 0 };
	const double *loop = points_m;
	for (size_t k = 0; k < loop_count; loop += 2 * counts[k++]) {
		if (counts[k] < 3)
			return batten_fail(context, BATTEN_USAGE, "loop %zu: %zu points, expected 3 at least",
			                   k, counts[k]);
		for (size_t i = 0; i < 2 * counts[k]; i++)
			if (!(fabs(loop[i]) <= HULL_LARGEST_M))
				return batten_fail(context, BATTEN_USAGE,
				                   "loop %zu: %c of point %zu is %g, expected a number within %g m",
				                   k, "xy"[i % 2], i / 2, loop[i], HULL_LARGEST_M);
		for (size_t i = 0; i < counts[k]; i++)
			add_side(loop + 2 * i, loop + 2 * ((i + 1) % counts[k]), &sums);
	}
	*out = sums;
	return BATTEN_OK;
}
