/* Newton's method over the free unknowns of a search's objective: how far its end is from a minimum, and
 * steps that go there. What certificates of grids and of control nets have in common. */
#ifndef BATTEN_BATCH_NEWTON_H
#define BATTEN_BATCH_NEWTON_H

#include "batch/jet.h"
#include "core/context.h"

/* In place of the number of an unknown: what stands there is held. */
#define NEWTON_HELD SIZE_MAX

/* Whether an unknown is held: within `near` of a bound, below or above, that its slope pushes it to. Then *step
 * gets its last way there, *last what it gains on that. */
bool newton_holds(double below, double above, double near, double slope, double *step,
                  double *last);

/* One term of the objective: its derivatives, and the places they are sums over. */
typedef struct newton_term {
	size_t count;
	const size_t *places;
	const double *weight; /* of place n in derivative v: weight[v * stride + n] */
	size_t stride;
	const jet *derivatives;
} newton_term;

/* The furthest that two unknowns at these places lie apart. number: by place. */
size_t newton_reach(size_t count, const size_t *places, const size_t *number);

/* What each pair of the term's places has of the Hessian, into the band (core/band.h). */
void newton_add_term(const newton_term *term, const size_t *number, size_t width, double *band);

/* Solves a factored band for slopes at the places, those of places that go together added up: the ways they
 * go, 0 where held. right: room for an unknown each. */
typedef struct newton_factor {
	size_t places, count, width;
	const size_t *number;
	const double *band;
	double *right;
} newton_factor;
void newton_answer(const newton_factor *factor, const double *slopes, double *ways);

/* The objective about an end, place by place. */
typedef struct newton_system {
	batten_context *context;
	size_t places;
	const size_t
		*number; /* of the unknown at a place, or NEWTON_HELD; places that go together share
	                           one */
	const double *gradient; /* by the unknown at a place; what is held has one too */
	double *step;           /* gets, where there is an unknown, y less the bottom of the parabola */
	size_t count;           /* of the unknowns */
	double last;            /* what those held at a bound still gain, beside the parabola */
	size_t (*width)(const void *of); /* newton_reach() over all terms */
	void (*assemble)(const void *of, size_t width, double *band); /* adds all terms */
	const void *of;
} newton_system;

/* Fills free_count, gradient_per_m, gap_estimate and message; out->objective is known. Errors: MEMORY. */
batten_status newton_judge(const newton_system *system, batten_certificate *out);

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
