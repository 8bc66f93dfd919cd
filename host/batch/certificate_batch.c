/* batten_search_certify_batch, batten_search_polish_batch: the threads of the C path share the ends of a batch. */
#include "batch/certificate.h"
#include "batch/newton.h"
#include "batch/workers.h"

#include <math.h>

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	search_plan *plan;
	batten_precision precision; /* of the searches */
	bool interior_penalty;
	const batten_search_problem *problems;
	const double *y_m;
	double gap, *polished_m; /* polished_m: y_m, to be polished to gap, or NULL */
	batten_certificate *certificates;
} batch;

static batten_status run_on_reference(batch_work *work)
{
	const batch *b = (const batch *)work;
	const size_t nodes = b->plan->station_count * b->plan->waterline_count;
	certifier c = { 0 };
	batten_status status = certifier_create(b->plan, b->precision, b->interior_penalty, &c);
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&work->queue, 1, &which) == 1)
		status = b->polished_m
		             ? certifier_polish(&c, &b->problems[which], b->gap,
		                                b->polished_m + which * nodes, &b->certificates[which])
		             : certifier_run(&c, &b->problems[which], b->y_m + which * nodes,
		                             &b->certificates[which]);
	certifier_release(&c);
	return status;
}

/* Why an end cannot be judged, or NULL. */
static const char *fault_of(const batch *b, size_t which)
{
	const batten_search_problem *problem = &b->problems[which];
	const size_t nodes = b->plan->station_count * b->plan->waterline_count;
	const char *fault = search_problem_fault(b->plan, problem);
	for (size_t n = 0; n < nodes && !fault; n++)
		if ((!problem->nodes || problem->nodes[n] != BATTEN_NODE_OUTSIDE) &&
		    !isfinite(b->y_m[which * nodes + n]))
			fault = "an offset is not finite";
	return fault;
}

static size_t order_sound(const batch *b, size_t count, size_t *order)
{
	size_t sound = 0;
	for (size_t p = 0; p < count; p++) {
		const char *fault = fault_of(b, p);
		if (!fault) {
			order[sound++] = p;
			continue;
		}
		b->certificates[p] = newton_refused(fault);
	}
	return sound;
}

static batten_status run_batch(batch *b, size_t count)
{
	batten_context *context = b->work.context;
	batten_run ran = { .strict = true };
	size_t *order = batten_allocate(context, count, sizeof *order);
	batten_status status = order ? BATTEN_OK : BATTEN_MEMORY;
	size_t sound = 0;
	if (status == BATTEN_OK) {
		sound = order_sound(b, count, order);
		status = work_queue_create(context, order, sound, &b->work.queue);
	}
	if (status == BATTEN_OK)
		status = batch_work_run(&b->work, &ran);
	work_queue_release(context, &b->work.queue);
	batten_release(context, order);
	if (status == BATTEN_OK && sound < count)
		status = batten_fail(context, BATTEN_INCOMPLETE,
		                     "%zu of %zu searches are invalid problems and were not judged",
		                     count - sound, count);
	return status;
}

static batten_status judge(batten_context *context, const batten_grid *grid, size_t count,
                           const batten_search_options *options, batch *b)
{
	batten_search_options chosen;
	batten_status status = search_options_check(context, options, &chosen);
	b->work = (batch_work){ .context = context,
		                    .device = BATTEN_DEVICE_REFERENCE,
		                    .run_reference = run_on_reference };
	b->precision = chosen.precision;
	b->interior_penalty = chosen.interior_penalty;
	if (status == BATTEN_OK && b->polished_m && b->interior_penalty)
		status = batten_fail(context, BATTEN_USAGE,
		                     "searches with an interior penalty end inside their boxes: none is "
		                     "polished, by steps that end at bounds");
	chosen.precision = BATTEN_F64;
	if (status == BATTEN_OK)
		status = search_plan_create(context, grid, count, b->problems, &chosen, &b->plan);
	if (status == BATTEN_OK && count > 0)
		status = run_batch(b, count);
	search_plan_destroy(b->plan);
	return status;
}

batten_status batten_search_certify_batch(batten_context *context, const batten_grid *grid,
                                          size_t count, const batten_search_problem *problems,
                                          const batten_search_options *options, const double *y_m,
                                          batten_certificate *certificates)
{
	batch b = { .problems = problems, .y_m = y_m, .certificates = certificates };
	return judge(context, grid, count, options, &b);
}

batten_status batten_search_polish_batch(batten_context *context, const batten_grid *grid,
                                         size_t count, const batten_search_problem *problems,
                                         const batten_search_options *options, double gap,
                                         double *y_m, batten_certificate *certificates)
{
	batch b = { .problems = problems,
		        .y_m = y_m,
		        .gap = gap,
		        .polished_m = y_m,
		        .certificates = certificates };
	if (!(gap > 0.0))
		return batten_fail(context, BATTEN_USAGE,
		                   "found a gap of %g to polish to, expected one above 0", gap);
	return judge(context, grid, count, options, &b);
}
