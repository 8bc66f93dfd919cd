/* What Letcher 4.9-4.10 says of tensor-product B-splines, on random nets. */
#include "bspline_fixture.h"

enum { TRIALS = 40, SAMPLES = 12 };

static void corners_and_edges(void **state)
{
	uint64_t seed = 32;
	for (int trial = 0; trial < TRIALS; trial++) {
		batten_surface *s = random_net(*state, &seed, true, trial % 2);
		size_t last_row = (s->count_v - 1) * s->count_u;
		struct bspline_curve edge;
		struct bspline_curve_net net = { s->order_u,
			                             s->count_u,
			                             3,
			                             s->knots_u,
			                             s->poles + 3 * last_row,
			                             s->weights ? s->weights + last_row : NULL };
		double last_v = surface_place(s, BATTEN_DIRECTION_V, 1);
		assert_int_equal(bspline_curve_create(*state, &net, &edge), BATTEN_OK);
		for (int i = 0; i <= SAMPLES; i++) {
			double u = surface_place(s, BATTEN_DIRECTION_U, (double)i / SAMPLES);
			surface_jet d;
			double expected[12];
			surface_evaluate(s, u, last_v, 3, d);
			bspline_curve_evaluate(&edge, u, 3, expected);
			double size = 1 / shortest_span(s->order_u, s->count_u, s->knots_u);
			for (size_t k = 0; k <= 3; k++)
				assert_all_close(3, d[k][0], expected + 3 * k,
				                 1e-13 * pow((double)s->order_u * size, (double)k));
			if (i == 0)
				assert_all_close(3, d[0][0], s->poles + 3 * last_row, 1e-15);
			if (i == SAMPLES)
				assert_all_close(3, d[0][0], s->poles + 3 * (last_row + s->count_u - 1), 1e-15);
		}
		bspline_curve_destroy(&edge);
		batten_surface_destroy(s);
	}
}

/* The slope across an edge depends on the two rows nearest to it only, the bend on three. */
static void rows_that_shape_an_edge(void **state)
{
	uint64_t seed = 33;
	const size_t orders[2] = { 4, 5 };
	const size_t counts[2] = { 8, 9 };
	batten_surface *s = random_surface(*state, &seed, orders, counts, true, true);
	double first_v = surface_place(s, BATTEN_DIRECTION_V, 0);
	double u = surface_place(s, BATTEN_DIRECTION_U, 0.4);
	surface_jet before;
	surface_evaluate(s, u, first_v, 3, before);
	for (size_t row = 0; row < 5; row++) {
		surface_jet after;
		for (size_t i = 0; i < s->count_u; i++)
			s->poles[3 * (row * s->count_u + i)] += 1;
		surface_evaluate(s, u, first_v, 3, after);
		for (size_t j = 0; j <= 3; j++)
			assert_int_equal(fabs(after[0][j][0] - before[0][j][0]) > 1e-9, row <= j);
		for (size_t i = 0; i < s->count_u; i++)
			s->poles[3 * (row * s->count_u + i)] -= 1;
	}
	batten_surface_destroy(s);
}

static void a_pole_moves_its_spans_only(void **state)
{
	uint64_t seed = 34;
	for (int trial = 0; trial < TRIALS; trial++) {
		batten_surface *s = random_net(*state, &seed, trial % 3, trial % 2);
		size_t i = random_size(&seed, 0, s->count_u - 1);
		size_t j = random_size(&seed, 0, s->count_v - 1);
		for (int sample = 0; sample < SAMPLES; sample++) {
			surface_jet before;
			surface_jet after;
			double u;
			double v;
			random_place(s, &seed, &u, &v);
			bool within = u > s->knots_u[i] && u < s->knots_u[i + s->order_u] &&
			              v > s->knots_v[j] && v < s->knots_v[j + s->order_v];
			surface_evaluate(s, u, v, 0, before);
			s->poles[3 * (j * s->count_u + i) + 2] += 1000;
			surface_evaluate(s, u, v, 0, after);
			s->poles[3 * (j * s->count_u + i) + 2] -= 1000;
			assert_int_equal(before[0][0][2] != after[0][0][2], within);
			assert_true(before[0][0][0] == after[0][0][0]);
		}
		batten_surface_destroy(s);
	}
}

