/* The report of a sweep: the page holds the database's numbers bit for bit, its text stays text, and a
 * database that is not as it should be is refused by name. */
#include "support/failing_heap.h"
#include "support/sweep_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include <sqlite3.h>

enum { DESIGNS = 100, KEPT = 4, FIRST_VALUE = 3 };

#define HULL BATTEN_DATA_DIR "/hulls/wigley.csv"
#define HOSTILE "a </script><!-- & \"b\" \xff \xf0\x9f\x9a\xa2"

typedef struct fixture {
	batten_context *context;
	char folder[64], database[128], page[128], out[128];
} fixture;

static void write_text(const char *path, const char *text)
{
	FILE *stream = fopen(path, "wb");
	assert_non_null(stream);
	assert_true(fputs(text, stream) >= 0);
	assert_int_equal(fclose(stream), 0);
}

/* Made once, copied for each test. */
static char original[] = "/tmp/batten-sweep-XXXXXX";

static int make_original(void **state)
{
	(void)state;
	batten_context *context = NULL;
	const int descriptor = mkstemp(original);
	assert_true(descriptor >= 0);
	assert_int_equal(close(descriptor), 0);
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	const sweep_file file = { original, HULL, DESIGNS, KEPT, "name" };
	sweep_file_make(context, &file);
	batten_context_destroy(context);
	return 0;
}

static int remove_original(void **state)
{
	(void)state;
	return unlink(original);
}

static void copy(const char *from, const char *to)
{
	static char bytes[1 << 20];
	FILE *in = fopen(from, "rb");
	FILE *out = fopen(to, "wb");
	assert_non_null(in);
	assert_non_null(out);
	const size_t length = fread(bytes, 1, sizeof bytes, in);
	assert_true(length > 0 && length < sizeof bytes);
	assert_int_equal(fwrite(bytes, 1, length, out), length);
	assert_int_equal(fclose(in), 0);
	assert_int_equal(fclose(out), 0);
}

static int make_fixture(void **state)
{
	fixture *f = calloc(1, sizeof *f);
	assert_non_null(f);
	assert_int_equal(batten_context_create(NULL, &f->context), BATTEN_OK);
	(void)snprintf(f->folder, sizeof f->folder, "/tmp/batten-report-XXXXXX");
	assert_non_null(mkdtemp(f->folder));
	(void)snprintf(f->database, sizeof f->database, "%s/sweep.db", f->folder);
	(void)snprintf(f->page, sizeof f->page, "%s/page.html", f->folder);
	(void)snprintf(f->out, sizeof f->out, "%s/report.html", f->folder);
	write_text(f->page, "<html>\n<!--batten-data-->\n</html>\n");
	copy(original, f->database);
	*state = f;
	return 0;
}

static int end_fixture(void **state)
{
	fixture *f = *state;
	(void)unlink(f->database);
	(void)unlink(f->page);
	(void)unlink(f->out);
	assert_int_equal(rmdir(f->folder), 0); /* no temporary file is left */
	batten_context_destroy(f->context);
	free(f);
	return 0;
}

static batten_status report(fixture *f, batten_report_facts *facts)
{
	batten_report_options options;
	batten_report_options_default(&options);
	options.page = f->page;
	return batten_report_write(f->context, f->database, &options, f->out, facts);
}

static char *read_out(const fixture *f)
{
	struct stat facts;
	assert_int_equal(stat(f->out, &facts), 0);
	char *text = calloc(1, (size_t)facts.st_size + 1);
	FILE *stream = fopen(f->out, "rb");
	assert_non_null(text);
	assert_non_null(stream);
	assert_int_equal(fread(text, 1, (size_t)facts.st_size, stream), facts.st_size);
	assert_int_equal(fclose(stream), 0);
	return text;
}

static size_t count_of(const char *text, const char *what)
{
	size_t count = 0;
	for (const char *at = strstr(text, what); at; at = strstr(at + 1, what))
		count++;
	return count;
}

/* The f64 of a base64 block; *count of them. */
static double *numbers_of(const char *text, const char *begin, size_t *count)
{
	static const char alphabet[] =
		"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	const char *at = strstr(text, begin);
	assert_non_null(at);
	at += strlen(begin);
	const size_t length = strcspn(at, "<\"");
	assert_int_equal(length % 4, 0);
	unsigned char *bytes = calloc(length + 8, 1);
	assert_non_null(bytes);
	size_t used = 0;
	for (size_t i = 0; i < length && at[i] != '='; i++) {
		const char *digit = strchr(alphabet, at[i]);
		assert_non_null(digit);
		const unsigned bits = (unsigned)(digit - alphabet);
		const unsigned place = 6 * (unsigned)i;
		bytes[place / 8] |= (unsigned char)(bits << 2 >> place % 8);
		if (place % 8 > 2)
			bytes[place / 8 + 1] |= (unsigned char)(bits << (10 - place % 8));
		used = (place + 6) / 8;
	}
	*count = used / sizeof(double);
	return (double *)(void *)bytes; /* calloc's memory is aligned */
}

