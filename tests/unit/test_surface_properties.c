/* Properties of B-spline surfaces that hold whatever the net (Letcher 3.7, 4.3, 4.8-4.11), and of
 * Wigley's hull (4.1, 9). */
#include "surface_fixture.h"

#include "geometry/bspline.h"

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/surface_point.h"

static surface_triple triple_of(const double *d)
{
	return (surface_triple){ d[0], d[1], d[2] };
}

static surface_jet jet_at(const batten_surface *surface, double u, double v)
{
	batten_surface_point p;
	assert_int_equal(batten_surface_evaluate(surface, u, v, &p), BATTEN_OK);
	return (surface_jet){ triple_of(p.derivative[0][0]), triple_of(p.derivative[1][0]),
		                  triple_of(p.derivative[0][1]), triple_of(p.derivative[2][0]),
		                  triple_of(p.derivative[1][1]), triple_of(p.derivative[0][2]) };
}

static surface_shape shape_at(const batten_surface *surface, double u, double v)
{
	return surface_shape_of(jet_at(surface, u, v), 0);
}

static batten_surface *open_surface(batten_context *context, const batten_surface_net *net)
{
	batten_surface *surface = NULL;
	if (batten_surface_create(context, net, &surface) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return surface;
}

static void near(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.17g, expected %.17g within %g", found, expected, tolerance);
}

/* Curvature in the direction a x_u + b x_v, by the quotient of the forms. */
static double normal_curvature(surface_shape s, double a, double b)
{
	return (s.second_uu * a * a + 2 * s.second_uv * a * b + s.second_vv * b * b) /
	       (s.first_uu * a * a + 2 * s.first_uv * a * b + s.first_vv * b * b);
}

/* ------------------------------------------------------------------------------------------------
 * Curves
 * --------------------------------------------------------------------------------------------- */

/* As many consecutive poles in a plane as the order: their span lies in it, the next does not. */
static void coplanar_poles_make_a_planar_span(void **state)
{
	(void)state;
	uint64_t seed = 21;
	batten_context *context = open_context();
	for (size_t order = 3; order <= 8; order++) {
		const size_t count = order + 4;
		double knots[24], poles[3 * 16];
		bspline_knots_clamped(order, count, knots);
		for (size_t i = 0; i < count; i++) {
			poles[3 * i] = (double)i + draw_real(&seed, -0.4, 0.4);
			poles[3 * i + 1] = draw_real(&seed, -1, 1);
			poles[3 * i + 2] = i >= 2 && i < 2 + order
			                       ? 0.5 * poles[3 * i] - 0.25 * poles[3 * i + 1] + 1
			                       : draw_real(&seed, 3, 9);
		}
		struct bspline_curve curve;
		const struct bspline_curve_net net = { order, count, 3, knots, poles, NULL };
		assert_int_equal(bspline_curve_create(context, &net, &curve), BATTEN_OK);
		const double first = knots[order + 1], last = knots[order + 2];
		for (int k = 0; k <= 8; k++) {
			double p[3], beyond[3];
			bspline_curve_evaluate(&curve, first + (last - first) * k / 8, 0, p);
			near(p[2], 0.5 * p[0] - 0.25 * p[1] + 1, 1e-13);
			bspline_curve_evaluate(&curve, last + (last - first) * (k + 1) / 9, 0, beyond);
			assert_true(fabs(beyond[2] - 0.5 * beyond[0] + 0.25 * beyond[1] - 1) > 1e-12);
		}
		bspline_curve_destroy(&curve);
	}
	batten_context_destroy(context);
}

/* The speed is least where the poles crowd. */
static void crowded_poles_are_passed_slowly(void **state)
{
	(void)state;
	static const double poles[] = { 0, 1, 2, 2.9, 3, 3.1, 4, 5, 6 };
	batten_context *context = open_context();
	double knots[13], least = INFINITY, where = 0;
	bspline_knots_clamped(4, 9, knots);
	struct bspline_curve curve;
	const struct bspline_curve_net net = { 4, 9, 1, knots, poles, NULL };
	assert_int_equal(bspline_curve_create(context, &net, &curve), BATTEN_OK);
	for (int k = 0; k <= 200; k++) {
		double p[2];
		bspline_curve_evaluate(&curve, k / 200.0, 1, p);
		if (p[1] < least) {
			least = p[1];
			where = p[0];
		}
	}
	near(where, 3, 0.05);
	double ends[2];
	bspline_curve_evaluate(&curve, 0, 1, ends);
	assert_true(least < 0.2 * ends[1]);
	bspline_curve_destroy(&curve);
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Surfaces
 * --------------------------------------------------------------------------------------------- */

/* Rows of the net as master curves (4.8): the first and the last lie on the surface, those between do
 * not but at order 2; it begins along the ruled strip of the first two. */
static void lofts_over_master_curves(void **state)
{
	(void)state;
	uint64_t seed = 22;
	batten_context *context = open_context();
	drawn d;
	for (size_t order = 2; order <= 6; order++) {
		draw_net(&seed, 4, order, false, &d);
		double knots[24];
		const size_t rows = d.net.count_v = order + 3;
		bspline_knots_clamped(order, rows, knots);
		memcpy(d.knots_v, knots, sizeof knots);
		draw_poles(&seed, &d);
		batten_surface *surface = open_surface(context, &d.net);
		for (size_t row = 0; row < rows; row++) {
			struct bspline_curve master;
			const struct bspline_curve_net net = {
				4, d.net.count_u, 3, d.knots_u, d.poles + 3 * row * d.net.count_u, NULL
			};
			assert_int_equal(bspline_curve_create(context, &net, &master), BATTEN_OK);
			const double u = draw_real(&seed, d.knots_u[3], d.knots_u[d.net.count_u]);
			double on[3], nearest = INFINITY;
			bspline_curve_evaluate(&master, u, 0, on);
			for (size_t k = 0; k <= 400 * (rows - 1); k++) {
				const surface_jet j = jet_at(surface, u, (double)k / (400.0 * (double)(rows - 1)));
				nearest = fmin(nearest,
				               hypot(hypot(j.at.x - on[0], j.at.y - on[1]), j.at.z - on[2]));
			}
			const bool met = order == 2 || row == 0 || row + 1 == rows;
			assert_true(met ? nearest < 1e-12 : nearest > 1e-6);
			if (row == 1) {
				const surface_jet j = jet_at(surface, u, 0);
				const surface_triple strip = { on[0] - j.at.x, on[1] - j.at.y, on[2] - j.at.z };
				const surface_triple across = triple_outer(strip, j.v);
				near(triple_inner(across, across), 0,
				     1e-24 * triple_inner(strip, strip) * triple_inner(j.v, j.v));
				assert_true(triple_inner(strip, j.v) > 0);
			}
			bspline_curve_destroy(&master);
		}
		batten_surface_destroy(surface);
	}
	batten_context_destroy(context);
}

/* Straight lines between any two curves: K <= 0 everywhere. */
static void ruled_surfaces_are_nowhere_elliptic(void **state)
{
	(void)state;
	uint64_t seed = 23;
	batten_context *context = open_context();
	drawn d;
	size_t negative = 0;
	for (size_t round = 0; round < 60; round++) {
		draw_net(&seed, 3 + round % 6, 2, false, &d);
		static const double ends[] = { 0, 0, 1, 1 };
		memcpy(d.knots_v, ends, sizeof ends);
		d.net.count_v = 2;
		batten_surface *surface = open_surface(context, &d.net);
		for (size_t k = 0; k < 20; k++) {
			const double u = draw_real(&seed, d.knots_u[d.net.order_u - 1],
			                           d.knots_u[d.net.count_u]);
			const surface_shape s = shape_at(surface, u, draw_real(&seed, 0, 1));
			assert_true(s.regular);
			assert_true(s.gauss <= 1e-12 * s.bending);
			negative += s.gauss < -1e-6 * s.bending;
		}
		batten_surface_destroy(surface);
	}
	assert_true(negative > 800);
	batten_context_destroy(context);
}

/* Cylinder and cone: K = 0 and one normal along each ruling; so has any affine image of them. */
static void developable_surfaces_stay_so(void **state)
{
	(void)state;
	uint64_t seed = 24;
	batten_context *context = open_context();
	drawn d;
	for (size_t round = 0; round < 40; round++) {
		static const double ends[] = { 0, 0, 1, 1 };
		const bool cone = round % 2;
		draw_net(&seed, 3 + round % 6, 2, false, &d);
		memcpy(d.knots_v, ends, sizeof ends);
		d.net.count_v = 2;
		for (size_t i = 0; i < d.net.count_u; i++)
			for (size_t c = 0; c < 3; c++) {
				static const double apex[] = { 3, -7, 20 }, along[] = { 0.3, 0.2, 1 };
				const double from = d.poles[3 * i + c];
				d.poles[3 * (d.net.count_u + i) + c] = cone ? from + (apex[c] - from) / 3
				                                            : from + along[c];
			}
		batten_surface *surface = open_surface(context, &d.net);
		for (int image = 0; image < 2; image++) {
			for (size_t k = 0; k < 20; k++) {
				const double u = draw_real(&seed, d.knots_u[d.net.order_u - 1],
				                           d.knots_u[d.net.count_u]);
				const surface_shape low = shape_at(surface, u, 0);
				const surface_shape high = shape_at(surface, u, draw_real(&seed, 0.1, 1));
				assert_true(low.regular && high.regular);
				near(high.gauss, 0, 1e-12 * (1 + high.bending));
				near(triple_inner(low.normal, high.normal), 1, 1e-13);
			}
			static const double map[9] = { 1, 0.4, -0.2, 0.1, 2, 0.3, 0, 0.5, 0.7 };
			static const double shift[3] = { 1, 2, 3 };
			assert_int_equal(batten_surface_map(surface, map, shift), BATTEN_OK);
		}
		batten_surface_destroy(surface);
	}
	batten_context_destroy(context);
}

/* Euler: sinusoidal in twice the angle, extremes at right angles; 2 H is the sum of any two curvatures
 * at right angles, H^2 >= K. A turned normal changes the sign of H, an affine map that of nothing:
 * K keeps it. */
static void curvatures_of_drawn_surfaces(void **state)
{
	(void)state;
	uint64_t seed = 25;
	batten_context *context = open_context();
	drawn d;
	static const double map[9] = { 1.5, 0.4, 0, -0.2, 0.8, 0.1, 0.3, 0, 1 }, shift[3] = { 0 };
	for (size_t round = 0; round < 60; round++) {
		draw_net(&seed, 3 + round % 6, 3 + round / 6 % 6, round % 2, &d);
		const double u = draw_real(&seed, d.knots_u[d.net.order_u - 1], d.knots_u[d.net.count_u]);
		const double v = draw_real(&seed, d.knots_v[d.net.order_v - 1], d.knots_v[d.net.count_v]);
		batten_surface *surface = open_surface(context, &d.net);
		const surface_shape s = shape_at(surface, u, v);
		const double size = 1e-12 * (1 + sqrt(s.bending)), spread = surface_spread_of(s);
		assert_true(s.regular && s.mean * s.mean >= s.gauss - size * size);
		near((s.mean + spread) * (s.mean - spread), s.gauss, 1e-12 * (1 + s.bending));
		near(s.area * s.area, s.first_uu * s.first_vv - s.first_uv * s.first_uv,
		     1e-12 * s.first_uu * s.first_vv);
		/* angle k from x_u: unit vectors by Gram and Schmidt */
		const double r = 1 / sqrt(s.first_uu), q = sqrt(s.first_uu) / s.area;
		const double along = normal_curvature(s, r, 0);
		const double across = normal_curvature(s, -q * s.first_uv / s.first_uu, q);
		const double diagonal = normal_curvature(s, r - q * s.first_uv / s.first_uu, q);
		near(along + across, 2 * s.mean, size);
		near(hypot((along - across) / 2, diagonal - s.mean), spread, size * 1e3);
		for (int k = 0; k < 12; k++) {
			const double c = cos(0.55 * k), e = sin(0.55 * k);
			const double found = normal_curvature(s, c * r - e * q * s.first_uv / s.first_uu,
			                                      e * q);
			near(found,
			     s.mean + (along - across) / 2 * (c * c - e * e) + (diagonal - s.mean) * 2 * c * e,
			     size);
		}
		batten_surface_reverse(surface, BATTEN_DIRECTION_U);
		const double back = d.knots_u[d.net.order_u - 1] + d.knots_u[d.net.count_u] - u;
		const surface_shape turned = shape_at(surface, back, v);
		near(turned.mean, -s.mean, 1e-9 * (1 + fabs(s.mean)));
		near(turned.gauss, s.gauss, 1e-9 * (1 + s.bending));
		assert_int_equal(batten_surface_map(surface, map, shift), BATTEN_OK);
		const surface_shape image = shape_at(surface, back, v);
		if (fabs(s.gauss) > 1e-6 * s.bending)
			assert_true((image.gauss > 0) == (s.gauss > 0));
		batten_surface_destroy(surface);
	}
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Wigley's hull, L 100, B 10, T 6.25, z over the keel
 * --------------------------------------------------------------------------------------------- */

static const double quadratic[] = { 0, 0, 0, 1, 1, 1 };
/* clang-format off */
static const double wigley_poles[27] = {
	0, 0, 0,      50, 0, 0,       100, 0, 0,
	0, 0, 3.125,  50, 10, 3.125,  100, 0, 3.125,
	0, 0, 6.25,   50, 10, 6.25,   100, 0, 6.25,
};
/* clang-format on */
static const batten_surface_net wigley = { NULL,         3,   3, 3, 3, quadratic, quadratic,
	                                       wigley_poles, NULL };

/* A waterline at depth q: k = (4 B c / L^2) / (1 + (2 B c s / L)^2)^(3/2), c = 1 - q^2, s = 1 - 2x / L,
 * of one sign all along. */
static void wigley_waterlines(void **state)
{
	(void)state;
	batten_context *context = open_context();
	batten_surface *surface = open_surface(context, &wigley);
	for (int j = 1; j <= 4; j++)
		for (int i = 0; i <= 20; i++) {
			const double u = i / 20.0, q = 1 - j / 4.0, c = 1 - q * q, s = 1 - 2 * u;
			const surface_jet jet = jet_at(surface, u, j / 4.0);
			const double speed2 = jet.u.x * jet.u.x + jet.u.y * jet.u.y;
			const double found = (jet.u.x * jet.uu.y - jet.u.y * jet.uu.x) /
			                     (speed2 * sqrt(speed2));
			const double slope = 2 * 10 * c * s / 100;
			near(-found, 4 * 10 * c / 1e4 / pow(1 + slope * slope, 1.5), 1e-14);
		}
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* Straight up above the waterline: the tangent goes on, the vertical curvature jumps by B / D^2, there
 * and at no other height. */
static void wigley_wall_side(void **state)
{
	(void)state;
	static const double knots_v[] = { 0, 0, 0, 1, 1, 2, 2, 2 };
	double poles[45];
	memcpy(poles, wigley_poles, sizeof wigley_poles);
	for (size_t i = 0; i < 6; i++) {
		memcpy(poles + 27 + 3 * i, wigley_poles + 18 + 3 * (i % 3), 3 * sizeof *poles);
		poles[27 + 3 * i + 2] = i < 3 ? 9.375 : 12.5;
	}
	batten_surface_net net = wigley;
	net.count_v = 5;
	net.knots_v = knots_v;
	net.poles_m = poles;
	batten_context *context = open_context();
	batten_surface *surface = open_surface(context, &net);
	for (int k = 1; k < 40; k++) {
		const double v = 0.05 * k;
		const surface_shape below = shape_at(surface, 0.5, v - 1e-9),
							here = shape_at(surface, 0.5, v);
		const double jump = normal_curvature(here, 0, 1) - normal_curvature(below, 0, 1);
		near(triple_inner(below.normal, here.normal), 1, 1e-12);
		near(jump, k == 20 ? 0.256 : 0, 1e-6);
	}
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* The divergence theorem: the volume by x, by y and by z, at two Gauss points a direction, exact for
 * this net; z from the waterline. */
static void wigley_volume_three_ways(void **state)
{
	(void)state;
	batten_context *context = open_context();
	batten_surface *surface = open_surface(context, &wigley);
	const double node[2] = { 0.5 - sqrt(1.0 / 12), 0.5 + sqrt(1.0 / 12) };
	double by_x = 0, by_y = 0, by_z = 0, none = 0;
	for (size_t i = 0; i < 4; i++) {
		const surface_jet j = jet_at(surface, node[i % 2], node[i / 2]);
		const surface_triple n = triple_outer(j.v, j.u);
		by_x += 0.25 * 2 * j.at.x * n.x;
		by_y += 0.25 * 2 * j.at.y * n.y;
		by_z += 0.25 * 2 * (j.at.z - 6.25) * n.z;
		none += 0.25 * (j.at.z - 6.25) * n.x;
	}
	const double volume = 4.0 / 9 * 100 * 10 * 6.25;
	near(by_x, volume, 1e-12 * volume);
	near(by_y, volume, 1e-12 * volume);
	near(by_z, volume, 1e-12 * volume);
	near(none, 0, 1e-12 * volume);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(coplanar_poles_make_a_planar_span),
		cmocka_unit_test(crowded_poles_are_passed_slowly),
		cmocka_unit_test(lofts_over_master_curves),
		cmocka_unit_test(ruled_surfaces_are_nowhere_elliptic),
		cmocka_unit_test(developable_surfaces_stay_so),
		cmocka_unit_test(curvatures_of_drawn_surfaces),
		cmocka_unit_test(wigley_waterlines),
		cmocka_unit_test(wigley_wall_side),
		cmocka_unit_test(wigley_volume_three_ways),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
