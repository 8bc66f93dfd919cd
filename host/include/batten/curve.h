/* batten.h, one part of it: one line, represented in several ways. */
#ifndef BATTEN_CURVE_H
#define BATTEN_CURVE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Curves: one line, represented in several ways
 * --------------------------------------------------------------------------------------------- */

/* The points of one line in their order: in the plane (x, y) or in space (x, y, z). */
typedef struct batten_points batten_points;

/* Reads a line file (data/README.md describes the format). Errors: IO, INPUT (naming file, line,
 * column, what was found and what was expected), MEMORY. */
BATTEN_API batten_status batten_points_read(batten_context *context, const char *path,
                                            batten_points **out);
/* Same, from memory; name stands for the file in messages. */
BATTEN_API batten_status batten_points_parse(batten_context *context, const char *name,
                                             const char *text, size_t length, batten_points **out);

/* Copies count points [count][dimension], dimension 2 or 3, count 2..4096, within 1e6 m, each at
 * least 1e-9 m from the one before. name may be NULL: "". Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_points_create(batten_context *context, const char *name,
                                              size_t dimension, size_t count,
                                              const double *points_m, batten_points **out);
BATTEN_API void batten_points_destroy(batten_points *points);

/* Borrowed views, valid while the points live. */
BATTEN_API const char *batten_points_name(const batten_points *points);
BATTEN_API const char *batten_points_source(const batten_points *points); /* "" when not given */
BATTEN_API const char *batten_points_unit(const batten_points *points);   /* "m", "mm" or "ft" */
BATTEN_API size_t batten_points_dimension(const batten_points *points);
BATTEN_API size_t batten_points_count(const batten_points *points);
BATTEN_API const double *batten_points_m(const batten_points *points); /* [count][dimension] */

/* How a curve is made from points (thesis 3.1, 3.2), and whether it goes through them. */
#define BATTEN_CURVE_FORM_LIST(X)                                                                  \
	X(MONOMIAL, "monomial", "one polynomial in powers, by Vandermonde's system")                   \
	X(LAGRANGE, "lagrange", "one polynomial from Lagrange's basis")                                \
	X(NEWTON, "newton", "one polynomial from divided differences")                                 \
	X(HERMITE, "hermite", "piecewise cubic by points and slopes")                                  \
	X(LEAST_SQUARES, "least-squares", "one polynomial of given degree, near the points")           \
	X(SPLINE, "spline", "cubic spline")                                                            \
	X(BEZIER, "bezier", "Bezier curve, the points its polygon")                                    \
	X(BSPLINE, "bspline", "B-spline, the points its polygon (thesis 5.2)")                         \
	X(BSPLINE_FIT, "bspline-fit", "B-spline near the points by least squares, ends held")

typedef enum batten_curve_form {
#define BATTEN_CURVE_FORM_ENTRY(name, word, text) BATTEN_CURVE_##name,
	BATTEN_CURVE_FORM_LIST(BATTEN_CURVE_FORM_ENTRY)
#undef BATTEN_CURVE_FORM_ENTRY
} batten_curve_form;

/* The parameter of the points (Letcher 3.5). The curves of a polygon (BEZIER, BSPLINE) have their
 * own, 0 .. count - order + 1. */
typedef enum batten_curve_parameter {
	BATTEN_PARAMETER_CHORD,   /* cumulative length of the chords, in metres */
	BATTEN_PARAMETER_UNIFORM, /* 0, 1, 2 ... */
	BATTEN_PARAMETER_X,       /* x itself, which must ascend: y(x) and z(x) */
	BATTEN_PARAMETER_GIVEN,   /* by the caller */
} batten_curve_parameter;

/* What holds at an end of a spline (Letcher 3.5). */
typedef enum batten_curve_end_kind {
	BATTEN_END_NATURAL,    /* second derivative 0 */
	BATTEN_END_NOT_A_KNOT, /* third derivative continuous at the point next to it */
	BATTEN_END_CLAMPED,    /* tangent given */
	BATTEN_END_CURVATURE,  /* curvature given, found by iteration */
} batten_curve_end_kind;
typedef struct batten_curve_end {
	batten_curve_end_kind kind;
	/* CLAMPED: direction of the tangent along the curve, of any length; all 0 takes that of the
	 * parabola through the three points at the end. */
	double tangent[3];
	/* CURVATURE: in the plane [0] is the curvature, positive to the left; in space the vector that
	 * points to the centre, of which the part across the tangent counts. */
	double curvature_per_m[3];
} batten_curve_end;

typedef struct batten_curve_options {
	size_t struct_size;
	batten_curve_form form;           /* SPLINE */
	batten_curve_parameter parameter; /* CHORD */
	const double *parameters;         /* GIVEN: [count], ascending; borrowed for the call */
	size_t order;      /* degree + 1 of LEAST_SQUARES (1..32), BSPLINE, BSPLINE_FIT (2..8); 4 */
	size_t pole_count; /* BSPLINE_FIT: order..count; 0: as many as points, through them */
	batten_curve_end ends[2]; /* SPLINE, first and last: NATURAL */
	const double *slopes; /* HERMITE: derivatives by the parameter, [count][dimension]; NULL takes
	                             those of the parabolas through three points */
	const char *label;    /* NULL takes the form's word */
} batten_curve_options;
BATTEN_API void batten_curve_options_default(batten_curve_options *options);

