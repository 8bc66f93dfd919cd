/* Directions of one colour may be worked through in any order: by brute force over every shipped
 * hull, no two of them share a term of the objective and neither reads what the other writes. */
#include "support/search_case.h"

#include "batch/search_plan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What a direction touches, node by node. */
typedef struct footprint {
	uint8_t *writes, *terms, *reads;
} footprint;

static footprint footprint_create(size_t nodes)
{
	footprint f = { calloc(nodes, 1), calloc(nodes, 1), calloc(nodes, 1) };
	assert_non_null(f.writes);
	assert_non_null(f.terms);
	assert_non_null(f.reads);
	return f;
}

static void footprint_release(footprint *f)
{
	free(f->writes);
	free(f->terms);
	free(f->reads);
}

/* Whether a term stands on a node: one of nine, or, of the variation of curvature, of the four beyond. */
static bool stands_on(const search_plan *plan, int x, int z)
{
	const int far = abs(x) > abs(z) ? abs(x) : abs(z);
	return far <= 1 || (plan->fairness == GRID_VARIATION && far == 2 && (x == 0 || z == 0));
}

/* By definition: it writes the nodes under its hat; a term changes where one of its nodes is written; a
 * changed term reads all of them. */
static void trace(const search_plan *plan, const search_level *level, int d, footprint *f)
{
	const int nx = (int)plan->station_count;
	const int nz = (int)plan->waterline_count;
	const int i0 = plan->centres[2 * d];
	const int k0 = plan->centres[2 * d + 1];
	memset(f->writes, 0, (size_t)(nx * nz));
	memset(f->terms, 0, (size_t)(nx * nz));
	memset(f->reads, 0, (size_t)(nx * nz));
	for (int n = 0; n < nx * nz; n++)
		f->writes[n] = abs(n % nx - i0) < level->width_x && abs(n / nx - k0) < level->width_z;
	for (int w = 0; w < nx * nz; w++)
		for (int n = 0; f->writes[w] && n < nx * nz; n++)
			f->terms[n] |= stands_on(plan, n % nx - w % nx, n / nx - w / nx);
	for (int t = 0; t < nx * nz; t++)
		for (int n = 0; f->terms[t] && n < nx * nz; n++)
			f->reads[n] |= stands_on(plan, n % nx - t % nx, n / nx - t / nx);
}

static void check_colour(const search_plan *plan, const search_level *level, int colour)
{
	const size_t nodes = plan->station_count * plan->waterline_count;
	footprint one = footprint_create(nodes);
	footprint other = footprint_create(nodes);
	for (int a = level->first[colour]; a < level->first[colour + 1]; a++) {
		trace(plan, level, a, &one);
		for (int b = a + 1; b < level->first[colour + 1]; b++) {
			trace(plan, level, b, &other);
			for (size_t n = 0; n < nodes; n++) {
				assert_false(one.terms[n] && other.terms[n]);
				assert_false(one.writes[n] && other.reads[n]);
				assert_false(one.reads[n] && other.writes[n]);
			}
		}
	}
	footprint_release(&one);
	footprint_release(&other);
}

static void check_hull(const char *name, batten_fairness fairness)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.fairness = fairness;
	search_case c = search_case_open(name, 0.01, false);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	search_plan *plan = NULL;
	assert_int_equal(search_plan_create(c.context, &c.grid, 1, &problem, &options, &plan),
	                 BATTEN_OK);
	assert_true(plan->level_count >= 2);
	uint8_t *covered = calloc(c.nodes, 1);
	assert_non_null(covered);
	for (int l = 0; l < plan->level_count; l++)
		for (int colour = 0; colour < GRID_COLOURS(plan->fairness); colour++)
			check_colour(plan, &plan->levels[l], colour);
	/* The finest level moves every variable by itself. */
	assert_int_equal(plan->levels[0].width_x, 1);
	assert_int_equal(plan->levels[0].width_z, 1);
	for (int d = plan->levels[0].first[0]; d < plan->levels[0].first[GRID_COLOURS(plan->fairness)];
	     d++)
		covered[(size_t)plan->centres[2 * d + 1] * plan->station_count +
		        (size_t)plan->centres[2 * d]]++;
	for (size_t n = 0; n < c.nodes; n++)
		assert_int_equal(covered[n], c.lower_m[n] < c.upper_m[n] ? 1 : 0);
	free(covered);
	search_plan_destroy(plan);
	search_case_close(&c);
}

static void test_npl_parent(void **state)
{
	(void)state;
	check_hull("npl_parent", BATTEN_FAIRNESS_BENDING);
	check_hull("npl_parent", BATTEN_FAIRNESS_VARIATION);
}

static void test_bsra_trawler(void **state)
{
	(void)state;
	check_hull("bsra_trawler", BATTEN_FAIRNESS_BENDING);
	check_hull("bsra_trawler", BATTEN_FAIRNESS_VARIATION);
}

static void test_highspeed_craft(void **state)
{
	(void)state;
	check_hull("highspeed_craft", BATTEN_FAIRNESS_BENDING);
}

static void test_wigley(void **state)
{
	(void)state;
	check_hull("wigley", BATTEN_FAIRNESS_BENDING);
}

static void test_wigley_noisy(void **state)
{
	(void)state;
	check_hull("wigley_noisy", BATTEN_FAIRNESS_BENDING);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_npl_parent),      cmocka_unit_test(test_bsra_trawler),
		cmocka_unit_test(test_highspeed_craft), cmocka_unit_test(test_wigley),
		cmocka_unit_test(test_wigley_noisy),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
