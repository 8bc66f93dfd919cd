/* search.net: a batch of noisy Wigley hulls as nets, whole searches for the y of the poles, by the block search and,
 * with --full, by the multilevel one: on the device against the plain C path, and against NLopt's LD_LBFGS with the
 * gradient by formula, one hull after another in plain C, to the same objective on every hull; where that cannot come
 * as low, as low as it can. The block search against the multilevel one on the same device, each to its own end. */
#include "nlopt_net_peer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
	COLUMNS = WIGLEY_NET_COLUMNS,
	ROWS = WIGLEY_NET_ROWS,
	POLES = WIGLEY_NET_POLES,
	DEGREE = WIGLEY_NET_DEGREE,
	GAUSS = WIGLEY_NET_GAUSS,
	MOST_HULLS = 64
};

/* Floating-point operations, the least known, root and division as one each, multiply-add as two. What is evaluated
 * beside these, and lanes whose search has ended, count nothing.
 *
 * The multilevel search: a sample of a direction: y and five derivatives moved (12), the normal, of which one part never changes (6), its square (4), the
 * second form (15) and the first (6), Gauss and mean curvature (3, 8), a division and a root (2), the density of bending
 * (4), both weights and sums (5); three evaluations a visit: that at y is known, its terms are kept. */
#define SAMPLE_OPERATIONS 65.0
#define EVALUATIONS 3.0

/* Samples that hats of a width see along one direction, summed over the hats with a pole between `low` and `high`,
 * those that may move. */
static double samples_along(int count, int width, int low, int high)
{
	int sum = 0;
	for (int centre = 0; centre < count - 1 + width; centre += width) {
		const int first = centre - width + 1 > 0 ? centre - width + 1 : 0;
		const int last = centre + width - 1 < count ? centre + width - 1 : count - 1;
		const int begin = first > DEGREE ? first - DEGREE : 0;
		const int end = last < count - DEGREE ? last + 1 : count - DEGREE;
		if (first <= high && last >= low)
			sum += GAUSS * (end - begin);
	}
	return sum;
}

/* Poles lie closer along v: hats are widened there first. */
static double iteration_operations(void)
{
	static const int widths[][2] = { { 1, 1 }, { 1, 2 }, { 1, 4 }, { 2, 4 }, { 4, 4 } };
	double samples = 0.0;
	for (size_t w = 0; w < sizeof widths / sizeof widths[0]; w++)
		samples += samples_along(COLUMNS, widths[w][0], 1, COLUMNS - 2) *
		           samples_along(ROWS, widths[w][1], 1, ROWS - 1);
	return EVALUATIONS * SAMPLE_OPERATIONS * samples;
}

/* The block search, an iteration. A sample: derivatives from its columns (48), normal, metric and second form (9, 15,
 * 5, 20), divisions and roots (9), squares of curvatures (14), both for probes and for the trial; four probes close by
 * (55 each) and three anywhere (18), their differences and the slopes (36), what its columns change (72), six pairs of
 * columns (36) and four of one (26), slopes along columns (48). A line: columns from poles (24 each), pairs of columns
 * (168; of one 132), slopes along poles (24). The factors of the band and their use. */
static double block_iteration_operations(void)
{
	enum {
		SAMPLES_U = GAUSS * (COLUMNS - DEGREE),
		LINES = GAUSS * (ROWS - DEGREE),
		BAND = DEGREE * ROWS + DEGREE
	};
	const double pairs = (COLUMNS - 1) + (COLUMNS - 2) + (COLUMNS - 3);
	const double sample = 2.0 * 120.0 + 4.0 * 55.0 + 18.0 + 36.0 + 72.0 + 6.0 * 36.0 + 4.0 * 26.0 +
	                      48.0;
	const double line = COLUMNS * (2.0 * 24.0 + 132.0 + 24.0) + pairs * 168.0;
	return LINES * (SAMPLES_U * sample + line) + POLES * BAND * (BAND + 1.0 + 4.0);
}

/* Hulls and what searches them. */
typedef struct searched {
	wigley_net *w;
	batten_search_algorithm algorithm;
} searched;

/* One run: the batch, searched whole. */
static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	const searched *of = user;
	const wigley_net *w = of->w;
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	batten_net_options options;
	batten_net_options_default(&options);
	options.search.algorithm = of->algorithm;
	options.search.device = device;
	options.search.precision = precision;
	return batten_net_search_batch(settings->context, w->count, w->problems, &options,
	                               known ? w->known_y : w->y, known ? w->known : w->results, run);
}

static bool same_results(const void *user)
{
	const wigley_net *w = ((const searched *)user)->w;
	return memcmp(w->y, w->known_y, w->count * POLES * sizeof *w->y) == 0;
}

