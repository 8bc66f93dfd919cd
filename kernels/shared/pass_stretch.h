/* The course of a pass of stretches (pass_layout.h), the same source for the kernel and the C path: lanes
 * lie along the values of one hull. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_STRETCH_H
#define BATTEN_SHARED_PASS_STRETCH_H

#include "shared/pass_program.h"

/* Numbers of a vector, and vectors that are summed side by side: none waits for the one before. */
#if defined(BATTEN_DIALECT_C)
#define STRETCH_LANES 1
#define STRETCH_SUMS 8
#define READ(from) (*(from))
#elif BATTEN_LANES == 1
#define STRETCH_LANES 1
#define STRETCH_SUMS 1
#else
#define STRETCH_LANES BATTEN_LANES
#define STRETCH_SUMS (BATTEN_LANES == 16 ? 2 : 4)
#endif
#define STRETCH_STEP (STRETCH_LANES * STRETCH_SUMS)

/* Hulls that are worked side by side: factors are loaded once for all, and none waits for what was
 * written just before. */
#if STRETCH_LANES == 1
#define STRETCH_HULLS 1
#else
#define STRETCH_HULLS PASS_STRETCH_HULLS
#endif
enum { STRETCH_PARTS = PASS_STRETCH / STRETCH_STEP };

/* Sums of a part of a stretch, STRETCH_PARTS to a row; the states lie state_size numbers apart. */
SHARED_FUNCTION void stretch_sum(const pass_program *p, int part, GLOBAL const scalar *state,
                                 int state_size, real sum[STRETCH_HULLS][STRETCH_SUMS])
{
	const int row = part / STRETCH_PARTS;
	const int at = part % STRETCH_PARTS * STRETCH_STEP;
	const int end = p->row_first[row + 1];
	UNROLLED
	for (int h = 0; h < STRETCH_HULLS; h++) {
		UNROLLED
		for (int s = 0; s < STRETCH_SUMS; s++)
			sum[h][s] = SPREAD(LITERAL(0.0));
	}
	ROLLED
	for (int n = p->row_first[row]; n < end; n++) {
		GLOBAL const scalar *from = state - PASS_STRETCH + p->term_index[n] + at;
		GLOBAL const scalar *factors = p->term_factor + n * PASS_STRETCH + at;
		UNROLLED
		for (int s = 0; s < STRETCH_SUMS; s++) {
			const real factor = READ(factors + s * STRETCH_LANES);
			UNROLLED
			for (int h = 0; h < STRETCH_HULLS; h++)
				sum[h][s] = FUSED(factor, READ(from + h * state_size + s * STRETCH_LANES),
				                  sum[h][s]);
		}
	}
}

/* Where the sums of a part go. */
SHARED_FUNCTION int stretch_target(const pass_program *p, int part)
{
	return p->row_target[part / STRETCH_PARTS] + part % STRETCH_PARTS * STRETCH_STEP;
}

#endif
