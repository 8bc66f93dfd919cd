/* Hulls side by side: body plans, waterlines, flat maps of curvature, and a table of numbers. */
#include "core/number.h"
#include "geometry/grid_curvature.h"
#include "picture/colour_map.h"
#include "picture/lines_page.h"
#include "picture/svg_file.h"

#include <math.h>
#include <stdio.h>

enum { HULLS_MOST = 8, ROWS_MOST = 40 };

static const double page_width = 1900.0, names_width = 235.0, bar_width = 95.0;
static const double title_height = 116.0, gap = 26.0, row_height = 24.0, text_size = 15.0;
static const double body_height = 230.0, half_height = 150.0, map_height = 120.0;

static const paper_ink dark = { 0.10, 0.12, 0.15 };
static const paper_ink medium = { 0.33, 0.36, 0.40 };

typedef struct sheet {
	batten_context *context;
	const batten_comparison *shown;
	cairo_t *cairo;
	double column; /* its width */
	double scale_per_m;
	lines_box box;
	picture_colour_map colours;
} sheet;

static double column_left(const sheet *s, size_t h)
{
	return names_width + s->column * (double)h;
}

static double panel_width(const sheet *s)
{
	return s->column - gap;
}

static void write_text(const sheet *s, double x, double y, double width, paper_anchor anchor,
                       paper_ink ink, bool bold, const char *text)
{
	char clean[256];
	const paper_text style = { .x = x,
		                       .y = y,
		                       .size = text_size,
		                       .width = width,
		                       .bold = bold,
		                       .anchor = anchor,
		                       .ink = ink };
	paper_clean_text(text, clean, sizeof clean);
	paper_write(s->cairo, &style, clean);
}

static batten_status take_extent(sheet *s)
{
	s->box = lines_box_empty();
	batten_status status = BATTEN_OK;
	for (size_t h = 0; h < s->shown->hull_count && status == BATTEN_OK; h++)
		status = lines_box_add(s->shown->hulls[h], &s->box);
	if (status == BATTEN_OK && !(s->box.half_beam > 0.0))
		status = batten_fail(s->context, BATTEN_INPUT,
		                     "no half-breadth is above 0: nothing to draw");
	return status;
}

/* Every so manieth line of a large table. */
static size_t stride_of(size_t count, size_t most)
{
	return (count + most - 1) / most;
}

/* Sections of a hull, the fore ones to the right. */
static batten_status draw_sections(const sheet *s, const batten_hull *hull, double left, double top,
                                   const lines_style *style)
{
	const double wide = panel_width(s);
	const double unit = fmin(0.5 * wide / s->box.half_beam,
	                         body_height / (s->box.z_high - s->box.z_low));
	lines_plan plan = { .frame = { left, top, wide, body_height },
		                .origin_x = left + 0.5 * wide,
		                .origin_y = top + body_height + unit * s->box.z_low,
		                .up = unit };
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < hull->station_count && status == BATTEN_OK;
	     i += stride_of(hull->station_count, 25)) {
		plan.across = hull->x_m[i] < 0.5 * (s->box.x_low + s->box.x_high) ? -unit : unit;
		status = lines_draw_line(s->cairo, hull, false, i, &plan, style);
	}
	return status;
}

static batten_status draw_waterlines(const sheet *s, const batten_hull *hull, double left,
                                     double top, const lines_style *style)
{
	const double wide = panel_width(s);
	const double across = wide / (s->box.x_high - s->box.x_low);
	const lines_plan plan = { .frame = { left, top, wide, half_height },
		                      .origin_x = left - across * s->box.x_low,
		                      .origin_y = top + half_height,
		                      .across = across,
		                      .up = half_height / s->box.half_beam };
	batten_status status = BATTEN_OK;
	for (size_t k = 0; k < hull->waterline_count && status == BATTEN_OK;
	     k += stride_of(hull->waterline_count, 12))
		status = lines_draw_line(s->cairo, hull, true, k, &plan, style);
	return status;
}

