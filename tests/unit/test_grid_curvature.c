/* Derivatives and curvatures of offset tables against closed forms; which nodes have one. */
#include "geometry/grid_curvature.h"
#include "hull/hull.h"
#include "support/failing_heap.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STATIONS = 7, WATERLINES = 6, NODES = STATIONS * WATERLINES };
static const double stations[STATIONS] = { 0, 0.7, 1, 2.5, 3, 4, 6 };
static const double waterlines[WATERLINES] = { 0, 0.1, 0.4, 0.5, 0.9, 1 };

static int make_context(void **state)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	*state = context;
	return 0;
}

static int end_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

static batten_hull *make(batten_context *context, size_t m, size_t n, const double *x,
                         const double *z, const double *y, const uint8_t *nodes)
{
	batten_hull_table table = { .name = "h",
		                        .lbp_m = 1,
		                        .draft_m = z[n - 1],
		                        .station_count = m,
		                        .waterline_count = n,
		                        .x_m = x,
		                        .z_m = z,
		                        .y_m = y,
		                        .nodes = nodes };
	batten_hull *hull = NULL;
	if (batten_hull_create(context, &table, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static grid_curvature *curvature_of(batten_context *context, const batten_hull *hull)
{
	grid_curvature *grid = NULL;
	if (grid_curvature_create(context, hull, &grid) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return grid;
}

static void near(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.17g, expected %.17g", found, expected);
}

/* Three-point formulas are exact for parabolas whatever the spacing, the mixed one for x z. */
static void parabolas_are_exact(void **state)
{
	double y[NODES];
	for (size_t j = 0; j < WATERLINES; j++)
		for (size_t i = 0; i < STATIONS; i++) {
			double x = stations[i];
			double z = waterlines[j];
			y[j * STATIONS + i] = 3 + 0.2 * x - 0.05 * x * x + 0.3 * z - 0.4 * z * z + 0.07 * x * z;
		}
	batten_hull *hull = make(*state, STATIONS, WATERLINES, stations, waterlines, y, NULL);
	grid_curvature *grid = curvature_of(*state, hull);
	assert_int_equal(grid->own_count, (STATIONS - 2) * (WATERLINES - 2));
	double area = 0;
	for (size_t j = 1; j + 1 < WATERLINES; j++)
		for (size_t i = 1; i + 1 < STATIONS; i++) {
			size_t node = j * STATIONS + i;
			double p = 0.2 - 0.1 * stations[i] + 0.07 * waterlines[j];
			double q = 0.3 - 0.8 * waterlines[j] + 0.07 * stations[i];
			double r = -0.1, s = 0.07, t = -0.8;
			double g = 1 + p * p + q * q;
			double mean = ((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * pow(g, 1.5));
			double gauss = (r * t - s * s) / (g * g);
			assert_int_equal(grid->origin[node], GRID_CURVATURE_OWN);
			near(grid->y_x[node], p, 1e-13);
			near(grid->y_z[node], q, 1e-13);
			near(grid->y_xx_per_m[node], r, 1e-12);
			near(grid->y_xz_per_m[node], s, 1e-12);
			near(grid->y_zz_per_m[node], t, 1e-11);
			near(grid->mean_per_m[node], mean, 1e-12);
			near(grid->gauss_per_m2[node], gauss, 1e-12);
			near(grid->bending_per_m2[node], 4 * mean * mean - 2 * gauss, 1e-12);
			double dx = 0.5 * (stations[i + 1] - stations[i - 1]);
			double dz = 0.5 * (waterlines[j + 1] - waterlines[j - 1]);
			near(grid->area_m2[node], sqrt(g) * dx * dz, 1e-13);
			area += dx * dz;
		}
	near(area, 0.5 * (6 + 4 - 0.7) * 0.5 * (1 + 0.9 - 0.1), 1e-12);
	grid_curvature_destroy(*state, grid);
	batten_hull_destroy(hull);
}

/* Largest error of H and K on a sphere of radius 2, over an inner part of its side. */
static double sphere_error(batten_context *context, size_t intervals)
{
	size_t count = intervals + 1;
	double *axis = malloc(count * sizeof *axis);
	double *y = malloc(count * count * sizeof *y);
	assert_non_null(axis);
	assert_non_null(y);
	for (size_t i = 0; i < count; i++)
		axis[i] = -1 + 2 * (double)i / (double)intervals;
	for (size_t j = 0; j < count; j++)
		for (size_t i = 0; i < count; i++)
			y[j * count + i] = sqrt(4 - axis[i] * axis[i] - axis[j] * axis[j]);
	batten_hull *hull = make(context, count, count, axis, axis, y, NULL);
	grid_curvature *grid = curvature_of(context, hull);
	double worst = 0;
	for (size_t node = 0; node < count * count; node++)
		if (fabs(axis[node % count]) <= 0.75 && fabs(axis[node / count]) <= 0.75) {
			assert_int_equal(grid->origin[node], GRID_CURVATURE_OWN);
			worst = fmax(worst, fabs(grid->mean_per_m[node] + 0.5));
			worst = fmax(worst, fabs(grid->gauss_per_m2[node] - 0.25));
		}
	grid_curvature_destroy(context, grid);
	batten_hull_destroy(hull);
	free(axis);
	free(y);
	return worst;
}

/* Convex to the water is negative; the error falls by four when the spacing is halved. */
static void spheres_converge(void **state)
{
	double errors[3];
	for (int k = 0; k < 3; k++)
		errors[k] = sphere_error(*state, (size_t)16 << k);
	assert_true(errors[0] < 0.02);
	for (int k = 0; k < 2; k++) {
		double ratio = errors[k] / errors[k + 1];
		assert_true(ratio > 3.8 && ratio < 4.3);
	}
}

/* A keel that rises aft: no stencil looks below it, and what lies outside changes nothing. */
static void edges_are_respected(void **state)
{
	double y[NODES];
	uint8_t nodes[NODES];
	for (size_t j = 0; j < WATERLINES; j++)
		for (size_t i = 0; i < STATIONS; i++) {
			size_t node = j * STATIONS + i;
			nodes[node] = i + j >= 3 ? BATTEN_NODE_GIVEN : BATTEN_NODE_OUTSIDE;
			y[node] = 1 + 0.1 * (double)(i * i) + 0.2 * (double)(j * i);
		}
	batten_hull *hull = make(*state, STATIONS, WATERLINES, stations, waterlines, y, nodes);
	for (size_t node = 0; node < NODES; node++)
		if (nodes[node] == BATTEN_NODE_OUTSIDE)
			hull->y_m[node] = NAN;
	grid_curvature *grid = curvature_of(*state, hull);
	size_t own = 0;
	for (size_t j = 0; j < WATERLINES; j++)
		for (size_t i = 0; i < STATIONS; i++) {
			size_t node = j * STATIONS + i;
			bool inner = i > 0 && j > 0 && i + 1 < STATIONS && j + 1 < WATERLINES;
			bool whole = inner && i - 1 + j - 1 >= 3;
			own += whole;
			assert_true(isfinite(grid->mean_per_m[node]) && isfinite(grid->area_m2[node]));
			assert_int_equal(grid->origin[node] == GRID_CURVATURE_OWN, whole);
			if (nodes[node] == BATTEN_NODE_OUTSIDE)
				assert_int_equal(grid->origin[node], GRID_CURVATURE_NONE);
			if (!whole) {
				assert_true(grid->area_m2[node] == 0);
				assert_true(grid->y_x[node] == 0);
			}
		}
	assert_int_equal(grid->own_count, own);
	grid_curvature_destroy(*state, grid);
	batten_hull_destroy(hull);
}

/* An edge node takes the nearest own node of its waterline or section; corners have none. */
static void edges_borrow_the_nearest(void **state)
{
	double y[NODES];
	for (size_t node = 0; node < NODES; node++)
		y[node] = 1 + 0.01 * (double)(node * node % 37);
	batten_hull *hull = make(*state, STATIONS, WATERLINES, stations, waterlines, y, NULL);
	grid_curvature *grid = curvature_of(*state, hull);
	const size_t last = STATIONS - 1;
	const size_t top = (WATERLINES - 1) * STATIONS;
	/* Station 0 of waterline 2: along the waterline only. */
	assert_int_equal(grid->origin[2 * STATIONS], GRID_CURVATURE_BORROWED);
	assert_true(grid->mean_per_m[2 * STATIONS] == grid->mean_per_m[2 * STATIONS + 1]);
	assert_true(grid->gauss_per_m2[2 * STATIONS] == grid->gauss_per_m2[2 * STATIONS + 1]);
	assert_true(grid->mean_per_m[2 * STATIONS + last] == grid->mean_per_m[2 * STATIONS + last - 1]);
	assert_true(grid->mean_per_m[3] == grid->mean_per_m[3 + STATIONS]);
	assert_true(grid->bending_per_m2[top + 3] == grid->bending_per_m2[top + 3 - STATIONS]);
	const size_t corners[] = { 0, last, top, top + last };
	for (size_t k = 0; k < 4; k++)
		assert_int_equal(grid->origin[corners[k]], GRID_CURVATURE_NONE);
	grid_curvature_destroy(*state, grid);
	batten_hull_destroy(hull);
}

static void small_tables_have_none(void **state)
{
	const double y[4] = { 1, 1, 1, 1 };
	batten_hull *hull = make(*state, 2, 2, stations, waterlines, y, NULL);
	grid_curvature *grid = curvature_of(*state, hull);
	assert_int_equal(grid->own_count, 0);
	for (size_t node = 0; node < 4; node++)
		assert_int_equal(grid->origin[node], GRID_CURVATURE_NONE);
	grid_curvature_destroy(*state, grid);
	grid_curvature_destroy(*state, NULL);
	batten_hull_destroy(hull);
}

static batten_status create_once(batten_context *context, void *user)
{
	grid_curvature *grid = NULL;
	const batten_status status = grid_curvature_create(context, user, &grid);
	assert_int_equal(grid != NULL, status == BATTEN_OK);
	grid_curvature_destroy(context, grid);
	return status;
}

static void every_allocation_may_fail(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	double y[NODES] = { 0 };
	batten_hull *hull = make(context, STATIONS, WATERLINES, stations, waterlines, y, NULL);
	assert_true(failing_heap_each(&heap, context, create_once, hull) >= 5);
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(parabolas_are_exact, make_context, end_context),
		cmocka_unit_test_setup_teardown(spheres_converge, make_context, end_context),
		cmocka_unit_test_setup_teardown(edges_are_respected, make_context, end_context),
		cmocka_unit_test_setup_teardown(edges_borrow_the_nearest, make_context, end_context),
		cmocka_unit_test_setup_teardown(small_tables_have_none, make_context, end_context),
		cmocka_unit_test(every_allocation_may_fail),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