typedef struct batten_curve batten_curve;

/* The points are copied; options may be NULL. One polynomial takes at most 64 points. Errors: USAGE
 * (orders, parameters, x that does not ascend, too many points), INPUT (equations that cannot be
 * told from dependent ones, an end curvature that no spline has), MEMORY. */
BATTEN_API batten_status batten_curve_create(batten_context *context, const batten_points *points,
                                             const batten_curve_options *options,
                                             batten_curve **out);
BATTEN_API void batten_curve_destroy(batten_curve *curve);

/* Borrowed views, valid while the curve lives. */
BATTEN_API const char *batten_curve_label(const batten_curve *curve);
BATTEN_API size_t batten_curve_dimension(const batten_curve *curve);
/* The range of its parameter, and the places between which it is one polynomial, both ends
 * included (a single polynomial: those of its points). */
BATTEN_API void batten_curve_range(const batten_curve *curve, double *first, double *last);
BATTEN_API size_t batten_curve_break_count(const batten_curve *curve);
BATTEN_API const double *batten_curve_breaks(const batten_curve *curve);

/* A place on a curve (Letcher 3.2, geometry by Frenet). At a break the piece that begins there. */
typedef struct batten_curve_point {
	double t;
	double derivative[4][3]; /* by t: x, y, z; [0] is the point */
	bool regular;            /* the tangent exists; else all below is 0 */
	double tangent[3],
		normal[3];          /* units; in the plane the normal points to the left; in space to */
	double binormal[3];     /* the centre of curvature, 0 where there is none */
	double speed;           /* metres by t */
	double curvature_per_m; /* in the plane positive to the left, in space >= 0 */
	double curvature_rate_per_m2; /* its derivative by the arc length */
	double torsion_per_m;         /* 0 in the plane and where the curvature is 0 */
} batten_curve_point;

/* Beyond its range a curve goes on as its first or last piece. Errors: USAGE (t is not finite). */
BATTEN_API batten_status batten_curve_evaluate(const batten_curve *curve, double t,
                                               batten_curve_point *out);

/* Arc length between two parameters (b < a: the negative). Errors: USAGE. */
BATTEN_API batten_status batten_curve_length(const batten_curve *curve, double a, double b,
                                             double *length_m);

/* The given points and how the curve keeps to them. */
typedef struct batten_curve_datum {
	batten_curve_point at; /* the curve at the point's parameter; polygon forms: nearest to it */
	double deviation_m;    /* from the given point */
} batten_curve_datum;
/* data is the caller's, one entry a point. */
BATTEN_API void batten_curve_data(const batten_curve *curve, batten_curve_datum *data);

/* Measures of a curve (thesis 4.4); what does not exist is NaN (null in JSON). */
#define BATTEN_CURVE_MEASURE_LIST(X)                                                               \
	X(deviation_max_m, "largest distance of a given point from the curve")                         \
	X(deviation_rms_m, "root mean square of these distances")                                      \
	X(length_m, "arc length")                                                                      \
	X(curvature_max_per_m, "largest |curvature|")                                                  \
	X(inflections, "sign changes of the curvature; not in space")                                  \
	X(monotone_pieces, "pieces on which the curvature is monotone (Farin and Sapidis 1989)")       \
	X(curvature_rate_max_per_m2, "largest |dk/ds| (Birkhoff 1933)")                                \
	X(energy_bending_per_m, "integral of k^2 ds (Roulier and Rando 1994)")                         \
	X(energy_mvc_per_m3, "integral of (dk/ds)^2 ds; not where the curvature jumps")                \
	X(curvature_jump_per_m, "largest jump of the curvature")                                       \
	X(kink_max_deg, "largest angle between the tangents at a break")                               \
	X(torsion_max_per_m, "largest |torsion|; in space")

typedef struct batten_curve_measures {
#define BATTEN_CURVE_MEASURE_FIELD(name, text) double name;
	BATTEN_CURVE_MEASURE_LIST(BATTEN_CURVE_MEASURE_FIELD)
#undef BATTEN_CURVE_MEASURE_FIELD
} batten_curve_measures;

enum { BATTEN_CURVE_MEASURE_COUNT = (int)(sizeof(batten_curve_measures) / sizeof(double)) };

/* Name and meaning of measure number i, as batten_measure_name(). */
BATTEN_API const char *batten_curve_measure_name(size_t i);
BATTEN_API const char *batten_curve_measure_text(size_t i);

/* Integrals by adaptive Gauss quadrature to 1e-10 of themselves; extremes by 32 samples a piece, then
 * by search about the largest. Errors: MEMORY. */
BATTEN_API batten_status batten_curve_measure(batten_context *context, const batten_curve *curve,
                                              batten_curve_measures *out);

/* Points of the curve at count (2..1000000) parameters evenly spread over its range, as a line file
 * in metres. Errors: USAGE, IO, MEMORY. */
BATTEN_API batten_status batten_curve_write(batten_context *context, const batten_curve *curve,
                                            size_t count, const char *path);

#ifdef __cplusplus
}
#endif

#endif
