#include "support/search_case.h"

#include "fairing/gross_errors.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

search_case search_case_open(const char *name, double part, bool smoothed)
{
	search_case c = { 0 };
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	assert_int_equal(batten_context_create(NULL, &c.context), BATTEN_OK);
	if (batten_hull_read(c.context, path, &c.hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(c.context));
	if (smoothed) {
		batten_replacement *list = NULL;
		size_t count = 0;
		assert_int_equal(gross_errors_replace(c.hull, NULL, &list, &count), BATTEN_OK);
		batten_release(c.context, list);
	}
	c.grid = (batten_grid){ batten_hull_station_count(c.hull), batten_hull_waterline_count(c.hull),
		                    batten_hull_x_m(c.hull), batten_hull_z_m(c.hull) };
	c.nodes = c.grid.station_count * c.grid.waterline_count;
	c.half_beam_m = batten_hull_half_beam_m(c.hull);
	c.lower_m = calloc(c.nodes, sizeof *c.lower_m);
	c.upper_m = calloc(c.nodes, sizeof *c.upper_m);
	assert_non_null(c.lower_m);
	assert_non_null(c.upper_m);
	const double *y = batten_hull_y_m(c.hull);
	for (size_t n = 0; n < c.nodes; n++) {
		const double room = y[n] > 0.0 ? part * c.half_beam_m : 0.0;
		c.lower_m[n] = fmax(0.0, y[n] - room);
		c.upper_m[n] = fmin(1.2 * c.half_beam_m, y[n] + room);
	}
	return c;
}

void search_case_close(search_case *c)
{
	free(c->lower_m);
	free(c->upper_m);
	batten_hull_destroy(c->hull);
	batten_context_destroy(c->context);
}

batten_search_problem search_case_problem(const search_case *c, double w1, double w2)
{
	return (batten_search_problem){ .nodes = batten_hull_nodes(c->hull),
		                            .start_m = batten_hull_y_m(c->hull),
		                            .target_m = batten_hull_y_m(c->hull),
		                            .lower_m = c->lower_m,
		                            .upper_m = c->upper_m,
		                            .w1 = w1,
		                            .w2 = w2,
		                            .half_beam_m = c->half_beam_m };
}

oracle_problem search_case_oracle(const search_case *c, double w1, double w2)
{
	return (oracle_problem){ .nx = c->grid.station_count,
		                     .nz = c->grid.waterline_count,
		                     .x = c->grid.x_m,
		                     .z = c->grid.z_m,
		                     .nodes = batten_hull_nodes(c->hull),
		                     .start = batten_hull_y_m(c->hull),
		                     .target = batten_hull_y_m(c->hull),
		                     .lower = c->lower_m,
		                     .upper = c->upper_m,
		                     .w1 = w1,
		                     .w2 = w2,
		                     .h = c->half_beam_m };
}

double *search_case_room(const search_case *c)
{
	double *numbers = calloc(c->nodes, sizeof *numbers);
	assert_non_null(numbers);
	return numbers;
}

batten_certificate search_case_certify(const search_case *c, const batten_search_problem *problem,
                                       const batten_search_options *options, const double *y)
{
	batten_certificate found;
	assert_int_equal(
		batten_search_certify_batch(c->context, &c->grid, 1, problem, options, y, &found),
		BATTEN_OK);
	return found;
}

batten_search_result search_case_run(const search_case *c, const batten_search_problem *problem,
                                     const batten_search_options *options, double *y)
{
	batten_search_result result;
	const batten_status status = batten_search_batch(c->context, &c->grid, 1, problem, options, y,
	                                                 &result, NULL);
	assert_true(status == BATTEN_OK || status == BATTEN_INCOMPLETE);
	assert_int_not_equal(result.end, BATTEN_SEARCH_REFUSED);
	return result;
}

double search_case_rms(const search_case *c, const double *y)
{
	const double *start = batten_hull_y_m(c->hull);
	double sum = 0.0;
	size_t count = 0;
	for (size_t n = 0; n < c->nodes; n++)
		if (start[n] > 0.0) {
			sum += (y[n] - start[n]) * (y[n] - start[n]);
			count++;
		}
	return sqrt(sum / (double)count);
}
