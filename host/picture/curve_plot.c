/* Curves with their porcupines, and their curvature over the arc length (Letcher 3.3). */
#include "core/number.h"
#include "geometry/curve.h"
#include "picture/paper.h"
#include "picture/svg_file.h"
#include "picture/view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PAGE_WIDTH 1600.0
#define PAGE_HEIGHT 1150.0

enum { CURVES_MOST = 8, SAMPLES = 600, NEEDLE_EVERY = 4 };

/* Colours that stay apart under the common colour-vision deficiencies (Okabe and Ito). */
static const paper_ink inks[CURVES_MOST] = { { 0.00, 0.45, 0.70 }, { 0.84, 0.37, 0.00 },
	                                         { 0.00, 0.62, 0.45 }, { 0.80, 0.47, 0.65 },
	                                         { 0.90, 0.62, 0.00 }, { 0.34, 0.71, 0.91 },
	                                         { 0.45, 0.35, 0.20 }, { 0.35, 0.35, 0.35 } };
static const paper_ink ink_text = { 0.10, 0.12, 0.15 };
static const paper_ink ink_grid = { 0.85, 0.87, 0.89 };

struct sample {
	double place[3], normal[3];
	double arc, curvature;
};

/* A rectangle of paper with axes. */
struct panel {
	picture_rectangle frame;
	double x_low, x_high, y_low, y_high;
};

struct plot {
	cairo_t *cairo;
	size_t count;
	const batten_curve *const *curves;
	const batten_points *points;
	struct sample *samples; /* [count][SAMPLES] */
	double curvature_shown; /* |curvature| at the panel's edge */
	double needle;          /* metres of porcupine a unit of curvature */
	bool clipped;
};

static double paper_x(const struct panel *panel, double x)
{
	return panel->frame.left +
	       panel->frame.width * (x - panel->x_low) / (panel->x_high - panel->x_low);
}

static double paper_y(const struct panel *panel, double y)
{
	return panel->frame.top + panel->frame.height -
	       panel->frame.height * (y - panel->y_low) / (panel->y_high - panel->y_low);
}

static void use_ink(cairo_t *cairo, paper_ink ink, double opacity)
{
	cairo_set_source_rgba(cairo, ink.red, ink.green, ink.blue, opacity);
}

/* ------------------------------------------------------------------------------------------------
 * Samples
 * --------------------------------------------------------------------------------------------- */

static void sample_curve(const batten_curve *curve, struct sample *samples)
{
	double first = 0, last = 0;
	batten_curve_range(curve, &first, &last);
	for (size_t i = 0; i < SAMPLES; i++) {
		double part = (double)i / (SAMPLES - 1);
		batten_curve_point point = { .t = first + part * (last - first) };
		curve_derivatives(curve, point.t, point.derivative);
		curve_frame(curve, &point);
		memcpy(samples[i].place, point.derivative[0], sizeof samples[i].place);
		memcpy(samples[i].normal, point.normal, sizeof samples[i].normal);
		samples[i].curvature = point.curvature_per_m;
		double square = 0;
		for (size_t c = 0; c < 3 && i > 0; c++) {
			double step = samples[i].place[c] - samples[i - 1].place[c];
			square += step * step;
		}
		samples[i].arc = i > 0 ? samples[i - 1].arc + sqrt(square) : 0;
	}
}

/* What 97 of 100 samples of every curve stay within, of the tamest curve three times at most: one wild
 * representation leaves the others to be seen. */
