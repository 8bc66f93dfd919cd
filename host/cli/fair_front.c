/* batten fair --front: the fairness-closeness front of a hull. */
#include "fair_job.h"

#include "json_out.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { COLUMNS = 11 };
static const char *const columns[COLUMNS] = {
	"ratio_w2_w1", "fairness",   "closeness_m4", "cn_pct",    "cn_max_m",  "cn_rms_m",
	"objective",   "iterations", "gap_estimate", "converged", "dominated",
};

/* The columns, and one for each measure that is kept. */
static size_t name_columns(const fair_job *job, const char *names[COLUMNS + BATTEN_KEEP_LIMIT])
{
	memcpy(names, columns, sizeof columns);
	for (size_t k = 0; k < job->options.keep_count; k++)
		names[COLUMNS + k] = batten_hydrostatics_name(job->options.keep[k].quantity);
	return COLUMNS + job->options.keep_count;
}

static void put_row(const batten_front_point *point, size_t kept, double *row)
{
	const double values[COLUMNS] = {
		point->ratio,
		point->fairness,
		point->closeness.closeness_m4,
		point->closeness.cn_pct,
		point->closeness.cn_max_m,
		point->closeness.cn_rms_m,
		point->result.objective_end,
		(double)point->result.iterations,
		point->gap_estimate,
		point->result.end == BATTEN_SEARCH_LIMIT ? 0.0 : 1.0,
		point->dominated ? 1.0 : 0.0,
	};
	memcpy(row, values, sizeof values);
	for (size_t k = 0; k < kept; k++)
		row[COLUMNS + k] = point->kept[k].value;
}

/* LOW:HIGH:COUNT. */
static batten_status read_front(const char *text, double *low, double *high, size_t *count)
{
	char *end = NULL;
	char *last = NULL;
	*low = strtod(text, &end);
	if (end != text && *end == ':')
		*high = strtod(end + 1, &last);
	if (last && last != end + 1 && *last == ':') {
		const char *digits = last + 1;
		errno = 0;
		const unsigned long number = strtoul(digits, &end, 10);
		if (*digits >= '0' && *digits <= '9' && *end == '\0' && errno == 0 && number >= 2 &&
		    number <= 4096 && *low > 0.0 && *high > *low) {
			*count = number;
			return BATTEN_OK;
		}
	}
	return cli_usage("fair",
	                 "--front: found '%s', expected LOW:HIGH:COUNT, as 1:1e6:25: 0 < LOW < HIGH, "
	                 "COUNT from 2 to 4096",
	                 text);
}

enum { NAME_SIZE = 32 };

/* The surface of each row, counted from 1, and none of an older front, which had more. */
static batten_status write_surfaces(const fair_job *job, size_t count,
                                    const batten_front_point *points, const char *folder)
{
	char path[PATH_MAX + NAME_SIZE];
	const size_t made = points[0].surface ? count : 0;
	for (size_t row = 1;; row++) {
		(void)snprintf(path, sizeof path, "%s/surface-%04zu.json", folder, row);
		if (row > made && unlink(path) != 0)
			return BATTEN_OK;
		if (row > made)
			continue;
		const batten_status status = batten_surface_write(job->context, points[row - 1].surface,
		                                                  path);
		if (status != BATTEN_OK)
			return status;
	}
}

static batten_status write_files(const fair_job *job, const batten_table *table,
                                 const batten_front_point *points, const char *folder)
{
	static const char *const names[] = { "front.csv", "front.json", "front.svg" };
	bool made = false;
	if (strlen(folder) + NAME_SIZE >= PATH_MAX)
		return cli_usage("fair", "--out: found '%s', expected a shorter path", folder);
	batten_status status = fair_folder_make(folder, &made);
	if (status != BATTEN_OK)
		return status;
	for (size_t f = 0; f < sizeof names / sizeof names[0] && status == BATTEN_OK; f++) {
		char path[PATH_MAX + NAME_SIZE];
		(void)snprintf(path, sizeof path, "%s/%s", folder, names[f]);
		status = f < 2 ? batten_table_write(job->context, table, path)
		               : batten_picture_front(job->context, table->name, table->row_count, points,
		                                      path);
	}
	if (status == BATTEN_OK)
		status = write_surfaces(job, table->row_count, points, folder);
	return status == BATTEN_OK ? status : cli_failure("fair", job->context, status);
}

