/* The front of a hull: fairness over closeness (thesis, conclusions). */
#include "picture/chart.h"

#include <math.h>
#include <stdio.h>

enum { NUMBERS = sizeof(batten_front_point) / sizeof(double) };
_Static_assert(sizeof(batten_front_point) % sizeof(double) == 0, "strides are in numbers");

batten_status batten_picture_front(batten_context *context, const char *name, size_t count,
                                   const batten_front_point *points, const char *path)
{
	if (count < 2)
		return batten_fail(context, BATTEN_USAGE, "a front of %zu points: two at least", count);
	chart_curve curve = { .count = count,
		                  .x = &points->closeness.cn_rms_m,
		                  .y = &points->fairness,
		                  .x_stride = NUMBERS,
		                  .y_stride = NUMBERS,
		                  .scale = 1000.0,
		                  .dotted = true };
	(void)snprintf(curve.label, sizeof curve.label, "w2/w1 from %.3g (right) to %.3g (left)",
	               points[0].ratio, points[count - 1].ratio);
	struct chart chart = {
		.name = name,
		.subtitle = points->surface ? "fairness of the surface against its distance from the "
		                              "fitted one, one point a weight"
		                            : "fairness against closeness, one point a weight",
		.x_title = "root mean square change, mm",
		.y_title = "sum of fairness dS",
		.count = 1,
		.curves = &curve,
		.y_low = INFINITY,
		.y_high = -INFINITY
	};
	for (size_t p = 0; p < count; p++) {
		chart.x_high = fmax(chart.x_high, 1000.0 * points[p].closeness.cn_rms_m);
		chart.y_low = fmin(chart.y_low, points[p].fairness);
		chart.y_high = fmax(chart.y_high, points[p].fairness);
	}
	if (!(chart.x_high > 0.0) || !(chart.y_high > chart.y_low) || !isfinite(chart.y_high))
		return batten_fail(context, BATTEN_USAGE, "%s: no weight of the front moves anything",
		                   name);
	return chart_write(context, &chart, path);
}
