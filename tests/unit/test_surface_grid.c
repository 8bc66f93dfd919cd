/* Batches of surfaces on the C path against closed forms (geometry of the Wigley hull, spheres,
 * cylinders, saddles), against evaluation point by point, and what is refused. */
#include "support/surface_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = BATTEN_SURFACE_VALUE_COUNT };
static const double pi = 3.14159265358979323846;

static batten_surface *make(batten_context *context, const batten_surface_net *net)
{
	batten_surface *surface = NULL;
	if (batten_surface_create(context, net, &surface) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return surface;
}

/* L 100, B 10, D 6.25 m, exactly as a net of 3 x 3 (Letcher 4.1, equations 30 and 31). */
static batten_surface *make_wigley(batten_context *context)
{
	static const double a[] = { 0.0, 2.0, 0.0 };
	static const double c[] = { 0.0, 1.0, 1.0 };
	double poles[27];
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++) {
			double *pole = poles + 3 * (3 * k + i);
			pole[0] = 50.0 * i;
			pole[1] = 5.0 * a[i] * c[k];
			pole[2] = -6.25 + 3.125 * k;
		}
	return make(context,
	            &(batten_surface_net){
					.order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = poles });
}

/* The surface z = a x^2 + b y^2 + c x y over -1..1 both ways, as a quadratic Bezier patch: the second
 * pole of t^2 over -1..1 lies at -1, of t at 0. */
static batten_surface *make_paraboloid(batten_context *context, double a, double b, double c)
{
	double poles[27];
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++) {
			double *pole = poles + 3 * (3 * k + i);
			pole[0] = i - 1.0;
			pole[1] = k - 1.0;
			pole[2] = a * (i == 1 ? -1.0 : 1.0) + b * (k == 1 ? -1.0 : 1.0) + c * pole[0] * pole[1];
		}
	return make(context,
	            &(batten_surface_net){
					.order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = poles });
}

/* An eighth of a sphere, a pole of the parameters at v = 1 (Letcher 3.8: conics are exact). */
static batten_surface *make_sphere(batten_context *context, double radius)
{
	static const double across[] = { 1.0, 1.0, 0.0 };
	static const double along[] = { 0.0, 1.0, 1.0 };
	const double arc[] = { 1.0, sqrt(0.5), 1.0 };
	double poles[27];
	double weights[9];
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++) {
			const int n = 3 * k + i;
			poles[3 * n] = radius * across[k] * across[i];
			poles[3 * n + 1] = radius * across[k] * along[i];
			poles[3 * n + 2] = radius * along[k];
			weights[n] = arc[i] * arc[k];
		}
	return make(context, &(batten_surface_net){ .order_u = 3,
	                                            .order_v = 3,
	                                            .count_u = 3,
	                                            .count_v = 3,
	                                            .poles_m = poles,
	                                            .weights = weights });
}

