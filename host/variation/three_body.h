/* Fore body, middle body and after body, each stretched by its own factor (Letcher 10.4, equations
 * 114-117). */
#ifndef BATTEN_VARIATION_THREE_BODY_H
#define BATTEN_VARIATION_THREE_BODY_H

#include <stdbool.h>
#include <stddef.h>

/* From the bow: fore body, middle body, after body. */
typedef struct three_body {
	double length[3];
	double volume[3];
	double centre[3];    /* of the volume from the body's forward end, in parts of its length */
	double waterline[3]; /* part of its length that the waterline has; middle body 1 */
	double section_area; /* of the middle body */
} three_body;

typedef struct three_body_target {
	double volume;
	double centre; /* from the bow, in parts of the waterline */
	double cp;
} three_body_target;

/* The factors that meet the target. Two of the three equations are linear: what they leave is a
 * straight line, on which the moment is a quadratic, so that every solution is found. Those with a
 * factor of 0 or less mean nothing; *rejected counts them. Returns how many are left, at most 2, the
 * one nearest to (1, 1, 1) first. */
size_t three_body_solve(const three_body *body, const three_body_target *target,
                        double factors[2][3], size_t *rejected);

/* Volume, centre and prismatic coefficient of the stretched hull. */
three_body_target three_body_measure(const three_body *body, const double factors[3]);

#endif
