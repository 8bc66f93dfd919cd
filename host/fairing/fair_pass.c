/* Fairing by forward and inverse passes (thesis 5, 6): iterations, the row of each, when to stop, and
 * what is restored afterwards. */
#include "fairing/fairing.h"
#include "fairing/lines.h"
#include "fairing/pass.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static batten_status fill_row(batten_fairing *fairing, batten_fairing_row *row)
{
	const batten_hull *hull = fairing->faired;
	batten_hydrostatics form;
	batten_closeness closeness;
	lines_sum sum;
	const double draft = hull->draft_m;
	batten_status status = batten_hull_hydrostatics(fairing->context, hull, NULL, 1, &draft, &form);
	if (status == BATTEN_OK)
		status = batten_hull_closeness(fairing->context, hull, fairing->smoothed, &closeness);
	if (status == BATTEN_OK)
		status = lines_of_hull(hull, true, &sum);
	if (status != BATTEN_OK)
		return status;
	row->beam_m = 2.0 * batten_hull_half_beam_m(hull);
	row->cwp = form.cwp;
	row->cb = form.cb;
	row->cm = form.cm;
	row->lcb_pct_lbp_fwd = form.lcb_pct_lbp_fwd;
	row->volume_m3 = form.volume_m3;
	row->fn_per_m2 = sum.fn_per_m2;
	row->cn_pct = closeness.cn_pct;
	return BATTEN_OK;
}

static batten_status add_row(batten_fairing *fairing, unsigned iteration, bool restored)
{
	batten_fairing_row row = { .iteration = iteration, .restored = restored };
	size_t filled = 0;
	/* '?' cells follow their line, so that each row is that of the hull as it would be written. */
	batten_status status = hull_fill_unknown(fairing->faired, &filled);
	if (status == BATTEN_OK)
		status = fill_row(fairing, &row);
	/* Nobody asked for this draft: the file is at fault. */
	if (status == BATTEN_USAGE)
		status = BATTEN_INPUT;
	if (status == BATTEN_OK)
		fairing->rows[fairing->row_count++] = row;
	return status;
}

static const batten_fairing_row *last_row(const batten_fairing *fairing)
{
	return &fairing->rows[fairing->row_count - 1];
}

/* One iteration: from the values at here to those at there. *stop: it is the last, or (*undone) was
 * one too many. */
static batten_status iterate(batten_fairing *fairing, const batten_fair_options *options,
                             const batten_pass *pass, const double *here, double *there, bool *stop)
{
	const batten_fairing_row before = *last_row(fairing);
	batten_status status = batten_pass_batch(fairing->context, pass, 1, 1, here, there,
	                                         &fairing->run);
	if (status != BATTEN_OK)
		return status;
	pass_put_values(there, fairing->faired);
	status = add_row(fairing, before.iteration + 1, false);
	if (status != BATTEN_OK)
		return status;
	const batten_fairing_row *after = last_row(fairing);
	if (options->max_cn_pct > 0.0 && after->cn_pct > options->max_cn_pct) {
		fairing->pass.stop = BATTEN_STOP_MAX_CN;
		fairing->row_count--;
		pass_put_values(here, fairing->faired);
		*stop = true;
	} else if (options->least_gain_pct > 0.0 &&
	           before.fn_per_m2 - after->fn_per_m2 <
	               options->least_gain_pct / 100.0 * before.fn_per_m2) {
		fairing->pass.stop = BATTEN_STOP_GAIN;
		*stop = true;
	}
	return BATTEN_OK;
}

static batten_status run_iterations(batten_fairing *fairing, const batten_fair_options *options,
                                    const batten_pass *pass)
{
	const size_t values = batten_pass_describe(pass).value_count;
	double *y = batten_allocate(fairing->context, values, 2 * sizeof *y);
	if (!y)
		return BATTEN_MEMORY;
	batten_pass_values(pass, fairing->faired, y);
	batten_status status = add_row(fairing, 0, false);
	bool stop = false;
	for (unsigned i = 0; i < options->iterations && !stop && status == BATTEN_OK; i++)
		status = iterate(fairing, options, pass, y + (i % 2) * values, y + ((i + 1) % 2) * values,
		                 &stop);
	batten_release(fairing->context, y);
	return status;
}

static void scale(batten_hull *hull, double factor)
{
	for (size_t n = 0; n < hull_node_count(hull); n++)
		hull->y_m[n] *= factor;
	for (size_t e = 0; e < hull->end_count; e++)
		hull->ends[e].y_m *= factor;
}

