/* The best designs so far: whose offsets stay when only those of the best are kept. What it ends with
 * depends on the designs alone, not on their order. */
#ifndef BATTEN_SWEEP_BEST_H
#define BATTEN_SWEEP_BEST_H

#include "core/context.h"

typedef struct best_entry {
	double key;  /* less is better */
	uint64_t id; /* of equals the smaller is better */
} best_entry;

typedef struct sweep_best {
	batten_context *context;
	size_t capacity, count;
	best_entry *heap; /* the worst first */
} sweep_best;

/* Errors: MEMORY. */
batten_status sweep_best_create(batten_context *context, size_t capacity, sweep_best *out);
void sweep_best_release(sweep_best *best);

/* Whether a design is among the best now; *dropped gets the one that no longer is, UINT64_MAX: none. A
 * key of NaN is never good. */
bool sweep_best_offer(sweep_best *best, best_entry entry, uint64_t *dropped);

#endif
