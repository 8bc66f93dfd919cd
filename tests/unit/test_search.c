/* The pattern search on the plain C path: against the oracle, and its laws. */
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const hulls[] = { "npl_parent", "bsra_trawler", "highspeed_craft", "wigley",
	                                 "wigley_noisy" };
enum { HULL_COUNT = 5 };

static batten_search_options reference_options(void)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	return options;
}

static batten_search_result run(const search_case *c, const batten_search_problem *problem,
                                const batten_search_options *options, double *y)
{
	batten_search_result result;
	assert_int_equal(
		batten_search_batch(c->context, &c->grid, 1, problem, options, y, &result, NULL),
		BATTEN_OK);
	return result;
}

static double *room_for(size_t count)
{
	double *numbers = calloc(count, sizeof *numbers);
	assert_non_null(numbers);
	return numbers;
}

/* What the search says of its objective is what the oracle finds, at the start and at the end. */
static void test_objective_is_the_oracles(void **state)
{
	(void)state;
	for (size_t h = 0; h < HULL_COUNT; h++) {
		search_case c = search_case_open(hulls[h], 0.01, false);
		const batten_search_options options = reference_options();
		const batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
		const oracle_problem known = search_case_oracle(&c, 1.0, 1e4);
		double *y = room_for(c.nodes);
		const batten_search_result result = run(&c, &problem, &options, y);
		const double start = (double)oracle_objective(&known, batten_hull_y_m(c.hull));
		const double end = (double)oracle_objective(&known, y);
		assert_true(fabs(result.objective_start - start) <= 1e-12 * start);
		assert_true(fabs(result.objective_end - end) <= 1e-12 * end);
		assert_true(end < start);
		free(y);
		search_case_close(&c);
	}
}

/* For a large w2 the offsets move along the energy's gradient: what the search leaves out of the
 * first-order movement falls as 1 / w2^2. */
static void test_first_order_movement(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley", 0.5, false);
	batten_search_options options = reference_options();
	options.last_step = 1e-10;
	double *y = room_for(c.nodes);
	long double *known = calloc(c.nodes, sizeof *known);
	assert_non_null(known);
	double worst[2];
	const double weights[2] = { 1e7, 1e8 };
	for (int w = 0; w < 2; w++) {
		const batten_search_problem problem = search_case_problem(&c, 1.0, weights[w]);
		const oracle_problem oracle = search_case_oracle(&c, 1.0, weights[w]);
		(void)run(&c, &problem, &options, y);
		assert_true(oracle_first_order(&oracle, known));
		double largest = 0.0;
		worst[w] = 0.0;
		for (size_t n = 0; n < c.nodes; n++) {
			const double moved = y[n] - batten_hull_y_m(c.hull)[n];
			worst[w] = fmax(worst[w], fabs(moved - (double)known[n]));
			largest = fmax(largest, fabs((double)known[n]));
		}
		assert_true(largest > 1e-7 / (w ? 10.0 : 1.0));
		assert_true(worst[w] < 0.05 * largest);
	}
	assert_true(worst[1] < worst[0] / 50.0);
	free(known);
	free(y);
	search_case_close(&c);
}

enum { PLANE_STATIONS = 11, PLANE_WATERLINES = 9, PLANE_NODES = PLANE_STATIONS * PLANE_WATERLINES };

/* A plane-sided hull with a rising keel and a raked stem has no curvature: whatever the weights, it
 * stays. A stencil that reached across the edge would see a cliff. */
