#include "geometry/grid_curvature.h"
#include "hull/hull.h"
#include "picture/curvature_chart.h"
#include "picture/png_file.h"

#include "core/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Part of the nodes whose curvature the colour scale spans. */
static const double scale_part = 0.98;

void batten_picture_options_default(batten_picture_options *options)
{
	*options = (batten_picture_options){
		.struct_size = sizeof *options,
		.width = 1600,
		.height = 900,
	};
}

/* The next larger of a few round numbers, so that the ticks of the colour bar are round as well. */
static double round_up(double value)
{
	static const double steps[] = { 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0 };
	double power = pow(10.0, floor(log10(value)));
	for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
		if (value <= steps[i] * power * (1.0 + 1e-9))
			return steps[i] * power;
	return 10.0 * power;
}

/* The curvature that scale_part of the nodes with one of their own stay below. A flat hull takes
 * the curvature of a circle through its beam. */
static batten_status choose_scale(batten_context *context, const batten_hull *hull,
                                  const grid_curvature *grid, double *scale_per_m)
{
	double *sizes = batten_allocate(context, grid->own_count, sizeof *sizes);
	if (!sizes)
		return BATTEN_MEMORY;
	size_t count = 0;
	for (size_t node = 0; node < hull_node_count(hull); node++)
		if (grid->origin[node] == GRID_CURVATURE_OWN && isfinite(grid->mean_per_m[node]))
			sizes[count++] = fabs(grid->mean_per_m[node]);
	qsort(sizes, count, sizeof *sizes, batten_number_compare);
	double value = count ? sizes[(size_t)(scale_part * (double)(count - 1))] : 0.0;
	batten_release(context, sizes);
	double half_beam = batten_hull_half_beam_m(hull);
	double least = half_beam > 0.0 ? 1e-6 / half_beam : 1e-6;
	if (value < least)
		value = half_beam > 0.0 ? 1.0 / half_beam : 1.0;
	*scale_per_m = fmin(fmax(round_up(value), 1e-30), 1e30);
	return BATTEN_OK;
}

batten_status batten_picture_scale(batten_context *context, const batten_hull *hull,
                                   double *scale_per_m)
{
	grid_curvature *grid = NULL;
	batten_status status = grid_curvature_create(context, hull, &grid);
	if (status != BATTEN_OK)
		return status;
	status = choose_scale(context, hull, grid, scale_per_m);
	grid_curvature_destroy(context, grid);
	return status;
}

/* Renders the views of the chart. */
static batten_status render(batten_context *context, curvature_chart *chart, uint8_t *rgba,
                            char *driver)
{
	picture_renderer *renderer = NULL;
	batten_status status = picture_renderer_create(context, &renderer);
	if (status != BATTEN_OK)
		return status;
	chart->profile = picture_profile_fit(chart->mesh, &chart->views[CHART_PROFILE]);
	picture_view views[CHART_VIEW_COUNT] = {
		[CHART_PROFILE] = picture_profile_view(chart->mesh, &chart->views[CHART_PROFILE],
		                                       &chart->profile),
		[CHART_BOW] = picture_perspective_view(chart->mesh, &chart->views[CHART_BOW], 34.0, -14.0),
		[CHART_STERN] = picture_perspective_view(chart->mesh, &chart->views[CHART_STERN], 146.0,
		                                         -14.0),
	};
	picture_scene scene = {
		.width = (uint32_t)chart->width,
		.height = (uint32_t)chart->height,
		.mesh = chart->mesh,
		.views = views,
		.view_count = CHART_VIEW_COUNT,
		.colours = chart->colours,
		.scale_per_m = chart->scale_per_m,
		.background = { 1.0F, 1.0F, 1.0F },
		.line_width_px = (float)fmax(1.0, 1.2 * chart->unit),
		.line_strength = 0.28F,
		.shading = 0.22F,
	};
	status = picture_renderer_draw(renderer, &scene, rgba);
	if (status == BATTEN_OK)
		(void)snprintf(driver, 128, "%.127s", picture_renderer_name(renderer));
	picture_renderer_destroy(renderer);
	return status;
}

/* Vulkan's bytes red, green, blue, alpha to cairo's words; in place, all opaque. */
static void swap_channels(uint8_t *pixels, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		uint8_t *p = pixels + 4 * i;
		uint32_t word = (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
		memcpy(p, &word, sizeof word);
	}
}

static batten_status annotate(batten_context *context, const curvature_chart *chart,
                              uint8_t *pixels)
{
	int width = (int)chart->width;
	cairo_surface_t *surface = cairo_image_surface_create_for_data(
		pixels, CAIRO_FORMAT_RGB24, width, (int)chart->height, 4 * width);
	cairo_t *cairo = cairo_create(surface);
	curvature_chart_draw(chart, cairo);
	batten_status status = paper_check(context, cairo);
	cairo_surface_flush(surface);
	cairo_destroy(cairo);
	cairo_surface_destroy(surface);
	return status;
}

