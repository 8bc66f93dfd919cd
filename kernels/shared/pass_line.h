/* A line of a hull that is fitted (pass_fit.h). The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_LINE_H
#define BATTEN_SHARED_PASS_LINE_H

/* A line and the room of the work-item. */
typedef struct pass_line {
	int points, order, vertices;
	GLOBAL const int *from, *to; /* places in the state */
	GLOBAL const scalar *along;  /* x of the points */
	GLOBAL real *parameter, *band, *x, *y;
} pass_line;

#endif
