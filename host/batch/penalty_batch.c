/* The multilevel search with an interior penalty (thesis 7.1; Fiacco and McCormick's sequence of
 * unconstrained minimisations): rounds of the search with r a hundredth of the one before, each from where
 * that ended, searches that are done left out. */
#include "batch/certificate.h"
#include "batch/search_batch.h"
#include "batch/search_pack.h"
#include "batch/search_result.h"

#include <math.h>
#include <string.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/grid_energy.h"
#include "shared/multilevel.h"

enum { ROUND_LIMIT = 16 };
/* Part of the box's width that a search starts inside at least; r's part of the objective at the start. */
#define PUSH 1e-3
#define FIRST_PART 0.1
/* Ways to bounds shrink to this from round to round, and steps begin so much shorter. */
#define NEARER (1.0 - INSIDE_PART)
/* Rounds end where r's part of the objective is below this; an objective that ends below a part of what it was
 * counts as that part. */
#define PENALTY_F64 1e-10
#define PENALTY_F32 1e-5
#define FALLEN 1e-6

typedef struct rounds {
	const search_call *call;
	size_t nodes;
	certifier certifier;
	/* Of those that go on, side by side: number, problem, r, end of the round. */
	size_t open, *which;
	batten_search_problem *problems;
	double *penalties, *y_m;
	batten_search_result *results;
} rounds;

static bool on_hull(const batten_search_problem *problem, size_t node)
{
	return !problem->nodes || problem->nodes[node] != BATTEN_NODE_OUTSIDE;
}

/* The penalty at y, of r = 1. */
static double penalty_at(const rounds *r, const batten_search_problem *problem, const double *y)
{
	double sum = 0.0;
	for (size_t n = 0; n < r->nodes; n++) {
		double lower = problem->lower_m[n];
		double upper = problem->upper_m[n];
		if (on_hull(problem, n) && search_box_inside(r->call->options->precision, &lower, &upper))
			sum += node_penalty(1.0, y[n], lower, upper);
	}
	return sum;
}

/* The start, at least PUSH of the width inside the box; in its middle where the precision has no number
 * there. */
static void push_inside(const rounds *r, const batten_search_problem *problem, double *y)
{
	const batten_precision precision = r->call->options->precision;
	for (size_t n = 0; n < r->nodes; n++) {
		double lower = problem->lower_m[n];
		double upper = problem->upper_m[n];
		y[n] = problem->start_m[n];
		if (!on_hull(problem, n))
			continue;
		y[n] = fmin(fmax(y[n], lower), upper);
		if (!search_box_inside(precision, &lower, &upper))
			continue;
		const double push = PUSH * (upper - lower);
		y[n] = fmin(fmax(y[n], lower + push), upper - push);
		if (precision == BATTEN_F32)
			y[n] = (double)(float)y[n];
		if (!(y[n] > lower && y[n] < upper))
			y[n] = lower + 0.5 * (upper - lower);
	}
}

static const char *fault_of(const rounds *r, const batten_search_problem *problem)
{
	const char *fault = search_weights_fault(r->call->options->precision, problem->w1, problem->w2,
	                                         problem->half_beam_m);
	return fault ? fault : search_problem_fault(r->certifier.plan, problem);
}

/* Starts inside; r of the first round. What cannot be searched goes there too, to be refused. */
static void begin(rounds *r)
{
	const search_call *call = r->call;
	r->open = call->count;
	for (size_t p = 0; p < call->count; p++) {
		const batten_search_problem *problem = &call->problems[p];
		double *y = call->y_m + p * r->nodes;
		r->which[p] = p;
		r->problems[p] = *problem;
		if (fault_of(r, problem))
			continue;
		const double objective = certifier_objective(&r->certifier, problem, problem->start_m);
		push_inside(r, problem, y);
		const double penalty = penalty_at(r, problem, y);
		r->problems[p].start_m = y;
		r->penalties[p] = penalty > 0.0 ? FIRST_PART * objective / penalty : 0.0;
		call->results[p] = (batten_search_result){ .end = BATTEN_SEARCH_STATIONARY,
			                                       .objective_start = objective };
	}
}

