/* The oracle against itself by other ways: gradients, Hessians and minima of noisy hulls. */
#include "oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { STATIONS = 21, WATERLINES = 20, NODES = STATIONS * WATERLINES };

typedef struct noisy_hull {
	size_t nx, nz;
	double x[STATIONS], z[WATERLINES], y[NODES], lower[NODES], upper[NODES];
	uint8_t nodes[NODES];
	double h;
	uint64_t seed;
} noisy_hull;

/* The next number of 0..1 (splitmix64). */
static double next_number(uint64_t *seed)
{
	*seed += 0x9e3779b97f4a7c15u;
	uint64_t bits = *seed;
	bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
	bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
	return (double)((bits ^ (bits >> 31)) >> 11) / 9007199254740992.0;
}

/* Wigley's hull, L 16, B 1.6, D 1 m, with even noise where the exact half-breadth is positive. */
static noisy_hull noisy_wigley(uint64_t seed, double noise)
{
	noisy_hull hull = { .nx = STATIONS, .nz = WATERLINES, .seed = seed };
	for (size_t i = 0; i < hull.nx; i++)
		hull.x[i] = 16 * (double)i / (STATIONS - 1);
	for (size_t j = 0; j < hull.nz; j++)
		hull.z[j] = (double)j / (WATERLINES - 1);
	for (size_t k = 0; k < NODES; k++) {
		double along = hull.x[k % hull.nx] / 8 - 1, down = 1 - hull.z[k / hull.nx];
		double exact = 0.8 * (1 - along * along) * (1 - down * down);
		double shift = noise * (2 * next_number(&hull.seed) - 1);
		hull.y[k] = exact > 1e-12 ? fmax(0, exact + shift) : 0;
		hull.h = fmax(hull.h, hull.y[k]);
		hull.nodes[k] = 1;
	}
	return hull;
}

/* A hull with uneven spacings, a keel that rises aft and a raked stem; NaN outside. */
static noisy_hull noisy_real_hull(void)
{
	noisy_hull hull = { .nx = 17, .nz = 12, .seed = 5 };
	for (size_t i = 1; i < hull.nx; i++)
		hull.x[i] = hull.x[i - 1] + (i % 3 == 0 ? 0.5 : i % 5 == 0 ? 1.25 : 1);
	for (size_t j = 1; j < hull.nz; j++)
		hull.z[j] = hull.z[j - 1] + (j < 4 ? 0.1 : j % 2 ? 0.25 : 0.15);
	double length = hull.x[hull.nx - 1];
	for (size_t k = 0; k < hull.nx * hull.nz; k++) {
		double x = hull.x[k % hull.nx], z = hull.z[k / hull.nx];
		double keel = fmax(0, 0.9 - 0.4 * x), stem = length - 2 + z;
		hull.nodes[k] = z >= keel && x <= stem;
		double along = 2 * x / length - 1;
		double exact = 0.8 * cos(along) * sin(0.2 + z) + 0.1 * z;
		hull.y[k] = hull.nodes[k] ? exact + 0.005 * (2 * next_number(&hull.seed) - 1) : NAN;
		if (hull.nodes[k])
			hull.h = fmax(hull.h, hull.y[k]);
	}
	return hull;
}

/* The problem of a hull that is its own start and target; box 0..1.2 h, or within limit * h of the
 * start with zeros fixed. */
static oracle_problem fairing_of(noisy_hull *hull, double w2, double limit)
{
	for (size_t k = 0; k < hull->nx * hull->nz; k++) {
		bool fixed = limit > 0 && !(hull->y[k] > 0);
		hull->lower[k] = limit > 0 ? fmax(0, hull->y[k] - limit * hull->h) : 0;
		hull->upper[k] = limit > 0 ? hull->y[k] + limit * hull->h : 1.2 * hull->h;
		if (fixed)
			hull->lower[k] = hull->upper[k] = hull->y[k];
	}
	return (oracle_problem){ .nx = hull->nx,
		                     .nz = hull->nz,
		                     .x = hull->x,
		                     .z = hull->z,
		                     .nodes = hull->nodes,
		                     .start = hull->y,
		                     .target = hull->y,
		                     .lower = hull->lower,
		                     .upper = hull->upper,
		                     .w1 = 1,
		                     .w2 = w2,
		                     .h = hull->h };
}

static long double largest(const long double *value, size_t count)
{
	long double most = 0;
	for (size_t k = 0; k < count; k++)
		most = fmaxl(most, fabsl(value[k]));
	return most;
}

