/* The noise of offsets: nothing on smooth forms, what was put in on noisy ones. */
#include "batten.h"
#include "core/median.h"
#include "fairing/noise.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_NODES = 64 * 64 };
static const double pi = 3.14159265358979323846;

/* A form over x/L in [-0.5, 0.5] and z/D in [0, 1]; 1 is the half-beam. */
typedef double form(double s, double t);

static double parabolic(double s, double t)
{
	return (1 - 4 * s * s) * (1 - (1 - t) * (1 - t));
}

static double cosine(double s, double t)
{
	return cos(pi * s) * (1 - cos(pi * t / 2));
}

static double cosine_square(double s, double t)
{
	return cos(pi * s) * cos(pi * s) * (1 - exp(-3 * t));
}

static double sine_sections(double s, double t)
{
	return cos(pi * s) * sin(pi * t / 2);
}

static double ellipsoid_midbody(double s, double t)
{
	double a = 2 * s / 1.3, b = (1 - t) / 1.3;
	return sqrt(1 - a * a - b * b);
}

static batten_context *make_context(void)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	return context;
}

/* The high 53 bits of splitmix64, in [0, 1). */
static double uniform(uint64_t *state)
{
	uint64_t z = *state += 0x9e3779b97f4a7c15u;
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	z ^= z >> 31;
	return (double)(z >> 11) * 0x1p-53;
}

/* The hull of a form, L = 16, half-beam 0.8, D = 1, with noise uniform in +-amplitude where y >
 * 0. */
static batten_hull *make_hull(batten_context *context, form *surface, size_t nx, size_t nz,
                              double amplitude, uint64_t seed)
{
	static double y[MOST_NODES];
	double x[64], z[64];
	assert_true(nx <= 64 && nz <= 64);
	for (size_t i = 0; i < nx; i++)
		x[i] = 16 * (double)i / (double)(nx - 1);
	for (size_t j = 0; j < nz; j++)
		z[j] = (double)j / (double)(nz - 1);
	for (size_t j = 0; j < nz; j++)
		for (size_t i = 0; i < nx; i++) {
			double exact = 0.8 * surface(x[i] / 16 - 0.5, z[j]);
			double noise = amplitude * (2 * uniform(&seed) - 1);
			y[j * nx + i] = exact > 1e-12 ? fmax(0, exact + noise) : 0;
		}
	batten_hull_table table = { "test", 16, 1, nx, nz, x, z, y, NULL };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
	return hull;
}

static double noise_of(batten_context *context, const batten_hull *hull)
{
	double noise = NAN;
	assert_int_equal(noise_estimate(context, hull, &noise), BATTEN_OK);
	assert_true(noise >= 0);
	return noise;
}

static double noise_of_form(form *surface, size_t nx, size_t nz, double amplitude, uint64_t seed)
{
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, surface, nx, nz, amplitude, seed);
	double noise = noise_of(context, hull);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
	return noise;
}

static batten_hull *read_shipped(batten_context *context, const char *name)
{
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_read(context, path, &hull), BATTEN_OK);
	return hull;
}

static void polynomial_hulls_have_none(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = read_shipped(context, "wigley");
	assert_true(noise_of(context, hull) <= 1e-12 * batten_hull_half_beam_m(hull));
	batten_hull_destroy(hull);
	batten_context_destroy(context);
	assert_true(noise_of_form(parabolic, 21, 20, 0, 0) <= 1e-12 * 0.8);
	assert_true(noise_of_form(parabolic, 41, 11, 0, 0) <= 1e-12 * 0.8);
}

/* Smooth forms that are no polynomial: the 0.75 of the noise a fairing may use stays so small that
 * even ten times it is below 1e-4 of the half-beam. */
static void smooth_hulls_have_next_to_none(void **state)
{
	(void)state;
	form *const forms[] = { cosine, cosine_square, sine_sections, ellipsoid_midbody };
	static const size_t sizes[][2] = { { 21, 20 }, { 13, 12 }, { 12, 21 } };
	for (size_t k = 0; k < sizeof forms / sizeof forms[0]; k++)
		for (size_t i = 0; i < 3; i++)
			assert_true(10 * 0.75 * noise_of_form(forms[k], sizes[i][0], sizes[i][1], 0, 0) <
			            1e-4 * 0.8);
}

