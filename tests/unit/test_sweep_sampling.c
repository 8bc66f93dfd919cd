/* Where a sweep puts its designs: Sobol's points, random numbers by counter, permutations, levels. */
#include "sweep/log_scale.h"
#include "sweep/random.h"
#include "sweep/sampling.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* The first points of Joe and Kuo's sequence in three dimensions, in Gray code order, as their program
 * and SciPy's qmc.Sobol(3, scramble=False) print them. */
static void sobol_begins_as_published(void **state)
{
	(void)state;
	static const double published[8][3] = {
		{ 0, 0, 0 },
		{ 0.5, 0.5, 0.5 },
		{ 0.75, 0.25, 0.25 },
		{ 0.25, 0.75, 0.75 },
		{ 0.375, 0.375, 0.625 },
		{ 0.875, 0.875, 0.125 },
		{ 0.625, 0.125, 0.875 },
		{ 0.125, 0.625, 0.375 },
	};
	for (unsigned d = 0; d < 3; d++) {
		uint32_t directions[SOBOL_BITS];
		sobol_directions(d, directions);
		for (uint32_t i = 0; i < 8; i++)
			assert_true(sobol_coordinate(directions, i) * 0x1p-32 == published[i][d]);
	}
}

/* In every dimension the first 2^k points stand one in each of 2^k equal parts, scrambled or not; two
 * neighbouring dimensions fill every box of 2^-a by 2^-b of the unscrambled first pair. */
static void sobol_is_a_net(void **state)
{
	(void)state;
	enum { POINTS = 256 };
	for (unsigned d = 0; d < SOBOL_DIMENSIONS; d++) {
		uint32_t directions[SOBOL_BITS];
		sobol_directions(d, directions);
		bool plain[POINTS] = { false };
		bool scrambled[POINTS] = { false };
		for (uint32_t i = 0; i < POINTS; i++) {
			const uint32_t coordinate = sobol_coordinate(directions, i);
			plain[coordinate >> 24] = true;
			scrambled[sobol_scramble(5, d, coordinate) >> 24] = true;
		}
		for (size_t i = 0; i < POINTS; i++)
			assert_true(plain[i] && scrambled[i]);
	}
}

/* Owen's scrambling keeps the net of the first two dimensions: of 256 points one in each box of 2^-a by
 * 2^-(8 - a). */
static void scrambled_pairs_fill_boxes(void **state)
{
	(void)state;
	uint32_t first[SOBOL_BITS];
	uint32_t second[SOBOL_BITS];
	sobol_directions(0, first);
	sobol_directions(1, second);
	for (unsigned a = 0; a <= 8; a++) {
		bool filled[256] = { false };
		for (uint32_t i = 0; i < 256; i++) {
			const uint64_t x = sobol_scramble(9, 0, sobol_coordinate(first, i));
			const uint64_t y = sobol_scramble(9, 1, sobol_coordinate(second, i));
			filled[(x >> (32 - a)) << (8 - a) | y >> (24 + a)] = true;
		}
		for (size_t i = 0; i < 256; i++)
			assert_true(filled[i]);
	}
}

/* Philox4x32-10 with everything 0 (Random123's known answers). */
static void random_numbers_are_philox(void **state)
{
	(void)state;
	assert_true(sweep_random(0, 0, 0, SWEEP_RANDOM_POINT) == 0xe169c58d6627e8d5u);
	assert_true(sweep_random(1, 0, 0, SWEEP_RANDOM_POINT) !=
	            sweep_random(0, 0, 0, SWEEP_RANDOM_POINT));
	assert_true(sweep_random(0, 0, 0, SWEEP_RANDOM_SHUFFLE) !=
	            sweep_random(0, 0, 0, SWEEP_RANDOM_POINT));
	double sum = 0;
	for (uint64_t i = 0; i < 10000; i++) {
		const double unit = sweep_random_unit(3, i, 2);
		assert_true(unit >= 0.0 && unit < 1.0);
		sum += unit;
	}
	/* The mean of 10000 has a standard deviation of 0.0029. */
	assert_true(fabs(sum / 10000 - 0.5) < 0.015);
}

static void permutations_reach_every_number_once(void **state)
{
	(void)state;
	static const uint64_t counts[] = { 1, 2, 3, 5, 16, 17, 100, 1000 };
	for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
		bool seen[1000] = { false };
		size_t moved = 0;
		for (uint64_t i = 0; i < counts[c]; i++) {
			const uint64_t to = sweep_permuted(11, 3, counts[c], i);
			assert_true(to < counts[c] && !seen[to]);
			seen[to] = true;
			moved += to != i;
		}
		assert_true(counts[c] < 100 || moved > counts[c] * 9 / 10);
	}
	assert_true(sweep_permuted(1, 0, (uint64_t)1 << 62, 12345) < (uint64_t)1 << 62);
}

