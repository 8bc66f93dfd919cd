/* Contours of surfaces (Letcher 4.19), the line K = 0 of Wigley's hull among them; rotation about an axis
 * and projection on a plane (2.3, 2.6, 3.11); points off a surface along its normal (4.13). */
#include "support/failing_heap.h"
#include "surface_fixture.h"

#include "geometry/bspline.h"

enum { SAMPLES = 41 };

typedef struct place {
	batten_context *context;
	batten_surface *surface;
	double u[SAMPLES], v[SAMPLES];
	batten_contours *contours;
} place;

/* A surface over the unit square of parameters, cut at a level over a mesh of count x count. */
static place cut(const batten_surface_net *net, batten_surface_value value, double level,
                 size_t count)
{
	place p = { .context = open_context() };
	for (size_t n = 0; n < count; n++)
		p.u[n] = p.v[n] = n + 1 == count ? 1 : (double)n / (double)(count - 1);
	const batten_surface_samples samples = { count, count, p.u, p.v };
	assert_int_equal(batten_surface_create(p.context, net, &p.surface), BATTEN_OK);
	assert_int_equal(
		batten_surface_contour(p.context, p.surface, value, level, &samples, &p.contours),
		BATTEN_OK);
	return p;
}

static void leave(place *p)
{
	batten_contours_destroy(p->contours);
	batten_surface_destroy(p->surface);
	batten_context_destroy(p->context);
}

static void near(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.17g, expected %.17g within %g", found, expected, tolerance);
}

/* Wigley's hull, L 100, B 10, T 6.25, x forward, z up from the keel (Letcher 30). */
static const double wigley_poles[] = { 0, 0, 0,     50, 0,  0,     100, 0, 0,
	                                   0, 0, 3.125, 50, 10, 3.125, 100, 0, 3.125,
	                                   0, 0, 6.25,  50, 10, 6.25,  100, 0, 6.25 };
static const batten_surface_net wigley = {
	.order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = wigley_poles
};

/* z = f(x) + g(y), parabolas by three poles each, over -1..1. */
static void sum_of_parabolas(double along, double across, double poles[27])
{
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++) {
			double *pole = poles + 3 * (3 * k + i);
			pole[0] = i - 1;
			pole[1] = k - 1;
			pole[2] = along * (i == 1 ? -1 : 1) + across * (k == 1 ? -1 : 1);
		}
}

static batten_surface_net square_net(const double *poles)
{
	return (batten_surface_net){
		.order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = poles
	};
}

/* A section, a waterline and a buttock lie in their planes to the last digits, whatever the mesh: the
 * crossings are the surface's, not the chords'. */
static void sections_of_wigley(void **state)
{
	(void)state;
	for (size_t count = 5; count <= SAMPLES; count += 36) {
		place p = cut(&wigley, BATTEN_SURFACE_VALUE_z, 2.6, count);
		assert_int_equal(batten_contours_count(p.contours), 1);
		const batten_contour line = batten_contours_at(p.contours, 0);
		assert_false(line.closed);
		assert_int_equal(line.count, count);
		for (size_t n = 0; n < line.count; n++) {
			const double *at = line.points_m + 3 * n;
			const double s = at[0] / 100, q = (6.25 - 2.6) / 6.25;
			near(at[2], 2.6, 1e-13);
			near(at[1], 5 * 4 * s * (1 - s) * (1 - q * q), 1e-12);
		}
		leave(&p);
	}
	/* A buttock comes up from the deck and goes back to it; points on both kinds of links. */
	place p = cut(&wigley, BATTEN_SURFACE_VALUE_y, 2, SAMPLES);
	assert_int_equal(batten_contours_count(p.contours), 1);
	const batten_contour line = batten_contours_at(p.contours, 0);
	assert_false(line.closed);
	for (size_t n = 0; n < line.count; n++)
		near(line.points_m[3 * n + 1], 2, 1e-12);
	near(line.v[0], 1, 0);
	near(line.v[line.count - 1], 1, 0);
	leave(&p);
}

/* W6: s = 1 - 2 x / L, q = (1 - s^2) / (1 + 3 s^2) with q = (z / T)^2 below the waterline. Lines end where
 * the table of parameters does. */
static void wigley_line_of_no_gauss_curvature(void **state)
{
	(void)state;
	place p = cut(&wigley, BATTEN_SURFACE_VALUE_gauss, 0, SAMPLES);
	size_t points = 0;
	for (size_t i = 0; i < batten_contours_count(p.contours); i++) {
		const batten_contour line = batten_contours_at(p.contours, i);
		for (size_t n = 0; n < line.count; n++, points++) {
			const double s = 1 - 2 * line.points_m[3 * n] / 100;
			const double depth = (6.25 - line.points_m[3 * n + 2]) / 6.25;
			near(depth * depth, (1 - s * s) / (1 + 3 * s * s), 1e-9);
		}
	}
	assert_true(points > SAMPLES);
	leave(&p);
}

