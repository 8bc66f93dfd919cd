/* batten surface: a hull as one B-spline surface. */
#include "cli.h"

#include "json_out.h"
#include "surface_contours.h"
#include "surface_grid.h"

#include <stdlib.h>
#include <string.h>

static const cli_command command = {
	.name = "surface",
	.usage = "HULL.csv --net MxN [--out FILE] [OPTION ...]\n"
			 "       batten surface SURFACE --grid FILE | --contours FILE --at LIST [--points MxN]",
	.summary = "fits a B-spline surface to the offsets of a hull by least squares",
	.example = "  batten surface data/hulls/npl_parent.csv --net 13x13 --out npl.json\n"
			   "  batten surface data/hulls/npl_parent.csv --net 13x13 --out npl.igs\n"
			   "  batten surface data/hulls/wigley.csv --net 3x3 --order 3x3 --json\n"
			   "  batten surface npl.json --grid curvature.csv --points 101x51\n"
			   "  batten surface npl.json --contours lines.csv --at z=0.05,z=0.1,x=2.1,gauss=0\n",
	.notes =
		"The net has M poles along the hull and N from keel to deck; its edges follow keel, stern,\n"
		"stem and the tops of the sections. Edges in the centreplane keep y = 0. A net of as many\n"
		"poles as a full table has stations and waterlines goes through every point. The deviation\n"
		"is the distance of the offsets from the nearest point of the surface. FILE ends in .json\n"
		"(data/schema/surface.schema.json), or in .igs, .iges, .stp, .step: IGES and STEP for other\n"
		"programs. All are in metres, frame ap-fwd.\n"
		"--grid writes a table of the surface, fitted or read: u, v, position, derivatives, both\n"
		"fundamental forms, normal, curvatures (positive towards the outward normal, so that a\n"
		"convex hull's are negative), principal directions, isophote value by light from port;\n"
		"singular is 1 where there is no normal.\n"
		"--contours writes lines of the surface, a row a point: waterlines z=0.5, sections x=8, buttocks\n"
		"y=0.2, and where other values of --grid (gauss, mean, isophote ...) have a level. Points lie on\n"
		"the surface where lines cross those of a mesh of --points.\n",
};

struct request {
	cli_common common;
	const char *hull_path, *out, *net, *order, *rounded, *grid, *points, *contours, *at;
	bool free_edges, given; /* given: hull_path is a surface */
	size_t u_count, v_count;
	size_t level_count;
	contour_level levels[CONTOURS_MOST];
	batten_fit_options fit;
};

static void print_table(const struct request *request, const batten_hull *hull,
                        const batten_fit_deviation *deviation)
{
	const batten_fit_options *fit = &request->fit;
	(void)printf("%s: %zu x %zu poles of order %zu x %zu, fitted to %zu points; metres, frame "
	             "ap-fwd\n\n",
	             batten_hull_name(hull), fit->count_u, fit->count_v, fit->order_u, fit->order_v,
	             deviation->point_count);
	(void)printf("deviation, rms      %12.6g m  %8.4f %% of the half-beam\n", deviation->rms_m,
	             deviation->rms_pct);
	(void)printf("deviation, largest  %12.6g m  %8.4f %% of the half-beam\n", deviation->max_m,
	             deviation->max_pct);
	(void)printf("  at x %.6g, y %.6g, z %.6g\n", deviation->x_m, deviation->y_m, deviation->z_m);
}

