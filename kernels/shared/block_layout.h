/* How searches by the block method lie in memory: the same numbers for the host, the C path and the
 * kernel. Lines run along the finer spacing of the grid; node k of line i is number i * length + k,
 * whichever way the lines run. A search's numbers lie together, so that any lane can take it. */
#ifndef BATTEN_SHARED_BLOCK_LAYOUT_H
#define BATTEN_SHARED_BLOCK_LAYOUT_H

/* Arrays of a search, one value a node each. */
enum {
	BLOCK_INPUT_START,
	BLOCK_INPUT_LOWER,
	BLOCK_INPUT_UPPER,
	BLOCK_INPUT_TARGET,
	BLOCK_INPUT_BEND,  /* w1 dx dz where the energy has a term, else 0 */
	BLOCK_INPUT_CLOSE, /* w2 dx dz / h^4 times the node's factor */
	BLOCK_INPUT_COUNT,
	/* Of a net, whose start and bounds are ways from the target, instead: */
	BLOCK_INPUT_X = BLOCK_INPUT_BEND,
	BLOCK_INPUT_Z = BLOCK_INPUT_CLOSE
};

/* One value a search each. */
enum {
	BLOCK_SETTING_LONGEST,   /* no offset moves further in an iteration */
	BLOCK_SETTING_LAST_STEP, /* the search ends when none moves further */
	BLOCK_SETTING_CURVATURE, /* how far second derivatives are probed */
	BLOCK_SETTING_FAIR,      /* of a net: w1 */
	BLOCK_SETTING_CLOSE,     /* of a net: w2 / h^4 */
	BLOCK_SETTING_COUNT
};
enum {
	BLOCK_OUTCOME_START, /* objective */
	BLOCK_OUTCOME_END,   /* objective */
	BLOCK_OUTCOME_STEP,  /* the longest movement of the last iteration */
	BLOCK_OUTCOME_CONVERGED,
	BLOCK_OUTCOME_ITERATIONS,
	BLOCK_OUTCOME_MOVES,  /* iterations that gained */
	BLOCK_OUTCOME_TRIALS, /* whole objectives, beyond one an iteration */
	BLOCK_OUTCOME_COUNT
};

/* What is known of a node of a line about its hats (block_hats.h), the same on every line: the number of
 * the first hat that it or a node beside it meets, how many from there on they meet, and of
 * BLOCK_HATS_MET from there on the values, and what each of the nodes below, at and above adds to the
 * first and to the second difference. */
enum { BLOCK_HATS_MET = 4 };
enum {
	BLOCK_HAT_FIRST,
	BLOCK_HAT_COUNT,
	BLOCK_HAT_VALUE,
	BLOCK_HAT_ONCE = BLOCK_HAT_VALUE + BLOCK_HATS_MET,
	BLOCK_HAT_TWICE = BLOCK_HAT_ONCE + 3 * BLOCK_HATS_MET,
	BLOCK_HAT_SIZE = BLOCK_HAT_TWICE + 3 * BLOCK_HATS_MET
};

/* Numbers of a row of the hats' table: a hat with those of its own line and of the next two. */
#define BLOCK_HAT_BAND(hats) (2 * (hats) + BLOCK_HATS_MET)
/* Numbers of all of a search's: the rows, the part of them that lines alone have, two ways. */
#define BLOCK_HAT_NUMBERS(lines, hats)                                                             \
	((lines) * (hats) * (BLOCK_HAT_BAND(hats) + BLOCK_HATS_MET + 2))

/* Moves remembered by the pattern move. */
enum { BLOCK_MEMORY = 3 };

/* Arrays of the state, lane by lane: those of the search (y where its start was) and these. */
enum {
	BLOCK_STATE_TRIAL = BLOCK_INPUT_COUNT,
	BLOCK_STATE_WAY,
	BLOCK_STATE_SLOPE,
	BLOCK_STATE_INVERSE, /* of the pivots of a line's table; 0 where the node is held */
	BLOCK_STATE_FACTOR_1,
	BLOCK_STATE_FACTOR_2,
	BLOCK_STATE_MOVE,                                     /* BLOCK_MEMORY arrays */
	BLOCK_STATE_CHANGE = BLOCK_STATE_MOVE + BLOCK_MEMORY, /* of the slope, along with each */
	BLOCK_STATE_COUNT = BLOCK_STATE_CHANGE + BLOCK_MEMORY
};
/* A search that takes rounds remembers no moves; in their place it has these. */
enum {
	BLOCK_STATE_BOTTOM = BLOCK_STATE_MOVE, /* of the round; where its step ends */
	BLOCK_STATE_GOING,                     /* slopes as far as the rounds went */
	BLOCK_STATE_SELF,                      /* tables before they are factored */
	BLOCK_STATE_NEXT,
	BLOCK_STATE_OVER
};

/* What the integrand's probes at a node tell, each times the weight of the node: slopes along the five
 * derivatives, curvatures along the second ones. */
enum {
	BLOCK_PROBE_P,
	BLOCK_PROBE_Q,
	BLOCK_PROBE_R,
	BLOCK_PROBE_S,
	BLOCK_PROBE_T,
	BLOCK_PROBE_RR,
	BLOCK_PROBE_SS,
	BLOCK_PROBE_TT,
	BLOCK_PROBE_RS,
	BLOCK_PROBE_RT,
	BLOCK_PROBE_ST,
	BLOCK_PROBE_COUNT
};

/* Sums of a line, added up over the lines in their order. */
enum { BLOCK_SUM_COUNT = 2 * BLOCK_MEMORY + 2 };

/* What a lane tells the host, and whether it has finished. */
enum { BLOCK_LANE_NUMBERS = BLOCK_OUTCOME_COUNT + 1 };

/* Numbers of a search's state in one lane: arrays, probes of so many lines, hats, sums, what lanes say. */
#define BLOCK_STATE_NUMBERS(lines, length, hats, slots)                                            \
	(BLOCK_STATE_COUNT * (lines) * (length) + BLOCK_PROBE_COUNT * (slots) * (length) +             \
	 BLOCK_HAT_NUMBERS(lines, hats) + BLOCK_SUM_COUNT * (lines) + BLOCK_LANE_NUMBERS)

#endif