/* In any direction a point lies between the extremes of the poles. */
static void within_the_hull_of_its_poles(void **state)
{
	uint64_t seed = 35;
	for (int trial = 0; trial < TRIALS; trial++) {
		batten_surface *s = random_net(*state, &seed, trial % 3, trial % 2);
		for (int sample = 0; sample < SAMPLES; sample++) {
			double direction[3] = { random_between(&seed, -1, 1), random_between(&seed, -1, 1),
				                    random_between(&seed, -1, 1) };
			double low = INFINITY;
			double high = -INFINITY;
			double u;
			double v;
			surface_jet d;
			random_place(s, &seed, &u, &v);
			surface_evaluate(s, u, v, 0, d);
			size_t span_u = bspline_span(s->order_u, s->count_u, s->knots_u, u);
			size_t span_v = bspline_span(s->order_v, s->count_v, s->knots_v, v);
			for (size_t j = span_v + 1 - s->order_v; j <= span_v; j++) {
				for (size_t i = span_u + 1 - s->order_u; i <= span_u; i++) {
					double along = dot(direction, s->poles + 3 * (j * s->count_u + i));
					low = fmin(low, along);
					high = fmax(high, along);
				}
			}
			assert_true(dot(direction, d[0][0]) >= low - 1e-14);
			assert_true(dot(direction, d[0][0]) <= high + 1e-14);
		}
		batten_surface_destroy(s);
	}
}

static void a_map_of_the_poles_maps_the_surface(void **state)
{
	static const double matrix[] = { 1.2, 0.3, 0, -0.5, 0.9, 2, 0.1, 0, -1.1 };
	static const double shift[] = { 3, -1, 0.5 };
	uint64_t seed = 36;
	for (int trial = 0; trial < TRIALS; trial++) {
		batten_surface *s = random_net(*state, &seed, trial % 3, trial % 2);
		batten_surface *mapped = clone_of(s);
		assert_int_equal(batten_surface_map(mapped, matrix, shift), BATTEN_OK);
		double u;
		double v;
		surface_jet before;
		surface_jet after;
		random_place(s, &seed, &u, &v);
		surface_evaluate(s, u, v, 1, before);
		surface_evaluate(mapped, u, v, 1, after);
		for (size_t i = 0; i < 3; i++) {
			assert_close(after[0][0][i], dot(matrix + 3 * i, before[0][0]) + shift[i], 2e-14);
			assert_close(after[1][0][i], dot(matrix + 3 * i, before[1][0]), 1e-11);
		}
		batten_surface_destroy(s);
		batten_surface_destroy(mapped);
	}
}

/* As many equal columns as the order: a parallel middle body between them. */
static void equal_columns_make_a_cylinder(void **state)
{
	uint64_t seed = 37;
	const size_t orders[2] = { 4, 4 };
	const size_t counts[2] = { 9, 6 };
	batten_surface *s = random_surface(*state, &seed, orders, counts, true, false);
	bspline_knots_clamped(4, 9, s->knots_u);
	for (size_t row = 0; row < 6; row++) {
		double *line = s->poles + 3 * row * 9;
		for (size_t i = 0; i < 9; i++)
			line[3 * i] = (double)i;
		for (size_t i = 3; i < 6; i++)
			memcpy(line + 3 * i + 1, line + 3 * 2 + 1, 2 * sizeof *line);
	}
	/* Poles 3 to 6 rule the span from 2/6 to 3/6. */
	for (int j = 1; j < SAMPLES; j++) {
		double v = surface_place(s, BATTEN_DIRECTION_V, (double)j / SAMPLES);
		struct shape first = shape_at(s, 2. / 6, v);
		for (int i = 0; i <= 10; i++) {
			struct shape here = shape_at(s, (2 + i / 10.) / 6, v);
			assert_all_close(3, here.normal, first.normal, 1e-13);
			assert_close(here.gauss, 0, 1e-11 * (1 + here.mean * here.mean));
		}
	}
	batten_surface_destroy(s);
}