/* ---- what the page holds ---- */

/* The value of a column that varies, found by its place among those in the page's own list. */
static size_t place_of(const char *text, const char *name)
{
	size_t place = FIRST_VALUE;
	char wanted[64];
	(void)snprintf(wanted, sizeof wanted, "{\"name\":\"%s\",\"parameter\"", name);
	const char *line = strstr(text, "\"columns\":[");
	assert_non_null(line);
	for (line = strchr(line, '\n'); line; line = strchr(line + 1, '\n')) {
		const size_t length = strcspn(line + 1, "\n");
		char copy[512];
		assert_true(length < sizeof copy);
		memcpy(copy, line + 1, length);
		copy[length] = '\0';
		if (strncmp(copy, wanted, strlen(wanted)) == 0)
			return place;
		place += strstr(copy, "\"constant\"") == NULL;
	}
	fail_msg("%s is no column", name);
	return 0;
}

static void test_numbers_are_those_of_the_database(void **state)
{
	fixture *f = *state;
	batten_report_facts facts;
	sqlite3 *database = NULL;
	sqlite3_stmt *row = NULL;
	size_t count = 0;
	assert_int_equal(report(f, &facts), BATTEN_OK);
	char *text = read_out(f);
	assert_int_equal(facts.design_count, DESIGNS);
	assert_int_equal(facts.shown_count, DESIGNS);
	assert_int_equal(facts.hull_count, KEPT);
	assert_int_equal(facts.bytes, strlen(text));
	double *rows = numbers_of(text, "id=\"batten-rows\">", &count);
	assert_int_equal(count % DESIGNS, 0);
	const size_t width = count / DESIGNS;
	const size_t volume = place_of(text, "volume_m3");
	assert_int_equal(sqlite3_open(f->database, &database), SQLITE_OK);
	assert_int_equal(
		sqlite3_prepare_v2(database,
	                       "SELECT d.id, d.pareto, m.volume_m3, d.status FROM designs d "
	                       "LEFT JOIN measures m ON m.id = d.id ORDER BY d.id",
	                       -1, &row, NULL),
		SQLITE_OK);
	size_t front = 0;
	for (size_t i = 0; i < DESIGNS; i++) {
		assert_int_equal(sqlite3_step(row), SQLITE_ROW);
		const double *found = rows + i * width;
		const bool is_done = strcmp((const char *)sqlite3_column_text(row, 3), "done") == 0;
		assert_true(found[0] == sqlite3_column_double(row, 0));
		assert_true(found[1] == (is_done ? 0.0 : 1.0));
		assert_true(found[2] == (is_done ? sqlite3_column_double(row, 1) : -1.0));
		assert_true(is_done ? found[volume] == sqlite3_column_double(row, 2)
		                    : found[volume] != found[volume]);
		front += found[2] == 1.0;
	}
	assert_int_equal(front, facts.front_count);
	assert_true(front > 0);
	sqlite3_finalize(row);
	assert_int_equal(sqlite3_close(database), SQLITE_OK);
	free(rows);
	/* a column in which all designs agree is told once */
	assert_non_null(strstr(text,
	                       "{\"name\":\"seed\",\"parameter\":true,\"meaning\":\"varied by the "
	                       "plan\",\"constant\":7}"));
	assert_non_null(strstr(text, "\"96\":\"dcp: no such form\""));
	free(text);
}

static void test_hulls_are_the_best_ones(void **state)
{
	fixture *f = *state;
	batten_report_facts facts;
	batten_report_options options;
	batten_report_options_default(&options);
	options.page = f->page;
	options.hull_count = 2;
	sweep_file_change(f->database, "UPDATE measures SET energy_bending = 100 - id");
	assert_int_equal(batten_report_write(f->context, f->database, &options, f->out, &facts),
	                 BATTEN_OK);
	assert_int_equal(facts.hull_count, 2);
	char *text = read_out(f);
	assert_null(strstr(text, "id=\"batten-hull-0\""));
	assert_null(strstr(text, "id=\"batten-hull-1\""));
	assert_non_null(strstr(text, "id=\"batten-hull-2\""));
	assert_non_null(strstr(text, "id=\"batten-hull-3\""));
	assert_non_null(strstr(text, "id=\"batten-hull-parent\""));
	free(text);
	/* a database without any geometry is a report all the same */
	sweep_file_change(f->database, "DELETE FROM geometry; DELETE FROM meta WHERE key = 'parent'");
	assert_int_equal(report(f, &facts), BATTEN_OK);
	assert_int_equal(facts.hull_count, 0);
}