/* What a run works, by the iterations that it takes. */
static batten_status count_operations(const bench_settings *settings, searched *of,
                                      batten_precision precision, double *operations)
{
	const batten_status status = run_batch(settings, of, settings->device, precision, NULL);
	double iterations = 0.0;
	for (size_t h = 0; h < of->w->count; h++)
		iterations += of->w->results[h].iterations;
	*operations = iterations * (of->algorithm == BATTEN_ALGORITHM_BLOCK
	                                ? block_iteration_operations()
	                                : iteration_operations());
	return status;
}

/* ---- NLopt ---- */

typedef struct rival {
	const bench_settings *settings;
	wigley_net *w;
	searched *of;
	batten_precision precision;
	nlopt_net_search_function *search;
	double most[MOST_HULLS]; /* what it must reach */
} rival;

/* Objective and gradient of the rival are ours: by the certificate of a start that the noise bends, and by
 * differences of it. */
static batten_status check_gradient(const rival *r, nlopt_net_objective_function *objective)
{
	enum { PROBES = 8 };
	const double step = 1e-5;
	const wigley_net *w = r->w;
	batten_net_options options;
	batten_net_problem problems[2 * PROBES + 1];
	batten_certificate found[2 * PROBES + 1];
	double gradient[POLES];
	double *y = calloc(2 * PROBES + 1, sizeof(double[POLES]));
	batten_net_options_default(&options);
	if (!y)
		return BATTEN_MEMORY;
	size_t probed[PROBES];
	double largest = 0.0;
	for (size_t p = 0; p < 2 * PROBES + 1; p++) {
		problems[p] = w->problems[0];
		/* Away from the target, so that closeness has a slope. */
		for (size_t n = 0; n < POLES; n++)
			y[p * POLES + n] = w->poles[3 * n + 1] * 0.98;
	}
	for (size_t p = 0; p < PROBES; p++) {
		probed[p] = 17 + p * (POLES - 17) / PROBES;
		y[2 * p * POLES + probed[p]] += step;
		y[(2 * p + 1) * POLES + probed[p]] -= step;
	}
	const double *here = y + 2 * PROBES * POLES;
	const double value = objective(w, 0, here, gradient);
	batten_status status = batten_net_certify_batch(r->settings->context, 2 * PROBES + 1, problems,
	                                                &options, y, found);
	if (status == BATTEN_OK && !(fabs(value - found[2 * PROBES].objective) <= 1e-12 * value))
		status = BATTEN_INTERNAL;
	for (size_t n = 0; n < POLES; n++)
		largest = fmax(largest, fabs(gradient[n]));
	for (size_t p = 0; p < PROBES && status == BATTEN_OK; p++) {
		const double slope = (found[2 * p].objective - found[2 * p + 1].objective) / (2.0 * step);
		if (!(fabs(slope - gradient[probed[p]]) <= 1e-6 * largest))
			status = BATTEN_INTERNAL;
	}
	free(y);
	return status;
}

static batten_status run_rival(const rival *r)
{
	for (size_t h = 0; h < r->w->count; h++)
		if (!(r->search(r->w, h, r->most[h], r->w->known_y + h * POLES) <= r->most[h]))
			return BATTEN_INTERNAL;
	return BATTEN_OK;
}

/* Both ends are the minimum; the higher one of each hull is what the rival is timed to. */
static batten_status prepare_rival(rival *r)
{
	const double within = r->precision == BATTEN_F64 ? 1e-6 : 2e-4;
	batten_certificate ends[MOST_HULLS];
	batten_net_options options;
	batten_net_options_default(&options);
	options.search.precision = r->precision;
	batten_status status = run_batch(r->settings, r->of, r->settings->device, r->precision, NULL);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE)
		status = batten_net_certify_batch(r->settings->context, r->w->count, r->w->problems,
		                                  &options, r->w->y, ends);
	for (size_t h = 0; h < r->w->count && status == BATTEN_OK; h++) {
		const double other = r->search(r->w, h, -HUGE_VAL, r->w->known_y + h * POLES);
		if (!(fabs(other - ends[h].objective) <= within * ends[h].objective))
			status = BATTEN_INTERNAL;
		/* Sums in another order differ by rounding. */
		r->most[h] = fmax(other, ends[h].objective) * (1.0 + 1e-12);
	}
	return status;
}