/* A cell of the table between four nodes on the hull, in the colour of their mean. */
static void draw_cell(const sheet *s, const batten_hull *hull, const grid_curvature *grid, size_t i,
                      size_t k, double left, double top)
{
	const size_t nx = hull->station_count;
	const size_t corners[] = { k * nx + i, k * nx + i + 1, (k + 1) * nx + i, (k + 1) * nx + i + 1 };
	double sum = 0.0, rgb[3];
	for (size_t c = 0; c < 4; c++) {
		if (grid->origin[corners[c]] == GRID_CURVATURE_NONE)
			return;
		sum -= 0.25 * grid->mean_per_m[corners[c]]; /* convex to the water is positive */
	}
	const double across = panel_width(s) / (s->box.x_high - s->box.x_low);
	const double up = map_height / (s->box.z_high - s->box.z_low);
	const double x = left + across * (hull->x_m[i] - s->box.x_low);
	const double y = top + map_height - up * (hull->z_m[k + 1] - s->box.z_low);
	picture_colour_map_look_up(&s->colours, sum / s->scale_per_m, rgb);
	cairo_set_source_rgb(s->cairo, rgb[0], rgb[1], rgb[2]);
	/* A hair larger, so that no line shows between neighbours. */
	cairo_rectangle(s->cairo, x - 0.2, y - 0.2, across * (hull->x_m[i + 1] - hull->x_m[i]) + 0.4,
	                up * (hull->z_m[k + 1] - hull->z_m[k]) + 0.4);
	cairo_fill(s->cairo);
}

static batten_status draw_map(const sheet *s, const batten_hull *hull, double left, double top)
{
	grid_curvature *grid = NULL;
	const batten_status status = grid_curvature_create(s->context, hull, &grid);
	if (status != BATTEN_OK)
		return status;
	for (size_t k = 0; k + 1 < hull->waterline_count; k++)
		for (size_t i = 0; i + 1 < hull->station_count; i++)
			draw_cell(s, hull, grid, i, k, left, top);
	grid_curvature_destroy(s->context, grid);
	return BATTEN_OK;
}

/* A hull's three panels, the first hull pale under the lines of the others. */
static batten_status draw_hull(const sheet *s, size_t h)
{
	const lines_style pale = { { 0.93, 0.62, 0.42 }, 1.8, 0.0 };
	const lines_style thin = { { 0.08, 0.16, 0.30 }, 0.8, 0.0 };
	const batten_hull *hull = s->shown->hulls[h];
	const double left = column_left(s, h);
	const double half = title_height + body_height + gap;
	batten_status status = BATTEN_OK;
	write_text(s, left + 0.5 * panel_width(s), title_height - 12.0, panel_width(s), PAPER_CENTRE,
	           dark, true, s->shown->labels[h]);
	if (h > 0)
		status = draw_sections(s, s->shown->hulls[0], left, title_height, &pale);
	if (status == BATTEN_OK)
		status = draw_sections(s, hull, left, title_height, &thin);
	if (status == BATTEN_OK && h > 0)
		status = draw_waterlines(s, s->shown->hulls[0], left, half, &pale);
	if (status == BATTEN_OK)
		status = draw_waterlines(s, hull, left, half, &thin);
	return status == BATTEN_OK ? draw_map(s, hull, left, half + half_height + gap) : status;
}

static void draw_bar(const sheet *s)
{
	const double top = title_height + body_height + half_height + 2.0 * gap;
	const double left = page_width - bar_width + 12.0;
	enum { STEPS = 40 };
	for (int n = 0; n < STEPS; n++) {
		double rgb[3];
		picture_colour_map_look_up(&s->colours, 1.0 - 2.0 * (n + 0.5) / STEPS, rgb);
		cairo_set_source_rgb(s->cairo, rgb[0], rgb[1], rgb[2]);
		cairo_rectangle(s->cairo, left, top + map_height * n / STEPS, 18.0,
		                map_height / STEPS + 0.4);
		cairo_fill(s->cairo);
	}
	char text[64];
	(void)snprintf(text, sizeof text, "+%.3g", s->scale_per_m);
	write_text(s, left + 24.0, top + 12.0, 0.0, PAPER_LEFT, dark, false, text);
	write_text(s, left + 24.0, top + 0.5 * map_height + 5.0, 0.0, PAPER_LEFT, dark, false, "0");
	(void)snprintf(text, sizeof text, "\u2212%.3g", s->scale_per_m);
	write_text(s, left + 24.0, top + map_height, 0.0, PAPER_LEFT, dark, false, text);
}

