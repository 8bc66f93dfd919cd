/* Table 7.1 of the thesis: the distorted quadratic of table A.8 by the search and by the exact
 * minimiser; and what is refused of a line. */
#include "fairing/lines.h"
#include "unit/pass_fixture.h"

enum { POINTS = 6, INNER = POINTS - 2 };

/* The minimiser of w1 sum d2^2 + w2 sum (y - given)^2 at unit spacing, ends fixed: normal equations of
 * four unknowns, by Gauss. */
static void exact(double w1, double w2, const double *given, double *y)
{
	static const double difference[3] = { 1, -2, 1 };
	double a[INNER][INNER + 1] = { { 0 } };
	for (int p = 1; p + 1 < POINTS; p++)
		for (int i = -1; i < 2; i++) {
			const int row = p + i - 1;
			if (row < 0 || row >= INNER)
				continue;
			for (int j = -1; j < 2; j++) {
				const int column = p + j - 1;
				const double part = w1 * difference[i + 1] * difference[j + 1];
				if (column >= 0 && column < INNER)
					a[row][column] += part;
				else
					a[row][INNER] -= part * given[p + j];
			}
		}
	for (int i = 0; i < INNER; i++) {
		a[i][i] += w2;
		a[i][INNER] += w2 * given[i + 1];
	}
	for (int i = 0; i < INNER; i++)
		for (int r = 0; r < INNER; r++)
			for (int j = INNER; r != i && j >= i; j--)
				a[r][j] -= a[r][i] / a[i][i] * a[i][j];
	y[0] = given[0];
	y[POINTS - 1] = given[POINTS - 1];
	for (int i = 0; i < INNER; i++)
		y[i + 1] = a[i][INNER] / a[i][i];
}

static double objective(double w1, double w2, const double *x, const double *given, const double *y)
{
	double closeness = 0;
	for (int i = 0; i < POINTS; i++)
		closeness += (y[i] - given[i]) * (y[i] - given[i]);
	return w1 * lines_fairness(POINTS, x, y) + w2 * closeness;
}

/* With the right end 24.9903, which the printed numbers ask for; with 25, as table A.8 has it, F lies
 * 0.16 % above. At w1 = 0 the points stay: FN is 21.961, the 22.9610 printed is a misprint. */
static void table_7_1(void **state)
{
	static struct printed table;
	read_printed("table7_1_results", &table);
	const size_t w1_at = column_of(&table, "w1"), w2_at = column_of(&table, "w2");
	const size_t f_at = column_of(&table, "F"), fn_at = column_of(&table, "FN");
	double both[2 * POINTS] = { 0, 0, 1, 1, 2, 3, 3, 9, 4, 16, 5, 24.9903 };
	double x[POINTS], given[POINTS], y[POINTS], best[POINTS];
	for (int i = 0; i < POINTS; i++) {
		x[i] = both[2 * i];
		given[i] = both[2 * i + 1];
	}
	batten_points *points = NULL;
	assert_int_equal(batten_points_create(*state, "quadratic", 2, POINTS, both, &points),
	                 BATTEN_OK);
	assert_int_equal(table.rows, 7);
	for (size_t r = 0; r < table.rows; r++) {
		batten_line_options options;
		batten_line_facts facts;
		batten_line_options_default(&options);
		options.method = BATTEN_METHOD_SEARCH;
		options.w1 = table.cells[r][w1_at];
		options.w2 = table.cells[r][w2_at];
		assert_int_equal(batten_line_fair(*state, points, &options, y, &facts), BATTEN_OK);
		exact(options.w1, options.w2, given, best);
		const double least = objective(options.w1, options.w2, x, given, best);
		assert_near(facts.objective, objective(options.w1, options.w2, x, given, y), 1e-12, "F");
		assert_near(facts.objective, least, 1e-8, "the search against the exact minimiser");
		assert_near(least, table.cells[r][f_at], 1.01e-4, "F of table 7.1, exact");
		assert_near(facts.objective, table.cells[r][f_at], 1.01e-4, "F of table 7.1, searched");
		if (options.w1 == 0) {
			assert_near(facts.fn_after_per_m2, 21.961, 1e-3, "FN at w1 = 0");
			assert_near(table.cells[r][fn_at], 22.961, 1e-9, "the misprint");
		}
	}
	batten_points_destroy(points);
}

static void refusals(void **state)
{
	const double space[] = { 0, 0, 0, 1, 1, 0, 2, 1, 0 };
	const double back[] = { 0, 0, 1, 1, 0.5, 2, 3, 1 };
	const double two[] = { 0, 0, 1, 1 };
	const struct {
		size_t dimension, count;
		const double *points;
		batten_status status;
		const char *words;
	} cases[] = {
		{ 3, 3, space, BATTEN_USAGE, "a space curve" },
		{ 2, 4, back, BATTEN_INPUT, "points 2 and 3" },
		{ 2, 2, two, BATTEN_USAGE, "a line of 2 points" },
	};
	double y[8];
	for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
		batten_points *points = NULL;
		assert_int_equal(batten_points_create(*state, "line", cases[c].dimension, cases[c].count,
		                                      cases[c].points, &points),
		                 BATTEN_OK);
		assert_int_equal(batten_line_fair(*state, points, NULL, y, NULL), cases[c].status);
		if (!strstr(batten_context_error(*state), cases[c].words))
			fail_msg("%s", batten_context_error(*state));
		batten_points_destroy(points);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(table_7_1, make_context, end_context),
		cmocka_unit_test_setup_teardown(refusals, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
