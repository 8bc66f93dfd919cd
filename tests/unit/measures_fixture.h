/* What the tests of the measures share: hulls of a given form, measured. */
#ifndef BATTEN_TESTS_MEASURES_FIXTURE_H
#define BATTEN_TESTS_MEASURES_FIXTURE_H

#include "batten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 161 };

/* Half-breadth over x and height over the keel; NaN is outside. */
typedef double form(double x, double z);

static inline batten_context *make_context(void)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	return context;
}

static inline batten_hull *make_hull(batten_context *context, form *surface, double length,
                                     double depth, size_t nx, size_t nz)
{
	static double y[MOST * MOST];
	static uint8_t nodes[MOST * MOST];
	double x[MOST], z[MOST];
	assert_true(nx <= MOST && nz <= MOST);
	for (size_t i = 0; i < nx; i++)
		x[i] = length * (double)i / (double)(nx - 1);
	for (size_t j = 0; j < nz; j++)
		z[j] = depth * (double)j / (double)(nz - 1);
	for (size_t i = 0; i < nx * nz; i++) {
		double value = surface(x[i % nx], z[i / nx]);
		nodes[i] = (uint8_t)(isnan(value) ? BATTEN_NODE_OUTSIDE : BATTEN_NODE_GIVEN);
		y[i] = isnan(value) ? 0 : value;
	}
	batten_hull_table table = { "test", length, depth, nx, nz, x, z, y, nodes };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
	return hull;
}

static inline batten_measures measure_at(batten_context *context, const batten_hull *hull,
                                         batten_quadrature rule, double draft_m)
{
	batten_measure_options options;
	batten_measure_options_default(&options);
	options.quadrature = rule;
	options.draft_m = draft_m;
	batten_measures measures;
	if (batten_hull_measure(context, hull, &options, &measures) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return measures;
}

static inline batten_measures measure_form(form *surface, double length, double depth, size_t nx,
                                           size_t nz, batten_quadrature rule, double draft_m)
{
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, surface, length, depth, nx, nz);
	batten_measures measures = measure_at(context, hull, rule, draft_m);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
	return measures;
}

static inline void assert_relative(double value, double expected, double tolerance)
{
	if (!(fabs(value / expected - 1) <= tolerance))
		fail_msg("%.17g where %.17g is expected", value, expected);
}

#endif
