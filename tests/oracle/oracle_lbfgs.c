/* A second opinion on the minimum: NLopt's LD_LBFGS (limited memory, variable metric, bounds) in
 * double on the gradient derived by hand. */
#include "oracle_internal.h"

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>

typedef struct second_opinion {
	const oracle_problem *problem;
	oracle_grid grid;
	unsigned count;
	size_t *node;
	double *point, *lower, *upper, *best;
	double best_value;
	long double *y, *gradient;
	unsigned evaluations;
} second_opinion;

static double objective_of(unsigned count, const double *point, double *gradient, void *user)
{
	second_opinion *s = user;
	for (unsigned k = 0; k < count; k++)
		s->y[s->node[k]] = point[k];
	double value = (double)oracle_objective_sum(s->problem, &s->grid, s->y);
	s->evaluations++;
	if (value < s->best_value) {
		s->best_value = value;
		for (unsigned k = 0; k < count; k++)
			s->best[k] = point[k];
	}
	if (gradient) {
		oracle_gradient_by_hand_sum(s->problem, &s->grid, s->y, s->gradient);
		for (unsigned k = 0; k < count; k++)
			gradient[k] = (double)s->gradient[s->node[k]];
	}
	return value;
}

static bool open_opinion(const oracle_problem *problem, second_opinion *s)
{
	size_t nodes = problem->nx * problem->nz;
	*s = (second_opinion){ .problem = problem, .best_value = INFINITY };
	if (!oracle_grid_create(problem->nx, problem->nz, problem->x, problem->z, problem->nodes,
	                        &s->grid))
		return false;
	s->node = malloc(nodes * sizeof *s->node);
	s->point = calloc(nodes, sizeof *s->point);
	s->lower = calloc(nodes, sizeof *s->lower);
	s->upper = calloc(nodes, sizeof *s->upper);
	s->best = calloc(nodes, sizeof *s->best);
	s->y = oracle_reals(nodes);
	s->gradient = oracle_reals(nodes);
	if (!s->node || !s->point || !s->lower || !s->upper || !s->best || !s->y || !s->gradient)
		return false;
	s->count = (unsigned)oracle_variables(problem, s->node);
	oracle_start(problem, s->y);
	for (unsigned k = 0; k < s->count; k++) {
		s->best[k] = (double)s->y[s->node[k]];
		s->lower[k] = problem->lower[s->node[k]];
		s->upper[k] = problem->upper[s->node[k]];
	}
	return true;
}

static void close_opinion(second_opinion *s)
{
	oracle_grid_release(&s->grid);
	free(s->node);
	free(s->point);
	free(s->lower);
	free(s->upper);
	free(s->best);
	free(s->y);
	free(s->gradient);
}

/* One run from the best point so far; its ending is of no interest, the best point is kept. */
static bool run_once(second_opinion *s)
{
	nlopt_opt optimiser = nlopt_create(NLOPT_LD_LBFGS, s->count);
	if (!optimiser)
		return false;
	bool ok = nlopt_set_min_objective(optimiser, objective_of, s) > 0 &&
	          nlopt_set_lower_bounds(optimiser, s->lower) > 0 &&
	          nlopt_set_upper_bounds(optimiser, s->upper) > 0 &&
	          nlopt_set_vector_storage(optimiser, 20) > 0 && nlopt_set_maxeval(optimiser, 5000) > 0;
	if (ok) {
		double value;
		for (unsigned k = 0; k < s->count; k++)
			s->point[k] = s->best[k];
		(void)nlopt_optimize(optimiser, s->point, &value);
	}
	nlopt_destroy(optimiser);
	return ok;
}

bool oracle_minimise_lbfgs(const oracle_problem *problem, double *y, oracle_minimum *out)
{
	second_opinion s;
	*out = (oracle_minimum){ 0 };
	bool ok = open_opinion(problem, &s);
	while (ok && s.count > 0 && !out->converged && out->iterations < 30) {
		double before = s.best_value;
		ok = run_once(&s);
		out->iterations++;
		out->converged = !(s.best_value < before * (1 - 1e-14));
	}
	if (ok) {
		for (unsigned k = 0; k < s.count; k++)
			s.y[s.node[k]] = s.best[k];
		out->evaluations = s.evaluations;
		ok = oracle_report(problem, &s.grid, s.y, out);
	}
	if (ok)
		oracle_finish(problem, s.y, y);
	close_opinion(&s);
	return ok;
}
