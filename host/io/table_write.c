/* Tables as CSV and JSON, whole or piece by piece: every number as the shortest decimal that reads back. */
#include "core/file.h"
#include "core/number.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A row is put together in a buffer of this size, at most this many bytes of it by one number. */
enum { ROOM = 4096 };

struct batten_table_file {
	batten_context *context;
	batten_file file;
	bool as_json, any; /* any: a row was written */
	size_t used;
	char room[ROOM];
};

/* stdio keeps its error until the file is committed. */
static void put(batten_table_file *out, const char *text, size_t length)
{
	if (length > ROOM - out->used) {
		(void)fwrite(out->room, 1, out->used, out->file.stream);
		out->used = 0;
	}
	if (length > ROOM) {
		(void)fwrite(text, 1, length, out->file.stream);
		return;
	}
	memcpy(out->room + out->used, text, length);
	out->used += length;
}

static void put_text(batten_table_file *out, const char *text)
{
	put(out, text, strlen(text));
}

static void put_number(batten_table_file *out, double value)
{
	char text[BATTEN_NUMBER_SIZE];
	put_text(out, batten_number_write(text, value));
}

/* ------------------------------------------------------------------------------------------------
 * CSV
 * --------------------------------------------------------------------------------------------- */

/* Quoted where it would be read as something else (RFC 4180). */
static void put_cell(batten_table_file *out, const char *text)
{
	const size_t length = strlen(text);
	const bool edged = length > 0 && (text[0] == ' ' || text[0] == '#' || text[length - 1] == ' ');
	if (!edged && !strpbrk(text, ",\"\r\n")) {
		put(out, text, length);
		return;
	}
	put(out, "\"", 1);
	for (const char *quote = strchr(text, '"'); quote; quote = strchr(text, '"')) {
		put(out, text, (size_t)(quote + 1 - text));
		put(out, "\"", 1);
		text = quote + 1;
	}
	put_text(out, text);
	put(out, "\"", 1);
}

static void put_csv_head(batten_table_file *out, const batten_table *table)
{
	put_text(out, "# unit and sign in the names; frame: ap-fwd\n# name: ");
	put_text(out, table->name);
	if (table->quadrature) {
		put_text(out, "\n# quadrature: ");
		put_text(out, table->quadrature);
	}
	put(out, "\n", 1);
	for (size_t i = 0; i < table->text_count + table->column_count; i++) {
		const size_t number = i - table->text_count;
		put(out, ",", i > 0);
		put_text(out, i < table->text_count ? table->text_columns[i] : table->columns[number]);
	}
	put(out, "\n", 1);
}

static void put_csv_row(batten_table_file *out, const batten_table *table, size_t row)
{
	const double *values = table->values + row * table->column_count;
	for (size_t i = 0; i < table->text_count; i++) {
		const char *text = table->texts[row * table->text_count + i];
		put(out, ",", i > 0);
		put_cell(out, text ? text : "");
	}
	for (size_t i = 0; i < table->column_count; i++) {
		put(out, ",", i > 0 || table->text_count > 0);
		if (isfinite(values[i]))
			put_number(out, values[i]);
	}
	put(out, "\n", 1);
}

/* ------------------------------------------------------------------------------------------------
 * JSON
 * --------------------------------------------------------------------------------------------- */

static batten_status put_json_text(batten_table_file *out, const char *text)
{
	json_t *value = text ? json_string(text) : json_null();
	char *written = value ? json_dumps(value, JSON_ENCODE_ANY) : NULL;
	json_decref(value);
	if (!written)
		return batten_fail_memory(out->context);
	put_text(out, written);
	free(written);
	return BATTEN_OK;
}

static batten_status put_json_head(batten_table_file *out, const batten_table *table)
{
	put_text(out, "{\n  \"name\": ");
	const batten_status status = put_json_text(out, table->name);
	put_text(out, ",\n  \"frame\": \"ap-fwd\"");
	if (table->quadrature) {
		put_text(out, ",\n  \"quadrature\": \"");
		put_text(out, table->quadrature);
		put_text(out, "\"");
	}
	put_text(out, ",\n  \"rows\": [");
	return status;
}

static void put_json_name(batten_table_file *out, const char *name, bool first)
{
	put_text(out, first ? "\"" : ", \"");
	put_text(out, name);
	put_text(out, "\": ");
}

static batten_status put_json_row(batten_table_file *out, const batten_table *table, size_t row)
{
	const double *values = table->values + row * table->column_count;
	batten_status status = BATTEN_OK;
	put_text(out, out->any ? ",\n    { " : "\n    { ");
	for (size_t i = 0; i < table->text_count && status == BATTEN_OK; i++) {
		put_json_name(out, table->text_columns[i], i == 0);
		status = put_json_text(out, table->texts[row * table->text_count + i]);
	}
	for (size_t i = 0; i < table->column_count; i++) {
		put_json_name(out, table->columns[i], i == 0 && table->text_count == 0);
		/* JSON reads -0 as an integer, which has no sign there */
		if (isfinite(values[i]))
			put_number(out, values[i] == 0 ? 0 : values[i]);
		else
			put_text(out, "null");
	}
	put_text(out, " }");
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Files
 * --------------------------------------------------------------------------------------------- */

static bool ends_in(const char *path, const char *ending)
{
	size_t length = strlen(path), wanted = strlen(ending);
	return length > wanted && strcmp(path + length - wanted, ending) == 0;
}

batten_status batten_table_open(batten_context *context, const batten_table *table,
                                const char *path, batten_table_file **file)
{
	*file = NULL;
	bool as_json = ends_in(path, ".json");
	if (!as_json && !ends_in(path, ".csv"))
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: a name that ends in .csv or .json was expected", path);
	batten_table_file *out = batten_allocate(context, 1, sizeof *out);
	if (!out)
		return BATTEN_MEMORY;
	out->context = context;
	out->as_json = as_json;
	batten_status status = batten_file_open(context, path, &out->file);
	if (status != BATTEN_OK) {
		batten_release(context, out);
		return status;
	}
	if (as_json)
		status = put_json_head(out, table);
	else
		put_csv_head(out, table);
	if (status == BATTEN_OK)
		status = batten_table_add(out, table);
	if (status == BATTEN_OK)
		*file = out;
	else
		batten_table_abandon(out);
	return status;
}

batten_status batten_table_add(batten_table_file *file, const batten_table *table)
{
	batten_status status = BATTEN_OK;
	for (size_t row = 0; row < table->row_count && status == BATTEN_OK; row++) {
		if (file->as_json)
			status = put_json_row(file, table, row);
		else
			put_csv_row(file, table, row);
		file->any = true;
	}
	return status;
}

batten_status batten_table_commit(batten_table_file *file)
{
	batten_context *context = file->context;
	if (file->as_json)
		put_text(file, "\n  ]\n}\n");
	(void)fwrite(file->room, 1, file->used, file->file.stream);
	const batten_status status = batten_file_commit(context, &file->file);
	batten_release(context, file);
	return status;
}

void batten_table_abandon(batten_table_file *file)
{
	if (!file)
		return;
	batten_file_abandon(file->context, &file->file);
	batten_release(file->context, file);
}

batten_status batten_table_write(batten_context *context, const batten_table *table,
                                 const char *path)
{
	batten_table_file *file = NULL;
	const batten_status status = batten_table_open(context, table, path, &file);
	return file ? batten_table_commit(file) : status;
}
