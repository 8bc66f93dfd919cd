/* Where n functions of n numbers vanish within a box: every place that is found. */
#ifndef BATTEN_VARIATION_ROOTS_H
#define BATTEN_VARIATION_ROOTS_H

#include "core/context.h"

enum { ROOTS_NUMBERS_MOST = 8, ROOTS_MOST = 8 };

/* The functions at a place: each in a unit of its own, in which tolerance is small enough. INPUT: there
 * is no value here. Any other error ends the search. */
typedef batten_status roots_function(void *user, const double *at, double *out);

struct roots_task {
	size_t count;                                               /* 1..ROOTS_NUMBERS_MOST */
	double least[ROOTS_NUMBERS_MOST], most[ROOTS_NUMBERS_MOST]; /* the box, least < most */
	double start[ROOTS_NUMBERS_MOST];                           /* within it */
	double tolerance;
	roots_function *function;
	void *user;
};

struct roots {
	size_t count; /* nearest to the start first, in parts of the box */
	double at[ROOTS_MOST][ROOTS_NUMBERS_MOST];
	/* the place that came nearest, and the largest value there: what there is without a root */
	double nearest[ROOTS_NUMBERS_MOST], off;
};

/* One number: the box is cut at equal parts, each change of sign is a bracket that Newton's method
 * closes (a step out of it becomes a halving), and each least size between two places is looked
 * into, where a curve only touches 0. Several: Newton's method from the start and from places spread
 * over the box, steps kept within the box and halved until the sum of squares falls. Errors: those of
 * the function but INPUT. */
batten_status roots_find(const struct roots_task *task, struct roots *out);

#endif
