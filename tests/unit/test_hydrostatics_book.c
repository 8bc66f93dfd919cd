/* What the book says of any floating body (Letcher 9.1, 10.2, 11), and of offsets in number. */
#include "unit/hydrostatics_fixture.h"

/* Wigley's hull 100 x 10 x 6.25 with its middle column of poles moved aft: no symmetry fore and aft. */
static batten_surface *lopsided(batten_context *context)
{
	static const double x[3] = { 0, 35, 100 }, a[3] = { 0, 2, 0 }, c[3] = { 0, 1, 1 };
	double poles[27];
	for (size_t i = 0; i < 9; i++) {
		poles[3 * i] = x[i % 3];
		poles[3 * i + 1] = 5 * a[i % 3] * c[i / 3];
		const size_t row = i / 3;
		poles[3 * i + 2] = 3.125 * (double)row;
	}
	return make_surface(context,
	                    &(batten_surface_net){ "lopsided", 3, 3, 3, 3, NULL, NULL, poles, NULL });
}

/* Centre of buoyancy by sections along x and by waterplanes along z (equations 118 to 121): the
 * waterplanes are integrated over the drafts by Gauss's rule. */
static void two_ways(void **state)
{
	(void)state;
	static const double at[5] = { -0.90617984593866399280, -0.53846931010568309104, 0,
		                          0.53846931010568309104, 0.90617984593866399280 };
	static const double weight[5] = { 0.23692688505618908751, 0.47862867049936646804,
		                              0.56888888888888888889, 0.47862867049936646804,
		                              0.23692688505618908751 };
	batten_context *context = make_context();
	batten_surface *surface = lopsided(context);
	const double draft = 5;
	const batten_hydrostatics h = surface_at(context, surface, NULL, draft);
	double volume = 0, moment_x = 0, moment_z = 0;
	for (size_t i = 0; i < 5; i++) {
		const double z = 0.5 * draft * (1 + at[i]), dz = 0.5 * draft * weight[i];
		const batten_hydrostatics level = surface_at(context, surface, NULL, z);
		volume += dz * level.waterplane_area_m2;
		moment_x += dz * level.waterplane_area_m2 * level.xcf_from_ap_m;
		moment_z += dz * level.waterplane_area_m2 * z;
	}
	assert_relative(h.volume_m3, volume, 1e-12);
	assert_relative(h.xcb_from_ap_m, moment_x / volume, 1e-12);
	assert_relative(h.kb_m, moment_z / volume, 1e-12);
	assert_true(h.xcb_from_ap_m < 48); /* lopsided indeed */
	assert_relative(h.cb, h.cp * h.cm, 1e-12);
	/* and by the sections along x */
	enum { SECTIONS = 201 };
	double x[SECTIONS], areas[SECTIONS], sum = 0, sum_x = 0;
	for (size_t i = 0; i < SECTIONS; i++)
		x[i] = 0.5 * (double)i;
	assert_int_equal(
		batten_surface_section_areas(context, surface, NULL, SECTIONS, x, 1, &draft, areas),
		BATTEN_OK);
	for (size_t i = 1; i + 1 < SECTIONS; i += 2) { /* Simpson */
		sum += (areas[i - 1] + 4 * areas[i] + areas[i + 1]) / 6;
		sum_x += (x[i - 1] * areas[i - 1] + 4 * x[i] * areas[i] + x[i + 1] * areas[i + 1]) / 6;
	}
	assert_relative(h.volume_m3, sum, 1e-7);
	assert_relative(h.xcb_from_ap_m, sum_x / sum, 1e-7);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* The area of a patch is secant of the obliquity times girth along the ship (equations 130, 131, as
 * corrected: g = 1 / (1 - n_x^2)): a curve of v is a section here. */
static void area_by_obliquity(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surfaces[2] = { lopsided(context), cylinder_surface(context, 50, 10) };
	for (size_t k = 0; k < 2; k++) {
		for (size_t i = 0; i < 100; i++) {
			const double u = 0.05 + 0.1 * (double)(i % 10), v = 0.005 + 0.01 * (double)i;
			batten_surface_point point;
			assert_int_equal(batten_surface_evaluate(surfaces[k], u, v, &point), BATTEN_OK);
			const double *a = point.derivative[1][0], *b = point.derivative[0][1];
			const double n[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
				                  a[0] * b[1] - a[1] * b[0] };
			const double area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
			const double obliquity = n[0] / area;
			assert_near(b[0], 0, 1e-12);
			assert_relative(
				area, a[0] * sqrt(b[1] * b[1] + b[2] * b[2]) / sqrt(1 - obliquity * obliquity),
				1e-12);
		}
		batten_surface_destroy(surfaces[k]);
	}
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Archimedes (equations 48 to 51)
 * --------------------------------------------------------------------------------------------- */

enum { ALONG = 12, UP = 6, CORNERS = (ALONG + 1) * (UP + 1), FACES = 2 * ALONG * UP };

/* Half a hull that is fuller aft, up to its draft of 6.25 m. */
static void full_aft(double along, double up, double at[3])
{
	at[0] = 100 * along;
	at[1] = 20 * along * (1 - along) * (1.4 - along) * (1 - (1 - up) * (1 - up));
	at[2] = 6.25 * up;
}

/* Force and moment of the pressure T - z on a triangle and its image, exact to the second power: the
 * middles of the sides. n points into the body. */
static void press(const double *p, const double *q, const double *r, double sign, double force[3],
                  double moment[3])
{
	double corner[3][3], n[3];
	for (size_t c = 0; c < 3; c++) {
		const double mirror = c == 1 ? sign : 1;
		corner[0][c] = mirror * p[c];
		corner[1][c] = mirror * (sign > 0 ? q[c] : r[c]);
		corner[2][c] = mirror * (sign > 0 ? r[c] : q[c]);
	}
	for (size_t c = 0; c < 3; c++) {
		const size_t d = (c + 1) % 3, e = (c + 2) % 3;
		n[c] = -0.5 * ((corner[1][d] - corner[0][d]) * (corner[2][e] - corner[0][e]) -
		               (corner[1][e] - corner[0][e]) * (corner[2][d] - corner[0][d]));
	}
	for (size_t k = 0; k < 3; k++) {
		double at[3];
		for (size_t c = 0; c < 3; c++)
			at[c] = 0.5 * (corner[k][c] + corner[(k + 1) % 3][c]);
		const double pressure = (6.25 - at[2]) / 3;
		for (size_t c = 0; c < 3; c++) {
			const size_t d = (c + 1) % 3, e = (c + 2) % 3;
			force[c] += pressure * n[c];
			moment[c] += pressure * (at[d] * n[e] - at[e] * n[d]);
		}
	}
}

static void pressure_carries(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_mesh *mesh = make_mesh(context, full_aft, ALONG, UP, true);
	const double draft = 6.25;
	batten_hydrostatics h;
	batten_hydrostatics_options options = with_lbp(100);
	assert_int_equal(batten_mesh_hydrostatics(context, mesh, &options, 1, &draft, &h), BATTEN_OK);
	double force[3] = { 0 }, moment[3] = { 0 };
	for (size_t j = 0; j < UP; j++)
		for (size_t i = 0; i < ALONG; i++) {
			double a[3], b[3], c[3], d[3];
			full_aft((double)i / ALONG, (double)j / UP, a);
			full_aft((double)(i + 1) / ALONG, (double)j / UP, b);
			full_aft((double)(i + 1) / ALONG, (double)(j + 1) / UP, c);
			full_aft((double)i / ALONG, (double)(j + 1) / UP, d);
			const bool other = (i + j) % 2; /* as make_mesh() lays them */
			for (int side = 1; side >= -1; side -= 2) {
				press(a, other ? d : c, b, side, force, moment);
				press(other ? b : a, d, c, side, force, moment);
			}
		}
	assert_relative(force[2], h.volume_m3, 1e-12);
	assert_near(force[0], 0, 1e-10);
	assert_near(force[1], 0, 1e-10);
	assert_relative(-moment[1] / force[2], h.xcb_from_ap_m, 1e-12);
	assert_near(moment[0], 0, 1e-9);
	assert_near(moment[2], 0, 1e-9);
	batten_mesh_destroy(mesh);
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Offsets in number
 * --------------------------------------------------------------------------------------------- */

static double wigley(double x, double z)
{
	const double s = x / 100, t = 1 - z / 6.25;
	return 20 * s * (1 - s) * (1 - t * t);
}

/* "A few hundred to a thousand offset points": trapezoids miss the volume by (1 - 1/N^2) times
 * (1 - 1/(4 M^2)) - 1, below one percent from 231 points on. */
static void offsets_in_number(void **state)
{
	(void)state;
	static const size_t intervals[3][2] = { { 20, 10 }, { 30, 20 }, { 40, 20 } };
	static const double printed[3] = { -0.499, -0.174, -0.125 };
	batten_context *context = make_context();
	for (size_t k = 0; k < 3; k++) {
		const double n = (double)intervals[k][0], m = (double)intervals[k][1];
		batten_hull *hull = make_hull(context, wigley, 100, 6.25, intervals[k][0] + 1,
		                              intervals[k][1] + 1);
		const batten_measures by = measure_at(context, hull, BATTEN_QUADRATURE_TRAPEZOID, 6.25);
		const double error = by.volume_m3 / (25000.0 / 9) - 1;
		assert_near(error, (1 - 1 / (n * n)) * (1 - 0.25 / (m * m)) - 1, 1e-12);
		assert_near(100 * error, printed[k], 5.1e-4);
		const batten_measures best = measure_at(context, hull, BATTEN_QUADRATURE_SIMPSON, 6.25);
		assert_relative(best.volume_m3, 25000.0 / 9, 1e-12);
		batten_hull_destroy(hull);
	}
	batten_context_destroy(context);
}

static batten_polygon_integrals polygon(batten_context *context, size_t loops, const size_t *counts,
                                        const double *points)
{
	batten_polygon_integrals found;
	if (batten_polygon_integrate(context, loops, counts, points, &found) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return found;
}

static void assert_rectangle(const batten_polygon_integrals *found, double sign, double a, double b,
                             double w, double h)
{
	const double area = sign * w * h, x = a + w / 2, y = b + h / 2;
	assert_relative(found->area_m2, area, 1e-15);
	assert_relative(found->moment_x_m3, area * x, 4e-15);
	assert_relative(found->moment_y_m3, area * y, 4e-15);
	assert_relative(found->i_xx_m4, area * (h * h / 12 + y * y), 4e-15);
	assert_relative(found->i_yy_m4, area * (w * w / 12 + x * x), 4e-15);
	assert_relative(found->i_xy_m4, area * x * y, 4e-15);
}

/* A rectangle off the axes, the other way round, with a hole (Letcher 9.4). */
static void polygons(void **state)
{
	(void)state;
	batten_context *context = make_context();
	const double a = 1.5, b = 0.75, w = 4, h = 2.5;
	const double points[16] = { a,     b,       a + w, b,       a + w, b + h,   a,     b + h,
		                        a + 1, b + 0.5, a + 1, b + 1.5, a + 3, b + 1.5, a + 3, b + 0.5 };
	const double turned[8] = { a, b + h, a + w, b + h, a + w, b, a, b };
	const size_t counts[2] = { 4, 4 }, few = 2;
	batten_polygon_integrals found = polygon(context, 1, counts, points);
	assert_rectangle(&found, 1, a, b, w, h);
	found = polygon(context, 1, counts, turned);
	assert_rectangle(&found, -1, a, b, w, h);
	const batten_polygon_integrals hole = polygon(context, 1, counts, points + 8);
	assert_rectangle(&hole, -1, a + 1, b + 0.5, 2, 1);
	const batten_polygon_integrals whole = polygon(context, 1, counts, points);
	found = polygon(context, 2, counts, points);
	const double *part = (const double *)&found, *one = (const double *)&whole;
	const double *less = (const double *)&hole;
	for (size_t k = 0; k < sizeof found / sizeof *part; k++)
		assert_relative(part[k], one[k] + less[k], 1e-14);
	assert_int_equal(batten_polygon_integrate(context, 1, &few, points, &found), BATTEN_USAGE);
	const double bad[6] = { 0, 0, 1, 0, NAN, 1 };
	const size_t three = 3;
	assert_int_equal(batten_polygon_integrate(context, 1, &three, bad, &found), BATTEN_USAGE);
	assert_string_equal(batten_context_error(context),
	                    "loop 0: x of point 2 is nan, expected a number within 1e+06 m");
	batten_context_destroy(context);
}

/* A curve of ordinates 1 that steps to 2 at midlength: trapezoids with both ordinates there are exact,
 * the rule with the upper one alone is 1 / (3 N) off (9.2.1). */
static void double_abscissa(void **state)
{
	(void)state;
	enum { N = 10 };
	batten_context *context = make_context();
	double points[2 * (N + 4)] = { 0 }, single = 0;
	size_t count = 0;
	for (int i = N; i >= 0; i--)
		for (int side = 2 * i == N ? 0 : 1; side < 2; side++, count++) {
			points[2 * count] = (double)i / N;
			points[2 * count + 1] = 2 * i > N || (2 * i == N && side == 0) ? 2 : 1;
		}
	points[2 * count++] = 0;
	points[2 * count++] = 1;
	const batten_polygon_integrals found = polygon(context, 1, &count, points);
	assert_relative(found.area_m2, 1.5, 1e-15);
	assert_relative(found.moment_x_m3, 0.125 + 0.75, 1e-15);
	for (int i = 0; i < N; i++)
		single += ((2 * i >= N ? 2.0 : 1.0) + (2 * i + 2 >= N ? 2.0 : 1.0)) / (2 * N);
	assert_relative(single / found.area_m2, 1 + 1.0 / (3 * N), 1e-14);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(polygons),         cmocka_unit_test(double_abscissa),
		cmocka_unit_test(two_ways),         cmocka_unit_test(area_by_obliquity),
		cmocka_unit_test(pressure_carries), cmocka_unit_test(offsets_in_number),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
