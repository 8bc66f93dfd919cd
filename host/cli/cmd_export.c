/* batten export: one design of a sweep as a file. */
#include "cli.h"

#include "json_out.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Triangles along one span of the surface's knots. */
enum { STL_STEPS = 4 };

static const cli_command command = {
	.name = "export",
	.usage = "RESULTS.db --id K --out FILE",
	.summary = "writes one design of a sweep as offsets, surface or triangles",
	.example = "  batten export trawler.db --id 12 --out hull12.csv\n"
			   "  batten export trawler.db --id 12 --out hull12.step\n",
	.notes =
		"FILE ends in .csv (offsets), .json, .igs, .iges, .stp, .step (a B-spline surface fitted\n"
		"to them, its net as large as the offsets ask for) or .stl (triangles of that surface). A\n"
		"design whose offsets are not in the database is made again from its plan.\n",
};

struct request {
	cli_common common;
	const char *database, *out, *id;
	uint64_t number;
};

static bool ends_in(const char *path, const char *ending)
{
	const size_t length = strlen(path);
	const size_t tail = strlen(ending);
	return length > tail && strcmp(path + length - tail, ending) == 0;
}

static batten_status parse(int argc, char **argv, struct request *request, bool *done)
{
	const cli_option options[] = {
		{ "id", CLI_TEXT, &request->id, "K", "number of the design, from 0" },
		{ "out", CLI_TEXT, &request->out, "FILE", "where it goes" },
		{ 0 },
	};
	size_t count = 0;
	const batten_status status = cli_parse(&command, argc, argv, options, &request->common,
	                                       &request->database, 1, &count, done);
	if (status != BATTEN_OK || *done)
		return status;
	if (count != 1)
		return cli_usage("export", "a database was expected");
	if (!request->id || !request->out)
		return cli_usage("export", "--id K and --out FILE were expected");
	char *end = NULL;
	errno = 0;
	request->number = strtoull(request->id, &end, 10);
	if (request->id[0] < '0' || request->id[0] > '9' || *end != '\0' || errno != 0)
		return cli_usage("export", "--id: found '%s', expected the number of a design",
		                 request->id);
	if (!ends_in(request->out, ".csv") && !ends_in(request->out, ".stl") &&
	    !cli_is_surface_file(request->out))
		return cli_usage(
			"export",
			"--out: found '%s', expected a name that ends in .csv, .json, .igs, .iges, "
			".stp, .step or .stl",
			request->out);
	return BATTEN_OK;
}

static batten_status write_surface(const struct request *request, batten_context *context,
                                   const batten_hull *hull, batten_fit_deviation *deviation)
{
	batten_surface *surface = NULL;
	batten_status status = batten_hull_fit_chosen(context, hull, &surface, deviation);
	if (status == BATTEN_OK && ends_in(request->out, ".stl"))
		status = batten_surface_write_stl(context, surface, STL_STEPS, request->out);
	else if (status == BATTEN_OK)
		status = batten_surfaces_write(context, 1, (const batten_surface *const *)&surface,
		                               request->out);
	batten_surface_destroy(surface);
	return status;
}

static batten_status run(const struct request *request, batten_context *context)
{
	batten_hull *hull = NULL;
	batten_fit_deviation deviation = { 0 };
	const bool is_table = ends_in(request->out, ".csv");
	batten_status status = batten_sweep_design(context, request->database, request->number, &hull);
	if (status == BATTEN_OK)
		status = is_table ? batten_hull_write(context, hull, request->out)
		                  : write_surface(request, context, hull, &deviation);
	if (status != BATTEN_OK)
		(void)cli_failure("export", context, status);
	else if (request->common.json)
		status = cli_json_print(
			"export", json_pack("{s:I, s:s, s:s, s:o}", "id", (json_int_t)request->number, "name",
		                        batten_hull_name(hull), "file", request->out, "deviation_max_m",
		                        is_table ? json_null() : cli_json_number(deviation.max_m)));
	else if (is_table)
		(void)printf("%s: design %llu\n", request->out, (unsigned long long)request->number);
	else
		(void)printf("%s: design %llu, the surface within %.3g m of its offsets\n", request->out,
		             (unsigned long long)request->number, deviation.max_m);
	batten_hull_destroy(hull);
	return status;
}

batten_status cli_export(int argc, char **argv)
{
	struct request request = { 0 };
	bool done = false;
	batten_context *context = NULL;
	batten_status status = parse(argc, argv, &request, &done);
	if (status == BATTEN_OK && !done)
		status = cli_context_create("export", &request.common, &context);
	if (status != BATTEN_OK || done)
		return status;
	status = run(&request, context);
	batten_context_destroy(context);
	return status;
}
