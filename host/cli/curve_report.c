/* What batten curve prints: a table, or one JSON object, which --out FILE.json keeps. */
#include "curve_request.h"

#include "json_out.h"

#include <math.h>
#include <string.h>

static const char *const parameter_words[] = { "chord", "uniform", "x" };

/* ------------------------------------------------------------------------------------------------
 * Table
 * --------------------------------------------------------------------------------------------- */

enum { NAME_WIDTH = 26, NUMBER_WIDTH = 13, DATA_MOST = 40 };

static void print_number(double value)
{
	if (value == value)
		(void)printf(" %*.6g", NUMBER_WIDTH, value);
	else
		(void)printf(" %*s", NUMBER_WIDTH, "-");
}

/* Labels longer than a column are numbered and told above the table. */
static void print_labels(const curve_request *request, const char *first)
{
	for (size_t k = 0; k < request->count; k++)
		(void)printf("  %zu  %s\n", k + 1, request->choices[k].label);
	(void)printf("\n%-*s", NAME_WIDTH, first);
	for (size_t k = 0; k < request->count; k++)
		(void)printf(" %*zu", NUMBER_WIDTH, k + 1);
	(void)printf("\n");
}

void curve_print_table(const curve_request *request, const batten_points *points,
                       const curve_answer *answers)
{
	const size_t dimension = batten_points_dimension(points);
	const size_t count = batten_points_count(points);
	const char *name = batten_points_name(points);
	(void)printf("%s: %zu points, %s; metres (file: %s); parameter %s\n\n",
	             *name ? name : request->path, count, dimension == 3 ? "x,y,z" : "x,y",
	             batten_points_unit(points), parameter_words[request->by]);
	print_labels(request, "");
	for (size_t i = 0; i < BATTEN_CURVE_MEASURE_COUNT; i++) {
		(void)printf("%-*s", NAME_WIDTH, batten_curve_measure_name(i));
		for (size_t k = 0; k < request->count; k++)
			print_number(((const double *)&answers[k].measures)[i]);
		(void)printf("  %s\n", batten_curve_measure_text(i));
	}
	if (count > DATA_MOST)
		return;
	(void)printf("\ncurvature_per_m at the points\n");
	for (size_t i = 0; i < count; i++) {
		char place[64];
		const double *m = batten_points_m(points) + i * dimension;
		(void)snprintf(place, sizeof place, "%.5g, %.5g", m[0], m[1]);
		(void)printf("%-*s", NAME_WIDTH, place);
		for (size_t k = 0; k < request->count; k++)
			print_number(answers[k].data[i].at.curvature_per_m);
		(void)printf("\n");
	}
}

/* ------------------------------------------------------------------------------------------------
 * JSON
 * --------------------------------------------------------------------------------------------- */

static json_t *vector(size_t dimension, const double *values)
{
	json_t *array = json_array();
	for (size_t c = 0; c < dimension; c++)
		(void)json_array_append_new(array, cli_json_number(values[c]));
	return array;
}

static json_t *datum(size_t dimension, const curve_answer *answer, size_t i)
{
	const batten_curve_point *at = &answer->data[i].at;
	json_t *object = json_object();
	(void)json_object_set_new(object, "t", cli_json_number(at->t));
	(void)json_object_set_new(object, "point_m", vector(dimension, at->derivative[0]));
	(void)json_object_set_new(object, "deviation_m", cli_json_number(answer->data[i].deviation_m));
	(void)json_object_set_new(object, "curvature_per_m", cli_json_number(at->curvature_per_m));
	(void)json_object_set_new(object, "curvature_rate_per_m2",
	                          cli_json_number(at->curvature_rate_per_m2));
	(void)json_object_set_new(object, "tangent", vector(dimension, at->tangent));
	(void)json_object_set_new(object, "normal", vector(dimension, at->normal));
	if (dimension == 3) {
		(void)json_object_set_new(object, "binormal", vector(dimension, at->binormal));
		(void)json_object_set_new(object, "torsion_per_m", cli_json_number(at->torsion_per_m));
	}
	return object;
}

static json_t *representation(const batten_points *points, const curve_answer *answer)
{
	json_t *object = json_pack("{s:s}", "as", batten_curve_label(answer->curve));
	json_t *data = json_array();
	for (size_t i = 0; i < BATTEN_CURVE_MEASURE_COUNT; i++)
		(void)json_object_set_new(object, batten_curve_measure_name(i),
		                          cli_json_number(((const double *)&answer->measures)[i]));
	for (size_t i = 0; i < batten_points_count(points); i++)
		(void)json_array_append_new(data, datum(batten_points_dimension(points), answer, i));
	(void)json_object_set_new(object, "at_points", data);
	return object;
}

static json_t *faired(const curve_request *request, const curve_fairing *fairing)
{
	if (!fairing->done)
		return json_null();
	const batten_line_facts *f = &fairing->facts;
	json_t *object = json_pack("{s:s}", "method", request->method);
	(void)json_object_set_new(object, "fn_before_per_m2", cli_json_number(f->fn_before_per_m2));
	(void)json_object_set_new(object, "fn_after_per_m2", cli_json_number(f->fn_after_per_m2));
	(void)json_object_set_new(object, "change_max_m", cli_json_number(f->change_max_m));
	(void)json_object_set_new(object, "closeness_m2", cli_json_number(f->closeness_m2));
	(void)json_object_set_new(object, "objective", cli_json_number(f->objective));
	return object;
}

/* All of it; NULL where memory runs out. */
static json_t *report(const curve_request *request, const batten_points *points,
                      const curve_answer *answers, const curve_fairing *fairing)
{
	json_t *object = json_pack(
		"{s:s, s:s, s:s, s:s, s:i, s:i}", "batten", batten_version(), "name",
		batten_points_name(points), "unit_of_file", batten_points_unit(points), "parameter",
		parameter_words[request->by], "dimension", (int)batten_points_dimension(points),
		"point_count", (int)batten_points_count(points));
	json_t *list = json_array();
	for (size_t k = 0; k < request->count; k++)
		(void)json_array_append_new(list, representation(points, &answers[k]));
	(void)json_object_set_new(object, "faired", faired(request, fairing));
	(void)json_object_set_new(object, "representations", list);
	return object;
}

batten_status curve_print_json(const curve_request *request, const batten_points *points,
                               const curve_answer *answers, const curve_fairing *fairing)
{
	return cli_json_print("curve", report(request, points, answers, fairing));
}

batten_status curve_save_json(const curve_request *request, const batten_points *points,
                              const curve_answer *answers, const curve_fairing *fairing)
{
	return cli_json_save("curve", report(request, points, answers, fairing), request->out);
}
