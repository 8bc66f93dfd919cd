/* What the tests of forward and inverse fairing share: contexts, the thesis's hulls as printed,
 * fairings. */
#ifndef BATTEN_TESTS_PASS_FIXTURE_H
#define BATTEN_TESTS_PASS_FIXTURE_H

#include "batten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline int make_context(void **state)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	*state = context;
	return 0;
}

static inline int end_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

static inline batten_hull *read_hull(batten_context *context, const char *name)
{
	char path[4096];
	batten_hull *hull = NULL;
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	if (batten_hull_read(context, path, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static inline batten_hull *parse_hull(batten_context *context, const char *text)
{
	batten_hull *hull = NULL;
	if (batten_hull_parse(context, "test.csv", text, strlen(text), &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static inline batten_fair_options by_method(batten_fair_method method, unsigned iterations)
{
	batten_fair_options options;
	batten_fair_options_default(&options);
	options.method = method;
	options.iterations = iterations;
	options.smooth = false;
	return options;
}

static inline batten_fairing *fair(batten_context *context, const batten_hull *hull,
                                   const batten_fair_options *options)
{
	batten_fairing *fairing = NULL;
	if (batten_hull_fair(context, hull, options, &fairing) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return fairing;
}

static inline void assert_near(double value, double expected, double tolerance, const char *what)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%s: found %.17g, expected %.17g within %g", what, value, expected, tolerance);
}

/* ------------------------------------------------------------------------------------------------
 * Printed tables
 * --------------------------------------------------------------------------------------------- */

enum { COLUMNS_MOST = 12, ROWS_MOST = 400 };

/* Empty cells are NaN. */
struct printed {
	size_t rows, columns;
	char names[COLUMNS_MOST][64];
	double cells[ROWS_MOST][COLUMNS_MOST];
	bool doubt[ROWS_MOST][COLUMNS_MOST]; /* the note says that the cell is misread */
};

static inline size_t split(char *line, char *cells[COLUMNS_MOST])
{
	size_t count = 0;
	line[strcspn(line, "\r\n")] = '\0';
	for (char *cell = line; cell && count < COLUMNS_MOST; count++) {
		cells[count] = cell;
		cell = strchr(cell, ',');
		if (cell)
			*cell++ = '\0';
	}
	return count;
}

static inline void read_printed(const char *table, struct printed *out)
{
	char path[4096], line[1024];
	char *cells[COLUMNS_MOST];
	(void)snprintf(path, sizeof path, "%s/../tests/data/tables/%s.csv", BATTEN_DATA_DIR, table);
	FILE *file = fopen(path, "r");
	assert_non_null(file);
	*out = (struct printed){ 0 };
	while (fgets(line, sizeof line, file)) {
		if (line[0] == '#')
			continue;
		const size_t count = split(line, cells);
		const bool header = out->columns == 0;
		for (size_t c = 0; c < count; c++) {
			if (header)
				(void)snprintf(out->names[c], sizeof out->names[c], "%s", cells[c]);
			else
				out->cells[out->rows][c] = *cells[c] ? strtod(cells[c], NULL) : NAN;
		}
		if (header)
			out->columns = count;
		else
			out->rows++;
		assert_true(out->rows < ROWS_MOST);
		const char *note = cells[count - 1];
		for (size_t c = 0; !header && c + 1 < count; c++)
			if (strncmp(note, "doubt:", 6) == 0 && strstr(note, out->names[c]))
				out->doubt[out->rows - 1][c] = true;
	}
	(void)fclose(file);
}

static inline size_t column_of(const struct printed *table, const char *name)
{
	for (size_t c = 0; c < table->columns; c++)
		if (strcmp(table->names[c], name) == 0)
			return c;
	fail_msg("no column %s", name);
	return 0;
}

#endif
