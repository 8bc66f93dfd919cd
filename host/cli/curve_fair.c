/* batten curve --method: the line is faired before it is represented. */
#include "curve_request.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static batten_status read_options(const curve_request *request, batten_line_options *o)
{
	batten_line_options_default(o);
	size_t method = 0;
	while (method < BATTEN_FAIR_METHOD_COUNT &&
	       strcmp(request->method, batten_fair_method_text(method)) != 0)
		method++;
	if (method == BATTEN_FAIR_METHOD_COUNT || method == BATTEN_METHOD_SMOOTH)
		return cli_usage("curve",
		                 "--method: found '%s', expected search, forward-approximation, "
		                 "forward-fit or inverse",
		                 request->method);
	o->method = (batten_fair_method)method;
	if (method == BATTEN_METHOD_SEARCH && (isnan(request->w1) || isnan(request->w2)))
		return cli_usage("curve", "--method search needs --w1 and --w2");
	if (method != BATTEN_METHOD_SEARCH && !(isnan(request->w1) && isnan(request->w2)))
		return cli_usage("curve", "--w1 and --w2 are about --method search");
	if (method == BATTEN_METHOD_SEARCH) {
		o->w1 = request->w1;
		o->w2 = request->w2;
	}
	if (request->fair_order != UINT_MAX)
		o->pass.order = request->fair_order;
	if (request->iterations != UINT_MAX)
		o->iterations = request->iterations;
	if (request->vertices != UINT_MAX)
		o->pass.vertices = request->vertices;
	return BATTEN_OK;
}

/* The faired points, in metres, as a line file. */
static batten_status write_points(batten_context *context, const char *path,
                                  const batten_points *points)
{
	static const char *const columns[] = { "x", "y" };
	const batten_table table = { .name = batten_points_name(points),
		                         .column_count = 2,
		                         .row_count = batten_points_count(points),
		                         .columns = columns,
		                         .values = batten_points_m(points) };
	return batten_table_write(context, &table, path);
}

static batten_status fair(const curve_request *request, batten_context *context,
                          const batten_line_options *options, batten_points **points,
                          curve_fairing *out)
{
	const size_t count = batten_points_count(*points);
	double *y = calloc(count, 3 * sizeof *y);
	if (!y) {
		(void)fputs("batten curve: out of memory\n", stderr);
		return BATTEN_MEMORY;
	}
	double *both = y + count;
	const batten_status faired = batten_line_fair(context, *points, options, y, &out->facts);
	batten_status status = faired == BATTEN_INCOMPLETE ? BATTEN_OK : faired;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		both[2 * i] = batten_points_m(*points)[2 * i];
		both[2 * i + 1] = y[i];
	}
	batten_points *made = NULL;
	if (status == BATTEN_OK)
		status = batten_points_create(context, batten_points_name(*points), 2, count, both, &made);
	if (status == BATTEN_OK && request->faired)
		status = write_points(context, request->faired, made);
	free(y);
	if (status != BATTEN_OK) {
		batten_points_destroy(made);
		return cli_failure("curve", context, status);
	}
	out->done = true;
	batten_points_destroy(*points);
	*points = made;
	return faired;
}

batten_status curve_fair(const curve_request *request, batten_context *context,
                         batten_points **points, curve_fairing *out)
{
	*out = (curve_fairing){ 0 };
	if (!request->method) {
		if (request->faired || request->iterations != UINT_MAX || request->vertices != UINT_MAX ||
		    request->fair_order != UINT_MAX || !isnan(request->w1) || !isnan(request->w2))
			return cli_usage("curve", "--faired, --iterations, --vertices, --fair-order, --w1 and "
			                          "--w2 need --method");
		return BATTEN_OK;
	}
	batten_line_options options;
	const batten_status status = read_options(request, &options);
	return status == BATTEN_OK ? fair(request, context, &options, points, out) : status;
}

void curve_fair_print(const curve_request *request, const curve_fairing *fairing)
{
	const batten_line_facts *f = &fairing->facts;
	if (!fairing->done)
		return;
	(void)printf("faired by %s: fn_per_m2 %.6g to %.6g, change_max_m %.6g, closeness_m2 %.6g",
	             request->method, f->fn_before_per_m2, f->fn_after_per_m2, f->change_max_m,
	             f->closeness_m2);
	if (!isnan(f->objective))
		(void)printf(", objective %.8g", f->objective);
	(void)printf("\nwhat follows is of the faired line\n\n");
}
