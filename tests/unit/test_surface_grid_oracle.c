/* Grids of points and curvatures, and energies, against the oracle: in both precisions, with the C
 * path. A value may be as wrong as roundings of its derivatives can make it: the bound is the sum
 * of what the oracle's value changes when each coordinate of each derivative is moved by a few
 * rounding units of the magnitude of its terms. */
#include "surface_fixture.h"

/* Values of a point, in the order of the comparison. */
enum {
	AT = 0, /* and by u, v, uu, uv, vv */
	FIRST = 18,
	AREA = 21,
	NORMAL = 22,
	SECOND = 25,
	GAUSS = 28,
	MEAN,
	K1,
	K2,
	BENDING,
	DIRECTION1,
	DIRECTION2 = DIRECTION1 + 3,
	ALONG = DIRECTION2 + 3,
	ACROSS,
	ISOPHOTE,
	VALUES
};

typedef struct expected {
	long double value[VALUES], bound[VALUES];
	bool regular;
} expected;

static const size_t derivatives[6][2] = {
	{ 0, 0 }, { 1, 0 }, { 0, 1 }, { 2, 0 }, { 1, 1 }, { 0, 2 }
};

/* Of length 7 as given to the library. */
static const double light[3] = { 2, -3, 6 };

/* Euler's formula: the curvature in a direction from the principal ones. x axis on the tangent plane:
 * what its product with the principal directions says. */
static void list_sections(const oracle_forms *forms, long double value[VALUES])
{
	long double a = forms->direction[0][0], b = forms->direction[1][0], square = a * a + b * b;
	value[ALONG] = -(forms->k[0] * a * a + forms->k[1] * b * b) / square;
	value[ACROSS] = -(forms->k[0] * b * b + forms->k[1] * a * a) / square;
	value[ISOPHOTE] = 0;
	for (size_t c = 0; c < 3; c++) {
		value[DIRECTION1 + c] = forms->direction[0][c];
		value[DIRECTION2 + c] = forms->direction[1][c];
		value[ISOPHOTE] -= forms->normal[c] * light[c] / 7;
	}
}

/* The library's normal is by_v x by_u: signs turn round, and k1 is the larger. */
static bool list_values(const oracle_jet jet, long double value[VALUES])
{
	oracle_forms forms;
	oracle_surface_forms(jet, &forms);
	for (size_t d = 0; d < 6; d++)
		for (size_t c = 0; c < 3; c++)
			value[AT + 3 * d + c] = jet[derivatives[d][0]][derivatives[d][1]][c];
	for (size_t c = 0; c < 3; c++) {
		value[FIRST + c] = forms.first[c];
		value[SECOND + c] = -forms.second[c];
		value[NORMAL + c] = -forms.normal[c];
	}
	value[AREA] = forms.area;
	value[GAUSS] = forms.gauss;
	value[MEAN] = -forms.mean;
	value[K1] = -forms.k[0];
	value[K2] = -forms.k[1];
	value[BENDING] = forms.k[0] * forms.k[0] + forms.k[1] * forms.k[1];
	list_sections(&forms, value);
	return forms.regular;
}

/* Either sense of a principal direction is right: takes that of the expected one. */
static void turn_directions(const long double wanted[VALUES], long double value[VALUES])
{
	for (size_t d = DIRECTION1; d <= DIRECTION2; d += 3) {
		long double along = 0;
		for (size_t c = 0; c < 3; c++)
			along += wanted[d + c] * value[d + c];
		for (size_t c = 0; c < 3 && along < 0; c++)
			value[d + c] = -value[d + c];
	}
}

/* k1 and k2 are made of H and sqrt(H^2 - K), k1^2 + k2^2 is 4 H^2 - 2 K: near umbilics and planes
 * their errors are those of H and K, not their own. */
static void bound_by_mean_and_gauss(expected *e, long double unit)
{
	long double mean = fabsl(e->value[MEAN]), gauss = fabsl(e->value[GAUSS]);
	long double spread = (e->value[K1] - e->value[K2]) / 2;
	long double square = 2 * mean * e->bound[MEAN] + e->bound[GAUSS] + unit * (mean * mean + gauss);
	long double root = sqrtl(square);
	if (spread > root)
		root = square / spread;
	e->bound[K1] = e->bound[K2] = e->bound[MEAN] + root + unit * (mean + spread);
	e->bound[BENDING] = 4 * square;
	/* components of units, and their parts of both curvatures */
	for (size_t n = DIRECTION1; n < ALONG; n++)
		e->bound[n] += unit;
	e->bound[ALONG] += unit * (mean + spread);
	e->bound[ACROSS] += unit * (mean + spread);
	e->bound[ISOPHOTE] += unit;
}

