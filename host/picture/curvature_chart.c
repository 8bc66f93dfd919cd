#include "picture/curvature_chart.h"

#include "core/number.h"
#include "hull/hull.h"

#include <math.h>
#include <stdio.h>

static const double design_width = 1600.0;
static const double design_height = 900.0;

static const paper_ink dark = { 0.10, 0.12, 0.15 };
static const paper_ink medium = { 0.33, 0.36, 0.40 };
static const paper_ink faint = { 0.72, 0.74, 0.77 };

void curvature_chart_lay_out(curvature_chart *chart, unsigned width, unsigned height)
{
	chart->width = width;
	chart->height = height;
	double u = fmin(width / design_width, height / design_height);
	chart->unit = u;
	double left = 56.0 * u;
	double bar = 150.0 * u; /* colour bar with its numbers */
	double wide = fmax(width - left - bar - 30.0 * u, 8.0 * u);
	double top = 116.0 * u;
	double bottom = height - 22.0 * u;
	double tall = fmax(bottom - top, 8.0 * u);
	double profile = 0.36 * tall;
	double axis = 78.0 * u; /* numbers and caption under the side view */
	chart->views[CHART_PROFILE] = (picture_rectangle){ left, top, wide, profile };
	double lower = top + profile + axis;
	double lower_tall = fmax(bottom - lower - 34.0 * u, 4.0 * u);
	double bow = 0.56 * wide;
	chart->views[CHART_STERN] = (picture_rectangle){ left, lower, wide - bow - 30.0 * u,
		                                             lower_tall };
	chart->views[CHART_BOW] = (picture_rectangle){ left + wide - bow, lower, bow, lower_tall };
	chart->colour_bar = (picture_rectangle){ width - bar + 24.0 * u, top + 40.0 * u, 34.0 * u,
		                                     fmax(tall - 110.0 * u, 4.0 * u) };
}

static paper_text text_at(const curvature_chart *chart, double x, double y, double size,
                          paper_anchor anchor, paper_ink ink)
{
	return (paper_text){ .x = x, .y = y, .size = size * chart->unit, .anchor = anchor, .ink = ink };
}

static void draw_header(const curvature_chart *chart, cairo_t *cairo)
{
	double u = chart->unit;
	double left = 40.0 * u;
	paper_text style = text_at(chart, left, 50.0 * u, 34.0, PAPER_LEFT, dark);
	style.bold = true;
	style.width = chart->width - 2.0 * left;
	paper_write(cairo, &style, chart->title);
	char lbp[BATTEN_NUMBER_SIZE];
	char draft[BATTEN_NUMBER_SIZE];
	char line[256];
	(void)snprintf(line, sizeof line,
	               "mean curvature H of the hull, both sides \u00b7 L %s m, T %s m \u00b7 frame "
	               "ap-fwd, m \u00b7 thin lines: stations and waterlines of the table",
	               batten_number_write(lbp, chart->hull->lbp_m),
	               batten_number_write(draft, chart->hull->draft_m));
	style = text_at(chart, left, 84.0 * u, 21.0, PAPER_LEFT, medium);
	style.width = chart->width - 2.0 * left;
	paper_write(cairo, &style, line);
}

/* The bar's pointed ends say that colours beyond the scale stay those of its ends. */
static void draw_bar_colours(const curvature_chart *chart, cairo_t *cairo)
{
	const picture_rectangle *bar = &chart->colour_bar;
	cairo_pattern_t *pattern = cairo_pattern_create_linear(0.0, bar->top + bar->height, 0.0,
	                                                       bar->top);
	for (int i = 0; i < PICTURE_COLOUR_COUNT; i += 8)
		cairo_pattern_add_color_stop_rgb(
			pattern, (double)i / (PICTURE_COLOUR_COUNT - 1), (double)chart->colours->rgba[i][0],
			(double)chart->colours->rgba[i][1], (double)chart->colours->rgba[i][2]);
	double tip = 0.5 * bar->width;
	double bottom = bar->top + bar->height;
	cairo_move_to(cairo, bar->left, bar->top);
	cairo_line_to(cairo, bar->left + tip, bar->top - tip);
	cairo_line_to(cairo, bar->left + bar->width, bar->top);
	cairo_line_to(cairo, bar->left + bar->width, bottom);
	cairo_line_to(cairo, bar->left + tip, bottom + tip);
	cairo_line_to(cairo, bar->left, bottom);
	cairo_close_path(cairo);
	cairo_set_source(cairo, pattern);
	cairo_fill_preserve(cairo);
	cairo_pattern_destroy(pattern);
	cairo_set_source_rgb(cairo, medium.red, medium.green, medium.blue);
	cairo_set_line_width(cairo, chart->unit);
	cairo_stroke(cairo);
}