/* Everything at one point. */
static bool evaluate(batten_context *context, const batten_surface *surface, double u, double v,
                     batten_precision precision, double values[COUNT])
{
	const batten_surface_samples samples = { 1, 1, &u, &v };
	const batten_surface_batch_options options = surface_case_options(
		BATTEN_DEVICE_REFERENCE, precision, BATTEN_SURFACE_EVERYTHING);
	uint8_t singular = 2;
	if (batten_surface_grid_batch(context, 1, &surface, &samples, &options, values, &singular,
	                              NULL) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	assert_true(singular < 2);
	return singular;
}

static void assert_near(double found, double wanted, double relative, double absolute)
{
	if (!(fabs(found - wanted) <= fmax(relative * fabs(wanted), absolute)))
		fail_msg("found %.17g, expected %.17g", found, wanted);
}

static void test_wigley_curvatures(void **state)
{
	(void)state;
	static const struct {
		double x, z, gauss, mean, normal[3];
	} table[] = {
		{ 50, 0, 1.024e-3, -0.13, { 0, 1, 0 } },
		{ 50, -3.125, 2.85544318858e-4, -0.0621171615122, { 0, .7808688094, -.6246950476 } },
		{ 25, 0, 7.52867365945e-4, -0.0974939409338, { -.09950371902, .9950371902, 0 } },
		{ 25,
		  -3.125,
		  1.71588058795e-4,
		  -0.062223159651,
		  { -.06417938248, .8557250997, -.5134350598 } },
		{ 75,
		  -3.125,
		  1.71588058795e-4,
		  -0.062223159651,
		  { .06417938248, .8557250997, -.5134350598 } },
		{ 0, 0, 0, -0.00188573206864, { -.1961161351, .9805806757, 0 } },
		{ 10,
		  -5,
		  -1.0454695287e-3,
		  -0.0359557313411,
		  { -.05224171436, .9069742076, -.4179337149 } },
	};
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	batten_surface *wigley = make_wigley(context);
	for (size_t p = 0; p < sizeof table / sizeof table[0]; p++) {
		double at[COUNT];
		const double u = table[p].x / 100.0;
		const double v = 1.0 + table[p].z / 6.25;
		assert_false(evaluate(context, wigley, u, v, BATTEN_F64, at));
		assert_near(at[BATTEN_SURFACE_VALUE_x], table[p].x, 1e-14, 1e-14);
		assert_near(at[BATTEN_SURFACE_VALUE_z], table[p].z, 1e-14, 1e-14);
		assert_near(at[BATTEN_SURFACE_VALUE_gauss], table[p].gauss, 1e-10, 1e-14);
		assert_near(at[BATTEN_SURFACE_VALUE_mean], table[p].mean, 1e-10, 0.0);
		for (int c = 0; c < 3; c++)
			assert_near(at[BATTEN_SURFACE_VALUE_normal_x + c], table[p].normal[c], 1e-9, 1e-15);
		assert_false(evaluate(context, wigley, u, v, BATTEN_F32, at));
		assert_near(at[BATTEN_SURFACE_VALUE_mean], table[p].mean, 2e-5, 0.0);
		assert_near(at[BATTEN_SURFACE_VALUE_gauss], table[p].gauss, 2e-5, 1e-8);
	}
	/* Principal curvatures amidships at the waterline: along x and along z. */
	double at[COUNT];
	assert_false(evaluate(context, wigley, 0.5, 1.0, BATTEN_F64, at));
	assert_near(at[BATTEN_SURFACE_VALUE_k1], -0.004, 1e-12, 0.0);
	assert_near(at[BATTEN_SURFACE_VALUE_k2], -0.256, 1e-13, 0.0);
	assert_near(at[BATTEN_SURFACE_VALUE_bending], 0.004 * 0.004 + 0.256 * 0.256, 1e-13, 0.0);
	batten_surface_destroy(wigley);
	batten_context_destroy(context);
}

/* On the Wigley hull K is 0 where (z/D)^2 = (1 - s^2) / (1 + 3 s^2), s = 1 - 2 x / L, and positive
 * above. */
static void test_wigley_line_of_no_gauss_curvature(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	batten_surface *wigley = make_wigley(context);
	for (int n = 1; n < 20; n++) {
		double at[COUNT];
		const double s = 1.0 - n / 10.0;
		const double depth = sqrt((1.0 - s * s) / (1.0 + 3.0 * s * s));
		assert_false(evaluate(context, wigley, n / 20.0, 1.0 - depth, BATTEN_F64, at));
		assert_near(at[BATTEN_SURFACE_VALUE_gauss], 0.0, 0.0, 1e-14);
		assert_false(evaluate(context, wigley, n / 20.0, 1.0 - 0.95 * depth, BATTEN_F64, at));
		assert_true(at[BATTEN_SURFACE_VALUE_gauss] > 1e-6);
		if (depth < 0.95) {
			assert_false(evaluate(context, wigley, n / 20.0, 1.0 - 1.05 * depth, BATTEN_F64, at));
			assert_true(at[BATTEN_SURFACE_VALUE_gauss] < -1e-6);
		}
	}
	batten_surface_destroy(wigley);
	batten_context_destroy(context);
}

/* z = x^2: K = 0; z = x y: K = -1 / (1 + x^2 + y^2)^2; z = x^2 + y^2: K = 4, |H| = 2 at the bottom. */
static void test_paraboloids(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	batten_surface *cylinder = make_paraboloid(context, 1.0, 0.0, 0.0);
	batten_surface *saddle = make_paraboloid(context, 0.0, 0.0, 1.0);
	batten_surface *bowl = make_paraboloid(context, 1.0, 1.0, 0.0);
	for (int n = 0; n < 121; n++) {
		double at[COUNT];
		const double u = (n % 11) / 10.0;
		const double v = (n / 11) / 10.0; /* NOLINT(bugprone-integer-division) */
		const double x = 2.0 * u - 1.0;
		const double y = 2.0 * v - 1.0;
		assert_false(evaluate(context, cylinder, u, v, BATTEN_F64, at));
		assert_near(at[BATTEN_SURFACE_VALUE_gauss], 0.0, 0.0, 1e-14);
		assert_near(fabs(at[BATTEN_SURFACE_VALUE_mean]), pow(1.0 + 4.0 * x * x, -1.5), 1e-13, 0.0);
		assert_false(evaluate(context, saddle, u, v, BATTEN_F64, at));
		assert_near(at[BATTEN_SURFACE_VALUE_gauss], -pow(1.0 + x * x + y * y, -2.0), 1e-13, 0.0);
		assert_near(at[BATTEN_SURFACE_VALUE_k1] * at[BATTEN_SURFACE_VALUE_k2],
		            at[BATTEN_SURFACE_VALUE_gauss], 1e-13, 0.0);
	}
	double at[COUNT];
	assert_false(evaluate(context, bowl, 0.5, 0.5, BATTEN_F64, at));
	assert_near(at[BATTEN_SURFACE_VALUE_gauss], 4.0, 1e-14, 0.0);
	assert_near(fabs(at[BATTEN_SURFACE_VALUE_mean]), 2.0, 1e-14, 0.0);
	batten_surface_destroy(cylinder);
	batten_surface_destroy(saddle);
	batten_surface_destroy(bowl);
	batten_context_destroy(context);
}

/* A sphere of radius R has K = 1 / R^2 everywhere and no normal where its parameters meet; its
 * energies do not depend on R. */
static void test_sphere(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	batten_surface *sphere = make_sphere(context, 5.0);
	double at[COUNT];
	for (int n = 0; n < 110; n++) {
		const double v = (n / 11) / 10.0; /* NOLINT(bugprone-integer-division) */
		assert_false(evaluate(context, sphere, (n % 11) / 10.0, v, BATTEN_F64, at));
		assert_near(hypot(hypot(at[0], at[1]), at[2]), 5.0, 1e-14, 0.0);
		assert_near(at[BATTEN_SURFACE_VALUE_gauss], 0.04, 1e-12, 0.0);
		assert_near(fabs(at[BATTEN_SURFACE_VALUE_mean]), 0.2, 1e-12, 0.0);
		/* Points off it along the outward normal lie on a sphere too (Letcher 4.13). */
		const double off = at[BATTEN_SURFACE_VALUE_mean] < 0.0 ? 0.7 : -0.7;
		const double *normal = at + BATTEN_SURFACE_VALUE_normal_x;
		assert_near(
			hypot(hypot(at[0] + off * normal[0], at[1] + off * normal[1]), at[2] + off * normal[2]),
			5.7, 1e-13, 0.0);
	}
	for (int f32 = 0; f32 < 2; f32++)
		for (int n = 0; n < 11; n++) {
			assert_true(
				evaluate(context, sphere, n / 10.0, 1.0, f32 ? BATTEN_F32 : BATTEN_F64, at));
			assert_near(at[BATTEN_SURFACE_VALUE_z], 5.0, 1e-6, 0.0);
			for (int v = BATTEN_SURFACE_VALUE_area; v < COUNT; v++)
				assert_true(at[v] == 0.0);
		}
	batten_surface_batch_options options = surface_case_options(BATTEN_DEVICE_REFERENCE, BATTEN_F64,
	                                                            BATTEN_SURFACE_CURVATURE);
	options.gauss_points = 16;
	const batten_surface *surfaces[] = { sphere };
	batten_surface_energies e;
	assert_int_equal(batten_surface_energy_batch(context, 1, surfaces, &options, &e, NULL),
	                 BATTEN_OK);
	assert_near(e.area_m2, 12.5 * pi, 1e-11, 0.0);
	assert_near(e.bending, pi, 1e-11, 0.0);
	assert_near(e.mean, pi / 2.0, 1e-11, 0.0);
	assert_near(e.gauss, pi / 2.0, 1e-11, 0.0);
	assert_int_equal(e.singular, 0);
	batten_surface_destroy(sphere);
	batten_context_destroy(context);
}

/* A net that is a line has no normal anywhere: all zero, all counted, nothing NaN. */
static void test_surface_without_normals(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	double poles[48];
	for (int n = 0; n < 16; n++)
		for (int c = 0; c < 3; c++)
			poles[3 * n + c] = (c + 1.0) * (n % 4 + n / 4); /* NOLINT(bugprone-integer-division) */
	batten_surface *line = make(
		context, &(batten_surface_net){
					 .order_u = 4, .order_v = 4, .count_u = 4, .count_v = 4, .poles_m = poles });
	const batten_surface *surfaces[] = { line };
	batten_surface_energies e;
	const batten_surface_batch_options options = surface_case_options(
		BATTEN_DEVICE_REFERENCE, BATTEN_F64, BATTEN_SURFACE_CURVATURE);
	assert_int_equal(batten_surface_energy_batch(context, 1, surfaces, &options, &e, NULL),
	                 BATTEN_OK);
	assert_true(e.area_m2 == 0.0 && e.bending == 0.0 && e.mean == 0.0 && e.gauss == 0.0);
	assert_int_equal(e.singular, 25);
	double at[COUNT];
	assert_true(evaluate(context, line, 0.3, 0.6, BATTEN_F64, at));
	assert_true(evaluate(context, line, 0.3, 0.6, BATTEN_F32, at));
	batten_surface_destroy(line);
	batten_context_destroy(context);
}

/* Positions and derivatives against evaluation point by point, forms against their definitions. */
static void check_point(const batten_surface_point *p, const double *at)
{
	static const int orders[6][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 2, 0 }, { 1, 1 }, { 0, 2 } };
	for (int d = 0; d < 6; d++)
		for (int c = 0; c < 3; c++)
			assert_near(at[3 * d + c], p->derivative[orders[d][0]][orders[d][1]][c], 1e-11, 2e-10);
	double forms[2][3] = { { 0.0 } };
	for (int c = 0; c < 3; c++) {
		const double u = at[BATTEN_SURFACE_VALUE_x_u + c];
		const double v = at[BATTEN_SURFACE_VALUE_x_v + c];
		const double n = at[BATTEN_SURFACE_VALUE_normal_x + c];
		forms[0][0] += u * u;
		forms[0][1] += u * v;
		forms[0][2] += v * v;
		for (int d = 0; d < 3; d++)
			forms[1][d] += at[BATTEN_SURFACE_VALUE_x_uu + 3 * d + c] * n;
	}
	for (int d = 0; d < 3; d++) {
		assert_near(at[BATTEN_SURFACE_VALUE_first_uu + d], forms[0][d], 1e-12, 1e-10);
		assert_near(at[BATTEN_SURFACE_VALUE_second_uu + d], forms[1][d], 1e-11, 1e-9);
	}
}