static batten_status choose_curvature(batten_context *context, struct plot *plot)
{
	double *sizes = batten_allocate(context, SAMPLES, sizeof *sizes);
	if (!sizes)
		return BATTEN_MEMORY;
	double tamest = INFINITY, wildest = 0, largest = 0;
	for (size_t k = 0; k < plot->count; k++) {
		for (size_t i = 0; i < SAMPLES; i++)
			sizes[i] = fabs(plot->samples[k * SAMPLES + i].curvature);
		qsort(sizes, SAMPLES, sizeof *sizes, batten_number_compare);
		double most = sizes[SAMPLES - 1 - SAMPLES * 3 / 100];
		tamest = fmin(tamest, most);
		wildest = fmax(wildest, most);
		largest = fmax(largest, sizes[SAMPLES - 1]);
	}
	batten_release(context, sizes);
	double shown = tamest > 0 ? fmin(wildest, 3 * tamest) : wildest;
	if (largest <= 1.4 * shown)
		shown = largest;
	plot->clipped = largest > 1.1 * shown;
	plot->curvature_shown = shown > 0 ? 1.1 * shown : 1;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Panels
 * --------------------------------------------------------------------------------------------- */

static void draw_axes(const struct plot *plot, const struct panel *panel, const char *title)
{
	cairo_t *cairo = plot->cairo;
	const picture_rectangle *frame = &panel->frame;
	paper_text label = { .size = 18.0, .anchor = PAPER_CENTRE, .ink = ink_text };
	char text[48];
	paper_ticks ticks = paper_choose_ticks(panel->x_low, panel->x_high, 12);
	cairo_set_line_width(cairo, 1.0);
	for (long tick = ticks.first; tick <= ticks.last; tick++) {
		label.x = paper_x(panel, ticks.step * (double)tick);
		label.y = frame->top + frame->height + 26.0;
		use_ink(cairo, ink_grid, 1.0);
		cairo_move_to(cairo, label.x, frame->top);
		cairo_line_to(cairo, label.x, frame->top + frame->height);
		cairo_stroke(cairo);
		paper_tick_text(&ticks, tick, false, text, sizeof text);
		paper_write(cairo, &label, text);
	}
	ticks = paper_choose_ticks(panel->y_low, panel->y_high, 7);
	label.anchor = PAPER_RIGHT;
	for (long tick = ticks.first; tick <= ticks.last; tick++) {
		double y = paper_y(panel, ticks.step * (double)tick);
		use_ink(cairo, tick == 0 ? ink_text : ink_grid, tick == 0 ? 0.6 : 1.0);
		cairo_move_to(cairo, frame->left, y);
		cairo_line_to(cairo, frame->left + frame->width, y);
		cairo_stroke(cairo);
		label.x = frame->left - 12.0;
		label.y = y + 6.0;
		paper_tick_text(&ticks, tick, false, text, sizeof text);
		paper_write(cairo, &label, text);
	}
	paper_text heading = { .x = frame->left,
		                   .y = frame->top - 14.0,
		                   .size = 20.0,
		                   .width = frame->width,
		                   .ink = ink_text };
	paper_write(cairo, &heading, title);
}

/* The needle's end, cut where the curvature is cut. */
static double needle_length(const struct plot *plot, double curvature)
{
	double most = plot->curvature_shown;
	return plot->needle * fmax(-most, fmin(most, curvature));
}

/* Needles point away from the centre of curvature, up the page for the curves that bend down. */
static void trace_needles(const struct plot *plot, const struct panel *panel, size_t down,
                          const struct sample *samples)
{
	for (size_t i = 0; i < SAMPLES; i++) {
		double length = needle_length(plot, samples[i].curvature);
		double x = samples[i].place[0] - length * samples[i].normal[0];
		double y = samples[i].place[down] - length * samples[i].normal[down];
		if (i % NEEDLE_EVERY == 0) {
			cairo_move_to(plot->cairo, paper_x(panel, samples[i].place[0]),
			              paper_y(panel, samples[i].place[down]));
			cairo_line_to(plot->cairo, paper_x(panel, x), paper_y(panel, y));
		}
	}
}

static void draw_line(const struct plot *plot, const struct panel *panel, size_t down, size_t k)
{
	cairo_t *cairo = plot->cairo;
	const struct sample *samples = plot->samples + k * SAMPLES;
	trace_needles(plot, panel, down, samples);
	use_ink(cairo, inks[k], 0.35);
	cairo_set_line_width(cairo, 1.0);
	cairo_stroke(cairo);
	for (size_t i = 0; i < SAMPLES; i++) {
		double length = needle_length(plot, samples[i].curvature);
		cairo_line_to(cairo, paper_x(panel, samples[i].place[0] - length * samples[i].normal[0]),
		              paper_y(panel, samples[i].place[down] - length * samples[i].normal[down]));
	}
	use_ink(cairo, inks[k], 0.6);
	cairo_stroke(cairo);
	for (size_t i = 0; i < SAMPLES; i++)
		cairo_line_to(cairo, paper_x(panel, samples[i].place[0]),
		              paper_y(panel, samples[i].place[down]));
	use_ink(cairo, inks[k], 1.0);
	cairo_set_line_width(cairo, 2.6);
	cairo_stroke(cairo);
}

/* One view of the line: x to the right, y or z up. */
static void draw_view(const struct plot *plot, const struct panel *panel, size_t down,
                      const char *title)
{
	cairo_t *cairo = plot->cairo;
	const picture_rectangle *frame = &panel->frame;
	draw_axes(plot, panel, title);
	cairo_save(cairo);
	cairo_rectangle(cairo, frame->left, frame->top, frame->width, frame->height);
	cairo_clip(cairo);
	for (size_t k = 0; k < plot->count; k++)
		draw_line(plot, panel, down, k);
	use_ink(cairo, ink_text, 1.0);
	for (size_t i = 0; i < plot->points->count; i++) {
		const double *m = plot->points->m + i * plot->points->dimension;
		cairo_new_sub_path(cairo);
		cairo_arc(cairo, paper_x(panel, m[0]), paper_y(panel, m[down]), 4.0, 0.0, 6.2831853);
		cairo_fill(cairo);
	}
	cairo_restore(cairo);
}

static void draw_curvature(const struct plot *plot, const struct panel *panel)
{
	cairo_t *cairo = plot->cairo;
	const picture_rectangle *frame = &panel->frame;
	draw_axes(plot, panel,
	          plot->clipped ? "curvature (1/m) over arc length (m); the largest are cut off"
	                        : "curvature (1/m) over arc length (m)");
	cairo_save(cairo);
	cairo_rectangle(cairo, frame->left, frame->top, frame->width, frame->height);
	cairo_clip(cairo);
	for (size_t k = 0; k < plot->count; k++) {
		const struct sample *samples = plot->samples + k * SAMPLES;
		double most = 20 * plot->curvature_shown;
		for (size_t i = 0; i < SAMPLES; i++)
			cairo_line_to(cairo, paper_x(panel, samples[i].arc),
			              paper_y(panel, fmax(-most, fmin(most, samples[i].curvature))));
		use_ink(cairo, inks[k], 1.0);
		cairo_set_line_width(cairo, 2.2);
		cairo_stroke(cairo);
	}
	cairo_restore(cairo);
}

/* ------------------------------------------------------------------------------------------------
 * The page
 * --------------------------------------------------------------------------------------------- */

/* Extent of the points, with room for needles of 0.15 of it, filled to the frame's shape. The scales
 * of both axes differ where a line is slender: heights are exaggerated by a whole number. */
static void fit_view(const struct plot *plot, struct panel *panel, size_t down,
                     unsigned *exaggeration)
{
	double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
	for (size_t i = 0; i < plot->points->count; i++)
		for (size_t a = 0; a < 2; a++) {
			double value = plot->points->m[i * plot->points->dimension + (a == 0 ? 0 : down)];
			low[a] = fmin(low[a], value);
			high[a] = fmax(high[a], value);
		}
	double width = high[0] - low[0], height = high[1] - low[1];
	double margin = plot->needle * plot->curvature_shown;
	double across = fmax(width, 1e-9) * 1.08;
	double scale = panel->frame.width / across;
	double room = panel->frame.height / (height + 2.2 * margin + 1e-9);
	if (room < scale)
		scale = room;
	*exaggeration = (unsigned)fmax(1, fmin(10, floor(room / scale)));
	double up = scale * *exaggeration;
	double middle_x = 0.5 * (low[0] + high[0]), middle_y = 0.5 * (low[1] + high[1]);
	panel->x_low = middle_x - 0.5 * panel->frame.width / scale;
	panel->x_high = middle_x + 0.5 * panel->frame.width / scale;
	panel->y_low = middle_y - 0.5 * panel->frame.height / up;
	panel->y_high = middle_y + 0.5 * panel->frame.height / up;
}

static void draw_header(const struct plot *plot)
{
	char title[256];
	paper_clean_text(plot->points->name, title, sizeof title);
	paper_text style = {
		.x = 110.0, .y = 52.0, .size = 32.0, .width = 1400.0, .bold = true, .ink = ink_text
	};
	paper_write(plot->cairo, &style, title);
	for (size_t k = 0; k < plot->count; k++) {
		char label[128];
		paper_clean_text(plot->curves[k]->label, label, sizeof label);
		paper_text entry = { .x = 166.0 + 360.0 * (double)(k % 4),
			                 .y = 92.0 + 30.0 * (double)(k / 4),
			                 .size = 20.0,
			                 .width = 290.0,
			                 .ink = ink_text };
		use_ink(plot->cairo, inks[k], 1.0);
		cairo_set_line_width(plot->cairo, 4.0);
		cairo_move_to(plot->cairo, entry.x - 56.0, entry.y - 7.0);
		cairo_line_to(plot->cairo, entry.x - 12.0, entry.y - 7.0);
		cairo_stroke(plot->cairo);
		paper_write(plot->cairo, &entry, label);
	}
}

static void draw_page(struct plot *plot)
{
	static const char *const names[] = { "", "y over x", "z over x" };
	size_t views = plot->points->dimension - 1;
	double height = (540.0 - 70.0 * (double)(views - 1)) / (double)views;
	double longest = 0, arc = 0;
	for (size_t k = 0; k < plot->count; k++)
		arc = fmax(arc, plot->samples[k * SAMPLES + SAMPLES - 1].arc);
	for (size_t i = 0; i < plot->points->count; i++)
		longest = fmax(longest,
		               fabs(plot->points->m[i * plot->points->dimension] - plot->points->m[0]));
	plot->needle = 0.06 * fmax(longest, 0.25 * plot->curves[0]->size) / plot->curvature_shown;
	draw_header(plot);
	for (size_t v = 0; v < views; v++) {
		char title[96];
		unsigned exaggeration = 1;
		struct panel panel = { .frame = { 110.0, 180.0 + (height + 70.0) * (double)v, 1440.0,
			                              height } };
		fit_view(plot, &panel, v + 1, &exaggeration);
		if (exaggeration > 1)
			(void)snprintf(title, sizeof title, "%s (m), heights %u times; needles: curvature",
			               names[v + 1], exaggeration);
		else
			(void)snprintf(title, sizeof title, "%s (m); needles: curvature", names[v + 1]);
		draw_view(plot, &panel, v + 1, title);
	}
	struct panel panel = { .frame = { 110.0, 800.0, 1440.0, 300.0 },
		                   .x_high = arc,
		                   .y_low = -plot->curvature_shown,
		                   .y_high = plot->curvature_shown };
	double low = 0, high = 0;
	for (size_t i = 0; i < plot->count * SAMPLES; i++) {
		low = fmin(low, plot->samples[i].curvature);
		high = fmax(high, plot->samples[i].curvature);
	}
	/* Curvature of one sign needs no room for the other. */
	panel.y_low = fmax(panel.y_low, low - 0.05 * plot->curvature_shown);
	panel.y_high = fmin(panel.y_high, high + 0.05 * plot->curvature_shown);
	draw_curvature(plot, &panel);
}

batten_status batten_picture_curves(batten_context *context, const batten_points *points,
                                    size_t count, const batten_curve *const *curves,
                                    const char *path)
{
	if (count < 1 || count > CURVES_MOST)
		return batten_fail(context, BATTEN_USAGE, "%zu curves in a picture, expected 1..%d", count,
		                   (int)CURVES_MOST);
	for (size_t k = 0; k < count; k++)
		if (curves[k]->dimension != points->dimension)
			return batten_fail(context, BATTEN_USAGE, "curves of different dimensions");
	struct plot plot = { .count = count, .curves = curves, .points = points };
	plot.samples = batten_allocate(context, count, SAMPLES * sizeof *plot.samples);
	if (!plot.samples)
		return BATTEN_MEMORY;
	for (size_t k = 0; k < count; k++)
		sample_curve(curves[k], plot.samples + k * SAMPLES);
	batten_status status = choose_curvature(context, &plot);
	svg_file svg;
	if (status == BATTEN_OK)
		status = svg_file_begin(context, PAGE_WIDTH, PAGE_HEIGHT, &svg);
	if (status == BATTEN_OK) {
		plot.cairo = svg.cairo;
		cairo_set_source_rgb(svg.cairo, 1.0, 1.0, 1.0);
		cairo_paint(svg.cairo);
		draw_page(&plot);
		status = svg_file_end(&svg, path);
	}
	batten_release(context, plot.samples);
	return status;
}
