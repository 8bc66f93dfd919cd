/* A box-constrained minimum by a projected Newton method (Bertsekas 1982): nodes at a bound that
 * the gradient pushes against are held, the others take a Newton step with a dense Cholesky factor,
 * the whole step is cut at the bounds and shortened until the objective falls. */
#include "oracle_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct newton {
	const oracle_problem *problem;
	oracle_grid grid;
	size_t count;   /* variables */
	size_t *node;   /* [count] */
	size_t *number; /* [nz][nx]: which free variable a node is, SIZE_MAX: none */
	size_t *first;  /* of each row of the factor */
	long double *y, *trial, *gradient, *step, *factor;
	size_t free_count;
	unsigned evaluations;
} newton;

size_t oracle_variables(const oracle_problem *problem, size_t *node)
{
	size_t count = 0;
	for (size_t k = 0; k < problem->nx * problem->nz; k++)
		if ((!problem->nodes || problem->nodes[k] != 0) && problem->lower[k] < problem->upper[k])
			node[count++] = k;
	return count;
}

static long double clamp(const oracle_problem *problem, size_t node, long double y)
{
	return fminl(fmaxl(y, problem->lower[node]), problem->upper[node]);
}

void oracle_start(const oracle_problem *problem, long double *y)
{
	for (size_t k = 0; k < problem->nx * problem->nz; k++) {
		bool inside = !problem->nodes || problem->nodes[k] != 0;
		y[k] = inside ? clamp(problem, k, problem->start[k]) : 0;
	}
}

void oracle_finish(const oracle_problem *problem, const long double *y, double *out)
{
	for (size_t k = 0; k < problem->nx * problem->nz; k++) {
		bool inside = !problem->nodes || problem->nodes[k] != 0;
		out[k] = inside ? (double)y[k] : problem->start[k];
	}
}

/* Largest scaled gradient step, cut at the bounds. */
static long double residual_of(const oracle_problem *problem, const long double *y,
                               const long double *gradient, const long double *hessian,
                               const size_t *node, size_t count)
{
	long double largest = 0;
	for (size_t k = 0; k < count; k++) {
		long double second = hessian[k * count + k];
		if (!(second > 0))
			continue;
		long double to = clamp(problem, node[k], y[node[k]] - gradient[node[k]] / second);
		largest = fmaxl(largest, fabsl(to - y[node[k]]));
	}
	return largest;
}

bool oracle_report(const oracle_problem *problem, const oracle_grid *grid, long double *y,
                   oracle_minimum *out)
{
	size_t nodes = grid->nx * grid->nz;
	size_t *node = malloc(nodes * sizeof *node);
	size_t *number = malloc(nodes * sizeof *number);
	long double *gradient = oracle_reals(nodes);
	size_t count = node ? oracle_variables(problem, node) : 0;
	long double *hessian = oracle_reals(count * count);
	bool ok = node && number && gradient && hessian;
	if (ok) {
		for (size_t k = 0; k < nodes; k++)
			number[k] = SIZE_MAX;
		for (size_t k = 0; k < count; k++)
			number[node[k]] = k;
		oracle_gradient_sum(problem, grid, y, gradient);
		oracle_hessian_sum(problem, grid, y, number, count, false, hessian);
		out->residual = residual_of(problem, y, gradient, hessian, node, count);
		out->bending = oracle_bending_sum(grid, y);
		out->closeness = oracle_closeness_sum(grid, y, problem->target, problem->closeness_weight);
		out->objective = oracle_objective_sum(problem, grid, y);
		out->variables = count;
		out->at_bound = 0;
		for (size_t k = 0; k < count; k++)
			if (y[node[k]] <= problem->lower[node[k]] || y[node[k]] >= problem->upper[node[k]])
				out->at_bound++;
	}
	free(node);
	free(number);
	free(gradient);
	free(hessian);
	return ok;
}

/* Holds the nodes that press against a bound, putting those next to it on it; true if one moved. */
static bool choose_free(newton *n)
{
	bool moved = false;
	const oracle_problem *problem = n->problem;
	long double margin = 1e-9L * problem->h;
	n->free_count = 0;
	for (size_t k = 0; k < problem->nx * problem->nz; k++)
		n->number[k] = SIZE_MAX;
	for (size_t k = 0; k < n->count; k++) {
		size_t node = n->node[k];
		long double push = n->gradient[node];
		bool held = (push > 0 && n->y[node] <= problem->lower[node] + margin) ||
		            (push < 0 && n->y[node] >= problem->upper[node] - margin);
		long double bound = push > 0 ? problem->lower[node] : problem->upper[node];
		if (!held) {
			n->number[node] = n->free_count++;
		} else if (fabsl(n->y[node] - bound) > 0) {
			n->y[node] = bound;
			moved = true;
		}
	}
	return moved;
}

/* Factors the exact Hessian of the free nodes; where it is not positive definite, the one with the
 * metric frozen, in the end with a growing diagonal. */