static void check_against_points(size_t order_u, size_t order_v, bool rational)
{
	surface_case c = surface_case_open(order_u, order_v, rational);
	const size_t samples = surface_case_samples(&c);
	double *values = calloc(surface_case_values(&c, BATTEN_SURFACE_EVERYTHING), sizeof *values);
	uint8_t *singular = calloc(c.count * samples, 1);
	assert_non_null(values);
	assert_non_null(singular);
	const batten_surface_batch_options options = surface_case_options(
		BATTEN_DEVICE_REFERENCE, BATTEN_F64, BATTEN_SURFACE_EVERYTHING);
	c.samples.u = c.u;
	c.samples.v = c.v;
	assert_int_equal(batten_surface_grid_batch(c.context, c.count,
	                                           (const batten_surface *const *)c.surfaces,
	                                           &c.samples, &options, values, singular, NULL),
	                 BATTEN_OK);
	size_t without = 0;
	for (size_t s = 0; s < c.count; s++)
		for (size_t n = 0; n < samples; n++) {
			batten_surface_point point;
			double at[COUNT];
			for (size_t v = 0; v < COUNT; v++)
				at[v] = values[(s * COUNT + v) * samples + n];
			assert_int_equal(batten_surface_evaluate(c.surfaces[s], c.u[n % c.samples.u_count],
			                                         c.v[n / c.samples.u_count], &point),
			                 BATTEN_OK);
			without += singular[s * samples + n];
			if (!singular[s * samples + n])
				check_point(&point, at);
		}
	/* The side of the fourth surface that is one point. */
	assert_true(without >= c.samples.v_count);
	free(values);
	free(singular);
	surface_case_close(&c);
}

