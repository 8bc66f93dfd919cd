/* net_certify: the threads of the C path share the ends of a batch. */
#include "batch/net_certificate.h"
#include "batch/newton.h"
#include "batch/workers.h"

#include <math.h>

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	const net_plan *plan;
	const double *y_m;
	double gap, *polished_m;
	batten_certificate *certificates;
} batch;

/* Why an end cannot be judged, or NULL. */
static const char *fault_of(const batch *b, size_t which)
{
	const size_t poles = net_plan_poles(b->plan);
	const char *fault = b->plan->items[which].fault;
	for (size_t n = 0; n < poles && !fault; n++)
		if (!isfinite(b->y_m[which * poles + n]))
			fault = "a pole is not finite";
	return fault;
}

static batten_status run_one(const batch *b, net_certifier *c, size_t which)
{
	const size_t poles = net_plan_poles(b->plan);
	batten_certificate *out = &b->certificates[which];
	const char *fault = fault_of(b, which);
	if (fault) {
		*out = newton_refused(fault);
		return BATTEN_OK;
	}
	return b->polished_m
	           ? net_certifier_polish(c, which, b->gap, b->polished_m + which * poles, out)
	           : net_certifier_run(c, which, b->y_m + which * poles, out);
}

static batten_status run_on_reference(batch_work *work)
{
	const batch *b = (const batch *)work;
	net_certifier c;
	batten_status status = net_certifier_create(b->plan, &c);
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&work->queue, 1, &which) == 1)
		status = run_one(b, &c, which);
	net_certifier_release(&c);
	return status;
}

batten_status net_certify(const net_plan *plan, const double *y_m, double gap, double *polished_m,
                          batten_certificate *certificates)
{
	batch b = { .work = { .context = plan->context,
		                  .device = BATTEN_DEVICE_REFERENCE,
		                  .run_reference = run_on_reference },
		        .plan = plan,
		        .y_m = y_m,
		        .gap = gap,
		        .polished_m = polished_m,
		        .certificates = certificates };
	return batch_work_run_all(&b.work, plan->count, NULL);
}
