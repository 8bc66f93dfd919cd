/* Curves: what Letcher 3.7-3.8 says of B-splines, on random nets, and closed forms. */
#include "bspline_fixture.h"

enum { SAMPLES = 40, TRIALS = 60 };

static struct bspline_curve make_curve(batten_context *context, size_t order, size_t count,
                                       size_t dimension, const double *poles, const double *weights)
{
	double knots[FIXTURE_POLES_MOST + BSPLINE_ORDER_MOST];
	struct bspline_curve curve;
	bspline_knots_clamped(order, count, knots);
	struct bspline_curve_net net = { order, count, dimension, knots, poles, weights };
	assert_int_equal(bspline_curve_create(context, &net, &curve), BATTEN_OK);
	return curve;
}

/* Curvature of a curve in space, or in a plane when its third coordinate is 0. */
static double curvature_at(const struct bspline_curve *curve, double t)
{
	double v[9] = { 0 };
	double d[2][3] = { { 0 } };
	double binormal[3];
	bspline_curve_evaluate(curve, t, 2, v);
	for (size_t i = 0; i < 2; i++)
		for (size_t c = 0; c < curve->dimension; c++)
			d[i][c] = v[(i + 1) * curve->dimension + c];
	cross(d[0], d[1], binormal);
	return sqrt(dot(binormal, binormal)) / pow(dot(d[0], d[0]), 1.5);
}

static double torsion_at(const struct bspline_curve *curve, double t)
{
	double v[12];
	double binormal[3];
	bspline_curve_evaluate(curve, t, 3, v);
	cross(v + 3, v + 6, binormal);
	return dot(binormal, v + 9) / dot(binormal, binormal);
}

static double speed_at(const struct bspline_curve *curve, double t)
{
	double v[6];
	bspline_curve_evaluate(curve, t, 1, v);
	double sum = 0;
	for (size_t c = 0; c < curve->dimension; c++)
		sum += v[curve->dimension + c] * v[curve->dimension + c];
	return sqrt(sum);
}

/* Simpson over 2000 steps; the curves measured are one smooth span. */
static double length_between(const struct bspline_curve *curve, double a, double b)
{
	double sum = 0;
	for (int i = 0; i <= 2000; i++) {
		double factor = i == 0 || i == 2000 ? 1 : i % 2 ? 4 : 2;
		sum += factor * speed_at(curve, a + (b - a) * i / 2000);
	}
	return sum * (b - a) / 6000;
}

/* ------------------------------------------------------------------------------------------------
 * Properties
 * --------------------------------------------------------------------------------------------- */

static void ends_and_end_tangents(void **state)
{
	uint64_t seed = 11;
	for (int trial = 0; trial < TRIALS; trial++) {
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		struct bspline_curve c = random_curve(*state, &seed, order, count, true, trial % 2);
		double v[6];
		double gain = (double)(order - 1) / (c.knots[order] - c.knots[order - 1]);
		if (c.weights)
			gain *= c.weights[1] / c.weights[0];
		bspline_curve_evaluate(&c, curve_place(&c, 0), 1, v);
		for (size_t i = 0; i < 3; i++) {
			assert_close(v[i], c.poles[i], 1e-15);
			assert_close(v[3 + i], gain * (c.poles[3 + i] - c.poles[i]), 1e-13 * gain);
		}
		bspline_curve_evaluate(&c, curve_place(&c, 1), 0, v);
		assert_all_close(3, v, c.poles + 3 * (count - 1), 1e-15);
		bspline_curve_destroy(&c);
	}
}

static void end_speed_of_six_poles(void **state)
{
	static const double poles[] = { 1, 2, 4, 8, 3, 5 };
	struct bspline_curve c = make_curve(*state, 4, 6, 1, poles, NULL);
	double v[2];
	bspline_curve_evaluate(&c, 0, 1, v);
	assert_close(v[1], 9 * (poles[1] - poles[0]), 1e-14);
	bspline_curve_destroy(&c);
}

