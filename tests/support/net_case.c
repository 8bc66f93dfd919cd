#include "support/net_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { COLUMNS = 16, ROWS = 10, ORDER = 4 };

/* What both cases have in common once there is a surface. */
static void take_surface(net_case *c, double part)
{
	c->net = batten_surface_describe(c->surface);
	c->poles = c->net.count_u * c->net.count_v;
	c->exact = (oracle_surface){ c->net.order_u, c->net.order_v, c->net.count_u, c->net.count_v,
		                         c->net.knots_u, c->net.knots_v, c->net.poles_m, NULL };
	c->target = calloc(c->poles, sizeof *c->target);
	c->lower = calloc(c->poles, sizeof *c->lower);
	c->upper = calloc(c->poles, sizeof *c->upper);
	assert_true(c->target && c->lower && c->upper);
	for (size_t n = 0; n < c->poles; n++) {
		const double y = c->net.poles_m[3 * n + 1];
		c->target[n] = c->lower[n] = c->upper[n] = y;
		if (y == 0.0)
			continue;
		c->lower[n] = y - part * c->half_beam_m;
		c->upper[n] = y + part * c->half_beam_m;
	}
}

/* Each pole on the hull over the mean of its knots: near enough to the hull, and exactly known. */
static void make_wigley(uint32_t state, double noise_m, double *poles)
{
	for (size_t k = 0; k < ROWS; k++)
		for (size_t i = 0; i < COLUMNS; i++) {
			double mean[2] = { 0.0, 0.0 };
			for (size_t d = 1; d < ORDER; d++) {
				const double u = ((double)(i + d) - 3.0) / (COLUMNS - 3);
				const double v = ((double)(k + d) - 3.0) / (ROWS - 3);
				mean[0] += fmin(fmax(u, 0.0), 1.0) / 3.0;
				mean[1] += fmin(fmax(v, 0.0), 1.0) / 3.0;
			}
			const double along = 2.0 * mean[0] - 1.0;
			const double down = 1.0 - mean[1];
			double y = 0.8 * (1.0 - along * along) * (1.0 - down * down);
			double *pole = poles + 3 * (k * COLUMNS + i);
			state = state * 1664525u + 1013904223u;
			if (y > 1e-9)
				y = fmax(0.0, y + noise_m * ((double)(state >> 8) / (double)(1u << 23) - 1.0));
			else
				y = 0.0;
			pole[0] = 16.0 * mean[0];
			pole[1] = y;
			pole[2] = mean[1];
		}
}

net_case net_case_wigley(double part)
{
	return net_case_noisy(777u, 0.01, part);
}

net_case net_case_noisy(uint32_t seed, double noise_m, double part)
{
	net_case c = { .half_beam_m = 0.8 };
	double poles[3 * COLUMNS * ROWS];
	make_wigley(seed, noise_m, poles);
	const batten_surface_net net = {
		.order_u = ORDER, .order_v = ORDER, .count_u = COLUMNS, .count_v = ROWS, .poles_m = poles
	};
	assert_int_equal(batten_context_create(NULL, &c.context), BATTEN_OK);
	assert_int_equal(batten_surface_create(c.context, &net, &c.surface), BATTEN_OK);
	take_surface(&c, part);
	return c;
}

net_case net_case_npl(double part)
{
	net_case c = { 0 };
	batten_hull *hull = NULL;
	batten_fit_options options;
	batten_fit_options_default(&options);
	options.count_u = options.count_v = 13;
	assert_int_equal(batten_context_create(NULL, &c.context), BATTEN_OK);
	assert_int_equal(batten_hull_read(c.context, BATTEN_DATA_DIR "/hulls/npl_parent.csv", &hull),
	                 BATTEN_OK);
	assert_int_equal(batten_hull_fit(c.context, hull, &options, &c.surface, NULL), BATTEN_OK);
	c.half_beam_m = batten_hull_half_beam_m(hull);
	batten_hull_destroy(hull);
	take_surface(&c, part);
	return c;
}

void net_case_close(net_case *c)
{
	batten_surface_destroy(c->surface);
	batten_context_destroy(c->context);
	free(c->target);
	free(c->lower);
	free(c->upper);
}

batten_net_problem net_case_problem(const net_case *c, double w1, double w2)
{
	return (batten_net_problem){ .start = c->surface,
		                         .lower_y_m = c->lower,
		                         .upper_y_m = c->upper,
		                         .w1 = w1,
		                         .w2 = w2,
		                         .half_beam_m = c->half_beam_m };
}

oracle_net_problem net_case_oracle(const net_case *c, oracle_fairness fairness, double w1,
                                   double w2)
{
	return (oracle_net_problem){ .surface = &c->exact,
		                         .target = c->target,
		                         .lower = c->lower,
		                         .upper = c->upper,
		                         .w1 = w1,
		                         .w2 = w2,
		                         .h = c->half_beam_m,
		                         .nodes = c->net.order_u,
		                         .fairness = fairness,
		                         .rounding = 1e-3 / (c->half_beam_m * c->half_beam_m) };
}