/* The first row on the centreplane under the second: the hull leaves it square, and with its mirror
 * image it is round, the same curvature on both sides. */
static void durable_rounding(void **state)
{
	uint64_t seed = 38;
	const size_t orders[2] = { 4, 4 };
	const size_t counts[2] = { 7, 6 };
	batten_surface *s = random_surface(*state, &seed, orders, counts, true, false);
	for (size_t i = 0; i < 7; i++) {
		memcpy(s->poles + 3 * i, s->poles + 3 * (7 + i), 3 * sizeof(double));
		s->poles[3 * i + 1] = 0;
		s->poles[3 * (7 + i) + 1] = 0.5 + 0.05 * (double)i;
	}
	batten_surface *other = clone_of(s);
	batten_surface_mirror(other);
	double v = surface_place(s, BATTEN_DIRECTION_V, 0);
	for (int sample = 0; sample <= SAMPLES; sample++) {
		double part = (double)sample / SAMPLES;
		double u = surface_place(s, BATTEN_DIRECTION_U, part);
		double mirrored = surface_place(s, BATTEN_DIRECTION_U, 0) +
		                  surface_place(s, BATTEN_DIRECTION_U, 1) - u;
		surface_jet port;
		surface_jet starboard;
		surface_evaluate(s, u, v, 2, port);
		surface_evaluate(other, mirrored, v, 2, starboard);
		assert_close(port[0][1][0], 0, 1e-14);
		assert_close(port[0][1][2], 0, 1e-14);
		assert_true(port[0][1][1] > 0.1);
		assert_all_close(3, starboard[0][0], port[0][0], 1e-14);
		/* The part of the second derivative across the tangent is the curvature vector. */
		double scale = port[0][1][1] * port[0][1][1];
		assert_close(starboard[0][2][0] / scale, port[0][2][0] / scale, 1e-11);
		assert_close(starboard[0][2][2] / scale, port[0][2][2] / scale, 1e-11);
	}
	batten_surface_destroy(s);
	batten_surface_destroy(other);
}

/* Two surfaces with the same edge row, knots and weights in proportion share the edge; with others
 * they do not. */
static void shared_edges(void **state)
{
	uint64_t seed = 39;
	const size_t orders[2] = { 4, 3 };
	const size_t counts[2] = { 8, 5 };
	batten_surface *a = random_surface(*state, &seed, orders, counts, true, true);
	batten_surface *b = random_surface(*state, &seed, orders, counts, true, true);
	size_t last = 4 * 8;
	memcpy(b->knots_u, a->knots_u, 12 * sizeof *a->knots_u);
	memcpy(b->poles, a->poles + 3 * last, 24 * sizeof *a->poles);
	for (size_t i = 0; i < 8; i++)
		b->weights[i] = 2.5 * a->weights[last + i];
	double gap = 0;
	for (int changed = 0; changed < 2; changed++) {
		gap = 0;
		for (int i = 0; i <= 50; i++) {
			double u = surface_place(a, BATTEN_DIRECTION_U, i / 50.);
			surface_jet at_a;
			surface_jet at_b;
			surface_evaluate(a, u, surface_place(a, BATTEN_DIRECTION_V, 1), 0, at_a);
			surface_evaluate(b, u, surface_place(b, BATTEN_DIRECTION_V, 0), 0, at_b);
			for (size_t c = 0; c < 3; c++)
				gap = fmax(gap, fabs(at_a[0][0][c] - at_b[0][0][c]));
		}
		if (changed == 0)
			assert_close(gap, 0, 1e-14);
		b->weights[3] *= 1.1;
	}
	assert_true(gap > 1e-4);
	batten_surface_destroy(a);
	batten_surface_destroy(b);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(corners_and_edges),
		cmocka_unit_test(rows_that_shape_an_edge),
		cmocka_unit_test(a_pole_moves_its_spans_only),
		cmocka_unit_test(within_the_hull_of_its_poles),
		cmocka_unit_test(a_map_of_the_poles_maps_the_surface),
		cmocka_unit_test(equal_columns_make_a_cylinder),
		cmocka_unit_test(durable_rounding),
		cmocka_unit_test(shared_edges),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