static bool factor_hessian(newton *n)
{
	long double extra = 0;
	for (int attempt = 0; attempt < 24; attempt++) {
		oracle_hessian_sum(n->problem, &n->grid, n->y, n->number, n->free_count, attempt > 0,
		                   n->factor);
		for (size_t k = 0; k < n->free_count; k++)
			n->factor[k * n->free_count + k] *= 1 + extra;
		if (oracle_cholesky(n->free_count, n->factor, n->first))
			return true;
		if (attempt > 0)
			extra = extra > 0 ? extra * 10 : 1e-14L;
	}
	return false;
}

/* The Newton step into n->step ([nz][nx], 0 where held), no longer than 0.04 h: a longer one may
 * jump a ridge of the objective. Returns the fall of the objective it promises. */
static long double newton_step(newton *n)
{
	size_t nodes = n->grid.nx * n->grid.nz;
	long double promise = 0, largest = 0;
	for (size_t k = 0; k < nodes; k++)
		if (n->number[k] != SIZE_MAX)
			n->trial[n->number[k]] = -n->gradient[k];
	oracle_cholesky_solve(n->free_count, n->factor, n->first, n->trial);
	for (size_t k = 0; k < nodes; k++) {
		n->step[k] = n->number[k] != SIZE_MAX ? n->trial[n->number[k]] : 0;
		promise -= n->step[k] * n->gradient[k] / 2;
		largest = fmaxl(largest, fabsl(n->step[k]));
	}
	long double limit = 0.04L * n->problem->h;
	for (size_t k = 0; k < nodes && largest > limit; k++)
		n->step[k] *= limit / largest;
	return promise;
}

/* Moves along the projected step as far as the objective falls; true when it did. */
static bool search_line(newton *n, long double *objective)
{
	size_t nodes = n->grid.nx * n->grid.nz;
	long double length = 1;
	for (int halving = 0; halving < 60; halving++) {
		long double slope = 0;
		memcpy(n->trial, n->y, nodes * sizeof *n->trial);
		for (size_t k = 0; k < n->count; k++) {
			size_t node = n->node[k];
			n->trial[node] = clamp(n->problem, node, n->y[node] + length * n->step[node]);
			slope += n->gradient[node] * (n->trial[node] - n->y[node]);
		}
		long double value = oracle_objective_sum(n->problem, &n->grid, n->trial);
		n->evaluations++;
		if (value <= *objective + 1e-4L * slope && value < *objective) {
			memcpy(n->y, n->trial, nodes * sizeof *n->trial);
			*objective = value;
			return true;
		}
		length /= 2;
	}
	return false;
}

static bool open_newton(const oracle_problem *problem, newton *n)
{
	size_t nodes = problem->nx * problem->nz;
	*n = (newton){ .problem = problem };
	if (!oracle_grid_create(problem->nx, problem->nz, problem->x, problem->z, problem->nodes,
	                        &n->grid))
		return false;
	n->node = malloc(nodes * sizeof *n->node);
	n->number = malloc(nodes * sizeof *n->number);
	n->first = malloc(nodes * sizeof *n->first);
	n->y = oracle_reals(nodes);
	n->trial = oracle_reals(nodes);
	n->gradient = oracle_reals(nodes);
	n->step = oracle_reals(nodes);
	if (n->node)
		n->count = oracle_variables(problem, n->node);
	n->factor = oracle_reals(n->count * n->count);
	return n->node && n->number && n->first && n->y && n->trial && n->gradient && n->step &&
	       n->factor;
}

static void close_newton(newton *n)
{
	oracle_grid_release(&n->grid);
	free(n->node);
	free(n->number);
	free(n->first);
	free(n->y);
	free(n->trial);
	free(n->gradient);
	free(n->step);
	free(n->factor);
}

static void iterate(newton *n, oracle_minimum *out)
{
	oracle_start(n->problem, n->y);
	long double objective = oracle_objective_sum(n->problem, &n->grid, n->y);
	for (out->iterations = 0; out->iterations < 300; out->iterations++) {
		oracle_gradient_sum(n->problem, &n->grid, n->y, n->gradient);
		if (choose_free(n)) {
			oracle_gradient_sum(n->problem, &n->grid, n->y, n->gradient);
			(void)choose_free(n);
		}
		objective = oracle_objective_sum(n->problem, &n->grid, n->y);
		n->evaluations++;
		if (!factor_hessian(n))
			return;
		out->promise = newton_step(n) / fmaxl(objective, 1e-300L);
		/* What is promised is below the rounding of the objective. */
		out->converged = out->promise < 1e-19L;
		if (!search_line(n, &objective) || out->converged) {
			out->converged = out->promise < 1e-17L;
			return;
		}
	}
}

bool oracle_minimise(const oracle_problem *problem, double *y, oracle_minimum *out)
{
	newton n;
	*out = (oracle_minimum){ 0 };
	bool ok = open_newton(problem, &n);
	if (ok) {
		iterate(&n, out);
		out->evaluations = n.evaluations;
		ok = oracle_report(problem, &n.grid, n.y, out);
	}
	if (ok)
		oracle_finish(problem, n.y, y);
	close_newton(&n);
	return ok;
}
