/* The threads of a sweep: each has a context of its own, since one is used by one thread at a time. */
#ifndef BATTEN_SWEEP_CREW_H
#define BATTEN_SWEEP_CREW_H

#include "core/context.h"

typedef struct sweep_crew {
	batten_context *context; /* whose memory and errors */
	size_t count;
	batten_context **contexts; /* [count], of one thread each */
} sweep_crew;

/* As many as the context has threads. Errors: MEMORY. */
batten_status sweep_crew_create(batten_context *context, sweep_crew *out);
void sweep_crew_destroy(sweep_crew *crew);

/* Works on items first to first + count - 1. An error ends the whole; what fails for one item only is
 * kept with the item. */
typedef batten_status (*sweep_work)(batten_context *context, void *user, size_t first,
                                    size_t count);

/* Hands total items out in pieces of at most this size. */
batten_status sweep_crew_run(const sweep_crew *crew, size_t total, size_t piece, sweep_work work,
                             void *user);

#endif
