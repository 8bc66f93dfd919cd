/* batten convert: surfaces from one file format to another. */
#include "cli.h"

#include "json_out.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const cli_command command = {
	.name = "convert",
	.usage = "IN ... OUT [--surface NAME|N] [--turn AXIS:DEGREES] [OPTION ...]",
	.summary = "takes the B-spline surfaces of files into another format",
	.example = "  batten surface data/hulls/npl_parent.csv --net 13x13 --out npl.json\n"
			   "  batten convert npl.json npl.step\n"
			   "  batten convert npl.step npl.igs --json\n"
			   "  batten convert hull.json deck.json ship.step\n"
			   "  batten convert y_up.igs hull.json --turn x:90\n",
	.notes =
		"The endings choose the formats: .json (data/schema/surface.schema.json, one surface), .igs\n"
		"or .iges (IGES, entity 128), .stp or .step (STEP). Any unit is read, metres are written;\n"
		"the axes are taken as they are: ap-fwd is x forward from the aft perpendicular, y to port,\n"
		"z up. --turn brings others there: x:90 what has y up, z:180 what has x aft. Without it poles,\n"
		"knots and weights keep every digit. Trimmed surfaces and whatever is no\n"
		"B-spline surface are left out with a warning. Offsets become a surface by batten surface.\n",
};

/* Most files a call reads. */
enum { FILES_MOST = 64 };

struct request {
	cli_common common;
	size_t file_count;
	const char *in[FILES_MOST + 1]; /* the last one given is out */
	const char *out, *surface, *turn;
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

/* The surfaces of all files in their order, and those of them that are written. */
struct gathered {
	size_t file_count, total, warning_count, count;
	batten_surfaces *files[FILES_MOST];
	const batten_surface **surfaces; /* [total + 1]; the first count of them are written */
	batten_surface **turned;         /* [total + 1]; NULL where they are written as they are */
};

static void gathered_release(struct gathered *g)
{
	for (size_t i = 0; g->turned && i < g->total; i++)
		batten_surface_destroy(g->turned[i]);
	for (size_t f = 0; f < g->file_count; f++)
		batten_surfaces_destroy(g->files[f]);
	free(g->surfaces);
	free(g->turned);
}

static batten_status gather(const struct request *request, batten_context *context,
                            struct gathered *g)
{
	for (; g->file_count < request->file_count; g->file_count++) {
		batten_surfaces **file = &g->files[g->file_count];
		const batten_status status = batten_surfaces_read(context, request->in[g->file_count],
		                                                  file);
		if (status != BATTEN_OK)
			return cli_failure("convert", context, status);
		g->total += batten_surfaces_count(*file);
		g->warning_count += batten_surfaces_warning_count(*file);
	}
	g->surfaces = calloc(g->total + 1, sizeof *g->surfaces);
	if (!g->surfaces)
		return BATTEN_MEMORY;
	for (size_t f = 0; f < g->file_count; f++)
		for (size_t i = 0; i < batten_surfaces_count(g->files[f]); i++)
			g->surfaces[g->count++] = batten_surfaces_at(g->files[f], i);
	return BATTEN_OK;
}

/* ---- what is said ---- */

static void print_table(const struct request *request, const struct gathered *g)
{
	for (size_t f = 0; f < request->file_count; f++)
		(void)printf("%s%s", f > 0 ? ", " : "", request->in[f]);
	(void)printf(" -> %s: %zu of %zu surfaces; metres, frame ap-fwd\n\n", request->out, g->count,
	             g->total);
	for (size_t i = 0; i < g->count; i++) {
		const batten_surface_net net = batten_surface_describe(g->surfaces[i]);
		(void)printf("%3zu  %zu x %zu poles of order %zu x %zu%s  %s\n", i + 1, net.count_u,
		             net.count_v, net.order_u, net.order_v, net.weights ? ", rational" : "",
		             net.name);
	}
	if (g->warning_count > 0)
		(void)printf("\n%zu warnings\n", g->warning_count);
}

/* A name, or a list of several. */
static json_t *names_of(const struct request *request)
{
	if (request->file_count == 1)
		return json_string(request->in[0]);
	json_t *names = json_array();
	for (size_t f = 0; names && f < request->file_count; f++)
		(void)json_array_append_new(names, json_string(request->in[f]));
	return names;
}

static batten_status print_json(const struct request *request, const struct gathered *g)
{
	json_t *array = json_array();
	json_t *warnings = json_array();
	for (size_t i = 0; array && i < g->count; i++) {
		const batten_surface_net net = batten_surface_describe(g->surfaces[i]);
		(void)json_array_append_new(
			array, json_pack("{s:s, s:I, s:I, s:I, s:I, s:b}", "name", net.name, "order_u",
		                     (json_int_t)net.order_u, "order_v", (json_int_t)net.order_v, "count_u",
		                     (json_int_t)net.count_u, "count_v", (json_int_t)net.count_v,
		                     "rational", net.weights != NULL));
	}
	for (size_t f = 0; f < g->file_count; f++)
		for (size_t i = 0; warnings && i < batten_surfaces_warning_count(g->files[f]); i++)
			(void)json_array_append_new(warnings,
			                            json_string(batten_surfaces_warning(g->files[f], i)));
	json_t *object = json_pack("{s:o, s:s, s:s, s:s, s:I, s:I, s:o, s:o}", "in", names_of(request),
	                           "out", request->out, "unit", "m", "frame", "ap-fwd", "count",
	                           (json_int_t)g->count, "count_in", (json_int_t)g->total, "surfaces",
	                           array, "warnings", warnings);
	return cli_json_print("convert", object);
}

/* ---- what is done ---- */

/* Leaves the surface that --surface means: by name, or by number from 1. */
static batten_status choose(const struct request *request, struct gathered *g)
{
	const char *wanted = request->surface;
	const batten_surface *found = NULL;
	size_t alike = 0;
	char *end = NULL;
	for (size_t i = 0; i < g->total; i++)
		if (strcmp(batten_surface_describe(g->surfaces[i]).name, wanted) == 0) {
			found = g->surfaces[i];
			alike++;
		}
	if (alike == 0 && wanted[0] >= '0' && wanted[0] <= '9') {
		const unsigned long number = strtoul(wanted, &end, 10);
		if (*end == '\0' && number > 0 && number <= g->total) {
			found = g->surfaces[number - 1];
			alike = 1;
		}
	}
	if (alike != 1)
		return cli_usage("convert",
		                 "--surface: found '%s', expected a name that only one surface has, or a "
		                 "number from 1 to %zu",
		                 wanted, g->total);
	g->surfaces[0] = found;
	g->count = 1;
	return BATTEN_OK;
}

/* Copies that are turned, in the place of the surfaces. */
static batten_status turn(const struct request *request, batten_context *context,
                          struct gathered *g)
{
	const double nowhere[3] = { 0.0, 0.0, 0.0 };
	g->turned = calloc(g->total + 1, sizeof *g->turned);
	batten_status status = g->turned ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t i = 0; i < g->count && status == BATTEN_OK; i++) {
		status = batten_surface_clone(context, g->surfaces[i], &g->turned[i]);
		if (status == BATTEN_OK)
			status = batten_surface_map(g->turned[i], request->matrix, nowhere);
		g->surfaces[i] = g->turned[i];
	}
	return status == BATTEN_OK ? status : cli_failure("convert", context, status);
}

