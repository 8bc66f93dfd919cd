/* search.block: the block search to its own end, against others to the same objective on every hull: the
 * multilevel search, and NLopt's LD_LBFGS with the gradient by formula, one hull after another in plain C.
 * Where a rival cannot come as low, it runs as low as it can, and the block search to its end all the
 * same. How far each must run is found beforehand. */
#include "nlopt_peer.h"

#include <math.h>
#include <stdio.h>

enum { HULLS = 16, ITERATIONS = 20000, REPEATS = 8 /* of what takes two milliseconds */ };

typedef struct contest {
	const bench_settings *settings;
	wigley_case w;
	wigley_side block, multilevel;
	double ends[WIGLEY_MOST_HULLS]; /* of the block search */
	double most[WIGLEY_MOST_HULLS]; /* what the rival must reach */
	nlopt_peer_function *nlopt;     /* NULL: not there */
	double within;                  /* how far ends may lie apart, as a part */
} contest;

typedef batten_status rival(contest *c);

static wigley_side make_side(const contest *c, batten_search_algorithm algorithm,
                             batten_precision precision)
{
	wigley_side s = { .count = HULLS };
	batten_search_options_default(&s.options);
	s.options.algorithm = algorithm;
	s.options.device = c->settings->device;
	s.options.precision = precision;
	s.options.iteration_limit = ITERATIONS;
	return s;
}

/* Both ends are the minimum; the higher one of each hull is what the rival is timed to. */
static batten_status agree(contest *c, const double *others)
{
	for (size_t h = 0; h < HULLS; h++) {
		if (!(fabs(others[h] - c->ends[h]) <= c->within * c->ends[h]))
			return BATTEN_INTERNAL;
		c->most[h] = others[h] > c->ends[h] ? others[h] : c->ends[h];
	}
	return BATTEN_OK;
}

static batten_status run_block(contest *c)
{
	batten_status status = BATTEN_OK;
	for (int r = 0; r < REPEATS && status == BATTEN_OK; r++)
		status = wigley_search(c->settings, &c->block, &c->w, c->w.results, NULL);
	return status;
}

static batten_status run_multilevel(contest *c)
{
	return wigley_search(c->settings, &c->multilevel, &c->w, c->w.results, NULL);
}

static batten_status run_nlopt(contest *c)
{
	for (size_t h = 0; h < HULLS; h++) {
		double *y = c->w.known_y + h * WIGLEY_NODES;
		if (!(c->nlopt(&c->w, h, c->most[h], y) <= c->most[h]))
			return BATTEN_INTERNAL;
	}
	return BATTEN_OK;
}

static batten_status prepare_multilevel(contest *c)
{
	double others[WIGLEY_MOST_HULLS] = { 0.0 };
	batten_status status = wigley_ends(c->settings, &c->multilevel, &c->w, others);
	if (status == BATTEN_OK)
		status = agree(c, others);
	if (status == BATTEN_OK)
		status = wigley_calibrate(c->settings, &c->multilevel, &c->w, c->most, HULLS);
	return status;
}

static batten_status prepare_nlopt(contest *c)
{
	double others[WIGLEY_MOST_HULLS] = { 0.0 };
	for (size_t h = 0; h < HULLS; h++)
		others[h] = c->nlopt(&c->w, h, -HUGE_VAL, c->w.known_y + h * WIGLEY_NODES);
	const batten_status status = agree(c, others);
	/* Sums in another order differ by rounding. */
	for (size_t h = 0; h < HULLS; h++)
		c->most[h] *= 1.0 + 1e-12;
	return status;
}

static batten_status pair(contest *c, rival *other, bench_row *row)
{
	bench_pairs pairs;
	batten_status status = BATTEN_OK;
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++)
		for (int i = 0; i < 2 && status == BATTEN_OK; i++) {
			const double begun = bench_seconds(c->settings);
			status = i ? other(c) : run_block(c);
			const double seconds = bench_seconds(c->settings) - begun;
			*(i ? &pairs.reference[p] : &pairs.value[p]) = i ? seconds : seconds / REPEATS;
		}
	if (status != BATTEN_OK)
		return status;
	bench_pairs_judge(&pairs, 1e6 / HULLS, row);
	c->settings->emit(row, c->settings->user);
	return BATTEN_OK;
}

static batten_status run_case(contest *c, double raw_w2, batten_precision precision)
{
	bench_row row = { .name = "search.block", .precision = precision, .unit = "us per hull" };
	batten_run ran = { .strict = true };
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w %g", raw_w2);
	c->block = make_side(c, BATTEN_ALGORITHM_BLOCK, precision);
	c->multilevel = make_side(c, BATTEN_ALGORITHM_MULTILEVEL, precision);
	c->within = precision == BATTEN_F64 ? 1e-6 : 2e-4;
	batten_status status = wigley_search(c->settings, &c->block, &c->w, c->w.results, &ran);
	(void)snprintf(row.device, sizeof row.device, "%s", ran.device);
	if (status == BATTEN_OK)
		status = wigley_ends(c->settings, &c->block, &c->w, c->ends);
	if (status == BATTEN_OK)
		status = prepare_multilevel(c);
	row.reference = "multilevel";
	if (status == BATTEN_OK)
		status = pair(c, run_multilevel, &row);
	if (status != BATTEN_OK || !c->nlopt)
		return status;
	row.reference = "nlopt_lbfgs";
	status = prepare_nlopt(c);
	return status == BATTEN_OK ? pair(c, run_nlopt, &row) : status;
}

batten_status bench_search_block(const bench_settings *settings)
{
	static const double weights[] = { 1e3, 10.0, 1e2, 1e4, 1e5 };
	const size_t count = settings->full ? sizeof weights / sizeof weights[0] : 1;
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		contest c = { .settings = settings };
		c.nlopt = (nlopt_peer_function *)bench_open_peer("batten_nlopt_peer", "nlopt_peer_search");
		status = wigley_case_create(HULLS, weights[i], &c.w) ? BATTEN_OK : BATTEN_MEMORY;
		for (int precision = 0; precision < 2 && status == BATTEN_OK; precision++)
			status = run_case(&c, weights[i], precision ? BATTEN_F32 : BATTEN_F64);
		wigley_case_release(&c.w);
	}
	return status;
}
