/* Curves: closed forms (Letcher 3), polynomials that come back, ends, and what is refused. */
#include "bspline_fixture.h"
#include "geometry/curve.h"
#include "oracle/oracle.h"
#include "support/failing_heap.h"

#define PI 3.14159265358979323846

static batten_points *points_of(batten_context *context, size_t dimension, size_t count,
                                const double *m)
{
	batten_points *points = NULL;
	if (batten_points_create(context, "line", dimension, count, m, &points) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return points;
}

static batten_curve_options options_of(batten_curve_form form, batten_curve_parameter parameter)
{
	batten_curve_options options;
	batten_curve_options_default(&options);
	options.form = form;
	options.parameter = parameter;
	return options;
}

static batten_curve *curve_of(batten_context *context, size_t dimension, size_t count,
                              const double *m, const batten_curve_options *options)
{
	batten_points *points = points_of(context, dimension, count, m);
	batten_curve *curve = NULL;
	if (batten_curve_create(context, points, options, &curve) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	batten_points_destroy(points);
	return curve;
}

static batten_curve_measures measures_of(batten_context *context, const batten_curve *curve)
{
	batten_curve_measures measures;
	assert_int_equal(batten_curve_measure(context, curve, &measures), BATTEN_OK);
	return measures;
}

static batten_curve_point at(const batten_curve *curve, double t)
{
	batten_curve_point point;
	assert_int_equal(batten_curve_evaluate(curve, t, &point), BATTEN_OK);
	return point;
}

/* C1: a straight line has no curvature, a line in a plane no torsion; both in every form. */
static void straight_and_plane(void **state)
{
	const double straight[] = { 0, 1, 0, 1, 3, 1, 3, 7, 3, 4, 9, 4 };
	double plane[12];
	for (size_t i = 0; i < 4; i++) {
		double x = straight[3 * i];
		plane[3 * i] = x;
		plane[3 * i + 1] = x * x;
		plane[3 * i + 2] = 2 * x - x * x;
	}
	for (int form = 0; form <= BATTEN_CURVE_BSPLINE_FIT; form++) {
		batten_curve_options options = options_of((batten_curve_form)form, BATTEN_PARAMETER_CHORD);
		batten_curve *curve = curve_of(*state, 3, 4, straight, &options);
		batten_curve_measures measures = measures_of(*state, curve);
		assert_close(measures.length_m, sqrt(16 + 64 + 16), 1e-13);
		assert_close(measures.curvature_max_per_m, 0, 1e-12);
		assert_true(measures.monotone_pieces == 1);
		batten_curve_destroy(curve);
		curve = curve_of(*state, 3, 4, plane, &options);
		for (double part = 0.05; part < 1; part += 0.1) {
			double first = 0, last = 0;
			batten_curve_range(curve, &first, &last);
			assert_close(at(curve, first + part * (last - first)).torsion_per_m, 0, 1e-11);
		}
		batten_curve_destroy(curve);
	}
}

/* C1: a circle. Clamped along its own tangents the spline is of the fourth order. */
static void circle(void **state)
{
	double error[2];
	for (size_t turn = 0; turn < 2; turn++) {
		size_t count = (size_t)17 << turn;
		double m[2 * 34];
		for (size_t i = 0; i < count; i++) {
			double angle = PI * (double)i / (double)(count - 1);
			m[2 * i] = 3 * cos(angle);
			m[2 * i + 1] = 3 * sin(angle);
		}
		batten_curve_options options = options_of(BATTEN_CURVE_SPLINE, BATTEN_PARAMETER_CHORD);
		options.ends[0] = (batten_curve_end){ BATTEN_END_CLAMPED, { 0, 1 }, { 0 } };
		options.ends[1] = (batten_curve_end){ BATTEN_END_CLAMPED, { 0, -1 }, { 0 } };
		batten_curve *curve = curve_of(*state, 2, count, m, &options);
		batten_curve_measures measures = measures_of(*state, curve);
		assert_close(measures.curvature_max_per_m, 1.0 / 3, 4e-3);
		assert_true(measures.inflections == 0);
		assert_close(measures.energy_bending_per_m, PI / 3, 1e-4);
		assert_true(at(curve, 1).curvature_per_m > 0);
		error[turn] = fabs(measures.length_m - 3 * PI);
		batten_curve_destroy(curve);
	}
	assert_true(error[0] < 1e-4 && error[1] < error[0] / 10);
}

/* C2: y = x^2 as a Bezier curve. */
static void parabola(void **state)
{
	const double m[] = { -1, 1, 0, -1, 1, 1 };
	batten_curve_options options = options_of(BATTEN_CURVE_BEZIER, BATTEN_PARAMETER_CHORD);
	batten_curve *curve = curve_of(*state, 2, 3, m, &options);
	for (int i = 0; i <= 10; i++) {
		double x = -1 + 0.2 * i;
		batten_curve_point point = at(curve, 0.1 * i);
		double w = 1 + 4 * x * x;
		assert_close(point.derivative[0][1], x * x, 1e-15);
		assert_close(point.curvature_per_m, 2 / (w * sqrt(w)), 1e-14);
		assert_close(point.curvature_rate_per_m2, -24 * x / (w * w * w), 1e-13);
		assert_close(point.normal[0], -2 * x / sqrt(w), 1e-15);
	}
	double length = 0;
	assert_int_equal(batten_curve_length(curve, 0.5, 1, &length), BATTEN_OK);
	assert_close(length, 1.478942857544597, 1e-14);
	assert_int_equal(batten_curve_length(curve, 1, 0.5, &length), BATTEN_OK);
	assert_close(length, -1.478942857544597, 1e-14);
	batten_curve_measures measures = measures_of(*state, curve);
	assert_close(measures.curvature_max_per_m, 2, 1e-14);
	assert_true(measures.inflections == 0 && measures.monotone_pieces == 2);
	/* Integrals over x of k^2 ds = 4 w^-5/2 and (dk/ds)^2 ds = 576 x^2 w^-11/2, w = 1 + 4 x^2. */
	double bending = 0, variation = 0;
	enum { STEPS = 4000 };
	for (int i = 0; i <= STEPS; i++) {
		double x = -1 + 2.0 * i / STEPS;
		double w = 1 + 4 * x * x;
		double weight = (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2) * 2.0 / STEPS / 3;
		bending += weight * 4 * pow(w, -2.5);
		variation += weight * 576 * x * x * pow(w, -5.5);
	}
	assert_close(measures.energy_bending_per_m, bending, 1e-10);
	assert_close(measures.energy_mvc_per_m3, variation, 1e-9);
	batten_curve_destroy(curve);
}

/* C3: the twisted cubic (t, t^2, t^3), its frame at right angles throughout. */
static void twisted_cubic(void **state)
{
	const double m[] = { 0, 0, 0, 1.0 / 3, 0, 0, 2.0 / 3, 1.0 / 3, 0, 1, 1, 1 };
	batten_curve_options options = options_of(BATTEN_CURVE_BEZIER, BATTEN_PARAMETER_CHORD);
	batten_curve *curve = curve_of(*state, 3, 4, m, &options);
	batten_curve_point point = at(curve, 0);
	assert_close(point.curvature_per_m, 2, 1e-14);
	assert_close(point.torsion_per_m, 3, 1e-14);
	assert_close(point.tangent[0], 1, 1e-15);
	assert_close(point.normal[1], 1, 1e-15);
	assert_close(point.binormal[2], 1, 1e-15);
	point = at(curve, 0.5);
	assert_close(point.curvature_per_m, 0.952004740039, 1e-12);
	assert_close(point.torsion_per_m, 0.786885245902, 1e-12);
	batten_curve_measures measures = measures_of(*state, curve);
	assert_close(measures.length_m, 1.863022982513, 1e-12);
	assert_close(measures.torsion_max_per_m, 3, 1e-12);
	assert_true(isnan(measures.inflections));
	batten_curve_destroy(curve);
}

/* Newton's form through samples of a helix, whose curvature and torsion are constant. */
static void helix(void **state)
{
	enum { COUNT = 14 };
	double m[3 * COUNT], t[COUNT];
	for (size_t i = 0; i < COUNT; i++) {
		t[i] = 0.2 * (double)i;
		m[3 * i] = 2 * cos(t[i]);
		m[3 * i + 1] = 2 * sin(t[i]);
		m[3 * i + 2] = 0.5 * t[i];
	}
	batten_curve_options options = options_of(BATTEN_CURVE_NEWTON, BATTEN_PARAMETER_GIVEN);
	options.parameters = t;
	batten_curve *curve = curve_of(*state, 3, COUNT, m, &options);
	for (double s = 0.3; s < 2.4; s += 0.17) {
		assert_close(at(curve, s).curvature_per_m, 2 / 4.25, 1e-9);
		assert_close(at(curve, s).torsion_per_m, 0.5 / 4.25, 1e-8);
		assert_close(at(curve, s).curvature_rate_per_m2, 0, 1e-7);
		assert_close(at(curve, s).speed, sqrt(4.25), 1e-10);
	}
	batten_curve_destroy(curve);
}

/* C4: another parameter, the same curve: length and curvature over the arc stay. */
static void other_parameter(void **state)
{
	double m[2 * 7], chosen[7];
	for (size_t i = 0; i < 7; i++) {
		double t = (double)i / 6;
		m[2 * i] = t;
		m[2 * i + 1] = t * t;
		/* f(s) = (s + s^2) / 2 = t */
		chosen[i] = (sqrt(1 + 8 * t) - 1) / 2;
	}
	batten_curve_options options = options_of(BATTEN_CURVE_LAGRANGE, BATTEN_PARAMETER_X);
	batten_curve *plain = curve_of(*state, 2, 7, m, &options);
	options.parameter = BATTEN_PARAMETER_GIVEN;
	options.parameters = chosen;
	batten_curve *other = curve_of(*state, 2, 7, m, &options);
	for (double s = 0.05; s < 1; s += 0.1) {
		double t = (s + s * s) / 2;
		assert_close(at(other, s).derivative[0][0], t, 1e-13);
		assert_close(at(other, s).curvature_per_m, at(plain, t).curvature_per_m, 1e-10);
		assert_close(at(other, s).speed, at(plain, t).speed * (1 + 2 * s) / 2, 1e-11);
	}
	assert_close(measures_of(*state, other).length_m, measures_of(*state, plain).length_m, 1e-12);
	batten_curve_destroy(plain);
	batten_curve_destroy(other);
}

/* C6: two points close together; uniform knots make a loop there, chord length does not. */
static void uniform_knots_loop(void **state)
{
	const double x[] = { 0, 1, 1.05, 2, 3 };
	double m[10];
	for (size_t i = 0; i < 5; i++) {
		m[2 * i] = x[i];
		m[2 * i + 1] = x[i] * x[i];
	}
	for (int uniform = 0; uniform < 2; uniform++) {
		batten_curve_options options = options_of(
			BATTEN_CURVE_SPLINE, uniform ? BATTEN_PARAMETER_UNIFORM : BATTEN_PARAMETER_CHORD);
		batten_curve *curve = curve_of(*state, 2, 5, m, &options);
		batten_curve_measures measures = measures_of(*state, curve);
		double first = 0, last = 0, least = 1;
		batten_curve_range(curve, &first, &last);
		for (int i = 0; i <= 1000; i++)
			least = fmin(least, at(curve, first + (last - first) * i / 1000).derivative[1][0]);
		assert_true(uniform ? least < 0 : least > 0);
		assert_true(measures.inflections == (uniform ? 1 : 0));
		assert_close(measures.curvature_max_per_m, uniform ? 360 : 0.642, uniform ? 5 : 5e-4);
		batten_curve_destroy(curve);
	}
}

/* C7: a straight line and an arc that touches it: the curvature jumps by 1/R. C8: mirrored ends
 * leave the centreplane square to it. */
static void joints(void **state)
{
	/* Piecewise cubic: straight to (0, 0), then y = x^2 / 2 with curvature 1 at its start. */
	const double m[] = { -2, 0, -1, 0, 0, 0, 1, 0.5, 2, 2 };
	const double slopes[] = { 1, 0, 1, 0, 1, 0, 1, 1, 1, 2 };
	batten_curve_options options = options_of(BATTEN_CURVE_HERMITE, BATTEN_PARAMETER_X);
	options.slopes = slopes;
	batten_curve *curve = curve_of(*state, 2, 5, m, &options);
	batten_curve_measures measures = measures_of(*state, curve);
	assert_close(measures.curvature_jump_per_m, 1, 1e-8);
	assert_close(measures.kink_max_deg, 0, 1e-6);
	assert_true(isnan(measures.energy_mvc_per_m3) && !isnan(measures.energy_bending_per_m));
	batten_curve_destroy(curve);
	const double mirrored[] = { 1, 0, 1, 0.7, 2, 1, 4, 1 };
	options = options_of(BATTEN_CURVE_BSPLINE, BATTEN_PARAMETER_CHORD);
	curve = curve_of(*state, 2, 4, mirrored, &options);
	assert_close(at(curve, 0).tangent[0], 0, 1e-15);
	assert_close(at(curve, 0).tangent[1], 1, 1e-15);
	batten_curve_destroy(curve);
	/* A polyline has kinks, and then neither energies nor inflections. */
	options.order = 2;
	curve = curve_of(*state, 2, 4, mirrored, &options);
	measures = measures_of(*state, curve);
	assert_close(measures.kink_max_deg, 180 / PI * atan(1 / 0.3), 1e-9);
	assert_true(isnan(measures.energy_bending_per_m) && isnan(measures.inflections));
	batten_curve_destroy(curve);
}

/* Every form that can hold a polynomial gives it back, derivatives too. */
static void polynomials_come_back(void **state)
{
	enum { COUNT = 8 };
	static const struct {
		batten_curve_form form;
		size_t degree, order;
	} cases[] = {
		{ BATTEN_CURVE_MONOMIAL, 7, 0 },      { BATTEN_CURVE_LAGRANGE, 7, 0 },
		{ BATTEN_CURVE_NEWTON, 7, 0 },        { BATTEN_CURVE_LEAST_SQUARES, 1, 2 },
		{ BATTEN_CURVE_LEAST_SQUARES, 5, 6 }, { BATTEN_CURVE_LEAST_SQUARES, 7, 8 },
		{ BATTEN_CURVE_HERMITE, 2, 0 },       { BATTEN_CURVE_SPLINE, 3, 0 },
		{ BATTEN_CURVE_BSPLINE_FIT, 3, 4 },   { BATTEN_CURVE_BSPLINE_FIT, 6, 7 },
	};
	static const double x[COUNT] = { -1, -0.8, -0.1, 0.3, 0.9, 1.4, 1.6, 2 };
	for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++)
		for (size_t poles = 0; poles <= COUNT; poles++) {
			if (poles > 0 && (cases[k].form != BATTEN_CURVE_BSPLINE_FIT || poles < cases[k].order))
				continue;
			double m[2 * COUNT];
			for (size_t i = 0; i < COUNT; i++) {
				m[2 * i] = x[i];
				m[2 * i + 1] = pow(x[i], (double)cases[k].degree) - x[i];
			}
			batten_curve_options options = options_of(cases[k].form, BATTEN_PARAMETER_X);
			options.ends[0].kind = options.ends[1].kind = BATTEN_END_NOT_A_KNOT;
			options.pole_count = poles;
			if (cases[k].order > 0)
				options.order = cases[k].order;
			batten_curve *curve = curve_of(*state, 2, COUNT, m, &options);
			double d = (double)cases[k].degree;
			for (double s = -0.95; s < 2; s += 0.1) {
				batten_curve_point point = at(curve, s);
				double size = fmax(1, pow(2, d));
				assert_close(point.derivative[0][1], pow(s, d) - s, 1e-13 * size);
				assert_close(point.derivative[1][1], d * pow(s, d - 1) - 1, 1e-11 * size);
				assert_true(point.derivative[0][0] == s);
			}
			batten_curve_destroy(curve);
		}
}

/* Neville's scheme in long double. */
static long double neville(size_t count, const double *x, const double *y, long double at_x)
{
	long double p[64];
	for (size_t i = 0; i < count; i++)
		p[i] = y[i];
	for (size_t order = 1; order < count; order++)
		for (size_t i = 0; i + order < count; i++)
			p[i] = ((at_x - x[i + order]) * p[i] - (at_x - x[i]) * p[i + 1]) /
			       ((long double)x[i] - x[i + order]);
	return p[0];
}

/* Runge: equally spaced points of 1 / (1 + 25 x^2); the polynomial's deviation grows, the spline's
 * does not. At 11 points the largest is known: 1.9156. */
static void runge(void **state)
{
	double last_spline = 1;
	for (size_t count = 11; count <= 31; count += 10) {
		double m[2 * 31], x[31], y[31];
		for (size_t i = 0; i < count; i++) {
			m[2 * i] = x[i] = -1 + 2.0 * (double)i / (double)(count - 1);
			m[2 * i + 1] = y[i] = 1 / (1 + 25 * x[i] * x[i]);
		}
		for (int form = 0; form <= BATTEN_CURVE_NEWTON; form++) {
			batten_curve_options options = options_of((batten_curve_form)form, BATTEN_PARAMETER_X);
			batten_curve *curve = curve_of(*state, 2, count, m, &options);
			double worst = 0;
			/* What ill-conditioning costs is told by the deviation at the data: between them it
			 * grows by the Lebesgue constant, 2^n / (e n log n), and no more. */
			double deviation = measures_of(*state, curve).deviation_max_m;
			double n = (double)count - 1;
			double amplified = (deviation + 1e-15) * pow(2, n) / (2.7 * n * log(n)) * 4;
			assert_true(deviation < (count == 11 ? 1e-12 : count == 21 ? 1e-8 : 1e-5));
			assert_true(form != BATTEN_CURVE_LAGRANGE || deviation < 1e-14);
			for (int i = 0; i <= 2000; i++) {
				double s = -1 + i / 1000.0;
				double value = at(curve, s).derivative[0][1];
				double expected = (double)neville(count, x, y, s);
				assert_close(value, expected, 1e-9 * (1 + fabs(expected)) + amplified);
				worst = fmax(worst, fabs(value - 1 / (1 + 25 * s * s)));
			}
			if (count == 11)
				assert_close(worst, 1.9156, 2e-4);
			else
				assert_true(worst > (count == 21 ? 50 : 1000));
			batten_curve_destroy(curve);
		}
		batten_curve_options options = options_of(BATTEN_CURVE_SPLINE, BATTEN_PARAMETER_X);
		batten_curve *curve = curve_of(*state, 2, count, m, &options);
		double worst = 0;
		for (int i = 0; i <= 2000; i++) {
			double s = -1 + i / 1000.0;
			batten_curve_point point = at(curve, s);
			if (i % 50 == 7) {
				long double oracle[3];
				assert_true(oracle_spline(count, x, y, ORACLE_NATURAL, s, oracle));
				for (size_t d = 0; d < 3; d++)
					assert_close(point.derivative[d][1], (double)oracle[d], 1e-11);
			}
			worst = fmax(worst, fabs(point.derivative[0][1] - 1 / (1 + 25 * s * s)));
		}
		assert_true(worst < 0.025 && worst < last_spline);
		last_spline = worst;
		batten_curve_destroy(curve);
	}
}

/* An end of given curvature has it; a circle's own curvature at its ends gives its tangents back. */
static void ends_of_given_curvature(void **state)
{
	const double m[] = { 0, 0, 1, 0.5, 2, 0.4, 3.5, 1 };
	for (int by_x = 0; by_x < 2; by_x++) {
		batten_curve_options options = options_of(
			BATTEN_CURVE_SPLINE, by_x ? BATTEN_PARAMETER_X : BATTEN_PARAMETER_CHORD);
		options.ends[0] = (batten_curve_end){ BATTEN_END_CURVATURE, { 0 }, { -0.3 } };
		options.ends[1] = (batten_curve_end){ BATTEN_END_CURVATURE, { 0 }, { 0.2 } };
		batten_curve *curve = curve_of(*state, 2, 4, m, &options);
		double first = 0, last = 0;
		batten_curve_range(curve, &first, &last);
		assert_close(at(curve, first).curvature_per_m, -0.3, 1e-11);
		assert_close(at(curve, last).curvature_per_m, 0.2, 1e-11);
		batten_curve_destroy(curve);
	}
	const double space[] = { 0, 0, 0, 1, 0.5, 0.1, 2, 0.4, 0.5, 3.5, 1, 0.4 };
	batten_curve_options options = options_of(BATTEN_CURVE_SPLINE, BATTEN_PARAMETER_CHORD);
	options.ends[0] = (batten_curve_end){ BATTEN_END_CURVATURE, { 0 }, { 0.1, 0.2, -0.1 } };
	batten_curve *curve = curve_of(*state, 3, 4, space, &options);
	batten_curve_point point = at(curve, 0);
	double along = 0.1 * point.tangent[0] + 0.2 * point.tangent[1] - 0.1 * point.tangent[2];
	const double asked[] = { 0.1, 0.2, -0.1 };
	for (size_t c = 0; c < 3; c++)
		assert_close(point.curvature_per_m * point.normal[c], asked[c] - along * point.tangent[c],
		             1e-11);
	batten_curve_destroy(curve);
	/* Not every curvature can be had. */
	options = options_of(BATTEN_CURVE_SPLINE, BATTEN_PARAMETER_X);
	options.ends[0] = (batten_curve_end){ BATTEN_END_CURVATURE, { 0 }, { 50 } };
	batten_points *points = points_of(*state, 2, 4, m);
	assert_refused(*state, batten_curve_create(*state, points, &options, &curve), BATTEN_INPUT,
	               "curvature asked for at an end");
	batten_points_destroy(points);
}

/* Least squares against the normal equations solved in long double would share its condition; what it
 * must do is leave a residual that no basis function sees. */
static void least_squares_residual(void **state)
{
	enum { COUNT = 30, DEGREE = 6 };
	double m[2 * COUNT];
	uint64_t seed = 5;
	for (size_t i = 0; i < COUNT; i++) {
		m[2 * i] = (double)i / 3;
		m[2 * i + 1] = random_between(&seed, -1, 1);
	}
	batten_curve_options options = options_of(BATTEN_CURVE_LEAST_SQUARES, BATTEN_PARAMETER_X);
	options.order = DEGREE + 1;
	batten_curve *curve = curve_of(*state, 2, COUNT, m, &options);
	for (int power = 0; power <= DEGREE; power++) {
		double sum = 0;
		for (size_t i = 0; i < COUNT; i++)
			sum += pow(m[2 * i] / 5 - 1, power) *
			       (at(curve, m[2 * i]).derivative[0][1] - m[2 * i + 1]);
		assert_close(sum, 0, 1e-12);
	}
	batten_curve_destroy(curve);
}

static void refusals(void **state)
{
	const double m[] = { 0, 0, 1, 1, 0.5, 2, 3, 3 };
	batten_points *points = NULL;
	batten_curve *curve = NULL;
	assert_refused(*state, batten_points_create(*state, NULL, 4, 2, m, &points), BATTEN_USAGE,
	               "dimension 4");
	assert_refused(*state, batten_points_create(*state, NULL, 2, 1, m, &points), BATTEN_USAGE,
	               "1 points");
	assert_refused(*state,
	               batten_points_create(*state, NULL, 2, 2, (double[]){ 0, NAN, 1, 1 }, &points),
	               BATTEN_USAGE, "not finite");
	assert_refused(*state,
	               batten_points_create(*state, NULL, 2, 2, (double[]){ 1, 2, 1, 2 }, &points),
	               BATTEN_USAGE, "repeats");
	assert_null(points);
	points = points_of(*state, 2, 4, m);
	struct {
		batten_curve_form form;
		batten_curve_parameter parameter;
		size_t order, poles;
		batten_status status;
		const char *words;
	} cases[] = {
		{ BATTEN_CURVE_LAGRANGE, BATTEN_PARAMETER_X, 4, 0, BATTEN_INPUT, "x to ascend" },
		{ BATTEN_CURVE_LAGRANGE, BATTEN_PARAMETER_GIVEN, 4, 0, BATTEN_USAGE, "not given" },
		{ BATTEN_CURVE_BSPLINE, BATTEN_PARAMETER_CHORD, 5, 0, BATTEN_USAGE, "at least as many" },
		{ BATTEN_CURVE_BSPLINE, BATTEN_PARAMETER_CHORD, 9, 0, BATTEN_USAGE, "2..8" },
		{ BATTEN_CURVE_BSPLINE_FIT, BATTEN_PARAMETER_CHORD, 3, 5, BATTEN_USAGE, "more than" },
		{ BATTEN_CURVE_LEAST_SQUARES, BATTEN_PARAMETER_CHORD, 5, 0, BATTEN_USAGE, "needs more" },
		{ BATTEN_CURVE_LEAST_SQUARES, BATTEN_PARAMETER_CHORD, 0, 0, BATTEN_USAGE, "order 0" },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		batten_curve_options options = options_of(cases[i].form, cases[i].parameter);
		options.order = cases[i].order;
		options.pole_count = cases[i].poles;
		assert_refused(*state, batten_curve_create(*state, points, &options, &curve),
		               cases[i].status, cases[i].words);
		assert_null(curve);
	}
	batten_points_destroy(points);
	/* One polynomial through too many points, and one that powers cannot hold any more. */
	double many[2 * 65];
	for (size_t i = 0; i < 65; i++)
		many[2 * i] = many[2 * i + 1] = (double)i;
	for (size_t count = 64; count <= 65; count++) {
		points = points_of(*state, 2, count, many);
		batten_curve_options options = options_of(BATTEN_CURVE_MONOMIAL, BATTEN_PARAMETER_X);
		assert_refused(*state, batten_curve_create(*state, points, &options, &curve),
		               count == 64 ? BATTEN_INPUT : BATTEN_USAGE,
		               count == 64 ? "cannot be told" : "64 at most");
		batten_points_destroy(points);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Memory
 * --------------------------------------------------------------------------------------------- */

static batten_status parse_and_measure(batten_context *context, void *user)
{
	static const char text[] = "# name: line\nx,y\n0,0\n1,1\n2,1.7\n3,2.1\n4,2.2\n";
	batten_points *points = NULL;
	batten_curve *curve = NULL;
	batten_curve_measures measures;
	batten_status status = batten_points_parse(context, "line.csv", text, sizeof text - 1, &points);
	if (status == BATTEN_OK)
		status = batten_curve_create(context, points, user, &curve);
	if (status == BATTEN_OK)
		status = batten_curve_measure(context, curve, &measures);
	batten_curve_destroy(curve);
	batten_points_destroy(points);
	return status;
}

static void memory_runs_out(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	for (int form = 0; form <= BATTEN_CURVE_BSPLINE_FIT; form++) {
		batten_curve_options chosen = options_of((batten_curve_form)form, BATTEN_PARAMETER_CHORD);
		assert_true(failing_heap_each(&heap, context, parse_and_measure, &chosen) >= 8);
	}
	failing_heap_close(&heap, context);
}

#define CURVE_TEST(name) cmocka_unit_test_setup_teardown(name, make_context, end_context)

int main(void)
{
	const struct CMUnitTest tests[] = {
		CURVE_TEST(straight_and_plane),
		CURVE_TEST(circle),
		CURVE_TEST(parabola),
		CURVE_TEST(twisted_cubic),
		CURVE_TEST(helix),
		CURVE_TEST(other_parameter),
		CURVE_TEST(uniform_knots_loop),
		CURVE_TEST(joints),
		CURVE_TEST(polynomials_come_back),
		CURVE_TEST(runge),
		CURVE_TEST(ends_of_given_curvature),
		CURVE_TEST(least_squares_residual),
		CURVE_TEST(refusals),
		CURVE_TEST(memory_runs_out),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
