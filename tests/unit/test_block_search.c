/* The block search on the plain C path: its minimum is the oracle's, on every shipped hull, on grids of
 * other kinds, over many seeds; what it refuses. */
#include "support/cases.h"
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static batten_search_options block_options(batten_precision precision)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	options.precision = precision;
	return options;
}

/* How far the search's objective is above the oracle's minimum, relative to it. */
static double gap_of(const search_case *c, double w2, batten_precision precision)
{
	double *y = calloc(c->nodes, sizeof *y);
	double *known = calloc(c->nodes, sizeof *known);
	assert_non_null(y);
	assert_non_null(known);
	const batten_search_options options = block_options(precision);
	const batten_search_problem problem = search_case_problem(c, 1.0, w2);
	oracle_problem oracle = search_case_oracle(c, 1.0, w2);
	batten_search_result result;
	assert_int_equal(
		batten_search_batch(c->context, &c->grid, 1, &problem, &options, y, &result, NULL),
		BATTEN_OK);
	assert_int_equal(result.algorithm, BATTEN_ALGORITHM_BLOCK);
	assert_true(result.iterations <= 60);
	oracle_minimum minimum;
	oracle.start = y;
	assert_true(oracle_minimise(&oracle, known, &minimum) && minimum.converged);
	const double found = (double)oracle_objective(&oracle, y);
	const double best = (double)oracle_objective(&oracle, known);
	free(y);
	free(known);
	return (found - best) / best;
}

static void test_minimum_is_the_oracles(void **state)
{
	(void)state;
	static const char *const hulls[] = { "npl_parent", "bsra_trawler", "highspeed_craft",
		                                 "wigley" };
	static const double weights[] = { 4.0, 400.0, 4e4 };
	static const double parts[] = { 0.01, 0.003 };
	for (size_t h = 0; h < sizeof hulls / sizeof hulls[0]; h++)
		for (int p = 0; p < 2; p++) {
			search_case c = search_case_open(hulls[h], parts[p], true);
			for (size_t w = 0; w < sizeof weights / sizeof weights[0]; w++) {
				assert_true(gap_of(&c, weights[w], BATTEN_F64) <= 4e-9);
				if (w != 1)
					assert_true(gap_of(&c, weights[w], BATTEN_F32) <= 2e-5);
			}
			search_case_close(&c);
		}
}

/* A noisy hull of a wave's form over a grid of its own. */
enum { STATIONS = 21, WATERLINES = 20, MOST = 61 * 31 };
typedef struct noisy_hull {
	size_t nx, nz;
	double x[61], z[31];
	double y[MOST], lower[MOST], upper[MOST], end[MOST];
} noisy_hull;

static void make_noisy(noisy_hull *hull, uint32_t seed, double noise)
{
	uint32_t number = 2654435761u * (seed + 1);
	for (size_t n = 0; n < hull->nx * hull->nz; n++) {
		number = number * 1664525u + 1013904223u;
		const double u = hull->x[n % hull->nx] / hull->x[hull->nx - 1];
		const double v = 1.0 - hull->z[n / hull->nx] / hull->z[hull->nz - 1];
		const double form = 3.2 * u * (1.0 - u) * (1.0 - v * v);
		const double y = form + 2.0 * noise * ((double)(number >> 8) / (1u << 24) - 0.5);
		hull->y[n] = fmin(fmax(y, 0.0), 0.8);
		hull->lower[n] = 0.0;
		hull->upper[n] = 0.8;
	}
}

static batten_search_problem problem_of(const noisy_hull *hull, double w2)
{
	return (batten_search_problem){ .start_m = hull->y,
		                            .target_m = hull->y,
		                            .lower_m = hull->lower,
		                            .upper_m = hull->upper,
		                            .w1 = 1.0,
		                            .w2 = w2,
		                            .half_beam_m = 0.8 };
}

static batten_search_result run(batten_context *context, noisy_hull *hull, double w2,
                                const batten_search_options *options)
{
	const batten_grid grid = { hull->nx, hull->nz, hull->x, hull->z };
	const batten_search_problem problem = problem_of(hull, w2);
	batten_search_result result;
	assert_int_equal(
		batten_search_batch(context, &grid, 1, &problem, options, hull->end, &result, NULL),
		BATTEN_OK);
	return result;
}

