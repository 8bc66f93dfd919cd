/* batten curve: representations of one line, compared. */
#include "curve_request.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const cli_command command = {
	.name = "curve",
	.usage = "LINE.csv [OPTION ...]",
	.summary = "represent one line, measure how fair it is, compare representations",
	.example =
		"  batten curve data/lines/npl_waterline.csv --as spline:natural,bspline:4 \\\n"
		"      --out waterline.svg\n"
		"  batten curve data/lines/quadratic.csv --parameter x --as lagrange --out line.json\n"
		"  batten curve data/lines/quadratic.csv --method search --w1 0.5 --w2 0.5\n"
		"  batten curve data/lines/npl_waterline.csv --method forward-fit --vertices 6 \\\n"
		"      --faired faired.csv --out faired.svg\n",
	.notes =
		"LINE.csv: columns x,y or x,y,z. --as takes, separated by commas:\n"
		"  monomial, lagrange, newton   one polynomial through up to 64 points\n"
		"  hermite                      cubics with the slopes of three-point parabolas\n"
		"  least-squares:DEGREE         one polynomial near the points\n"
		"  spline:END, spline:FIRST/LAST   cubic spline; an end is natural, not-a-knot, clamped,\n"
		"                               clamped=SLOPE (or X:Y, X:Y:Z), curvature=K (in 1/m, + left)\n"
		"  bezier, bspline:ORDER        the points as polygon\n"
		"  bspline-fit:ORDER:POLES      least squares, the ends held\n"
		"Units and signs stand in the names; '-' (null in JSON): not defined for this curve.\n",
};

static void release(size_t count, curve_answer *answers)
{
	for (size_t k = 0; k < count; k++) {
		batten_curve_destroy(answers[k].curve);
		free(answers[k].data);
	}
}

static batten_status answer_one(batten_context *context, const batten_points *points,
                                const curve_choice *choice, curve_answer *out)
{
	batten_status status = batten_curve_create(context, points, &choice->options, &out->curve);
	if (status == BATTEN_OK)
		status = batten_curve_measure(context, out->curve, &out->measures);
	if (status != BATTEN_OK) {
		(void)fprintf(stderr, "batten curve: --as %s: %s\n", choice->label,
		              batten_context_error(context));
		return status;
	}
	out->data = calloc(batten_points_count(points), sizeof *out->data);
	if (!out->data) {
		(void)fputs("batten curve: out of memory\n", stderr);
		return BATTEN_MEMORY;
	}
	batten_curve_data(out->curve, out->data);
	return BATTEN_OK;
}

static bool ends_with(const char *text, const char *end)
{
	size_t length = strlen(text);
	return length > strlen(end) && strcmp(text + length - strlen(end), end) == 0;
}

static batten_status write_out(const curve_request *request, batten_context *context,
                               const batten_points *points, const curve_answer *answers,
                               const curve_fairing *fairing)
{
	if (ends_with(request->out, ".json"))
		return curve_save_json(request, points, answers, fairing);
	const batten_curve *curves[CURVES_MOST] = { NULL };
	for (size_t k = 0; k < request->count; k++)
		curves[k] = answers[k].curve;
	batten_status status = BATTEN_OK;
	if (ends_with(request->out, ".csv"))
		status = batten_curve_write(context, curves[0], request->points, request->out);
	else
		status = batten_picture_curves(context, points, request->count, curves, request->out);
	return status == BATTEN_OK ? status : cli_failure("curve", context, status);
}