/* Prismatic coefficient and centre of buoyancy, by moving sections along the ship. */
static batten_status restore_sections(batten_fairing *fairing, double cp, double lcb_pct)
{
	batten_context *context = fairing->context;
	batten_measures now;
	batten_hull *restored = NULL;
	batten_vary_outcome outcome;
	batten_vary_options options;
	batten_vary_options_default(&options);
	batten_status status = batten_hull_measure(context, fairing->faired, NULL, &now);
	if (status != BATTEN_OK)
		return status;
	options.method = BATTEN_VARY_LACKENBY;
	options.dcp_pct = 100.0 * (cp - now.cp) / now.cp;
	options.dlcb_pct = lcb_pct - now.lcb_pct_lbp_fwd;
	status = batten_hull_vary(context, fairing->faired, &options, &restored, &outcome);
	if (status != BATTEN_OK)
		return status;
	(void)snprintf(fairing->pass.warning, sizeof fairing->pass.warning, "%.200s", outcome.warning);
	batten_hull_destroy(fairing->faired);
	fairing->faired = restored;
	return BATTEN_OK;
}

static batten_status restore(batten_fairing *fairing, batten_restore what)
{
	const batten_fairing_row first = fairing->rows[0];
	const batten_fairing_row last = *last_row(fairing);
	batten_status status = BATTEN_OK;
	if (what == BATTEN_RESTORE_NONE)
		return BATTEN_OK;
	if (what == BATTEN_RESTORE_BEAM) {
		scale(fairing->faired, first.beam_m / last.beam_m);
	} else if (what == BATTEN_RESTORE_VOLUME) {
		scale(fairing->faired, first.volume_m3 / last.volume_m3);
	} else {
		/* C_P = C_B / C_M. */
		status = restore_sections(fairing, first.cb / first.cm, first.lcb_pct_lbp_fwd);
	}
	return status == BATTEN_OK ? add_row(fairing, last.iteration, true) : status;
}

static batten_status check_search_options(batten_context *context,
                                          const batten_fair_options *options, const char *word)
{
	if (options->lock_count > 0 || options->net_lock_count > 0 || options->lower ||
	    options->upper || options->weights_given || options->locked_edges ||
	    options->fixed_tangents || options->variables != BATTEN_VARIABLES_OFFSETS)
		return batten_fail(context, BATTEN_USAGE,
		                   "weights, locks, lower and upper offsets and nets are of the search; "
		                   "found one of them with the method %s",
		                   word);
	return BATTEN_OK;
}

batten_status fair_pass_check(batten_context *context, const batten_fair_options *options)
{
	const char *word = batten_fair_method_text((size_t)options->method);
	if (!word)
		return batten_fail(context, BATTEN_USAGE, "found method %d, which is none",
		                   (int)options->method);
	if (options->method == BATTEN_METHOD_SEARCH)
		return options->restore == BATTEN_RESTORE_NONE
		           ? BATTEN_OK
		           : batten_fail(context, BATTEN_USAGE,
		                         "to restore is of forward and inverse methods, not of the search");
	const batten_status status = check_search_options(context, options, word);
	if (status != BATTEN_OK || options->method == BATTEN_METHOD_SMOOTH)
		return status;
	if (options->iterations < 1 || options->iterations > BATTEN_ITERATIONS_MOST)
		return batten_fail(context, BATTEN_USAGE, "found %u iterations, expected 1 to %d",
		                   options->iterations, BATTEN_ITERATIONS_MOST);
	if (!(options->max_cn_pct >= 0.0) || !(options->least_gain_pct >= 0.0))
		return batten_fail(context, BATTEN_USAGE,
		                   "a limit of cn %g %% and a least gain of %g %%: neither is to be "
		                   "negative",
		                   options->max_cn_pct, options->least_gain_pct);
	if ((int)options->restore < BATTEN_RESTORE_NONE ||
	    (int)options->restore > BATTEN_RESTORE_CP_LCB)
		return batten_fail(context, BATTEN_USAGE, "found %d to restore, which is nothing",
		                   (int)options->restore);
	return BATTEN_OK;
}

static double cpu_seconds(void)
{
	struct timespec now;
	(void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

batten_status fair_pass(batten_fairing *fairing, const batten_fair_options *options)
{
	batten_context *context = fairing->context;
	const double begun = cpu_seconds();
	batten_pass_options how = options->pass;
	how.method = options->method;
	how.precision = options->search.precision;
	how.device = options->search.device == BATTEN_DEVICE_AUTO ? BATTEN_DEVICE_REFERENCE
	                                                          : options->search.device;
	batten_pass *pass = NULL;
	fairing->rows = batten_allocate(context, options->iterations + 2, sizeof *fairing->rows);
	batten_status status = fairing->rows ? batten_pass_create(context, fairing->faired, &how, &pass)
	                                     : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		fairing->pass.facts = batten_pass_describe(pass);
		status = run_iterations(fairing, options, pass);
	}
	if (status == BATTEN_OK)
		status = restore(fairing, options->restore);
	batten_pass_destroy(pass);
	fairing->pass.cpu_seconds = cpu_seconds() - begun;
	return status;
}