/* Objective of the minimum that Newton's method by exact derivatives reaches from the search's end. */
static double polished(batten_context *context, noisy_hull *hull, double w2,
                       const batten_search_options *options)
{
	const batten_grid grid = { hull->nx, hull->nz, hull->x, hull->z };
	const batten_search_problem problem = problem_of(hull, w2);
	batten_certificate certificate;
	assert_int_equal(batten_search_polish_batch(context, &grid, 1, &problem, options, 1e-14,
	                                            hull->end, &certificate),
	                 BATTEN_OK);
	assert_true(certificate.gap_estimate <= 1e-14);
	return certificate.objective;
}

/* The gap to where the oracle's Newton method gets from the search's end. */
static double gap_of_noisy(batten_context *context, noisy_hull *hull, double w2)
{
	const batten_search_options options = block_options(BATTEN_F64);
	const batten_search_result result = run(context, hull, w2, &options);
	const oracle_problem oracle = { .nx = hull->nx,
		                            .nz = hull->nz,
		                            .x = hull->x,
		                            .z = hull->z,
		                            .start = hull->end,
		                            .target = hull->y,
		                            .lower = hull->lower,
		                            .upper = hull->upper,
		                            .w1 = 1.0,
		                            .w2 = w2,
		                            .h = 0.8 };
	double best[MOST];
	oracle_minimum minimum;
	assert_true(oracle_minimise(&oracle, best, &minimum) && minimum.converged);
	return (result.objective_end - (double)minimum.objective) / (double)minimum.objective;
}

/* Square cells, lines along x, and spacing that changes from line to line; at the least weight hats couple
 * the lines on each. */
static void test_grids_of_other_kinds(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	for (int kind = 0; kind < 3; kind++)
		for (int power = 0; power < 4; power++) {
			const double w2 = 0.4 * pow(100.0, power);
			noisy_hull hull = { .nx = 13, .nz = 11 };
			for (size_t i = 0; i < hull.nx; i++)
				hull.x[i] = kind == 0   ? 0.1 * (double)i
				            : kind == 1 ? 0.05 * (double)i
				                        : 0.7 * (double)i + 0.05 * (double)(i * i);
			for (size_t k = 0; k < hull.nz; k++)
				hull.z[k] = kind == 0   ? 0.1 * (double)k
				            : kind == 1 ? 0.3 * (double)k
				                        : 0.05 * (double)k + 0.004 * (double)(k * k);
			make_noisy(&hull, 5, 0.01);
			assert_true(gap_of_noisy(context, &hull, w2) <= 1e-6);
		}
	batten_context_destroy(context);
}

static noisy_hull noisy_over(size_t nx, size_t nz, double dx, double dz)
{
	noisy_hull hull = { .nx = nx, .nz = nz };
	for (size_t i = 0; i < nx; i++)
		hull.x[i] = dx * (double)i;
	for (size_t k = 0; k < nz; k++)
		hull.z[k] = dz * (double)k;
	make_noisy(&hull, 1, 0.01);
	return hull;
}

/* Finer tables, and square cells, take few more iterations than 21 x 20 stretched ones at the same weights: lines
 * alone, lines that take rounds, with hats and without. */