/* In any direction a point lies between the extremes of the poles of its span. */
static void within_the_hull_of_its_poles(void **state)
{
	uint64_t seed = 12;
	for (int trial = 0; trial < TRIALS; trial++) {
		size_t order = random_size(&seed, 2, 8);
		struct bspline_curve c = random_curve(*state, &seed, order, FIXTURE_POLES_MOST, trial % 3,
		                                      trial % 2);
		for (int sample = 0; sample < SAMPLES; sample++) {
			double t = curve_place(&c, random_between(&seed, 0, 1));
			size_t span = bspline_span(order, c.count, c.knots, t);
			double direction[3] = { random_between(&seed, -1, 1), random_between(&seed, -1, 1),
				                    random_between(&seed, -1, 1) };
			double low = INFINITY;
			double high = -INFINITY;
			double point[3];
			bspline_curve_evaluate(&c, t, 0, point);
			for (size_t i = span + 1 - order; i <= span; i++) {
				low = fmin(low, dot(direction, c.poles + 3 * i));
				high = fmax(high, dot(direction, c.poles + 3 * i));
			}
			assert_true(dot(direction, point) >= low - 1e-14);
			assert_true(dot(direction, point) <= high + 1e-14);
		}
		bspline_curve_destroy(&c);
	}
}

static void a_pole_moves_its_spans_only(void **state)
{
	uint64_t seed = 13;
	for (int trial = 0; trial < TRIALS; trial++) {
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		struct bspline_curve c = random_curve(*state, &seed, order, count, trial % 3, trial % 2);
		size_t pole = random_size(&seed, 0, count - 1);
		double before[3];
		double after[3];
		for (int sample = 0; sample < SAMPLES; sample++) {
			double t = curve_place(&c, random_between(&seed, 0, 1));
			bool within = t > c.knots[pole] && t < c.knots[pole + order];
			bspline_curve_evaluate(&c, t, 0, before);
			c.poles[3 * pole] += 1;
			bspline_curve_evaluate(&c, t, 0, after);
			c.poles[3 * pole] -= 1;
			assert_int_equal(before[0] != after[0], within);
			assert_true(before[1] == after[1]);
		}
		bspline_curve_destroy(&c);
	}
}

static void poles_on_a_line_make_a_straight_span(void **state)
{
	static const double poles[] = { 0, 1, 1, 3, 2, 2, 3, 3, 5, 5, 6, 6, 7, 0, 9, 4 };
	struct bspline_curve c = make_curve(*state, 4, 8, 2, poles, NULL);
	/* Poles 3 to 6 lie on y = x: the span from 2/5 to 3/5 is straight, its neighbours are not. */
	double v[2];
	for (int i = 0; i <= SAMPLES; i++) {
		double t = 0.4 + 0.2 * i / SAMPLES;
		bspline_curve_evaluate(&c, t, 0, v);
		assert_close(v[1], v[0], 4e-15);
		assert_close(curvature_at(&c, 0.401 + 0.198 * i / SAMPLES), 0, 1e-13);
	}
	bspline_curve_evaluate(&c, 0.3, 0, v);
	assert_true(fabs(v[1] - v[0]) > 1e-3);
	bspline_curve_destroy(&c);
}

static void order_two_is_the_polygon(void **state)
{
	static const double poles[] = { 0, 0, 1, 5, 2, -3, 7, 1 };
	struct bspline_curve c = make_curve(*state, 2, 4, 2, poles, NULL);
	double v[2];
	for (size_t i = 0; i < 4; i++) {
		bspline_curve_evaluate(&c, (double)i / 3, 0, v);
		assert_all_close(2, v, poles + 2 * i, 1e-15);
	}
	bspline_curve_evaluate(&c, 0.5, 0, v);
	assert_close(v[0], 1.5, 1e-15);
	assert_close(v[1], 1, 1e-15);
	bspline_curve_destroy(&c);
}

/* As many poles as the order: Bernstein's polynomials. */
static void bezier(void **state)
{
	uint64_t seed = 14;
	for (size_t order = 2; order <= 8; order++) {
		double poles[8];
		for (size_t i = 0; i < order; i++)
			poles[i] = random_between(&seed, -1, 1);
		struct bspline_curve c = make_curve(*state, order, order, 1, poles, NULL);
		for (int sample = 0; sample <= 10; sample++) {
			double t = sample / 10.;
			double sum = 0;
			double binomial = 1;
			for (size_t i = 0; i < order; i++) {
				double n = (double)(order - 1);
				sum += binomial * pow(t, (double)i) * pow(1 - t, n - (double)i) * poles[i];
				binomial = binomial * (n - (double)i) / (double)(i + 1);
			}
			double found;
			bspline_curve_evaluate(&c, t, 0, &found);
			assert_close(found, sum, 1e-14);
		}
		bspline_curve_destroy(&c);
	}
}

