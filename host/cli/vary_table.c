#include "vary_table.h"

#include "json_out.h"
#include "vary_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Rows held at once. */
enum {
	PIECE = 1024,
	TEXTS = 4,
	BEFORE_MOST = 1 + VARY_COLUMNS_MOST + 1 + 2 * BATTEN_VARY_TARGETS_MOST
};

/* What a method is asked to meet, as measures. */
static const char *const targets[BATTEN_VARY_METHOD_COUNT][BATTEN_VARY_TARGETS_MOST] = {
	[BATTEN_VARY_SWING] = { "lcb_pct_lbp_fwd" },
	[BATTEN_VARY_ONE_MINUS_PRISMATIC] = { "cp", "lcb_pct_lbp_fwd" },
	[BATTEN_VARY_LACKENBY] = { "cp", "lcb_pct_lbp_fwd" },
	[BATTEN_VARY_MOOR] = { "cb", "lcb_pct_lbp_fwd", "cwp", "lcf_pct_lbp_fwd" },
	[BATTEN_VARY_THREE_BODY] = { "volume_m3", "lcb_pct_lbp_fwd", "cp" },
};

/* A piece at work: one allocation a member. */
struct piece {
	vary_row_room *rooms;
	batten_vary_options *options;
	batten_vary_result *results;
	batten_vary_outcome *outcomes;
	batten_hydrostatics *forms;
	batten_hull **hulls;
	double *values;
	const char **texts;
	char (*names)[24]; /* of rows without */
};

struct job {
	batten_context *context;
	const vary_request *request;
	const batten_hull *parent;
	vary_rows rows;
	struct piece piece;
	batten_table_file *file;
	batten_run run;
	size_t drafts, column_count, target_count, failed;
	const char *columns[BEFORE_MOST + BATTEN_HYDROSTATICS_COUNT];
	char names[VARY_COLUMNS_MOST + 2 * BATTEN_VARY_TARGETS_MOST][64];
	size_t name_count;
};

/* ------------------------------------------------------------------------------------------------
 * The table
 * --------------------------------------------------------------------------------------------- */

static void name_column(struct job *job, const char *before, const char *name)
{
	char(*copy)[64] = &job->names[job->name_count++];
	(void)snprintf(*copy, sizeof *copy, "%s_%s", before, name);
	job->columns[job->column_count++] = *copy;
}

static void name_columns(struct job *job)
{
	const char *const *asked = targets[job->request->options.method];
	job->columns[job->column_count++] = "row";
	for (size_t i = 0; i < job->rows.column_count; i++)
		if (job->rows.columns[i].kind != VARY_COLUMN_LATTICE)
			name_column(job, "given", job->rows.columns[i].name);
	job->columns[job->column_count++] = "passes";
	for (; job->target_count < BATTEN_VARY_TARGETS_MOST && asked[job->target_count];
	     job->target_count++) {
		name_column(job, "asked", asked[job->target_count]);
		name_column(job, "got", asked[job->target_count]);
	}
	for (size_t i = 0; i < BATTEN_HYDROSTATICS_COUNT; i++)
		job->columns[job->column_count++] = batten_hydrostatics_name(i);
}

/* One row of the table: variant i of the piece at a draft. */
static void fill(const struct job *job, size_t first, size_t i, size_t draft, size_t at)
{
	const struct piece *piece = &job->piece;
	const batten_vary_outcome *outcome = &piece->outcomes[i];
	double *values = piece->values + at * job->column_count;
	const char **texts = piece->texts + at * TEXTS;
	const bool good = piece->results[i].status == BATTEN_OK;
	(void)snprintf(piece->names[i], sizeof piece->names[i], "%zu", first + i + 1);
	texts[0] = job->rows.named ? job->rows.names[first + i] : piece->names[i];
	texts[1] = good ? "ok" : "failed";
	texts[2] = good ? NULL : outcome->reason;
	texts[3] = outcome->warning[0] ? outcome->warning : NULL;
	*values++ = (double)(first + i + 1);
	for (size_t c = 0; c < job->rows.column_count; c++)
		if (job->rows.columns[c].kind != VARY_COLUMN_LATTICE)
			*values++ = vary_rows_number(&job->rows, first + i, c);
	*values++ = piece->results[i].passes;
	for (size_t t = 0; t < job->target_count; t++) {
		*values++ = t < outcome->target_count ? outcome->targets[t].asked : NAN;
		*values++ = t < outcome->target_count ? outcome->targets[t].got : NAN;
	}
	memcpy(values, &piece->forms[i * job->drafts + draft], sizeof *piece->forms);
}

static batten_status write_piece(struct job *job, size_t first, size_t count)
{
	static const char *const text_columns[TEXTS] = { "id", "status", "reason", "warning" };
	size_t at = 0;
	for (size_t i = 0; i < count; i++) {
		const bool good = job->piece.results[i].status == BATTEN_OK;
		job->failed += !good;
		for (size_t d = 0; d < (good ? job->drafts : 1); d++)
			fill(job, first, i, d, at++);
	}
	const batten_table table = { .name = batten_hull_name(job->parent),
		                         .quadrature = "spline",
		                         .column_count = job->column_count,
		                         .row_count = at,
		                         .columns = job->columns,
		                         .values = job->piece.values,
		                         .text_count = TEXTS,
		                         .text_columns = text_columns,
		                         .texts = job->piece.texts };
	return job->file ? batten_table_add(job->file, &table)
	                 : batten_table_open(job->context, &table, job->request->out, &job->file);
}

