/* Energies, closeness and the objective of a table of offsets. At each node the surface is the
 * biquadratic through the 3 x 3 nodes around it; its coefficients come from solving for the
 * parabola through three points, its curvatures from the eigenvalues of the shape operator. */
#include "oracle_internal.h"

#include <math.h>
#include <stdlib.h>

/* inverse[a][b]: coefficient of power a, from value b, of the parabola at -before, 0, after. */
static bool invert_parabola(long double before, long double after, long double *inverse)
{
	const long double at[3] = { -before, 0, after };
	for (size_t b = 0; b < 3; b++) {
		long double matrix[9], right[3];
		for (size_t row = 0; row < 3; row++) {
			matrix[row * 3] = 1;
			matrix[row * 3 + 1] = at[row];
			matrix[row * 3 + 2] = at[row] * at[row];
			right[row] = row == b ? 1 : 0;
		}
		if (!oracle_solve(3, matrix, right))
			return false;
		for (size_t a = 0; a < 3; a++)
			inverse[a * 3 + b] = right[a];
	}
	return true;
}

static bool prepare_direction(size_t count, const double *at, long double *quadratic,
                              long double *width)
{
	for (size_t i = 0; i < count; i++) {
		if (i > 0 && !(at[i] > at[i - 1]))
			return false;
		long double before = i > 0 ? (long double)at[i] - at[i - 1] : 0;
		long double after = i + 1 < count ? (long double)at[i + 1] - at[i] : 0;
		width[i] = (before + after) / 2;
		if (i > 0 && i + 1 < count && at[i + 1] > at[i] &&
		    !invert_parabola(before, after, &quadratic[i * 9]))
			return false;
	}
	return true;
}

bool oracle_grid_on_hull(const oracle_grid *grid, size_t node)
{
	return !grid->nodes || grid->nodes[node] != 0;
}

static void mark_whole(oracle_grid *grid)
{
	for (size_t j = 1; j + 1 < grid->nz; j++) {
		for (size_t i = 1; i + 1 < grid->nx; i++) {
			bool whole = true;
			for (size_t b = j - 1; b <= j + 1; b++)
				for (size_t a = i - 1; a <= i + 1; a++)
					whole = whole && oracle_grid_on_hull(grid, b * grid->nx + a);
			grid->whole[j * grid->nx + i] = whole;
		}
	}
}

bool oracle_grid_create(size_t nx, size_t nz, const double *x, const double *z,
                        const uint8_t *nodes, oracle_grid *out)
{
	*out = (oracle_grid){ .nx = nx, .nz = nz, .nodes = nodes };
	if (nx < 3 || nz < 3)
		return false;
	out->whole = calloc(nx * nz, 1);
	out->quadratic_x = oracle_reals(nx * 9);
	out->quadratic_z = oracle_reals(nz * 9);
	out->width_x = oracle_reals(nx);
	out->width_z = oracle_reals(nz);
	if (!out->whole || !out->quadratic_x || !out->quadratic_z || !out->width_x || !out->width_z ||
	    !prepare_direction(nx, x, out->quadratic_x, out->width_x) ||
	    !prepare_direction(nz, z, out->quadratic_z, out->width_z)) {
		oracle_grid_release(out);
		return false;
	}
	mark_whole(out);
	return true;
}

void oracle_grid_release(oracle_grid *grid)
{
	free(grid->whole);
	free(grid->quadratic_x);
	free(grid->quadratic_z);
	free(grid->width_x);
	free(grid->width_z);
	*grid = (oracle_grid){ 0 };
}

/* Powers of x and z and the factor by which a coefficient becomes a derivative at the origin. */
static const struct {
	size_t x, z;
	long double factor;
} monomials[ORACLE_DERIVATIVES] = {
	{ 1, 0, 1 }, { 0, 1, 1 }, { 2, 0, 2 }, { 1, 1, 1 }, { 0, 2, 2 }
};

void oracle_derivative_weights(const oracle_grid *grid, size_t i, size_t j,
                               long double out[ORACLE_DERIVATIVES][9])
{
	for (size_t d = 0; d < ORACLE_DERIVATIVES; d++) {
		const long double *in_x = &grid->quadratic_x[i * 9 + monomials[d].x * 3];
		const long double *in_z = &grid->quadratic_z[j * 9 + monomials[d].z * 3];
		for (size_t b = 0; b < 3; b++)
			for (size_t a = 0; a < 3; a++)
				out[d][b * 3 + a] = monomials[d].factor * in_x[a] * in_z[b];
	}
}

