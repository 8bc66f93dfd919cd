/* A sweep by threads, its stages beside each other, gives the rows of one whose stages take turns in a
 * single thread; stopped and resumed too. On the plain C path, so that it runs under ThreadSanitizer. */
#include "batten.h"

#include <setjmp.h>
#include <sqlite3.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { PATH_MOST = 300, DESIGNS = 23, THREADS = 4 };

static char folder[200];

static void path_of(const char *name, char path[PATH_MOST])
{
	(void)snprintf(path, PATH_MOST, "%s/%s", folder, name);
}

static int make_folder(void **state)
{
	(void)state;
	const char *temporary = getenv("TMPDIR");
	(void)snprintf(folder, sizeof folder, "%.100s/batten-test.XXXXXX",
	               temporary ? temporary : "/tmp");
	return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
	(void)state;
	static const char *const names[] = { "hull.csv", "plan.json", "turns.db", "threads.db" };
	for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
		char path[PATH_MOST];
		path_of(names[i], path);
		(void)unlink(path);
	}
	return rmdir(folder);
}

/* A full form with a wave in its waterlines, and a plan of all stages. */
static void write_inputs(void)
{
	char path[PATH_MOST];
	path_of("hull.csv", path);
	FILE *stream = fopen(path, "w");
	assert_non_null(stream);
	(void)fputs("# batten-offsets: 1\n# name: parent\n# unit: m\n# frame: ap-fwd\n# lbp: 16\n"
	            "# draft: 1\n# layout: grid\nz\\x,0,2,4,6,8,10,12,14,16\n",
	            stream);
	for (int k = 0; k <= 6; k++) {
		(void)fprintf(stream, "%g", 0.2 * k);
		for (int i = 0; i <= 8; i++) {
			const double u = (i - 4) / 4.0, v = 1 - k / 6.0;
			const double wave = i > 0 && i < 8 && k > 0 ? 0.004 * ((i * 3 + k * 5) % 4) : 0;
			(void)fprintf(stream, ",%.17g", (1 - u * u) * (1 - v * v) + wave);
		}
		(void)fputc('\n', stream);
	}
	assert_int_equal(fclose(stream), 0);
	path_of("plan.json", path);
	stream = fopen(path, "w");
	assert_non_null(stream);
	(void)fprintf(
		stream,
		"{ \"batten_plan\": 1, \"name\": \"test\", \"parent\": { \"hull\": \"hull.csv\" },\n"
		"\"parameters\": { \"dcp\": { \"from\": -2, \"to\": 2 },\n"
		"\"deep\": { \"from\": 0.9, \"to\": 1.1, \"steps\": 2 } },\n"
		"\"sampling\": { \"method\": \"random\", \"count\": %d, \"seed\": 5 },\n"
		"\"vary\": [ { \"method\": \"lackenby\", \"dcp_pct\": \"dcp\" },\n"
		"{ \"method\": \"affine\", \"scale_z\": \"deep\" } ],\n"
		"\"fair\": { \"w2_over_w1\": 100, \"iteration_limit\": 20 },\n"
		"\"measure\": { \"drafts_m\": [0.5, 0.8] },\n"
		"\"objectives\": [ { \"measure\": \"energy_bending\", \"goal\": \"min\" } ],\n"
		"\"keep\": { \"offsets\": { \"best\": 3, \"measure\": \"cb\", \"goal\": \"max\" } } }\n",
		DESIGNS);
	assert_int_equal(fclose(stream), 0);
}

/* Stops once so many designs are stored. */
static void note(const batten_sweep_progress *progress, void *user)
{
	uint64_t *stored = user;
	*stored = progress->stored;
}

static bool has_some(void *user)
{
	return *(const uint64_t *)user >= 6;
}

static batten_status sweep(const char *name, unsigned threads, batten_sweep_options options)
{
	char plan[PATH_MOST], database[PATH_MOST];
	uint64_t stored = 0;
	batten_context_options how;
	batten_context *context = NULL;
	batten_context_options_default(&how);
	how.threads = threads;
	assert_int_equal(batten_context_create(&how, &context), BATTEN_OK);
	path_of("plan.json", plan);
	path_of(name, database);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.progress = note;
	options.user = &stored;
	batten_sweep_progress progress;
	const batten_status status = batten_sweep_run(context, plan, database, &options, &progress);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE && status != BATTEN_INTERRUPTED)
		fail_msg("%s", batten_context_error(context));
	batten_context_destroy(context);
	return status;
}

/* Rows of one table that the other database has not, both ways. */
static int differences(sqlite3 *both, const char *table)
{
	char sql[400];
	sqlite3_stmt *statement = NULL;
	(void)snprintf(
		sql, sizeof sql,
		"SELECT count(*) FROM (SELECT * FROM (SELECT * FROM main.%s EXCEPT SELECT * FROM b.%s) "
		"UNION ALL SELECT * FROM (SELECT * FROM b.%s EXCEPT SELECT * FROM main.%s))",
		table, table, table, table);
	assert_int_equal(sqlite3_prepare_v2(both, sql, -1, &statement, NULL), SQLITE_OK);
	assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
	const int count = sqlite3_column_int(statement, 0);
	assert_int_equal(sqlite3_finalize(statement), SQLITE_OK);
	return count;
}

static int rows_of(sqlite3 *database, const char *table)
{
	char sql[100];
	sqlite3_stmt *statement = NULL;
	(void)snprintf(sql, sizeof sql, "SELECT count(*) FROM %s", table);
	assert_int_equal(sqlite3_prepare_v2(database, sql, -1, &statement, NULL), SQLITE_OK);
	assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
	const int count = sqlite3_column_int(statement, 0);
	assert_int_equal(sqlite3_finalize(statement), SQLITE_OK);
	return count;
}

static void same_rows(void)
{
	static const char *const tables[] = { "designs", "parameters", "measures", "hydrostatics",
		                                  "geometry" };
	char path[PATH_MOST], attach[PATH_MOST + 50];
	sqlite3 *both = NULL;
	path_of("turns.db", path);
	assert_int_equal(sqlite3_open(path, &both), SQLITE_OK);
	path_of("threads.db", path);
	(void)snprintf(attach, sizeof attach, "ATTACH '%s' AS b", path);
	assert_int_equal(sqlite3_exec(both, attach, NULL, NULL, NULL), SQLITE_OK);
	for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++)
		assert_int_equal(differences(both, tables[t]), 0);
	assert_int_equal(rows_of(both, "main.designs"), DESIGNS);
	assert_int_equal(rows_of(both, "main.measures"), DESIGNS);
	assert_int_equal(rows_of(both, "main.geometry"), 3);
	assert_int_equal(sqlite3_close(both), SQLITE_OK);
}

static void threads_and_turns_give_the_same_rows(void **state)
{
	(void)state;
	batten_sweep_options options;
	batten_sweep_options_default(&options);
	write_inputs();
	options.block = 5;
	options.stages_take_turns = true;
	const batten_status whole = sweep("turns.db", 1, options);
	assert_true(whole == BATTEN_OK || whole == BATTEN_INCOMPLETE);
	batten_sweep_options_default(&options);
	options.block = 9;
	options.stop = has_some;
	assert_int_equal(sweep("threads.db", THREADS, options), BATTEN_INTERRUPTED);
	options.stop = NULL;
	options.resume = true;
	assert_int_equal(sweep("threads.db", THREADS, options), whole);
	same_rows();
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(threads_and_turns_give_the_same_rows),
	};
	return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