static batten_status tell_json(const batten_table *table)
{
	json_t *rows = json_array();
	for (size_t r = 0; r < table->row_count; r++) {
		json_t *row = json_object();
		for (size_t c = 0; c < table->column_count; c++)
			(void)json_object_set_new(row, table->columns[c],
			                          cli_json_number(table->values[r * table->column_count + c]));
		(void)json_array_append_new(rows, row);
	}
	json_t *object = json_object();
	(void)json_object_set_new(object, "name", json_string(table->name));
	(void)json_object_set_new(object, "points", rows);
	return cli_json_write(object, stdout);
}

static batten_status tell(const fair_job *job, const batten_table *table, const char *folder)
{
	if (job->request->common.json)
		return tell_json(table);
	if (job->request->common.quiet)
		return BATTEN_OK;
	(void)printf("%14s %14s %14s %10s\n", "w2/w1", "fairness", "rms change mm", "cn %");
	for (size_t r = 0; r < table->row_count; r++) {
		const double *row = table->values + r * table->column_count;
		(void)printf("%14.6g %14.6g %14.6g %10.4g%s%s\n", row[0], row[1], 1000.0 * row[5], row[3],
		             row[9] == 0.0 ? "  not converged" : "", row[10] == 0.0 ? "" : "  dominated");
	}
	(void)printf("\nwritten to %s: front.csv, front.json, front.svg", folder);
	if (job->options.variables == BATTEN_VARIABLES_NET)
		(void)printf(", surface-0001.json to surface-%04zu.json", table->row_count);
	(void)printf("\n");
	return BATTEN_OK;
}

/* The front as a table, in files and told. */
static batten_status put_out(const fair_job *job, size_t count, const batten_front_point *points,
                             const char *folder)
{
	const bool by_net = job->options.variables == BATTEN_VARIABLES_NET;
	const char *names[COLUMNS + BATTEN_KEEP_LIMIT];
	const size_t width = name_columns(job, names);
	double *values = calloc(count, width * sizeof *values);
	if (!values) {
		(void)fprintf(stderr, "batten fair: %s\n", batten_status_text(BATTEN_MEMORY));
		return BATTEN_MEMORY;
	}
	for (size_t p = 0; p < count; p++)
		put_row(&points[p], job->options.keep_count, values + p * width);
	const batten_table table = {
		.name = batten_hull_name(job->hull),
		.quadrature = by_net ? "gauss, a knot span: points of the order, as searched"
		                     : "differences over 3 x 3 offsets",
		.column_count = width,
		.row_count = count,
		.columns = names,
		.values = values
	};
	batten_status status = write_files(job, &table, points, folder);
	if (status == BATTEN_OK)
		status = tell(job, &table, folder);
	free(values);
	return status;
}

batten_status fair_front(fair_job *job, const char *folder)
{
	double low = 0.0;
	double high = 0.0;
	size_t count = 1;
	if (job->options.weights_given)
		return cli_usage("fair", "--front sweeps w2/w1: no --w1 and --w2 are expected with it");
	batten_status status = read_front(job->request->front, &low, &high, &count);
	if (status != BATTEN_OK)
		return status;
	batten_front_point *points = calloc(count, sizeof *points);
	if (!points) {
		(void)fprintf(stderr, "batten fair: %s\n", batten_status_text(BATTEN_MEMORY));
		return BATTEN_MEMORY;
	}
	batten_run run;
	memset(&run, 0, sizeof run);
	const batten_status swept = batten_hull_front(job->context, job->hull, &job->options, low, high,
	                                              count, points, &run);
	if (run.warning[0])
		fair_warn(job, "%s", run.warning);
	if (swept == BATTEN_OK || swept == BATTEN_INCOMPLETE)
		status = put_out(job, count, points, folder);
	else
		status = cli_failure("fair", job->context, swept);
	for (size_t p = 0; p < count; p++)
		batten_surface_destroy(points[p].surface);
	free(points);
	return status == BATTEN_OK ? swept : status;
}