static void test_everything_agrees_with_points(void **state)
{
	(void)state;
	check_against_points(4, 4, false);
	check_against_points(2, 3, false);
	check_against_points(3, 5, true);
	check_against_points(8, 6, true);
}

/* A surface alone, and all in the other order, have the same bits; so have smaller outputs. */
static void test_independent_of_the_batch(void **state)
{
	(void)state;
	surface_case c = surface_case_open(4, 3, true);
	const batten_surface *turned[SURFACE_CASE_COUNT];
	batten_surface_energies all[SURFACE_CASE_COUNT];
	batten_surface_energies other[SURFACE_CASE_COUNT];
	for (size_t s = 0; s < c.count; s++)
		turned[s] = c.surfaces[c.count - 1 - s];
	const batten_surface_batch_options options = surface_case_options(
		BATTEN_DEVICE_REFERENCE, BATTEN_F32, BATTEN_SURFACE_CURVATURE);
	memset(all, 0, sizeof all);
	memset(other, 0, sizeof other);
	assert_int_equal(batten_surface_energy_batch(c.context, c.count,
	                                             (const batten_surface *const *)c.surfaces,
	                                             &options, all, NULL),
	                 BATTEN_OK);
	assert_int_equal(batten_surface_energy_batch(c.context, c.count, turned, &options, other, NULL),
	                 BATTEN_OK);
	for (size_t s = 0; s < c.count; s++) {
		batten_surface_energies alone;
		memset(&alone, 0, sizeof alone);
		assert_memory_equal(&all[s], &other[c.count - 1 - s], sizeof alone);
		assert_int_equal(
			batten_surface_energy_batch(c.context, 1, &turned[s], &options, &alone, NULL),
			BATTEN_OK);
		assert_memory_equal(&alone, &other[s], sizeof alone);
	}
	double at[COUNT];
	double position[3];
	double curvature[2];
	const double u = 0.7;
	const double v = 1.1;
	const batten_surface_samples samples = { 1, 1, &u, &v };
	assert_false(evaluate(c.context, c.surfaces[0], u, v, BATTEN_F64, at));
	batten_surface_batch_options less = surface_case_options(BATTEN_DEVICE_REFERENCE, BATTEN_F64,
	                                                         BATTEN_SURFACE_POSITION);
	assert_int_equal(batten_surface_grid_batch(c.context, 1,
	                                           (const batten_surface *const *)c.surfaces, &samples,
	                                           &less, position, NULL, NULL),
	                 BATTEN_OK);
	less.output = BATTEN_SURFACE_CURVATURE;
	assert_int_equal(batten_surface_grid_batch(c.context, 1,
	                                           (const batten_surface *const *)c.surfaces, &samples,
	                                           &less, curvature, NULL, NULL),
	                 BATTEN_OK);
	assert_memory_equal(position, at, sizeof position);
	assert_memory_equal(curvature, at + BATTEN_SURFACE_VALUE_gauss, sizeof curvature);
	surface_case_close(&c);
}