static void test_iterations_on_finer_grids(void **state)
{
	(void)state;
	static const struct {
		size_t nx, nz;
		double dx, dz, w2;
		unsigned most;
	} grids[] = { { 21, 20, 0.8, 1.0 / 19.0, 40.96, 14 },
		          { 21, 20, 0.8, 1.0 / 19.0, 4.096, 15 },
		          { 21, 20, 1.0 / 19.0, 1.0 / 19.0, 40.96, 20 },
		          { 21, 20, 1.0 / 19.0, 1.0 / 19.0, 4096.0, 12 },
		          { 61, 31, 16.0 / 60.0, 1.0 / 30.0, 4.096, 20 },
		          { 61, 31, 16.0 / 60.0, 1.0 / 30.0, 40.96, 17 },
		          { 61, 31, 16.0 / 60.0, 1.0 / 30.0, 409.6, 8 } };
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	const batten_search_options options = block_options(BATTEN_F64);
	for (size_t g = 0; g < sizeof grids / sizeof grids[0]; g++) {
		noisy_hull hull = noisy_over(grids[g].nx, grids[g].nz, grids[g].dx, grids[g].dz);
		const batten_search_result result = run(context, &hull, grids[g].w2, &options);
		print_message("%zu x %zu, w2 %g: %u iterations\n", grids[g].nx, grids[g].nz, grids[g].w2,
		              result.iterations);
		assert_true(result.iterations <= grids[g].most);
		const double best = polished(context, &hull, grids[g].w2, &options);
		assert_true(fabs(result.objective_end - best) <= 1e-8 * best);
	}
	batten_context_destroy(context);
}

/* The first iteration takes nearly all of the noise: slopes along the first derivatives, which say that steeper
 * is better, would lead it away. Begun at its end, a search is over soon, and no worse. */
static void test_first_iteration(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	noisy_hull hull = noisy_over(61, 31, 16.0 / 60.0, 1.0 / 30.0);
	const batten_grid grid = { hull.nx, hull.nz, hull.x, hull.z };
	batten_search_problem problem = problem_of(&hull, 409.6);
	batten_search_options options = block_options(BATTEN_F64);
	const batten_search_result whole = run(context, &hull, problem.w2, &options);
	assert_true(whole.objective_start > 100.0 * whole.objective_end);
	noisy_hull end = hull;
	batten_search_result result;
	problem.start_m = hull.end;
	assert_int_equal(
		batten_search_batch(context, &grid, 1, &problem, &options, end.end, &result, NULL),
		BATTEN_OK);
	assert_int_not_equal(result.end, BATTEN_SEARCH_LIMIT);
	assert_true(result.iterations <= 5);
	assert_true(result.objective_end <= whole.objective_end);
	problem.start_m = hull.y;
	options.iteration_limit = 1;
	assert_int_equal(
		batten_search_batch(context, &grid, 1, &problem, &options, end.end, &result, NULL),
		BATTEN_INCOMPLETE);
	assert_true(result.objective_end < 2.0 * whole.objective_end);
	batten_context_destroy(context);
}

/* The block search ends close to the minimum, whatever the noise: 12 seeds, 3 levels, 3 weights. */
static void test_robust_against_noise(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	static const double noises[] = { 0.005, 0.01, 0.02 };
	static const double weights[] = { 10.0, 1e3, 1e5 };
	const batten_search_options options = block_options(BATTEN_F64);
	const batten_search_options single = block_options(BATTEN_F32);
	double worst = 0.0, worst_f32 = 0.0;
	for (uint32_t seed = 0; seed < CASES(12, 1); seed++)
		for (size_t noise = 0; noise < 3; noise++)
			for (size_t w = 0; w < 3; w++) {
				noisy_hull hull = { .nx = STATIONS, .nz = WATERLINES };
				for (size_t i = 0; i < hull.nx; i++)
					hull.x[i] = 0.8 * (double)i;
				for (size_t k = 0; k < hull.nz; k++)
					hull.z[k] = (double)k / 19.0;
				make_noisy(&hull, seed, noises[noise]);
				const double w2 = 0.4096 * weights[w];
				const double found_f32 = run(context, &hull, w2, &single).objective_end;
				const double found = run(context, &hull, w2, &options).objective_end;
				const double best = polished(context, &hull, w2, &options);
				worst = fmax(worst, fabs(found - best) / best);
				worst_f32 = fmax(worst_f32, fabs(found_f32 - best) / best);
			}
	print_message("worst gap %.2g, f32 %.2g\n", worst, worst_f32);
	assert_true(worst <= 1e-6);
	assert_true(worst_f32 <= 5e-5);
	batten_context_destroy(context);
}

/* Offsets of which many are held by bounds at the minimum, begun a rounding, or little more, off these: they
 * stop at once on their way, and what their lines would gain with them is not the end of the search. */
