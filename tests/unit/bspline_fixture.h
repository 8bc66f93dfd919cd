/* What the tests of B-splines share: a context, seeded random curves and surfaces. */
#ifndef BATTEN_TESTS_BSPLINE_FIXTURE_H
#define BATTEN_TESTS_BSPLINE_FIXTURE_H

#include "geometry/bspline.h"
#include "geometry/surface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { FIXTURE_POLES_MOST = 16 }; /* along one direction of a random net */

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

static inline void assert_close(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.17g, expected %.17g within %g", found, expected, tolerance);
}

static inline void assert_all_close(size_t count, const double *found, const double *expected,
                                    double tolerance)
{
	for (size_t i = 0; i < count; i++)
		assert_close(found[i], expected[i], tolerance);
}

/* The call failed as expected and its message has the words. */
static inline void assert_refused(const batten_context *context, batten_status found,
                                  batten_status expected, const char *words)
{
	assert_int_equal(found, expected);
	if (!strstr(batten_context_error(context), words))
		fail_msg("found \"%s\", expected \"%s\" in it", batten_context_error(context), words);
}

/* ------------------------------------------------------------------------------------------------
 * Random nets
 * --------------------------------------------------------------------------------------------- */

/* Uniform in [low, high), by splitmix64. */
static inline double random_between(uint64_t *seed, double low, double high)
{
	uint64_t z = (*seed += 0x9E3779B97F4A7C15u);
	z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
	z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
	z ^= z >> 31;
	return low + (high - low) * ((double)(z >> 11) * 0x1p-53);
}

static inline size_t random_size(uint64_t *seed, size_t low, size_t high)
{
	return low + (size_t)random_between(seed, 0, (double)(high - low + 1));
}

/* Uneven knots, some inner ones repeated up to order - 1 times; clamped or going on beyond both ends
 * of the range, there with repetitions too. */
static inline void random_knots(uint64_t *seed, size_t order, size_t count, bool clamped,
                                double *knots)
{
	double knot = random_between(seed, -2, 2);
	size_t times = 1;
	for (size_t i = 0; i < count + order; i++) {
		bool held = clamped && (i < order || i > count);
		bool must_move = i == order || i == count || times == order - 1;
		bool repeats = held || (!must_move && random_between(seed, 0, 4) < 1);
		if (i > 0 && !repeats) {
			knot += random_between(seed, 0.1, 1);
			times = 0;
		}
		times++;
		knots[i] = knot;
	}
}

static inline struct bspline_curve random_curve(batten_context *context, uint64_t *seed,
                                                size_t order, size_t count, bool clamped,
                                                bool rational)
{
	double knots[FIXTURE_POLES_MOST + BSPLINE_ORDER_MOST];
	double poles[3 * FIXTURE_POLES_MOST];
	double weights[FIXTURE_POLES_MOST];
	random_knots(seed, order, count, clamped, knots);
	for (size_t i = 0; i < 3 * count; i++)
		poles[i] = random_between(seed, -1, 1);
	for (size_t i = 0; i < count; i++)
		weights[i] = random_between(seed, 0.5, 2);
	struct bspline_curve curve;
	struct bspline_curve_net net = { order, count, 3, knots, poles, rational ? weights : NULL };
	assert_int_equal(bspline_curve_create(context, &net, &curve), BATTEN_OK);
	return curve;
}

static inline batten_surface *random_surface(batten_context *context, uint64_t *seed,
                                             const size_t orders[2], const size_t counts[2],
                                             bool clamped, bool rational)
{
	batten_surface *surface;
	assert_int_equal(surface_allocate(context, "random", orders[0], orders[1], counts[0], counts[1],
	                                  rational, &surface),
	                 BATTEN_OK);
	random_knots(seed, orders[0], counts[0], clamped, surface->knots_u);
	random_knots(seed, orders[1], counts[1], clamped, surface->knots_v);
	for (size_t i = 0; i < 3 * counts[0] * counts[1]; i++)
		surface->poles[i] = random_between(seed, -1, 1);
	for (size_t i = 0; i < counts[0] * counts[1] && rational; i++)
		surface->weights[i] = random_between(seed, 0.5, 2);
	assert_int_equal(surface_check(surface), BATTEN_OK);
	return surface;
}

/* A parameter of the range at part 0..1 of it. */
static inline double curve_place(const struct bspline_curve *curve, double part)
{
	double first = curve->knots[curve->order - 1];
	double last = curve->knots[curve->count];
	return part <= 0 ? first : part >= 1 ? last : first + part * (last - first);
}

static inline double surface_place(const batten_surface *surface, batten_direction direction,
                                   double part)
{
	double first;
	double last;
	batten_surface_range(surface, direction, &first, &last);
	return part <= 0 ? first : part >= 1 ? last : first + part * (last - first);
}

/* ------------------------------------------------------------------------------------------------
 * Shape of a surface
 * --------------------------------------------------------------------------------------------- */

static inline void cross(const double a[3], const double b[3], double out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Outward normal, Gauss curvature and mean curvature, the last negative where the surface is convex
 * to the water. */
struct shape {
	double normal[3], gauss, mean;
};

static inline struct shape shape_at(const batten_surface *surface, double u, double v)
{
	batten_surface_point p;
	struct shape out;
	assert_int_equal(batten_surface_evaluate(surface, u, v, &p), BATTEN_OK);
	const double *by_u = p.derivative[1][0];
	const double *by_v = p.derivative[0][1];
	cross(by_v, by_u, out.normal);
	double size = sqrt(dot(out.normal, out.normal));
	for (size_t i = 0; i < 3; i++)
		out.normal[i] /= size;
	double e = dot(p.derivative[2][0], out.normal);
	double f = dot(p.derivative[1][1], out.normal);
	double g = dot(p.derivative[0][2], out.normal);
	double area = dot(by_u, by_u) * dot(by_v, by_v) - dot(by_u, by_v) * dot(by_u, by_v);
	out.gauss = (e * g - f * f) / area;
	out.mean = (e * dot(by_v, by_v) - 2 * f * dot(by_u, by_v) + g * dot(by_u, by_u)) / (2 * area);
	return out;
}

static inline batten_surface *random_net(batten_context *context, uint64_t *seed, bool clamped,
                                         bool rational)
{
	size_t orders[2] = { random_size(seed, 2, 8), random_size(seed, 2, 8) };
	size_t counts[2] = { random_size(seed, orders[0], FIXTURE_POLES_MOST),
		                 random_size(seed, orders[1], FIXTURE_POLES_MOST) };
	return random_surface(context, seed, orders, counts, clamped, rational);
}

static inline void random_place(const batten_surface *surface, uint64_t *seed, double *u, double *v)
{
	*u = surface_place(surface, BATTEN_DIRECTION_U, random_between(seed, 0.001, 0.999));
	*v = surface_place(surface, BATTEN_DIRECTION_V, random_between(seed, 0.001, 0.999));
}

static inline double shortest_span(size_t order, size_t count, const double *knots)
{
	double shortest = INFINITY;
	for (size_t i = order; i <= count; i++)
		if (knots[i] > knots[i - 1])
			shortest = fmin(shortest, knots[i] - knots[i - 1]);
	return shortest;
}

static inline batten_surface *clone_of(const batten_surface *surface)
{
	batten_surface *clone;
	assert_int_equal(batten_surface_clone(surface->context, surface, &clone), BATTEN_OK);
	return clone;
}

#endif
