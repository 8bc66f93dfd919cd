/* Tables and charts of hydrostatics as files. */
#include "unit/measures_fixture.h"

#include <stdio.h>
#include <unistd.h>

static double wigley(double x, double z)
{
	double s = x / 100, t = 1 - z / 6.25;
	return 5 * 4 * s * (1 - s) * (1 - t * t);
}

static size_t read_text(const char *path, char *text, size_t size)
{
	FILE *file = fopen(path, "r");
	assert_non_null(file);
	size_t length = fread(text, 1, size - 1, file);
	text[length] = '\0';
	assert_int_equal(fclose(file), 0);
	return length;
}

static void tables(void **state)
{
	(void)state;
	char folder[] = "/tmp/batten-hydrostatics-XXXXXX", path[64], text[65536];
	assert_non_null(mkdtemp(folder));
	batten_context *context = make_context();
	const char *columns[] = { "draft_m", "kb_m" };
	const double values[] = { 0.1, 1.0 / 3, 2, NAN };
	batten_table table = { .name = "a \"b\"",
		                   .quadrature = "spline",
		                   .column_count = 2,
		                   .row_count = 2,
		                   .columns = columns,
		                   .values = values };
	(void)snprintf(path, sizeof path, "%s/t.csv", folder);
	assert_int_equal(batten_table_write(context, &table, path), BATTEN_OK);
	(void)read_text(path, text, sizeof text);
	assert_non_null(strstr(text, "draft_m,kb_m\n0.1,0.3333333333333333\n2,\n"));
	assert_int_equal(remove(path), 0);
	(void)snprintf(path, sizeof path, "%s/t.json", folder);
	assert_int_equal(batten_table_write(context, &table, path), BATTEN_OK);
	(void)read_text(path, text, sizeof text);
	assert_non_null(strstr(text, "\"name\": \"a \\\"b\\\"\""));
	assert_non_null(strstr(text, "{ \"draft_m\": 2, \"kb_m\": null }"));
	assert_int_equal(remove(path), 0);
	(void)snprintf(path, sizeof path, "%s/t.txt", folder);
	assert_int_equal(batten_table_write(context, &table, path), BATTEN_USAGE);
	batten_context_destroy(context);
	assert_int_equal(rmdir(folder), 0);
}

/* Text beside numbers, in pieces: what would be read as something else is quoted. */
static void tables_of_text(void **state)
{
	(void)state;
	char folder[] = "/tmp/batten-hydrostatics-XXXXXX", path[64], text[65536];
	assert_non_null(mkdtemp(folder));
	batten_context *context = make_context();
	const char *columns[] = { "kb_m" }, *names[] = { "row", "reason" };
	const char *texts[] = { "a", NULL, " b", "said \"no\", twice" };
	const double values[] = { 1.5, -0.0 };
	batten_table table = { .name = "t",
		                   .quadrature = "spline",
		                   .column_count = 1,
		                   .row_count = 1,
		                   .columns = columns,
		                   .values = values,
		                   .text_count = 2,
		                   .text_columns = names,
		                   .texts = texts };
	batten_table more = table;
	more.texts = texts + 2;
	more.values = values + 1;
	batten_table_file *file = NULL;
	for (int json = 0; json < 2; json++) {
		(void)snprintf(path, sizeof path, "%s/t.%s", folder, json ? "json" : "csv");
		assert_int_equal(batten_table_open(context, &table, path, &file), BATTEN_OK);
		assert_int_equal(batten_table_add(file, &more), BATTEN_OK);
		batten_table_abandon(file);
		assert_null(fopen(path, "r"));
		assert_int_equal(batten_table_open(context, &table, path, &file), BATTEN_OK);
		assert_int_equal(batten_table_add(file, &more), BATTEN_OK);
		assert_int_equal(batten_table_commit(file), BATTEN_OK);
		(void)read_text(path, text, sizeof text);
		assert_int_equal(remove(path), 0);
		assert_non_null(strstr(text, json ? "{ \"row\": \"a\", \"reason\": null, \"kb_m\": 1.5 },\n"
		                                    "    { \"row\": \" b\", \"reason\": \"said \\\"no\\\", "
		                                    "twice\", \"kb_m\": 0 }\n"
		                                  : "row,reason,kb_m\na,,1.5\n\" b\",\"said \"\"no\"\", "
		                                    "twice\",-0\n"));
	}
	batten_table_abandon(NULL);
	batten_context_destroy(context);
	assert_int_equal(rmdir(folder), 0);
}

static void charts(void **state)
{
	(void)state;
	char folder[] = "/tmp/batten-hydrostatics-XXXXXX", path[64], text[65536];
	assert_non_null(mkdtemp(folder));
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 5, 5);
	const double drafts[] = { 2, 4, 6 }, x[] = { 0, 25, 50, 75, 100 };
	batten_hydrostatics rows[3];
	double areas[15];
	const size_t counts[] = { 5, 5, 5 };
	double all_x[15];
	for (size_t i = 0; i < 15; i++)
		all_x[i] = x[i % 5];
	assert_int_equal(batten_hull_hydrostatics(context, hull, NULL, 3, drafts, rows), BATTEN_OK);
	assert_int_equal(batten_hull_section_areas(context, hull, NULL, 3, drafts, areas), BATTEN_OK);
	(void)snprintf(path, sizeof path, "%s/c.svg", folder);
	for (int kind = 0; kind < 3; kind++) {
		batten_status status = kind == 0
		                           ? batten_picture_curves_of_form(context, "w", 3, rows, path)
		                       : kind == 1
		                           ? batten_picture_bonjean(context, "w", 5, x, 3, drafts, areas,
		                                                    path)
		                           : batten_picture_section_areas(context, "w", 3, drafts, counts,
		                                                          all_x, areas, path);
		assert_int_equal(status, BATTEN_OK);
		assert_true(read_text(path, text, sizeof text) > 2000);
		assert_non_null(strstr(text, "<svg"));
		assert_int_equal(remove(path), 0);
	}
	assert_int_equal(batten_picture_curves_of_form(context, "w", 1, rows, path), BATTEN_USAGE);
	rows[1] = rows[2] = rows[0];
	rows[0].draft_m = rows[1].draft_m = rows[2].draft_m = 0;
	assert_int_equal(batten_picture_curves_of_form(context, "w", 3, rows, path), BATTEN_USAGE);
	assert_int_equal(batten_picture_bonjean(context, "w", 1, x, 3, drafts, areas, path),
	                 BATTEN_USAGE);
	assert_int_equal(batten_picture_section_areas(context, "w", 0, drafts, counts, x, areas, path),
	                 BATTEN_USAGE);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
	assert_int_equal(rmdir(folder), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(tables),
		cmocka_unit_test(tables_of_text),
		cmocka_unit_test(charts),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
