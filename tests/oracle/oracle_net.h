/*
 * The oracle for searches over a control net: fairness and closeness of a surface integrated over its
 * knot spans, as a function of the y of its poles, and its minimum. The basis at a node comes from de
 * Boor's recursion over unit poles, curvatures from the shape operator, derivatives by each node's
 * y-derivatives from differences.
 */
#ifndef BATTEN_TESTS_ORACLE_NET_H
#define BATTEN_TESTS_ORACLE_NET_H

#include "oracle_bspline.h"

typedef enum oracle_fairness {
	ORACLE_FAIRNESS_BENDING, /* k1^2 + k2^2 */
	ORACLE_FAIRNESS_MEAN,    /* ((k1 + k2) / 2)^2 */
	ORACLE_FAIRNESS_GAUSS,   /* sqrt((k1 k2)^2 + rounding^2) */
} oracle_fairness;

/* Minimise w1 * integral fairness dS + w2 * integral (y - target)^2 |x_u z_v - x_v z_u| du dv / h^4,
 * lower <= y <= upper; arrays [count_v][count_u]. */
typedef struct oracle_net_problem {
	const oracle_surface
		*surface; /* x, z and the start's y; nodes where it is singular are left out */
	const double *target, *lower, *upper;
	double w1, w2, h;
	size_t nodes; /* of Gauss, a span and direction */
	oracle_fairness fairness;
	double rounding;
} oracle_net_problem;

/* NaN when memory is short or the knots make no surface. */
long double oracle_net_objective(const oracle_net_problem *problem, const double *y);

/* The objective's slopes by the y of each pole, [count_v][count_u]: its differences over step to either side. */
bool oracle_net_slopes(const oracle_net_problem *problem, const double *y, double step,
                       double *slopes);

/* A local minimum from the start, moved into the box, by a projected Newton method in long double:
 * dense factors, steps of at most 0.04 h, made positive where the objective is not convex. y may be
 * target. bending and closeness of the report are 0. */
bool oracle_net_minimise(const oracle_net_problem *problem, double *y, oracle_minimum *out);

#endif
