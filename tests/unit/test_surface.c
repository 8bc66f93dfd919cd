/* Surfaces: the Wigley hull, quadrics, changes in place, and what is refused. */
#include "bspline_fixture.h"
#include "support/failing_heap.h"

enum { TRIALS = 40, SAMPLES = 12 };

/* All derivatives agree, relative to the size they can have. */
static void assert_same_surface(const batten_surface *a, const batten_surface *b, double tolerance)
{
	uint64_t seed = 31;
	double size_u = (double)a->order_u / shortest_span(a->order_u, a->count_u, a->knots_u);
	double size_v = (double)a->order_v / shortest_span(a->order_v, a->count_v, a->knots_v);
	for (int sample = 0; sample < SAMPLES; sample++) {
		double u;
		double v;
		surface_jet at_a;
		surface_jet at_b;
		random_place(a, &seed, &u, &v);
		surface_evaluate(a, u, v, 3, at_a);
		surface_evaluate(b, u, v, 3, at_b);
		for (size_t i = 0; i <= 3; i++)
			for (size_t j = 0; i + j <= 3; j++)
				assert_all_close(3, at_b[i][j], at_a[i][j],
				                 tolerance * pow(size_u, (double)i) * pow(size_v, (double)j));
	}
}

/* ------------------------------------------------------------------------------------------------
 * Wigley's parabolic hull: L = 100, B = 10, D = T = 6.25, z = 0 at the waterline
 * --------------------------------------------------------------------------------------------- */

static batten_surface *wigley(batten_context *context)
{
	static const double a[] = { 0, 2, 0 };
	static const double c[] = { 0, 1, 1 };
	double poles[27];
	for (size_t j = 0; j < 3; j++) {
		for (size_t i = 0; i < 3; i++) {
			double pole[3] = { 50 * (double)i, 5 * a[i] * c[j], -6.25 + 3.125 * (double)j };
			memcpy(poles + 3 * (3 * j + i), pole, sizeof pole);
		}
	}
	batten_surface_net net = {
		.name = "Wigley", .order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = poles
	};
	batten_surface *surface;
	assert_int_equal(batten_surface_create(context, &net, &surface), BATTEN_OK);
	return surface;
}

static double wigley_y(double x, double z)
{
	return 5 * 4 * (x / 100) * (1 - x / 100) * (1 - (z / 6.25) * (z / 6.25));
}

static void assert_wigley(const batten_surface *surface)
{
	for (int i = 0; i <= 20; i++) {
		for (int j = 0; j <= 20; j++) {
			surface_jet d;
			surface_evaluate(surface, i / 20., j / 20., 0, d);
			assert_close(d[0][0][0], 5 * i, 1e-13);
			assert_close(d[0][0][2], -6.25 + 6.25 * j / 20, 1e-14);
			assert_close(d[0][0][1], wigley_y(d[0][0][0], d[0][0][2]), 1e-14);
		}
	}
}

static void wigley_is_exact(void **state)
{
	static const double a[] = { 0, 4. / 3, 4. / 3, 0 };
	static const double c[] = { 0, 2. / 3, 1, 1 };
	batten_surface *surface = wigley(*state);
	assert_wigley(surface);
	assert_int_equal(batten_surface_elevate(surface, BATTEN_DIRECTION_U, 1), BATTEN_OK);
	assert_int_equal(batten_surface_elevate(surface, BATTEN_DIRECTION_V, 1), BATTEN_OK);
	batten_surface_net net = batten_surface_describe(surface);
	assert_int_equal(net.count_u, 4);
	assert_int_equal(net.count_v, 4);
	for (size_t j = 0; j < 4; j++) {
		for (size_t i = 0; i < 4; i++) {
			const double *pole = net.poles_m + 3 * (4 * j + i);
			assert_close(pole[0], 100 * (double)i / 3, 2e-14);
			assert_close(pole[1], 5 * a[i] * c[j], 2e-15);
			assert_close(pole[2], -6.25 + 6.25 * (double)j / 3, 2e-15);
		}
	}
	assert_wigley(surface);
	assert_int_equal(batten_surface_insert_knot(surface, BATTEN_DIRECTION_U, 0.3, 3), BATTEN_OK);
	assert_int_equal(batten_surface_insert_knot(surface, BATTEN_DIRECTION_V, 0.8, 1), BATTEN_OK);
	assert_wigley(surface);
	batten_surface_destroy(surface);
}

