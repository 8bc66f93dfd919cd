#include "batch/grid_terms.h"

#include "batch/net_terms.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/grid_energy.h"

enum { Y_X, Y_Z, Y_XX, Y_XZ, Y_ZZ, Y_XXX, Y_XXZ, Y_XZZ, Y_ZZZ };

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

/* The third derivative by five neighbours as their weights. */
static void spread_third(const double w[STENCIL_THIRD], double third[5])
{
	third[0] = -w[0];
	third[4] = w[3];
	for (int n = 1; n < 4; n++)
		third[n] = w[n - 1] - w[n];
}

/* y_xxx .. y_zzz: along a line by five nodes, mixed by what the nine have of second and first. */
static void add_third(const search_plan *plan, size_t station, size_t waterline,
                      const double first[2][3], const double second[2][3], grid_stencil *s)
{
	double x[5], z[5];
	spread_third(plan->third_x + station * STENCIL_THIRD, x);
	spread_third(plan->third_z + waterline * STENCIL_THIRD, z);
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++) {
			const int n = 3 * k + i;
			s->weight[Y_XXX][n] = k == 1 ? x[i + 1] : 0.0;
			s->weight[Y_XXZ][n] = second[0][i] * first[1][k];
			s->weight[Y_XZZ][n] = first[0][i] * second[1][k];
			s->weight[Y_ZZZ][n] = i == 1 ? z[k + 1] : 0.0;
		}
	s->weight[Y_XXX][9] = x[0];
	s->weight[Y_XXX][10] = x[4];
	s->weight[Y_ZZZ][11] = z[0];
	s->weight[Y_ZZZ][12] = z[4];
}

grid_stencil grid_stencil_of(const search_plan *plan, size_t station, size_t waterline)
{
	double first[2][3], second[2][3]; /* along x, along z */
	grid_stencil s = { .count = grid_stencil_count(plan), .variables = GRID_TERM_VARIABLES };
	spread(plan->stencil_x + station * STENCIL_SIZE, first[0], second[0]);
	spread(plan->stencil_z + waterline * STENCIL_SIZE, first[1], second[1]);
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++) {
			const int n = 3 * k + i;
			s.weight[Y_X][n] = k == 1 ? first[0][i] : 0.0;
			s.weight[Y_Z][n] = i == 1 ? first[1][k] : 0.0;
			s.weight[Y_XX][n] = k == 1 ? second[0][i] : 0.0;
			s.weight[Y_XZ][n] = first[0][i] * first[1][k];
			s.weight[Y_ZZ][n] = i == 1 ? second[1][k] : 0.0;
		}
	if (plan->fairness == GRID_VARIATION) {
		s.variables = GRID_TERM_VARIABLES_MOST;
		add_third(plan, station, waterline, first, second, &s);
	}
	return s;
}

size_t grid_stencil_count(const search_plan *plan)
{
	return plan->fairness == GRID_VARIATION ? GRID_STENCIL_MOST : 9;
}

void grid_stencil_places(size_t count, size_t node, size_t stride, size_t places[GRID_STENCIL_MOST])
{
	for (size_t n = 0; n < 9; n++)
		places[n] = node + n / 3 * stride + n % 3 - stride - 1;
	if (count > 9) {
		places[9] = node - 2;
		places[10] = node + 2;
		places[11] = node - 2 * stride;
		places[12] = node + 2 * stride;
	}
}

/* The surface (x, y, z) by u = x and v = z, as a sample of a net. */
static jet variation_density(const double way[GRID_TERM_VARIABLES_MOST])
{
	double sample[NET_SAMPLE_SIZE_THIRD] = { 0.0 };
	sample[NET_SAMPLE_X] = 1.0;
	sample[NET_SAMPLE_Z + 1] = 1.0;
	return net_density_of(NET_FAIRNESS_VARIATION, sample, way, 0.0);
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

/* Bending, mean or Gauss, by first and second derivatives. */
static jet second_density(const search_plan *plan, double half_beam_m,
                          const double values[GRID_TERM_VARIABLES])
{
	const double along = sqrt(plan->options.longitudinal_weight);
	const double across = sqrt(plan->options.transverse_weight);
	jet d[GRID_TERM_VARIABLES], k[3];
	for (int v = 0; v < GRID_TERM_VARIABLES; v++)
		d[v] = jet_variable(values[v], v, GRID_TERM_VARIABLES);
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

jet grid_density(const search_plan *plan, double half_beam_m, const grid_stencil *stencil,
                 const double y[GRID_STENCIL_MOST])
{
	double values[GRID_TERM_VARIABLES_MOST] = { 0.0 };
	for (int v = 0; v < stencil->variables; v++)
		for (size_t n = 0; n < stencil->count; n++)
			values[v] += stencil->weight[v][n] * y[n];
	return plan->fairness == GRID_VARIATION ? variation_density(values)
	                                        : second_density(plan, half_beam_m, values);
}
