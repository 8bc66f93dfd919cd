/* Newton's method over the free unknowns of a search's objective: how far its end is from a minimum, and
 * steps that go there. What certificates of grids and of control nets have in common. */
#ifndef BATTEN_BATCH_NEWTON_H
#define BATTEN_BATCH_NEWTON_H

#include "core/context.h"

/* The Hessian over the free unknowns, as whoever knows the objective writes it. */
typedef struct newton_system {
	batten_context *context;
	size_t count; /* of the unknowns */
	size_t width; /* the furthest that two unknowns of one term lie apart */
	double last;  /* what those held at a bound still gain, beside the parabola */
	void (*assemble)(const void *of, size_t width,
	                 double *band); /* adds to the band, as core/band.h */
	const void *of;
} newton_system;

/* Fills gap_estimate and message; out->objective is known. step: the gradient over the unknowns, and
 * afterwards the way back to the minimum of the parabola. Errors: MEMORY. */
batten_status newton_estimate(const newton_system *system, double *step, batten_certificate *out);

/* Something to go to the minimum of. */
typedef struct newton_way {
	batten_context *context;
	size_t count; /* numbers of y */
	/* Judges y, and keeps the step from there. */
	batten_status (*judge)(void *of, const double *y, batten_certificate *out);
	/* The objective at `from` less `part` of the step, kept in the box; that is written to y. */
	double (*go)(void *of, const double *from, double part, double *y);
	void *of;
} newton_way;

/* Goes on from y until the gap estimate is at most `gap`: whole steps, halved until the objective falls.
 * Errors: MEMORY, those of judge. */
batten_status newton_polish(const newton_way *way, double gap, double *y, batten_certificate *out);

/* The certificate of what cannot be judged, and why. */
batten_certificate newton_refused(const char *fault);

#endif
