/* search.block: the block search to its own end, 256 hulls in a batch, against others to the same
 * objective on every one of the first 16: the multilevel search, the same block search with slopes by
 * formula, NLopt's LD_LBFGS with the gradient by formula, one hull after another in plain C, and on one
 * hull its LN_PRAXIS and LN_SBPLX. Where a rival cannot come as low, it runs as low as it can, and the
 * block search to its end all the same. How far each must run is found beforehand. */
#include "nlopt_peer.h"

#include <math.h>
#include <stdio.h>

enum { HULLS = 16, BATCH = 256, ITERATIONS = 20000 };
#define VALUES_SECONDS 120.0

/* Floating-point operations of an iteration, counted in the source, divisions and roots as one: at a node
 * with an energy (probes, objective of the trial) and at every node (tables, their factors, the way). */
enum { OPERATIONS_A_TERM = 297, OPERATIONS_A_NODE = 199 };
enum { TERMS = (WIGLEY_STATIONS - 2) * (WIGLEY_WATERLINES - 2) };

typedef struct contest {
	const bench_settings *settings;
	wigley_case w;
	wigley_side block, gradient, multilevel;
	double operations;              /* of a batch of the block search */
	double ends[WIGLEY_MOST_HULLS]; /* of the block search */
	double most[WIGLEY_MOST_HULLS]; /* what the rival must reach */
	nlopt_peer_function *nlopt;     /* NULL: not there */
	nlopt_peer_values_function *nlopt_values;
	double within; /* how far ends may lie apart, as a part */
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
	return wigley_search(c->settings, &c->block, &c->w, c->w.results, NULL);
}

static batten_status run_gradient(contest *c)
{
	return wigley_search(c->settings, &c->gradient, &c->w, c->w.results, NULL);
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

/* hulls: how many the rival runs. */
static batten_status pair(contest *c, rival *other, size_t hulls, bench_row *row)
{
	bench_pairs pairs;
	double share[BENCH_PAIRS] = { 0.0 };
	double peaks[BENCH_PAIRS] = { 0.0 };
	batten_status status = BATTEN_OK;
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		const double peak = peaks[p] = bench_peak(row->precision);
		for (int i = 0; i < 2 && status == BATTEN_OK; i++) {
			const double begun = bench_seconds(c->settings);
			status = i ? other(c) : run_block(c);
			const double seconds = bench_seconds(c->settings) - begun;
			*(i ? &pairs.reference[p] : &pairs.value[p]) = seconds / (double)(i ? hulls : BATCH);
			if (!i && peak > 0.0)
				share[p] = 100.0 * c->operations / (peak * seconds);
		}
	}
	if (status != BATTEN_OK)
		return status;
	bench_pairs_judge(&pairs, 1e6, row);
	row->percent_of_peak = bench_is_cpu(c->settings) ? bench_median(share) : 0.0;
	row->bound = row->percent_of_peak > 0.0 ? "multiply-adds" : NULL;
	row->peak = bench_median(peaks);
	c->settings->emit(row, c->settings->user);
	return BATTEN_OK;
}

static batten_status prepare_gradient(contest *c)
{
	double others[WIGLEY_MOST_HULLS] = { 0.0 };
	wigley_side judged = c->gradient;
	judged.count = HULLS;
	const batten_status status = wigley_ends(c->settings, &judged, &c->w, others);
	return status == BATTEN_OK ? agree(c, others) : status;
}

/* The ends of the first hulls, and what a batch takes. */
static batten_status prepare_block(contest *c, batten_run *ran)
{
	wigley_side judged = c->block;
	judged.count = HULLS;
	batten_status status = wigley_search(c->settings, &c->block, &c->w, c->w.results, ran);
	c->operations = 0.0;
	for (size_t h = 0; h < BATCH && status == BATTEN_OK; h++)
		c->operations += (double)c->w.results[h].iterations *
		                 (OPERATIONS_A_TERM * TERMS + OPERATIONS_A_NODE * WIGLEY_NODES);
	return status == BATTEN_OK ? wigley_ends(c->settings, &judged, &c->w, c->ends) : status;
}

