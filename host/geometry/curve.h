/* One line in one of its representations: batten_curve. curve_forms makes them, curve evaluates and
 * measures the geometry of a place, curve_measure that of the whole. */
#ifndef BATTEN_GEOMETRY_CURVE_H
#define BATTEN_GEOMETRY_CURVE_H

#include "core/spline.h"
#include "geometry/bspline.h"
#include "geometry/points.h"
#include "geometry/polynomial.h"

struct batten_curve {
	batten_context *context; /* whose memory it is */
	char *label;
	batten_curve_form form;
	size_t dimension, count; /* of the given points */
	double *points;          /* [count][dimension] */
	double *parameters;      /* [count]: where the curve answers to each of them */
	bool by_x;               /* x is the parameter, exactly */
	size_t break_count;
	double *breaks;
	double size;       /* length of all chords, > 0 */
	double mean_speed; /* size by the range of the parameter */
	/* What the form needs. */
	struct polynomial polynomial;
	struct spline splines[3];
	double *slopes; /* [count][dimension] */
	struct bspline_curve bspline;
	double bspline_first, bspline_scale; /* its own parameter is (t - first) * scale */
};

/* Point and derivatives by t, coordinates beyond the dimension 0. */
void curve_derivatives(const batten_curve *curve, double t, double out[4][3]);

/* The geometry of a place from its derivatives. */
void curve_frame(const batten_curve *curve, batten_curve_point *point);

/* Makes what the form needs, and the breaks; label, points, parameters and size are there. Errors: as
 * batten_curve_create(). */
batten_status curve_forms_make(batten_curve *curve, const batten_curve_options *options);

/* Moves the parameters of a polygon's points to the nearest places of the part each governs. */
void curve_find_nearest(batten_curve *curve);

/* The place within low..high where value is largest, value rising to it and falling from it. */
typedef double curve_value_at(const batten_curve *curve, double t, const void *data);
double curve_find_largest(const batten_curve *curve, double low, double high, curve_value_at *value,
                          const void *data);

#endif
