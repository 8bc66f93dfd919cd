/* A sweep's database as one page: what meta says, the hulls, the designs, put into the page that the
 * build made of page/. */
#include "core/file.h"
#include "core/installed.h"
#include "picture/colour_map.h"
#include "report/hulls.h"
#include "report/out.h"
#include "report/rows.h"

#include <math.h>
#include <string.h>

enum { PAGE_LIMIT = 16 << 20 };

#define PAGE_NAME "batten_report.html"
static const char mark[] = "<!--batten-data-->";

void batten_report_options_default(batten_report_options *options)
{
	*options = (batten_report_options){ .struct_size = sizeof *options };
}

/* ---- the page ---- */

/* Its text, and where the data go. */
typedef struct report_page {
	char *text;
	size_t length, place;
} report_page;

static batten_status read_page(batten_context *context, const char *given, report_page *page)
{
	char found[INSTALLED_PATH_SIZE];
	const char *path = given;
	if (!path && installed_find(PAGE_NAME, found))
		path = found;
	if (!path)
		return batten_fail(
			context, BATTEN_MISSING,
			"the report's page, " PAGE_NAME
			", is missing: batten was built without it; install nodejs and npm and build "
			"again where npm reaches its registry");
	batten_status status = batten_file_read(context, path, PAGE_LIMIT, &page->text, &page->length);
	if (status != BATTEN_OK)
		return status;
	const char *at = strstr(page->text, mark);
	if (!at || strstr(at + 1, mark))
		return batten_fail(context, BATTEN_INPUT, "%s: expected the mark %s, once", path, mark);
	page->place = (size_t)(at - page->text);
	return BATTEN_OK;
}

/* ---- what is said of the sweep as a whole ---- */

static void put_name(FILE *stream, const char *text)
{
	report_put_text(stream, text, strlen(text));
}

/* What a column means; columns that are no measure of a hull explain themselves by their name. */
static const char *meaning_of(const char *name)
{
	for (size_t i = 0; batten_measure_name(i); i++)
		if (strcmp(batten_measure_name(i), name) == 0)
			return batten_measure_text(i);
	static const char *const others[][2] = {
		{ "cn_pct", "largest change of a half-breadth, percent of the half-beam" },
		{ "cn_max_m", "largest change of a half-breadth" },
		{ "cn_rms_m", "root mean square change of the half-breadths" },
		{ "closeness_m4", "sum of the squared changes, times dx dz" },
		{ "search_iterations", "iterations of the search" },
		{ "objective_start", "objective before the search" },
		{ "objective_end", "objective after the search" },
		{ "w2_over_w1", "weight of closeness over weight of fairness" },
	};
	for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
		if (strcmp(others[i][0], name) == 0)
			return others[i][1];
	return "";
}

static void put_columns(const report_sweep *sweep, FILE *stream)
{
	(void)fputs(",\n\"columns\":[", stream);
	for (size_t i = 0; i < sweep->column_count; i++) {
		const report_column *column = &sweep->columns[i];
		(void)fputs(i > 0 ? ",\n{\"name\":" : "\n{\"name\":", stream);
		put_name(stream, column->name);
		(void)fprintf(stream,
		              ",\"parameter\":%s,\"meaning\":", column->is_parameter ? "true" : "false");
		put_name(stream, column->is_parameter ? "varied by the plan" : meaning_of(column->name));
		if (column->is_constant) {
			(void)fputs(",\"constant\":", stream);
			report_put_number(stream, column->value);
		}
		(void)fputc('}', stream);
	}
	(void)fputc(']', stream);
}

static void put_statuses(const report_sweep *sweep, FILE *stream)
{
	(void)fputs(",\n\"statuses\":[", stream);
	for (size_t i = 0; i < sweep->status_count; i++) {
		(void)fputs(i > 0 ? ",{\"name\":" : "{\"name\":", stream);
		put_name(stream, sweep->statuses[i].name);
		(void)fprintf(stream, ",\"count\":%zu}", sweep->statuses[i].count);
	}
	(void)fputc(']', stream);
}

static void put_objectives(const report_sweep *sweep, FILE *stream)
{
	(void)fputs(",\n\"objectives\":[", stream);
	for (size_t i = 0; i < json_array_size(sweep->objectives); i++) {
		const json_t *objective = json_array_get(sweep->objectives, i);
		(void)fputs(i > 0 ? ",{\"measure\":" : "{\"measure\":", stream);
		put_name(stream, json_string_value(json_object_get(objective, "measure")));
		(void)fputs(",\"goal\":", stream);
		put_name(stream, json_string_value(json_object_get(objective, "goal")));
		(void)fputc('}', stream);
	}
	(void)fputc(']', stream);
}

/* The texts and whole numbers of meta that the page shows; null where there is none. */
static void put_meta(const report_sweep *sweep, FILE *stream)
{
	static const char *const keys[] = { "batten_version", "name",  "plan",   "plan_hash", "seed",
		                                "design_count",   "shard", "shards", "complete" };
	for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
		const json_t *value = json_object_get(sweep->meta, keys[i]);
		(void)fprintf(stream, "%s\"%s\":", i > 0 ? ",\n" : "", keys[i]);
		if (json_is_string(value))
			put_name(stream, json_string_value(value));
		else if (json_is_integer(value))
			(void)fprintf(stream, "\"%lld\"", (long long)json_integer_value(value));
		else
			(void)fputs("null", stream);
	}
}

