/* The variation of curvature of surfaces: one point against closed forms and the oracle's
 * differences of curvatures, in both precisions, and integrals of it. */
#include "surface_fixture.h"

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/surface_variation.h"

static surface_triple triple_of(const double *d)
{
	return (surface_triple){ d[0], d[1], d[2] };
}

static surface_variation variation_at(const batten_surface *surface, double u, double v)
{
	batten_surface_point p;
	assert_int_equal(batten_surface_evaluate(surface, u, v, &p), BATTEN_OK);
	const surface_jet jet = { triple_of(p.derivative[0][0]), triple_of(p.derivative[1][0]),
		                      triple_of(p.derivative[0][1]), triple_of(p.derivative[2][0]),
		                      triple_of(p.derivative[1][1]), triple_of(p.derivative[0][2]) };
	const surface_third third = { triple_of(p.derivative[3][0]), triple_of(p.derivative[2][1]),
		                          triple_of(p.derivative[1][2]), triple_of(p.derivative[0][3]) };
	return surface_variation_of(jet, third, surface_shape_of(jet, 0));
}

static batten_surface *open_surface(batten_context *context, const batten_surface_net *net)
{
	batten_surface *surface = NULL;
	if (batten_surface_create(context, net, &surface) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return surface;
}

static void near(double found, long double expected, long double tolerance)
{
	if (!(fabsl(found - expected) <= tolerance))
		fail_msg("found %.17g, expected %.17Lg within %Lg", found, expected, tolerance);
}

/* Surfaces of any order, rational and not. The oracle differences curvatures; its own error and that
 * of rounding grow as the curvatures come together, so that these points have their bound widened by
 * what they are apart. */
static void drawn_surfaces_against_the_oracle(void **state)
{
	(void)state;
	uint64_t seed = 11;
	size_t compared = 0;
	batten_context *context = open_context();
	drawn d;
	for (size_t round = 0; round < 100; round++) {
		draw_net(&seed, 3 + round % 6, 3 + round / 6 % 6, round % 2, &d);
		batten_surface *surface = open_surface(context, &d.net);
		oracle_surface exact = as_oracle(&d.net);
		for (size_t i = 0; i < 10; i++) {
			double u = draw_real(&seed, d.knots_u[d.net.order_u - 1], d.knots_u[d.net.count_u]);
			double v = draw_real(&seed, d.knots_v[d.net.order_v - 1], d.knots_v[d.net.count_v]);
			oracle_jet jet;
			oracle_forms forms;
			assert_true(oracle_surface_at(&exact, u, v, jet));
			oracle_surface_forms(jet, &forms);
			long double size = hypotl(forms.k[0], forms.k[1]), apart = forms.k[1] - forms.k[0];
			if (!(apart > 0.1L * size))
				continue;
			surface_variation found = variation_at(surface, u, v);
			long double expected = oracle_surface_variation(&exact, u, v, 0);
			assert_true(found.known);
			near(found.density, expected, 1e-8L * fmaxl(expected, size * size * size * size));
			compared++;
		}
		batten_surface_destroy(surface);
	}
	assert_true(compared > 800);
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Closed forms
 * --------------------------------------------------------------------------------------------- */

/* A surface point of formulas: derivatives by u and v. */
typedef struct formula {
	surface_jet jet;
	surface_third third;
} formula;

static surface_variation variation_of(const formula *f)
{
	return surface_variation_of(f->jet, f->third, surface_shape_of(f->jet, 0));
}

/* The same point in other parameters: u = p + slant q, v = q. */
static formula slanted(const formula *f, double slant)
{
	const surface_jet j = f->jet;
	const surface_third t = f->third;
	formula s = *f;
	s.jet.v = triple_add(slant, j.u, j.v);
	s.jet.uv = triple_add(slant, j.uu, j.uv);
	s.jet.vv = triple_add(slant * slant, j.uu, triple_add(2 * slant, j.uv, j.vv));
	s.third.uuv = triple_add(slant, t.uuu, t.uuv);
	s.third.uvv = triple_add(slant * slant, t.uuu, triple_add(2 * slant, t.uuv, t.uvv));
	s.third.vvv = triple_add(
		slant * slant * slant, t.uuu,
		triple_add(3 * slant * slant, t.uuv, triple_add(3 * slant, t.uvv, t.vvv)));
	return s;
}

static surface_triple at(double x, double y, double z)
{
	return (surface_triple){ x, y, z };
}

/* y = x^3 - x drawn along z: dk/ds of the curve, y'' / (1 + y'^2)^(3/2). */
static void cylinders_over_a_curve(void **state)
{
	(void)state;
	const surface_triple none = triple_zero();
	for (int i = -8; i <= 8; i++) {
		const double x = i / 8.0 + 0.01, y1 = 3 * x * x - 1, y2 = 6 * x, y3 = 6;
		const double q = 1 + y1 * y1;
		const double slope = (y3 * q - 3 * y1 * y2 * y2) / (q * q * q);
		const formula f = { { at(x, x * x * x - x, 0), at(1, y1, 0), at(0, 0, 1), at(0, y2, 0),
			                  none, none },
			                { at(0, y3, 0), none, none, none } };
		for (double slant = -1; slant <= 2; slant += 1.5) {
			const formula s = slanted(&f, slant);
			const surface_variation found = variation_of(&s);
			assert_true(found.known);
			near(found.density, slope * slope, 1e-12 * slope * slope);
		}
	}
}

/* Circular cone with half angle a: along the parallels nothing changes, and nothing along the
 * rulings, which are straight. */
static void cones_have_none(void **state)
{
	(void)state;
	for (int i = 0; i < 12; i++) {
		const double angle = 0.5 * i, c = cos(angle), s = sin(angle), w = 0.5 + 0.25 * i;
		const surface_triple none = triple_zero();
		const formula f = {
			{ at(w * c, w * s, 2 * w), at(-w * s, w * c, 0), at(c, s, 2), at(-w * c, -w * s, 0),
			  at(-s, c, 0), none },
			{ at(w * s, -w * c, 0), at(-c, -s, 0), none, none },
		};
		const formula other = slanted(&f, 0.7);
		assert_true(variation_of(&f).known && variation_of(&other).known);
		near(variation_of(&f).density, 0, 1e-24);
		near(variation_of(&other).density, 0, 1e-22);
	}
}

/* A torus, R and r: circles both ways, along each of which its own curvature is the same. */
static void tori_have_none(void **state)
{
	(void)state;
	const double R = 3, r = 1;
	for (int i = 0; i < 144; i++) {
		const double u = 0.5 * (i % 12) + 0.1, v = 0.5 * (i / 12) + 0.2;
		const double c = cos(u), s = sin(u), cv = cos(v), sv = sin(v), q = R + r * cv;
		const formula f = {
			{ at(q * c, q * s, r * sv), at(-q * s, q * c, 0), at(-r * sv * c, -r * sv * s, r * cv),
			  at(-q * c, -q * s, 0), at(r * sv * s, -r * sv * c, 0),
			  at(-r * cv * c, -r * cv * s, -r * sv) },
			{ at(q * s, -q * c, 0), at(r * sv * c, r * sv * s, 0), at(r * cv * s, -r * cv * c, 0),
			  at(r * sv * c, r * sv * s, -r * cv) },
		};
		const formula other = slanted(&f, 0.7);
		assert_true(variation_of(&f).known && variation_of(&other).known);
		near(variation_of(&f).density, 0, 1e-24);
		near(variation_of(&other).density, 0, 1e-22);
	}
}

/* A principal curvature of the ellipsoid with half-axes a, from its K and H in closed form; u runs
 * round, v up; convex is negative. */
static long double ellipsoid_curvature(const double axis[3], long double u, long double v,
                                       int which)
{
	const long double x[3] = { axis[0] * cosl(u) * cosl(v), axis[1] * sinl(u) * cosl(v),
		                       axis[2] * sinl(v) };
	long double slope = 0, trace = 0, product = 1;
	for (size_t c = 0; c < 3; c++) {
		const long double square = (long double)axis[c] * axis[c];
		slope += x[c] * x[c] / (square * square);
		trace += square - x[c] * x[c];
		product *= square;
	}
	const long double gauss = 1 / (product * slope * slope);
	const long double mean = -trace / (2 * product * slope * sqrtl(slope));
	return mean + which * sqrtl(mean * mean - gauss);
}

static formula ellipsoid(const double a[3], double u, double v)
{
	const double c = cos(u), s = sin(u), cv = cos(v), sv = sin(v);
	const double ax = a[0], ay = a[1], az = a[2];
	return (formula){
		{ at(ax * c * cv, ay * s * cv, az * sv), at(-ax * s * cv, ay * c * cv, 0),
		  at(-ax * c * sv, -ay * s * sv, az * cv), at(-ax * c * cv, -ay * s * cv, 0),
		  at(ax * s * sv, -ay * c * sv, 0), at(-ax * c * cv, -ay * s * cv, -az * sv) },
		{ at(ax * s * cv, -ay * c * cv, 0), at(ax * c * sv, ay * s * sv, 0),
		  at(ax * s * cv, -ay * c * cv, 0), at(ax * c * sv, ay * s * sv, -az * cv) },
	};
}

/* Along the equator v = 0, a line of curvature, k = -1 / (sqrt(m) e); the other curvature does not
 * change there along v, by symmetry. */
static void ellipsoids_on_the_equator(void **state)
{
	(void)state;
	static const double a[3] = { 4, 1, 2 };
	for (int i = 0; i < 24; i++) {
		const double u = 0.26 * i + 0.05, c = cos(u), s = sin(u);
		const double e = a[0] * a[0] * s * s + a[1] * a[1] * c * c;
		const double m = c * c / (a[0] * a[0]) + s * s / (a[1] * a[1]);
		const double e_u = 2 * s * c * (a[0] * a[0] - a[1] * a[1]);
		const double m_u = 2 * s * c * (1 / (a[1] * a[1]) - 1 / (a[0] * a[0]));
		const double slope = (m_u / (2 * m) + e_u / e) / (sqrt(m) * e) / sqrt(e);
		const formula f = ellipsoid(a, u, 0), other = slanted(&f, -0.4);
		assert_true(variation_of(&f).known);
		near(variation_of(&f).density, slope * slope, 1e-12 * slope * slope);
		near(variation_of(&other).density, slope * slope, 1e-11 * slope * slope);
	}
}

/* Anywhere on an ellipsoid: each principal curvature differenced along the direction found here. */
static void ellipsoids_anywhere(void **state)
{
	(void)state;
	static const double a[3] = { 3, 1, 2 };
	for (int i = 0; i < 60; i++) {
		const double u = 0.37 * i, v = -1.2 + 0.04 * i;
		const formula f = ellipsoid(a, u, v);
		const surface_shape shape = surface_shape_of(f.jet, 0);
		const surface_axes axes = surface_axes_of(shape);
		const surface_pair pairs[2] = { axes.first, axes.second };
		const surface_variation found = variation_of(&f);
		const double along[2] = { found.along_1, found.along_2 };
		if (!(ellipsoid_curvature(a, u, v, 1) - ellipsoid_curvature(a, u, v, -1) > 0.05L))
			continue;
		assert_true(axes.apart);
		for (int k = 0; k < 2; k++) {
			/* here the normal points inward, there outward */
			const int which = k == 0 ? -1 : 1;
			const surface_triple e = triple_add(pairs[k].v, f.jet.v,
			                                    triple_scale(pairs[k].u, f.jet.u));
			near(triple_inner(e, e), 1, 1e-12);
			long double sum = 0;
			static const long double weight[] = { 672, -168, 32, -3 }; /* of 840, order 8 */
			const long double h = 1e-3L;
			for (int n = 1; n <= 4; n++)
				sum += weight[n - 1] * (ellipsoid_curvature(a, u + n * h * pairs[k].u,
				                                            v + n * h * pairs[k].v, which) -
				                        ellipsoid_curvature(a, u - n * h * pairs[k].u,
				                                            v - n * h * pairs[k].v, which));
			const long double slope = sum / (840 * h);
			near(-along[k], slope, 1e-8L * fmaxl(fabsl(slope), 1e-2L));
		}
	}
}

/* ------------------------------------------------------------------------------------------------
 * Points without directions
 * --------------------------------------------------------------------------------------------- */

static void known_nothing(const formula *f)
{
	const surface_variation found = variation_of(f);
	assert_false(found.known);
	assert_true(found.density == 0 && found.along_1 == 0 && found.along_2 == 0);
}

static void spheres_planes_and_points_are_left_out(void **state)
{
	(void)state;
	static const double ball[3] = { 2, 2, 2 };
	for (int i = 0; i < 50; i++) {
		const formula f = ellipsoid(ball, 0.3 * i, -1.4 + 0.05 * i), s = slanted(&f, 0.8);
		known_nothing(&f);
		known_nothing(&s);
	}
	const surface_triple none = triple_zero();
	const formula plane = { { none, at(1, 0, 0), at(0, 1, 0), none, none, none },
		                    { none, none, none, none } };
	known_nothing(&plane);
	formula pole = plane;
	pole.jet.u = none; /* both derivatives must differ from 0 */
	pole.third.uuu = at(1, 2, 3);
	known_nothing(&pole);
	formula squashed = plane;
	squashed.jet.u = squashed.jet.v;
	squashed.jet.uu = at(0, 0, 1);
	known_nothing(&squashed);
	/* nothing is NaN where numbers run over */
	formula large = plane;
	large.jet.uu = at(0, 0, 1);
	large.third.uuu = at(0, 0, 1e300);
	known_nothing(&large);
	large.third.uuu = at(0, 0, INFINITY);
	known_nothing(&large);
}

/* The limit: just beyond it a point has directions, just below it none. */
static void the_umbilic_limit(void **state)
{
	(void)state;
	const surface_triple none = triple_zero();
	for (int above = 0; above < 2; above++) {
		const double apart = SURFACE_UMBILIC_F64 * sqrt(2.0) * (above ? 1.01 : 0.99);
		const formula f = { { none, at(1, 0, 0), at(0, 1, 0), at(0, 0, 1 + apart), none,
			                  at(0, 0, 1) },
			                { at(0, 0, 3), none, none, at(0, 0, 4) } };
		assert_int_equal(variation_of(&f).known, above);
		near(variation_of(&f).density, above ? 25 : 0, 1e-9);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Integrals
 * --------------------------------------------------------------------------------------------- */

static long double density_of(const oracle_jet d, const oracle_forms *forms, const void *data)
{
	const oracle_surface *surface = data;
	(void)forms;
	const long double sum = oracle_surface_variation(surface, d[0][0][0] / 4, d[0][0][2], 1e-9L);
	return isnan(sum) ? 0 : sum;
}

/* A net whose parameters are u = x / 4 and z, with no umbilic: y = z^2 (1 + u / 4) + u^2 / 8, u to 2
 * and z to 1. */
static const double graph_u[] = { 0, 0, 0, 2, 2, 2 }, graph_v[] = { 0, 0, 0, 1, 1, 1 };
/* clang-format off */
static const double graph_poles[27] = {
	0, 0, 0,    4, 0, 0,     8, 0.5, 0,
	0, 0, 0.5,  4, 0, 0.5,   8, 0.5, 0.5,
	0, 1, 1,    4, 1.25, 1,  8, 2, 1,
};
/* clang-format on */

static batten_status integrate(batten_context *context, const batten_surface *surface,
                               unsigned points, batten_surface_energies *found)
{
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.gauss_points = points;
	options.variation = true;
	return batten_surface_energy_batch(context, 1, &surface, &options, found, NULL);
}

static void integrals_against_the_oracle(void **state)
{
	(void)state;
	batten_context *context = open_context();
	const batten_surface_net net = { NULL, 3, 3, 3, 3, graph_u, graph_v, graph_poles, NULL };
	batten_surface *surface = open_surface(context, &net);
	oracle_surface exact = as_oracle(&net);
	long double right;
	batten_surface_energies found, coarse, again;
	assert_true(oracle_surface_integral(&exact, 16, density_of, &exact, &right, NULL));
	assert_int_equal(integrate(context, surface, 16, &found), BATTEN_OK);
	assert_int_equal(found.variation_left_out, 0);
	near(found.variation_per_m2, right, 1e-8L * right);
	/* the same points whatever says so; a finer description of the surface changes nothing */
	assert_int_equal(integrate(context, surface, 0, &coarse), BATTEN_OK);
	assert_int_equal(integrate(context, surface, 4, &again), BATTEN_OK);
	assert_true(coarse.variation_per_m2 == again.variation_per_m2);
	assert_int_equal(batten_surface_insert_knot(surface, BATTEN_DIRECTION_U, 1, 1), BATTEN_OK);
	assert_int_equal(batten_surface_elevate(surface, BATTEN_DIRECTION_V, 2), BATTEN_OK);
	assert_int_equal(integrate(context, surface, 16, &again), BATTEN_OK);
	near(again.variation_per_m2, right, 1e-8L * right);
	/* 1 / m^2: half as large at twice the size is a fourth */
	static const double twice[9] = { 0, 0, 2, 2, 0, 0, 0, 2, 0 }, nowhere[3] = { 5, 1, 2 };
	assert_int_equal(batten_surface_map(surface, twice, nowhere), BATTEN_OK);
	assert_int_equal(integrate(context, surface, 16, &again), BATTEN_OK);
	near(again.variation_per_m2, right / 4, 1e-8L * right);
	/* the mirror changes nothing */
	batten_surface_mirror(surface);
	assert_int_equal(integrate(context, surface, 16, &found), BATTEN_OK);
	near(found.variation_per_m2, again.variation_per_m2, 1e-12L * again.variation_per_m2);
	assert_int_equal(integrate(context, surface, 17, &found), BATTEN_USAGE);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* An octant of the ball: every point is left out, those of its pole too. */
static void a_sphere_has_no_variation(void **state)
{
	(void)state;
	static const double knots[] = { 0, 0, 0, 1, 1, 1 };
	static const double circle[3][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 } }, weight[] = { 1, 1, 2 };
	double poles[27], weights[9];
	for (size_t n = 0; n < 9; n++) {
		poles[3 * n] = circle[n % 3][0] * circle[n / 3][0];
		poles[3 * n + 1] = circle[n % 3][1] * circle[n / 3][0];
		poles[3 * n + 2] = circle[n / 3][1];
		weights[n] = weight[n % 3] * weight[n / 3];
	}
	batten_context *context = open_context();
	const batten_surface_net net = { NULL, 3, 3, 3, 3, knots, knots, poles, weights };
	batten_surface *surface = open_surface(context, &net);
	batten_surface_energies sum;
	assert_int_equal(integrate(context, surface, 8, &sum), BATTEN_OK);
	assert_true(sum.variation_per_m2 == 0);
	assert_int_equal(sum.variation_left_out, 64);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(drawn_surfaces_against_the_oracle),
		cmocka_unit_test(cylinders_over_a_curve),
		cmocka_unit_test(cones_have_none),
		cmocka_unit_test(tori_have_none),
		cmocka_unit_test(ellipsoids_on_the_equator),
		cmocka_unit_test(ellipsoids_anywhere),
		cmocka_unit_test(spheres_planes_and_points_are_left_out),
		cmocka_unit_test(the_umbilic_limit),
		cmocka_unit_test(integrals_against_the_oracle),
		cmocka_unit_test(a_sphere_has_no_variation),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
