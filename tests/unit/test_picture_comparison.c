/* The sheet of hulls side by side: whole, the same each time, refused where there is nothing. */
#include "unit/pass_fixture.h"

static size_t read_file(const char *path, char **out)
{
	FILE *file = fopen(path, "rb");
	assert_non_null(file);
	*out = calloc(1, 1 << 22);
	assert_non_null(*out);
	const size_t length = fread(*out, 1, (1 << 22) - 1, file);
	(void)fclose(file);
	(void)remove(path);
	return length;
}

static void test_sheet(void **state)
{
	static const char *const labels[] = { "given", "noisy <&" };
	static const char *const names[] = { "fn_per_m2", "cn_pct" };
	const double values[] = { 1, 2, NAN, 3 };
	batten_hull *first = read_hull(*state, "wigley");
	batten_hull *second = read_hull(*state, "highspeed_craft");
	const batten_hull *hulls[] = { first, second };
	batten_comparison shown = { "a title", 2, hulls, labels, 2, names, values };
	char *once = NULL, *again = NULL;
	assert_int_equal(batten_picture_comparison(*state, &shown, "comparison.svg"), BATTEN_OK);
	const size_t length = read_file("comparison.svg", &once);
	assert_int_equal(batten_picture_comparison(*state, &shown, "comparison.svg"), BATTEN_OK);
	assert_int_equal(read_file("comparison.svg", &again), length);
	assert_memory_equal(once, again, length);
	assert_true(length > 10000 && strstr(once, "</svg>"));
	free(once);
	free(again);
	shown.hull_count = 9;
	assert_int_equal(batten_picture_comparison(*state, &shown, "comparison.svg"), BATTEN_USAGE);
	shown.hull_count = 2;
	assert_int_equal(batten_picture_comparison(*state, &shown, "no/such/folder/a.svg"), BATTEN_IO);
	batten_hull_destroy(first);
	batten_hull_destroy(second);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_sheet, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
