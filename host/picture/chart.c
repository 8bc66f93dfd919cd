#include "picture/chart.h"

#include "picture/paper.h"
#include "picture/svg_file.h"

#include <math.h>

static const double width = 1600, height = 1000;
static const double left = 120, top = 130, bottom = 900;
static const paper_ink dark = { 0.10, 0.12, 0.15 };
static const paper_ink medium = { 0.33, 0.36, 0.40 };
static const paper_ink faint = { 0.85, 0.87, 0.89 };

/* Distinct under the common colour-vision deficiencies (Okabe and Ito); then dashed. */
static const paper_ink inks[] = {
	{ 0.00, 0.45, 0.70 }, { 0.84, 0.37, 0.00 }, { 0.00, 0.62, 0.45 }, { 0.80, 0.47, 0.65 },
	{ 0.34, 0.71, 0.91 }, { 0.90, 0.62, 0.00 }, { 0.10, 0.12, 0.15 },
};
enum { INK_COUNT = (int)(sizeof inks / sizeof inks[0]) };

static void set_ink(cairo_t *cairo, paper_ink ink)
{
	cairo_set_source_rgb(cairo, ink.red, ink.green, ink.blue);
}

/* Where the axes end: the legend is to the right of it, if there is one. */
static double right_of(const struct chart *chart)
{
	for (size_t i = 0; i < chart->count; i++)
		if (chart->curves[i].label[0])
			return 1120;
	return 1540;
}

static double across(const struct chart *chart, double x)
{
	return left + (right_of(chart) - left) * (x - chart->x_low) / (chart->x_high - chart->x_low);
}

static double down(const struct chart *chart, double y)
{
	return bottom - (bottom - top) * (y - chart->y_low) / (chart->y_high - chart->y_low);
}

static void draw_rule(cairo_t *cairo, double x0, double y0, double x1, double y1)
{
	set_ink(cairo, faint);
	cairo_move_to(cairo, x0, y0);
	cairo_line_to(cairo, x1, y1);
	cairo_stroke(cairo);
}

static void draw_axes(const struct chart *chart, cairo_t *cairo)
{
	const double right = right_of(chart);
	char number[64];
	cairo_set_line_width(cairo, 1.0);
	paper_ticks ticks = paper_choose_ticks(chart->x_low, chart->x_high, 12);
	for (long tick = ticks.first; tick <= ticks.last; tick++) {
		double x = across(chart, ticks.step * (double)tick);
		draw_rule(cairo, x, top, x, bottom);
		paper_tick_text(&ticks, tick, false, number, sizeof number);
		paper_text style = {
			.x = x, .y = bottom + 28, .size = 18, .anchor = PAPER_CENTRE, .ink = medium
		};
		paper_write(cairo, &style, number);
	}
	ticks = paper_choose_ticks(chart->y_low, chart->y_high, 12);
	for (long tick = ticks.first; tick <= ticks.last; tick++) {
		double y = down(chart, ticks.step * (double)tick);
		draw_rule(cairo, left, y, right, y);
		paper_tick_text(&ticks, tick, false, number, sizeof number);
		paper_text style = {
			.x = left - 12, .y = y + 6, .size = 18, .anchor = PAPER_RIGHT, .ink = medium
		};
		paper_write(cairo, &style, number);
	}
	paper_text style = { .x = 0.5 * (left + right),
		                 .y = bottom + 64,
		                 .size = 21,
		                 .width = right - left,
		                 .anchor = PAPER_CENTRE,
		                 .ink = dark };
	paper_write(cairo, &style, chart->x_title);
	style = (paper_text){ .x = left - 60, .y = top - 18, .size = 21, .width = 900, .ink = dark };
	paper_write(cairo, &style, chart->y_title);
}

static void set_pen(cairo_t *cairo, size_t curve)
{
	static const double dashes[] = { 14, 6 }, dots[] = { 3, 5 };
	set_ink(cairo, inks[curve % INK_COUNT]);
	cairo_set_line_width(cairo, 2.2);
	size_t round = curve / INK_COUNT % 3;
	cairo_set_dash(cairo, round == 2 ? dots : dashes, round == 0 ? 0 : 2, 0);
}

static void draw_curve(const struct chart *chart, cairo_t *cairo, const chart_curve *curve)
{
	bool begun = false;
	for (size_t i = 0; i < curve->count; i++) {
		double x = across(chart, curve->x[i * curve->x_stride] * curve->scale + curve->to);
		double y = down(chart, curve->y[i * curve->y_stride]);
		if (!isfinite(x) || !isfinite(y)) {
			begun = false;
			continue;
		}
		if (begun)
			cairo_line_to(cairo, x, y);
		else
			cairo_move_to(cairo, x, y);
		begun = true;
	}
	cairo_stroke(cairo);
}

static void draw_dots(const struct chart *chart, cairo_t *cairo, const chart_curve *curve)
{
	for (size_t i = 0; i < curve->count; i++) {
		const double x = across(chart, curve->x[i * curve->x_stride] * curve->scale + curve->to);
		const double y = down(chart, curve->y[i * curve->y_stride]);
		if (!isfinite(x) || !isfinite(y))
			continue;
		cairo_arc(cairo, x, y, 4.5, 0.0, 2.0 * acos(-1.0));
		cairo_fill(cairo);
	}
}

static void draw_curves(const struct chart *chart, cairo_t *cairo)
{
	const double right = right_of(chart);
	double y = top + 16;
	size_t pen = 0;
	for (size_t i = 0; i < chart->count; i++) {
		const chart_curve *curve = &chart->curves[i];
		set_pen(cairo, pen);
		draw_curve(chart, cairo, curve);
		if (curve->dotted)
			draw_dots(chart, cairo, curve);
		if (curve->label[0]) {
			cairo_move_to(cairo, right + 36, y - 6);
			cairo_line_to(cairo, right + 90, y - 6);
			cairo_stroke(cairo);
			paper_text style = { .x = right + 104, .y = y, .size = 18, .width = 360, .ink = dark };
			paper_write(cairo, &style, curve->label);
			y += 28;
			pen++;
		}
	}
	cairo_set_dash(cairo, NULL, 0, 0);
}

batten_status chart_write(batten_context *context, const struct chart *chart, const char *path)
{
	svg_file svg;
	batten_status status = svg_file_begin(context, width, height, &svg);
	if (status != BATTEN_OK)
		return status;
	char title[256];
	cairo_set_source_rgb(svg.cairo, 1, 1, 1);
	cairo_paint(svg.cairo);
	paper_clean_text(chart->name, title, sizeof title);
	paper_text style = { .x = 40, .y = 50, .size = 34, .width = 1500, .bold = true, .ink = dark };
	paper_write(svg.cairo, &style, title);
	style = (paper_text){ .x = 40, .y = 82, .size = 21, .width = 1500, .ink = medium };
	paper_write(svg.cairo, &style, chart->subtitle);
	draw_axes(chart, svg.cairo);
	draw_curves(chart, svg.cairo);
	return svg_file_end(&svg, path);
}
