/* Multipliers of measures to keep, and how measures answer to them: Newton's method for the measures that
 * lie at an end of their tolerance, its matrix learnt from what each step did (Broyden). */
#ifndef BATTEN_FAIRING_KEPT_STATE_H
#define BATTEN_FAIRING_KEPT_STATE_H

#include "batten.h"

typedef struct matrix {
	double a[BATTEN_KEEP_LIMIT][BATTEN_KEEP_LIMIT];
} matrix;

/* Measures are counted in tolerances from what they are to be: within -1 .. 1. */
typedef struct kept_state {
	size_t count;
	double value[BATTEN_KEEP_LIMIT], multiplier[BATTEN_KEEP_LIMIT];
	int side[BATTEN_KEEP_LIMIT]; /* which end a measure is held at; 0: none */
	matrix response;             /* how measures fall with the multipliers */
} kept_state;

/* Measures beyond an end are held there from now on. Returns whether all is as it should be. */
bool kept_judge(kept_state *t);

/* The change to the next multipliers; a measure that would be pulled away from its end is held no more.
 * false: the held measures hang together. */
bool kept_choose(kept_state *t, double *change);

/* What a change of the multipliers did, put into the response: value was `before`. */
void kept_learn(kept_state *t, const double *before, const double *change);

/* The slope along a change of the multipliers of the least of the objective with them. */
double kept_rise(const kept_state *t, const double *change);

/* How far the held measures are from what is aimed at. */
double kept_distance(const kept_state *t, const double *value);

#endif
