/* batten measure: tables over drafts and along the ship. */
#include "json_out.h"
#include "measure_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A table in the making, and what its chart is drawn from. */
struct maker {
	const measure_job *job;
	batten_context *context;
	size_t draft_count, section_count, height_count;
	double *drafts, *x, *heights, *areas;
	batten_hydrostatics *rows;
	size_t *counts;
	double *values; /* of a table of areas */
};

static batten_status no_memory(void)
{
	(void)fputs("batten measure: out of memory\n", stderr);
	return BATTEN_MEMORY;
}

static void release(struct maker *m)
{
	free(m->drafts);
	free(m->x);
	free(m->heights);
	free(m->areas);
	free(m->rows);
	free(m->counts);
	free(m->values);
}

/* ------------------------------------------------------------------------------------------------
 * Out
 * --------------------------------------------------------------------------------------------- */

static batten_status print_table_json(const batten_table *table)
{
	json_t *rows = json_array();
	for (size_t i = 0; rows && i < table->row_count; i++) {
		json_t *row = json_object();
		for (size_t k = 0; row && k < table->text_count; k++) {
			const char *text = table->texts[i * table->text_count + k];
			(void)json_object_set_new(row, table->text_columns[k],
			                          text ? json_string(text) : json_null());
		}
		for (size_t k = 0; row && k < table->column_count; k++)
			(void)json_object_set_new(row, table->columns[k],
			                          cli_json_number(table->values[i * table->column_count + k]));
		(void)json_array_append_new(rows, row);
	}
	return cli_json_print("measure",
	                      json_pack("{s:s, s:s, s:s, s:o}", "name", table->name, "frame", "ap-fwd",
	                                "quadrature", table->quadrature, "rows", rows));
}

static void print_number(double value)
{
	if (isnan(value))
		(void)printf(" %14s", "-");
	else
		(void)printf(" %14.8g", value);
}

/* The end of a text, as paths tell most there; no control characters. */
static void print_text(const char *text)
{
	enum { WIDE = 14 };
	char shown[WIDE + 1];
	const size_t length = text ? strlen(text) : 0;
	(void)snprintf(shown, sizeof shown, "%s",
	               text ? text + (length > WIDE ? length - WIDE : 0) : "-");
	cli_clean(shown);
	(void)printf(" %14s", shown);
}

/* Columns down, as there are more of them than drafts; areas as they are. */
static void print_table_text(const batten_table *table, bool across)
{
	(void)printf("%s: frame ap-fwd; quadrature: %s\n\n", table->name, table->quadrature);
	for (size_t k = 0; across && k < table->text_count; k++) {
		(void)printf("%-22s", table->text_columns[k]);
		for (size_t i = 0; i < table->row_count; i++)
			print_text(table->texts[i * table->text_count + k]);
		(void)fputc('\n', stdout);
	}
	for (size_t k = 0; across && k < table->column_count; k++) {
		(void)printf("%-22s", table->columns[k]);
		for (size_t i = 0; i < table->row_count; i++)
			print_number(table->values[i * table->column_count + k]);
		(void)fputc('\n', stdout);
	}
	for (size_t k = 0; !across && k < table->column_count; k++)
		(void)printf(" %14s", table->columns[k]);
	for (size_t i = 0; !across && i < table->row_count; i++) {
		(void)fputc('\n', stdout);
		for (size_t k = 0; k < table->column_count; k++)
			print_number(table->values[i * table->column_count + k]);
	}
	if (!across)
		(void)fputc('\n', stdout);
}

static batten_status put_chart(const struct maker *m)
{
	const measure_job *job = m->job;
	batten_status status;
	if (job->bonjean)
		status = batten_picture_bonjean(m->context, job->name, m->section_count, m->x,
		                                m->height_count, m->heights, m->areas, job->out);
	else if (job->section_areas)
		status = batten_picture_section_areas(m->context, job->name, m->draft_count, m->drafts,
		                                      m->counts, m->x, m->areas, job->out);
	else
		status = batten_picture_curves_of_form(m->context, job->name, m->draft_count, m->rows,
		                                       job->out);
	return status == BATTEN_OK ? status : cli_failure("measure", m->context, status);
}