static void draw_colour_bar(const curvature_chart *chart, cairo_t *cairo)
{
	const picture_rectangle *bar = &chart->colour_bar;
	double u = chart->unit;
	draw_bar_colours(chart, cairo);
	double scale = chart->scale_per_m;
	paper_ticks ticks = paper_choose_ticks(-scale, scale, 9);
	for (long tick = ticks.first; tick <= ticks.last; tick++) {
		double part = 0.5 * (ticks.step * (double)tick / scale + 1.0);
		double y = bar->top + bar->height * (1.0 - part);
		double right = bar->left + bar->width;
		char number[64];
		paper_tick_text(&ticks, tick, true, number, sizeof number);
		cairo_move_to(cairo, right, y);
		cairo_line_to(cairo, right + 6.0 * u, y);
		cairo_stroke(cairo);
		paper_text style = text_at(chart, right + 11.0 * u, y + 7.0 * u, 20.0, PAPER_LEFT, dark);
		style.width = chart->width - right - 15.0 * u;
		paper_write(cairo, &style, number);
	}
	double middle = bar->left + 0.5 * bar->width;
	double above = bar->top - 0.5 * bar->width;
	double below = bar->top + bar->height + 0.5 * bar->width;
	paper_text style = text_at(chart, middle, above - 42.0 * u, 22.0, PAPER_CENTRE, dark);
	style.bold = true;
	paper_write(cairo, &style, "H, 1/m");
	style = text_at(chart, middle, above - 12.0 * u, 20.0, PAPER_CENTRE, medium);
	paper_write(cairo, &style, "convex");
	style.y = below + 26.0 * u;
	paper_write(cairo, &style, "concave");
}

static void draw_axis_x(const curvature_chart *chart, cairo_t *cairo, double bottom)
{
	double u = chart->unit;
	const profile_scale *scale = &chart->profile;
	paper_ticks ticks = paper_choose_ticks(chart->mesh->low[0], chart->mesh->high[0], 12);
	for (long tick = ticks.first; tick <= ticks.last; tick++) {
		double x = scale->x_left + ticks.step * (double)tick * scale->pixels_per_m;
		char number[64];
		paper_tick_text(&ticks, tick, false, number, sizeof number);
		cairo_set_source_rgb(cairo, faint.red, faint.green, faint.blue);
		cairo_move_to(cairo, x, bottom + 4.0 * u);
		cairo_line_to(cairo, x, bottom + 12.0 * u);
		cairo_stroke(cairo);
		paper_text style = text_at(chart, x, bottom + 32.0 * u, 18.0, PAPER_CENTRE, medium);
		paper_write(cairo, &style, number);
	}
}

static void draw_axis_z(const curvature_chart *chart, cairo_t *cairo, double left)
{
	double u = chart->unit;
	const profile_scale *scale = &chart->profile;
	paper_ticks ticks = paper_choose_ticks(chart->mesh->low[2], chart->mesh->high[2], 5);
	for (long tick = ticks.first; tick <= ticks.last; tick++) {
		double z = ticks.step * (double)tick * scale->pixels_per_m * scale->exaggeration;
		double y = scale->z_top - z;
		char number[64];
		paper_tick_text(&ticks, tick, false, number, sizeof number);
		cairo_set_source_rgb(cairo, faint.red, faint.green, faint.blue);
		cairo_move_to(cairo, left - 12.0 * u, y);
		cairo_line_to(cairo, left - 4.0 * u, y);
		cairo_stroke(cairo);
		paper_text style = text_at(chart, left - 16.0 * u, y + 6.0 * u, 18.0, PAPER_RIGHT, medium);
		style.width = left - 20.0 * u;
		paper_write(cairo, &style, number);
	}
}

static void draw_profile_notes(const curvature_chart *chart, cairo_t *cairo)
{
	double u = chart->unit;
	const profile_scale *scale = &chart->profile;
	double down = scale->pixels_per_m * scale->exaggeration;
	double bottom = scale->z_top - chart->mesh->low[2] * down;
	double left = scale->x_left + chart->mesh->low[0] * scale->pixels_per_m;
	cairo_set_line_width(cairo, 1.5 * u);
	draw_axis_x(chart, cairo, bottom);
	draw_axis_z(chart, cairo, left);
	const picture_rectangle *view = &chart->views[CHART_PROFILE];
	char line[128];
	if (scale->exaggeration > 1.0)
		(void)snprintf(line, sizeof line, "profile, bow to the right, heights \u00d7 %d; x, z in m",
		               (int)scale->exaggeration);
	else
		(void)snprintf(line, sizeof line, "profile, bow to the right; x, z in m");
	paper_text style = text_at(chart, view->left + 0.5 * view->width, bottom + 60.0 * u, 20.0,
	                           PAPER_CENTRE, dark);
	style.width = view->width;
	paper_write(cairo, &style, line);
}

static void draw_caption(const curvature_chart *chart, cairo_t *cairo, chart_view which,
                         const char *text)
{
	const picture_rectangle *view = &chart->views[which];
	paper_text style = text_at(chart, view->left + 0.5 * view->width,
	                           view->top + view->height + 30.0 * chart->unit, 20.0, PAPER_CENTRE,
	                           dark);
	style.width = view->width;
	paper_write(cairo, &style, text);
}

void curvature_chart_draw(const curvature_chart *chart, cairo_t *cairo)
{
	draw_header(chart, cairo);
	draw_colour_bar(chart, cairo);
	draw_profile_notes(chart, cairo);
	draw_caption(chart, cairo, CHART_STERN, "from the starboard quarter, below");
	draw_caption(chart, cairo, CHART_BOW, "from the starboard bow, below");
}