/* Adds a round's result to those before; whether r is to fall further. */
static bool add_round(rounds *r, size_t at)
{
	const size_t p = r->which[at];
	const batten_search_result *found = &r->results[at];
	batten_search_result *total = &r->call->results[p];
	double *y = r->call->y_m + p * r->nodes;
	if (found->end == BATTEN_SEARCH_REFUSED) {
		*total = *found;
		return false;
	}
	memcpy(y, r->y_m + at * r->nodes, r->nodes * sizeof *y);
	total->iterations += found->iterations;
	total->probes += found->probes;
	total->last_step_m = found->last_step_m;
	if (found->end == BATTEN_SEARCH_LIMIT)
		total->end = BATTEN_SEARCH_LIMIT;
	else if (found->end == BATTEN_SEARCH_CONVERGED || total->end == BATTEN_SEARCH_LIMIT)
		total->end = BATTEN_SEARCH_CONVERGED;
	const double part = r->penalties[at] * penalty_at(r, &r->call->problems[p], y);
	const double objective = fmax(found->objective_end - part, FALLEN * total->objective_start);
	const bool is_f64 = r->call->options->precision == BATTEN_F64;
	return part > (is_f64 ? PENALTY_F64 : PENALTY_F32) * objective;
}

/* Those that go on, moved together. */
static void close_round(rounds *r)
{
	const size_t count = r->open;
	r->open = 0;
	for (size_t i = 0; i < count; i++) {
		if (!add_round(r, i))
			continue;
		r->which[r->open] = r->which[i];
		r->problems[r->open] = r->problems[i];
		r->penalties[r->open++] = r->penalties[i] * NEARER * NEARER;
	}
}

static batten_status run_rounds(rounds *r, batten_run *run)
{
	batten_status status = BATTEN_OK;
	batten_search_options options = *r->call->options;
	search_call call = *r->call;
	call.problems = r->problems;
	call.options = &options;
	call.y_m = r->y_m;
	call.results = r->results;
	call.penalties = r->penalties;
	for (unsigned round = 0; round < ROUND_LIMIT && r->open > 0 && status == BATTEN_OK; round++) {
		batten_run told = { .strict = true };
		call.count = r->open;
		status = multilevel_batch_run(&call, &told);
		if (status != BATTEN_OK)
			break;
		batch_run_add(run, &told);
		close_round(r);
		options.first_step = fmin(options.first_step,
		                          fmax(NEARER * options.first_step, 8.0 * options.last_step));
	}
	return status;
}

static batten_status allocate(rounds *r)
{
	batten_context *context = r->call->context;
	const size_t count = r->call->count;
	r->which = batten_allocate(context, count, sizeof *r->which);
	r->problems = batten_allocate(context, count, sizeof *r->problems);
	r->penalties = batten_allocate(context, count, sizeof *r->penalties);
	r->results = batten_allocate(context, count, sizeof *r->results);
	r->y_m = batten_allocate(context, count, r->nodes * sizeof *r->y_m);
	return r->which && r->problems && r->penalties && r->results && r->y_m ? BATTEN_OK
	                                                                       : BATTEN_MEMORY;
}

static void release(rounds *r)
{
	batten_context *context = r->call->context;
	certifier_release(&r->certifier);
	batten_release(context, r->which);
	batten_release(context, r->problems);
	batten_release(context, r->penalties);
	batten_release(context, r->results);
	batten_release(context, r->y_m);
}

/* The ends as what they are without the penalty. */
static void conclude(rounds *r)
{
	for (size_t p = 0; p < r->call->count; p++)
		if (r->call->results[p].end != BATTEN_SEARCH_REFUSED)
			r->call->results[p].objective_end = certifier_objective(
				&r->certifier, &r->call->problems[p], r->call->y_m + p * r->nodes);
	/* r did not fall far enough: the precision has no numbers nearer to the bounds. */
	for (size_t i = 0; i < r->open; i++)
		r->call->results[r->which[i]].end = BATTEN_SEARCH_LIMIT;
}

batten_status penalty_batch_run(const search_call *call, batten_run *run)
{
	rounds r = { .call = call, .nodes = call->grid->station_count * call->grid->waterline_count };
	search_plan *plan = NULL;
	batten_search_options exact = *call->options;
	exact.precision = BATTEN_F64;
	exact.interior_penalty = false;
	batten_status status = search_plan_create(call->context, call->grid, call->count,
	                                          call->problems, &exact, &plan);
	if (status == BATTEN_OK)
		status = certifier_create(plan, call->options->precision, true, &r.certifier);
	if (status == BATTEN_OK)
		status = allocate(&r);
	if (status == BATTEN_OK) {
		begin(&r);
		status = run_rounds(&r, run);
	}
	if (status == BATTEN_OK)
		conclude(&r);
	release(&r);
	search_plan_destroy(plan);
	return status;
}