static batten_status print_json(const struct request *request, const batten_hull *hull,
                                const batten_fit_deviation *deviation)
{
	const batten_fit_options *fit = &request->fit;
	json_t *object = json_pack(
		"{s:s, s:s, s:s, s:I, s:I, s:I, s:I, s:I, s:I}", "name", batten_hull_name(hull), "unit",
		"m", "frame", "ap-fwd", "order_u", (json_int_t)fit->order_u, "order_v",
		(json_int_t)fit->order_v, "count_u", (json_int_t)fit->count_u, "count_v",
		(json_int_t)fit->count_v, "points", (json_int_t)deviation->point_count, "corrections",
		(json_int_t)deviation->corrections);
	const struct {
		const char *name;
		double value;
	} numbers[] = {
		{ "half_beam_m", batten_hull_half_beam_m(hull) },
		{ "deviation_rms_m", deviation->rms_m },
		{ "deviation_max_m", deviation->max_m },
		{ "deviation_rms_pct", deviation->rms_pct },
		{ "deviation_max_pct", deviation->max_pct },
		{ "deviation_max_x_m", deviation->x_m },
		{ "deviation_max_y_m", deviation->y_m },
		{ "deviation_max_z_m", deviation->z_m },
	};
	for (size_t i = 0; object && i < sizeof numbers / sizeof numbers[0]; i++)
		(void)json_object_set_new(object, numbers[i].name, cli_json_number(numbers[i].value));
	return cli_json_print("surface", object);
}

static batten_status write_tables(const struct request *request, batten_context *context,
                                  const batten_surface *surface)
{
	batten_status status = BATTEN_OK;
	if (request->grid)
		status = surface_grid_write(context, surface, request->u_count, request->v_count,
		                            request->grid);
	if (status == BATTEN_OK && request->contours)
		status = surface_contours_write(context, surface, request->u_count, request->v_count,
		                                request->levels, request->level_count, request->contours);
	return status;
}

/* A surface that is there already: its tables. */
static batten_status read_surface(const struct request *request, batten_context *context)
{
	batten_surfaces *surfaces = NULL;
	batten_status status = batten_surfaces_read(context, request->hull_path, &surfaces);
	if (status == BATTEN_OK && batten_surfaces_count(surfaces) != 1) {
		const size_t count = batten_surfaces_count(surfaces);
		batten_surfaces_destroy(surfaces);
		return cli_usage("surface",
		                 "%s: found %zu surfaces, expected one: batten convert "
		                 "--surface takes it out",
		                 request->hull_path, count);
	}
	if (status == BATTEN_OK)
		status = write_tables(request, context, batten_surfaces_at(surfaces, 0));
	batten_surfaces_destroy(surfaces);
	return status == BATTEN_OK ? status : cli_failure("surface", context, status);
}

static batten_status make_surface(const struct request *request, batten_context *context)
{
	batten_hull *hull = NULL;
	batten_surface *surface = NULL;
	batten_fit_deviation deviation;
	batten_status status = batten_hull_read(context, request->hull_path, &hull);
	if (status == BATTEN_OK)
		status = batten_hull_fit(context, hull, &request->fit, &surface, &deviation);
	if (status == BATTEN_OK && request->out)
		status = batten_surfaces_write(context, 1, (const batten_surface *const *)&surface,
		                               request->out);
	if (status == BATTEN_OK)
		status = write_tables(request, context, surface);
	if (status != BATTEN_OK)
		status = cli_failure("surface", context, status);
	else if (request->common.json)
		status = print_json(request, hull, &deviation);
	else
		print_table(request, hull, &deviation);
	batten_surface_destroy(surface);
	batten_hull_destroy(hull);
	return status;
}

/* What is asked for of tables. */
static batten_status read_tables(struct request *request)
{
	const bool wanted = request->grid || request->contours;
	if (request->points && !wanted)
		return cli_usage("surface",
		                 "--points: --grid FILE or --contours FILE was expected with it");
	if (request->points && (!cli_read_pair(request->points, &request->u_count, &request->v_count) ||
	                        request->u_count < 2 || request->v_count < 2))
		return cli_usage("surface", "--points: found '%s', expected MxN, as 65x33, each at least 2",
		                 request->points);
	if (!request->contours != !request->at)
		return cli_usage("surface", "--contours FILE and --at LIST were expected together");
	if (request->at && !surface_contours_read(request->at, request->levels, &request->level_count))
		return cli_usage(
			"surface",
			"--at: found '%s', expected values of --grid without their units and levels, "
			"at most %d, as z=0.5,x=8,gauss=0",
			request->at, CONTOURS_MOST);
	request->given = cli_is_surface_file(request->hull_path);
	return request->given && !wanted
	           ? cli_usage("surface",
	                       "%s is a surface: --grid FILE or --contours FILE was expected",
	                       request->hull_path)
	           : BATTEN_OK;
}

