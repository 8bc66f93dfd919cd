/* Differences, fairness numbers and inflections of lines, against the thesis's printed tables and
 * closed forms. */
#include "batten.h"
#include "fairing/lines.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_ROWS = 32 };

/* One printed table: coordinate, half-breadth, d1, d2; NaN where a cell is empty. */
typedef struct printed {
	size_t count;
	double along[MOST_ROWS], value[MOST_ROWS], d1[MOST_ROWS], d2[MOST_ROWS];
} printed;

static double next_cell(char **rest)
{
	char *cell = *rest, *end = strchr(cell, ',');
	if (end)
		*end = '\0';
	*rest = end ? end + 1 : cell + strlen(cell);
	return *cell == '\0' || *cell == '\n' ? NAN : strtod(cell, NULL);
}

static void read_printed(const char *name, printed *out)
{
	char path[512], row[512];
	(void)snprintf(path, sizeof path, "%s/../tests/data/tables/%s.csv", BATTEN_DATA_DIR, name);
	FILE *file = fopen(path, "r");
	assert_non_null(file);
	bool header = true;
	out->count = 0;
	while (fgets(row, sizeof row, file)) {
		if (row[0] == '#')
			continue;
		if (header) {
			header = false;
			continue;
		}
		assert_true(out->count < MOST_ROWS);
		char *rest = row;
		size_t i = out->count++;
		out->along[i] = next_cell(&rest);
		out->value[i] = next_cell(&rest);
		out->d1[i] = next_cell(&rest);
		out->d2[i] = next_cell(&rest);
	}
	(void)fclose(file);
}

/* Half a unit of the last printed digit, and the rounding of the comparison itself. */
static void assert_printed(double computed, double print, double last_digit)
{
	assert_true(fabs(computed - print) <= 0.5 * last_digit + 1e-11 * fabs(print));
}

static void check_table(const char *name, double last_digit, size_t points, size_t second_count)
{
	printed table;
	read_printed(name, &table);
	assert_int_equal(table.count, points);
	double d1[MOST_ROWS], d2[MOST_ROWS];
	lines_first_differences(table.count, table.along, table.value, d1);
	lines_second_differences(table.count, table.along, table.value, d2);
	size_t seconds = 0;
	for (size_t i = 0; i < table.count; i++) {
		if (!isnan(table.d1[i]))
			assert_printed(d1[i], table.d1[i], last_digit);
		if (isnan(table.d2[i]))
			continue;
		assert_true(i > 0 && i + 1 < table.count);
		assert_printed(d2[i - 1], table.d2[i], last_digit);
		seconds++;
	}
	assert_int_equal(seconds, second_count);
}

static void printed_second_differences(void **state)
{
	(void)state;
	check_table("tableA1_hardchine", 1e-2, 11, 9);
	check_table("tableA3_lpd17_s27", 1e-4, 19, 17);
	check_table("tableA4_lpd17_s38", 1e-4, 21, 19);
	check_table("tableA5_lpd17_s44", 1e-4, 25, 23);
	check_table("tableA6_npl_s11", 1e-4, 21, 19);
	check_table("tableA7_npl_wl11", 1e-4, 15, 13);
	check_table("tableA8_quadratic", 1e-4, 6, 4);
}

static void fairness_of_a_line(void **state)
{
	(void)state;
	printed table;
	read_printed("tableA8_quadratic", &table);
	/* d2 of table A.8: 1, 4, 1, 2 */
	assert_true(lines_fairness(table.count, table.along, table.value) == 22);
	assert_true(isnan(lines_fairness(2, table.along, table.value)));
	/* y = x^2 at any spacing: every d2 is 2 */
	double x[] = { 0, 0.5, 2, 2.25, 4 }, y[5];
	for (size_t i = 0; i < 5; i++)
		y[i] = x[i] * x[i];
	assert_true(lines_fairness(5, x, y) == 12);
}