void oracle_derivatives(const oracle_grid *grid, const long double *y, size_t i, size_t j,
                        long double out[ORACLE_DERIVATIVES])
{
	const long double *corner = &y[(j - 1) * grid->nx + i - 1];
	for (size_t d = 0; d < ORACLE_DERIVATIVES; d++) {
		const long double *in_x = &grid->quadratic_x[i * 9 + monomials[d].x * 3];
		const long double *in_z = &grid->quadratic_z[j * 9 + monomials[d].z * 3];
		long double sum = 0;
		for (size_t b = 0; b < 3; b++) {
			const long double *row = &corner[b * grid->nx];
			sum += in_z[b] * (in_x[0] * row[0] + in_x[1] * row[1] + in_x[2] * row[2]);
		}
		out[d] = monomials[d].factor * sum;
	}
}

/* II v = k I v: the first form is factored, I = L L^T, and the symmetric matrix L^-1 II L^-T turned
 * by one Jacobi rotation. */
void oracle_principal_curvatures(const long double d[ORACLE_DERIVATIVES], long double k[2])
{
	long double p = d[ORACLE_P], q = d[ORACLE_Q];
	long double normal = sqrtl(1 + p * p + q * q);
	long double l11 = sqrtl(1 + p * p);
	long double l21 = p * q / l11;
	long double l22 = sqrtl(1 + q * q - l21 * l21);
	/* rows of L^-1 II, then columns by L^-T */
	long double r = d[ORACLE_R] / normal, s = d[ORACLE_S] / normal, t = d[ORACLE_T] / normal;
	long double upper[2] = { r / l11, s / l11 };
	long double lower[2] = { (s - l21 * upper[0]) / l22, (t - l21 * upper[1]) / l22 };
	long double a11 = upper[0] / l11;
	long double a21 = lower[0] / l11;
	long double a22 = (lower[1] - l21 * a21) / l22;
	k[0] = a11;
	k[1] = a22;
	if (fabsl(a21) > 0) {
		long double cotangent = (a22 - a11) / (2 * a21);
		long double tangent = 1 / (fabsl(cotangent) + sqrtl(1 + cotangent * cotangent));
		tangent = copysignl(tangent, cotangent);
		k[0] = a11 - tangent * a21;
		k[1] = a22 + tangent * a21;
	}
	if (k[0] > k[1]) {
		long double kept = k[0];
		k[0] = k[1];
		k[1] = kept;
	}
}

static long double stretch(const long double d[ORACLE_DERIVATIVES])
{
	return sqrtl(1 + d[ORACLE_P] * d[ORACLE_P] + d[ORACLE_Q] * d[ORACLE_Q]);
}

long double oracle_bending_density(const long double d[ORACLE_DERIVATIVES])
{
	long double k[2];
	oracle_principal_curvatures(d, k);
	return (k[0] * k[0] + k[1] * k[1]) * stretch(d);
}

long double oracle_bending_sum(const oracle_grid *grid, const long double *y)
{
	long double sum = 0;
	for (size_t j = 1; j + 1 < grid->nz; j++) {
		for (size_t i = 1; i + 1 < grid->nx; i++) {
			if (!grid->whole[j * grid->nx + i])
				continue;
			long double d[ORACLE_DERIVATIVES];
			oracle_derivatives(grid, y, i, j, d);
			sum += oracle_bending_density(d) * grid->width_x[i] * grid->width_z[j];
		}
	}
	return sum;
}

long double oracle_closeness_sum(const oracle_grid *grid, const long double *y,
                                 const double *target, const double *weight)
{
	long double sum = 0;
	for (size_t j = 0; j < grid->nz; j++) {
		for (size_t i = 0; i < grid->nx; i++) {
			size_t node = j * grid->nx + i;
			if (!oracle_grid_on_hull(grid, node))
				continue;
			long double change = y[node] - target[node];
			sum += (weight ? weight[node] : 1) * change * change * grid->width_x[i] *
			       grid->width_z[j];
		}
	}
	return sum;
}