/* A closed line and its length: the circle z = 1/4 of z = x^2 + y^2, by chords, in O(h^2). */
static void closed_lines_come_back(void **state)
{
	(void)state;
	double poles[27], error[2];
	sum_of_parabolas(1, 1, poles);
	const batten_surface_net net = square_net(poles);
	for (int fine = 0; fine < 2; fine++) {
		place p = cut(&net, BATTEN_SURFACE_VALUE_z, 0.25, fine ? 41 : 21);
		assert_int_equal(batten_contours_count(p.contours), 1);
		const batten_contour line = batten_contours_at(p.contours, 0);
		assert_true(line.closed);
		double length = 0;
		for (size_t n = 0; n < line.count; n++) {
			const double *a = line.points_m + 3 * n;
			const double *b = line.points_m + 3 * ((n + 1) % line.count);
			near(hypot(a[0], a[1]), 0.5, 1e-13);
			length += hypot(a[0] - b[0], a[1] - b[1]);
		}
		error[fine] = acos(-1) - length;
		leave(&p);
	}
	assert_true(error[0] > 0 && error[1] > 0);
	assert_true(error[1] < 0.35 * error[0]);
}

/* Both branches of a hyperbola, x y = +-0.001 on the bilinear saddle; both pass through the middle cell,
 * whose corners lie on different sides by turns, and stay apart. */
static void branches_stay_apart(void **state)
{
	(void)state;
	const double poles[] = { -1, -1, 1, 1, -1, -1, -1, 1, -1, 1, 1, 1 };
	const batten_surface_net net = {
		.order_u = 2, .order_v = 2, .count_u = 2, .count_v = 2, .poles_m = poles
	};
	for (int side = -1; side <= 1; side += 2) {
		place p = cut(&net, BATTEN_SURFACE_VALUE_z, side * 1e-3, 12);
		assert_int_equal(batten_contours_count(p.contours), 2);
		for (size_t i = 0; i < 2; i++) {
			const batten_contour line = batten_contours_at(p.contours, i);
			assert_false(line.closed);
			for (size_t n = 0; n < line.count; n++) {
				const double *at = line.points_m + 3 * n;
				near(at[0] * at[1], side * 1e-3, 1e-15);
				assert_true(line.points_m[0] * at[0] > 0);
			}
		}
		leave(&p);
	}
}

/* No line at a level that is not there; a mesh or a value that is none. */
static void refusals(void **state)
{
	(void)state;
	place p = cut(&wigley, BATTEN_SURFACE_VALUE_z, 100, 5);
	assert_int_equal(batten_contours_count(p.contours), 0);
	assert_int_equal(batten_contours_at(p.contours, 0).count, 0);
	batten_contours *none = NULL;
	batten_surface_samples samples = { 1, 5, p.u, p.v };
	assert_int_equal(
		batten_surface_contour(p.context, p.surface, BATTEN_SURFACE_VALUE_z, 1, &samples, &none),
		BATTEN_USAGE);
	assert_string_equal(batten_context_error(p.context),
	                    "a contour over 1 x 5 samples: at least 2 x 2 were expected");
	samples.u_count = 5;
	assert_int_equal(batten_surface_contour(p.context, p.surface, BATTEN_SURFACE_VALUE_COUNT, 1,
	                                        &samples, &none),
	                 BATTEN_USAGE);
	assert_int_equal(
		batten_surface_contour(p.context, p.surface, BATTEN_SURFACE_VALUE_z, NAN, &samples, &none),
		BATTEN_USAGE);
	assert_null(none);
	leave(&p);
}

/* One contour by a context whose memory runs out. */
static batten_status cut_once(batten_context *context, void *user)
{
	const double at[] = { 0, 0.3, 0.8, 1 };
	const batten_surface_samples samples = { 4, 4, at, at };
	batten_contours *contours = NULL;
	const batten_status status = batten_surface_contour(context, user, BATTEN_SURFACE_VALUE_gauss,
	                                                    0.0005, &samples, &contours);
	batten_contours_destroy(contours);
	return status;
}

static void memory_runs_out(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_surface *surface = NULL;
	assert_int_equal(batten_surface_create(context, &wigley, &surface), BATTEN_OK);
	assert_true(failing_heap_each(&heap, context, cut_once, surface) > 20);
	batten_surface_destroy(surface);
	failing_heap_close(&heap, context);
}

