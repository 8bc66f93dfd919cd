/* A chart of curves over two axes. */
#ifndef BATTEN_PICTURE_CHART_H
#define BATTEN_PICTURE_CHART_H

#include "core/context.h"

/* One curve; places that are not finite break it. */
typedef struct chart_curve {
	size_t count;
	const double *x, *y;
	size_t x_stride, y_stride; /* in numbers */
	double scale, to;          /* drawn at x * scale + to */
	bool dotted;               /* with a dot at each place */
	char label[96];            /* in the legend; "" leaves it out */
} chart_curve;

struct chart {
	const char *name, *subtitle, *x_title, *y_title;
	size_t count;
	const chart_curve *curves;
	double x_low, x_high, y_low, y_high; /* low < high, finite */
};

/* Draws and writes it as SVG, at once or not at all. Errors: IO, MEMORY, INTERNAL. */
batten_status chart_write(batten_context *context, const struct chart *chart, const char *path);

#endif
