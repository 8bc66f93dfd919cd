#include "wigley_case.h"

#include <math.h>
#include <stdlib.h>

void wigley_case_release(wigley_case *w)
{
	free(w->start);
	free(w->y);
	free(w->known_y);
	free(w->problems);
	free(w->results);
	free(w->known);
}

bool wigley_case_create(size_t count, double raw_w2, wigley_case *w)
{
	*w = (wigley_case){ .count = count };
	w->start = calloc(count * WIGLEY_NODES, sizeof *w->start);
	w->y = calloc(count * WIGLEY_NODES, sizeof *w->y);
	w->known_y = calloc(count * WIGLEY_NODES, sizeof *w->known_y);
	w->problems = calloc(count, sizeof *w->problems);
	w->results = calloc(count, sizeof *w->results);
	w->known = calloc(count, sizeof *w->known);
	if (!w->start || !w->y || !w->known_y || !w->problems || !w->results || !w->known)
		return false;
	for (int i = 0; i < WIGLEY_STATIONS; i++)
		w->x[i] = 0.8 * i;
	for (int k = 0; k < WIGLEY_WATERLINES; k++)
		w->z[k] = k / 19.0;
	for (size_t h = 0; h < count; h++) {
		uint32_t state = 2654435761u * (uint32_t)(h + 1);
		for (int n = 0; n < WIGLEY_NODES; n++) {
			state = state * 1664525u + 1013904223u;
			const double u = (w->x[n % WIGLEY_STATIONS] - 8.0) / 8.0;
			const double v = 1.0 - w->z[n / WIGLEY_STATIONS];
			const double y = 0.8 * (1.0 - u * u) * (1.0 - v * v) +
			                 0.02 * ((double)(state >> 8) / (1u << 24) - 0.5);
			w->start[h * WIGLEY_NODES + (size_t)n] = y < 0.0 ? 0.0 : y > 0.8 ? 0.8 : y;
			w->upper[n] = 0.8;
		}
		w->problems[h] = (batten_search_problem){ .start_m = w->start + h * WIGLEY_NODES,
			                                      .target_m = w->start + h * WIGLEY_NODES,
			                                      .lower_m = w->lower,
			                                      .upper_m = w->upper,
			                                      .w1 = 1.0,
			                                      .w2 = 0.4096 * raw_w2,
			                                      .half_beam_m = 0.8 };
	}
	return true;
}

batten_status wigley_search(const bench_settings *settings, const wigley_side *s,
                            const wigley_case *w, batten_search_result *results, batten_run *ran)
{
	const batten_grid grid = { WIGLEY_STATIONS, WIGLEY_WATERLINES, w->x, w->z };
	const batten_status status = batten_search_batch(settings->context, &grid, s->count,
	                                                 w->problems, &s->options, w->y, results, ran);
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

batten_status wigley_ends(const bench_settings *settings, const wigley_side *s,
                          const wigley_case *w, double values[WIGLEY_MOST_HULLS])
{
	const batten_grid grid = { WIGLEY_STATIONS, WIGLEY_WATERLINES, w->x, w->z };
	batten_certificate certificates[WIGLEY_MOST_HULLS];
	batten_status status = wigley_search(settings, s, w, w->results, NULL);
	if (status == BATTEN_OK)
		status = batten_search_certify_batch(settings->context, &grid, s->count, w->problems,
		                                     &s->options, w->y, certificates);
	for (size_t h = 0; h < s->count && status == BATTEN_OK; h++)
		values[h] = certificates[h].objective;
	return status;
}

batten_status wigley_calibrate(const bench_settings *settings, wigley_side *s, const wigley_case *w,
                               const double *most, size_t judged)
{
	batten_status status = BATTEN_OK;
	double values[WIGLEY_MOST_HULLS] = { 0.0 };
	for (int halvings = 1; halvings < 30 && status == BATTEN_OK; halvings++) {
		bool reached = true;
		s->options.last_step = ldexp(s->options.first_step, -halvings);
		status = wigley_ends(settings, s, w, values);
		for (size_t h = 0; h < judged && h < s->count; h++)
			reached = reached && values[h] <= most[h];
		if (status == BATTEN_OK && reached)
			return BATTEN_OK;
	}
	return status == BATTEN_OK ? BATTEN_INTERNAL : status;
}
