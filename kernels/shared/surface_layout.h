/* How surfaces and what is known of them lie in memory: the same numbers for the host, the C path and
 * the kernel. Value v of lane l is number v * lanes + l. */
#ifndef BATTEN_SHARED_SURFACE_LAYOUT_H
#define BATTEN_SHARED_SURFACE_LAYOUT_H

/* What a launch gives back: values of each point, or sums of each line (v fixed). */
#define SURFACE_OUTPUT_POSITION 0
#define SURFACE_OUTPUT_CURVATURE 1
#define SURFACE_OUTPUT_EVERYTHING 2
#define SURFACE_OUTPUT_ENERGY 3
#define SURFACE_OUTPUT_VARIATION 4 /* the energies, and the variation of curvature */

/* Whether an output is sums of lines. */
#define SURFACE_SUMS(output)                                                                       \
	((output) == SURFACE_OUTPUT_ENERGY || (output) == SURFACE_OUTPUT_VARIATION)

/* Derivatives an output takes in one direction, the point among them. */
#define SURFACE_DERIVATIVES(output)                                                                \
	((output) == SURFACE_OUTPUT_POSITION ? 1 : (output) == SURFACE_OUTPUT_VARIATION ? 4 : 3)

enum { SURFACE_POSITION_COUNT = 3, SURFACE_CURVATURE_COUNT = 2 };

/* Everything, in this order; three numbers a vector. */
enum {
	SURFACE_AT = 0,
	SURFACE_BY_U = 3,
	SURFACE_BY_V = 6,
	SURFACE_BY_UU = 9,
	SURFACE_BY_UV = 12,
	SURFACE_BY_VV = 15,
	SURFACE_FIRST_UU = 18, /* E, F, G */
	SURFACE_FIRST_UV,
	SURFACE_FIRST_VV,
	SURFACE_AREA,
	SURFACE_NORMAL,
	SURFACE_SECOND_UU = SURFACE_NORMAL + 3, /* e, f, g */
	SURFACE_SECOND_UV,
	SURFACE_SECOND_VV,
	SURFACE_GAUSS,
	SURFACE_MEAN,
	SURFACE_K1,
	SURFACE_K2,
	SURFACE_BENDING,
	SURFACE_DIRECTION1,
	SURFACE_DIRECTION2 = SURFACE_DIRECTION1 + 3,
	SURFACE_ALONG_X = SURFACE_DIRECTION2 + 3,
	SURFACE_ACROSS_X,
	SURFACE_ISOPHOTE,
	SURFACE_EVERYTHING_COUNT
};

/* Sums of a line, each weighted along u; the weight of the line itself is the host's. */
enum {
	SURFACE_SUM_BENDING,
	SURFACE_SUM_MEAN,
	SURFACE_SUM_GAUSS,
	SURFACE_SUM_AREA,
	SURFACE_SUM_SINGULAR,  /* a number of points */
	SURFACE_SUM_VARIATION, /* these two are 0 without SURFACE_OUTPUT_VARIATION */
	SURFACE_SUM_LEFT_OUT,  /* points that add nothing to the variation */
	SURFACE_SUM_COUNT
};

/* The mean curvature a point without a normal gets: no real one is as large. */
#define SURFACE_NO_NORMAL 3e38

/* Two directions closer than this, in radians, or an area element this much smaller than the net's
 * own, are rounding: there is no normal. So is a difference of the principal curvatures this much
 * smaller than what the second derivatives could make, and a normal this close to the x axis. */
#define SURFACE_ANGLE_F64 1e-10
#define SURFACE_ANGLE_F32 1e-5

/* One sample of a direction in its table: `order` values of the basis, of its first and of its second
 * derivative, and of its third where the variation of curvature is found; then the weight in an
 * integral. */
#define SURFACE_TABLE_ROWS(output) ((output) == SURFACE_OUTPUT_VARIATION ? 4 : 3)
#define SURFACE_TABLE_SIZE(rows, order) ((rows) * (order) + 1)

#endif
