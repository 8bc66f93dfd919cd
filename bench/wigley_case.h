/* The searches of the literature's notes: 21 x 20 noisy Wigley hulls, L 16, B 1.6, D 1 m, noise 0.01 m,
 * every offset free in 0 .. B/2. */
#ifndef BATTEN_BENCH_WIGLEY_CASE_H
#define BATTEN_BENCH_WIGLEY_CASE_H

#include "bench.h"

enum {
	WIGLEY_STATIONS = 21,
	WIGLEY_WATERLINES = 20,
	WIGLEY_NODES = WIGLEY_STATIONS * WIGLEY_WATERLINES
};

typedef struct wigley_case {
	size_t count;
	double x[WIGLEY_STATIONS], z[WIGLEY_WATERLINES], lower[WIGLEY_NODES], upper[WIGLEY_NODES];
	double *start, *y, *known_y;
	batten_search_problem *problems;
	batten_search_result *results, *known;
} wigley_case;

/* Literature quotes w2/w1 with lengths in metres; without dimension it is h^4 = 0.4096 times that.
 * False when memory is short; release it all the same. */
bool wigley_case_create(size_t count, double raw_w2, wigley_case *w);
void wigley_case_release(wigley_case *w);

/* ---- searches of the case, to be compared ---- */
enum { WIGLEY_MOST_HULLS = 64 };

/* One side: its searches and how many of the case's hulls it runs, WIGLEY_MOST_HULLS at most. */
typedef struct wigley_side {
	batten_search_options options;
	size_t count;
} wigley_side;

/* Searches into w->y; an iteration limit that is met is no error. ran may be NULL. */
batten_status wigley_search(const bench_settings *settings, const wigley_side *s,
                            const wigley_case *w, batten_search_result *results, batten_run *ran);

/* Searches, and says what objectives the ends in w->y have in f64, whatever the searches were in. */
batten_status wigley_ends(const bench_settings *settings, const wigley_side *s,
                          const wigley_case *w, double values[WIGLEY_MOST_HULLS]);

/* Sets the longest last step, halved from the first, that ends at or below `most` on the first
 * `judged` hulls. INTERNAL: none does. */
batten_status wigley_calibrate(const bench_settings *settings, wigley_side *s, const wigley_case *w,
                               const double *most, size_t judged);

#endif
