/* A line of a hull that is fitted (pass_fit.h). The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_LINE_H
#define BATTEN_SHARED_PASS_LINE_H

/* What the includer does beside the rows, tiles and fitted points of a pass: a pass_beside, and
 * PASS_BESIDE(pass_beside *, time), time being roughly how long each of them takes. */
#if !defined(PASS_BESIDE)
#define PASS_BESIDE(beside, time) ((void)(beside))
typedef void pass_beside;
#endif
enum { PASS_ROW_TIME = 1, PASS_TILE_TIME = 16, PASS_POINT_TIME = 16 };

/* A pivot below this part of its diagonal is rounding: the points do not determine the vertices. */
#if BATTEN_DOUBLE
#define PASS_PIVOT LITERAL(1e-12)
#else
#define PASS_PIVOT LITERAL(1e-5)
#endif

/* A line and the room of the work-item. */
typedef struct pass_line {
	int points, order, vertices;
	pass_beside *beside;
	GLOBAL const int *from, *to; /* places in the state */
	GLOBAL const scalar *along;  /* x of the points */
	GLOBAL real *parameter, *band, *x, *y;
} pass_line;

#endif
