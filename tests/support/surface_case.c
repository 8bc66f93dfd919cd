#include "support/surface_case.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { COUNT_U = 11, COUNT_V = 9, POLES = COUNT_U * COUNT_V, ORDER_MOST = 8 };

static double noise_of(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

/* Clamped over 0..2, uneven within, the first inner knot twice where the order allows it. */
static void make_knots(size_t order, size_t count, double *knots)
{
	for (size_t n = 0; n < count + order; n++)
		knots[n] = n < order ? 0.0 : n >= count ? 2.0 : 0.0;
	for (size_t n = order; n < count; n++) {
		const double t = (double)(n - order + 1) / (double)(count - order + 1);
		knots[n] = 2.0 * t * (0.75 + 0.25 * t);
	}
	if (order > 2 && count > order + 1)
		knots[order + 1] = knots[order];
}

static size_t make_parameters(size_t order, size_t count, const double *knots, double *t)
{
	size_t n = 0;
	for (size_t k = order - 1; k <= count; k++)
		t[n++] = knots[k];
	for (int k = 1; k < 12; k++)
		t[n++] = k / 6.0;
	return n;
}

static batten_surface *make_surface(surface_case *c, const batten_surface_net *shape, size_t s,
                                    uint32_t *state)
{
	double poles[POLES * 3];
	double weights[POLES];
	batten_surface_net net = *shape;
	for (size_t n = 0; n < POLES; n++) {
		const double i = (double)(n % COUNT_U);
		const double k = (double)(n / COUNT_U);
		const double side = s == 3 && n % COUNT_U == 0 ? 0.0 : 1.0;
		poles[3 * n] = 10.0 * i + noise_of(state) * side;
		poles[3 * n + 1] = side * (0.2 * i * (10.0 - i) + 0.5 * k + 0.5 * noise_of(state));
		poles[3 * n + 2] = side * (k + 0.25 * noise_of(state));
		weights[n] = 1.0 + 0.8 * noise_of(state);
	}
	net.poles_m = poles;
	net.weights = shape->weights ? weights : NULL;
	batten_surface *surface = NULL;
	if (batten_surface_create(c->context, &net, &surface) != BATTEN_OK)
		fail_msg("%s", batten_context_error(c->context));
	return surface;
}

surface_case surface_case_open(size_t order_u, size_t order_v, bool rational)
{
	surface_case c = { .count = SURFACE_CASE_COUNT };
	double knots_u[COUNT_U + ORDER_MOST];
	double knots_v[COUNT_V + ORDER_MOST];
	const double any = 1.0;
	uint32_t state = 7919u;
	assert_int_equal(batten_context_create(NULL, &c.context), BATTEN_OK);
	make_knots(order_u, COUNT_U, knots_u);
	make_knots(order_v, COUNT_V, knots_v);
	const batten_surface_net shape = { .order_u = order_u,
		                               .order_v = order_v,
		                               .count_u = COUNT_U,
		                               .count_v = COUNT_V,
		                               .knots_u = knots_u,
		                               .knots_v = knots_v,
		                               .weights = rational ? &any : NULL };
	for (size_t s = 0; s < c.count; s++)
		c.surfaces[s] = make_surface(&c, &shape, s, &state);
	c.samples.u_count = make_parameters(order_u, COUNT_U, knots_u, c.u);
	c.samples.v_count = make_parameters(order_v, COUNT_V, knots_v, c.v);
	return c;
}

void surface_case_close(surface_case *c)
{
	for (size_t s = 0; s < c->count; s++)
		batten_surface_destroy(c->surfaces[s]);
	batten_context_destroy(c->context);
}

size_t surface_case_samples(const surface_case *c)
{
	return c->samples.u_count * c->samples.v_count;
}

size_t surface_case_values(const surface_case *c, batten_surface_output output)
{
	return c->count * batten_surface_output_count(output) * surface_case_samples(c);
}

batten_surface_batch_options surface_case_options(int device, batten_precision precision,
                                                  batten_surface_output output)
{
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = device;
	options.precision = precision;
	options.output = output;
	return options;
}

static void run_grid(const surface_case *c, const batten_surface_batch_options *options,
                     double *values, uint8_t *singular)
{
	batten_surface_samples samples = c->samples;
	batten_run run;
	samples.u = c->u;
	samples.v = c->v;
	if (batten_surface_grid_batch(c->context, c->count, (const batten_surface *const *)c->surfaces,
	                              &samples, options, values, singular, &run) != BATTEN_OK)
		fail_msg("%s", batten_context_error(c->context));
	assert_true(run.strict);
	assert_string_equal(run.warning, "");
}

static void compare_grid(const surface_case *c, batten_surface_batch_options options)
{
	const size_t numbers = surface_case_values(c, options.output);
	const size_t points = c->count * surface_case_samples(c);
	double *values = calloc(2 * numbers, sizeof *values);
	uint8_t *singular = calloc(2 * points, 1);
	assert_non_null(values);
	assert_non_null(singular);
	run_grid(c, &options, values, singular);
	options.device = BATTEN_DEVICE_REFERENCE;
	run_grid(c, &options, values + numbers, singular + points);
	assert_memory_equal(values, values + numbers, numbers * sizeof *values);
	assert_memory_equal(singular, singular + points, points);
	free(values);
	free(singular);
}

static void compare_energy(const surface_case *c, batten_surface_batch_options options)
{
	batten_surface_energies found[SURFACE_CASE_COUNT] = { { 0 } };
	batten_surface_energies known[SURFACE_CASE_COUNT] = { { 0 } };
	const batten_surface *const *surfaces = (const batten_surface *const *)c->surfaces;
	assert_int_equal(
		batten_surface_energy_batch(c->context, c->count, surfaces, &options, found, NULL),
		BATTEN_OK);
	options.device = BATTEN_DEVICE_REFERENCE;
	assert_int_equal(
		batten_surface_energy_batch(c->context, c->count, surfaces, &options, known, NULL),
		BATTEN_OK);
	assert_memory_equal(found, known, sizeof found);
	assert_true(found[0].area_m2 > 0.0);
	assert_true((found[0].variation_per_m2 > 0.0) == options.variation);
}

void surface_case_compare_most(const surface_case *c, const batten_surface_batch_options *options)
{
	batten_surface_batch_options chosen = *options;
	chosen.output = BATTEN_SURFACE_EVERYTHING;
	compare_grid(c, chosen);
	chosen = *options;
	chosen.variation = true;
	compare_energy(c, chosen);
}

void surface_case_compare(const surface_case *c, const batten_surface_batch_options *options)
{
	static const batten_surface_output outputs[] = { BATTEN_SURFACE_POSITION,
		                                             BATTEN_SURFACE_CURVATURE,
		                                             BATTEN_SURFACE_EVERYTHING };
	for (size_t o = 0; o < sizeof outputs / sizeof outputs[0]; o++) {
		batten_surface_batch_options chosen = *options;
		chosen.output = outputs[o];
		compare_grid(c, chosen);
	}
	batten_surface_batch_options chosen = *options;
	for (int variation = 0; variation < 2; variation++) {
		chosen.variation = variation;
		compare_energy(c, chosen);
	}
}