/* Worked out from the formula of the hull. Letcher measures x from the fore perpendicular; the hull
 * is the same at both ends, but for the sign of the normal's x. */
static void wigley_curvatures(void **state)
{
	/* x, z, K, H, normal */
	static const double cases[][7] = {
		{ 50, 0, 1.024e-3, -0.13, 0, 1, 0 },
		{ 50, -3.125, 2.85544318858e-4, -0.0621171615122, 0, .7808688094, -.6246950476 },
		{ 25, 0, 7.52867365945e-4, -0.0974939409338, -.09950371902, .9950371902, 0 },
		{ 25, -3.125, 1.71588058795e-4, -0.062223159651, -.06417938248, .8557250997, -.5134350598 },
		{ 75, -3.125, 1.71588058795e-4, -0.062223159651, .06417938248, .8557250997, -.5134350598 },
		{ 0, 0, 0, -0.00188573206864, -.1961161351, .9805806757, 0 },
		{ 10, -5, -1.0454695287e-3, -0.0359557313411, -.05224171436, .9069742076, -.4179337149 },
	};
	batten_surface *surface = wigley(*state);
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		const double *known = cases[i];
		struct shape s = shape_at(surface, known[0] / 100, 1 + known[1] / 6.25);
		assert_close(s.gauss, known[2], fmax(1e-14, 1e-10 * fabs(known[2])));
		assert_close(s.mean, known[3], 1e-10 * fabs(known[3]));
		assert_all_close(3, s.normal, known + 4, 1e-10);
	}
	/* K = 0 along q = (1 - s^2) / (1 + 3 s^2), above 0 nearer to the waterline. */
	for (int i = 1; i < 20; i++) {
		double s = i / 20.;
		double q = (1 - s * s) / (1 + 3 * s * s);
		double u = (1 - s) / 2;
		assert_close(shape_at(surface, u, 1 - sqrt(q)).gauss, 0, 1e-16);
		assert_true(shape_at(surface, u, 1 - 0.98 * sqrt(q)).gauss > 1e-8);
		assert_true(shape_at(surface, u, 1 - 1.02 * sqrt(q)).gauss < -1e-8);
	}
	batten_surface_destroy(surface);
}

/* ------------------------------------------------------------------------------------------------
 * Quadrics
 * --------------------------------------------------------------------------------------------- */

/* An eighth of an ellipsoid: a quarter circle turned by a quarter, as wide as the half axes. */
static batten_surface *ellipsoid(batten_context *context, const double axes[3])
{
	static const double x[] = { 1, 1, 0 };
	static const double y[] = { 0, 1, 1 };
	const double weight[] = { 1, sqrt(0.5), 1 };
	double poles[27];
	double weights[9];
	for (size_t j = 0; j < 3; j++) {
		for (size_t i = 0; i < 3; i++) {
			double pole[3] = { axes[0] * x[i] * x[j], axes[1] * y[i] * x[j], axes[2] * y[j] };
			memcpy(poles + 3 * (3 * j + i), pole, sizeof pole);
			weights[3 * j + i] = weight[i] * weight[j];
		}
	}
	batten_surface_net net = {
		.order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = poles, .weights = weights
	};
	batten_surface *surface;
	assert_int_equal(batten_surface_create(context, &net, &surface), BATTEN_OK);
	return surface;
}