static void inflections_of_a_line(void **state)
{
	(void)state;
	enum { COUNT = 41 };
	double x[COUNT], y[COUNT];
	for (size_t i = 0; i < COUNT; i++)
		x[i] = 0.1 * (double)i;
	for (size_t i = 0; i < COUNT; i++)
		y[i] = 3.7 - 0.3 * x[i]; /* straight: d2 is rounding, and has no sign */
	assert_int_equal(lines_inflections(COUNT, x, y), 0);
	for (size_t i = 0; i < COUNT; i++)
		y[i] = sin(3.14159265358979 * (x[i] - 0.05)); /* inflections near 1.05, 2.05, 3.05 */
	assert_int_equal(lines_inflections(COUNT, x, y), 3);
	for (size_t i = 0; i < COUNT; i++)
		y[i] = i < 15 ? 1 + pow(1.4 - x[i], 3) : i > 25 ? 1 - pow(x[i] - 2.5, 3) : 1;
	/* convex, flat, concave: one, however long the flat piece is */
	assert_int_equal(lines_inflections(COUNT, x, y), 1);
	printed table;
	read_printed("tableA6_npl_s11", &table);
	double d2[MOST_ROWS];
	lines_second_differences(table.count, table.along, table.value, d2);
	assert_int_equal(lines_inflections(table.count, table.along, table.value), 8);
}

/* ------------------------------------------------------------------------------------------------
 * Lines of hulls
 * --------------------------------------------------------------------------------------------- */

enum { STATIONS = 9, WATERLINES = 7 };

static batten_context *make_context(void)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	return context;
}

static batten_hull *make_hull(batten_context *context, double (*surface)(double x, double z))
{
	double x[STATIONS], z[WATERLINES], y[STATIONS * WATERLINES];
	for (size_t i = 0; i < STATIONS; i++)
		x[i] = 2.0 * (double)i + (i == 3 ? 0.25 : 0);
	for (size_t j = 0; j < WATERLINES; j++)
		z[j] = 0.5 * (double)j;
	for (size_t j = 0; j < WATERLINES; j++)
		for (size_t i = 0; i < STATIONS; i++)
			y[j * STATIONS + i] = surface(x[i], z[j]);
	batten_hull_table table = { "test", 16, 3, STATIONS, WATERLINES, x, z, y, NULL };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
	return hull;
}

static double parabolic(double x, double z)
{
	double s = x / 16, t = 1 - z / 3;
	return 2 * 4 * s * (1 - s) * (1 - t * t);
}

static double plane(double x, double z)
{
	return 0.25 + 0.0625 * x + 0.5 * z;
}

static double chine(double x, double z)
{
	(void)z;
	return 3 - 0.25 * fabs(x - 8);
}

static batten_line *lines_of(batten_context *context, const batten_hull *hull,
                             const batten_hull *reference, size_t *count)
{
	assert_int_equal(batten_hull_lines(context, hull, reference, NULL, 0, count), BATTEN_OK);
	batten_line *lines = calloc(*count, sizeof *lines);
	assert_non_null(lines);
	assert_int_equal(batten_hull_lines(context, hull, reference, lines, *count, count), BATTEN_OK);
	return lines;
}

/* fn of values that are NaN where there is none. */
static double fairness_of(const double *x, const double *value, size_t *points)
{
	double along[STATIONS], kept[STATIONS];
	*points = 0;
	for (size_t i = 0; i < STATIONS; i++)
		if (!isnan(value[i])) {
			along[*points] = x[i];
			kept[(*points)++] = value[i];
		}
	return lines_fairness(*points, along, kept);
}

/* Sections of the parabolic hull are parabolas, which the splines hold exactly, so its buttocks and
 * diagonals have closed forms. */