static batten_status save(batten_context *context, const curvature_chart *chart,
                          const uint8_t *pixels, const char *driver, const char *path)
{
	char number[BATTEN_NUMBER_SIZE];
	char scale[96];
	char name[256];
	paper_clean_text(chart->hull->name, name, sizeof name);
	(void)snprintf(scale, sizeof scale, "-%s..%s", batten_number_write(number, chart->scale_per_m),
	               number);
	const png_note notes[] = {
		{ "Title", chart->title }, { "Software", "batten " BATTEN_VERSION },
		{ "Hull", name },          { "Quantity", "mean curvature, convex positive" },
		{ "Scale", scale },        { "Unit", "1/m" },
		{ "Frame", "ap-fwd, m" },  { "Renderer", driver },
	};
	const png_picture picture = {
		.width = (uint32_t)chart->width,
		.height = (uint32_t)chart->height,
		.stride = 4 * (size_t)chart->width,
		.xrgb = pixels,
		.notes = notes,
		.note_count = sizeof notes / sizeof notes[0],
	};
	return png_file_write(context, &picture, path);
}

static batten_status draw_and_save(batten_context *context, curvature_chart *chart,
                                   const char *path, char *driver)
{
	size_t count = (size_t)chart->width * (size_t)chart->height;
	uint8_t *pixels = batten_allocate(context, count, 4);
	if (!pixels)
		return BATTEN_MEMORY;
	char name[128] = "";
	batten_status status = render(context, chart, pixels, name);
	if (status == BATTEN_OK) {
		swap_channels(pixels, count);
		status = annotate(context, chart, pixels);
	}
	if (status == BATTEN_OK)
		status = save(context, chart, pixels, name, path);
	batten_release(context, pixels);
	if (status == BATTEN_OK && driver)
		memcpy(driver, name, sizeof name);
	return status;
}

static batten_status check_options(batten_context *context, const batten_picture_options *options)
{
	if (options->struct_size != sizeof *options)
		return batten_fail(context, BATTEN_USAGE, "picture options of another version of batten");
	if (options->width < 64 || options->width > 8192 || options->height < 64 ||
	    options->height > 8192)
		return batten_fail(context, BATTEN_USAGE,
		                   "a picture of %u x %u pixels: both must be 64 to 8192", options->width,
		                   options->height);
	if (!(options->scale_per_m >= 0.0 && isfinite(options->scale_per_m)))
		return batten_fail(context, BATTEN_USAGE,
		                   "the curvature scale must be 0 or more and finite");
	return BATTEN_OK;
}

static batten_status make_mesh(batten_context *context, const batten_hull *hull,
                               curvature_chart *chart, picture_mesh **mesh)
{
	grid_curvature *grid = NULL;
	batten_status status = grid_curvature_create(context, hull, &grid);
	if (status != BATTEN_OK)
		return status;
	/* On the page convex is positive, as the bar says: a hull is mostly of the warm colours. */
	for (size_t node = 0; node < hull_node_count(hull); node++)
		grid->mean_per_m[node] = -grid->mean_per_m[node];
	picture_field field = { .value = grid->mean_per_m, .known = grid->origin };
	if (chart->scale_per_m == 0.0)
		status = choose_scale(context, hull, grid, &chart->scale_per_m);
	if (status == BATTEN_OK)
		status = picture_mesh_create(context, hull, &field, mesh);
	grid_curvature_destroy(context, grid);
	return status;
}

batten_status batten_picture_curvature(batten_context *context, const batten_hull *hull,
                                       const batten_picture_options *options, const char *path,
                                       char *driver)
{
	batten_picture_options chosen;
	batten_picture_options_default(&chosen);
	if (options)
		chosen = *options;
	batten_status status = check_options(context, &chosen);
	if (status != BATTEN_OK)
		return status;
	char title[256];
	paper_clean_text(chosen.title ? chosen.title : hull->name, title, sizeof title);
	picture_colour_map colours;
	picture_colour_map_fill(&colours);
	curvature_chart chart = {
		.hull = hull,
		.colours = &colours,
		.title = title,
		.scale_per_m = chosen.scale_per_m,
	};
	curvature_chart_lay_out(&chart, chosen.width, chosen.height);
	picture_mesh *mesh = NULL;
	status = make_mesh(context, hull, &chart, &mesh);
	if (status != BATTEN_OK)
		return status;
	chart.mesh = mesh;
	status = draw_and_save(context, &chart, path, driver);
	picture_mesh_destroy(mesh);
	return status;
}