static void expect(const oracle_surface *surface, double u, double v, long double unit, expected *e)
{
	oracle_jet jet, magnitude;
	assert_true(oracle_surface_at(surface, u, v, jet));
	assert_true(oracle_surface_magnitude(surface, u, v, magnitude));
	e->regular = list_values(jet, e->value);
	for (size_t n = 0; n < VALUES; n++)
		e->bound[n] = unit * fabsl(e->value[n]);
	for (size_t d = 0; d < 6; d++) {
		for (size_t c = 0; c < 3; c++) {
			size_t i = derivatives[d][0], j = derivatives[d][1];
			long double kept = jet[i][j][c], moved[VALUES];
			jet[i][j][c] += unit * magnitude[i][j][c];
			(void)list_values(jet, moved);
			turn_directions(e->value, moved);
			jet[i][j][c] = kept;
			for (size_t n = 0; n < VALUES; n++)
				e->bound[n] += fabsl(moved[n] - e->value[n]);
		}
	}
	bound_by_mean_and_gauss(e, unit);
}

enum { BATCH = 3, WIDE = 5, UP = 4, POINTS = WIDE * UP };

typedef struct batch {
	drawn of[BATCH];
	batten_surface *surfaces[BATCH];
	double u[WIDE], v[UP];
} batch;

static void open_batch(batten_context *context, uint64_t *seed, size_t order_u, size_t order_v,
                       bool rational, batch *b)
{
	for (size_t s = 0; s < BATCH; s++) {
		drawn *d = &b->of[s];
		draw_net(seed, order_u, order_v, rational, d);
		if (s > 0) { /* the first one's knots */
			d->net = b->of[0].net;
			d->net.poles_m = d->poles;
			d->net.weights = rational ? d->weights : NULL;
			draw_poles(seed, d);
		}
		assert_int_equal(batten_surface_create(context, &d->net, &b->surfaces[s]), BATTEN_OK);
	}
	const batten_surface_net *net = &b->of[0].net;
	for (size_t i = 0; i < WIDE; i++)
		b->u[i] = draw_place(seed, order_u, net->count_u, net->knots_u);
	for (size_t j = 0; j < UP; j++)
		b->v[j] = draw_place(seed, order_v, net->count_v, net->knots_v);
}

static void close_batch(batch *b)
{
	for (size_t s = 0; s < BATCH; s++)
		batten_surface_destroy(b->surfaces[s]);
}

static batten_surface_batch_options plain(batten_precision precision)
{
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.precision = precision;
	options.output = BATTEN_SURFACE_EVERYTHING;
	for (size_t c = 0; c < 3; c++)
		options.light[c] = light[c];
	return options;
}

/* Compares one surface of the batch; returns how many points have a curvature known to `sharp` of
 * its scale, H^2 + |K|. */
static size_t compare(const batch *b, size_t s, const double *values, const uint8_t *singular,
                      long double unit, long double sharp)
{
	oracle_surface surface = as_oracle(&b->of[s].net);
	size_t known = 0;
	for (size_t p = 0; p < POINTS; p++) {
		expected e;
		expect(&surface, b->u[p % WIDE], b->v[p / WIDE], unit, &e);
		assert_true(e.regular);
		assert_int_equal(singular[s * POINTS + p], 0);
		long double found[VALUES];
		for (size_t n = 0; n < VALUES; n++)
			found[n] = values[(s * VALUES + n) * POINTS + p];
		turn_directions(e.value, found);
		for (size_t n = 0; n < VALUES; n++)
			if (!(fabsl(found[n] - e.value[n]) <= e.bound[n]))
				fail_msg("value %zu: found %.17Lg, expected %.17Lg within %Lg", n, found[n],
				         e.value[n], e.bound[n]);
		long double scale = e.value[MEAN] * e.value[MEAN] + fabsl(e.value[GAUSS]);
		known += e.bound[GAUSS] <= sharp * scale;
	}
	return known;
}

static void compare_batches(batten_precision precision, uint64_t seed, long double unit,
                            long double sharp)
{
	batten_context *context = open_context();
	batten_surface_batch_options options = plain(precision);
	double values[BATCH * VALUES * POINTS];
	uint8_t singular[BATCH * POINTS];
	batch b;
	size_t known = 0, all = 0;
	for (size_t round = 0; round < 2 * 49; round++) {
		open_batch(context, &seed, 2 + round % 7, 2 + round / 7 % 7, round >= 49, &b);
		const batten_surface_samples samples = {
			.u_count = WIDE, .u = b.u, .v_count = UP, .v = b.v
		};
		assert_int_equal(batten_surface_grid_batch(context, BATCH,
		                                           (const batten_surface *const *)b.surfaces,
		                                           &samples, &options, values, singular, NULL),
		                 BATTEN_OK);
		for (size_t s = 0; s < BATCH; s++)
			known += compare(&b, s, values, singular, unit, sharp);
		all += BATCH * POINTS;
		close_batch(&b);
	}
	assert_true(known * 100 >= all * 99);
	batten_context_destroy(context);
}