static void sphere_and_ellipsoid(void **state)
{
	static const double round[] = { 2, 2, 2 };
	static const double long_axes[] = { 5, 2, 1 };
	batten_surface *sphere = ellipsoid(*state, round);
	batten_surface *hull = ellipsoid(*state, long_axes);
	assert_int_equal(batten_surface_insert_knot(sphere, BATTEN_DIRECTION_V, 0.7, 2), BATTEN_OK);
	assert_int_equal(batten_surface_elevate(hull, BATTEN_DIRECTION_U, 3), BATTEN_OK);
	for (int j = 0; j < 10; j++) { /* the pole at the end has no normal */
		for (int i = 0; i <= 10; i++) {
			surface_jet d;
			surface_evaluate(sphere, i / 10., j / 10., 0, d);
			assert_close(dot(d[0][0], d[0][0]), 4, 1e-14);
			struct shape s = shape_at(sphere, i / 10., j / 10.);
			assert_close(s.gauss, 0.25, 1e-12);
			assert_close(fabs(s.mean), 0.5, 1e-12);
			surface_evaluate(hull, i / 10., j / 10., 0, d);
			double sum = 0;
			double slope = 0; /* K = 1 / (abc)^2 / (x^2/a^4 + y^2/b^4 + z^2/c^4)^2 */
			for (size_t c = 0; c < 3; c++) {
				double part = d[0][0][c] / long_axes[c];
				sum += part * part;
				slope += part * part / (long_axes[c] * long_axes[c]);
			}
			assert_close(sum, 1, 1e-14);
			double expected = 1 / (100 * slope * slope);
			assert_close(shape_at(hull, i / 10., j / 10.).gauss, expected, 1e-11 * expected);
		}
	}
	batten_surface_destroy(sphere);
	batten_surface_destroy(hull);
}

/* ------------------------------------------------------------------------------------------------
 * Changes in place
 * --------------------------------------------------------------------------------------------- */

static void finer_nets_change_nothing(void **state)
{
	uint64_t seed = 40;
	for (int trial = 0; trial < TRIALS; trial++) {
		batten_surface *s = random_net(*state, &seed, trial % 3, trial % 2);
		batten_surface *finer = clone_of(s);
		batten_direction way = trial % 4 < 2 ? BATTEN_DIRECTION_U : BATTEN_DIRECTION_V;
		size_t order = way == BATTEN_DIRECTION_U ? s->order_u : s->order_v;
		double t = surface_place(s, way, random_between(&seed, 0.1, 0.9));
		size_t times = random_size(&seed, 1, order - 1);
		assert_int_equal(batten_surface_insert_knot(finer, way, t, times), BATTEN_OK);
		assert_int_equal(finer->count_u * finer->count_v,
		                 s->count_u * s->count_v +
		                     times * (way == BATTEN_DIRECTION_U ? s->count_v : s->count_u));
		assert_same_surface(s, finer, 1e-12);
		if (order < 8) {
			assert_int_equal(batten_surface_elevate(finer, way, 8 - order), BATTEN_OK);
			assert_same_surface(s, finer, 1e-11);
		}
		assert_int_equal(surface_check(finer), BATTEN_OK);
		assert_string_equal(batten_surface_describe(finer).name, "random");
		batten_surface_destroy(s);
		batten_surface_destroy(finer);
	}
}

static void reversing_and_mirroring(void **state)
{
	uint64_t seed = 41;
	for (int trial = 0; trial < TRIALS; trial++) {
		batten_surface *s = random_net(*state, &seed, trial % 3, trial % 2);
		batten_surface *back = clone_of(s);
		batten_direction way = trial % 4 < 2 ? BATTEN_DIRECTION_U : BATTEN_DIRECTION_V;
		batten_surface_reverse(back, way);
		assert_int_equal(surface_check(back), BATTEN_OK);
		double sum = surface_place(s, way, 0) + surface_place(s, way, 1);
		for (int sample = 0; sample < SAMPLES; sample++) {
			double u;
			double v;
			surface_jet a;
			surface_jet b;
			random_place(s, &seed, &u, &v);
			surface_evaluate(s, u, v, 0, a);
			surface_evaluate(back, way == BATTEN_DIRECTION_U ? sum - u : u,
			                 way == BATTEN_DIRECTION_V ? sum - v : v, 0, b);
			assert_all_close(3, b[0][0], a[0][0], 1e-13);
		}
		batten_surface_destroy(s);
		batten_surface_destroy(back);
	}
	batten_surface *port = wigley(*state);
	batten_surface *starboard = clone_of(port);
	batten_surface_mirror(starboard);
	for (int i = 0; i <= 10; i++) {
		struct shape a = shape_at(port, i / 10., 0.4);
		struct shape b = shape_at(starboard, 1 - i / 10., 0.4);
		assert_close(b.normal[0], a.normal[0], 1e-15);
		assert_close(b.normal[1], -a.normal[1], 1e-15);
		assert_true(a.normal[1] > 0); /* to the water */
		assert_close(b.normal[2], a.normal[2], 1e-15);
		assert_close(b.mean, a.mean, 1e-15);
	}
	batten_surface_destroy(port);
	batten_surface_destroy(starboard);
}

