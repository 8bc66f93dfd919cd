/* The block search in plain C, one search at a time: what kernels/block_search.cl does, equal to it bit
 * for bit. Layout is the kernel's (shared/block_layout.h), with one lane. */
#ifndef BATTEN_REFERENCE_BLOCK_SEARCH_H
#define BATTEN_REFERENCE_BLOCK_SEARCH_H

typedef struct reference_block_search {
	int lines, length, iteration_limit;
	int hats;     /* of a line; 0: none */
	int rounds;   /* of an iteration; 0: one, bent by the moves remembered */
	int analytic; /* slopes of the integrand by formula, not by probes */
} reference_block_search;

/* Lines of probes that are kept: all where there are hats or rounds. */
#define REFERENCE_BLOCK_SLOTS(lines, hats, rounds) ((hats) > 0 || (rounds) > 0 ? (lines) + 2 : 3)
/* Numbers of scratch that a search takes. */
#define REFERENCE_BLOCK_SCRATCH(lines, length, hats)                                               \
	BLOCK_STATE_NUMBERS(lines, length, hats, REFERENCE_BLOCK_SLOTS(lines, hats, 1))

/* stencils: STENCIL_SIZE a line, then a node of a line, then BLOCK_HAT_SIZE a node of a line. input [BLOCK_INPUT_COUNT][nodes], settings
 * [BLOCK_SETTING_COUNT], outcome [BLOCK_OUTCOME_COUNT]. The end of the search takes the place of its
 * start. */
void reference_block_search_f64(const reference_block_search *shared, const double *stencils,
                                double *input, const double *settings, double *outcome,
                                double *scratch);
void reference_block_search_f32(const reference_block_search *shared, const float *stencils,
                                float *input, const float *settings, float *outcome,
                                float *scratch);

#endif
