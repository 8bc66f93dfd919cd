/* batten.h, one part of it: offset tables: made, read, written, filled, measured. */
#ifndef BATTEN_HULL_H
#define BATTEN_HULL_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Hulls: an offset table over stations (x) and waterlines (z)
 * --------------------------------------------------------------------------------------------- */

typedef struct batten_hull batten_hull;

/* What a node of the table is. */
typedef enum batten_node {
	BATTEN_NODE_OUTSIDE = 0, /* not on the hull: an empty cell */
	BATTEN_NODE_GIVEN = 1,   /* a half-breadth; 0 is a profile point (keel, stem, stern) */
	BATTEN_NODE_UNKNOWN = 2, /* on the hull, half-breadth not given: a cell '?'. Filled by a natural
	                            cubic spline along its waterline (along its section where the
	                            waterline has fewer than two given points), written as '?' again */
} batten_node;

/* Reads an offsets file (data/README.md describes the format). Errors: IO, INPUT (naming file, line,
 * column, what was found and what was expected), MEMORY. */
BATTEN_API batten_status batten_hull_read(batten_context *context, const char *path,
                                          batten_hull **out);

/* Same, from memory; name stands for the file in messages. */
BATTEN_API batten_status batten_hull_parse(batten_context *context, const char *name,
                                           const char *text, size_t length, batten_hull **out);

/* Makes a hull from arrays, in the frame ap-fwd and metres. x, z ascending and finite, 2..4096 each;
 * y and nodes are waterline-major: index waterline * station_count + station; y >= 0 and finite where
 * given, read nowhere else. nodes may be NULL: all given. lbp, draft > 0.
 * Errors: USAGE, MEMORY. */
typedef struct batten_hull_table {
	const char *name;
	double lbp_m, draft_m;
	size_t station_count, waterline_count;
	const double *x_m, *z_m, *y_m;
	const uint8_t *nodes;
} batten_hull_table;
BATTEN_API batten_status batten_hull_create(batten_context *context, const batten_hull_table *table,
                                            batten_hull **out);

/* Writes the hull in the layout, frame and unit it was read in. The file is replaced at once or not
 * at all. Errors: IO, MEMORY. */
BATTEN_API batten_status batten_hull_write(batten_context *context, const batten_hull *hull,
                                           const char *path);

BATTEN_API batten_status batten_hull_clone(batten_context *context, const batten_hull *hull,
                                           batten_hull **out);
BATTEN_API void batten_hull_destroy(batten_hull *hull);

/* Borrowed views, valid while the hull lives and is not written to. */
BATTEN_API const char *batten_hull_name(const batten_hull *hull);
BATTEN_API const char *batten_hull_source(const batten_hull *hull); /* "" when the file has none */
BATTEN_API const char *batten_hull_unit(const batten_hull *hull);   /* "m", "mm" or "ft" */
BATTEN_API const char *batten_hull_frame(const batten_hull *hull);  /* "ap-fwd", ... */
BATTEN_API const char *batten_hull_layout(const batten_hull *hull); /* "grid" or "long" */
BATTEN_API double batten_hull_lbp_m(const batten_hull *hull);
BATTEN_API double batten_hull_draft_m(const batten_hull *hull);
BATTEN_API size_t batten_hull_station_count(const batten_hull *hull);
BATTEN_API size_t batten_hull_waterline_count(const batten_hull *hull);
BATTEN_API const double *batten_hull_x_m(const batten_hull *hull);    /* [stations] */
BATTEN_API const double *batten_hull_z_m(const batten_hull *hull);    /* [waterlines] */
BATTEN_API const double *batten_hull_y_m(const batten_hull *hull);    /* [waterlines][stations] */
BATTEN_API const uint8_t *batten_hull_nodes(const batten_hull *hull); /* batten_node, as y */

/* Largest half-breadth of the table, line ends included (m): the h of all dimensionless figures. */
BATTEN_API double batten_hull_half_beam_m(const batten_hull *hull);

/* A place given in the frame and unit of the hull's file, as x and z inside. */
BATTEN_API void batten_hull_place(const batten_hull *hull, double file_x, double file_z,
                                  double *x_m, double *z_m);

/* Replaces the half-breadths of all nodes that are not outside. y_m as batten_hull_y_m().
 * Errors: USAGE (a negative or non-finite half-breadth). */
BATTEN_API batten_status batten_hull_set_y(batten_context *context, batten_hull *hull,
                                           const double *y_m);

/* ------------------------------------------------------------------------------------------------
 * Measures
 * --------------------------------------------------------------------------------------------- */

typedef enum batten_quadrature {
	BATTEN_QUADRATURE_SPLINE,    /* not-a-knot spline in z, natural spline in x */
	BATTEN_QUADRATURE_SIMPSON,   /* even number of equal intervals in both directions, else INPUT */
	BATTEN_QUADRATURE_TRAPEZOID, /* sums of trapezoids */
} batten_quadrature;

typedef struct batten_measure_options {
	size_t struct_size;
	double draft_m; /* 0 takes the hull's own */
	batten_quadrature quadrature;
	double density_t_per_m3; /* 1.025 */
} batten_measure_options;
BATTEN_API void batten_measure_options_default(batten_measure_options *options);

/* Every measure: its name, which carries unit and sign, and what it is. A measure that does not exist
 * for a hull is NaN (null in JSON). L of the coefficients is lbp_m, B is beam_wl_m.
 * Definitions: Letcher 9-11; fairness: thesis 4.4, 5 and 7. First what is known of a hull at a
 * draft, then what is known of it at any. */
