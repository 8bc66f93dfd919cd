/* batten_net_search_batch, and what its ends are worth. */
#include "batch/net_batch.h"
#include "batch/net_certificate.h"
#include "batch/net_closeness.h"
#include "batch/search_result.h"
#include "fairing/net_problem.h"

batten_status batten_net_search_batch(batten_context *context, size_t count,
                                      const batten_net_problem *problems,
                                      const batten_net_options *options, double *y_m,
                                      batten_search_result *results, batten_run *run)
{
	net_problems p;
	batten_run told = { .strict = true };
	batten_status status = net_problems_open(context, count, problems, options, &p);
	p.plan.y_m = y_m;
	p.plan.results = results;
	if (status == BATTEN_OK && count > 0)
		status = net_batch_run(&p.plan, &told);
	net_problems_close(&p);
	if (status != BATTEN_OK)
		return status;
	for (size_t n = 0; n < count; n++)
		results[n].algorithm = p.plan.block ? BATTEN_ALGORITHM_BLOCK : BATTEN_ALGORITHM_MULTILEVEL;
	if (run)
		*run = told;
	return search_results_judge(context, count, results);
}

/* polished_m: y_m, to go on from, or NULL. */
static batten_status certify(batten_context *context, size_t count,
                             const batten_net_problem *problems, const batten_net_options *options,
                             const double *y_m, double gap, double *polished_m,
                             batten_certificate *certificates)
{
	net_problems p;
	size_t refused = 0;
	batten_status status = net_problems_open(context, count, problems, options, &p);
	if (status == BATTEN_OK && count > 0)
		status = net_certify(&p.plan, y_m, gap, polished_m, certificates);
	net_problems_close(&p);
	for (size_t n = 0; status == BATTEN_OK && n < count; n++)
		refused += certificates[n].objective != certificates[n].objective;
	if (refused > 0)
		return batten_fail(context, BATTEN_INCOMPLETE,
		                   "%zu of %zu searches are invalid problems and were not judged", refused,
		                   count);
	return status;
}

batten_status batten_net_certify_batch(batten_context *context, size_t count,
                                       const batten_net_problem *problems,
                                       const batten_net_options *options, const double *y_m,
                                       batten_certificate *certificates)
{
	return certify(context, count, problems, options, y_m, 0.0, NULL, certificates);
}

batten_status batten_net_polish_batch(batten_context *context, size_t count,
                                      const batten_net_problem *problems,
                                      const batten_net_options *options, double gap, double *y_m,
                                      batten_certificate *certificates)
{
	if (!(gap > 0.0))
		return batten_fail(context, BATTEN_USAGE,
		                   "found a gap of %g to polish to, expected one above 0", gap);
	return certify(context, count, problems, options, y_m, gap, y_m, certificates);
}

static batten_status open_one(batten_context *context, const batten_net_problem *problem,
                              const batten_net_options *options, net_problems *p)
{
	const batten_status status = net_problems_open(context, 1, problem, options, p);
	if (status == BATTEN_OK && p->plan.items[0].fault)
		return batten_fail(context, BATTEN_INPUT, "%s", p->plan.items[0].fault);
	return status;
}

batten_status net_problem_yield(batten_context *context, const batten_net_problem *problem,
                                const batten_net_options *options, size_t count,
                                const double *slopes, double *ways)
{
	net_problems p;
	batten_status status = open_one(context, problem, options, &p);
	if (status == BATTEN_OK)
		status = net_closeness_invert(&p.plan, 0, count, slopes, ways);
	net_problems_close(&p);
	return status;
}

batten_status net_problem_answer(batten_context *context, const batten_net_problem *problem,
                                 const batten_net_options *options, const double *y_m, size_t count,
                                 const double *slopes, double *ways, bool *known)
{
	net_problems p;
	batten_status status = open_one(context, problem, options, &p);
	if (status == BATTEN_OK) {
		net_certifier c;
		status = net_certifier_create(&p.plan, &c);
		if (status == BATTEN_OK)
			status = net_certifier_answer(&c, 0, y_m, count, slopes, ways, known);
		net_certifier_release(&c);
	}
	net_problems_close(&p);
	return status;
}