/* One table of 21 x 20 tells the noise within about 8 % (one standard deviation); the mean of many
 * is not biased. */
static void noise_put_in_comes_out(void **state)
{
	(void)state;
	form *const forms[] = { parabolic, cosine, cosine_square, sine_sections };
	static const double amplitudes[] = { 0.002, 0.005, 0.01, 0.02 };
	enum { SEEDS = 24 };
	for (size_t k = 0; k < sizeof forms / sizeof forms[0]; k++)
		for (size_t a = 0; a < 4; a++) {
			double truth = amplitudes[a] / sqrt(3), sum = 0;
			for (uint64_t seed = 1; seed <= SEEDS; seed++) {
				double noise = noise_of_form(forms[k], 21, 20, amplitudes[a], 1000 * seed + k);
				assert_true(fabs(noise / truth - 1) < 0.3);
				sum += noise;
			}
			assert_true(fabs(sum / SEEDS / truth - 1) < 0.06);
		}
}

static void noise_of_the_shipped_hulls(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *noisy = read_shipped(context, "wigley_noisy");
	assert_true(fabs(noise_of(context, noisy) / 0.0058 - 1) <= 0.1);
	batten_hull_destroy(noisy);
	/* NPL with its misprint replaced: about 0.09 % of the half-beam */
	batten_hull *npl = read_shipped(context, "npl_parent");
	size_t stations = batten_hull_station_count(npl);
	double y[MOST_NODES];
	memcpy(y, batten_hull_y_m(npl), stations * batten_hull_waterline_count(npl) * sizeof *y);
	size_t misprint = 15 * stations + 10;
	assert_true(y[misprint] == 0.1192);
	y[misprint] = 0.1089;
	assert_int_equal(batten_hull_set_y(context, npl, y), BATTEN_OK);
	double part = noise_of(context, npl) / batten_hull_half_beam_m(npl);
	assert_true(part > 0.0008 && part < 0.001);
	batten_hull_destroy(npl);
	batten_context_destroy(context);
}

static void gross_errors_do_not_count(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, cosine, 21, 20, 0.005, 7);
	double clean = noise_of(context, hull), y[MOST_NODES];
	memcpy(y, batten_hull_y_m(hull), 21 * 20 * sizeof *y);
	y[5 * 21 + 6] += 0.2;
	y[16 * 21 + 15] -= 0.2;
	assert_int_equal(batten_hull_set_y(context, hull, y), BATTEN_OK);
	double spoilt = noise_of(context, hull);
	assert_true(spoilt >= clean && spoilt < 1.35 * clean);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

/* Noise that only one direction sees is form: stations that jump while each section is smooth. */
static double ragged_stations(double s, double t)
{
	double jump = fmod(1e3 * (s + 0.5) * 7.3, 1) - 0.5;
	return (1 - s * s + 0.02 * jump) * (0.5 + t);
}

static void the_smoother_direction_wins(void **state)
{
	(void)state;
	assert_true(noise_of_form(ragged_stations, 21, 20, 0, 0) < 1e-12);
}

static void scale_and_pieces(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, cosine, 21, 20, 0.01, 3);
	double noise = noise_of(context, hull);
	/* the same in units 2^10 times smaller, every way */
	batten_hull *scaled = NULL;
	double x[21], z[20], y[420];
	for (size_t i = 0; i < 21; i++)
		x[i] = 1024 * batten_hull_x_m(hull)[i];
	for (size_t j = 0; j < 20; j++)
		z[j] = 1024 * batten_hull_z_m(hull)[j];
	for (size_t i = 0; i < 420; i++)
		y[i] = 1024 * batten_hull_y_m(hull)[i];
	uint8_t nodes[420];
	memset(nodes, BATTEN_NODE_GIVEN, sizeof nodes);
	batten_hull_table table = { "scaled", 16384, 1024, 21, 20, x, z, y, nodes };
	assert_int_equal(batten_hull_create(context, &table, &scaled), BATTEN_OK);
	assert_true(fabs(noise_of(context, scaled) / 1024 / noise - 1) < 1e-12);
	batten_hull_destroy(scaled);
	/* empty cells break the lines: pieces of 4 by 4 are too short for any difference */
	for (size_t i = 0; i < 420; i++)
		if (i % 21 % 5 == 4 || i / 21 % 5 == 4)
			nodes[i] = BATTEN_NODE_OUTSIDE;
	assert_int_equal(batten_hull_create(context, &table, &scaled), BATTEN_OK);
	assert_true(noise_of(context, scaled) == 0);
	batten_hull_destroy(scaled);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

