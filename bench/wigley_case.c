#include "wigley_case.h"

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
