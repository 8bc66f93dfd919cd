/* batten convert: surfaces from one file format to another. */
#include "cli.h"

#include "json_out.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const cli_command command = {
	.name = "convert",
	.usage = "IN OUT [--surface NAME|N] [--turn AXIS:DEGREES] [OPTION ...]",
	.summary = "takes the B-spline surfaces of a file into another format",
	.example = "  batten surface data/hulls/npl_parent.csv --net 13x13 --out npl.json\n"
			   "  batten convert npl.json npl.step\n"
			   "  batten convert npl.step npl.igs --json\n"
			   "  batten convert y_up.igs hull.json --turn x:90\n",
	.notes =
		"The endings choose the formats: .json (data/schema/surface.schema.json, one surface), .igs\n"
		"or .iges (IGES, entity 128), .stp or .step (STEP). Any unit is read, metres are written;\n"
		"the axes are taken as they are: ap-fwd is x forward from the aft perpendicular, y to port,\n"
		"z up. --turn brings others there: x:90 what has y up, z:180 what has x aft. Without it poles,\n"
		"knots and weights keep every digit. Trimmed surfaces and whatever is no\n"
		"B-spline surface are left out with a warning. Offsets become a surface by batten surface.\n",
};

struct request {
	cli_common common;
	const char *in, *out, *surface, *turn;
	double matrix[9]; /* of turn */
};

bool cli_is_surface_file(const char *path)
{
	static const char *const endings[] = { ".json", ".igs", ".iges", ".stp", ".step" };
	const char *slash = strrchr(path, '/');
	const char *name = slash ? slash + 1 : path;
	const char *dot = strrchr(name, '.');
	for (size_t i = 0; dot && dot > name && i < sizeof endings / sizeof endings[0]; i++)
		if (strcasecmp(dot, endings[i]) == 0)
			return true;
	return false;
}

/* ---- what is said ---- */

static void print_table(const struct request *request, const batten_surfaces *list, size_t count,
                        const batten_surface *const *surfaces)
{
	(void)printf("%s -> %s: %zu of %zu surfaces; metres, frame ap-fwd\n\n", request->in,
	             request->out, count, batten_surfaces_count(list));
	for (size_t i = 0; i < count; i++) {
		const batten_surface_net net = batten_surface_describe(surfaces[i]);
		(void)printf("%3zu  %zu x %zu poles of order %zu x %zu%s  %s\n", i + 1, net.count_u,
		             net.count_v, net.order_u, net.order_v, net.weights ? ", rational" : "",
		             net.name);
	}
	if (batten_surfaces_warning_count(list) > 0)
		(void)printf("\n%zu warnings\n", batten_surfaces_warning_count(list));
}

static batten_status print_json(const struct request *request, const batten_surfaces *list,
                                size_t count, const batten_surface *const *surfaces)
{
	json_t *array = json_array();
	json_t *warnings = json_array();
	for (size_t i = 0; array && i < count; i++) {
		const batten_surface_net net = batten_surface_describe(surfaces[i]);
		(void)json_array_append_new(
			array, json_pack("{s:s, s:I, s:I, s:I, s:I, s:b}", "name", net.name, "order_u",
		                     (json_int_t)net.order_u, "order_v", (json_int_t)net.order_v, "count_u",
		                     (json_int_t)net.count_u, "count_v", (json_int_t)net.count_v,
		                     "rational", net.weights != NULL));
	}
	for (size_t i = 0; warnings && i < batten_surfaces_warning_count(list); i++)
		(void)json_array_append_new(warnings, json_string(batten_surfaces_warning(list, i)));
	json_t *object = json_pack(
		"{s:s, s:s, s:s, s:s, s:I, s:I, s:o, s:o}", "in", request->in, "out", request->out, "unit",
		"m", "frame", "ap-fwd", "count", (json_int_t)count, "count_in",
		(json_int_t)batten_surfaces_count(list), "surfaces", array, "warnings", warnings);
	return cli_json_print("convert", object);
}

/* ---- what is done ---- */

/* The surface that --surface means: by name, or by number from 1. NULL: none, or several. */
static const batten_surface *find_surface(const batten_surfaces *list, const char *wanted)
{
	const batten_surface *found = NULL;
	char *end = NULL;
	for (size_t i = 0; i < batten_surfaces_count(list); i++) {
		const batten_surface *surface = batten_surfaces_at(list, i);
		if (strcmp(batten_surface_describe(surface).name, wanted) != 0)
			continue;
		if (found)
			return NULL;
		found = surface;
	}
	if (found || wanted[0] < '0' || wanted[0] > '9')
		return found;
	const unsigned long number = strtoul(wanted, &end, 10);
	return *end == '\0' && number > 0 ? batten_surfaces_at(list, number - 1) : NULL;
}

static batten_status write_all(const struct request *request, batten_context *context,
                               const batten_surfaces *list, size_t count,
                               const batten_surface *const *surfaces)
{
	const char *dot = strrchr(request->out, '.');
	if (count > 1 && dot && strcasecmp(dot, ".json") == 0)
		return cli_usage("convert",
		                 "%s holds %zu surfaces, a .json file one: choose it by --surface NAME|N",
		                 request->in, count);
	const batten_status status = batten_surfaces_write(context, count, surfaces, request->out);
	if (status != BATTEN_OK)
		return cli_failure("convert", context, status);
	if (request->common.json)
		return print_json(request, list, count, surfaces);
	print_table(request, list, count, surfaces);
	return BATTEN_OK;
}

