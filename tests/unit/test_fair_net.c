/* Fairing by the control net of a surface: what is held, what is kept, what becomes fairer. */
#include "unit/fit_fixture.h"

#include "hull/hull.h"

static batten_fair_options net_options(size_t count_u, size_t count_v)
{
	batten_fair_options options;
	batten_fair_options_default(&options);
	options.variables = BATTEN_VARIABLES_NET;
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.fit.count_u = count_u;
	options.fit.count_v = count_v;
	options.weights_given = true;
	options.w1 = 1.0;
	options.w2 = 1e3;
	return options;
}

static batten_fairing *fair(batten_context *context, const batten_hull *hull,
                            const batten_fair_options *options)
{
	batten_fairing *fairing = NULL;
	if (batten_hull_fair(context, hull, options, &fairing) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return fairing;
}

/* Movement of a pole along y; x and z stay to the last bit. */
static double moved(const batten_fairing *fairing, size_t i, size_t j)
{
	const batten_surface_net a = batten_surface_describe(batten_fairing_fitted_surface(fairing));
	const batten_surface_net b = batten_surface_describe(batten_fairing_faired_surface(fairing));
	assert_true(pole(&a, i, j)[0] == pole(&b, i, j)[0]);
	assert_true(pole(&a, i, j)[2] == pole(&b, i, j)[2]);
	return pole(&b, i, j)[1] - pole(&a, i, j)[1];
}

/* Every pole within the limit, every change of the surface too; the objective does not rise; the
 * edges in the centreplane stay; zeros stay and positive offsets remain positive. */
static void check_rules(const batten_hull *hull, const batten_fairing *fairing)
{
	const batten_surface_net a = batten_surface_describe(batten_fairing_fitted_surface(fairing));
	const double limit = batten_fairing_describe(fairing).max_distance_m;
	const double half_beam = batten_hull_half_beam_m(batten_fairing_smoothed(fairing));
	const batten_search_result *result = batten_fairing_result(fairing);
	assert_true(result->objective_end <= result->objective_start);
	for (size_t j = 0; j < a.count_v; j++)
		for (size_t i = 0; i < a.count_u; i++) {
			const double before = pole(&a, i, j)[1];
			const double after = before + moved(fairing, i, j);
			assert_true(fabs(after - before) <= limit);
			assert_true(after >= fmin(before, 0.0) - 1e-15);
			assert_true(after <= fmax(before, 1.2 * half_beam) + 1e-15);
		}
	for (int k = 0; k < 400; k++) {
		batten_surface_point p, q;
		const double u = fmod(0.61803398875 * k, 1.0);
		const double v = (k + 0.5) / 400.0;
		assert_int_equal(batten_surface_evaluate(batten_fairing_fitted_surface(fairing), u, v, &p),
		                 BATTEN_OK);
		assert_int_equal(batten_surface_evaluate(batten_fairing_faired_surface(fairing), u, v, &q),
		                 BATTEN_OK);
		assert_true(fabs(q.derivative[0][0][1] - p.derivative[0][0][1]) <= limit);
	}
	const batten_hull *faired = batten_fairing_faired(fairing);
	for (size_t n = 0; n < batten_hull_station_count(hull) * batten_hull_waterline_count(hull);
	     n++) {
		if (batten_hull_nodes(hull)[n] != BATTEN_NODE_GIVEN)
			continue;
		assert_true((batten_hull_y_m(hull)[n] > 0.0) == (batten_hull_y_m(faired)[n] > 0.0));
		assert_true(fabs(batten_hull_y_m(faired)[n] -
		                 batten_hull_y_m(batten_fairing_smoothed(fairing))[n]) <=
		            limit + 1.1 * batten_fairing_describe_net(fairing).deviation.max_m +
		                0.002 * half_beam);
	}
}

static double distance_from_wigley(const batten_hull *hull)
{
	const size_t nx = batten_hull_station_count(hull);
	const size_t count = nx * batten_hull_waterline_count(hull);
	double sum = 0.0;
	for (size_t n = 0; n < count; n++) {
		const double x = batten_hull_x_m(hull)[n % nx] / 16.0;
		const double z = batten_hull_z_m(hull)[n / nx];
		const double y = 3.2 * x * (1.0 - x) * (1.0 - (1.0 - z) * (1.0 - z));
		sum += (batten_hull_y_m(hull)[n] - y) * (batten_hull_y_m(hull)[n] - y);
	}
	return sqrt(sum / (double)count);
}

/* As a net of 3 x 3, 4 x 4 and of the size chosen: without noise nothing moves. */
static void test_exact_wigley_stays(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley");
	const size_t sizes[3] = { 3, 4, 0 };
	for (size_t k = 0; k < 3; k++) {
		batten_fair_options options = net_options(sizes[k], sizes[k]);
		options.weights_given = false;
		if (sizes[k] == 3)
			options.fit.order_u = options.fit.order_v = 3;
		batten_fairing *fairing = fair(*state, hull, &options);
		check_rules(hull, fairing);
		assert_below(distance_from_wigley(batten_fairing_faired(fairing)), 1e-6 * 0.8,
		             "distance from the exact hull");
		batten_fairing_destroy(fairing);
	}
	batten_hull_destroy(hull);
}

static void test_noise_goes(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options(0, 0);
	options.weights_given = false;
	batten_fairing *fairing = fair(*state, hull, &options);
	check_rules(hull, fairing);
	/* 0.22 % of h is measured, 0.67 % are put in. */
	assert_below(distance_from_wigley(batten_fairing_faired(fairing)), 0.0025 * 0.8,
	             "distance from the exact hull");
	assert_true(distance_from_wigley(hull) > 0.006 * 0.8);
	const batten_fairing_net net = batten_fairing_describe_net(fairing);
	assert_true(net.after.bending < net.before.bending);
	assert_int_equal(net.kept_count, 0);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* The nets chosen for the shipped hulls keep the bounds that the tests of the fit set. */
static void test_chosen_nets(void **state)
{
	static const struct {
		const char *name;
		double rms_pct, max_pct;
	} bounds[] = { { "npl_parent", 0.2, 1.2 },
		           { "bsra_trawler", 0.11, 0.65 },
		           { "highspeed_craft", 0.16, 1.8 },
		           { "wigley", 1e-7, 1e-7 } };
	for (size_t b = 0; b < sizeof bounds / sizeof bounds[0]; b++) {
		batten_hull *hull = read_hull(*state, bounds[b].name);
		batten_fair_options options = net_options(0, 0);
		options.max_distance_m = 0.0;
		batten_fairing *fairing = fair(*state, hull, &options);
		const batten_fairing_net net = batten_fairing_describe_net(fairing);
		assert_below(net.deviation.rms_pct, bounds[b].rms_pct, bounds[b].name);
		assert_below(net.deviation.max_pct, bounds[b].max_pct, bounds[b].name);
		assert_true((double)net.pole_count <= 0.7 * (double)net.deviation.point_count);
		check_rules(hull, fairing);
		batten_fairing_destroy(fairing);
		batten_hull_destroy(hull);
	}
}

/* A transom's line ends, which lie off the table, move with the offsets beside them: no waterline
 * has a kink there. */
static void test_line_ends(void **state)
{
	batten_hull *hull = read_hull(*state, "highspeed_craft");
	batten_fair_options options = net_options(0, 0);
	batten_fairing *fairing = fair(*state, hull, &options);
	const batten_hull *smoothed = batten_fairing_smoothed(fairing);
	const batten_hull *faired = batten_fairing_faired(fairing);
	size_t compared = 0;
	double largest = 0.0;
	for (size_t e = 0; e < smoothed->end_count; e++) {
		const hull_line_end *end = &smoothed->ends[e];
		const size_t first = end->line * smoothed->station_count;
		if (!end->on_waterline || end->along_m > smoothed->x_m[0] ||
		    smoothed->x_m[0] - end->along_m > 0.1 || !(end->y_m > 0.0))
			continue;
		const double moved_end = faired->ends[e].y_m - end->y_m;
		assert_near(moved_end, faired->y_m[first] - smoothed->y_m[first], 0.003,
		            "movement of a line end");
		largest = fmax(largest, fabs(moved_end));
		compared++;
	}
	assert_true(compared > 0 && largest > 0.006);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* Rows, columns, poles and edges of the net. */
static void test_net_locks(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options(8, 7);
	batten_fairing *fairing = fair(*state, hull, &options);
	/* All of what is locked below moves when it is not. */
	for (size_t i = 1; i < 7; i++)
		assert_true(moved(fairing, i, 3) != 0.0 && moved(fairing, i, 6) != 0.0);
	for (size_t j = 1; j < 7; j++)
		assert_true(moved(fairing, 2, j) != 0.0);
	assert_true(moved(fairing, 5, 4) != 0.0);
	batten_fairing_destroy(fairing);
	const batten_net_lock locks[] = { { .kind = BATTEN_NET_LOCK_ROW, .row = 3 },
		                              { .kind = BATTEN_NET_LOCK_COLUMN, .column = 2 },
		                              { BATTEN_NET_LOCK_POLE, 5, 4 } };
	options.net_locks = locks;
	options.net_lock_count = 3;
	options.locked_edges = BATTEN_EDGE_DECK;
	fairing = fair(*state, hull, &options);
	size_t free_poles = 0;
	for (size_t j = 0; j < 7; j++)
		for (size_t i = 0; i < 8; i++) {
			const bool held = i == 0 || i == 7 || j == 0 || j == 3 || j == 6 || i == 2 ||
			                  (i == 5 && j == 4);
			assert_true((moved(fairing, i, j) == 0.0) == held);
			free_poles += !held;
		}
	assert_int_equal(batten_fairing_describe(fairing).variable_count, free_poles);
	assert_int_equal(batten_fairing_describe_net(fairing).locked_count, 56 - free_poles);
	check_rules(hull, fairing);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* The surface rests at a locked station, waterline or point; its offsets keep their numbers. */
static void test_table_locks(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const size_t nx = batten_hull_station_count(hull);
	const size_t station = 8;
	const size_t waterline = 12;
	const batten_lock lock[] = {
		{ BATTEN_LOCK_STATION, batten_hull_x_m(hull)[station], 0.0 },
		{ BATTEN_LOCK_WATERLINE, 0.0, batten_hull_z_m(hull)[waterline] },
		{ BATTEN_LOCK_POINT, batten_hull_x_m(hull)[station], batten_hull_z_m(hull)[waterline] },
	};
	for (size_t k = 0; k < 3; k++) {
		batten_fair_options options = net_options(12, 11);
		options.locks = &lock[k];
		options.lock_count = 1;
		batten_fairing *fairing = fair(*state, hull, &options);
		size_t changed = 0;
		for (size_t w = 0; w < batten_hull_waterline_count(hull); w++)
			for (size_t s = 0; s < nx; s++) {
				const bool held = (lock[k].kind == BATTEN_LOCK_WATERLINE || s == station) &&
				                  (lock[k].kind == BATTEN_LOCK_STATION || w == waterline);
				const double before = batten_hull_y_m(hull)[w * nx + s];
				const double after = batten_hull_y_m(batten_fairing_faired(fairing))[w * nx + s];
				if (held)
					assert_true(before == after);
				changed += before != after;
			}
		assert_true(changed > 100);
		for (int i = 0; i <= 200; i++) {
			batten_surface_point p, q;
			const double part = i / 200.0;
			const batten_surface *fitted = batten_fairing_fitted_surface(fairing);
			const batten_surface *faired = batten_fairing_faired_surface(fairing);
			for (int j = 0; j <= 200; j++) {
				assert_int_equal(batten_surface_evaluate(fitted, part, j / 200.0, &p), BATTEN_OK);
				const double *at = p.derivative[0][0];
				if ((lock[k].kind == BATTEN_LOCK_WATERLINE || fabs(at[0] - lock[k].x_m) < 1e-3) &&
				    (lock[k].kind == BATTEN_LOCK_STATION || fabs(at[2] - lock[k].z_m) < 1e-4)) {
					assert_int_equal(batten_surface_evaluate(faired, part, j / 200.0, &q),
					                 BATTEN_OK);
					assert_near(q.derivative[0][0][1], at[1], 1e-15, "y where it is locked");
				}
			}
		}
		check_rules(hull, fairing);
		batten_fairing_destroy(fairing);
	}
	batten_hull_destroy(hull);
}

/* The deck moves with the row below it; where it is locked too, both stay. So does the row beside a
 * keel in the centreplane. */
static void test_fixed_tangents(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options(8, 7);
	options.fixed_tangents = BATTEN_EDGE_DECK | BATTEN_EDGE_KEEL;
	for (int locked = 0; locked < 2; locked++) {
		options.locked_edges = locked ? BATTEN_EDGE_DECK : 0;
		batten_fairing *fairing = fair(*state, hull, &options);
		double largest = 0.0;
		for (size_t i = 0; i < 8; i++) {
			assert_near(moved(fairing, i, 5), moved(fairing, i, 6), 1e-15, "deck and beside it");
			assert_true(moved(fairing, i, 0) == 0.0 && moved(fairing, i, 1) == 0.0);
			largest = fmax(largest, fabs(moved(fairing, i, 6)));
		}
		assert_true(locked ? largest == 0.0 : largest > 1e-5);
		check_rules(hull, fairing);
		batten_fairing_destroy(fairing);
	}
	batten_hull_destroy(hull);
}

/* Letcher 4.13: first row = second row projected on the centreplane. The crossing tangent is along
 * y, and the surface goes on into its mirrored half with the same curvature. */
static void test_durable_rounding(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options(9, 8);
	options.fit.rounded = BATTEN_ROUNDED_STEM;
	batten_fairing *fairing = fair(*state, hull, &options);
	const batten_surface *faired = batten_fairing_faired_surface(fairing);
	const batten_surface_net net = batten_surface_describe(faired);
	double largest = 0.0;
	for (size_t j = 1; j < 8; j++) {
		assert_true(pole(&net, 8, j)[1] == 0.0);
		assert_true(pole(&net, 8, j)[0] == pole(&net, 7, j)[0]);
		assert_true(pole(&net, 8, j)[2] == pole(&net, 7, j)[2]);
		largest = fmax(largest, fabs(moved(fairing, 7, j)));
	}
	assert_true(largest > 1e-6);
	for (int k = 1; k <= 20; k++) {
		batten_surface_point p;
		assert_int_equal(batten_surface_evaluate(faired, 1.0, k / 20.0, &p), BATTEN_OK);
		const double *by_u = p.derivative[1][0];
		assert_near(p.derivative[0][0][1], 0.0, 1e-15, "y on the stem");
		assert_near(hypot(by_u[0], by_u[2]) / fabs(by_u[1]), 0.0, 1e-12, "tangent off the y axis");
		/* The mirrored half has the mirrored curvature vector there: the same one where it lies in
		 * the centreplane. */
		const double *second = p.derivative[2][0];
		const double speed = by_u[0] * by_u[0] + by_u[1] * by_u[1] + by_u[2] * by_u[2];
		const double along = (second[0] * by_u[0] + second[1] * by_u[1] + second[2] * by_u[2]) /
		                     speed;
		double curvature[3];
		for (size_t c = 0; c < 3; c++)
			curvature[c] = (second[c] - along * by_u[c]) / speed;
		assert_true(hypot(curvature[0], curvature[2]) > 1e-3);
		assert_near(curvature[1] / hypot(curvature[0], curvature[2]), 0.0, 1e-9,
		            "curvature out of the centreplane");
	}
	check_rules(hull, fairing);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* The end of a search is where the next one stays: from the faired table with the same net, and held
 * to it, nothing moves by more than the steps of the search. */
static void test_restart(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options(8, 7);
	options.w2 = 1e5;
	options.max_distance_part = 0.05;
	batten_fairing *first = fair(*state, hull, &options);
	const batten_surface_net a = batten_surface_describe(batten_fairing_fitted_surface(first));
	const batten_surface *faired = batten_fairing_faired_surface(first);
	double fitted_y[56], lower[56], upper[56], y[56];
	for (size_t p = 0; p < 56; p++) {
		fitted_y[p] = a.poles_m[3 * p + 1];
		const bool edge = p / 8 == 0 || p % 8 == 0 || p % 8 == 7;
		lower[p] = edge ? fitted_y[p] : fitted_y[p] - 0.04;
		upper[p] = edge ? fitted_y[p] : fitted_y[p] + 0.04;
	}
	const batten_net_problem problem = { .start = faired,
		                                 .target_y_m = fitted_y,
		                                 .lower_y_m = lower,
		                                 .upper_y_m = upper,
		                                 .w1 = 1.0,
		                                 .w2 = 1e5,
		                                 .half_beam_m = batten_hull_half_beam_m(hull) };
	batten_net_options how;
	batten_net_options_default(&how);
	how.search.device = BATTEN_DEVICE_REFERENCE;
	batten_search_result result;
	assert_int_equal(batten_net_search_batch(*state, 1, &problem, &how, y, &result, NULL),
	                 BATTEN_OK);
	const batten_surface_net b = batten_surface_describe(faired);
	for (size_t p = 0; p < 56; p++)
		assert_near(y[p], b.poles_m[3 * p + 1], 1e-5 * problem.half_beam_m, "a pole, restarted");
	batten_fairing_destroy(first);
	batten_hull_destroy(hull);
}

/* Every fairness falls by its own search. */
static void test_fairness(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	for (int k = 0; k <= (int)BATTEN_FAIRNESS_VARIATION; k++) {
		batten_fair_options options = net_options(8, 7);
		options.fairness = (batten_fairness)k;
		options.w2 = 10.0;
		batten_fairing *fairing = fair(*state, hull, &options);
		const batten_fairing_net net = batten_fairing_describe_net(fairing);
		const batten_search_result *result = batten_fairing_result(fairing);
		assert_true(result->objective_end < 0.99 * result->objective_start);
		if (k == BATTEN_FAIRNESS_BENDING)
			assert_true(net.after.bending < net.before.bending);
		if (k == BATTEN_FAIRNESS_MEAN)
			assert_true(net.after.mean < net.before.mean);
		if (k == BATTEN_FAIRNESS_GAUSS)
			assert_true(net.after.gauss < net.before.gauss);
		check_rules(hull, fairing);
		batten_fairing_destroy(fairing);
	}
	batten_hull_destroy(hull);
}

static void refuse(batten_context *context, const batten_hull *hull,
                   const batten_fair_options *options, batten_status status, const char *part)
{
	batten_fairing *fairing = NULL;
	assert_int_equal(batten_hull_fair(context, hull, options, &fairing), status);
	assert_null(fairing);
	if (!strstr(batten_context_error(context), part))
		fail_msg("'%s' is not in '%s'", part, batten_context_error(context));
	assert_null(strchr(batten_context_error(context), '\n'));
}

static void test_refusals(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options(8, 7);
	options.lower = hull;
	refuse(*state, hull, &options, BATTEN_USAGE, "lower and upper offsets");
	options = net_options(8, 7);
	options.upper = hull;
	refuse(*state, hull, &options, BATTEN_USAGE, "lower and upper offsets");
	batten_net_lock lock = { .kind = BATTEN_NET_LOCK_ROW, .row = 7 };
	options = net_options(8, 7);
	options.net_locks = &lock;
	options.net_lock_count = 1;
	refuse(*state, hull, &options, BATTEN_USAGE, "found row 7, expected 0 to 6");
	lock = (batten_net_lock){ .kind = BATTEN_NET_LOCK_COLUMN, .column = 8 };
	refuse(*state, hull, &options, BATTEN_USAGE, "found column 8, expected 0 to 7");
	lock = (batten_net_lock){ BATTEN_NET_LOCK_POLE, 2, 9 };
	refuse(*state, hull, &options, BATTEN_USAGE, "found row 9");
	options.variables = BATTEN_VARIABLES_OFFSETS;
	refuse(*state, hull, &options, BATTEN_USAGE, "--variables net");
	options = net_options(8, 7);
	options.fixed_tangents = 16;
	refuse(*state, hull, &options, BATTEN_USAGE, "edge 16");
	options = net_options(8, 7);
	options.variables = BATTEN_VARIABLES_OFFSETS;
	options.fairness = BATTEN_FAIRNESS_VARIATION;
	options.search.longitudinal_weight = 2.0;
	refuse(*state, hull, &options, BATTEN_USAGE, "principal directions");
	options = net_options(8, 7);
	options.variables = (batten_variables)7;
	refuse(*state, hull, &options, BATTEN_USAGE, "variables 7");
	options = net_options(8, 7);
	options.fit.stiffness = 0.0;
	refuse(*state, hull, &options, BATTEN_USAGE, "stiffness 0");
	options.fit.stiffness = NAN;
	refuse(*state, hull, &options, BATTEN_USAGE, "stiffness");
	options = net_options(22, 7);
	refuse(*state, hull, &options, BATTEN_INPUT, "expected at least 22");
	options = net_options(8, 7);
	options.fit.order_u = 9;
	refuse(*state, hull, &options, BATTEN_USAGE, "order 9");
	options = net_options(8, 7);
	options.fairness = (batten_fairness)4;
	refuse(*state, hull, &options, BATTEN_USAGE, "fairness 4");
	batten_hull_destroy(hull);
}

/* An allocator that fails at its n-th call. */
struct limited {
	long left;
};

static void *allocate_limited(size_t size, void *user)
{
	struct limited *limited = user;
	return limited->left-- > 0 ? malloc(size) : NULL;
}

static void release_limited(void *memory, void *user)
{
	(void)user;
	free(memory);
}

static void test_memory(void **state)
{
	(void)state;
	struct limited limited = { .left = 1000000000 };
	batten_context_options how;
	batten_context *context = NULL;
	batten_context_options_default(&how);
	how.allocate = allocate_limited;
	how.release = release_limited;
	how.allocate_user = &limited;
	how.threads = 1;
	assert_int_equal(batten_context_create(&how, &context), BATTEN_OK);
	batten_hull *hull = read_hull(context, "wigley");
	batten_fair_options options = net_options(4, 4);
	options.search.iteration_limit = 2;
	batten_status status = BATTEN_MEMORY;
	long calls = 0;
	for (; status == BATTEN_MEMORY && calls < 5000; calls++) {
		batten_fairing *fairing = NULL;
		limited.left = calls;
		status = batten_hull_fair(context, hull, &options, &fairing);
		assert_true((status == BATTEN_MEMORY) == !fairing);
		batten_fairing_destroy(fairing);
	}
	assert_true(status == BATTEN_OK || status == BATTEN_INCOMPLETE);
	assert_true(calls > 20);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_exact_wigley_stays, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_noise_goes, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_chosen_nets, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_line_ends, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_net_locks, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_table_locks, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_fixed_tangents, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_durable_rounding, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_restart, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_fairness, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
