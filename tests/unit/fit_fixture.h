/* What the tests of fits share: contexts, shipped hulls, hulls of a formula, comparisons. */
#ifndef BATTEN_TESTS_FIT_FIXTURE_H
#define BATTEN_TESTS_FIT_FIXTURE_H

#include "batten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline int make_context(void **state)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	*state = context;
	return 0;
}

static inline int end_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

static inline batten_hull *read_hull(batten_context *context, const char *name)
{
	char path[4096];
	batten_hull *hull = NULL;
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	if (batten_hull_read(context, path, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static inline batten_fit_options net(size_t count_u, size_t count_v, size_t order)
{
	batten_fit_options options;
	batten_fit_options_default(&options);
	options.count_u = count_u;
	options.count_v = count_v;
	options.order_u = order;
	options.order_v = order;
	return options;
}

static inline batten_surface *fit(batten_context *context, const batten_hull *hull,
                                  const batten_fit_options *options,
                                  batten_fit_deviation *deviation)
{
	batten_surface *surface = NULL;
	if (batten_hull_fit(context, hull, options, &surface, deviation) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return surface;
}

/* A grid hull without empty cells from a formula. */
enum { STATIONS = 17, WATERLINES = 13 };
static inline batten_hull *hull_of(batten_context *context, double (*y)(double x, double z))
{
	double at_x[STATIONS], at_z[WATERLINES], at_y[STATIONS * WATERLINES];
	for (size_t s = 0; s < STATIONS; s++)
		at_x[s] = 8.0 * (1.0 - cos(acos(-1.0) * (double)s / (STATIONS - 1)));
	for (size_t w = 0; w < WATERLINES; w++) {
		at_z[w] = 1.0 - cos(0.5 * acos(-1.0) * (double)w / (WATERLINES - 1));
		for (size_t s = 0; s < STATIONS; s++)
			at_y[w * STATIONS + s] = s == 0 || s + 1 == STATIONS || w == 0 ? 0.0
			                                                               : y(at_x[s], at_z[w]);
	}
	const batten_hull_table table = { .name = "formula",
		                              .lbp_m = 16,
		                              .draft_m = 1,
		                              .station_count = STATIONS,
		                              .waterline_count = WATERLINES,
		                              .x_m = at_x,
		                              .z_m = at_z,
		                              .y_m = at_y };
	batten_hull *hull = NULL;
	if (batten_hull_create(context, &table, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static inline const double *pole(const batten_surface_net *of, size_t i, size_t j)
{
	return of->poles_m + 3 * (j * of->count_u + i);
}

static inline void assert_near(double value, double expected, double tolerance, const char *what)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%s: found %.17g, expected %.17g within %g", what, value, expected, tolerance);
}

static inline void assert_below(double value, double bound, const char *what)
{
	if (!(value >= 0.0 && value <= bound))
		fail_msg("%s: found %.17g, expected at most %g", what, value, bound);
}

#endif