static void a_map_of_the_poles_maps_the_curve(void **state)
{
	static const double matrix[] = { 1.2, 0.3, 0, -0.5, 0.9, 2, 0.1, 0, -1.1 };
	static const double shift[] = { 3, -1, 0.5 };
	uint64_t seed = 15;
	for (int trial = 0; trial < TRIALS; trial++) {
		struct bspline_curve c = random_curve(*state, &seed, random_size(&seed, 2, 8), 12,
		                                      trial % 3, trial % 2);
		struct bspline_curve mapped;
		struct bspline_curve_net net = { c.order, c.count, 3, c.knots, c.poles, c.weights };
		assert_int_equal(bspline_curve_create(*state, &net, &mapped), BATTEN_OK);
		assert_int_equal(bspline_curve_map(&mapped, matrix, shift), BATTEN_OK);
		for (int sample = 0; sample <= 10; sample++) {
			double before[3];
			double after[3];
			double t = curve_place(&c, sample / 10.);
			bspline_curve_evaluate(&c, t, 0, before);
			bspline_curve_evaluate(&mapped, t, 0, after);
			for (size_t i = 0; i < 3; i++)
				assert_close(after[i], dot(matrix + 3 * i, before) + shift[i], 1e-14);
		}
		bspline_curve_destroy(&c);
		bspline_curve_destroy(&mapped);
	}
}