static void test_plane_sided_hull_stays(void **state)
{
	(void)state;
	double x[PLANE_STATIONS], z[PLANE_WATERLINES], y[PLANE_NODES], end[PLANE_NODES];
	double lower[PLANE_NODES], upper[PLANE_NODES];
	uint8_t nodes[PLANE_NODES];
	for (int i = 0; i < PLANE_STATIONS; i++)
		x[i] = 2.0 * i + 0.03 * i * i;
	for (int k = 0; k < PLANE_WATERLINES; k++)
		z[k] = 0.3 * k + 0.01 * k * k;
	for (int n = 0; n < PLANE_NODES; n++) {
		const int i = n % PLANE_STATIONS;
		const int k = n / PLANE_STATIONS;
		nodes[n] = 2 * k >= 5 - i && i <= 7 + k / 2;
		y[n] = nodes[n] ? 1.5 - 0.04 * x[i] + 0.2 * z[k] : 0.0;
		lower[n] = 0.0;
		upper[n] = nodes[n] ? 3.0 : 0.0;
	}
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	const batten_search_options options = reference_options();
	const batten_grid grid = { PLANE_STATIONS, PLANE_WATERLINES, x, z };
	const double weights[][2] = {
		{ 1.0, 0.0 }, { 1.0, 1e-3 }, { 1.0, 1.0 }, { 1.0, 1e4 }, { 1e4, 1.0 }
	};
	for (size_t w = 0; w < sizeof weights / sizeof weights[0]; w++) {
		const batten_search_problem problem = { .nodes = nodes,
			                                    .start_m = y,
			                                    .target_m = y,
			                                    .lower_m = lower,
			                                    .upper_m = upper,
			                                    .w1 = weights[w][0],
			                                    .w2 = weights[w][1],
			                                    .half_beam_m = 2.0 };
		batten_search_result result;
		assert_int_equal(
			batten_search_batch(context, &grid, 1, &problem, &options, end, &result, NULL),
			BATTEN_OK);
		for (int n = 0; n < PLANE_NODES; n++)
			assert_true(fabs(end[n] - y[n]) <= 1e-6 * 4.0);
	}
	batten_context_destroy(context);
}

/* A hull's result is the same alone, in a batch, in any order, and on one thread or four. */
static void test_result_does_not_depend_on_the_batch(void **state)
{
	(void)state;
	enum { COUNT = 7 };
	search_case c = search_case_open("npl_parent", 0.01, true);
	batten_search_problem problems[COUNT];
	double *together = room_for(COUNT * c.nodes);
	double *alone = room_for(c.nodes);
	const batten_search_options options = reference_options();
	batten_search_result results[COUNT];
	for (int p = 0; p < COUNT; p++)
		problems[p] = search_case_problem(&c, 1.0, pow(10.0, (p * 3) % COUNT));
	batten_context_options chosen;
	batten_context_options_default(&chosen);
	chosen.threads = 4;
	batten_context *four = NULL;
	assert_int_equal(batten_context_create(&chosen, &four), BATTEN_OK);
	assert_int_equal(
		batten_search_batch(four, &c.grid, COUNT, problems, &options, together, results, NULL),
		BATTEN_OK);
	for (int p = 0; p < COUNT; p++) {
		const batten_search_result result = run(&c, &problems[p], &options, alone);
		assert_memory_equal(alone, together + (size_t)p * c.nodes, c.nodes * sizeof *alone);
		assert_true(result.iterations == results[p].iterations &&
		            result.probes == results[p].probes);
	}
	batten_context_destroy(four);
	free(together);
	free(alone);
	search_case_close(&c);
}

/* Started again from its result, with the same target and box, a multilevel search never raises the objective
 * and hardly lowers it. Where closeness holds the hull (w2/w1 from 1e4) nothing moves by more than the
 * final step; along the flat valley of a small w2 it still may. */
static void test_restart_stays(void **state)
{
	(void)state;
	static const double weights[] = { 4.0, 400.0, 1e4, 1e6 };
	for (size_t h = 0; h < HULL_COUNT; h++) {
		search_case c = search_case_open(hulls[h], 0.01, true);
		double *first = room_for(c.nodes);
		double *second = room_for(c.nodes);
		for (size_t w = 0; w < sizeof weights / sizeof weights[0]; w++) {
			batten_search_options options = reference_options();
			options.algorithm = BATTEN_ALGORITHM_MULTILEVEL;
			options.last_step = 2e-7;
			batten_search_problem problem = search_case_problem(&c, 1.0, weights[w]);
			const batten_search_result result = run(&c, &problem, &options, first);
			assert_true(result.objective_end <= result.objective_start);
			problem.start_m = first;
			/* Larger steps were tried already. */
			options.first_step = 4e-7;
			const batten_search_result again = run(&c, &problem, &options, second);
			assert_true(again.objective_end <= result.objective_end);
			assert_true(again.objective_end >= (1.0 - 1e-8) * result.objective_end);
			for (size_t n = 0; n < c.nodes && weights[w] >= 1e4; n++)
				assert_true(fabs(second[n] - first[n]) <= 2e-7 * c.half_beam_m);
		}
		free(first);
		free(second);
		search_case_close(&c);
	}
}