/* y off the target, so that both parts of the objective have a slope. */
static void check_gradients(noisy_hull *hull)
{
	oracle_problem problem = fairing_of(hull, 400, 0);
	long double numeric[NODES], by_hand[NODES];
	double y[NODES] = { 0 };
	size_t count = hull->nx * hull->nz;
	for (size_t k = 0; k < count; k++)
		y[k] = hull->y[k] + 0.003 * next_number(&hull->seed);
	assert_true(oracle_gradient(&problem, y, numeric));
	assert_true(oracle_gradient_by_hand(&problem, y, by_hand));
	long double size = largest(by_hand, count);
	assert_true(size > 1);
	for (size_t k = 0; k < count; k++) {
		assert_true(fabsl(numeric[k] - by_hand[k]) < 1e-14L * size);
		assert_true(hull->nodes[k] || (numeric[k] == 0 && by_hand[k] == 0));
	}
}

static void test_gradient_by_two_ways(void **state)
{
	(void)state;
	noisy_hull hull = noisy_wigley(3, 0.01);
	check_gradients(&hull);
	hull = noisy_real_hull();
	check_gradients(&hull);
}

/* The gradient along a direction of -1 0 1 against the whole objective, steps exact in double. */
static void test_gradient_against_the_objective(void **state)
{
	(void)state;
	noisy_hull hull = noisy_real_hull();
	oracle_problem problem = fairing_of(&hull, 400, 0);
	size_t count = hull.nx * hull.nz;
	long double gradient[NODES], column[4], expected = 0;
	double y[NODES] = { 0 }, moved[NODES], direction[NODES];
	for (size_t k = 0; k < count; k++) {
		y[k] = ldexp(rint(ldexp(hull.y[k], 20)), -20);
		direction[k] = floor(3 * next_number(&hull.seed)) - 1;
	}
	assert_true(oracle_gradient(&problem, y, gradient));
	for (size_t k = 0; k < count; k++)
		expected += gradient[k] * direction[k];
	for (int level = 0; level < 4; level++) {
		double step = ldexp(1, -8 - level);
		for (size_t k = 0; k < count; k++)
			moved[k] = y[k] + step * direction[k];
		column[level] = oracle_objective(&problem, moved);
		for (size_t k = 0; k < count; k++)
			moved[k] = y[k] - step * direction[k];
		column[level] = (column[level] - oracle_objective(&problem, moved)) / (2 * step);
	}
	for (int order = 1; order < 4; order++)
		for (int level = 3; level >= order; level--)
			column[level] += (column[level] - column[level - 1]) / (powl(4, order) - 1);
	assert_true(fabsl(column[3] - expected) < 1e-8L * largest(gradient, count));
}

static void test_hessian_by_two_ways(void **state)
{
	(void)state;
	noisy_hull hull = noisy_real_hull();
	oracle_problem problem = fairing_of(&hull, 400, 0);
	size_t count = hull.nx * hull.nz;
	long double *hessian = calloc(count * count, sizeof *hessian);
	long double product[NODES], difference[NODES];
	double direction[NODES];
	assert_non_null(hessian);
	for (size_t k = 0; k < count; k++)
		direction[k] = hull.nodes[k] ? 2 * next_number(&hull.seed) - 1 : 0;
	assert_true(oracle_hessian(&problem, hull.y, hessian));
	assert_true(oracle_hessian_vector(&problem, hull.y, direction, product));
	long double size = largest(hessian, count * count);
	for (size_t row = 0; row < count; row++) {
		difference[row] = -product[row];
		for (size_t column = 0; column < count; column++) {
			difference[row] += hessian[row * count + column] * direction[column];
			assert_true(fabsl(hessian[row * count + column] - hessian[column * count + row]) <=
			            1e-17L * size);
		}
	}
	assert_true(largest(product, count) > 100);
	assert_true(largest(difference, count) < 1e-12L * largest(product, count));
	free(hessian);
}

/* Both methods from the raw noise; the objective of what they return, to 1e-10 of each other. */
static oracle_minimum check_minima(const oracle_problem *problem)
{
	double newton[NODES], second[NODES];
	oracle_minimum a, b;
	assert_true(oracle_minimise(problem, newton, &a));
	assert_true(oracle_minimise_lbfgs(problem, second, &b));
	assert_true(a.converged && b.converged);
	assert_true(a.promise < 1e-17L && a.residual < 1e-10L);
	long double value = oracle_objective(problem, newton);
	assert_true(fabsl(value - a.objective) <= 1e-15L * value);
	assert_true(fabsl(oracle_objective(problem, second) - value) <= 1e-10L * value);
	assert_true(value < oracle_objective(problem, problem->start));
	for (size_t k = 0; k < problem->nx * problem->nz; k++) {
		if (!problem->nodes[k])
			continue;
		assert_true(newton[k] >= problem->lower[k] && newton[k] <= problem->upper[k]);
		assert_true(second[k] >= problem->lower[k] && second[k] <= problem->upper[k]);
		assert_true(fabs(newton[k] - second[k]) < 1e-5 * problem->h);
	}
	return a;
}