static void test_begins_beside_bounds(void **state)
{
	(void)state;
	static const double rooms[] = { 1e-13, 5e-8, 1e-5 }; /* half-beams */
	search_case c = search_case_open("wigley_noisy", 0.01, true);
	const batten_search_options options = block_options(BATTEN_F64);
	double *y = calloc(c.nodes, sizeof *y);
	double *start = calloc(c.nodes, sizeof *start);
	assert_true(y && start);
	for (size_t run = 0; run < 6; run++) {
		batten_search_problem problem = search_case_problem(&c, 1.0, run < 3 ? 40.0 : 1e4);
		const double room = rooms[run % 3] * c.half_beam_m;
		batten_search_result whole, again;
		assert_int_equal(
			batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &whole, NULL),
			BATTEN_OK);
		size_t held = 0;
		for (size_t n = 0; n < c.nodes; n++) {
			const double middle = 0.5 * (c.lower_m[n] + c.upper_m[n]);
			const bool at_bound = y[n] <= c.lower_m[n] || y[n] >= c.upper_m[n];
			if (!(c.lower_m[n] < c.upper_m[n]))
				start[n] = y[n];
			else if (at_bound)
				start[n] = y[n] + (y[n] < middle ? room : -room);
			else
				start[n] = y[n] + 0.1 * (middle - y[n]);
			held += at_bound && c.lower_m[n] < c.upper_m[n];
		}
		assert_true(held > 20);
		problem.start_m = start;
		assert_int_equal(
			batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &again, NULL),
			BATTEN_OK);
		print_message("%zu held, room %.0e: %u iterations, %.2e above the other end\n", held, room,
		              again.iterations, again.objective_end / whole.objective_end - 1.0);
		assert_true(fabs(again.objective_end / whole.objective_end - 1.0) < 1e-8);
	}
	free(start);
	free(y);
	search_case_close(&c);
}

/* Slopes by formula end where probing does. */
static void test_slopes_by_formula(void **state)
{
	(void)state;
	search_case c = search_case_open("highspeed_craft", 0.01, true);
	double *y = calloc(2 * c.nodes, sizeof *y);
	assert_non_null(y);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e3);
	batten_search_options options = block_options(BATTEN_F64);
	batten_search_result probed, derived;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &probed, NULL),
		BATTEN_OK);
	options.analytic_slopes = true;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, y + c.nodes, &derived, NULL),
		BATTEN_OK);
	assert_int_equal(probed.iterations, derived.iterations);
	assert_true(fabs(probed.objective_end / derived.objective_end - 1.0) <= 1e-10);
	free(y);
	search_case_close(&c);
}

/* A stream whose source uses one set of arrays again and again. */
typedef struct noisy_stream {
	noisy_hull *hull;
	size_t count, taken, given, bad; /* bad: the search that is refused */
	batten_status source_says, sink_says;
	double ends[5];
	batten_search_end how[5];
} noisy_stream;

static batten_status next_hull(void *user, size_t index, batten_search_problem *problem)
{
	noisy_stream *s = user;
	assert_int_equal(index, s->taken);
	assert_null(problem->start_m);
	if (index == s->count)
		return s->source_says;
	s->taken++;
	make_noisy(s->hull, (uint32_t)index, 0.01);
	*problem = problem_of(s->hull, index == s->bad ? -1.0 : 40.96 * (double)(index + 1));
	return BATTEN_OK;
}

static batten_status take_end(void *user, size_t index, const batten_search_result *result,
                              const double *y_m)
{
	noisy_stream *s = user;
	assert_int_equal(index, s->given++);
	s->how[index] = result->end;
	s->ends[index] = result->objective_end;
	assert_true(result->end == BATTEN_SEARCH_REFUSED || y_m[s->hull->nx + 1] >= 0.0);
	return s->sink_says;
}

