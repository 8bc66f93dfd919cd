/* A block of designs on its way from parameters to numbers: what the stages work on, one after the
 * other, each over the whole block. */
#ifndef BATTEN_SWEEP_BLOCK_H
#define BATTEN_SWEEP_BLOCK_H

#include "hull/hull.h"
#include "sweep/crew.h"
#include "sweep/plan.h"

/* What became of a design; the words stand in the database. */
#define SWEEP_STATUS_LIST(X)                                                                       \
	X(DONE, "done")                                                                                \
	X(NOT_CONVERGED, "not_converged")                                                              \
	X(REJECTED, "rejected")                                                                        \
	X(VARY_FAILED, "vary_failed")                                                                  \
	X(FAIR_FAILED, "fair_failed")                                                                  \
	X(MEASURE_FAILED, "measure_failed")

typedef enum sweep_status {
#define SWEEP_STATUS_ENTRY(name, word) SWEEP_##name,
	SWEEP_STATUS_LIST(SWEEP_STATUS_ENTRY)
#undef SWEEP_STATUS_ENTRY
} sweep_status;

const char *sweep_status_word(sweep_status status);

typedef struct sweep_design {
	sweep_status status;
	char reason[256];  /* one line, "" when nothing is to be said */
	batten_hull *form; /* all but its half-breadths where that is not the parent's, else NULL */
	plan_fairing_numbers fairing;
	batten_search_result search;
	bool measured;
	double measures[SWEEP_MEASURE_COUNT];
	bool kept; /* its offsets go into the database */
} sweep_design;

/* Half-breadths stand side by side, so that a stage gives a device all of them at once. */
typedef struct sweep_block {
	batten_context *context;
	const sweep_plan *plan;
	size_t capacity, count, nodes_each;
	uint64_t first; /* number of the first design */
	sweep_design *designs;
	double *parameters;                /* [count][parameters] */
	batten_hydrostatics *hydrostatics; /* [count][drafts] */
	uint8_t *nodes;                    /* [count][waterlines][stations], as the two below */
	double *varied_y_m, *faired_y_m;   /* the second NULL when the plan does not fair */
} sweep_block;

/* Errors: MEMORY. */
batten_status sweep_block_create(const sweep_plan *plan, size_t capacity, sweep_block *out);
void sweep_block_destroy(sweep_block *block);

/* Empties the block and gives it designs first to first + count - 1, with their parameters. */
void sweep_block_begin(sweep_block *block, uint64_t first, size_t count);

/* A design as a hull that borrows its parts from block and plan, whose memory is taken from context: as
 * it was varied, or as it ends. */
batten_hull sweep_block_varied(const sweep_block *block, batten_context *context, size_t i);
batten_hull sweep_block_final(const sweep_block *block, batten_context *context, size_t i);

/* Puts a variant in its place; what of it is the parent's is not kept twice. The hull becomes the
 * block's. */
void sweep_block_take(sweep_block *block, size_t i, batten_hull *variant);

/* Marks a design as failed, for this reason. */
void sweep_design_fail(sweep_design *design, sweep_status status, const char *reason);

/* Whether a design is still on its way. */
bool sweep_design_lives(const sweep_design *design);

#endif