batten_status measure_put_table(const measure_job *job, batten_context *context,
                                const batten_table *table, bool across)
{
	if (!job->out) {
		if (job->common.json)
			return print_table_json(table);
		print_table_text(table, across);
		return BATTEN_OK;
	}
	const batten_status status = batten_table_write(context, table, job->out);
	return status == BATTEN_OK ? status : cli_failure("measure", context, status);
}

static batten_status put_table(const struct maker *m, batten_table *table, bool across)
{
	const measure_job *job = m->job;
	table->name = job->name;
	table->quadrature = measure_rule(job);
	if (job->out && measure_ends_in(job->out, ".svg"))
		return put_chart(m);
	return measure_put_table(job, m->context, table, across);
}

/* ------------------------------------------------------------------------------------------------
 * Over drafts
 * --------------------------------------------------------------------------------------------- */

/* N heights up to the draft asked for, else the top of the table. */
static double *heights_up(const measure_job *job, size_t count)
{
	const double top = job->draft_count ? job->drafts_m[0] : job->highest_m;
	double *heights = malloc(count * sizeof *heights);
	for (size_t k = 0; heights && k < count; k++)
		heights[k] = k + 1 == count
		                 ? top
		                 : job->lowest_m + (top - job->lowest_m) * (double)(k + 1) / (double)count;
	return heights;
}

static batten_status table_over_drafts(struct maker *m)
{
	const measure_job *job = m->job;
	const char *columns[BATTEN_HYDROSTATICS_COUNT];
	m->draft_count = job->curves_of_form ? job->curves_of_form : job->draft_count;
	if (job->curves_of_form)
		m->drafts = heights_up(job, m->draft_count);
	else if ((m->drafts = malloc(m->draft_count * sizeof *m->drafts)))
		memcpy(m->drafts, job->drafts_m, m->draft_count * sizeof *m->drafts);
	m->rows = malloc(m->draft_count * sizeof *m->rows);
	if (!m->drafts || !m->rows)
		return no_memory();
	const batten_status status = measure_hydrostatics(job, m->context, m->draft_count, m->drafts,
	                                                  m->rows);
	if (status != BATTEN_OK)
		return status;
	for (size_t k = 0; k < BATTEN_HYDROSTATICS_COUNT; k++)
		columns[k] = batten_hydrostatics_name(k);
	/* The struct is an array of doubles in the order of the names (batten.h). */
	batten_table table = { .column_count = BATTEN_HYDROSTATICS_COUNT,
		                   .row_count = m->draft_count,
		                   .columns = columns,
		                   .values = (const double *)m->rows };
	return put_table(m, &table, true);
}

/* ------------------------------------------------------------------------------------------------
 * Along the ship
 * --------------------------------------------------------------------------------------------- */

/* The stations of a table, or as many equal intervals of a surface or mesh. */
static batten_status take_sections(struct maker *m, size_t intervals)
{
	const measure_job *job = m->job;
	m->section_count = job->hull ? batten_hull_station_count(job->hull) : intervals + 1;
	m->x = malloc(m->section_count * sizeof *m->x);
	if (!m->x)
		return no_memory();
	if (job->hull) {
		memcpy(m->x, batten_hull_x_m(job->hull), m->section_count * sizeof *m->x);
		return BATTEN_OK;
	}
	for (size_t i = 0; i <= intervals; i++)
		m->x[i] = job->aftmost_m +
		          (job->foremost_m - job->aftmost_m) * (double)i / (double)intervals;
	return BATTEN_OK;
}

/* Columns place, height, area: heights one after the other. */
static batten_status put_areas(struct maker *m, const char *height_name, size_t count,
                               const double *x, const double *heights)
{
	const char *columns[] = { height_name, "x_m", "section_area_m2" };
	m->values = malloc((3 * count + 1) * sizeof *m->values);
	if (!m->values)
		return no_memory();
	for (size_t i = 0; i < count; i++) {
		m->values[3 * i] = heights[i];
		m->values[3 * i + 1] = x[i];
		m->values[3 * i + 2] = m->areas[i];
	}
	batten_table table = {
		.column_count = 3, .row_count = count, .columns = columns, .values = m->values
	};
	return put_table(m, &table, false);
}

