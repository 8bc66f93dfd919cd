/* batten.h, one part of it: forward and inverse fairing, many hulls at a time. */
#ifndef BATTEN_PASS_H
#define BATTEN_PASS_H

#include "base.h"
#include "curve.h"
#include "device.h"
#include "hull.h"
#include "search.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Forward and inverse fairing, many hulls at a time
 * --------------------------------------------------------------------------------------------- */

/* How a hull is faired. "Order" is degree + 1; knots are the thesis's open uniform ones; ends of lines,
 * and points where a knuckle breaks them, stay. Words: batten_fair_method_text(). */
#define BATTEN_FAIR_METHOD_LIST(X)                                                                 \
	X(SEARCH, "search", "pattern search for the least fairness and closeness (thesis 7)")          \
	X(SMOOTH, "smooth", "gross errors of single offsets replaced, nothing else (thesis 4.5)")      \
	X(FORWARD_APPROXIMATION, "forward-approximation",                                              \
	  "offsets as B-spline polygons, waterlines then sections, again and again (thesis 5.2)")      \
	X(FORWARD_FIT, "forward-fit",                                                                  \
	  "sections so, then waterlines by least squares of few vertices (thesis 5.3)")                \
	X(INVERSE, "inverse",                                                                          \
	  "second derivatives represented by B-splines, offsets from them (thesis 6)")

typedef enum batten_fair_method {
#define BATTEN_FAIR_METHOD_ENTRY(name, word, text) BATTEN_METHOD_##name,
	BATTEN_FAIR_METHOD_LIST(BATTEN_FAIR_METHOD_ENTRY)
#undef BATTEN_FAIR_METHOD_ENTRY
} batten_fair_method;

enum { BATTEN_FAIR_METHOD_COUNT = BATTEN_METHOD_INVERSE + 1 };

/* "search" and what it is; NULL beyond the last. */
BATTEN_API const char *batten_fair_method_text(size_t method);
BATTEN_API const char *batten_fair_method_meaning(size_t method);

enum { BATTEN_ITERATIONS_MOST = 10000 }; /* of a pass */

typedef struct batten_pass_options {
	size_t struct_size;
	batten_fair_method method; /* one of the last three; FORWARD_APPROXIMATION */
	unsigned order;            /* along waterlines, 2..8; 3 */
	unsigned order_sections;   /* along sections; 0 (default): as order */
	/* FORWARD_FIT: polygon vertices of each waterline; 0 (default) takes 8. INVERSE: those of each
	 * line of a field; 0 takes the field's own points as polygon. At least the order. */
	unsigned vertices;
	int device; /* BATTEN_DEVICE_AUTO */
	batten_precision precision;
	unsigned lanes, work_group; /* as in batten_search_options */
} batten_pass_options;
BATTEN_API void batten_pass_options_default(batten_pass_options *options);

/* One iteration of a method, made ready for all hulls of a topology: the same table, nodes, line
 * ends, profile points and knuckles.
 *
 * FORWARD_APPROXIMATION: the points of a line are the polygon of its curve, the new y those at the
 * parameters t where x(t) is the old x. t depends on x alone, so that an iteration is one linear map.
 * FORWARD_FIT: parameters by chord length depend on y; every line of every hull is solved for itself,
 * and one whose points do not determine its vertices stays as it is.
 * INVERSE: the second differences along waterlines and along sections, at the inner points of lines,
 * are two fields; each becomes a tensor-product B-spline of `order` along x and `order_sections` along
 * z. The new offsets are those whose second differences come closest to these, sum of ((difference -
 * asked) a b)^2, a and b being the steps beside the point: residuals are lengths, and both directions
 * count alike. Every end of a line stays. Orders of 2 represent a field exactly: nothing changes.
 *
 * A line of fewer points than the method needs is passed over: the order or the vertices, 3 at least;
 * with INVERSE its inner points. '?' cells are no points and keep their numbers. */
typedef struct batten_pass batten_pass;

/* Errors: USAGE (an option out of its range, an order or vertices that no line has points for), INPUT
 * (a profile point behind the end of its line, a table too large), MEMORY. */
BATTEN_API batten_status batten_pass_create(batten_context *context, const batten_hull *hull,
                                            const batten_pass_options *options, batten_pass **out);

/* The same for a single line y(x): count 3..4096, x ascending. y may have any sign. Errors: USAGE,
 * INPUT (coincident points), MEMORY. */
BATTEN_API batten_status batten_pass_create_line(batten_context *context, size_t count,
                                                 const double *x_m,
                                                 const batten_pass_options *options,
                                                 batten_pass **out);
BATTEN_API void batten_pass_destroy(batten_pass *pass);

typedef struct batten_pass_facts {
	size_t value_count;  /* numbers a hull: nodes as in batten_hull_y_m(), then line ends off the
	                       table; of a line its points */
	size_t line_count;   /* pieces of lines that are faired */
	size_t passed_count; /* pieces passed over: too short */
	size_t term_count;   /* products of an iteration, those of fits left out */
	unsigned order, order_sections, vertices; /* as used */
} batten_pass_facts;
BATTEN_API batten_pass_facts batten_pass_describe(const batten_pass *pass);

/* The numbers of a hull of the topology, [value_count]. */
BATTEN_API void batten_pass_values(const batten_pass *pass, const batten_hull *hull, double *y_m);

/* Works iterations (1..10000) of the pass on count hulls. y_m and out_m are two arrays of the caller,
 * [count][value_count]; no half-breadth becomes less than 0. run may be NULL. The result of a hull
 * does not depend on the others, on their order or number, nor (when strict) on what ran it. Errors:
 * USAGE (also numbers that are not finite or beyond 1e6 m; out_m is then of no use), DEVICE, KERNEL,
 * MEMORY. */
BATTEN_API batten_status batten_pass_batch(batten_context *context, const batten_pass *pass,
                                           size_t count, unsigned iterations, const double *y_m,
                                           double *out_m, batten_run *run);

/* A single line y(x) faired by a method of hulls but SMOOTH; its ends stay. SEARCH (thesis 7.3) lowers
 * F = w1 FN + w2 CN by Hooke and Jeeves' search as published, FN = sum of squared second differences
 * (1/m2), CN = sum of (y - given)^2 (m2). */
typedef struct batten_line_options {
	size_t struct_size;
	batten_fair_method method; /* FORWARD_APPROXIMATION */
	batten_pass_options pass;  /* its method is the one above */
	unsigned iterations;       /* of the last three methods, 1..10000; 1 */
	double w1, w2;             /* of SEARCH, >= 0, not both 0; 1 and 1 */
	double last_step;          /* of SEARCH, in parts of the range of y; 1e-9 */
} batten_line_options;
BATTEN_API void batten_line_options_default(batten_line_options *options);

typedef struct batten_line_facts {
	double fn_before_per_m2, fn_after_per_m2;
	double change_max_m, closeness_m2;
	double objective; /* of SEARCH, else NaN */
} batten_line_facts;

/* y_m is the caller's, [points]; options and facts may be NULL. Returns INCOMPLETE when a search met
 * its limit of a million sweeps. Errors: USAGE (options, a space curve, fewer than three points), INPUT
 * (x does not grow), as batten_pass_create_line, MEMORY. */
BATTEN_API batten_status batten_line_fair(batten_context *context, const batten_points *points,
                                          const batten_line_options *options, double *y_m,
                                          batten_line_facts *facts);

#ifdef __cplusplus
}
#endif

#endif
