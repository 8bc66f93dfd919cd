/* A batch of searches as the caller gave it, and the algorithms that run one. Each has files of its
 * own, named after it; the multilevel search's are those named search_. */
#ifndef BATTEN_BATCH_SEARCH_BATCH_H
#define BATTEN_BATCH_SEARCH_BATCH_H

#include "batch/search_plan.h"
#include "batch/workers.h"

typedef struct search_call {
	batten_context *context;
	const batten_grid *grid;
	size_t count;
	const batten_search_problem *problems;
	const batten_search_options *options; /* checked; of the algorithm that is to run */
	double *y_m;                          /* [count][waterlines][stations] */
	batten_search_result *results;        /* [count] */
	const double *penalties;              /* [count] as in search_plan, or NULL */
} search_call;

/* Of the textbook search too. Runs the batch: every result is set, but for its algorithm, or an error returned. run is told what
 * ran. Errors: USAGE, DEVICE, KERNEL, MEMORY. */
batten_status multilevel_batch_run(const search_call *call, batten_run *run);
batten_status block_batch_run(const search_call *call, batten_run *run);

/* The multilevel search with an interior penalty: r falls from round to round until the penalty is no
 * matter. Objectives of the results are those without it. Else as above. */
batten_status penalty_batch_run(const search_call *call, batten_run *run);

/* What every algorithm does with a plan: refuses what cannot be searched, queues the rest by w2/w1 and
 * works the queue off. Errors: those of batch_work_run(). */
batten_status search_batch_work(const search_call *call, const search_plan *plan, batch_work *work,
                                batten_run *run);

#endif