static void test_text_stays_text(void **state)
{
	fixture *f = *state;
	char sql[2048];
	(void)snprintf(sql, sizeof sql,
	               "UPDATE meta SET value = '%s' WHERE key IN ('name', 'plan', 'plan_hash');"
	               "UPDATE designs SET status = '%s', reason = '%s' WHERE id = 5;"
	               "ALTER TABLE parameters RENAME COLUMN dcp TO \"%s\"",
	               "a </script><!-- & b \xf0\x9f\x9a\xa2", "<b>", HOSTILE, "x</SCRIPT ><script>");
	sweep_file_change(f->database, sql);
	assert_int_equal(report(f, NULL), BATTEN_OK);
	char *text = read_out(f);
	const size_t blocks = count_of(text, "<script type=");
	assert_int_equal(blocks, KEPT + 4); /* the hulls, the parent, rows, reasons, sweep */
	assert_int_equal(count_of(text, "<script"), blocks);
	assert_int_equal(count_of(text, "</script>\n"), blocks);
	assert_null(strstr(text, "</SCRIPT"));
	assert_null(strstr(text, "<!--"));
	assert_null(strstr(text, "<b>"));
	assert_non_null(strstr(text,
	                       "a \\u003c/script\\u003e\\u003c!-- \\u0026 \\u0022b\\u0022 \\ufffd "
	                       "\\ud83d\\udea2"));
	free(text);
}

/* ---- what is refused ---- */

static void refuse(fixture *f, const char *sql, batten_status expected, const char *says)
{
	if (sql)
		sweep_file_change(f->database, sql);
	(void)unlink(f->out);
	const batten_status status = report(f, NULL);
	if (status != expected || !strstr(batten_context_error(f->context), says))
		print_message("after %s: %d: %s\n", sql ? sql : "nothing", (int)status,
		              batten_context_error(f->context));
	assert_int_equal(status, expected);
	assert_non_null(strstr(batten_context_error(f->context), says));
	assert_int_not_equal(access(f->out, F_OK), 0);
}

static void test_refusals(void **state)
{
	static const struct {
		const char *sql, *says;
	} cases[] = {
		{ "UPDATE geometry SET y_m = substr(y_m, 1, 80) WHERE id = 2",
		  "geometry: design 2: y_m holds 80 bytes, expected 2080" },
		{ "UPDATE geometry SET y_m = NULL WHERE id = 2", "geometry: design 2: has no y_m" },
		{ "UPDATE geometry SET y_m = zeroblob(2072) || x'000000000000f0bf' WHERE id = 1",
		  "geometry: design 1: " },
		{ "UPDATE geometry SET nodes = x'01' WHERE id = 0",
		  "geometry: design 0: nodes holds 1 bytes, expected 260" },
		{ "UPDATE geometry SET lbp_m = NULL WHERE id = 0", "geometry: design 0: " },
		{ "UPDATE measures SET volume_m3 = 'much' WHERE id = 9", "volume_m3: found text" },
		{ "DELETE FROM meta WHERE key = 'x_m'", "meta: x_m: expected a JSON array" },
		{ "UPDATE meta SET value = '[1, 0]' WHERE key = 'z_m'", "ascending numbers" },
		{ "UPDATE meta SET value = '[1' WHERE key = 'z_m'", "meta: z_m is no JSON" },
		{ "UPDATE meta SET value = '[{\"measure\": \"beauty\", \"goal\": \"max\"}]' "
		  "WHERE key = 'objectives'",
		  "meta: objectives[0]" },
		{ "UPDATE meta SET value = '{\"by\": \"beauty\"}' WHERE key = 'keep'",
		  "found by 'beauty'" },
		{ "UPDATE meta SET value = 'no hull' WHERE key = 'parent'", "meta: parent" },
		{ "UPDATE meta SET value = CAST(x'ff' AS TEXT) WHERE key = 'name'", "meta: key 'name'" },
		{ "DELETE FROM meta WHERE key = 'plan'", "meta: has no text 'plan'" },
		{ "UPDATE designs SET id = -1 WHERE id = 0", "designs: found ids -1 to 99" },
		{ "UPDATE designs SET status = 's' || id", "more than 32 different statuses" },
		{ "DELETE FROM designs", "designs: is empty" },
		{ "ALTER TABLE measures RENAME COLUMN id TO ident", "measures: has no column 'id'" },
		{ "ALTER TABLE parameters RENAME TO p; CREATE VIEW parameters AS WITH RECURSIVE n(id) AS "
		  "(SELECT 1 UNION ALL SELECT id + 1 FROM n) SELECT id FROM n",
		  "has no plain table 'parameters'" },
		{ "UPDATE meta SET value = 2 WHERE key = 'schema_version'",
		  "found schema_version 2, expected 1" },
		{ "DROP TABLE meta", "has no table 'meta'" },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		void *fresh = NULL;
		assert_int_equal(make_fixture(&fresh), 0);
		refuse(fresh, cases[i].sql, BATTEN_INPUT, cases[i].says);
		assert_int_equal(end_fixture(&fresh), 0);
	}
	fixture *f = *state;
	/* a file cut short */
	assert_int_equal(truncate(f->database, 5000), 0);
	refuse(f, NULL, BATTEN_INPUT, "cannot be read as the result of a sweep");
	write_text(f->database,
	           "x,y\n1,2\nthis is a table, no database, and longer than its header is\n"
	           "this is a table, no database, and longer than its header is\n");
	refuse(f, NULL, BATTEN_INPUT, "is no SQLite database");
	assert_int_equal(unlink(f->database), 0);
	refuse(f, NULL, BATTEN_IO, "No such file");
}