static sweep_sampling sampling_of(sampling_method method, uint64_t count,
                                  sampling_parameter *parameters, size_t parameter_count)
{
	sweep_sampling sampling = { .method = method,
		                        .scramble = true,
		                        .seed = 4,
		                        .count = count,
		                        .parameter_count = parameter_count,
		                        .parameters = parameters };
	return sampling;
}

static void latin_hypercubes_have_one_point_a_stratum(void **state)
{
	(void)state;
	enum { COUNT = 60 };
	sampling_parameter parameters[3] = { { .from = 0, .to = 1 },
		                                 { .from = -2, .to = 4 },
		                                 { .from = 1, .to = 1000, .logarithmic = true } };
	const sweep_sampling sampling = sampling_of(SAMPLING_LATIN, COUNT, parameters, 3);
	bool seen[3][COUNT] = { { false } };
	for (uint64_t i = 0; i < COUNT; i++) {
		double values[3];
		sampling_values(&sampling, i, values);
		const double units[3] = { values[0], (values[1] + 2) / 6, log10(values[2]) / 3 };
		for (size_t p = 0; p < 3; p++) {
			const size_t stratum = (size_t)(units[p] * COUNT);
			assert_true(stratum < COUNT && !seen[p][stratum]);
			seen[p][stratum] = true;
		}
	}
}

static void grids_go_through_every_combination(void **state)
{
	(void)state;
	double list[2] = { 7, 3 };
	sampling_parameter parameters[3] = { { .from = 0, .to = 1, .level_count = 3 },
		                                 { .levels = list, .level_count = 2 },
		                                 { .from = 5, .to = 6, .level_count = 1 } };
	sweep_sampling sampling = sampling_of(SAMPLING_GRID, 0, parameters, 3);
	assert_true(sampling_grid_count(&sampling, &sampling.count));
	assert_int_equal(sampling.count, 6);
	static const double expected[6][3] = { { 0, 7, 5 },   { 0, 3, 5 }, { 0.5, 7, 5 },
		                                   { 0.5, 3, 5 }, { 1, 7, 5 }, { 1, 3, 5 } };
	for (uint64_t i = 0; i < 6; i++) {
		double values[3];
		sampling_values(&sampling, i, values);
		assert_memory_equal(values, expected[i], sizeof values);
	}
	parameters[0].level_count = (uint64_t)1 << 40;
	parameters[1].level_count = (uint64_t)1 << 40;
	assert_false(sampling_grid_count(&sampling, &sampling.count));
}

static void levels_have_equal_shares(void **state)
{
	(void)state;
	double list[4] = { 1, 2, 4, 8 };
	sampling_parameter parameter = { .levels = list, .level_count = 4 };
	sweep_sampling sampling = sampling_of(SAMPLING_SOBOL, 64, &parameter, 1);
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	assert_int_equal(sampling_prepare(context, &sampling), BATTEN_OK);
	size_t counts[9] = { 0 };
	for (uint64_t i = 0; i < 64; i++) {
		double value = 0;
		sampling_values(&sampling, i, &value);
		counts[(size_t)value]++;
	}
	assert_true(counts[1] == 16 && counts[2] == 16 && counts[4] == 16 && counts[8] == 16);
	batten_release(context, sampling.directions);
	batten_context_destroy(context);
}

static void log_scales_are_powers(void **state)
{
	(void)state;
	static const double ends[][2] = { { 1, 1e6 }, { 1e-9, 1e12 }, { 3, 3.5 }, { 1e-100, 1e100 } };
	for (size_t e = 0; e < sizeof ends / sizeof ends[0]; e++) {
		for (int i = 0; i <= 100; i++) {
			const long double part = i / 100.0L;
			const long double exact = ends[e][0] * powl((long double)ends[e][1] / ends[e][0], part);
			const double found = log_scale_between(ends[e][0], ends[e][1], (double)i / 100.0);
			/* The relative error of a power grows with its exponent. */
			assert_true(fabsl(found - exact) <= 2e-13L * exact);
		}
		assert_true(log_scale_between(ends[e][0], ends[e][1], 0) == ends[e][0]);
		assert_true(log_scale_between(ends[e][0], ends[e][1], 1) == ends[e][1]);
	}
	assert_true(fabs(log_scale_between(1, 1e6, 0.5) - 1000) <= 1e-11);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sobol_begins_as_published),
		cmocka_unit_test(sobol_is_a_net),
		cmocka_unit_test(scrambled_pairs_fill_boxes),
		cmocka_unit_test(random_numbers_are_philox),
		cmocka_unit_test(permutations_reach_every_number_once),
		cmocka_unit_test(latin_hypercubes_have_one_point_a_stratum),
		cmocka_unit_test(grids_go_through_every_combination),
		cmocka_unit_test(levels_have_equal_shares),
		cmocka_unit_test(log_scales_are_powers),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