#define BATTEN_FORM_LIST(X)                                                                        \
	X(lbp_m, "length between perpendiculars")                                                      \
	X(lwl_m, "length of the waterline at the draft")                                               \
	X(beam_wl_m, "largest breadth of the waterline at the draft")                                  \
	X(beam_max_m, "largest breadth of the table")                                                  \
	X(draft_m, "draft")                                                                            \
	X(half_beam_m, "largest half-breadth of the table, h")                                         \
	X(volume_m3, "moulded volume up to the draft")                                                 \
	X(displacement_t, "mass of the displaced water")                                               \
	X(wetted_surface_m2, "wetted surface, both sides, transom left out")                           \
	X(waterplane_area_m2, "area of the waterplane")                                                \
	X(midship_area_m2, "immersed section area amidships")                                          \
	X(max_section_area_m2, "largest immersed section area of the stations")                        \
	X(cb, "block coefficient, volume / (L B T)")                                                   \
	X(cp, "prismatic coefficient, volume / (L midship area)")                                      \
	X(cm, "midship coefficient, midship area / (B T)")                                             \
	X(cwp, "waterplane coefficient, waterplane area / (L B)")                                      \
	X(cv, "volumetric coefficient, 1000 volume / L^3")                                             \
	X(cws, "wetted surface / sqrt(volume L)")                                                      \
	X(lcb_pct_lbp_fwd, "centre of buoyancy from amidships, percent of LBP, + forward")             \
	X(xcb_from_ap_m, "centre of buoyancy from the aft perpendicular, + forward")                   \
	X(lcf_pct_lbp_fwd, "centre of flotation from amidships, percent of LBP, + forward")            \
	X(xcf_from_ap_m, "centre of flotation from the aft perpendicular, + forward")                  \
	X(kb_m, "centre of buoyancy above the baseline")                                               \
	X(bmt_m, "transverse metacentric radius")                                                      \
	X(bml_m, "longitudinal metacentric radius")                                                    \
	X(kmt_m, "transverse metacentre above the baseline")                                           \
	X(kml_m, "longitudinal metacentre above the baseline")                                         \
	X(i_t_m4, "transverse second moment of the waterplane")                                        \
	X(i_l_m4, "longitudinal second moment of the waterplane about its centre")                     \
	X(tpc_t_per_cm, "tonnes per centimetre immersion")

#define BATTEN_MEASURE_LIST(X)                                                                     \
	BATTEN_FORM_LIST(X)                                                                            \
	X(fn_per_m2, "fairness number: sum of squared second derivatives over all waterlines")         \
	X(fn_sections_per_m2, "the same over all sections")                                            \
	X(energy_bending, "sum of (k1^2 + k2^2) dS over the nodes inside the hull")                    \
	X(energy_mean, "sum of H^2 dS")                                                                \
	X(energy_gauss, "sum of |K| dS")                                                               \
	X(energy_mvc_per_m2, "sum of ((dk1/de1)^2 + (dk2/de2)^2) dS, each along its own direction")    \
	X(noise_m, "robust estimate of the noise of the offsets")                                      \
	X(inflections, "sign changes of the second derivative over all waterlines and sections")

typedef struct batten_measures {
#define BATTEN_MEASURE_FIELD(name, text) double name;
	BATTEN_MEASURE_LIST(BATTEN_MEASURE_FIELD)
#undef BATTEN_MEASURE_FIELD
} batten_measures;

enum { BATTEN_MEASURE_COUNT = (int)(sizeof(batten_measures) / sizeof(double)) };

/* Name and meaning of measure number i (0..BATTEN_MEASURE_COUNT-1, the order of the struct); NULL
 * beyond. */
BATTEN_API const char *batten_measure_name(size_t i);
BATTEN_API const char *batten_measure_text(size_t i);

/* options may be NULL. Errors: USAGE (a draft asked for outside the table), INPUT (the hull's own draft
 * outside its table, a rule whose conditions do not hold), MEMORY. */
BATTEN_API batten_status batten_hull_measure(batten_context *context, const batten_hull *hull,
                                             const batten_measure_options *options,
                                             batten_measures *out);

/* How one hull differs from the one it was faired from, both on the same table; '?' cells do not
 * count. */
typedef struct batten_closeness {
	double cn_pct;       /* 100 max |y - y0| / h, h of the reference */
	double cn_max_m;     /* max |y - y0| */
	double cn_rms_m;     /* root of the mean of (y - y0)^2 over the nodes given and > 0 in either */
	double closeness_m4; /* sum of (y - y0)^2 dx dz */
} batten_closeness;
BATTEN_API batten_status batten_hull_closeness(batten_context *context, const batten_hull *hull,
                                               const batten_hull *reference, batten_closeness *out);

/* One line of a hull and how fair it is. */
typedef enum batten_line_kind {
	BATTEN_LINE_STATION,   /* y against z at one x */
	BATTEN_LINE_WATERLINE, /* y against x at one z */
	BATTEN_LINE_BUTTOCK,   /* z against x at one y */
	BATTEN_LINE_DIAGONAL,  /* distance along a 45-degree plane against x; the coordinate is the
	                          height where the plane meets the centreplane */
} batten_line_kind;
typedef struct batten_line {
	batten_line_kind kind;
	double coordinate_m;
	size_t point_count;
	double fn_per_m2; /* NaN below three points */
	size_t inflections;
	double change_max_m; /* against the reference; 0 without one */
} batten_line;

/* All stations, waterlines, and for each waterline height up to the half-beam one buttock at
 * y = that fraction of h, and one diagonal. lines is the caller's, capacity entries long; *count gets
 * the number there are (call with capacity 0 to ask). reference may be NULL. Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_hull_lines(batten_context *context, const batten_hull *hull,
                                           const batten_hull *reference, batten_line *lines,
                                           size_t capacity, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
