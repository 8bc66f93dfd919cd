/* The page of a curvature map: where its views lie, and all that is not the hull itself. */
#ifndef BATTEN_PICTURE_CURVATURE_CHART_H
#define BATTEN_PICTURE_CURVATURE_CHART_H

#include "picture/paper.h"
#include "picture/view.h"

typedef enum chart_view { CHART_PROFILE, CHART_BOW, CHART_STERN, CHART_VIEW_COUNT } chart_view;

typedef struct curvature_chart {
	double width, height; /* pixels */
	double unit;          /* pixels of one unit of the design, which is 1600 x 900 */
	picture_rectangle views[CHART_VIEW_COUNT];
	picture_rectangle colour_bar;
	profile_scale profile; /* of the side view, set once its hull is known */
	const batten_hull *hull;
	const picture_mesh *mesh;
	const picture_colour_map *colours;
	const char *title; /* clean */
	double scale_per_m;
} curvature_chart;

/* Divides the page. */
void curvature_chart_lay_out(curvature_chart *chart, unsigned width, unsigned height);
/* Draws title, colour bar, axes and notes over the rendered views. */
void curvature_chart_draw(const curvature_chart *chart, cairo_t *cairo);

#endif
