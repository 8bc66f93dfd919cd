/* Derivatives of the objective by extrapolated differences. */
#include "oracle_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The terms that y at (i, j) enters: the bending of the nodes around it and its own closeness. */
static long double local_part(const oracle_problem *problem, const oracle_grid *grid,
                              const long double *y, size_t i, size_t j)
{
	long double sum = 0;
	for (size_t b = j > 0 ? j - 1 : 0; b <= j + 1 && b < grid->nz; b++) {
		for (size_t a = i > 0 ? i - 1 : 0; a <= i + 1 && a < grid->nx; a++) {
			if (!grid->whole[b * grid->nx + a])
				continue;
			long double d[ORACLE_DERIVATIVES];
			oracle_derivatives(grid, y, a, b, d);
			sum += oracle_bending_density(d) * grid->width_x[a] * grid->width_z[b];
		}
	}
	size_t node = j * grid->nx + i;
	long double change = y[node] - problem->target[node];
	return problem->w1 * sum + oracle_closeness_factor(problem, grid, node) * change * change;
}

static long double smallest_spacing(const double *at, size_t count, size_t i)
{
	long double smallest = INFINITY;
	for (size_t k = i > 1 ? i - 1 : 1; k <= i + 2 && k < count; k++)
		smallest = fminl(smallest, (long double)at[k] - at[k - 1]);
	return smallest;
}

/* The first step is an eighth of the smallest spacing near by: it turns no slope by more than 1/8,
 * where the Taylor series in a slope q converges to |sqrt(1 + q^2)| at least. */
void oracle_gradient_sum(const oracle_problem *problem, const oracle_grid *grid, long double *y,
                         long double *gradient)
{
	for (size_t j = 0; j < grid->nz; j++) {
		for (size_t i = 0; i < grid->nx; i++) {
			size_t node = j * grid->nx + i;
			gradient[node] = 0;
			if (!oracle_grid_on_hull(grid, node))
				continue;
			long double kept = y[node];
			long double step = fminl(smallest_spacing(problem->x, grid->nx, i),
			                         smallest_spacing(problem->z, grid->nz, j)) /
			                   8;
			long double column[ORACLE_LEVELS];
			for (int level = 0; level < ORACLE_LEVELS; level++) {
				y[node] = kept + step;
				column[level] = local_part(problem, grid, y, i, j);
				y[node] = kept - step;
				column[level] -= local_part(problem, grid, y, i, j);
				column[level] /= 2 * step;
				step /= 2;
			}
			y[node] = kept;
			gradient[node] = oracle_extrapolate(column);
		}
	}
}

static long double density_off(const long double d[ORACLE_DERIVATIVES], size_t a, long double by_a,
                               size_t b, long double by_b)
{
	long double moved[ORACLE_DERIVATIVES];
	memcpy(moved, d, sizeof moved);
	moved[a] += by_a;
	moved[b] += by_b;
	return oracle_bending_density(moved);
}

/* Second derivatives of the density by p q r s t. It is a square form in r s t, so that their steps
 * only have to be of their size. */
static void second_derivatives(const long double d[ORACLE_DERIVATIVES],
                               long double out[ORACLE_DERIVATIVES][ORACLE_DERIVATIVES])
{
	long double size = 1 + fabsl(d[ORACLE_R]) + fabsl(d[ORACLE_S]) + fabsl(d[ORACLE_T]);
	const long double first[ORACLE_DERIVATIVES] = { 0.125L, 0.125L, size, size, size };
	for (size_t a = 0; a < ORACLE_DERIVATIVES; a++) {
		for (size_t b = 0; b <= a; b++) {
			long double column[ORACLE_LEVELS];
			long double u = first[a], v = first[b];
			for (int level = 0; level < ORACLE_LEVELS; level++) {
				if (a == b)
					column[level] = (density_off(d, a, u, b, 0) - 2 * oracle_bending_density(d) +
					                 density_off(d, a, -u, b, 0)) /
					                (u * u);
				else
					column[level] = (density_off(d, a, u, b, v) - density_off(d, a, u, b, -v) -
					                 density_off(d, a, -u, b, v) + density_off(d, a, -u, b, -v)) /
					                (4 * u * v);
				u /= 2;
				v /= 2;
			}
			out[a][b] = out[b][a] = oracle_extrapolate(column);
		}
	}
}

/* hessian += factor * weights^T second weights, over the variables among the nine neighbours. */
static void add_term(const oracle_grid *grid, size_t i, size_t j, long double factor,
                     long double second[ORACLE_DERIVATIVES][ORACLE_DERIVATIVES],
                     size_t first_derivative, const size_t *variable, size_t count,
                     long double *hessian)
{
	long double weights[ORACLE_DERIVATIVES][9];
	oracle_derivative_weights(grid, i, j, weights);
	for (size_t m = 0; m < 9; m++) {
		size_t row = variable[(j + m / 3 - 1) * grid->nx + i + m % 3 - 1];
		for (size_t n = 0; n < 9 && row != SIZE_MAX; n++) {
			size_t column = variable[(j + n / 3 - 1) * grid->nx + i + n % 3 - 1];
			if (column == SIZE_MAX)
				continue;
			long double sum = 0;
			for (size_t a = first_derivative; a < ORACLE_DERIVATIVES; a++)
				for (size_t b = first_derivative; b < ORACLE_DERIVATIVES; b++)
					sum += weights[a][m] * second[a][b] * weights[b][n];
			hessian[row * count + column] += factor * sum;
		}
	}
}

