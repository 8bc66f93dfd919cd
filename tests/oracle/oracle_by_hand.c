/* The gradient of the objective by the chain rule.
 *
 * With p q r s t = y_x y_z y_xx y_xz y_zz, A = 1 + p^2, B = 1 + q^2, m = p q, W^2 = 1 + p^2 + q^2
 * the shape operator I^-1 II is 1/W^3 times
 *     | a  b |   a = B r - m s   b = B s - m t
 *     | c  d |   c = A s - m r   d = A t - m s
 * and k1^2 + k2^2 is the trace of its square, so that the density of bending is
 *     (k1^2 + k2^2) W = (a^2 + 2 b c + d^2) / W^5.
 * The derivatives below are those of this expression, line by line. */
#include "oracle_internal.h"

#include <math.h>

static void density_gradient(const long double in[ORACLE_DERIVATIVES],
                             long double out[ORACLE_DERIVATIVES])
{
	long double p = in[ORACLE_P], q = in[ORACLE_Q];
	long double r = in[ORACLE_R], s = in[ORACLE_S], t = in[ORACLE_T];
	long double A = 1 + p * p, B = 1 + q * q, m = p * q;
	long double W2 = 1 + p * p + q * q;
	long double W5 = W2 * W2 * sqrtl(W2);
	long double a = B * r - m * s, b = B * s - m * t;
	long double c = A * s - m * r, d = A * t - m * s;
	long double trace = a * a + 2 * b * c + d * d;
	/* by p: A' = 2p, B' = 0, m' = q; by q: A' = 0, B' = 2q, m' = p; (W^2)' = 2p, 2q */
	long double a_p = -q * s, b_p = -q * t, c_p = 2 * p * s - q * r, d_p = 2 * p * t - q * s;
	long double a_q = 2 * q * r - p * s, b_q = 2 * q * s - p * t, c_q = -p * r, d_q = -p * s;
	out[ORACLE_P] = 2 * (a * a_p + b * c_p + b_p * c + d * d_p) / W5 - 5 * p * trace / (W5 * W2);
	out[ORACLE_Q] = 2 * (a * a_q + b * c_q + b_q * c + d * d_q) / W5 - 5 * q * trace / (W5 * W2);
	out[ORACLE_R] = 2 * (B * a - m * b) / W5;
	out[ORACLE_S] = 2 * (A * b + B * c - m * (a + d)) / W5;
	out[ORACLE_T] = 2 * (A * d - m * c) / W5;
}

void oracle_gradient_by_hand_sum(const oracle_problem *problem, const oracle_grid *grid,
                                 const long double *y, long double *gradient)
{
	for (size_t node = 0; node < grid->nx * grid->nz; node++) {
		gradient[node] = 0;
		if (oracle_grid_on_hull(grid, node))
			gradient[node] = 2 * oracle_closeness_factor(problem, grid, node) *
			                 (y[node] - problem->target[node]);
	}
	for (size_t j = 1; j + 1 < grid->nz; j++) {
		for (size_t i = 1; i + 1 < grid->nx; i++) {
			if (!grid->whole[j * grid->nx + i])
				continue;
			long double in[ORACLE_DERIVATIVES], by[ORACLE_DERIVATIVES];
			long double weights[ORACLE_DERIVATIVES][9];
			oracle_derivatives(grid, y, i, j, in);
			density_gradient(in, by);
			oracle_derivative_weights(grid, i, j, weights);
			long double factor = problem->w1 * grid->width_x[i] * grid->width_z[j];
			for (size_t m = 0; m < 9; m++) {
				long double sum = 0;
				for (size_t k = 0; k < ORACLE_DERIVATIVES; k++)
					sum += by[k] * weights[k][m];
				gradient[(j + m / 3 - 1) * grid->nx + i + m % 3 - 1] += factor * sum;
			}
		}
	}
}
