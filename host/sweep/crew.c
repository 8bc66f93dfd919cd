#include "sweep/crew.h"

#include <stdatomic.h>

/* One run of work, shared by its threads. */
struct shift {
	sweep_work work;
	void *user;
	size_t total, piece;
	atomic_size_t next;
};

struct hand {
	struct shift *shift;
	batten_context *context;
	pthread_t thread;
	bool started;
	batten_status status;
};

batten_status sweep_crew_create(batten_context *context, sweep_crew *out)
{
	sweep_crew crew = { .context = context };
	crew.contexts = batten_allocate(context, context->options.threads, sizeof *crew.contexts);
	if (!crew.contexts)
		return BATTEN_MEMORY;
	batten_context_options options = context->options;
	options.threads = 1;
	options.log = NULL;
	batten_status status = BATTEN_OK;
	while (crew.count < context->options.threads && status == BATTEN_OK) {
		status = batten_context_create(&options, &crew.contexts[crew.count]);
		crew.count += status == BATTEN_OK;
	}
	if (status != BATTEN_OK) {
		sweep_crew_destroy(&crew);
		return batten_fail_memory(context);
	}
	*out = crew;
	return BATTEN_OK;
}

void sweep_crew_destroy(sweep_crew *crew)
{
	for (size_t i = 0; i < crew->count; i++)
		batten_context_destroy(crew->contexts[i]);
	if (crew->contexts)
		batten_release(crew->context, crew->contexts);
	*crew = (sweep_crew){ 0 };
}

static void *run_hand(void *argument)
{
	struct hand *hand = argument;
	struct shift *shift = hand->shift;
	while (hand->status == BATTEN_OK) {
		const size_t first = atomic_fetch_add(&shift->next, shift->piece);
		if (first >= shift->total)
			break;
		const size_t left = shift->total - first;
		hand->status = shift->work(hand->context, shift->user, first,
		                           left < shift->piece ? left : shift->piece);
	}
	return NULL;
}

batten_status sweep_crew_run(const sweep_crew *crew, size_t total, size_t piece, sweep_work work,
                             void *user)
{
	struct shift shift = { .work = work, .user = user, .total = total, .piece = piece };
	struct hand *hands = batten_allocate(crew->context, crew->count, sizeof *hands);
	if (!hands)
		return BATTEN_MEMORY;
	for (size_t h = 0; h < crew->count; h++)
		hands[h] = (struct hand){ .shift = &shift, .context = crew->contexts[h] };
	/* A thread that cannot be started leaves its share to the others; the first is this one. */
	for (size_t h = 1; h < crew->count && h * piece < total; h++)
		hands[h].started = pthread_create(&hands[h].thread, NULL, run_hand, &hands[h]) == 0;
	(void)run_hand(&hands[0]);
	batten_status status = BATTEN_OK;
	for (size_t h = 0; h < crew->count; h++) {
		if (hands[h].started)
			(void)pthread_join(hands[h].thread, NULL);
		if (status == BATTEN_OK && hands[h].status != BATTEN_OK)
			status = batten_fail(crew->context, hands[h].status, "%s",
			                     batten_context_error(hands[h].context));
	}
	batten_release(crew->context, hands);
	return status;
}