static void multiply(const double a[9], const double b[9], double out[9])
{
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

/* Letcher (11), whose printed R21 and R31 fail this. */
static void rotations(void **state)
{
	(void)state;
	batten_context *context = open_context();
	const double right = acos(-1) / 2;
	double m[9];
	assert_int_equal(batten_rotation(context, (const double[]){ 0, 0, 1 }, right, m), BATTEN_OK);
	const double about_z[] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
	for (int n = 0; n < 9; n++)
		near(m[n], about_z[n], 1e-15);
	assert_int_equal(batten_rotation(context, (const double[]){ 0, 3, 0 }, right, m), BATTEN_OK);
	near(m[6], -1, 1e-15);
	near(m[2], 1, 1e-15);
	uint64_t seed = 5;
	for (int round = 0; round < 50; round++) {
		const double axis[] = { draw_real(&seed, -1, 1), draw_real(&seed, -1, 1),
			                    draw_real(&seed, -1, 1) };
		double back[9], product[9];
		assert_int_equal(batten_rotation(context, axis, draw_real(&seed, -9, 9), m), BATTEN_OK);
		for (int n = 0; n < 9; n++)
			back[n] = m[n % 3 * 3 + n / 3];
		multiply(m, back, product);
		for (int n = 0; n < 9; n++)
			near(product[n], n % 4 == 0, 1e-14);
		near(m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
		         m[2] * (m[3] * m[7] - m[4] * m[6]),
		     1, 1e-14);
		for (int c = 0; c < 3; c++) /* the axis stays */
			near(m[3 * c] * axis[0] + m[3 * c + 1] * axis[1] + m[3 * c + 2] * axis[2], axis[c],
			     1e-14);
	}
	assert_int_equal(batten_rotation(context, (const double[]){ 0, 0, 0 }, 1, m), BATTEN_USAGE);
	assert_int_equal(batten_rotation(context, (const double[]){ 0, NAN, 0 }, 1, m), BATTEN_USAGE);
	assert_int_equal(batten_rotation(context, (const double[]){ 1, 0, 0 }, INFINITY, m),
	                 BATTEN_USAGE);
	batten_context_destroy(context);
}

/* Maps one after the other are their product at once, in that order (2.3). A projection on a plane (29)
 * leaves every point in the plane, straight before where it was. */
static void maps_of_a_surface(void **state)
{
	(void)state;
	batten_context *context = open_context();
	batten_surface *given = NULL, *turned = NULL, *at_once = NULL, *flat = NULL;
	const double none[3] = { 0 }, stretch[] = { 2, 0, 0, 0, 1, 0, 0, 0, 0.5 };
	double turn[9], product[9], other[9];
	assert_int_equal(batten_surface_create(context, &wigley, &given), BATTEN_OK);
	batten_surface **copies[] = { &turned, &at_once, &flat };
	for (int c = 0; c < 3; c++)
		assert_int_equal(batten_surface_clone(context, given, copies[c]), BATTEN_OK);
	assert_int_equal(batten_rotation(context, (const double[]){ 1, 1, 0 }, 0.7, turn), BATTEN_OK);
	multiply(stretch, turn, product);
	multiply(turn, stretch, other);
	assert_true(fabs(product[1] - other[1]) > 0.1);
	assert_int_equal(batten_surface_map(turned, turn, none), BATTEN_OK);
	assert_int_equal(batten_surface_map(turned, stretch, none), BATTEN_OK);
	assert_int_equal(batten_surface_map(at_once, product, none), BATTEN_OK);
	const double n[] = { 2.0 / 3, -1.0 / 3, 2.0 / 3 }, far = 4;
	double onto[9], shift[3];
	for (int i = 0; i < 9; i++)
		onto[i] = (i % 4 == 0) - n[i / 3] * n[i % 3];
	for (int c = 0; c < 3; c++)
		shift[c] = far * n[c];
	assert_int_equal(batten_surface_map(flat, onto, shift), BATTEN_OK);
	for (int i = 0; i <= 10; i++) {
		batten_surface_point p, a, b, f;
		const double u = 0.1 * i, v = 1 - 0.07 * i;
		assert_int_equal(batten_surface_evaluate(given, u, v, &p), BATTEN_OK);
		assert_int_equal(batten_surface_evaluate(turned, u, v, &a), BATTEN_OK);
		assert_int_equal(batten_surface_evaluate(at_once, u, v, &b), BATTEN_OK);
		assert_int_equal(batten_surface_evaluate(flat, u, v, &f), BATTEN_OK);
		double height = -far, off = 0;
		for (int c = 0; c < 3; c++) {
			near(a.derivative[0][0][c], b.derivative[0][0][c], 1e-12);
			height += n[c] * f.derivative[0][0][c];
			off += n[c] * (p.derivative[0][0][c] - f.derivative[0][0][c]);
		}
		near(height, 0, 1e-13);
		for (int c = 0; c < 3; c++)
			near(p.derivative[0][0][c] - f.derivative[0][0][c], off * n[c], 1e-12);
	}
	batten_surface *all[] = { given, turned, at_once, flat };
	for (int c = 0; c < 4; c++)
		batten_surface_destroy(all[c]);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sections_of_wigley),
		cmocka_unit_test(wigley_line_of_no_gauss_curvature),
		cmocka_unit_test(closed_lines_come_back),
		cmocka_unit_test(branches_stay_apart),
		cmocka_unit_test(refusals),
		cmocka_unit_test(memory_runs_out),
		cmocka_unit_test(rotations),
		cmocka_unit_test(maps_of_a_surface),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
