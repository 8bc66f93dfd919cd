/* batten_fair_stream: searches between a source and a sink, batch after batch, in the memory of one. */
#include "batch/search_plan.h"
#include "batch/workers.h"

#include <string.h>

/* Searches of a batch: full lanes on several devices, fewer where grids are large. */
enum { BATCH_MOST = 1024, BATCH_BYTES = 16 << 20 };

/* Arrays of a problem that are copied: start, target, bounds, factors of closeness. */
enum { ARRAYS = 5 };

typedef struct stream {
	batten_context *context;
	const batten_grid *grid;
	batten_fair_source source;
	batten_fair_sink sink;
	void *user;
	const batten_search_options *options;
	size_t nodes, room; /* of a grid; searches of a batch */
	batten_search_problem *problems;
	batten_search_result *results;
	double *arrays, *y_m; /* [room][ARRAYS][nodes], [room][nodes] */
	uint8_t *marks;       /* [room][nodes] */
	size_t taken, given;
	bool ended, incomplete;
	batten_run run;
} stream;

static batten_status stream_allocate(stream *s)
{
	s->nodes = s->grid->station_count * s->grid->waterline_count;
	const size_t fit = BATCH_BYTES / (s->nodes * ((ARRAYS + 1) * sizeof(double) + 1));
	s->room = fit < 1 ? 1 : fit > BATCH_MOST ? BATCH_MOST : fit;
	s->problems = batten_allocate(s->context, s->room, sizeof *s->problems);
	s->results = batten_allocate(s->context, s->room, sizeof *s->results);
	s->arrays = batten_allocate(s->context, s->room, ARRAYS * s->nodes * sizeof *s->arrays);
	s->y_m = batten_allocate(s->context, s->room, s->nodes * sizeof *s->y_m);
	s->marks = batten_allocate(s->context, s->room, s->nodes);
	return s->problems && s->results && s->arrays && s->y_m && s->marks ? BATTEN_OK : BATTEN_MEMORY;
}

static void stream_release(stream *s)
{
	void *memory[] = { s->problems, s->results, s->arrays, s->y_m, s->marks };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(s->context, memory[i]);
}

/* Makes the arrays of a problem the stream's own. */
static batten_status keep_problem(stream *s, size_t place)
{
	batten_search_problem *problem = &s->problems[place];
	const double **arrays[ARRAYS] = { &problem->start_m, &problem->target_m, &problem->lower_m,
		                              &problem->upper_m, &problem->closeness_weight };
	for (size_t a = 0; a < ARRAYS; a++) {
		double *own = s->arrays + (place * ARRAYS + a) * s->nodes;
		if (!*arrays[a] && arrays[a] != &problem->closeness_weight)
			return batten_fail(s->context, BATTEN_USAGE,
			                   "search %zu of a stream has a start, but no target or bounds",
			                   s->taken);
		if (!*arrays[a])
			continue;
		memcpy(own, *arrays[a], s->nodes * sizeof *own);
		*arrays[a] = own;
	}
	if (problem->nodes) {
		memcpy(s->marks + place * s->nodes, problem->nodes, s->nodes);
		problem->nodes = s->marks + place * s->nodes;
	}
	return BATTEN_OK;
}

static batten_status take_batch(stream *s, size_t *count)
{
	for (*count = 0; *count < s->room && !s->ended; s->taken++) {
		s->problems[*count] = (batten_search_problem){ .w1 = 0.0 };
		batten_status status = s->source(s->user, s->taken, &s->problems[*count]);
		if (status != BATTEN_OK)
			return status;
		if (!s->problems[*count].start_m) {
			s->ended = true;
			break;
		}
		status = keep_problem(s, (*count)++);
		if (status != BATTEN_OK)
			return status;
	}
	return BATTEN_OK;
}

static batten_status run_batch(stream *s, size_t count)
{
	batten_run run = { .strict = true };
	const batten_status status = batten_search_batch(s->context, s->grid, count, s->problems,
	                                                 s->options, s->y_m, s->results, &run);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		return status;
	s->incomplete |= status == BATTEN_INCOMPLETE;
	batch_run_add(&s->run, &run);
	return BATTEN_OK;
}

static batten_status give_batch(stream *s, size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++, s->given++)
		status = s->sink(s->user, s->given, &s->results[i], s->y_m + i * s->nodes);
	return status;
}

static batten_status stream_run(stream *s)
{
	batten_status status = stream_allocate(s);
	while (status == BATTEN_OK && !s->ended) {
		size_t taken = 0;
		status = take_batch(s, &taken);
		if (status == BATTEN_OK && taken > 0)
			status = run_batch(s, taken);
		if (status == BATTEN_OK)
			status = give_batch(s, taken);
	}
	stream_release(s);
	return status;
}

batten_status batten_fair_stream(batten_context *context, const batten_grid *grid,
                                 batten_fair_source source, batten_fair_sink sink, void *user,
                                 const batten_search_options *options, size_t *count,
                                 batten_run *run)
{
	stream s = { .context = context,
		         .grid = grid,
		         .source = source,
		         .sink = sink,
		         .user = user,
		         .options = options };
	batten_search_options chosen;
	s.run.strict = true;
	if (count)
		*count = 0;
	batten_status status = search_options_check(context, options, &chosen);
	if (status == BATTEN_OK)
		status = search_grid_check(context, grid);
	if (status != BATTEN_OK)
		return status;
	status = stream_run(&s);
	if (count)
		*count = s.given;
	if (status != BATTEN_OK)
		return status;
	if (run)
		*run = s.run;
	return s.incomplete ? batten_fail(context, BATTEN_INCOMPLETE,
	                                  "searches of a stream were refused or met their limit")
	                    : BATTEN_OK;
}
