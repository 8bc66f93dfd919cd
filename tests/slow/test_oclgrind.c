/* Small block searches, of lines alone and of lines coupled by hats, each with rounds and without, by three
 * work-items under Oclgrind, which watches every access: no race, no access out of bounds, no barrier that some
 * pass by.
 * What it finds it writes to a log; the program knows nothing of it, so the log has to be empty. */
#include "batten.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STATIONS = 6, WATERLINES = 5, NODES = STATIONS * WATERLINES, COUNT = 4 };

static void test_small_searches(void **state)
{
	(void)state;
	const double x[STATIONS] = { 0.0, 1.0, 2.0, 3.0, 4.0, 5.0 };
	const double z[WATERLINES] = { 0.0, 0.5, 1.0, 1.5, 2.0 };
	static const double weights[] = { 1e-4, 0.5, 5.0, 1e3 };
	double y[NODES], lower[NODES], upper[NODES], ends[COUNT * NODES];
	for (int n = 0; n < NODES; n++) {
		const int k = n / STATIONS;
		y[n] = 0.5 + 0.02 * (double)(n * 7 % 5) + 0.05 * (double)k;
		lower[n] = y[n] - 0.04 * (double)(n % 4);
		upper[n] = y[n] + 0.04;
	}
	batten_search_problem problems[COUNT];
	for (int p = 0; p < COUNT; p++)
		problems[p] = (batten_search_problem){ .start_m = y,
			                                   .target_m = y,
			                                   .lower_m = lower,
			                                   .upper_m = upper,
			                                   .w1 = 1.0,
			                                   .w2 = weights[p],
			                                   .half_beam_m = 1.0 };
	const batten_grid grid = { STATIONS, WATERLINES, x, z };
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = 0;
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	options.lanes = 1;
	options.work_group = 3;
	options.iteration_limit = 3;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	batten_search_result results[COUNT];
	batten_run run;
	const batten_status status = batten_search_batch(context, &grid, COUNT, problems, &options,
	                                                 ends, results, &run);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		fail_msg("%s", batten_context_error(context));
	assert_non_null(strstr(run.device, "Oclgrind"));
	assert_true(run.strict);
	assert_true(results[0].objective_end < results[0].objective_start);
	batten_context_destroy(context);
}

static void test_nothing_was_found(void **state)
{
	(void)state;
	char line[256] = "";
	const char *name = getenv("OCLGRIND_LOG");
	assert_non_null(name);
	FILE *log = fopen(name, "r");
	assert_non_null(log);
	while (fgets(line, sizeof line, log) && line[0] == '\n')
		continue;
	(void)fclose(log);
	if (line[0] != '\0' && line[0] != '\n')
		fail_msg("%s says: %s", name, line);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_small_searches),
		cmocka_unit_test(test_nothing_was_found),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
