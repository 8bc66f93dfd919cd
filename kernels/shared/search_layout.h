/* How a block of searches lies in memory: the same numbers for the host, the C path and the kernel.
 * Value v of lane l is number v * lanes + l. */
#ifndef BATTEN_SHARED_SEARCH_LAYOUT_H
#define BATTEN_SHARED_SEARCH_LAYOUT_H

/* Arrays of a block, one value a node each (the grid with a ring of one node around it). */
enum {
	SEARCH_ARRAY_Y,
	SEARCH_ARRAY_LOWER,
	SEARCH_ARRAY_UPPER,
	SEARCH_ARRAY_TARGET,
	SEARCH_ARRAY_BEND,  /* w1 dx dz where the energy has a term, else 0 */
	SEARCH_ARRAY_CLOSE, /* w2 dx dz / h^4 */
	SEARCH_ARRAY_COUNT
};

/* Ways a pattern move goes: the iteration's own and those of iterations before. One more for an offset grid
 * has most of the gain and a third of the probes. */
#define GRID_WAYS 2
#define NET_WAYS 4

/* Arrays of nodes that a search works in: five, remembered ways, five derivatives. */
#define SEARCH_STATE_COUNT (5 + GRID_WAYS - 1 + 5)

/* Numbers of a search over an offset grid that work-items share: these arrays, a sum a waterline, two numbers a
 * work-item. */
#define SEARCH_STATE_NUMBERS(nodes, waterlines, work_items)                                        \
	(SEARCH_STATE_COUNT * (nodes) + (waterlines) + 2 * (work_items))

/* What an offset grid is to be low in. */
enum {
	GRID_BENDING,          /* k1^2 + k2^2, both directions alike */
	GRID_BENDING_WEIGHTED, /* the directions weighted */
	GRID_MEAN,             /* ((k1 + k2) / 2)^2 */
	GRID_GAUSS,            /* |k1 k2|, rounded off at 0 */
	GRID_VARIATION         /* h^2 ((dk1/de1)^2 + (dk2/de2)^2), by third differences */
};

/* How far along a line the nodes lie that a term stands on. */
#define GRID_REACH(kind) ((kind) == GRID_VARIATION ? 2 : 1)

/* Directions of one colour share no term and none reads what another moves: so many colours along each
 * direction of a level. */
#define GRID_COLOURS_ASIDE(kind) ((kind) == GRID_VARIATION ? 5 : 3)
#define GRID_COLOURS(kind) (GRID_COLOURS_ASIDE(kind) * GRID_COLOURS_ASIDE(kind))

/* |K| is taken as sqrt(K^2 + e^2) with e this part of 1 / h^2: a search needs a smooth objective. */
#define GAUSS_ROUNDING 1e-3

/* One value a search each. */
enum {
	SEARCH_SETTING_FIRST_STEP,
	SEARCH_SETTING_LAST_STEP,
	SEARCH_SETTING_ALONG, /* this and the next two: grid_weights of grid_energy.h */
	SEARCH_SETTING_ACROSS,
	SEARCH_SETTING_BLUNT,
	SEARCH_SETTING_WIDE_PROBES, /* two for each direction of the wide levels (multilevel.h) */
	SEARCH_SETTING_PENALTY,     /* r of the interior penalty; 0: none */
	SEARCH_SETTING_COUNT
};
enum {
	SEARCH_OUTCOME_START, /* objective */
	SEARCH_OUTCOME_END,   /* objective */
	SEARCH_OUTCOME_STEP,  /* last step */
	SEARCH_OUTCOME_ITERATIONS,
	SEARCH_OUTCOME_MOVES,      /* iterations whose exploratory moves gained */
	SEARCH_OUTCOME_EXTRA_HIGH, /* probes beyond two a direction and iteration: high * 2^20 + low;
	                            * those of the wide levels all */
	SEARCH_OUTCOME_EXTRA_LOW,
	SEARCH_OUTCOME_COUNT
};

/* One level of hats: widths along x and z, first direction of each colour and the end of the last. */
enum {
	SEARCH_COLOUR_LIMIT = 25,
	SEARCH_LEVEL_WIDTH_X = 0,
	SEARCH_LEVEL_WIDTH_Z = 1,
	SEARCH_LEVEL_FIRST = 2,
	SEARCH_LEVEL_SIZE = SEARCH_LEVEL_FIRST + SEARCH_COLOUR_LIMIT + 1
};

#endif
