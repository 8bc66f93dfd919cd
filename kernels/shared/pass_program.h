/* A fairing pass (pass_layout.h) as kernels and the C path have it. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_PROGRAM_H
#define BATTEN_SHARED_PASS_PROGRAM_H

#include "pass_layout.h"

/* What the hulls of a batch share. A pass of stretches has no lines. */
typedef struct pass_program {
	GLOBAL const int *shape;      /* PASS_SHAPE_SIZE */
	GLOBAL const int *operations; /* [operations][PASS_OPERATION_SIZE] */
	GLOBAL const int *row_first;  /* [rows + 1]: its first term */
	GLOBAL const int *row_target; /* [rows] */
	GLOBAL const int *term_index; /* [terms] */
	GLOBAL const scalar *term_factor;
	GLOBAL const int *line_first; /* [lines + 1]: its first point */
	GLOBAL const int *point_from, *point_to;
	GLOBAL const scalar *point_along;
} pass_program;

#endif