static void test_stream(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	noisy_hull hull = { .nx = 21, .nz = 20 };
	for (size_t i = 0; i < hull.nx; i++)
		hull.x[i] = 0.8 * (double)i;
	for (size_t k = 0; k < hull.nz; k++)
		hull.z[k] = (double)k / 19.0;
	const batten_grid grid = { hull.nx, hull.nz, hull.x, hull.z };
	const batten_search_options options = block_options(BATTEN_F64);
	noisy_stream s = { .hull = &hull, .count = 5, .bad = 99 };
	batten_run told;
	size_t count = 99;
	assert_int_equal(
		batten_fair_stream(context, &grid, next_hull, take_end, &s, &options, &count, &told),
		BATTEN_OK);
	assert_int_equal(count, 5);
	assert_true(told.strict && strcmp(told.device, "reference") == 0);
	for (size_t p = 0; p < 5; p++) {
		make_noisy(&hull, (uint32_t)p, 0.01);
		const double known = run(context, &hull, 40.96 * (double)(p + 1), &options).objective_end;
		assert_memory_equal(&s.ends[p], &known, sizeof known);
	}
	s = (noisy_stream){ .hull = &hull, .count = 3, .bad = 1 };
	assert_int_equal(
		batten_fair_stream(context, &grid, next_hull, take_end, &s, &options, &count, NULL),
		BATTEN_INCOMPLETE);
	assert_int_equal(s.how[0], BATTEN_SEARCH_CONVERGED);
	assert_int_equal(s.how[1], BATTEN_SEARCH_REFUSED);
	assert_int_equal(count, 3);
	s = (noisy_stream){ .hull = &hull, .count = 3, .bad = 99, .source_says = BATTEN_INPUT };
	assert_int_equal(
		batten_fair_stream(context, &grid, next_hull, take_end, &s, &options, &count, NULL),
		BATTEN_INPUT);
	assert_int_equal(s.given, 0);
	s = (noisy_stream){ .hull = &hull, .count = 3, .bad = 99, .sink_says = BATTEN_IO };
	assert_int_equal(
		batten_fair_stream(context, &grid, next_hull, take_end, &s, &options, &count, NULL),
		BATTEN_IO);
	assert_int_equal(s.given, 1);
	s = (noisy_stream){ .hull = &hull };
	assert_int_equal(
		batten_fair_stream(context, &grid, next_hull, take_end, &s, &options, &count, NULL),
		BATTEN_OK);
	assert_int_equal(count, 0);
	batten_context_destroy(context);
}

static void test_refusals(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley", 0.01, false);
	double *y = calloc(2 * c.nodes, sizeof *y);
	double *bad = calloc(c.nodes, sizeof *bad);
	assert_non_null(y);
	assert_non_null(bad);
	memcpy(bad, batten_hull_y_m(c.hull), c.nodes * sizeof *bad);
	bad[30] = INFINITY;
	batten_search_problem problems[2] = { search_case_problem(&c, 1.0, 1e3),
		                                  search_case_problem(&c, 1.0, 1e3) };
	problems[0].start_m = bad;
	batten_search_result results[2];
	batten_search_options options = block_options(BATTEN_F64);
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 2, problems, &options, y, results, NULL),
		BATTEN_INCOMPLETE);
	assert_int_equal(results[0].end, BATTEN_SEARCH_REFUSED);
	assert_int_equal(results[1].end, BATTEN_SEARCH_CONVERGED);
	options.fairness = BATTEN_FAIRNESS_MEAN;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, problems + 1, &options, y, results, NULL),
		BATTEN_USAGE);
	options.algorithm = BATTEN_ALGORITHM_AUTO;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, problems + 1, &options, y, results, NULL),
		BATTEN_OK);
	assert_int_equal(results[0].algorithm, BATTEN_ALGORITHM_MULTILEVEL);
	free(y);
	free(bad);
	search_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_minimum_is_the_oracles),
		cmocka_unit_test(test_grids_of_other_kinds),
		cmocka_unit_test(test_iterations_on_finer_grids),
		cmocka_unit_test(test_first_iteration),
		cmocka_unit_test(test_robust_against_noise),
		cmocka_unit_test(test_begins_beside_bounds),
		cmocka_unit_test(test_slopes_by_formula),
		cmocka_unit_test(test_stream),
		cmocka_unit_test(test_refusals),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
