/* What a search cannot be given. */
#include "batch/search_plan.h"
#include "core/runs.h"

/* Whether a number keeps its worth in the precision, its fourth power with it. */
static bool is_length(batten_precision precision, double length)
{
	return precision == BATTEN_F64 ? length >= 1e-60 && length <= 1e60
	                               : length >= 1e-7 && length <= 1e7;
}

/* Larger ones would make the objective overflow. */
#define WEIGHT_LIMIT 1e100

static bool is_weight(batten_precision precision, double weight)
{
	const double most = precision == BATTEN_F64 ? WEIGHT_LIMIT : 1e20;
	return weight == 0.0 || (weight >= 1.0 / most && weight <= most);
}

const char *search_weights_fault(batten_precision precision, double w1, double w2,
                                 double half_beam_m)
{
	if (!is_weight(precision, w1) || !is_weight(precision, w2) || w1 + w2 == 0.0)
		return "weights: 0 or 1e-100 to 1e100 (1e-20 to 1e20 in f32), not both 0";
	if (!is_length(precision, half_beam_m))
		return "half-beam: 1e-60 to 1e60 m (1e-7 to 1e7 m in f32) is expected";
	return NULL;
}

/* How many nodes of the hull have each fault. */
struct node_faults {
	size_t values, bounds, weights;
};

/* A number, not a bool: both compilers then see that `&` is meant. */
INLINED int is_finite(double value)
{
	return value - value == 0.0;
}

INLINED void look_at_nodes(size_t count, batten_search_problem problem, struct node_faults *out)
{
	struct node_faults faults = { 0 };
	const uint8_t *nodes = problem.nodes;
	const double *weight = problem.closeness_weight;
	for (size_t n = 0; n < count; n++) {
		const bool there = !nodes || nodes[n] != BATTEN_NODE_OUTSIDE;
		const double lower = problem.lower_m[n], upper = problem.upper_m[n];
		faults.values += there & !(is_finite(problem.start_m[n]) & is_finite(problem.target_m[n]));
		faults.bounds += there & !(is_finite(lower) & is_finite(upper) & (lower <= upper));
		faults.weights += there & (weight && !(weight[n] >= 0.0 && is_finite(weight[n])));
	}
	*out = faults;
}

RUNS_FUNCTION(count_faults, look_at_nodes,
              (size_t count, batten_search_problem problem, struct node_faults *out),
              (count, problem, out))

const char *search_problem_fault(const search_plan *plan, const batten_search_problem *problem)
{
	const char *fault = search_weights_fault(plan->options.precision, problem->w1, problem->w2,
	                                         problem->half_beam_m);
	if (fault)
		return fault;
	struct node_faults faults;
	count_faults(plan->station_count * plan->waterline_count, *problem, &faults);
	return faults.values > 0    ? "a start or target value is not finite"
	       : faults.bounds > 0  ? "a lower bound is above its upper bound or not finite"
	       : faults.weights > 0 ? "a closeness weight is negative or not finite"
	                            : NULL;
}