static void test_everything_in_double(void **state)
{
	(void)state;
	compare_batches(BATTEN_F64, 11, 8 * 0x1p-53L, 1e-11L);
}

static void test_everything_in_float(void **state)
{
	(void)state;
	compare_batches(BATTEN_F32, 12, 8 * 0x1p-24L, 5e-3L);
}

/* The same Gauss nodes per span on both sides. */
static void test_energies(void **state)
{
	(void)state;
	enum { NODES = 3 };
	uint64_t seed = 13;
	batten_context *context = open_context();
	batten_surface_batch_options options = plain(BATTEN_F64);
	options.gauss_points = NODES;
	batch b;
	for (size_t round = 0; round < 49; round++) {
		open_batch(context, &seed, 2 + round % 7, 2 + round / 7 % 7, round % 2, &b);
		batten_surface_energies found[BATCH];
		assert_int_equal(batten_surface_energy_batch(context, BATCH,
		                                             (const batten_surface *const *)b.surfaces,
		                                             &options, found, NULL),
		                 BATTEN_OK);
		for (size_t s = 0; s < BATCH; s++) {
			oracle_surface surface = as_oracle(&b.of[s].net);
			oracle_energies exact;
			assert_true(oracle_surface_energy(&surface, NODES, 0, &exact));
			long double bound = 2e-14L * exact.bending;
			assert_true(fabsl(found[s].bending - exact.bending) <= bound);
			assert_true(fabsl(found[s].mean - exact.mean) <= bound);
			assert_true(fabsl(found[s].gauss - exact.gauss) <= bound);
			assert_true(fabsl(found[s].area_m2 - exact.area) <= 1e-14L * exact.area);
			assert_int_equal(found[s].singular, 0);
		}
		close_batch(&b);
	}
	batten_context_destroy(context);
}

/* An octant of the ellipsoid with half-axes 3, 2, 1, its pole at the top of v: there x_u is 0. */
static void test_pole_is_flagged(void **state)
{
	(void)state;
	enum { SIDE = 6 };
	static const double quadrant[3][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 } }, weight[] = { 1, 1, 2 };
	static const double at[SIDE] = { 0, 0.2, 0.4, 0.6, 0.8, 1 };
	double poles[27], weights[9], values[VALUES][SIDE][SIDE];
	uint8_t singular[SIDE][SIDE];
	for (size_t i = 0; i < 9; i++) {
		poles[3 * i] = 3 * quadrant[i % 3][0] * quadrant[i / 3][0];
		poles[3 * i + 1] = 2 * quadrant[i % 3][1] * quadrant[i / 3][0];
		poles[3 * i + 2] = quadrant[i / 3][1];
		weights[i] = weight[i % 3] * weight[i / 3];
	}
	batten_context *context = open_context();
	batten_surface *surface = NULL;
	const batten_surface_net net = {
		.order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = poles, .weights = weights
	};
	assert_int_equal(batten_surface_create(context, &net, &surface), BATTEN_OK);
	const batten_surface_samples samples = { .u_count = SIDE, .u = at, .v_count = SIDE, .v = at };
	for (size_t round = 0; round < 2; round++) {
		batten_surface_batch_options options = plain(round ? BATTEN_F32 : BATTEN_F64);
		double tolerance = round ? 1e-5 : 1e-13;
		assert_int_equal(
			batten_surface_grid_batch(context, 1, (const batten_surface *const[]){ surface },
		                              &samples, &options, &values[0][0][0], &singular[0][0], NULL),
			BATTEN_OK);
		for (size_t i = 0; i < SIDE * SIDE; i++) {
			bool pole = i / SIDE == SIDE - 1;
			assert_int_equal(singular[i / SIDE][i % SIDE], pole);
			double value[VALUES];
			for (size_t n = 0; n < VALUES; n++) {
				value[n] = values[n][i / SIDE][i % SIDE];
				assert_true(isfinite(value[n]));
			}
			double x = value[AT], y = value[AT + 1], z = value[AT + 2];
			assert_true(fabs(x * x / 9 + y * y / 4 + z * z - 1) <= tolerance);
			double slope = x * x / 81 + y * y / 16 + z * z;
			double gauss = pole ? 0 : 1 / (36 * slope * slope);
			double mean = pole ? 0 : -(14 - x * x - y * y - z * z) / (72 * slope * sqrt(slope));
			/* u runs to port and v up: by_v x by_u points inward here */
			assert_true(fabs(value[GAUSS] - gauss) <= tolerance * fabs(gauss) * 100);
			assert_true(fabs(value[MEAN] + mean) <= tolerance * fabs(mean) * 100);
		}
	}
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_everything_in_double),
		cmocka_unit_test(test_everything_in_float),
		cmocka_unit_test(test_energies),
		cmocka_unit_test(test_pole_is_flagged),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