static void buttocks_and_diagonals_of_a_parabolic_hull(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, parabolic);
	size_t count = 0;
	batten_line *lines = lines_of(context, hull, NULL, &count);
	assert_int_equal(count, STATIONS + WATERLINES + (WATERLINES - 2) + (WATERLINES - 1));
	const double *x = batten_hull_x_m(hull);
	size_t buttocks = 0, diagonals = 0, points = 0;
	for (size_t k = STATIONS + WATERLINES; k < count; k++) {
		double value[STATIONS], c = lines[k].coordinate_m;
		for (size_t i = 0; i < STATIONS; i++) {
			double top = parabolic(x[i], 3);
			if (lines[k].kind == BATTEN_LINE_BUTTOCK) {
				value[i] = c <= top ? 3 * (1 - sqrt(1 - c / top)) : NAN;
				continue;
			}
			/* top (1 - (1 - z/3)^2) + z = c, with u = z / 3: top u^2 - (2 top + 3) u + c = 0 */
			double b = 2 * top + 3;
			double u = top > 0 ? (b - sqrt(b * b - 4 * top * c)) / (2 * top) : c / 3;
			value[i] = sqrt(2) * (c - 3 * u);
		}
		buttocks += lines[k].kind == BATTEN_LINE_BUTTOCK;
		diagonals += lines[k].kind == BATTEN_LINE_DIAGONAL;
		double fn = fairness_of(x, value, &points);
		assert_int_equal(lines[k].point_count, points);
		if (isnan(fn))
			assert_true(isnan(lines[k].fn_per_m2));
		else
			assert_true(fabs(lines[k].fn_per_m2 - fn) <= 1e-11 * fmax(1, fn));
	}
	assert_int_equal(buttocks, WATERLINES - 2);
	assert_int_equal(diagonals, WATERLINES - 1);
	free(lines);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static void lines_of_a_plane_hull_are_straight(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, plane);
	size_t count = 0;
	batten_line *lines = lines_of(context, hull, NULL, &count);
	for (size_t k = 0; k < count; k++) {
		/* buttocks and diagonals below the lowest waterline run along the flat bottom first */
		bool cut = lines[k].kind == BATTEN_LINE_BUTTOCK || lines[k].kind == BATTEN_LINE_DIAGONAL;
		if (!cut) {
			assert_true(lines[k].fn_per_m2 < 1e-24);
			assert_int_equal(lines[k].inflections, 0);
		} else if (lines[k].coordinate_m > 1.3 && lines[k].kind == BATTEN_LINE_BUTTOCK) {
			assert_true(lines[k].point_count >= 3);
			assert_true(lines[k].fn_per_m2 < 1e-24);
		}
	}
	free(lines);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static void changes_are_against_the_reference(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *before = make_hull(context, parabolic), *after = NULL;
	assert_int_equal(batten_hull_clone(context, before, &after), BATTEN_OK);
	double y[STATIONS * WATERLINES];
	memcpy(y, batten_hull_y_m(before), sizeof y);
	y[4 * STATIONS + 5] += 0.125;
	assert_int_equal(batten_hull_set_y(context, after, y), BATTEN_OK);
	size_t count = 0;
	batten_line *lines = lines_of(context, after, before, &count);
	for (size_t k = 0; k < STATIONS + WATERLINES; k++) {
		bool hit = k == 5 || k == STATIONS + 4;
		assert_true(fabs(lines[k].change_max_m - (hit ? 0.125 : 0)) < 1e-15);
	}
	double most = 0;
	for (size_t k = STATIONS + WATERLINES; k < count; k++)
		most = fmax(most, lines[k].change_max_m);
	assert_true(most > 0.01 && most < 1);
	size_t wrong = 0;
	assert_int_equal(batten_hull_lines(context, after, before, lines, count - 1, &wrong),
	                 BATTEN_USAGE);
	assert_int_equal(wrong, 0);
	free(lines);
	batten_hull_destroy(after);
	batten_hull_destroy(before);
	batten_context_destroy(context);
}

/* A hull with a knuckle at x = 8 on every waterline: unfair where the knuckle is not named,
 * straight where it is. */
static void lines_break_at_knuckles(void **state)
{
	(void)state;
	static const char head[] =
		"# batten-offsets: 1\n# name: chine\n# unit: m\n# frame: ap-fwd\n"
		"# lbp: 16\n# draft: 2\n# layout: grid\nz\\x,0,2,4,6,8,10,12,14,16\n";
	char text[1024];
	int length = snprintf(text, sizeof text, "%s", head);
	for (int j = 0; j < 3; j++) {
		length += snprintf(text + length, sizeof text - (size_t)length, "%d", j);
		for (int i = 0; i < 9; i++)
			length += snprintf(text + length, sizeof text - (size_t)length, ",%g", chine(2 * i, j));
		length += snprintf(text + length, sizeof text - (size_t)length, "\n");
	}
	batten_context *context = make_context();
	batten_hull *plain = NULL, *named = NULL;
	assert_int_equal(batten_hull_parse(context, "plain", text, (size_t)length, &plain), BATTEN_OK);
	for (int j = 0; j < 3; j++) /* the last one between two stations */
		length += snprintf(text + length, sizeof text - (size_t)length, "knuckle,waterline,%g,%d\n",
		                   j < 2 ? 8.0 : 7.0, j);
	assert_int_equal(batten_hull_parse(context, "named", text, (size_t)length, &named), BATTEN_OK);
	lines_sum sum;
	assert_int_equal(lines_of_hull(plain, true, &sum), BATTEN_OK);
	assert_int_equal(sum.interior_count, 21);
	assert_true(fabs(sum.fn_per_m2 - 3 * 0.0625) < 1e-15);
	assert_int_equal(lines_of_hull(named, true, &sum), BATTEN_OK);
	/* 3 + 3 where it is a point; 2 + 3 where it lies between points 3 and 4 */
	assert_int_equal(sum.interior_count, 6 + 6 + 5);
	assert_true(sum.fn_per_m2 < 1e-28);
	batten_hull_destroy(named);
	batten_hull_destroy(plain);
	batten_context_destroy(context);
}