/* Against algorithms without gradients, to 1e-4 above the block search's end: minutes a hull, so the first
 * one, once, for at most VALUES_SECONDS; where that is not enough the ratio is what it is at least. */
static batten_status run_values(contest *c, bench_row *row)
{
	static const struct {
		nlopt_peer_algorithm algorithm;
		const char *name, *unfinished;
	} rivals[] = { { NLOPT_PEER_PRAXIS, "nlopt_praxis", "nlopt_praxis, not there" },
		           { NLOPT_PEER_SBPLX, "nlopt_sbplx", "nlopt_sbplx, not there" } };
	(void)snprintf(row->case_name, sizeof row->case_name, "21x20 w 1e4 gap 1e-4");
	row->percent_of_peak = 0.0;
	row->bound = NULL;
	for (size_t r = 0; r < sizeof rivals / sizeof rivals[0]; r++) {
		const double stop = (1.0 + 1e-4) * c->ends[0];
		double begun = bench_seconds(c->settings);
		const batten_status status = run_block(c);
		if (status != BATTEN_OK)
			return status;
		row->value = 1e6 * (bench_seconds(c->settings) - begun) / BATCH;
		begun = bench_cpu_seconds();
		const double found = c->nlopt_values(&c->w, 0, rivals[r].algorithm, stop, VALUES_SECONDS,
		                                     c->w.known_y);
		row->reference_value = 1e6 * (bench_cpu_seconds() - begun);
		row->reference = found <= stop ? rivals[r].name : rivals[r].unfinished;
		row->ratio = row->reference_value / row->value;
		row->ratio_low = row->ratio_high = row->ratio;
		c->settings->emit(row, c->settings->user);
	}
	return BATTEN_OK;
}

static batten_status run_case(contest *c, double raw_w2, batten_precision precision)
{
	bench_row row = { .name = "search.block", .precision = precision, .unit = "us per hull" };
	batten_run ran = { .strict = true };
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w %g", raw_w2);
	c->block = make_side(c, BATTEN_ALGORITHM_BLOCK, precision);
	c->block.count = BATCH;
	c->gradient = c->block;
	c->gradient.options.analytic_slopes = true;
	c->multilevel = make_side(c, BATTEN_ALGORITHM_MULTILEVEL, precision);
	c->within = precision == BATTEN_F64 ? 1e-6 : 2e-4;
	batten_status status = prepare_block(c, &ran);
	(void)snprintf(row.device, sizeof row.device, "%s", ran.device);
	if (status == BATTEN_OK)
		status = prepare_multilevel(c);
	row.reference = "multilevel";
	if (status == BATTEN_OK)
		status = pair(c, run_multilevel, HULLS, &row);
	if (status == BATTEN_OK)
		status = prepare_gradient(c);
	row.reference = "line_gradient";
	if (status == BATTEN_OK)
		status = pair(c, run_gradient, BATCH, &row);
	if (status != BATTEN_OK || !c->nlopt)
		return status;
	row.reference = "nlopt_lbfgs";
	status = prepare_nlopt(c);
	if (status == BATTEN_OK)
		status = pair(c, run_nlopt, HULLS, &row);
	if (status == BATTEN_OK && c->nlopt_values && c->settings->full && raw_w2 == 1e4)
		status = run_values(c, &row);
	return status;
}

batten_status bench_search_block(const bench_settings *settings)
{
	static const double weights[] = { 1e3, 10.0, 1e2, 1e4, 1e5 };
	const size_t count = settings->full ? sizeof weights / sizeof weights[0] : 1;
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		contest c = { .settings = settings };
		c.nlopt = (nlopt_peer_function *)bench_open_peer("batten_nlopt_peer", "nlopt_peer_search");
		c.nlopt_values = (nlopt_peer_values_function *)bench_open_peer("batten_nlopt_peer",
		                                                               "nlopt_peer_search_values");
		status = wigley_case_create(BATCH, weights[i], &c.w) ? BATTEN_OK : BATTEN_MEMORY;
		for (int precision = 0; precision < 2 && status == BATTEN_OK; precision++)
			status = run_case(&c, weights[i], precision ? BATTEN_F32 : BATTEN_F64);
		wigley_case_release(&c.w);
	}
	return status;
}
