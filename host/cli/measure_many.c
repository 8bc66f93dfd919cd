/* batten measure: several surfaces of one topology. */
#include "measure_job.h"

#include <stdlib.h>
#include <string.h>

enum { TEXTS = 3 };

/* What is read and made of the files; one row a surface and draft. */
struct many {
	batten_surface **surfaces;
	batten_hydrostatics *rows;
	batten_afloat_result *results;
	const char **texts;
};

static void release(struct many *m, size_t count)
{
	for (size_t i = 0; m->surfaces && i < count; i++)
		batten_surface_destroy(m->surfaces[i]);
	free(m->surfaces);
	free(m->rows);
	free(m->results);
	free(m->texts);
}

static batten_status read_surfaces(const measure_job *job, batten_context *context, struct many *m)
{
	const size_t rows = job->path_count * job->draft_count;
	m->surfaces = calloc(job->path_count, sizeof *m->surfaces);
	m->results = calloc(job->path_count, sizeof *m->results);
	m->rows = calloc(rows, sizeof *m->rows);
	m->texts = calloc(rows * TEXTS, sizeof *m->texts);
	if (!m->surfaces || !m->results || !m->rows || !m->texts) {
		(void)fputs("batten measure: out of memory\n", stderr);
		return BATTEN_MEMORY;
	}
	for (size_t i = 0; i < job->path_count; i++) {
		const batten_status status = batten_surface_read(context, job->paths[i], &m->surfaces[i]);
		if (status != BATTEN_OK)
			return cli_failure("measure", context, status);
	}
	return BATTEN_OK;
}

static batten_status put_rows(const measure_job *job, batten_context *context, const struct many *m)
{
	static const char *const text_columns[TEXTS] = { "file", "status", "reason" };
	const char *columns[BATTEN_HYDROSTATICS_COUNT];
	for (size_t k = 0; k < BATTEN_HYDROSTATICS_COUNT; k++)
		columns[k] = batten_hydrostatics_name(k);
	for (size_t i = 0; i < job->path_count * job->draft_count; i++) {
		const batten_afloat_result *result = &m->results[i / job->draft_count];
		const bool good = result->status == BATTEN_OK;
		m->texts[i * TEXTS] = job->paths[i / job->draft_count];
		m->texts[i * TEXTS + 1] = good ? "ok" : "failed";
		m->texts[i * TEXTS + 2] = good ? NULL : result->reason;
	}
	const batten_table table = { .name = "surfaces",
		                         .quadrature = "gauss",
		                         .column_count = BATTEN_HYDROSTATICS_COUNT,
		                         .row_count = job->path_count * job->draft_count,
		                         .columns = columns,
		                         .values = (const double *)m->rows,
		                         .text_count = TEXTS,
		                         .text_columns = text_columns,
		                         .texts = m->texts };
	return measure_put_table(job, context, &table, true);
}

batten_status measure_many(const measure_job *job, batten_context *context)
{
	size_t failed = 0;
	struct many m = { .surfaces = NULL };
	batten_batch_options batch;
	batten_run run = { .strict = true };
	batten_batch_options_default(&batch);
	batch.device = job->device;
	batten_status status = read_surfaces(job, context, &m);
	if (status == BATTEN_OK) {
		status = batten_surface_hydrostatics_batch(
			context, job->path_count, (const batten_surface *const *)m.surfaces, &job->options,
			&batch, job->draft_count, job->drafts_m, m.rows, m.results, &run);
		if (status != BATTEN_OK)
			(void)cli_failure("measure", context, status);
	}
	if (status == BATTEN_OK && !job->common.quiet && run.warning[0])
		(void)fprintf(stderr, "warning: %s\n", run.warning);
	if (status == BATTEN_OK)
		status = put_rows(job, context, &m);
	for (size_t i = 0; status == BATTEN_OK && i < job->path_count; i++)
		if (m.results[i].status != BATTEN_OK) {
			failed++;
			(void)fprintf(stderr, "batten measure: %s: %s\n", job->paths[i], m.results[i].reason);
		}
	release(&m, job->path_count);
	return status == BATTEN_OK && failed > 0 ? BATTEN_INCOMPLETE : status;
}