typedef struct refusal {
	batten_surface_samples samples;
	batten_surface_batch_options options;
	const char *said;
} refusal;

static void test_refusals(void **state)
{
	(void)state;
	surface_case c = surface_case_open(4, 4, false);
	surface_case d = surface_case_open(4, 4, true);
	surface_case e = surface_case_open(4, 5, false);
	const double good = 1.0;
	const double beyond = 2.0 + 1e-9;
	const double none = NAN;
	const batten_surface_batch_options options = surface_case_options(
		BATTEN_DEVICE_REFERENCE, BATTEN_F64, BATTEN_SURFACE_CURVATURE);
	const batten_surface_samples one = { 1, 1, &good, &good };
	refusal table[] = {
		{ { 1, 1, &beyond, &good }, options, "sample 0: u is 2, 0 to 2 is expected" },
		{ { 1, 1, &good, &none }, options, "sample 0: v is nan" },
		{ { 0, 1, &good, &good }, options, "0 samples along u" },
		{ { 1, 65537, &good, &good }, options, "65537 samples along v" },
		{ one, options, "3 lanes" },
		{ one, options, "surface output 7" },
		{ one, options, "another version" },
		{ one, options, "device -5" },
	};
	table[4].options.lanes = 3;
	table[5].options.output = (batten_surface_output)7;
	table[6].options.struct_size = 1;
	table[7].options.device = -5;
	double values[SURFACE_CASE_COUNT * 2];
	for (size_t r = 0; r < sizeof table / sizeof table[0]; r++) {
		assert_int_equal(
			batten_surface_grid_batch(c.context, c.count, (const batten_surface *const *)c.surfaces,
		                              &table[r].samples, &table[r].options, values, NULL, NULL),
			BATTEN_USAGE);
		if (!strstr(batten_context_error(c.context), table[r].said))
			fail_msg("said '%s'", batten_context_error(c.context));
	}
	const batten_surface *mixed[] = { c.surfaces[0], d.surfaces[0] };
	batten_surface_energies energies[2];
	assert_int_equal(batten_surface_energy_batch(c.context, 2, mixed, NULL, energies, NULL),
	                 BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(c.context), "surface 1 of 2 has weights"));
	mixed[1] = e.surfaces[0];
	assert_int_equal(batten_surface_energy_batch(c.context, 2, mixed, NULL, energies, NULL),
	                 BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(c.context), "other orders"));
	assert_int_equal(batten_surface_energy_batch(c.context, 0, mixed, NULL, energies, NULL),
	                 BATTEN_USAGE);
	table[0].options.gauss_points = 17;
	assert_int_equal(
		batten_surface_energy_batch(c.context, 1, mixed, &table[0].options, energies, NULL),
		BATTEN_USAGE);
	surface_case_close(&c);
	surface_case_close(&d);
	surface_case_close(&e);
}

