#include "batch/grid_terms.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/grid_energy.h"

enum { Y_X, Y_Z, Y_XX, Y_XZ, Y_ZZ };

/* First and second derivative over three neighbours, by the values and no more by their differences. */
static void spread(const double w[STENCIL_SIZE], double first[3], double second[3])
{
	const double to_first[3] = { -w[0], w[0] - w[1], w[1] };
	const double to_second[3] = { w[2], -(w[2] + w[3]), w[3] };
	for (int i = 0; i < 3; i++) {
		first[i] = to_first[i];
		second[i] = to_second[i];
	}
}

grid_stencil grid_stencil_of(const search_plan *plan, size_t station, size_t waterline)
{
	double x_first[3], x_second[3], z_first[3], z_second[3];
	grid_stencil s = { { { 0.0 } } };
	spread(plan->stencil_x + station * STENCIL_SIZE, x_first, x_second);
	spread(plan->stencil_z + waterline * STENCIL_SIZE, z_first, z_second);
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++) {
			const int n = 3 * k + i;
			s.weight[Y_X][n] = k == 1 ? x_first[i] : 0.0;
			s.weight[Y_Z][n] = i == 1 ? z_first[k] : 0.0;
			s.weight[Y_XX][n] = k == 1 ? x_second[i] : 0.0;
			s.weight[Y_XZ][n] = x_first[i] * z_first[k];
			s.weight[Y_ZZ][n] = i == 1 ? z_second[k] : 0.0;
		}
	return s;
}

/* The entries of the shape operator along the waterline's tangent and square to it (batten.h,
 * longitudinal_weight), by the forms of the graph: E = 1 + y_x^2, F = y_x y_z, W dS's factor. */
static void shape_operator(const jet d[GRID_TERM_VARIABLES], jet w2, jet entries[3])
{
	const jet e = jet_add(jet_constant(1.0), jet_square(d[Y_X]));
	const jet e_inverse = jet_inverse(e);
	const jet skew = jet_multiply(jet_multiply(d[Y_X], d[Y_Z]), e_inverse); /* F / E */
	const jet normal = jet_inverse(jet_root(w2));
	const jet twist = jet_subtract(d[Y_XZ], jet_multiply(skew, d[Y_XX]));
	const jet across = jet_add(jet_subtract(d[Y_ZZ], jet_scale(jet_multiply(skew, d[Y_XZ]), 2.0)),
	                           jet_multiply(jet_square(skew), d[Y_XX]));
	entries[0] = jet_multiply(jet_multiply(d[Y_XX], e_inverse), normal);
	entries[1] = jet_multiply(twist, jet_square(normal));
	entries[2] = jet_multiply(jet_multiply(across, e), jet_multiply(normal, jet_square(normal)));
}

jet grid_density(const search_plan *plan, double half_beam_m, const grid_stencil *stencil,
                 const double y[GRID_STENCIL_NODES])
{
	const double along = sqrt(plan->options.longitudinal_weight);
	const double across = sqrt(plan->options.transverse_weight);
	jet d[GRID_TERM_VARIABLES], k[3];
	for (int v = 0; v < GRID_TERM_VARIABLES; v++) {
		double value = 0.0;
		for (int n = 0; n < GRID_STENCIL_NODES; n++)
			value += stencil->weight[v][n] * y[n];
		d[v] = jet_variable(value, v, GRID_TERM_VARIABLES);
	}
	const jet w2 = jet_add(jet_add(jet_constant(1.0), jet_square(d[Y_X])), jet_square(d[Y_Z]));
	shape_operator(d, w2, k);
	jet fairness;
	if (plan->fairness == GRID_MEAN) {
		fairness = jet_scale(jet_square(jet_add(jet_scale(k[0], along), jet_scale(k[2], across))),
		                     0.25);
	} else if (plan->fairness == GRID_GAUSS) {
		const double blunt = GAUSS_ROUNDING / (half_beam_m * half_beam_m);
		const jet gauss = jet_scale(jet_subtract(jet_multiply(k[0], k[2]), jet_square(k[1])),
		                            along * across);
		fairness = jet_root(jet_add(jet_square(gauss), jet_constant(blunt * blunt)));
	} else {
		fairness = jet_add(jet_add(jet_scale(jet_square(k[0]), along * along),
		                           jet_scale(jet_square(k[2]), across * across)),
		                   jet_scale(jet_square(k[1]), 2.0 * along * across));
	}
	return jet_multiply(fairness, jet_root(w2));
}
