/* search.multilevel against `textbook`, the search of the thesis with every probe the whole objective, on
 * the plain C path: time of a probe, and time to an objective. How far each search runs to get there is
 * found beforehand: the longest last step that reaches it on every hull. */
#include "wigley_case.h"

#include <stdio.h>

enum { HULLS = 16, TEXTBOOK_HULLS = 1, SWEEP_LIMIT = 20000 };
#define RAW_W2 1e3
#define GAP 5e-5

static wigley_side make_side(batten_search_algorithm algorithm, int device,
                             batten_precision precision)
{
	wigley_side s = { .count = algorithm == BATTEN_ALGORITHM_TEXTBOOK ? TEXTBOOK_HULLS : HULLS };
	batten_search_options_default(&s.options);
	s.options.algorithm = algorithm;
	s.options.device = device;
	s.options.precision = precision;
	if (algorithm == BATTEN_ALGORITHM_TEXTBOOK) {
		s.options.iteration_limit = SWEEP_LIMIT;
		s.options.last_step = 2e-6; /* 1e-6 B, as in the literature's notes */
	}
	return s;
}

static uint64_t probes_of(const wigley_side *s, const batten_search_result *results)
{
	uint64_t sum = 0;
	for (size_t h = 0; h < s->count; h++)
		sum += results[h].probes;
	return sum;
}

/* Pairs of one side and the textbook's, each by the hull, or by the probe. */
static batten_status pair(const bench_settings *settings, const wigley_side *value,
                          const wigley_side *textbook, const wigley_case *w, bool by_probe,
                          bench_row *row)
{
	bench_pairs pairs;
	const wigley_side *const sides[2] = { value, textbook };
	batten_run ran = { .strict = true };
	batten_status status = wigley_search(settings, value, w, w->results, &ran);
	(void)snprintf(row->device, sizeof row->device, "%s", ran.device);
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++)
		for (int i = 0; i < 2 && status == BATTEN_OK; i++) {
			const double begun = bench_seconds(settings);
			status = wigley_search(settings, sides[i], w, w->results, NULL);
			const double seconds = bench_seconds(settings) - begun;
			const double units = by_probe ? (double)probes_of(sides[i], w->results)
			                              : (double)sides[i]->count;
			*(i ? &pairs.reference[p] : &pairs.value[p]) = seconds / units;
		}
	if (status != BATTEN_OK)
		return status;
	row->unit = by_probe ? "ns per probe" : "us per hull";
	bench_pairs_judge(&pairs, by_probe ? 1e9 : 1e6, row);
	settings->emit(row, settings->user);
	return BATTEN_OK;
}

static bench_row make_row(const char *case_name, batten_precision precision)
{
	bench_row row = { .name = "search.multilevel",
		              .reference = "textbook",
		              .precision = precision };
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w %g %s", RAW_W2, case_name);
	return row;
}

/* Time of a probe: few sweeps are as good as a whole search, and after few all lanes still search. */
static batten_status time_probes(const bench_settings *settings, const wigley_case *w)
{
	const struct {
		int device;
		batten_precision precision;
		const char *name;
	} cases[] = { { BATTEN_DEVICE_REFERENCE, BATTEN_F64, "plain C" },
		          { settings->device, BATTEN_F64, "probes" },
		          { settings->device, BATTEN_F32, "probes" } };
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < sizeof cases / sizeof cases[0] && status == BATTEN_OK; i++) {
		wigley_side value = make_side(BATTEN_ALGORITHM_MULTILEVEL, cases[i].device,
		                              cases[i].precision);
		wigley_side textbook = make_side(BATTEN_ALGORITHM_TEXTBOOK, BATTEN_DEVICE_REFERENCE,
		                                 cases[i].precision);
		textbook.options.last_step = 1e-3;
		value.options.last_step = 1e-9;
		value.options.iteration_limit = 25;
		bench_row row = make_row(cases[i].name, cases[i].precision);
		status = pair(settings, &value, &textbook, w, true, &row);
	}
	return status;
}

/* To the textbook search's own end, in f64; to a gap, in f32. */
static batten_status time_searches(const bench_settings *settings, const wigley_case *w)
{
	double best[WIGLEY_MOST_HULLS] = { 0.0 };
	double ends[WIGLEY_MOST_HULLS] = { 0.0 };
	wigley_side textbook = make_side(BATTEN_ALGORITHM_TEXTBOOK, BATTEN_DEVICE_REFERENCE,
	                                 BATTEN_F64);
	wigley_side value = make_side(BATTEN_ALGORITHM_MULTILEVEL, settings->device, BATTEN_F64);
	batten_status status = wigley_ends(settings, &textbook, w, ends);
	if (status == BATTEN_OK)
		status = wigley_ends(settings, &value, w, best);
	if (status == BATTEN_OK)
		status = wigley_calibrate(settings, &value, w, ends, TEXTBOOK_HULLS);
	if (status == BATTEN_OK) {
		bench_row row = make_row("to its end", BATTEN_F64);
		status = pair(settings, &value, &textbook, w, false, &row);
	}
	for (size_t h = 0; h < HULLS; h++)
		best[h] *= 1.0 + GAP;
	value = make_side(BATTEN_ALGORITHM_MULTILEVEL, settings->device, BATTEN_F32);
	if (status == BATTEN_OK)
		status = wigley_calibrate(settings, &value, w, best, HULLS);
	if (status == BATTEN_OK)
		status = wigley_calibrate(settings, &textbook, w, best, TEXTBOOK_HULLS);
	if (status == BATTEN_OK) {
		bench_row row = make_row("to gap 5e-5", BATTEN_F32);
		status = pair(settings, &value, &textbook, w, false, &row);
	}
	return status;
}

batten_status bench_search_textbook(const bench_settings *settings)
{
	wigley_case w;
	batten_status status = wigley_case_create(HULLS, RAW_W2, &w) ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = time_probes(settings, &w);
	if (status == BATTEN_OK)
		status = time_searches(settings, &w);
	wigley_case_release(&w);
	return status;
}