/* Beyond its range a surface goes on with the polynomials of its last spans. */
static void beyond_the_range(void **state)
{
	batten_surface *s = wigley(*state);
	batten_surface_point p;
	assert_int_equal(batten_surface_evaluate(s, 1.1, -0.2, &p), BATTEN_OK);
	assert_close(p.derivative[0][0][0], 110, 1e-13);
	assert_close(p.derivative[0][0][2], -7.5, 1e-14);
	assert_close(p.derivative[0][0][1], wigley_y(110, -7.5), 1e-14);
	assert_refused(*state, batten_surface_evaluate(s, NAN, 0, &p), BATTEN_USAGE, "not finite");
	assert_refused(*state, batten_surface_evaluate(s, 0, INFINITY, &p), BATTEN_USAGE, "not finite");
	batten_surface_destroy(s);
}

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static void a_surface_says_what_it_is(void **state)
{
	uint64_t seed = 42;
	const size_t orders[2] = { 3, 5 };
	const size_t counts[2] = { 6, 9 };
	batten_surface *s = random_surface(*state, &seed, orders, counts, false, true);
	batten_surface *clone = clone_of(s);
	batten_surface_net net = batten_surface_describe(clone);
	assert_string_equal(net.name, "random");
	assert_int_equal(net.order_u, 3);
	assert_int_equal(net.order_v, 5);
	assert_int_equal(net.count_u, 6);
	assert_int_equal(net.count_v, 9);
	assert_memory_equal(net.knots_u, s->knots_u, 9 * sizeof(double));
	assert_memory_equal(net.knots_v, s->knots_v, 14 * sizeof(double));
	assert_memory_equal(net.poles_m, s->poles, 3 * 54 * sizeof(double));
	assert_memory_equal(net.weights, s->weights, 54 * sizeof(double));
	assert_int_equal(batten_surface_set_poles(clone, s->poles), BATTEN_OK);
	s->poles[7] = NAN;
	assert_refused(*state, batten_surface_set_poles(clone, s->poles), BATTEN_USAGE,
	               "coordinate 2 of pole 3 is not finite");
	assert_true(isfinite(net.poles_m[7]));
	batten_surface_destroy(s);
	batten_surface_destroy(clone);
	batten_surface_destroy(NULL);
}

static void bad_nets_are_refused(void **state)
{
	static const double down[] = { 0, 0, 0.4, 0.2, 1, 1 };
	static const double twice[] = { 0, 0, 0.5, 0.5, 1, 1 };
	static const double good[12] = { 0 };
	static const double infinite[12] = { 0, 0, 0, 0, 0, INFINITY };
	static const double no_weight[4] = { 0 };
	static const double negative[4] = { 1, -1, 1, 1 };
	const struct {
		batten_surface_net net;
		const char *words;
	} cases[] = {
		{ { NULL, 2, 2, 2, 2, NULL, NULL, NULL, NULL }, "without poles" },
		{ { NULL, 1, 2, 2, 2, NULL, NULL, good, NULL }, "direction u: found order 1" },
		{ { NULL, 2, 9, 2, 2, NULL, NULL, good, NULL }, "direction v: found order 9" },
		{ { NULL, 3, 2, 2, 2, NULL, NULL, good, NULL }, "direction u: found 2 poles, order 3" },
		{ { NULL, 2, 2, 2, 5000, NULL, NULL, good, NULL }, "direction v: found 5000 poles" },
		{ { NULL, 2, 2, SIZE_MAX, 2, NULL, NULL, good, NULL }, "direction u: found 1844" },
		{ { NULL, 2, 2, 4, 1, down, NULL, good, NULL }, "direction v: found 1 poles" },
		{ { NULL, 2, 2, 2, 2, NULL, NULL, infinite, NULL }, "coordinate 3 of pole 2" },
		{ { NULL, 2, 2, 2, 2, NULL, NULL, good, no_weight }, "weight 1: found 0" },
		{ { NULL, 2, 2, 2, 2, NULL, NULL, good, negative }, "weight 2: found -1" },
		{ { "a\nb", 2, 2, 2, 2, NULL, NULL, good, NULL }, "byte 2 of a name" },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		batten_surface *s = (batten_surface *)(uintptr_t)1;
		assert_refused(*state, batten_surface_create(*state, &cases[i].net, &s), BATTEN_USAGE,
		               cases[i].words);
		assert_null(s);
	}
	static const double eight[24] = { 0 };
	batten_surface *s;
	batten_surface_net net = { NULL, 2, 2, 4, 2, down, NULL, eight, NULL };
	assert_refused(*state, batten_surface_create(*state, &net, &s), BATTEN_USAGE,
	               "knots_u: knot 4 (0.2) is below the one before");
	net = (batten_surface_net){ NULL, 2, 2, 2, 4, NULL, twice, eight, NULL };
	assert_refused(*state, batten_surface_create(*state, &net, &s), BATTEN_USAGE,
	               "knots_v: knot 0.5 occurs more than 1 times");
}