static batten_status read_request(struct request *request)
{
	batten_fit_options *fit = &request->fit;
	const batten_status status = read_tables(request);
	if (status != BATTEN_OK)
		return status;
	if (request->given && (request->net || request->order || request->out || request->rounded))
		return cli_usage("surface", "%s is a surface: only --grid and --contours were expected",
		                 request->hull_path);
	if (request->given)
		return BATTEN_OK;
	if (!request->net)
		return cli_usage("surface", "--net MxN was expected: poles along the hull, keel to deck");
	if (!cli_read_pair(request->net, &fit->count_u, &fit->count_v))
		return cli_usage("surface", "--net: found '%s', expected MxN, as 13x13", request->net);
	if (request->order && !cli_read_pair(request->order, &fit->order_u, &fit->order_v))
		return cli_usage("surface", "--order: found '%s', expected KxL, as 4x4", request->order);
	if (request->out && !cli_is_surface_file(request->out))
		return cli_usage("surface",
		                 "--out: found '%s', expected a name that ends in .json, .igs, .iges, .stp "
		                 "or .step",
		                 request->out);
	fit->hold_centreplane = !request->free_edges;
	return request->rounded
	           ? cli_read_edges("surface", "rounded", request->rounded, false, &fit->rounded)
	           : BATTEN_OK;
}

batten_status cli_surface(int argc, char **argv)
{
	struct request request = { .u_count = 65, .v_count = 33 };
	batten_fit_options_default(&request.fit);
	const cli_option options[] = {
		{ "net", CLI_TEXT, &request.net, "MxN", "poles along the hull and from keel to deck" },
		{ "order", CLI_TEXT, &request.order, "KxL", "orders, degree + 1, 2 to 8 (4x4)" },
		{ "out", CLI_TEXT, &request.out, "FILE", "where the surface goes" },
		{ "rounded", CLI_TEXT, &request.rounded, "EDGES",
		  "edges that leave the centreplane square to it: keel,stern,stem" },
		{ "free-edges", CLI_FLAG, &request.free_edges, NULL,
		  "do not hold y = 0 on edges in the centreplane" },
		{ "corrections", CLI_COUNT, &request.fit.correction_limit, "N",
		  "rounds of better parameters, at most (20)" },
		{ "grid", CLI_TEXT, &request.grid, "FILE", "a table of the surface, .csv or .json" },
		{ "contours", CLI_TEXT, &request.contours, "FILE", "lines of the surface, .csv or .json" },
		{ "at", CLI_TEXT, &request.at, "LIST", "what is the same along them: z=0.5,x=8,gauss=0" },
		{ "points", CLI_TEXT, &request.points, "MxN",
		  "points of --grid and mesh of --contours along u and v (65x33)" },
		{ 0 },
	};
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&command, argc, argv, options, &request.common,
	                                 &request.hull_path, 1, &count, &done);
	if (status != BATTEN_OK || done)
		return status;
	if (count != 1)
		return cli_usage("surface", "an offsets file was expected");
	status = read_request(&request);
	batten_context *context = NULL;
	if (status == BATTEN_OK)
		status = cli_context_create("surface", &request.common, &context);
	if (status != BATTEN_OK)
		return status;
	status = request.given ? read_surface(&request, context) : make_surface(&request, context);
	batten_context_destroy(context);
	return status;
}