static batten_status put_grid(struct maker *m, const char *height_name)
{
	const size_t count = m->section_count * m->height_count;
	double *x = malloc(count * sizeof *x), *heights = malloc(count * sizeof *heights);
	batten_status status = x && heights ? BATTEN_OK : no_memory();
	for (size_t i = 0; status == BATTEN_OK && i < count; i++) {
		x[i] = m->x[i % m->section_count];
		heights[i] = m->heights[i / m->section_count];
	}
	if (status == BATTEN_OK)
		status = put_areas(m, height_name, count, x, heights);
	free(x);
	free(heights);
	return status;
}

static batten_status areas_on_grid(struct maker *m)
{
	const measure_job *job = m->job;
	m->areas = malloc(m->section_count * m->height_count * sizeof *m->areas);
	if (!m->areas)
		return no_memory();
	return measure_sections(job, m->context, m->section_count, m->x, m->height_count, m->heights,
	                        m->areas);
}

static batten_status bonjean(struct maker *m)
{
	enum { INTERVALS = 20 };
	m->height_count = m->job->bonjean;
	batten_status status = take_sections(m, INTERVALS);
	if (status == BATTEN_OK && !(m->heights = heights_up(m->job, m->height_count)))
		status = no_memory();
	if (status == BATTEN_OK)
		status = areas_on_grid(m);
	return status == BATTEN_OK ? put_grid(m, "z_m") : status;
}

/* Curves with their ends, one after the other. */
static batten_status area_curves(struct maker *m)
{
	const measure_job *job = m->job;
	const size_t most = batten_hull_station_count(job->hull) + 2;
	m->x = malloc(m->draft_count * most * sizeof *m->x);
	m->areas = malloc(m->draft_count * most * sizeof *m->areas);
	m->heights = malloc(m->draft_count * most * sizeof *m->heights);
	if (!m->x || !m->areas || !m->heights)
		return no_memory();
	size_t total = 0;
	for (size_t k = 0; k < m->draft_count; k++) {
		const batten_status status = batten_hull_area_curve(m->context, job->hull, &job->options,
		                                                    m->drafts[k], m->x + total,
		                                                    m->areas + total, &m->counts[k]);
		if (status != BATTEN_OK)
			return cli_failure("measure", m->context, status);
		for (size_t i = 0; i < m->counts[k]; i++)
			m->heights[total++] = m->drafts[k];
	}
	return put_areas(m, "draft_m", total, m->x, m->heights);
}

static batten_status section_areas(struct maker *m)
{
	enum { INTERVALS = 40 };
	const measure_job *job = m->job;
	m->draft_count = job->draft_count ? job->draft_count : 1;
	m->drafts = malloc(m->draft_count * sizeof *m->drafts);
	m->counts = malloc(m->draft_count * sizeof *m->counts);
	if (!m->drafts || !m->counts)
		return no_memory();
	for (size_t k = 0; k < m->draft_count; k++)
		m->drafts[k] = job->draft_count ? job->drafts_m[k] : batten_hull_draft_m(job->hull);
	if (job->hull)
		return area_curves(m);
	batten_status status = take_sections(m, INTERVALS);
	if (status != BATTEN_OK)
		return status;
	/* the chart takes one list of places a curve */
	const size_t one = m->section_count, count = one * m->draft_count;
	double *x = realloc(m->x, count * sizeof *x);
	m->heights = malloc(m->draft_count * sizeof *m->heights);
	if (x)
		m->x = x;
	if (!x || !m->heights)
		return no_memory();
	for (size_t i = one; i < count; i++)
		m->x[i] = m->x[i - one];
	for (size_t k = 0; k < m->draft_count; k++) {
		m->counts[k] = one;
		m->heights[k] = m->drafts[k];
	}
	m->height_count = m->draft_count;
	status = areas_on_grid(m);
	return status == BATTEN_OK ? put_grid(m, "draft_m") : status;
}

batten_status measure_table(const measure_job *job, batten_context *context)
{
	struct maker m = { .job = job, .context = context };
	const batten_status status = job->bonjean         ? bonjean(&m)
	                             : job->section_areas ? section_areas(&m)
	                                                  : table_over_drafts(&m);
	release(&m);
	return status;
}