void oracle_hessian_sum(const oracle_problem *problem, const oracle_grid *grid,
                        const long double *y, const size_t *variable, size_t count, bool frozen,
                        long double *hessian)
{
	memset(hessian, 0, count * count * sizeof *hessian);
	for (size_t j = 1; j + 1 < grid->nz; j++) {
		for (size_t i = 1; i + 1 < grid->nx; i++) {
			if (!grid->whole[j * grid->nx + i])
				continue;
			long double d[ORACLE_DERIVATIVES], second[ORACLE_DERIVATIVES][ORACLE_DERIVATIVES];
			oracle_derivatives(grid, y, i, j, d);
			second_derivatives(d, second);
			long double factor = problem->w1 * grid->width_x[i] * grid->width_z[j];
			add_term(grid, i, j, factor, second, frozen ? ORACLE_R : ORACLE_P, variable, count,
			         hessian);
		}
	}
	for (size_t node = 0; node < grid->nx * grid->nz; node++) {
		size_t row = variable[node];
		if (row != SIZE_MAX)
			hessian[row * count + row] += 2 * oracle_closeness_factor(problem, grid, node);
	}
}

/* A table and its half-breadths as long double. */
typedef struct workplace {
	oracle_grid grid;
	size_t count;
	long double *y;
} workplace;

static bool open_workplace(const oracle_problem *problem, const double *y, workplace *out)
{
	if (!oracle_grid_create(problem->nx, problem->nz, problem->x, problem->z, problem->nodes,
	                        &out->grid))
		return false;
	out->count = problem->nx * problem->nz;
	out->y = oracle_reals(out->count);
	if (!out->y) {
		oracle_grid_release(&out->grid);
		return false;
	}
	for (size_t node = 0; node < out->count; node++)
		if (oracle_grid_on_hull(&out->grid, node))
			out->y[node] = y[node];
	return true;
}

static void close_workplace(workplace *place)
{
	free(place->y);
	oracle_grid_release(&place->grid);
}

bool oracle_gradient(const oracle_problem *problem, const double *y, long double *gradient)
{
	workplace place;
	if (!open_workplace(problem, y, &place))
		return false;
	oracle_gradient_sum(problem, &place.grid, place.y, gradient);
	close_workplace(&place);
	return true;
}

bool oracle_gradient_by_hand(const oracle_problem *problem, const double *y, long double *gradient)
{
	workplace place;
	if (!open_workplace(problem, y, &place))
		return false;
	oracle_gradient_by_hand_sum(problem, &place.grid, place.y, gradient);
	close_workplace(&place);
	return true;
}

bool oracle_hessian(const oracle_problem *problem, const double *y, long double *hessian)
{
	workplace place;
	if (!open_workplace(problem, y, &place))
		return false;
	size_t *variable = calloc(place.count, sizeof *variable);
	if (variable) {
		for (size_t node = 0; node < place.count; node++)
			variable[node] = oracle_grid_on_hull(&place.grid, node) ? node : SIZE_MAX;
		oracle_hessian_sum(problem, &place.grid, place.y, variable, place.count, false, hessian);
	}
	free(variable);
	close_workplace(&place);
	return variable != NULL;
}

/* column gets the gradients at y + s v less those at y - s v, over 2 s, for every level. */
static void difference_gradients(const oracle_problem *problem, workplace *place,
                                 const double *direction, long double step, long double *work,
                                 long double *column)
{
	long double *moved = work, *other = work + place->count;
	for (int side = 1; side >= -1; side -= 2) {
		for (size_t node = 0; node < place->count; node++)
			moved[node] = place->y[node] + side * step * direction[node];
		oracle_gradient_by_hand_sum(problem, &place->grid, moved, side > 0 ? column : other);
	}
	for (size_t node = 0; node < place->count; node++)
		column[node] = (column[node] - other[node]) / (2 * step);
}

bool oracle_hessian_vector(const oracle_problem *problem, const double *y, const double *direction,
                           long double *product)
{
	workplace place;
	if (!open_workplace(problem, y, &place))
		return false;
	long double *work = oracle_reals(place.count * (ORACLE_LEVELS + 2));
	long double largest = 0, spacing = INFINITY;
	for (size_t node = 0; node < place.count; node++)
		if (oracle_grid_on_hull(&place.grid, node))
			largest = fmaxl(largest, fabsl(direction[node]));
	for (size_t i = 0; i < problem->nx; i++)
		spacing = fminl(spacing, smallest_spacing(problem->x, problem->nx, i));
	for (size_t j = 0; j < problem->nz; j++)
		spacing = fminl(spacing, smallest_spacing(problem->z, problem->nz, j));
	long double step = largest > 0 ? spacing / (32 * largest) : 1;
	for (int level = 0; work && level < ORACLE_LEVELS; level++) {
		difference_gradients(problem, &place, direction, step, work,
		                     work + place.count * (size_t)(level + 2));
		step /= 2;
	}
	for (size_t node = 0; work && node < place.count; node++) {
		long double column[ORACLE_LEVELS];
		for (size_t level = 0; level < ORACLE_LEVELS; level++)
			column[level] = work[place.count * (level + 2) + node];
		product[node] = oracle_extrapolate(column);
	}
	free(work);
	close_workplace(&place);
	return work != NULL;
}

bool oracle_first_order(const oracle_problem *problem, long double *movement)
{
	oracle_problem fairness = *problem;
	fairness.w2 = 0;
	workplace place;
	if (!open_workplace(problem, problem->target, &place))
		return false;
	oracle_gradient_sum(&fairness, &place.grid, place.y, movement);
	for (size_t node = 0; node < place.count; node++) {
		bool moves = oracle_grid_on_hull(&place.grid, node) &&
		             problem->lower[node] < problem->upper[node];
		long double factor = moves ? oracle_closeness_factor(problem, &place.grid, node) : 1;
		movement[node] = moves ? -movement[node] / (2 * factor) : 0;
	}
	close_workplace(&place);
	return true;
}