/* A change that fails leaves the surface as it was. */
static void changes_that_are_refused(void **state)
{
	static const double far[9] = { 1e9, 0, 0, 0, 1, 0, 0, 0, 1 };
	static const double none[3] = { 0, 0, 0 };
	batten_surface *s = wigley(*state);
	batten_surface *same = clone_of(s);
	assert_refused(*state, batten_surface_insert_knot(s, BATTEN_DIRECTION_U, 1, 1), BATTEN_USAGE,
	               "not inside the range 0..1");
	assert_refused(*state, batten_surface_insert_knot(s, BATTEN_DIRECTION_V, 0.5, 3), BATTEN_USAGE,
	               "can be inserted 2 times at order 3, not 3");
	assert_refused(*state, batten_surface_elevate(s, BATTEN_DIRECTION_V, 6), BATTEN_USAGE,
	               "gives order 9");
	assert_refused(*state, batten_surface_map(s, far, none), BATTEN_USAGE, "takes pole 2");
	assert_int_equal(batten_surface_insert_knot(s, BATTEN_DIRECTION_U, 7, 0), BATTEN_OK);
	assert_int_equal(batten_surface_elevate(s, BATTEN_DIRECTION_U, 0), BATTEN_OK);
	assert_int_equal(s->order_u + s->order_v + s->count_u + s->count_v, 12);
	assert_memory_equal(s->poles, same->poles, 27 * sizeof(double));
	assert_memory_equal(s->knots_u, same->knots_u, 6 * sizeof(double));
	batten_surface_destroy(s);
	batten_surface_destroy(same);
}

struct change {
	int number;
	const batten_surface *surface;
};

static batten_status clone_and_change(batten_context *context, void *user)
{
	const struct change *change = user;
	const batten_direction way = change->number % 2 ? BATTEN_DIRECTION_U : BATTEN_DIRECTION_V;
	batten_surface *s = NULL;
	batten_status status = batten_surface_clone(context, change->surface, &s);
	assert_int_equal(s != NULL, status == BATTEN_OK);
	if (s && change->number > 0) {
		status = change->number < 3 ? batten_surface_insert_knot(s, way, 0.4, 2)
		                            : batten_surface_elevate(s, way, 2);
		assert_int_equal(s->count_u * s->count_v > 9, status == BATTEN_OK);
		if (status != BATTEN_OK)
			assert_same_surface(change->surface, s, 0);
	}
	batten_surface_destroy(s);
	return status;
}

/* Whichever allocation fails: MEMORY, the surface as it was, nothing lost. */
static void memory_runs_out(void **state)
{
	static const double axes[3] = { 3, 2, 1 };
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_surface *surface = ellipsoid(*state, axes);
	size_t failed[5];
	for (int number = 0; number < 5; number++) {
		struct change change = { number, surface };
		failed[number] = failing_heap_each(&heap, context, clone_and_change, &change);
		assert_true(failed[number] > (number ? failed[0] : 0) && failed[number] < 59);
	}
	batten_surface_destroy(surface);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(wigley_is_exact),           cmocka_unit_test(wigley_curvatures),
		cmocka_unit_test(sphere_and_ellipsoid),      cmocka_unit_test(finer_nets_change_nothing),
		cmocka_unit_test(reversing_and_mirroring),   cmocka_unit_test(beyond_the_range),
		cmocka_unit_test(a_surface_says_what_it_is), cmocka_unit_test(bad_nets_are_refused),
		cmocka_unit_test(changes_that_are_refused),  cmocka_unit_test(memory_runs_out),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
