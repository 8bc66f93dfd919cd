/* Batches of surfaces in every shape of the kernel, lanes and work-items, orders 2 to 8, rational or
 * not, both precisions, equal the C path bit for bit. */
#include "support/kernel_compile.h"
#include "support/surface_case.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void check(size_t order_u, size_t order_v, bool rational, batten_precision precision,
                  unsigned lanes, unsigned work_group)
{
	surface_case c = surface_case_open(order_u, order_v, rational);
	batten_surface_batch_options options = surface_case_options(0, precision,
	                                                            BATTEN_SURFACE_EVERYTHING);
	options.lanes = lanes;
	options.work_group = work_group;
	surface_case_compare_most(&c, &options);
	surface_case_close(&c);
}

static void test_lanes(void **state)
{
	(void)state;
	kernels_unoptimised(true);
	check(4, 3, false, BATTEN_F64, 1, 1);
	check(4, 3, true, BATTEN_F64, 2, 1);
	check(4, 3, false, BATTEN_F64, 16, 1);
	check(4, 3, true, BATTEN_F32, 1, 1);
	check(4, 3, false, BATTEN_F32, 4, 1);
}

static void test_work_groups(void **state)
{
	(void)state;
	kernels_unoptimised(true);
	check(3, 4, false, BATTEN_F64, 1, 7);
	check(3, 4, true, BATTEN_F64, 1, 64);
	check(3, 4, false, BATTEN_F64, 4, 3);
	check(3, 4, true, BATTEN_F32, 1, 32);
}

static void test_orders(void **state)
{
	(void)state;
	kernels_unoptimised(false);
	check(2, 8, true, BATTEN_F64, 0, 0);
	check(5, 5, false, BATTEN_F64, 0, 0);
	check(6, 4, false, BATTEN_F32, 0, 0);
	check(8, 2, true, BATTEN_F32, 0, 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_lanes),
		cmocka_unit_test(test_work_groups),
		cmocka_unit_test(test_orders),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