static void test_minima_of_noisy_wigley(void **state)
{
	(void)state;
	static const double ratios[3] = { 4, 400, 4e4 };
	noisy_hull hull = noisy_wigley(1, 0.01);
	for (size_t k = 0; k < 3; k++) {
		oracle_problem problem = fairing_of(&hull, ratios[k], 0);
		oracle_minimum free_of_limit = check_minima(&problem);
		assert_int_equal(free_of_limit.variables, NODES);
		problem = fairing_of(&hull, ratios[k], 0.01);
		oracle_minimum limited = check_minima(&problem);
		assert_true(limited.objective > free_of_limit.objective);
		assert_true(limited.at_bound > 0 && limited.variables < NODES);
	}
}

static void test_minima_of_a_real_hull(void **state)
{
	(void)state;
	static const double ratios[3] = { 4, 400, 4e4 };
	noisy_hull hull = noisy_real_hull();
	for (size_t k = 0; k < 3; k++) {
		oracle_problem problem = fairing_of(&hull, ratios[k], 0);
		(void)check_minima(&problem);
		problem = fairing_of(&hull, ratios[k], 0.005);
		oracle_minimum limited = check_minima(&problem);
		assert_true(k == 2 || limited.at_bound > limited.variables / 10);
	}
}

/* An earlier study of this hull found 0.614776, 6.132236 and 35.120135 with scipy's L-BFGS-B for
 * the weights 10, 1e3 and 1e5 per m^4, a noise of 0.01 m and the box 0..0.8 m. Its noise is not
 * known number by number. Over the seeds 1..4 the minima here are 0..1, 0..2.1 and -3..12 % off;
 * areas counted whole at the table's ends, a possible reading, give 14 % more for the first. */
static void test_minima_are_those_of_an_earlier_study(void **state)
{
	(void)state;
	static const struct {
		double w2;
		long double objective, spread;
	} known[3] = { { 10, 0.614776L, 0.015L },
		           { 1e3, 6.132236L, 0.03L },
		           { 1e5, 35.120135L, 0.15L } };
	noisy_hull hull = noisy_wigley(3, 0.01);
	hull.h = 0.8;
	for (size_t k = 0; k < 3; k++) {
		oracle_problem problem = fairing_of(&hull, known[k].w2 * pow(0.8, 4), 0);
		double y[NODES];
		oracle_minimum found;
		for (size_t node = 0; node < NODES; node++)
			hull.upper[node] = 0.8;
		assert_true(oracle_minimise(&problem, y, &found));
		assert_true(found.converged);
		assert_true(fabsl(found.objective / known[k].objective - 1) < known[k].spread);
	}
}

/* Largest error of the first-order movement of the exact Wigley hull, relative to the movement. */
static long double first_order_error(double w2)
{
	noisy_hull hull = noisy_wigley(1, 0);
	oracle_problem problem = fairing_of(&hull, w2, 0.5);
	long double movement[NODES];
	double y[NODES], weight[NODES];
	oracle_minimum found;
	for (size_t k = 0; k < NODES; k++) {
		weight[k] = 1 + 0.5 * (double)(k % 3);
		if (hull.lower[k] < hull.upper[k])
			hull.lower[k] = -1;
	}
	problem.closeness_weight = weight;
	assert_true(oracle_first_order(&problem, movement));
	assert_true(oracle_minimise(&problem, y, &found));
	assert_true(found.converged && found.at_bound == 0);
	long double most = largest(movement, NODES), error = 0;
	for (size_t k = 0; k < NODES; k++) {
		error = fmaxl(error, fabsl((long double)y[k] - hull.y[k] - movement[k]));
		assert_true(hull.lower[k] < hull.upper[k] || movement[k] == 0);
	}
	return error / most;
}

static void test_first_order_movement(void **state)
{
	(void)state;
	long double coarse = first_order_error(1e9), fine = first_order_error(1e10);
	assert_true(fine < 1e-3L);
	assert_true(coarse / fine > 9.5L && coarse / fine < 10.5L);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_gradient_by_two_ways),
		cmocka_unit_test(test_gradient_against_the_objective),
		cmocka_unit_test(test_hessian_by_two_ways),
		cmocka_unit_test(test_minima_of_noisy_wigley),
		cmocka_unit_test(test_minima_of_a_real_hull),
		cmocka_unit_test(test_minima_are_those_of_an_earlier_study),
		cmocka_unit_test(test_first_order_movement),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
