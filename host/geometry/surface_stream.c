/* batten_surface_grid_stream and batten_surface_energy_stream: batch after batch between a source and
 * a sink. */
#include "batch/workers.h"
#include "geometry/surface_batch.h"

/* Surfaces of a batch: full lanes on several devices; fewer where their values are many. */
enum { BATCH_MOST = 512, VALUES_MOST = 1 << 21 };

/* One stream; either sink is NULL. */
typedef struct stream {
	batten_context *context;
	batten_surface_source source;
	batten_surface_grid_sink grid_sink;
	batten_surface_energy_sink energy_sink;
	void *user;
	const batten_surface_samples *samples;
	const batten_surface_batch_options *options;
	size_t room, each, points; /* surfaces of a batch; values, samples of one */
	batten_surface *first;     /* surface 0: all others are like it */
	batten_surface **surfaces; /* [room] */
	double *values;
	uint8_t *singular;
	batten_surface_energies *energies;
	size_t taken, given;
	bool ended;
	batten_run run;
} stream;

static batten_status stream_allocate(stream *s)
{
	s->surfaces = batten_allocate(s->context, s->room, sizeof(batten_surface *));
	if (s->energy_sink) {
		s->energies = batten_allocate(s->context, s->room, sizeof *s->energies);
		return s->surfaces && s->energies ? BATTEN_OK : BATTEN_MEMORY;
	}
	s->values = batten_allocate(s->context, s->room, s->each * sizeof *s->values);
	s->singular = batten_allocate(s->context, s->room, s->points);
	return s->surfaces && s->values && s->singular ? BATTEN_OK : BATTEN_MEMORY;
}

static void drop_batch(stream *s, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		if (s->surfaces[i] != s->first)
			batten_surface_destroy(s->surfaces[i]);
		s->surfaces[i] = NULL;
	}
}

static void stream_release(stream *s)
{
	batten_surface_destroy(s->first);
	batten_release(s->context, (void *)s->surfaces);
	batten_release(s->context, s->values);
	batten_release(s->context, s->singular);
	batten_release(s->context, s->energies);
}

/* Fills a batch as far as there are surfaces; those taken are in it whatever is returned. */
static batten_status take_batch(stream *s, size_t *count)
{
	for (*count = 0; *count < s->room && !s->ended;) {
		batten_surface *surface = NULL;
		const batten_status status = s->source(s->user, s->taken, &surface);
		if (status != BATTEN_OK) {
			batten_surface_destroy(surface);
			return status;
		}
		if (!surface) {
			s->ended = true;
			break;
		}
		if (!s->first)
			s->first = surface;
		s->surfaces[(*count)++] = surface;
		s->taken++;
		const char *fault = surface_unlike(s->first, surface);
		if (fault)
			return batten_fail(s->context, BATTEN_USAGE, "surface %zu of a stream %s", s->taken - 1,
			                   fault);
	}
	return BATTEN_OK;
}

static batten_status run_batch(stream *s, size_t count)
{
	batten_run run = { .strict = true };
	const batten_surface *const *surfaces = (const batten_surface *const *)s->surfaces;
	const batten_status status = s->energy_sink
	                                 ? batten_surface_energy_batch(s->context, count, surfaces,
	                                                               s->options, s->energies, &run)
	                                 : batten_surface_grid_batch(s->context, count, surfaces,
	                                                             s->samples, s->options, s->values,
	                                                             s->singular, &run);
	if (status != BATTEN_OK)
		return status;
	batch_run_add(&s->run, &run);
	return BATTEN_OK;
}

static batten_status give_batch(stream *s, size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		status = s->energy_sink ? s->energy_sink(s->user, s->given, &s->energies[i])
		                        : s->grid_sink(s->user, s->given, s->values + i * s->each,
		                                       s->singular + i * s->points);
		s->given++;
	}
	return status;
}

static batten_status stream_run(stream *s, size_t *count, batten_run *run)
{
	s->run.strict = true;
	batten_status status = stream_allocate(s);
	while (status == BATTEN_OK && !s->ended) {
		size_t taken = 0;
		status = take_batch(s, &taken);
		if (status == BATTEN_OK && taken > 0)
			status = run_batch(s, taken);
		if (status == BATTEN_OK)
			status = give_batch(s, taken);
		drop_batch(s, taken);
	}
	stream_release(s);
	if (count)
		*count = s->given;
	if (run && status == BATTEN_OK)
		*run = s->run;
	return status;
}

batten_status batten_surface_grid_stream(batten_context *context, batten_surface_source source,
                                         batten_surface_grid_sink sink, void *user,
                                         const batten_surface_samples *samples,
                                         const batten_surface_batch_options *options, size_t *count,
                                         batten_run *run)
{
	batten_surface_batch_options chosen;
	if (count)
		*count = 0;
	batten_status status = surface_batch_options_check(context, options, &chosen);
	if (status == BATTEN_OK)
		status = surface_samples_check(context, "u", samples->u_count);
	if (status == BATTEN_OK)
		status = surface_samples_check(context, "v", samples->v_count);
	if (status != BATTEN_OK)
		return status;
	stream s = { .context = context,
		         .source = source,
		         .grid_sink = sink,
		         .user = user,
		         .samples = samples,
		         .options = options,
		         .points = samples->u_count * samples->v_count };
	s.each = s.points * batten_surface_output_count(chosen.output);
	const size_t fit = VALUES_MOST / s.each;
	s.room = fit < 1 ? 1 : fit > BATCH_MOST ? BATCH_MOST : fit;
	return stream_run(&s, count, run);
}

batten_status batten_surface_energy_stream(batten_context *context, batten_surface_source source,
                                           batten_surface_energy_sink sink, void *user,
                                           const batten_surface_batch_options *options,
                                           size_t *count, batten_run *run)
{
	stream s = { .context = context,
		         .source = source,
		         .energy_sink = sink,
		         .user = user,
		         .options = options,
		         .room = BATCH_MOST };
	batten_surface_batch_options chosen;
	if (count)
		*count = 0;
	const batten_status status = surface_batch_options_check(context, options, &chosen);
	return status == BATTEN_OK ? stream_run(&s, count, run) : status;
}