static batten_status run_against_rival(rival *r, bench_row *row)
{
	bench_pairs pairs;
	batten_status status = prepare_rival(r);
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		double begun = bench_seconds(r->settings);
		status = run_batch(r->settings, r->of, r->settings->device, r->precision, NULL);
		pairs.value[p] = bench_seconds(r->settings) - begun;
		begun = bench_seconds(r->settings);
		if (status == BATTEN_OK)
			status = run_rival(r);
		pairs.reference[p] = bench_seconds(r->settings) - begun;
	}
	if (status != BATTEN_OK)
		return status;
	row->reference = "nlopt_lbfgs";
	row->percent_of_peak = 0.0;
	row->bound = NULL;
	bench_pairs_judge(&pairs, 1e6 / (double)r->w->count, row);
	r->settings->emit(row, r->settings->user);
	return BATTEN_OK;
}

/* ---- the multilevel search ---- */

/* Each to its own end, at one minimum. */
static batten_status run_against_multilevel(const rival *r, bench_row *row)
{
	const double within = r->precision == BATTEN_F64 ? 1e-6 : 2e-4;
	const bench_settings *settings = r->settings;
	searched other = { r->w, BATTEN_ALGORITHM_MULTILEVEL };
	double ends[MOST_HULLS];
	bench_pairs pairs;
	batten_status status = run_batch(settings, r->of, settings->device, r->precision, NULL);
	for (size_t h = 0; h < r->w->count; h++)
		ends[h] = r->w->results[h].objective_end;
	if (status == BATTEN_OK)
		status = run_batch(settings, &other, settings->device, r->precision, NULL);
	for (size_t h = 0; h < r->w->count && status == BATTEN_OK; h++)
		if (!(fabs(r->w->results[h].objective_end - ends[h]) <= within * ends[h]))
			status = BATTEN_INTERNAL;
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		double begun = bench_seconds(settings);
		status = run_batch(settings, r->of, settings->device, r->precision, NULL);
		pairs.value[p] = bench_seconds(settings) - begun;
		begun = bench_seconds(settings);
		if (status == BATTEN_OK)
			status = run_batch(settings, &other, settings->device, r->precision, NULL);
		pairs.reference[p] = bench_seconds(settings) - begun;
	}
	if (status != BATTEN_OK)
		return status;
	row->reference = "multilevel";
	row->percent_of_peak = 0.0;
	row->bound = NULL;
	bench_pairs_judge(&pairs, 1e6 / (double)r->w->count, row);
	settings->emit(row, settings->user);
	return BATTEN_OK;
}

static batten_status run_case(const bench_settings *settings, double w2, batten_precision precision,
                              batten_search_algorithm algorithm)
{
	const bool block = algorithm == BATTEN_ALGORITHM_BLOCK;
	wigley_net w;
	searched of = { &w, algorithm };
	rival other = { .settings = settings, .w = &w, .of = &of, .precision = precision };
	other.search = (nlopt_net_search_function *)bench_open_peer("batten_nlopt_peer",
	                                                            "nlopt_net_search");
	nlopt_net_objective_function *objective = (nlopt_net_objective_function *)bench_open_peer(
		"batten_nlopt_peer", "nlopt_net_objective");
	bench_row row = { .name = "search.net", .precision = precision, .unit = "us per hull" };
	batten_status status = wigley_net_create(settings, block ? MOST_HULLS : 16, w2, &w);
	bench_contest contest = {
		.workload = &of, .run = run_batch, .same = same_results, .scale = 1e6 / (double)w.count
	};
	(void)snprintf(row.case_name, sizeof row.case_name, "%s w %g batch %zu",
	               batten_search_algorithm_text(algorithm), w2, w.count);
	if (status == BATTEN_OK)
		status = count_operations(settings, &of, precision, &contest.operations);
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &contest, &row);
	if (status == BATTEN_OK && block)
		status = run_against_multilevel(&other, &row);
	if (status == BATTEN_OK && other.search && objective) {
		status = check_gradient(&other, objective);
		if (status == BATTEN_OK)
			status = run_against_rival(&other, &row);
	}
	wigley_net_release(&w);
	return status;
}

batten_status bench_search_net(const bench_settings *settings)
{
	static const double quick[] = { 1e3 };
	static const double full[] = { 10.0, 1e3, 1e5 };
	const double *weights = settings->full ? full : quick;
	const int count = settings->full ? 3 : 1;
	batten_status status = BATTEN_OK;
	for (int c = 0; c < 2 * count && status == BATTEN_OK; c++) {
		const batten_precision precision = c < count ? BATTEN_F64 : BATTEN_F32;
		status = run_case(settings, weights[c % count], precision, BATTEN_ALGORITHM_BLOCK);
		if (status == BATTEN_OK && settings->full)
			status = run_case(settings, weights[c % count], precision, BATTEN_ALGORITHM_MULTILEVEL);
	}
	return status;
}