long double oracle_closeness_factor(const oracle_problem *problem, const oracle_grid *grid,
                                    size_t node)
{
	const double *weight = problem->closeness_weight;
	long double area = grid->width_x[node % grid->nx] * grid->width_z[node / grid->nx];
	return problem->w2 * (weight ? weight[node] : 1) * area / powl(problem->h, 4);
}

long double oracle_objective_sum(const oracle_problem *problem, const oracle_grid *grid,
                                 const long double *y)
{
	long double close = oracle_closeness_sum(grid, y, problem->target, problem->closeness_weight);
	return problem->w1 * oracle_bending_sum(grid, y) + problem->w2 * close / powl(problem->h, 4);
}

/* y as long double, 0 outside the hull. */
static long double *widen(const oracle_grid *grid, const double *y)
{
	long double *wide = oracle_reals(grid->nx * grid->nz);
	for (size_t node = 0; wide && node < grid->nx * grid->nz; node++)
		wide[node] = oracle_grid_on_hull(grid, node) ? y[node] : 0;
	return wide;
}

bool oracle_shape_at(size_t nx, size_t nz, const double *x, const double *z, const double *y,
                     size_t station, size_t waterline, oracle_shape *out)
{
	oracle_grid grid;
	if (station == 0 || station + 1 >= nx || waterline == 0 || waterline + 1 >= nz ||
	    !oracle_grid_create(nx, nz, x, z, NULL, &grid))
		return false;
	long double *wide = widen(&grid, y);
	if (wide) {
		long double d[ORACLE_DERIVATIVES], k[2];
		oracle_derivatives(&grid, wide, station, waterline, d);
		oracle_principal_curvatures(d, k);
		*out = (oracle_shape){
			d[ORACLE_P], d[ORACLE_Q],
			d[ORACLE_R], d[ORACLE_S],
			d[ORACLE_T], k[0],
			k[1],        stretch(d) * grid.width_x[station] * grid.width_z[waterline]
		};
	}
	free(wide);
	oracle_grid_release(&grid);
	return wide != NULL;
}

static void add_energies(const oracle_grid *grid, const long double *y, oracle_energies *out)
{
	for (size_t j = 1; j + 1 < grid->nz; j++) {
		for (size_t i = 1; i + 1 < grid->nx; i++) {
			if (!grid->whole[j * grid->nx + i])
				continue;
			long double d[ORACLE_DERIVATIVES], k[2];
			oracle_derivatives(grid, y, i, j, d);
			oracle_principal_curvatures(d, k);
			long double area = stretch(d) * grid->width_x[i] * grid->width_z[j];
			out->bending += (k[0] * k[0] + k[1] * k[1]) * area;
			out->mean += (k[0] + k[1]) * (k[0] + k[1]) / 4 * area;
			out->gauss += fabsl(k[0] * k[1]) * area;
			out->area += area;
			out->terms++;
		}
	}
}

bool oracle_energy(size_t nx, size_t nz, const double *x, const double *z, const double *y,
                   const uint8_t *nodes, oracle_energies *out)
{
	oracle_grid grid;
	*out = (oracle_energies){ 0 };
	if (!oracle_grid_create(nx, nz, x, z, nodes, &grid))
		return false;
	long double *wide = widen(&grid, y);
	if (wide)
		add_energies(&grid, wide, out);
	free(wide);
	oracle_grid_release(&grid);
	return wide != NULL;
}

long double oracle_closeness(size_t nx, size_t nz, const double *x, const double *z,
                             const double *y, const double *target, const double *weight,
                             const uint8_t *nodes)
{
	oracle_grid grid;
	if (!oracle_grid_create(nx, nz, x, z, nodes, &grid))
		return nanl("");
	long double *wide = widen(&grid, y);
	long double sum = wide ? oracle_closeness_sum(&grid, wide, target, weight) : nanl("");
	free(wide);
	oracle_grid_release(&grid);
	return sum;
}

long double oracle_objective(const oracle_problem *problem, const double *y)
{
	oracle_grid grid;
	if (!oracle_grid_create(problem->nx, problem->nz, problem->x, problem->z, problem->nodes,
	                        &grid))
		return nanl("");
	long double *wide = widen(&grid, y);
	long double sum = wide ? oracle_objective_sum(problem, &grid, wide) : nanl("");
	free(wide);
	oracle_grid_release(&grid);
	return sum;
}
