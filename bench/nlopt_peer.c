#include "nlopt_peer.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>
#include <time.h>

enum { MEMORY = 10, EVALUATIONS = 5000, ATTEMPTS = 30 };
#define FIRST_STEP 0.016 /* m: as the searches' */

typedef struct peer {
	const batten_search_problem *problem;
	double dx, dz;
	double best_value;
	double *best;
} peer;

/* Bending energy of a node per dx dz, (4 H^2 - 2 K) W, and its derivatives by y_x, y_z, y_xx, y_xz,
 * y_zz. */
typedef struct density {
	double value, p, q, r, s, t;
} density;

static density density_of(double p, double q, double r, double s, double t)
{
	const double inverse = 1.0 / (1.0 + p * p + q * q);
	const double three = inverse * sqrt(inverse); /* W^-3 */
	const double five = three * inverse;
	const double mean = (1.0 + q * q) * r - 2.0 * p * q * s + (1.0 + p * p) * t;
	const double gauss = r * t - s * s;
	const double stretch = 6.0 * gauss * five - 5.0 * mean * mean * five * inverse;
	return (density){
		.value = mean * mean * five - 2.0 * gauss * three,
		.p = 4.0 * mean * (p * t - q * s) * five + p * stretch,
		.q = 4.0 * mean * (q * r - p * s) * five + q * stretch,
		.r = 2.0 * mean * (1.0 + q * q) * five - 2.0 * t * three,
		.s = -4.0 * mean * p * q * five + 4.0 * s * three,
		.t = 2.0 * mean * (1.0 + p * p) * five - 2.0 * r * three,
	};
}

/* Energy of the node that y stands at; what its neighbours have of it goes into the gradient there. */
static double add_energy(const peer *c, double bend, const double *y, double *gradient)
{
	enum { ROW = WIGLEY_STATIONS };
	const double x1 = 0.5 / c->dx;
	const double z1 = 0.5 / c->dz;
	const double x2 = 1.0 / (c->dx * c->dx);
	const double z2 = 1.0 / (c->dz * c->dz);
	const density e = density_of(
		(y[1] - y[-1]) * x1, (y[ROW] - y[-ROW]) * z1, ((y[1] - y[0]) - (y[0] - y[-1])) * x2,
		((y[ROW + 1] - y[ROW - 1]) - (y[1 - ROW] - y[-ROW - 1])) * (x1 * z1),
		((y[ROW] - y[0]) - (y[0] - y[-ROW])) * z2);
	const double corner = bend * e.s * x1 * z1;
	gradient[0] -= 2.0 * bend * (e.r * x2 + e.t * z2);
	gradient[1] += bend * (e.r * x2 + e.p * x1);
	gradient[-1] += bend * (e.r * x2 - e.p * x1);
	gradient[ROW] += bend * (e.t * z2 + e.q * z1);
	gradient[-ROW] += bend * (e.t * z2 - e.q * z1);
	gradient[ROW + 1] += corner;
	gradient[ROW - 1] -= corner;
	gradient[1 - ROW] -= corner;
	gradient[-ROW - 1] += corner;
	return bend * e.value;
}

static double objective_of(unsigned count, const double *y, double *gradient, void *user)
{
	peer *c = user;
	double unused[WIGLEY_NODES];
	double *slope = gradient ? gradient : unused;
	const double h = c->problem->half_beam_m;
	const double cell = c->dx * c->dz;
	const double close = c->problem->w2 * cell / (h * h * h * h);
	double sum = 0.0;
	for (int k = 0; k < WIGLEY_WATERLINES; k++)
		for (int i = 0; i < WIGLEY_STATIONS; i++) {
			const int n = k * WIGLEY_STATIONS + i;
			const double off = y[n] - c->problem->target_m[n];
			const double part = close * (i > 0 && i + 1 < WIGLEY_STATIONS ? 1.0 : 0.5) *
			                    (k > 0 && k + 1 < WIGLEY_WATERLINES ? 1.0 : 0.5);
			slope[n] = 2.0 * part * off;
			sum += part * off * off;
		}
	for (int k = 1; k + 1 < WIGLEY_WATERLINES; k++)
		for (int n = k * WIGLEY_STATIONS + 1; n + 1 < (k + 1) * WIGLEY_STATIONS; n++)
			sum += add_energy(c, c->problem->w1 * cell, y + n, slope + n);
	if (sum < c->best_value) {
		c->best_value = sum;
		memcpy(c->best, y, count * sizeof *y);
	}
	return sum;
}

double nlopt_peer_search(const wigley_case *w, size_t hull, double stop, double *y)
{
	peer c = { .problem = &w->problems[hull],
		       .dx = w->x[1] - w->x[0],
		       .dz = w->z[1] - w->z[0],
		       .best_value = HUGE_VAL,
		       .best = y };
	double point[WIGLEY_NODES];
	memcpy(point, c.problem->start_m, sizeof point);
	nlopt_opt search = nlopt_create(NLOPT_LD_LBFGS, WIGLEY_NODES);
	bool ok = search && nlopt_set_min_objective(search, objective_of, &c) > 0 &&
	          nlopt_set_lower_bounds(search, c.problem->lower_m) > 0 &&
	          nlopt_set_upper_bounds(search, c.problem->upper_m) > 0 &&
	          nlopt_set_vector_storage(search, MEMORY) > 0 &&
	          nlopt_set_maxeval(search, EVALUATIONS) > 0 && nlopt_set_stopval(search, stop) > 0;
	for (int attempt = 0; attempt < ATTEMPTS && ok && !(c.best_value <= stop); attempt++) {
		const double before = c.best_value;
		double value = 0.0;
		(void)nlopt_optimize(search, point,
		                     &value); /* the best point is kept, whatever its ending */
		memcpy(point, y, sizeof point);
		if (!(c.best_value < before * (1.0 - 1e-14)))
			break;
	}
	nlopt_destroy(search);
	return ok ? c.best_value : (double)NAN;
}

static double wall_seconds(void)
{
	struct timespec now;
	(void)clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double nlopt_peer_search_values(const wigley_case *w, size_t hull, nlopt_peer_algorithm algorithm,
                                double stop, double seconds, double *y)
{
	peer c = { .problem = &w->problems[hull],
		       .dx = w->x[1] - w->x[0],
		       .dz = w->z[1] - w->z[0],
		       .best_value = HUGE_VAL,
		       .best = y };
	double point[WIGLEY_NODES];
	memcpy(point, c.problem->start_m, sizeof point);
	nlopt_opt search = nlopt_create(
		algorithm == NLOPT_PEER_PRAXIS ? NLOPT_LN_PRAXIS : NLOPT_LN_SBPLX, WIGLEY_NODES);
	const bool ok = search && nlopt_set_min_objective(search, objective_of, &c) > 0 &&
	                nlopt_set_lower_bounds(search, c.problem->lower_m) > 0 &&
	                nlopt_set_upper_bounds(search, c.problem->upper_m) > 0 &&
	                nlopt_set_initial_step1(search, FIRST_STEP) > 0 &&
	                nlopt_set_stopval(search, stop) > 0;
	const double end = wall_seconds() + seconds;
	for (double left = seconds; ok && left > 0.0 && !(c.best_value <= stop);
	     left = end - wall_seconds()) {
		double value = 0.0;
		(void)nlopt_set_maxtime(search, left);
		(void)nlopt_optimize(search, point,
		                     &value); /* the best point is kept, whatever its ending */
		memcpy(point, y, sizeof point);
	}
	nlopt_destroy(search);
	return ok ? c.best_value : (double)NAN;
}