/* Copies that are turned, in the place of the surfaces; the caller destroys what there is in turned. */
static batten_status turn_all(const struct request *request, batten_context *context, size_t count,
                              const batten_surface **surfaces, batten_surface **turned)
{
	const double nowhere[3] = { 0.0, 0.0, 0.0 };
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		status = batten_surface_clone(context, surfaces[i], &turned[i]);
		if (status == BATTEN_OK)
			status = batten_surface_map(turned[i], request->matrix, nowhere);
		surfaces[i] = turned[i];
	}
	return status == BATTEN_OK ? status : cli_failure("convert", context, status);
}

static batten_status write_turned(const struct request *request, batten_context *context,
                                  const batten_surfaces *list, size_t count,
                                  const batten_surface **surfaces)
{
	if (!request->turn)
		return write_all(request, context, list, count, surfaces);
	batten_surface **turned = calloc(count, sizeof *turned);
	batten_status status = turned ? turn_all(request, context, count, surfaces, turned)
	                              : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = write_all(request, context, list, count, surfaces);
	for (size_t i = 0; turned && i < count; i++)
		batten_surface_destroy(turned[i]);
	free(turned);
	return status;
}

static batten_status convert(const struct request *request, batten_context *context)
{
	batten_surfaces *list = NULL;
	batten_status status = batten_surfaces_read(context, request->in, &list);
	if (status != BATTEN_OK)
		return cli_failure("convert", context, status);
	size_t count = request->surface ? 1 : batten_surfaces_count(list);
	const batten_surface **surfaces = calloc(count, sizeof *surfaces);
	if (!surfaces)
		status = BATTEN_MEMORY;
	for (size_t i = 0; surfaces && i < count; i++)
		surfaces[i] = batten_surfaces_at(list, i);
	if (surfaces && request->surface)
		surfaces[0] = find_surface(list, request->surface);
	if (surfaces && !surfaces[0])
		status = cli_usage("convert",
		                   "--surface: found '%s', expected a name that only one surface has, or a "
		                   "number from 1 to %zu",
		                   request->surface, batten_surfaces_count(list));
	else if (surfaces)
		status = write_turned(request, context, list, count, surfaces);
	free(surfaces);
	batten_surfaces_destroy(list);
	return status;
}

static batten_status check_paths(const struct request *request)
{
	const char *dot = strrchr(request->in, '.');
	if (dot && strcasecmp(dot, ".csv") == 0)
		return cli_usage(
			"convert", "%s holds offsets: 'batten surface %s --net 13x13 --out %s' fits a surface",
			request->in, request->in, request->out);
	if (!cli_is_surface_file(request->in) || !cli_is_surface_file(request->out))
		return cli_usage("convert",
		                 "found '%s', expected a name that ends in .json, .igs, .iges, .stp or "
		                 ".step",
		                 cli_is_surface_file(request->in) ? request->out : request->in);
	return BATTEN_OK;
}

/* "x:90". Quarter turns are exact: no digit of a pole is lost. */
static batten_status read_turn(struct request *request, batten_context *context)
{
	const char *text = request->turn;
	char *end = NULL;
	const double degrees = text[0] && text[1] == ':' ? strtod(text + 2, &end) : 0.0;
	if (!strchr("xyz", text[0]) || !end || end == text + 2 || *end != '\0' || !isfinite(degrees))
		return cli_usage("convert", "--turn: found '%s', expected AXIS:DEGREES, as x:90", text);
	const double axis[] = { text[0] == 'x', text[0] == 'y', text[0] == 'z' };
	const batten_status status = batten_rotation(context, axis, degrees * (acos(-1.0) / 180.0),
	                                             request->matrix);
	for (size_t n = 0; n < 9 && fmod(degrees, 90.0) == 0.0; n++)
		request->matrix[n] = round(request->matrix[n]);
	return status;
}

batten_status cli_convert(int argc, char **argv)
{
	struct request request = { 0 };
	const cli_option options[] = {
		{ "surface", CLI_TEXT, &request.surface, "NAME|N",
		  "only the surface of this name or number, from 1" },
		{ "turn", CLI_TEXT, &request.turn, "AXIS:DEGREES",
		  "about the x, y or z axis: x takes y to z, y z to x, z x to y" },
		{ 0 },
	};
	const char *paths[2] = { NULL, NULL };
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&command, argc, argv, options, &request.common, paths, 2,
	                                 &count, &done);
	if (status != BATTEN_OK || done)
		return status;
	if (count != 2)
		return cli_usage("convert", "two files were expected, IN and OUT");
	request.in = paths[0];
	request.out = paths[1];
	status = check_paths(&request);
	batten_context *context = NULL;
	if (status == BATTEN_OK)
		status = cli_context_create("convert", &request.common, &context);
	if (status != BATTEN_OK)
		return status;
	if (request.turn)
		status = read_turn(&request, context);
	if (status == BATTEN_OK)
		status = convert(&request, context);
	batten_context_destroy(context);
	return status;
}