/* Derivatives too large for f32 are refused there, and work in f64. */
static void test_too_large_for_f32(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	static const double knots[] = { 0.0, 0.0, 0.0, 1e-8, 1e-8, 1e-8 };
	batten_surface *sphere = make_sphere(context, 1e5);
	batten_surface_net net = batten_surface_describe(sphere);
	net.knots_u = knots;
	batten_surface *steep = make(context, &net);
	const batten_surface *surfaces[] = { steep };
	batten_surface_energies e;
	batten_surface_batch_options options = surface_case_options(BATTEN_DEVICE_REFERENCE, BATTEN_F32,
	                                                            BATTEN_SURFACE_CURVATURE);
	assert_int_equal(batten_surface_energy_batch(context, 1, surfaces, &options, &e, NULL),
	                 BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(context), "too large for f32"));
	options.precision = BATTEN_F64;
	options.gauss_points = 16;
	assert_int_equal(batten_surface_energy_batch(context, 1, surfaces, &options, &e, NULL),
	                 BATTEN_OK);
	assert_near(e.bending, pi, 1e-10, 0.0);
	batten_surface_destroy(steep);
	batten_surface_destroy(sphere);
	batten_context_destroy(context);
}

/* Fails allocation number `left` and those after it. */
static void *allocate_some(size_t size, void *user)
{
	long *left = user;
	return (*left)-- > 0 ? malloc(size) : NULL;
}

static void release_all(void *memory, void *user)
{
	(void)user;
	free(memory);
}

static void test_out_of_memory(void **state)
{
	(void)state;
	long left = 1000;
	batten_context_options given;
	batten_context *context = NULL;
	batten_context_options_default(&given);
	given.allocate = allocate_some;
	given.release = release_all;
	given.allocate_user = &left;
	assert_int_equal(batten_context_create(&given, &context), BATTEN_OK);
	batten_surface *sphere = make_sphere(context, 5.0);
	const batten_surface *surfaces[] = { sphere };
	const batten_surface_batch_options options = surface_case_options(
		BATTEN_DEVICE_REFERENCE, BATTEN_F64, BATTEN_SURFACE_CURVATURE);
	long failures = 0;
	for (batten_status status = BATTEN_MEMORY; status == BATTEN_MEMORY; failures++) {
		batten_surface_energies e;
		left = failures;
		status = batten_surface_energy_batch(context, 1, surfaces, &options, &e, NULL);
		assert_true(status == BATTEN_MEMORY || status == BATTEN_OK);
	}
	assert_true(failures > 10);
	left = 1000;
	batten_surface_destroy(sphere);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_wigley_curvatures),
		cmocka_unit_test(test_wigley_line_of_no_gauss_curvature),
		cmocka_unit_test(test_paraboloids),
		cmocka_unit_test(test_sphere),
		cmocka_unit_test(test_surface_without_normals),
		cmocka_unit_test(test_everything_agrees_with_points),
		cmocka_unit_test(test_independent_of_the_batch),
		cmocka_unit_test(test_refusals),
		cmocka_unit_test(test_too_large_for_f32),
		cmocka_unit_test(test_out_of_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