/* Scaled by a power of two, every number of a search scales exactly. */
static void test_scale_law(void **state)
{
	(void)state;
	search_case c = search_case_open("bsra_trawler", 0.02, false);
	const size_t nx = c.grid.station_count;
	const size_t nz = c.grid.waterline_count;
	double *large[5];
	const double *small[5] = { batten_hull_y_m(c.hull), c.lower_m, c.upper_m, c.grid.x_m,
		                       c.grid.z_m };
	const size_t counts[5] = { c.nodes, c.nodes, c.nodes, nx, nz };
	for (int a = 0; a < 5; a++) {
		large[a] = room_for(counts[a]);
		for (size_t n = 0; n < counts[a]; n++)
			large[a][n] = 4.0 * small[a][n];
	}
	double *y = room_for(c.nodes);
	double *scaled = room_for(c.nodes);
	const batten_search_options options = reference_options();
	batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	const batten_search_result result = run(&c, &problem, &options, y);
	problem.start_m = problem.target_m = large[0];
	problem.lower_m = large[1];
	problem.upper_m = large[2];
	problem.half_beam_m *= 4.0;
	c.grid.x_m = large[3];
	c.grid.z_m = large[4];
	const batten_search_result other = run(&c, &problem, &options, scaled);
	assert_true(result.objective_end == other.objective_end);
	for (size_t n = 0; n < c.nodes; n++)
		assert_true(scaled[n] == 4.0 * y[n]);
	for (int a = 0; a < 5; a++)
		free(large[a]);
	free(y);
	free(scaled);
	search_case_close(&c);
}

/* Mirrored fore and aft, a hull fairs to its mirror image. */
static void test_mirror(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	const size_t nx = c.grid.station_count;
	double *y = room_for(c.nodes);
	double *mirrored = room_for(c.nodes);
	double *start = room_for(c.nodes);
	double *lower = room_for(c.nodes);
	double *upper = room_for(c.nodes);
	for (size_t n = 0; n < c.nodes; n++) {
		const size_t m = n / nx * nx + (nx - 1 - n % nx);
		start[m] = batten_hull_y_m(c.hull)[n];
		lower[m] = c.lower_m[n];
		upper[m] = c.upper_m[n];
	}
	const batten_search_options options = reference_options();
	batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	const batten_search_result result = run(&c, &problem, &options, y);
	problem.start_m = problem.target_m = start;
	problem.lower_m = lower;
	problem.upper_m = upper;
	const batten_search_result other = run(&c, &problem, &options, mirrored);
	assert_true(fabs(result.objective_end - other.objective_end) <= 1e-9 * result.objective_end);
	for (size_t n = 0; n < c.nodes; n++)
		assert_true(fabs(y[n] - mirrored[n / nx * nx + (nx - 1 - n % nx)]) <= 1e-4 * c.half_beam_m);
	free(y);
	free(mirrored);
	free(start);
	free(lower);
	free(upper);
	search_case_close(&c);
}

/* A hull that cannot be searched is refused with a reason; its neighbours are not harmed. */
static void test_faulty_problems_are_refused(void **state)
{
	(void)state;
	enum { COUNT = 5 };
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	double *bad_start = room_for(c.nodes);
	double *bad_lower = room_for(c.nodes);
	memcpy(bad_start, batten_hull_y_m(c.hull), c.nodes * sizeof *bad_start);
	memcpy(bad_lower, c.lower_m, c.nodes * sizeof *bad_lower);
	bad_start[77] = NAN;
	bad_lower[78] = 2.0;
	batten_search_problem problems[COUNT];
	for (int p = 0; p < COUNT; p++)
		problems[p] = search_case_problem(&c, 1.0, 1e4);
	problems[0].start_m = bad_start;
	problems[2].lower_m = bad_lower;
	problems[3].w2 = -1.0;
	problems[4].half_beam_m = 0.0;
	double *y = room_for(COUNT * c.nodes);
	double *alone = room_for(c.nodes);
	batten_search_result results[COUNT];
	const batten_search_options options = reference_options();
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, COUNT, problems, &options, y, results, NULL),
		BATTEN_INCOMPLETE);
	for (int p = 0; p < COUNT; p++) {
		assert_int_equal(results[p].end == BATTEN_SEARCH_REFUSED, p != 1);
		assert_int_equal(results[p].message[0] != '\0', p != 1);
	}
	(void)run(&c, &problems[1], &options, alone);
	assert_memory_equal(alone, y + c.nodes, c.nodes * sizeof *alone);
	free(bad_start);
	free(bad_lower);
	free(y);
	free(alone);
	search_case_close(&c);
}

