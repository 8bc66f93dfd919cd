/* A fairing pass as the list of operations it is, the same for every hull of a topology (thesis 5.2,
 * 5.3, 6): host, C path and kernel read the same numbers.
 *
 * The state of a hull is one row of reals: first its values (half-breadths), then constants (profile
 * points), then room. An iteration works the operations one after the other; each leaves its results
 * in the state, and after the last one the values are the new ones.
 *
 * A pass is either stretches alone, or none of them. Stretches are worked with lanes along the values of
 * one hull, which needs no hulls side by side and no journey of numbers between lanes and hulls; all other
 * kinds with a hull a lane. The state of stretches has PASS_STRETCH numbers before and behind it: they
 * are 0, as are gaps inside that nobody writes. */
#ifndef BATTEN_SHARED_PASS_LAYOUT_H
#define BATTEN_SHARED_PASS_LAYOUT_H

/* Kinds of operations, and of what `first` and `count` are numbers; those of rows come first. */
enum {
	/* rows: state[target] = sum of factor * state[index], no row reading what another one writes */
	PASS_ROWS = 0,
	/* rows, PASS_TILE of them at a time, that read the same numbers and write when all is read. The
	 * terms belong to the first of them, PASS_TILE side by side to an index: one for each of the rows */
	PASS_TILES,
	PASS_TILES_IN_ORDER, /* tiles that read what those before them wrote: triangular systems */
	PASS_ADD,            /* rows of one term each: state[target] += state[index] */
	/* rows, each of PASS_STRETCH targets side by side; a term has as many factors, and its index is the
	 * place of the first of as many numbers that they multiply, counted from PASS_STRETCH before the
	 * state */
	PASS_STRETCHES,
	PASS_FLOOR, /* values: below 0 they become 0 */
	PASS_FIT,   /* lines: least squares with parameters by chord length, which depend on y */
};

/* So many rows load what they read once; and where a row waits for the one before it they wait once. */
enum { PASS_TILE = 4 };

/* Few enough that most terms of a stretch are no zeros, and four vectors of f64 on the widest CPU. */
enum { PASS_STRETCH = 32 };
/* Hulls that a work-group works side by side in lanes of stretches; without lanes it has one. */
enum { PASS_STRETCH_HULLS = 2 };

/* An operation. */
enum { PASS_KIND, PASS_FIRST, PASS_COUNT, PASS_OPERATION_SIZE };

/* What the kernel is told about the pass. */
enum {
	PASS_SHAPE_ITERATIONS,
	PASS_SHAPE_OPERATIONS,
	PASS_SHAPE_VALUES,
	PASS_SHAPE_LARGEST, /* a value is no length beyond this */
	PASS_SHAPE_CONSTANTS,
	PASS_SHAPE_STATE,      /* values, constants and room, but that of fits */
	PASS_SHAPE_STRETCHES,  /* 1: of stretches alone */
	PASS_SHAPE_FIT_ORDER,  /* 0 without fits */
	PASS_SHAPE_VERTICES,   /* of each fitted line */
	PASS_SHAPE_FIT_POINTS, /* of the longest of them */
	PASS_SHAPE_SIZE
};

enum { PASS_ORDER_LEAST = 2, PASS_ORDER_MOST = 8 };

/* Room a work-item needs for fits, in reals: parameters, the band of the normal equations, x and y
 * of the vertices. */
#define PASS_FIT_ROOM(order, vertices, points)                                                     \
	((order) > 0 ? (points) + (vertices) * ((order) + 2) : 0)

#endif