static void test_a_sweep_that_runs_is_not_read(void **state)
{
	fixture *f = *state;
	sqlite3 *writer = NULL;
	assert_int_equal(sqlite3_open(f->database, &writer), SQLITE_OK);
	assert_int_equal(sqlite3_exec(writer, "BEGIN EXCLUSIVE", NULL, NULL, NULL), SQLITE_OK);
	refuse(f, NULL, BATTEN_IO, "is being written by another process");
	assert_int_equal(sqlite3_close(writer), SQLITE_OK);
	assert_int_equal(report(f, NULL), BATTEN_OK);
}

static void test_the_page_itself(void **state)
{
	fixture *f = *state;
	write_text(f->page, "<html></html>\n");
	refuse(f, NULL, BATTEN_INPUT, "expected the mark <!--batten-data-->, once");
	write_text(f->page, "<!--batten-data--><!--batten-data-->\n");
	refuse(f, NULL, BATTEN_INPUT, "once");
	assert_int_equal(setenv("BATTEN_MODULE_PATH", f->folder, 1), 0);
	assert_int_equal(batten_report_write(f->context, f->database, NULL, f->out, NULL),
	                 BATTEN_MISSING);
	assert_non_null(strstr(batten_context_error(f->context), "batten_report.html, is missing"));
	assert_int_equal(batten_status_exit_code(BATTEN_MISSING), 6);
	assert_int_equal(unsetenv("BATTEN_MODULE_PATH"), 0);
	batten_report_options options;
	batten_report_options_default(&options);
	options.hull_count = BATTEN_REPORT_HULLS_MOST + 1;
	assert_int_equal(batten_report_write(f->context, f->database, &options, f->out, NULL),
	                 BATTEN_USAGE);
	(void)unlink(f->out);
}

/* ---- memory ---- */

static batten_status report_again(batten_context *context, void *user)
{
	fixture *f = user;
	batten_report_options options;
	batten_report_options_default(&options);
	options.page = f->page;
	return batten_report_write(context, f->database, &options, f->out, NULL);
}

static void test_memory_runs_out(void **state)
{
	fixture *f = *state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	sweep_file_change(f->database, "DELETE FROM geometry WHERE id > 0; DROP TABLE parameters;"
	                               "CREATE TABLE parameters(id INTEGER PRIMARY KEY);"
	                               "DELETE FROM designs WHERE id > 3");
	assert_true(failing_heap_each(&heap, context, report_again, f) > 50);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_numbers_are_those_of_the_database, make_fixture,
		                                end_fixture),
		cmocka_unit_test_setup_teardown(test_hulls_are_the_best_ones, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_text_stays_text, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_refusals, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_a_sweep_that_runs_is_not_read, make_fixture,
		                                end_fixture),
		cmocka_unit_test_setup_teardown(test_the_page_itself, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_memory_runs_out, make_fixture, end_fixture),
	};
	return cmocka_run_group_tests(tests, make_original, remove_original);
}