static void test_ends_are_told_apart(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	double *y = room_for(c.nodes);
	batten_search_result result;
	batten_search_options options = reference_options();
	batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	options.iteration_limit = 2;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
		BATTEN_INCOMPLETE);
	assert_int_equal(result.end, BATTEN_SEARCH_LIMIT);
	assert_int_equal(result.iterations, 2);
	options = reference_options();
	/* Nothing but closeness: the start is the minimum. */
	problem.w1 = 0.0;
	result = run(&c, &problem, &options, y);
	assert_int_equal(result.end, BATTEN_SEARCH_STATIONARY);
	assert_memory_equal(y, batten_hull_y_m(c.hull), c.nodes * sizeof *y);
	free(y);
	search_case_close(&c);
}

static void test_bad_arguments(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	double *y = room_for(c.nodes);
	batten_search_result result;
	for (int fault = 0; fault < 11; fault++) {
		batten_search_options options = reference_options();
		batten_grid grid = c.grid;
		double x[21];
		memcpy(x, grid.x_m, sizeof x);
		switch (fault) {
		case 0:
			grid.station_count = 2;
			break;
		case 1:
			grid.waterline_count = 4097;
			break;
		case 2:
			x[5] = x[4];
			grid.x_m = x;
			break;
		case 3:
			options.first_step = -1.0;
			break;
		case 4:
			options.last_step = 1.0;
			break;
		case 5:
			options.iteration_limit = 0;
			break;
		case 6:
			options.lanes = 3;
			break;
		case 7:
			options.first_step = options.last_step = 1e-3;
			break;
		case 8:
			options.algorithm = (batten_search_algorithm)7;
			break;
		case 9:
			options.algorithm = (batten_search_algorithm)99;
			break;
		default:
			options.device = -7;
			break;
		}
		assert_int_equal(
			batten_search_batch(c.context, &grid, 1, &problem, &options, y, &result, NULL),
			BATTEN_USAGE);
		assert_true(batten_context_error(c.context)[0] != '\0');
	}
	free(y);
	search_case_close(&c);
}

/* Memory that fails at any point ends in MEMORY, with nothing left behind. */
typedef struct failing_heap {
	long countdown;
	long live;
} failing_heap;

static void *take(size_t size, void *user)
{
	failing_heap *heap = user;
	if (heap->countdown-- == 0)
		return NULL;
	heap->live++;
	return malloc(size);
}

static void give(void *memory, void *user)
{
	failing_heap *heap = user;
	heap->live--;
	free(memory);
}

static void test_failing_memory(void **state)
{
	(void)state;
	search_case c = search_case_open("bsra_trawler", 0.01, false);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	const batten_search_options options = reference_options();
	double *y = room_for(c.nodes);
	batten_search_result result;
	batten_status status = BATTEN_MEMORY;
	for (long k = 0; status == BATTEN_MEMORY; k++) {
		assert_true(k < 1000);
		failing_heap heap = { .countdown = k };
		batten_context_options chosen;
		batten_context_options_default(&chosen);
		chosen.allocate = take;
		chosen.release = give;
		chosen.allocate_user = &heap;
		chosen.threads = 1;
		batten_context *context = NULL;
		status = batten_context_create(&chosen, &context);
		if (status == BATTEN_OK)
			status = batten_search_batch(context, &c.grid, 1, &problem, &options, y, &result, NULL);
		batten_context_destroy(context);
		assert_int_equal(heap.live, 0);
	}
	assert_int_equal(status, BATTEN_OK);
	free(y);
	search_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_objective_is_the_oracles),
		cmocka_unit_test(test_first_order_movement),
		cmocka_unit_test(test_plane_sided_hull_stays),
		cmocka_unit_test(test_result_does_not_depend_on_the_batch),
		cmocka_unit_test(test_restart_stays),
		cmocka_unit_test(test_scale_law),
		cmocka_unit_test(test_mirror),
		cmocka_unit_test(test_faulty_problems_are_refused),
		cmocka_unit_test(test_ends_are_told_apart),
		cmocka_unit_test(test_bad_arguments),
		cmocka_unit_test(test_failing_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