static void draw_captions(const sheet *s)
{
	static const char *const captions[][2] = { { "body plan", "fore sections right" },
		                                       { "waterlines", "half-breadths stretched" },
		                                       { "mean curvature",
		                                         "1/m, + convex; heights stretched" } };
	const double tops[] = { title_height, title_height + body_height + gap,
		                    title_height + body_height + half_height + 2.0 * gap };
	for (size_t c = 0; c < 3; c++) {
		write_text(s, 24.0, tops[c] + 20.0, names_width - 40.0, PAPER_LEFT, dark, true,
		           captions[c][0]);
		write_text(s, 24.0, tops[c] + 40.0, names_width - 40.0, PAPER_LEFT, medium, false,
		           captions[c][1]);
	}
	write_text(s, 24.0, tops[1] + 60.0, names_width - 40.0, PAPER_LEFT, medium, false,
	           "orange: the first hull");
	const paper_text title = {
		.x = 24.0, .y = 42.0, .size = 26.0, .width = page_width - 48.0, .bold = true, .ink = dark
	};
	char clean[256];
	paper_clean_text(s->shown->title, clean, sizeof clean);
	paper_write(s->cairo, &title, clean);
	char lbp[BATTEN_NUMBER_SIZE], draft[BATTEN_NUMBER_SIZE];
	(void)snprintf(clean, sizeof clean,
	               "L %s m, T %s m \u00b7 frame ap-fwd, m \u00b7 one scale for all columns",
	               batten_number_write(lbp, s->shown->hulls[0]->lbp_m),
	               batten_number_write(draft, s->shown->hulls[0]->draft_m));
	write_text(s, 24.0, 68.0, page_width - 48.0, PAPER_LEFT, medium, false, clean);
}

static void draw_table(const sheet *s)
{
	const size_t columns = s->shown->hull_count;
	const double top = title_height + body_height + half_height + map_height + 4.0 * gap;
	for (size_t r = 0; r < s->shown->row_count; r++) {
		const double y = top + (double)r * row_height;
		if (r % 2 == 0) {
			cairo_set_source_rgb(s->cairo, 0.95, 0.96, 0.97);
			cairo_rectangle(s->cairo, 16.0, y - 17.0, page_width - bar_width - 16.0, row_height);
			cairo_fill(s->cairo);
		}
		write_text(s, 24.0, y, names_width - 40.0, PAPER_LEFT, dark, false, s->shown->row_names[r]);
		for (size_t h = 0; h < columns; h++) {
			const double value = s->shown->values[r * columns + h];
			char text[48];
			(void)snprintf(text, sizeof text, isnan(value) ? "\u2013" : "%.5g", value);
			write_text(s, column_left(s, h) + 0.5 * panel_width(s), y, panel_width(s), PAPER_CENTRE,
			           dark, false, text);
		}
	}
}

static batten_status draw(sheet *s)
{
	cairo_set_source_rgb(s->cairo, 1.0, 1.0, 1.0);
	cairo_paint(s->cairo);
	batten_status status = BATTEN_OK;
	for (size_t h = 0; h < s->shown->hull_count && status == BATTEN_OK; h++)
		status = draw_hull(s, h);
	draw_bar(s);
	draw_captions(s);
	draw_table(s);
	return status == BATTEN_OK ? paper_check(s->context, s->cairo) : status;
}

batten_status batten_picture_comparison(batten_context *context, const batten_comparison *shown,
                                        const char *path)
{
	if (shown->hull_count < 1 || shown->hull_count > HULLS_MOST || shown->row_count > ROWS_MOST)
		return batten_fail(context, BATTEN_USAGE,
		                   "%zu hulls and %zu rows: 1 to %d and up to %d are expected",
		                   shown->hull_count, shown->row_count, HULLS_MOST, ROWS_MOST);
	sheet s = { .context = context,
		        .shown = shown,
		        .column = (page_width - names_width - bar_width) / (double)shown->hull_count };
	batten_status status = batten_picture_scale(context, shown->hulls[0], &s.scale_per_m);
	if (status != BATTEN_OK)
		return status;
	status = take_extent(&s);
	if (status != BATTEN_OK)
		return status;
	picture_colour_map_fill(&s.colours);
	const double height = title_height + body_height + half_height + map_height + 4.0 * gap +
	                      row_height * (double)shown->row_count + 10.0;
	svg_file svg;
	status = svg_file_begin(context, page_width, height, &svg);
	if (status != BATTEN_OK)
		return status;
	s.cairo = svg.cairo;
	status = draw(&s);
	if (status != BATTEN_OK) {
		svg_file_abandon(&svg);
		return status;
	}
	return svg_file_end(&svg, path);
}
