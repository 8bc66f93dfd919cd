/* How far each section of a hull moves along the ship: the formulas of thesis 2.3.1-2.3.3. */
#ifndef BATTEN_VARIATION_SHIFT_H
#define BATTEN_VARIATION_SHIFT_H

#include "core/spline.h"

/* The ends between which sections move, and the parallel body amidships. */
typedef struct variation_span {
	double aft_m, middle_m, fore_m;
	double parallel_aft, parallel_fore; /* p, in parts of each half */
} variation_span;

/* One half of a curve along the ship, from amidships (0) to its end (1), in parts of the ordinate
 * amidships. */
typedef struct variation_half {
	double fullness; /* Cp: integral y dx */
	double lever;    /* centroid from amidships */
	double gyration; /* k^2 = (integral y x^2 dx) / Cp */
	double parallel; /* p */
} variation_half;

typedef struct variation_halves {
	variation_half aft, fore;
	double fullness; /* of both: (CpA + CpF) / 2 */
	double centre;   /* of the whole curve, from amidships, + forward, in parts of a half length */
} variation_halves;

/* dx = (1 - x)(constant + linear (x - p)) for p <= x <= 1, by parts of the half. */
typedef struct variation_half_shift {
	double parallel, constant, linear;
} variation_half_shift;

typedef struct variation_shift {
	variation_span span;
	/* swing: dx = factor * (A(x) - chord between its end values) / A amidships; the thesis leaves
	 * the chord out and only holds the ends */
	const struct spline *swing; /* NULL for the other methods */
	double swing_factor_m;
	bool without_chord;
	variation_half_shift aft, fore;
	/* Parallel body amidships after the move: the section amidships stands from .. to. */
	bool body, body_open; /* open: the thesis puts no section at its after end */
	double body_from_m, body_to_m;
	double fullness_aft, fullness_fore; /* changes of the half fullnesses, for the record */
} variation_shift;

/* What is asked of a curve: fullness in percent of its value, centre in percent of the length,
 * + forward. centre_used in percent of the length, NaN: that of the curve. */
typedef struct variation_change {
	double fullness_pct, centre_pct, centre_used_pct;
	double parallel_aft_pct, parallel_fore_pct; /* of each half */
} variation_change;

variation_shift variation_shift_swing(const struct spline *curve, const variation_span *span,
                                      double centre_pct, double length_m);
/* Both: false where the curve leaves the formulas nothing to work on (a half that is full). */
bool variation_shift_one_minus(const struct spline *curve, const variation_span *span,
                               const variation_change *change, variation_shift *out);
bool variation_shift_lackenby(const struct spline *curve, const variation_span *span,
                              const variation_change *change, variation_shift *out);

/* The numbers of both formulas that do not depend on what is asked for: half-lengths, levers of a change
 * of fullness and of parallel body, and the shift they make,
 *   level = by_fullness change + by_body body,
 *   linear = linear (change - level (1 - fullness)). */
typedef struct variation_half_numbers {
	double parallel, length_m, fullness, lever, body_lever, by_fullness, by_body, linear;
} variation_half_numbers;
typedef struct variation_numbers {
	variation_half_numbers aft, fore;
	double fullness, centre;
} variation_numbers;
/* False where the curve leaves the formulas nothing to work on. */
bool variation_shift_numbers(const struct spline *curve, const variation_span *span, bool lackenby,
                             variation_numbers *out);

/* Least and greatest slope d(dx)/dx of a swing by one metre of factor. */
void variation_shift_swing_slopes(const variation_shift *shift, double *least, double *most);

/* A parallel body shorter than this part of the length is none. */
#define VARIATION_BODY_PART 1e-9

double variation_shift_at(const variation_shift *shift, double x_m);

/* True where two sections would change places, 1 + d(dx)/dx <= 0; *x_m gets where. */
bool variation_shift_folds(const variation_shift *shift, double *x_m);

/* The curve after the move, a natural spline through its moved points. Errors: USAGE, MEMORY. */
batten_status variation_shift_curve(batten_context *context, const variation_shift *shift,
                                    const struct spline *curve, struct spline *out);

#endif