static void put_numbers(FILE *stream, const char *name, const double *values, size_t count)
{
	(void)fprintf(stream, ",\n\"%s\":[", name);
	for (size_t i = 0; i < count; i++) {
		(void)fputs(i > 0 ? "," : "", stream);
		report_put_number(stream, values[i]);
	}
	(void)fputc(']', stream);
}

/* The colours of the pictures, six hexadecimal digits each. */
static void put_colours(FILE *stream)
{
	picture_colour_map map;
	picture_colour_map_fill(&map);
	(void)fputs(",\n\"colours\":\"", stream);
	for (size_t i = 0; i < PICTURE_COLOUR_COUNT; i++)
		for (size_t k = 0; k < 3; k++)
			(void)fprintf(stream, "%02lx", lround(255.0 * (double)map.rgba[i][k]));
	(void)fputc('"', stream);
}

static void put_head(const report_sweep *sweep, const report_hulls *hulls, size_t written,
                     FILE *stream)
{
	(void)fputs("<script type=\"application/json\" id=\"batten-sweep\">{\"report_version\":",
	            stream);
	put_name(stream, BATTEN_VERSION);
	(void)fprintf(stream, ",\n\"designs\":%zu,\"shown\":%zu,\"front\":%zu,\"hulls\":%zu,\n",
	              sweep->design_count, written, sweep->front_count, hulls->count);
	put_meta(sweep, stream);
	put_statuses(sweep, stream);
	put_objectives(sweep, stream);
	put_columns(sweep, stream);
	put_numbers(stream, "x_m", sweep->x_m, sweep->station_count);
	put_numbers(stream, "z_m", sweep->z_m, sweep->waterline_count);
	(void)fputs(",\n\"hydrostatics\":[", stream);
	for (size_t i = 0; report_hydrostatics_name(i); i++)
		(void)fprintf(stream, "%s\"%s\"", i > 0 ? "," : "", report_hydrostatics_name(i));
	(void)fputs("],\n\"scale_per_m\":", stream);
	report_put_number(stream, hulls->scale_per_m);
	put_colours(stream);
	(void)fputs("}</script>\n", stream);
}

/* ---- all of it ---- */

static batten_status write_data(const report_sweep *sweep, size_t hull_count, FILE *stream,
                                batten_report_facts *facts)
{
	report_choice choice = { 0 };
	report_hulls hulls = { 0 };
	size_t written = 0;
	batten_status status = report_choice_make(sweep, hull_count, &choice);
	if (status == BATTEN_OK)
		status = report_hulls_write(sweep, &choice, stream, &hulls);
	if (status == BATTEN_OK)
		status = report_rows_write(sweep, &choice, stream, &written);
	report_choice_release(&choice);
	if (status != BATTEN_OK)
		return status;
	put_head(sweep, &hulls, written, stream);
	*facts = (batten_report_facts){
		.design_count = sweep->design_count,
		.shown_count = written,
		.front_count = sweep->front_count,
		.hull_count = hulls.count,
	};
	return BATTEN_OK;
}

static batten_status write_page(const report_sweep *sweep, const report_page *page,
                                size_t hull_count, const char *path, batten_report_facts *facts)
{
	batten_file file = { 0 };
	batten_context *context = sweep->database->context;
	batten_status status = batten_file_open(context, path, &file);
	if (status != BATTEN_OK)
		return status;
	(void)fwrite(page->text, 1, page->place, file.stream);
	status = write_data(sweep, hull_count, file.stream, facts);
	const size_t rest = page->place + sizeof mark - 1;
	(void)fwrite(page->text + rest, 1, page->length - rest, file.stream);
	const long length = ftell(file.stream);
	facts->bytes = length > 0 ? (uint64_t)length : 0;
	if (status == BATTEN_OK)
		return batten_file_commit(context, &file);
	batten_file_abandon(context, &file);
	return status;
}

batten_status batten_report_write(batten_context *context, const char *database_path,
                                  const batten_report_options *options, const char *path,
                                  batten_report_facts *facts)
{
	batten_report_options chosen;
	batten_report_options_default(&chosen);
	if (options)
		chosen = *options;
	if (chosen.struct_size != sizeof chosen)
		return batten_fail(context, BATTEN_USAGE, "report options of another version of batten");
	if (chosen.hull_count > BATTEN_REPORT_HULLS_MOST)
		return batten_fail(context, BATTEN_USAGE, "a report with %zu hulls: at most %d can be kept",
		                   chosen.hull_count, BATTEN_REPORT_HULLS_MOST);
	report_page page = { 0 };
	report_database database = { 0 };
	report_sweep sweep = { 0 };
	batten_report_facts told = { 0 };
	batten_status status = read_page(context, chosen.page, &page);
	if (status == BATTEN_OK)
		status = report_database_open(context, database_path, &database);
	if (status == BATTEN_OK)
		status = report_sweep_read(&database, &sweep);
	if (status == BATTEN_OK)
		status = write_page(&sweep, &page, chosen.hull_count, path, &told);
	if (status == BATTEN_OK && facts)
		*facts = told;
	report_sweep_release(&sweep);
	report_database_close(&database);
	batten_release(context, page.text);
	return status;
}
