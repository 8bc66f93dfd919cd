/* Tables of numbers as CSV and JSON: every number as the shortest decimal that reads back. */
#include "core/file.h"
#include "core/number.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* stdio keeps its error until the file is committed. */
static void put_csv(FILE *stream, const batten_table *table)
{
	(void)fputs("# unit and sign in the names; frame: ap-fwd\n", stream);
	(void)fprintf(stream, "# name: %s\n# quadrature: %s\n", table->name, table->quadrature);
	for (size_t i = 0; i < table->column_count; i++)
		(void)fprintf(stream, "%s%s", i > 0 ? "," : "", table->columns[i]);
	for (size_t i = 0; i < table->row_count * table->column_count; i++) {
		char text[BATTEN_NUMBER_SIZE];
		(void)fputc(i % table->column_count == 0 ? '\n' : ',', stream);
		if (isfinite(table->values[i]))
			(void)fputs(batten_number_write(text, table->values[i]), stream);
	}
	(void)fputc('\n', stream);
}

static void put_row(FILE *stream, const batten_table *table, const double *row)
{
	for (size_t i = 0; i < table->column_count; i++) {
		char text[BATTEN_NUMBER_SIZE];
		/* JSON reads -0 as an integer, which has no sign there */
		double value = row[i] == 0 ? 0 : row[i];
		(void)fprintf(stream, "%s\"%s\": %s", i > 0 ? ", " : "", table->columns[i],
		              isfinite(value) ? batten_number_write(text, value) : "null");
	}
}

static batten_status put_json(batten_context *context, FILE *stream, const batten_table *table)
{
	json_t *name = json_string(table->name);
	char *text = name ? json_dumps(name, JSON_ENCODE_ANY) : NULL;
	json_decref(name);
	if (!text)
		return batten_fail_memory(context);
	(void)fprintf(stream,
	              "{\n  \"name\": %s,\n  \"frame\": \"ap-fwd\",\n  \"quadrature\": \"%s\",\n"
	              "  \"rows\": [",
	              text, table->quadrature);
	for (size_t i = 0; i < table->row_count; i++) {
		(void)fputs(i > 0 ? ",\n    { " : "\n    { ", stream);
		put_row(stream, table, table->values + i * table->column_count);
		(void)fputs(" }", stream);
	}
	(void)fputs("\n  ]\n}\n", stream);
	free(text);
	return BATTEN_OK;
}

static bool ends_in(const char *path, const char *ending)
{
	size_t length = strlen(path), wanted = strlen(ending);
	return length > wanted && strcmp(path + length - wanted, ending) == 0;
}

batten_status batten_table_write(batten_context *context, const batten_table *table,
                                 const char *path)
{
	bool as_json = ends_in(path, ".json");
	if (!as_json && !ends_in(path, ".csv"))
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: a name that ends in .csv or .json was expected", path);
	batten_file file = { 0 };
	batten_status status = batten_file_open(context, path, &file);
	if (status != BATTEN_OK)
		return status;
	if (as_json)
		status = put_json(context, file.stream, table);
	else
		put_csv(file.stream, table);
	if (status == BATTEN_OK)
		return batten_file_commit(context, &file);
	batten_file_abandon(context, &file);
	return status;
}