static batten_status write_all(const struct request *request, batten_context *context,
                               const struct gathered *g)
{
	const char *dot = strrchr(request->out, '.');
	if (g->count > 1 && dot && strcasecmp(dot, ".json") == 0)
		return cli_usage(
			"convert", "%s%s: %zu surfaces, a .json file holds one: choose it by --surface NAME|N",
			request->in[0], request->file_count > 1 ? " ..." : "", g->count);
	const batten_status status = batten_surfaces_write(context, g->count, g->surfaces,
	                                                   request->out);
	if (status != BATTEN_OK)
		return cli_failure("convert", context, status);
	if (request->common.json)
		return print_json(request, g);
	print_table(request, g);
	return BATTEN_OK;
}

static batten_status convert(const struct request *request, batten_context *context)
{
	struct gathered g = { 0 };
	batten_status status = gather(request, context, &g);
	if (status == BATTEN_OK && request->surface)
		status = choose(request, &g);
	if (status == BATTEN_OK && request->turn)
		status = turn(request, context, &g);
	if (status == BATTEN_OK)
		status = write_all(request, context, &g);
	gathered_release(&g);
	return status;
}

static batten_status check_path(const struct request *request, const char *path)
{
	const char *dot = strrchr(path, '.');
	if (path != request->out && dot && strcasecmp(dot, ".csv") == 0)
		return cli_usage(
			"convert", "%s holds offsets: 'batten surface %s --net 13x13 --out %s' fits a surface",
			path, path, request->out);
	return cli_is_surface_file(path)
	           ? BATTEN_OK
	           : cli_usage("convert",
	                       "found '%s', expected a name that ends in .json, .igs, .iges, .stp or "
	                       ".step",
	                       path);
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
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&command, argc, argv, options, &request.common, request.in,
	                                 FILES_MOST + 1, &count, &done);
	if (status != BATTEN_OK || done)
		return status;
	if (count < 2)
		return cli_usage("convert", "two files were expected, IN and OUT");
	request.file_count = count - 1;
	request.out = request.in[count - 1];
	for (size_t f = 0; f < count && status == BATTEN_OK; f++)
		status = check_path(&request, request.in[f]);
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