/* Plane pieces between knuckles at every fourth station: nothing where they are named. */
static void no_difference_across_a_knuckle(void **state)
{
	(void)state;
	static char text[16384];
	size_t length = (size_t)snprintf(
		text, sizeof text,
		"# batten-offsets: 1\n# name: chine\n# unit: m\n"
		"# frame: ap-fwd\n# lbp: 20\n# draft: 2\n# layout: grid\nz\\x");
	for (int i = 0; i <= 20; i++)
		length += (size_t)snprintf(text + length, sizeof text - length, ",%d", i);
	for (int j = 0; j < 4; j++) {
		length += (size_t)snprintf(text + length, sizeof text - length, "\n%d", j);
		for (int i = 0; i <= 20; i++)
			length += (size_t)snprintf(text + length, sizeof text - length, ",%g",
			                           1 + 0.25 * abs(i % 8 - 4) + 0.5 * j);
	}
	length += (size_t)snprintf(text + length, sizeof text - length, "\n");
	batten_context *context = make_context();
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_parse(context, "plain", text, length, &hull), BATTEN_OK);
	assert_true(noise_of(context, hull) > 0.01);
	batten_hull_destroy(hull);
	for (int j = 0; j < 4; j++)
		for (int i = 4; i < 20; i += 4)
			length += (size_t)snprintf(text + length, sizeof text - length,
			                           "knuckle,waterline,%d,%d\n", i, j);
	assert_int_equal(batten_hull_parse(context, "named", text, length, &hull), BATTEN_OK);
	assert_true(noise_of(context, hull) < 1e-14);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

/* A grid's lines side by side give the bits of lines collected one by one, which those of the long layout
 * are. */
static void lines_side_by_side(void **state)
{
	(void)state;
	batten_context *context = make_context();
	static const size_t sizes[][2] = { { 21, 20 }, { 13, 9 }, { 6, 24 }, { 5, 5 } };
	for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
		batten_hull *hull = make_hull(context, parabolic, sizes[k][0], sizes[k][1], 0.01, 7 + k);
		const double grid = noise_of(context, hull);
		hull->layout = HULL_LAYOUT_LONG_WATERLINES;
		const double lines = noise_of(context, hull);
		hull->layout = HULL_LAYOUT_GRID;
		assert_true(grid == lines && (grid > 0) == (sizes[k][0] > 5));
		batten_hull_destroy(hull);
	}
	batten_context_destroy(context);
}

static int ascending(const void *a, const void *b)
{
	const double *x = a, *y = b;
	return (*x > *y) - (*x < *y);
}

static void medians(void **state)
{
	(void)state;
	uint64_t seed = 3;
	double list[60], sorted[60];
	for (size_t count = 1; count <= 50; count++)
		for (int kinds = 1; kinds <= 1000; kinds *= 10) {
			const size_t total = count + count % 7;
			for (size_t i = 0; i < total; i++)
				list[i] = i < count ? floor(kinds * uniform(&seed)) : INFINITY;
			/* What does not count may stand anywhere. */
			const double last = list[total - 1];
			list[total - 1] = list[0];
			list[0] = last;
			memcpy(sorted, list, total * sizeof *list);
			qsort(sorted, total, sizeof *sorted, ascending);
			const double expected = 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
			const double guesses[] = { list[total / 2], expected, 0.9 * expected,
				                       1.1 * expected,  -1,       0,
				                       INFINITY,        NAN };
			for (size_t g = 0; g < sizeof guesses / sizeof guesses[0]; g++)
				assert_true(median_of_least(list, total, count, guesses[g]) == expected);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(polynomial_hulls_have_none),
		cmocka_unit_test(smooth_hulls_have_next_to_none),
		cmocka_unit_test(noise_put_in_comes_out),
		cmocka_unit_test(noise_of_the_shipped_hulls),
		cmocka_unit_test(gross_errors_do_not_count),
		cmocka_unit_test(the_smoother_direction_wins),
		cmocka_unit_test(scale_and_pieces),
		cmocka_unit_test(no_difference_across_a_knuckle),
		cmocka_unit_test(lines_side_by_side),
		cmocka_unit_test(medians),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