static batten_status answer(const curve_request *request, batten_context *context)
{
	batten_points *points = NULL;
	curve_answer answers[CURVES_MOST] = { 0 };
	batten_status status = batten_points_read(context, request->path, &points);
	if (status != BATTEN_OK)
		return cli_failure("curve", context, status);
	curve_fairing fairing;
	const batten_status faired = curve_fair(request, context, &points, &fairing);
	status = faired == BATTEN_INCOMPLETE ? BATTEN_OK : faired;
	for (size_t k = 0; k < request->count && status == BATTEN_OK; k++)
		status = answer_one(context, points, &request->choices[k], &answers[k]);
	if (status == BATTEN_OK && request->out)
		status = write_out(request, context, points, answers, &fairing);
	if (status == BATTEN_OK && request->common.json)
		status = curve_print_json(request, points, answers, &fairing);
	else if (status == BATTEN_OK) {
		curve_fair_print(request, &fairing);
		curve_print_table(request, points, answers);
	}
	release(request->count, answers);
	batten_points_destroy(points);
	return status == BATTEN_OK ? faired : status;
}

static batten_status check_out(const curve_request *request)
{
	if (!request->out)
		return BATTEN_OK;
	if (ends_with(request->out, ".json"))
		return BATTEN_OK;
	if (!ends_with(request->out, ".csv") && !ends_with(request->out, ".svg"))
		return cli_usage("curve",
		                 "--out: found '%s', expected a name that ends in .csv, .svg or .json",
		                 request->out);
	if (ends_with(request->out, ".csv") && request->count > 1)
		return cli_usage("curve", "--out: a .csv holds one representation, found %zu in --as",
		                 request->count);
	if (request->count > DRAWN_MOST)
		return cli_usage("curve", "--out: a picture holds %d representations, found %zu in --as",
		                 (int)DRAWN_MOST, request->count);
	return BATTEN_OK;
}

batten_status cli_curve(int argc, char **argv)
{
	curve_request request = { .as = "spline:natural",
		                      .parameter = "chord",
		                      .points = 201,
		                      .fair_order = UINT_MAX,
		                      .iterations = UINT_MAX,
		                      .vertices = UINT_MAX,
		                      .w1 = NAN,
		                      .w2 = NAN };
	const cli_option options[] = {
		{ "as", CLI_TEXT, &request.as, "LIST", "representations (spline:natural)" },
		{ "parameter", CLI_TEXT, &request.parameter, "P",
		  "of the points: chord (default), uniform, or x for y(x)" },
		{ "order", CLI_COUNT, &request.order, "K", "degree + 1 where --as names none (4)" },
		{ "method", CLI_TEXT, &request.method, "NAME",
		  "fair the line first: search, forward-approximation, forward-fit, inverse" },
		{ "fair-order", CLI_COUNT, &request.fair_order, "K", "order of --method, 2 to 8 (3)" },
		{ "iterations", CLI_COUNT, &request.iterations, "N", "iterations of --method (1)" },
		{ "vertices", CLI_COUNT, &request.vertices, "N",
		  "forward-fit: vertices (8); inverse: of the second derivatives (their points)" },
		{ "w1", CLI_NUMBER, &request.w1, "X", "search: weight of fn, sum of squared d2 (1/m2)" },
		{ "w2", CLI_NUMBER, &request.w2, "Y", "search: weight of the sum of squared changes (m2)" },
		{ "faired", CLI_TEXT, &request.faired, "FILE.csv", "writes the faired points, in metres" },
		{ "points", CLI_COUNT, &request.points, "N", "points of a .csv (201)" },
		{ "out", CLI_TEXT, &request.out, "FILE",
		  "sampled points .csv, curvature plot .svg, all of --json .json" },
		{ 0 },
	};
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&command, argc, argv, options, &request.common, &request.path,
	                                 1, &count, &done);
	if (status != BATTEN_OK || done)
		return status;
	if (count != 1)
		return cli_usage("curve", "a line file was expected");
	status = curve_read_request(&request);
	if (status == BATTEN_OK)
		status = check_out(&request);
	batten_context *context = NULL;
	if (status == BATTEN_OK)
		status = cli_context_create("curve", &request.common, &context);
	if (status != BATTEN_OK)
		return status;
	status = answer(&request, context);
	batten_context_destroy(context);
	return status;
}