/* Line after line, each collected by itself. */
static lines_sum one_by_one(const batten_hull *hull, bool waterlines)
{
	lines_sum total = { 0 };
	const size_t count = waterlines ? hull->waterline_count : hull->station_count;
	for (size_t line = 0; line < count; line++) {
		hull_line points;
		assert_int_equal(hull_line_collect(hull, waterlines, line, false, &points), BATTEN_OK);
		const lines_sum sum = lines_of_points(hull, waterlines, line, &points);
		hull_line_release(hull, &points);
		total.fn_per_m2 += sum.fn_per_m2;
		total.interior_count += sum.interior_count;
		total.inflections += sum.inflections;
	}
	return total;
}

/* Lines side by side give the bits of each by itself: whole, broken by empty cells, across '?' cells. */
static void lines_side_by_side(void **state)
{
	(void)state;
	enum { COLUMNS = 21, ROWS = 11, NODES = COLUMNS * ROWS };
	static double y[NODES], x[COLUMNS], z[ROWS];
	static uint8_t nodes[NODES];
	for (size_t i = 0; i < COLUMNS; i++)
		x[i] = (double)i + 0.3 * (double)(i % 3);
	for (size_t j = 0; j < ROWS; j++)
		z[j] = 0.2 * (double)j + 0.05 * (double)(j % 2);
	batten_context *context = make_context();
	for (unsigned holes = 0; holes < 5; holes++) {
		for (unsigned n = 0; n < NODES; n++) {
			const unsigned drawn = (n * 2654435761u >> 7) % 32;
			nodes[n] = drawn < holes       ? BATTEN_NODE_OUTSIDE
			           : drawn < 2 * holes ? BATTEN_NODE_UNKNOWN
			                               : BATTEN_NODE_GIVEN;
			y[n] = nodes[n] == BATTEN_NODE_GIVEN ? 1 + 0.01 * drawn + 0.1 * x[n % COLUMNS] : 0;
		}
		batten_hull_table table = { "holes", 20, 2, COLUMNS, ROWS, x, z, y, nodes };
		batten_hull *hull = NULL;
		assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
		for (int waterlines = 0; waterlines < 2; waterlines++) {
			lines_sum sum;
			const lines_sum expected = one_by_one(hull, waterlines);
			assert_int_equal(lines_of_hull(hull, waterlines, &sum), BATTEN_OK);
			assert_true(sum.interior_count > 0 && sum.inflections > 0);
			assert_true(sum.fn_per_m2 == expected.fn_per_m2);
			assert_int_equal(sum.interior_count, expected.interior_count);
			assert_int_equal(sum.inflections, expected.inflections);
		}
		batten_hull_destroy(hull);
	}
	batten_context_destroy(context);
}

static double fairness_of_shipped(const char *name)
{
	batten_context *context = make_context();
	batten_hull *hull = NULL;
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	assert_int_equal(batten_hull_read(context, path, &hull), BATTEN_OK);
	lines_sum sum;
	assert_int_equal(lines_of_hull(hull, true, &sum), BATTEN_OK);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
	return sum.fn_per_m2;
}

static void fairness_of_the_shipped_hulls(void **state)
{
	(void)state;
	/* exact offsets of table B.2, y in cm: 731.04 */
	assert_true(fabs(1e4 * fairness_of_shipped("wigley") - 731.04) <= 0.005);
	/* table B.6 from y */
	assert_true(fabs(fairness_of_shipped("highspeed_craft") - 1.0840) <= 0.00005);
	/* table B.3 with its profile zeros */
	assert_true(fabs(fairness_of_shipped("npl_parent") - 7.16) <= 0.005);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(printed_second_differences),
		cmocka_unit_test(fairness_of_a_line),
		cmocka_unit_test(inflections_of_a_line),
		cmocka_unit_test(buttocks_and_diagonals_of_a_parabolic_hull),
		cmocka_unit_test(lines_of_a_plane_hull_are_straight),
		cmocka_unit_test(changes_are_against_the_reference),
		cmocka_unit_test(lines_break_at_knuckles),
		cmocka_unit_test(lines_side_by_side),
		cmocka_unit_test(fairness_of_the_shipped_hulls),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