/* ------------------------------------------------------------------------------------------------
 * Pieces
 * --------------------------------------------------------------------------------------------- */

static bool make_room(struct job *job)
{
	struct piece *piece = &job->piece;
	const size_t count = job->rows.count < PIECE ? job->rows.count : PIECE;
	const size_t lines = count * job->drafts;
	piece->rooms = calloc(count, sizeof *piece->rooms);
	piece->options = calloc(count, sizeof *piece->options);
	piece->results = calloc(count, sizeof *piece->results);
	piece->outcomes = calloc(count, sizeof *piece->outcomes);
	piece->forms = calloc(lines, sizeof *piece->forms);
	piece->hulls = calloc(count, sizeof *piece->hulls);
	piece->values = calloc(lines, job->column_count * sizeof *piece->values);
	piece->texts = calloc(lines, TEXTS * sizeof *piece->texts);
	piece->names = calloc(count, sizeof *piece->names);
	return piece->rooms && piece->options && piece->results && piece->outcomes && piece->forms &&
	       piece->hulls && piece->values && piece->texts && piece->names;
}

static void release_room(struct piece *piece)
{
	free(piece->rooms);
	free(piece->options);
	free(piece->results);
	free(piece->outcomes);
	free(piece->forms);
	free(piece->hulls);
	free(piece->values);
	free(piece->texts);
	free(piece->names);
}

static batten_status write_hulls(const struct job *job, size_t first, size_t count)
{
	batten_status status = BATTEN_OK;
	/* a folder that cannot be made is told of by the first file */
	(void)mkdir(job->request->hulls, 0777);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		char path[4096];
		if (!job->piece.hulls[i])
			continue;
		(void)snprintf(path, sizeof path, "%s/%zu.csv", job->request->hulls, first + i + 1);
		status = batten_hull_write(job->context, job->piece.hulls[i], path);
	}
	return status;
}

static batten_status run_piece(struct job *job, size_t first, size_t count)
{
	struct piece *piece = &job->piece;
	const vary_request *request = job->request;
	const batten_variants variants = {
		.count = count,
		.draft_count = job->drafts,
		.drafts_m = request->draft_count > 0 ? request->drafts_m : NULL,
		.results = piece->results,
		.out = piece->forms,
		.row_options = piece->options,
		.outcomes = piece->outcomes,
		.hulls = request->hulls ? piece->hulls : NULL,
	};
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = request->device;
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		status = vary_rows_bind(job->context, request, &job->rows, first + i, &piece->rooms[i],
		                        &piece->options[i]);
	if (status == BATTEN_OK)
		status = batten_hull_vary_measure(job->context, job->parent, NULL, NULL, &batch, &variants,
		                                  &job->run);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE)
		status = write_piece(job, first, count);
	if (status == BATTEN_OK && request->hulls)
		status = write_hulls(job, first, count);
	for (size_t i = 0; i < count; i++) {
		batten_lattice_destroy(piece->rooms[i].lattice);
		piece->rooms[i].lattice = NULL;
		batten_hull_destroy(piece->hulls[i]);
		piece->hulls[i] = NULL;
	}
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * The whole
 * --------------------------------------------------------------------------------------------- */

static batten_status tell(const struct job *job)
{
	const size_t rows = job->rows.count;
	const char *method = batten_vary_method_name((size_t)job->request->options.method);
	if (job->request->common.json)
		return cli_json_print("vary",
		                      json_pack("{s:s, s:s, s:s, s:I, s:I, s:s, s:b, s:s}", "name",
		                                batten_hull_name(job->parent), "method", method, "table",
		                                job->request->out, "rows", (json_int_t)rows, "failed",
		                                (json_int_t)job->failed, "device", job->run.device,
		                                "strict", job->run.strict, "warning", job->run.warning));
	(void)printf("%s, %s: %zu variants, %zu failed; %s\n", batten_hull_name(job->parent), method,
	             rows, job->failed, job->request->out);
	return BATTEN_OK;
}

static batten_status make(struct job *job)
{
	const size_t rows = job->rows.count;
	batten_status status = BATTEN_OK;
	name_columns(job);
	if (!make_room(job)) {
		(void)fprintf(stderr, "batten vary: %s\n", batten_status_text(BATTEN_MEMORY));
		return BATTEN_MEMORY;
	}
	for (size_t first = 0; first < rows && status == BATTEN_OK; first += PIECE)
		status = run_piece(job, first, rows - first < PIECE ? rows - first : PIECE);
	if (status == BATTEN_OK) {
		status = batten_table_commit(job->file);
		job->file = NULL;
	}
	if (status != BATTEN_OK)
		return cli_failure("vary", job->context, status);
	if (job->failed > 0 && !job->request->common.quiet)
		(void)fprintf(stderr, "warning: %zu of %zu rows failed, the table says why\n", job->failed,
		              rows);
	status = tell(job);
	return status == BATTEN_OK && job->failed > 0 ? BATTEN_INCOMPLETE : status;
}

batten_status vary_table_make(batten_context *context, const vary_request *request,
                              const batten_hull *parent)
{
	struct job job = { .context = context,
		               .request = request,
		               .parent = parent,
		               .drafts = request->draft_count > 0 ? request->draft_count : 1 };
	batten_status status = vary_rows_read(request, &job.rows);
	if (status != BATTEN_OK)
		return status;
	status = make(&job);
	batten_table_abandon(job.file);
	release_room(&job.piece);
	vary_rows_release(&job.rows);
	return status;
}
