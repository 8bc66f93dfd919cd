/* Whole searches in every shape of the kernel, lanes and work-items, local and global state, both
 * precisions, equal the C path bit for bit. */
#include "support/search_equal.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void check(const char *hull, const search_shape *shapes, size_t count)
{
	search_case c = search_case_open(hull, 0.01, true);
	for (size_t s = 0; s < count; s++)
		search_equal_check(&c, &shapes[s]);
	search_case_close(&c);
}

static void test_lanes(void **state)
{
	(void)state;
	static const search_shape shapes[] = {
		{ 0, BATTEN_F64, 1, 1, false, GRID_BENDING, false, false },
		{ 0, BATTEN_F64, 16, 1, true, GRID_BENDING, false, false },
		{ 0, BATTEN_F32, 8, 1, false, GRID_BENDING, false, false },
	};
	check("npl_parent", shapes, sizeof shapes / sizeof shapes[0]);
}

static void test_work_groups(void **state)
{
	(void)state;
	static const search_shape shapes[] = {
		{ 0, BATTEN_F64, 4, 3, false, GRID_BENDING, false, false },
		{ 0, BATTEN_F32, 1, 32, false, GRID_BENDING, false, false },
		/* Abreast, each search one work-item's, and three's. */
		{ 0, BATTEN_F64, 4, 4, true, GRID_BENDING, false, false },
		{ 0, BATTEN_F32, 8, 24, true, GRID_BENDING, false, false },
	};
	check("bsra_trawler", shapes, sizeof shapes / sizeof shapes[0]);
}

static void test_global_state(void **state)
{
	(void)state;
	static const search_shape shapes[] = {
		{ 0, BATTEN_F64, 8, 1, true, GRID_BENDING, false, false },
		{ 0, BATTEN_F32, 16, 1, true, GRID_BENDING, false, false },
	};
	check("npl_parent", shapes, sizeof shapes / sizeof shapes[0]);
}

static void test_textbook_and_other_fairness(void **state)
{
	(void)state;
	static const search_shape shapes[] = {
		{ 0, BATTEN_F64, 8, 1, true, GRID_BENDING, true, false },
		{ 0, BATTEN_F32, 4, 8, true, GRID_BENDING, true, false },
		{ 0, BATTEN_F64, 2, 1, false, GRID_BENDING_WEIGHTED, false, false },
		{ 0, BATTEN_F32, 16, 1, false, GRID_MEAN, false, false },
		{ 0, BATTEN_F64, 8, 1, false, GRID_GAUSS, false, false },
		{ 0, BATTEN_F64, 2, 6, true, GRID_VARIATION, false, false },
	};
	check("npl_parent", shapes, sizeof shapes / sizeof shapes[0]);
}

static void test_interior_penalty(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	search_equal_penalised(&c, BATTEN_F64, 1, 6);
	search_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_lanes),
		cmocka_unit_test(test_work_groups),
		cmocka_unit_test(test_global_state),
		cmocka_unit_test(test_textbook_and_other_fairness),
		cmocka_unit_test(test_interior_penalty),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