/* No plane cuts a curve more often than its polygon. */
static void variation_diminishes(void **state)
{
	uint64_t seed = 16;
	for (int trial = 0; trial < TRIALS; trial++) {
		struct bspline_curve c = random_curve(*state, &seed, random_size(&seed, 2, 8), 14,
		                                      trial % 3, trial % 2);
		double normal[3] = { random_between(&seed, -1, 1), random_between(&seed, -1, 1), 0.3 };
		double height = random_between(&seed, -0.3, 0.3);
		size_t polygon = 0;
		size_t curve = 0;
		double last = dot(normal, c.poles) - height;
		for (size_t i = 1; i < c.count; i++) {
			double now = dot(normal, c.poles + 3 * i) - height;
			polygon += (now > 0) != (last > 0);
			last = now;
		}
		for (int i = 0; i <= 2000; i++) {
			double point[3];
			bspline_curve_evaluate(&c, curve_place(&c, i / 2000.), 0, point);
			double now = dot(normal, point) - height;
			curve += i > 0 && (now > 0) != (last > 0);
			last = now;
		}
		assert_true(curve <= polygon);
		bspline_curve_destroy(&c);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Weights and conics
 * --------------------------------------------------------------------------------------------- */

static void weights(void **state)
{
	static const double poles[] = { 0, 0, 1, 2, 2, 2, 3, 0, 4, 1 };
	static const double equal[] = { 3, 3, 3, 3, 3 };
	struct bspline_curve plain = make_curve(*state, 3, 5, 2, poles, NULL);
	struct bspline_curve same = make_curve(*state, 3, 5, 2, poles, equal);
	double a[8];
	double b[8];
	for (int i = 0; i <= 10; i++) {
		bspline_curve_evaluate(&plain, i / 10., 3, a);
		bspline_curve_evaluate(&same, i / 10., 3, b);
		assert_all_close(8, b, a, 1e-13);
	}
	/* The heavier a pole, the nearer the curve. */
	double last = INFINITY;
	for (double weight = 1; weight < 1e8; weight *= 10) {
		same.weights[1] = 3 * weight;
		bspline_curve_evaluate(&same, 0.2, 0, a);
		double distance = hypot(a[0] - poles[2], a[1] - poles[3]);
		assert_true(distance < last);
		last = distance;
	}
	assert_true(last < 1e-6);
	bspline_curve_destroy(&plain);
	bspline_curve_destroy(&same);
	/* A pole of next to no weight is as good as none: the chord of the other two, all of it. */
	static const double light[] = { 1, 1e-9, 1 };
	struct bspline_curve chord = make_curve(*state, 3, 3, 2, poles, light);
	for (int i = 0; i <= 10; i++) {
		double t = i / 10.;
		double along = t * t / (t * t + (1 - t) * (1 - t));
		bspline_curve_evaluate(&chord, t, 0, a);
		assert_close(a[0], along * poles[4], 1e-8);
		assert_close(a[1], along * poles[5], 1e-8);
	}
	bspline_curve_destroy(&chord);
}

/* A quarter of a circle is a circle however it is described. */
static void quarter_circle(void **state)
{
	static const double radius = 3;
	static const double poles[] = { 3, 0, 3, 3, 0, 3 };
	const double corner[] = { 1, sqrt(0.5), 1 };
	struct bspline_curve c = make_curve(*state, 3, 3, 2, poles, corner);
	for (int form = 0; form < 4; form++) {
		for (int i = 0; i <= SAMPLES; i++) {
			double t = (double)i / SAMPLES;
			double v[8];
			bspline_curve_evaluate(&c, t, 3, v);
			assert_close(hypot(v[0], v[1]), radius, 4e-15);
			assert_close(v[0] * v[2] + v[1] * v[3], 0, 1e-13);
			/* Third derivative of x.x = R^2. */
			assert_close(v[0] * v[6] + v[1] * v[7] + 3 * (v[2] * v[4] + v[3] * v[5]), 0, 2e-11);
			assert_close(curvature_at(&c, t), 1 / radius, 1e-13);
		}
		if (form == 0)
			assert_int_equal(bspline_curve_insert_knot(&c, 0.3, 1), BATTEN_OK);
		else if (form == 1)
			assert_int_equal(bspline_curve_elevate(&c, 2), BATTEN_OK);
		else
			bspline_curve_reverse(&c);
	}
	assert_int_equal(c.order, 5);
	bspline_curve_destroy(&c);
}

/* ------------------------------------------------------------------------------------------------
 * Curvature, torsion, length
 * --------------------------------------------------------------------------------------------- */

static void straight_line(void **state)
{
	static const double poles[] = { 0, 0, 0, 1, 2, 3, 4, 8, 12, 5, 10, 15 };
	struct bspline_curve c = make_curve(*state, 4, 4, 3, poles, NULL);
	for (int i = 0; i <= 10; i++)
		assert_close(curvature_at(&c, i / 10.), 0, 1e-14);
	bspline_curve_destroy(&c);
}

static void parabola(void **state)
{
	static const double poles[] = { -1, 1, 0, -1, 1, 1 };
	struct bspline_curve c = make_curve(*state, 3, 3, 2, poles, NULL);
	for (int i = 0; i <= 10; i++) {
		double t = i / 10.;
		double x = 2 * t - 1;
		double v[2];
		bspline_curve_evaluate(&c, t, 0, v);
		assert_close(v[0], x, 1e-15);
		assert_close(v[1], x * x, 1e-15);
		assert_close(curvature_at(&c, t), 2 / pow(1 + 4 * x * x, 1.5), 1e-14);
	}
	assert_close(length_between(&c, 0.5, 1), 1.478942857544597, 1e-12);
	bspline_curve_destroy(&c);
}

static void twisted_cubic(void **state)
{
	static const double poles[] = { 0, 0, 0, 1. / 3, 0, 0, 2. / 3, 1. / 3, 0, 1, 1, 1 };
	struct bspline_curve c = make_curve(*state, 4, 4, 3, poles, NULL);
	assert_close(curvature_at(&c, 0), 2, 1e-14);
	assert_close(torsion_at(&c, 0), 3, 1e-14);
	assert_close(curvature_at(&c, 0.5), 0.952004740039, 1e-12);
	assert_close(torsion_at(&c, 0.5), 0.786885245902, 1e-12);
	assert_close(length_between(&c, 0, 1), 1.863022982513, 1e-12);
	bspline_curve_destroy(&c);
}

static void torsion_of_a_planar_curve(void **state)
{
	/* In the plane z = x + 2 y. */
	static const double poles[] = { 0, 0, 0, 1, 0, 1, 1, 1, 3, 2, 3, 8, 4, 1, 6 };
	struct bspline_curve c = make_curve(*state, 4, 5, 3, poles, NULL);
	for (int i = 0; i < 10; i++)
		assert_close(torsion_at(&c, i / 10.), 0, 1e-12);
	bspline_curve_destroy(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(ends_and_end_tangents),
		cmocka_unit_test(end_speed_of_six_poles),
		cmocka_unit_test(within_the_hull_of_its_poles),
		cmocka_unit_test(a_pole_moves_its_spans_only),
		cmocka_unit_test(poles_on_a_line_make_a_straight_span),
		cmocka_unit_test(order_two_is_the_polygon),
		cmocka_unit_test(bezier),
		cmocka_unit_test(a_map_of_the_poles_maps_the_curve),
		cmocka_unit_test(variation_diminishes),
		cmocka_unit_test(weights),
		cmocka_unit_test(quarter_circle),
		cmocka_unit_test(straight_line),
		cmocka_unit_test(parabola),
		cmocka_unit_test(twisted_cubic),
		cmocka_unit_test(torsion_of_a_planar_curve),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
