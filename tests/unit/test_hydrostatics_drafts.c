/* Hydrostatics over drafts from offsets; offsets, surfaces and meshes against each other; lack
 * of memory. */
#include "support/failing_heap.h"
#include "unit/hydrostatics_fixture.h"

static double wigley(double x, double z)
{
	double s = x / 100, t = 1 - z / 6.25;
	return 5 * 4 * s * (1 - s) * (1 - t * t);
}

static void wigley_place(double along, double up, double at[3])
{
	at[0] = 100 * along;
	at[2] = 6.25 * up;
	at[1] = wigley(at[0], at[2]);
}

/* ------------------------------------------------------------------------------------------------
 * Offsets
 * --------------------------------------------------------------------------------------------- */

/* Many drafts at once are what one at a time gives, bit for bit, in any order. */
static void many_drafts(void **state)
{
	(void)state;
	static const double drafts[] = { 6.25, 0.3, 3.125, 4.9 };
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 21, 11);
	batten_hydrostatics together[4], alone;
	batten_hydrostatics_options options = with_lbp(0);
	options.kg_m = 4;
	assert_int_equal(batten_hull_hydrostatics(context, hull, &options, 4, drafts, together),
	                 BATTEN_OK);
	for (size_t k = 0; k < 4; k++) {
		assert_int_equal(batten_hull_hydrostatics(context, hull, &options, 1, &drafts[k], &alone),
		                 BATTEN_OK);
		assert_memory_equal(&alone, &together[k], offsetof(batten_hydrostatics, mt1cm_t_m_per_cm));
		batten_measures m = measure_at(context, hull, BATTEN_QUADRATURE_SPLINE, drafts[k]);
		assert_memory_equal(&m, &alone, offsetof(batten_measures, fn_per_m2));
		assert_true(alone.gmt_m == alone.kmt_m - 4 && alone.gml_m == alone.kml_m - 4);
		assert_relative(alone.mt1cm_t_m_per_cm, alone.displacement_t * alone.gml_m / 1e4, 1e-15);
		assert_true(isnan(alone.volume_mismatch_pct) && alone.transom_area_m2 == 0);
	}
	assert_int_equal(batten_hull_hydrostatics(context, hull, NULL, 1, drafts, &alone), BATTEN_OK);
	assert_true(isnan(alone.gmt_m) && isnan(alone.gml_m) && isnan(alone.mt1cm_t_m_per_cm));
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static void drafts_by_displacement(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 21, 11);
	batten_hydrostatics_options options = with_lbp(0);
	for (int rule = 0; rule < 3; rule += 2) {
		options.quadrature = (batten_quadrature)rule;
		for (int tenth = 0; tenth <= 10; tenth++) {
			const double draft = 0.1 + 0.615 * tenth;
			batten_hydrostatics h;
			double found = 0;
			assert_int_equal(batten_hull_hydrostatics(context, hull, &options, 1, &draft, &h),
			                 BATTEN_OK);
			assert_int_equal(
				batten_hull_draft_at(context, hull, &options, h.displacement_t, &found), BATTEN_OK);
			assert_relative(found, draft, 1e-11);
		}
	}
	options = with_lbp(0);
	static const double wrong[] = { 0, -5, 2900, NAN, INFINITY };
	double draft = -1;
	for (size_t k = 0; k < 5; k++)
		assert_int_equal(batten_hull_draft_at(context, hull, &options, wrong[k], &draft),
		                 BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(context), "at a draft of 6.25 m"));
	assert_true(draft == -1);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

/* Sections of the Wigley hull are parabolas, which not-a-knot splines hold. */
static void sections_of_offsets(void **state)
{
	(void)state;
	enum { STATIONS = 21 };
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, STATIONS, 11);
	const double heights[] = { 1, 3.3, 6.25 };
	double areas[3 * STATIONS], x[STATIONS + 2], curve[STATIONS + 2];
	size_t count = 0;
	assert_int_equal(batten_hull_section_areas(context, hull, NULL, 3, heights, areas), BATTEN_OK);
	for (size_t i = 0; i < 3 * STATIONS; i++) {
		double s = (double)(i % STATIONS) / (STATIONS - 1), e = heights[i / STATIONS] / 6.25;
		assert_near(areas[i], 4 * s * (1 - s) * 62.5 * (e * e - e * e * e / 3), 1e-12);
	}
	assert_int_equal(batten_hull_area_curve(context, hull, NULL, 3.3, x, curve, &count), BATTEN_OK);
	assert_int_equal(count, STATIONS);
	assert_memory_equal(curve, areas + STATIONS, sizeof(double) * STATIONS);
	const double wrong[] = { 1, 7 };
	areas[0] = -1;
	assert_int_equal(batten_hull_section_areas(context, hull, NULL, 2, wrong, areas), BATTEN_USAGE);
	assert_int_equal(batten_hull_area_curve(context, hull, NULL, NAN, x, curve, &count),
	                 BATTEN_USAGE);
	assert_true(areas[0] == -1);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static double nothing(double x, double z)
{
	(void)x;
	(void)z;
	return 0;
}

static void wrong_calls(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 21, 10);
	batten_hydrostatics h = { .lbp_m = -1 }, two[2] = { { .lbp_m = -1 } };
	static const double drafts[] = { 0, -2, 6.2501, NAN, INFINITY };
	for (size_t k = 0; k < 5; k++) {
		const double both[] = { 3, drafts[k] };
		assert_int_equal(batten_hull_hydrostatics(context, hull, NULL, 1, &drafts[k], &h),
		                 BATTEN_USAGE);
		assert_int_equal(batten_hull_hydrostatics(context, hull, NULL, 2, both, two), BATTEN_USAGE);
	}
	assert_true(h.lbp_m == -1 && two[0].lbp_m == -1);
	batten_hydrostatics_options options = with_lbp(0);
	options.quadrature = BATTEN_QUADRATURE_SIMPSON; /* nine intervals */
	const double draft = 6.25;
	assert_int_equal(batten_hull_hydrostatics(context, hull, &options, 1, &draft, &h),
	                 BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(context), "even number"));
	options = with_lbp(0);
	options.density_t_per_m3 = NAN;
	assert_int_equal(batten_hull_hydrostatics(context, hull, &options, 1, &draft, &h),
	                 BATTEN_USAGE);
	batten_hull_destroy(hull);
	/* no volume, no waterplane: undefined, never a division */
	hull = make_hull(context, nothing, 100, 6.25, 5, 5);
	assert_int_equal(batten_hull_hydrostatics(context, hull, NULL, 1, &draft, &h), BATTEN_OK);
	assert_true(h.volume_m3 == 0 && isnan(h.kb_m) && isnan(h.xcf_from_ap_m) && isnan(h.kmt_m));
	assert_int_equal(batten_hydrostatics_warnings(&h, NULL, 0), 0);
	batten_hull_destroy(hull);
	assert_null(batten_hydrostatics_name(BATTEN_HYDROSTATICS_COUNT));
	assert_null(batten_hydrostatics_text(BATTEN_HYDROSTATICS_COUNT));
	assert_string_equal(batten_hydrostatics_name(6), batten_measure_name(6));
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Three ways, one hull
 * --------------------------------------------------------------------------------------------- */

/* Relative distances of a hull's volume, waterplane, KB and surface from the surface's. */
static void distances(const batten_hydrostatics *h, const batten_hydrostatics *exact, double out[4])
{
	out[0] = h->volume_m3 / exact->volume_m3 - 1;
	out[1] = h->waterplane_area_m2 / exact->waterplane_area_m2 - 1;
	out[2] = h->kmt_m / exact->kmt_m - 1;
	out[3] = h->wetted_surface_m2 / exact->wetted_surface_m2 - 1;
}

/* Offsets converge to the surface at the orders of their rule, meshes at the second, at each of four
 * drafts; the waterlines of mesh and table go through the drafts. */
static void wigley_three_ways(void **state)
{
	(void)state;
	static const double orders[3][4] = { { 3, 3, 0, 3 }, { 0, 0, 0, 4 }, { 2, 2, 2, 2 } };
	batten_context *context = make_context();
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	batten_hydrostatics_options options = with_lbp(0);
	options.gauss_points = 16;
	for (int quarter = 1; quarter <= 4; quarter++) {
		double errors[4][4][3], draft = 6.25 * quarter / 4;
		batten_hydrostatics exact = surface_at(context, surface, &options, draft), h;
		size_t n = 16;
		for (size_t k = 0; k < 3; k++, n *= 2) {
			double found[4];
			batten_hull *hull = make_hull(context, wigley, 100, 6.25, n + 1, n + 1);
			for (int rule = 0; rule < 3; rule++) {
				options.quadrature = (batten_quadrature)rule;
				assert_int_equal(batten_hull_hydrostatics(context, hull, &options, 1, &draft, &h),
				                 BATTEN_OK);
				distances(&h, &exact, found);
				for (size_t q = 0; q < 4; q++)
					errors[rule][q][k] = found[q];
			}
			batten_hull_destroy(hull);
			batten_mesh *mesh = make_mesh(context, wigley_place, n, n, true);
			h = mesh_at(context, mesh, &options, draft);
			distances(&h, &exact, found);
			for (size_t q = 0; q < 4; q++)
				errors[3][q][k] = found[q];
			batten_mesh_destroy(mesh);
		}
		for (size_t q = 0; q < 4; q++) {
			for (size_t rule = 0; rule < 3; rule++) {
				if (orders[rule][q] > 0)
					assert_order(errors[rule][q], orders[rule][q], 0.3);
				else if (q < 2)
					assert_near(errors[rule][q][2], 0, 1e-12);
			}
			assert_order(errors[3][q], 2, 0.2);
		}
	}
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

static double box(double x, double z)
{
	(void)x;
	(void)z;
	return 5;
}

static double wedge(double x, double z)
{
	(void)x;
	return 5 * z / 4;
}

static void box_place(double along, double up, double at[3])
{
	at[0] = 60 * along;
	at[1] = fmin(2 * up, 1) * 5;
	at[2] = fmax(2 * up - 1, 0) * 4;
}

static void wedge_place(double along, double up, double at[3])
{
	at[0] = 60 * along;
	at[1] = 5 * up;
	at[2] = 4 * up;
}

static void prisms_three_ways(void **state)
{
	(void)state;
	static const double sections[2][3][2] = { { { 0, 0 }, { 5, 0 }, { 5, 4 } },
		                                      { { 0, 0 }, { 5, 4 }, { 0, 0 } } };
	batten_context *context = make_context();
	for (int which = 0; which < 2; which++) {
		batten_hull *hull = make_hull(context, which ? wedge : box, 60, 4, 9, 9);
		batten_surface *surface = prism_surface(context, 60, which ? 2 : 3, sections[which]);
		batten_mesh *mesh = make_mesh(context, which ? wedge_place : box_place, 3, 2, false);
		for (int metre = 1; metre <= 4; metre++) {
			const double draft = metre;
			batten_hydrostatics h[3];
			assert_int_equal(batten_hull_hydrostatics(context, hull, NULL, 1, &draft, &h[0]),
			                 BATTEN_OK);
			h[1] = surface_at(context, surface, NULL, draft);
			h[2] = mesh_at(context, mesh, NULL, draft);
			const double *values[3] = { (const double *)&h[0], (const double *)&h[1],
				                        (const double *)&h[2] };
			/* every quantity that all three have, but the beam of the table above the draft */
			for (size_t q = 0; q < BATTEN_HYDROSTATICS_COUNT; q++)
				for (size_t k = 1; k < 3; k++) {
					const char *name = batten_hydrostatics_name(q);
					if (!strncmp(name, "gm", 2) || !strncmp(name, "mt1", 3) ||
					    !strncmp(name, "volume_mis", 10))
						continue;
					if (!(fabs(values[k][q] - values[0][q]) <= 1e-11 * (1 + fabs(values[0][q]))))
						fail_msg("%s: %.17g and %.17g", name, values[0][q], values[k][q]);
				}
		}
		batten_mesh_destroy(mesh);
		batten_surface_destroy(surface);
		batten_hull_destroy(hull);
	}
	batten_context_destroy(context);
}

static void ellipsoid_place(double along, double up, double at[3])
{
	double a = pi * along, b = 0.5 * pi * up;
	at[0] = 50 * (1 - cos(a));
	at[1] = up > 0 ? 5 * sin(a) * sin(b) : 0;
	at[2] = 6.25 * (1 - sin(a) * cos(b));
}

/* Meshes of round bodies at the second order, against the rational surface, at the edge and cut. */
static void ellipsoid_by_mesh_and_surface(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = ellipsoid_surface(context, 100, 10, 6.25);
	for (int turn = 0; turn < 2; turn++) {
		const double draft = turn ? 6.25 : 4;
		batten_hydrostatics exact = surface_at(context, surface, NULL, draft);
		double errors[4][3], found[4];
		size_t n = 20;
		for (size_t k = 0; k < 3; k++, n *= 2) {
			batten_mesh *mesh = make_mesh(context, ellipsoid_place, n, n, true);
			batten_hydrostatics_options options = with_lbp(100);
			batten_hydrostatics h = mesh_at(context, mesh, &options, draft);
			distances(&h, &exact, found);
			for (size_t q = 0; q < 4; q++)
				errors[q][k] = found[q];
			assert_near(h.xcb_from_ap_m, 50, 1e-6);
			batten_mesh_destroy(mesh);
		}
		assert_order(errors[0], 2, 0.2);
		assert_order(errors[1], 2, 0.3);
		assert_order(errors[3], 2, 0.2);
	}
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Memory
 * --------------------------------------------------------------------------------------------- */

struct numbered_call {
	int number;
	const batten_hull *hull;
	const batten_surface *surface;
	const batten_mesh_table *table;
};

static batten_status call_number(batten_context *context, void *user)
{
	const struct numbered_call *call = user;
	const batten_hull *hull = call->hull;
	const batten_surface *surface = call->surface;
	const double drafts[] = { 2, 4 }, x[] = { 20, 50 };
	batten_hydrostatics rows[2];
	double areas[16], more[16], draft;
	size_t count;
	batten_mesh *mesh = NULL;
	switch (call->number) {
	case 0:
		return batten_hull_hydrostatics(context, hull, NULL, 2, drafts, rows);
	case 1:
		return batten_hull_draft_at(context, hull, NULL, 1000, &draft);
	case 2:
		return batten_hull_section_areas(context, hull, NULL, 2, drafts, areas);
	case 3:
		return batten_hull_area_curve(context, hull, NULL, 4, areas, more, &count);
	case 4:
		return batten_surface_hydrostatics(context, surface, NULL, 2, drafts, rows);
	case 5:
		return batten_surface_section_areas(context, surface, NULL, 2, x, 2, drafts, areas);
	case 6:
		return batten_surface_draft_at(context, surface, NULL, 1000, &draft);
	default:
		break;
	}
	batten_status status = batten_mesh_create(context, call->table, &mesh);
	if (status == BATTEN_OK)
		status = batten_mesh_hydrostatics(context, mesh, NULL, 2, drafts, rows);
	if (status == BATTEN_OK)
		status = batten_mesh_section_areas(context, mesh, NULL, 2, x, 2, drafts, areas);
	batten_mesh_destroy(mesh);
	return status;
}

/* Whichever allocation fails, the call says so and keeps nothing. */
static void out_of_memory(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 7, 6);
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	const double vertices[12] = { 0, 0, 0, 90, 0, 0, 0, 9, 5, 90, 9, 5 };
	const uint32_t triangles[6] = { 0, 2, 3, 0, 3, 1 };
	const batten_mesh_table table = { 4, 2, vertices, triangles, true };
	struct numbered_call call = { 0, hull, surface, &table };
	for (; call.number < 8; call.number++)
		assert_true(failing_heap_each(&heap, context, call_number, &call) > 2);
	batten_surface_destroy(surface);
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(many_drafts),
		cmocka_unit_test(drafts_by_displacement),
		cmocka_unit_test(sections_of_offsets),
		cmocka_unit_test(wrong_calls),
		cmocka_unit_test(wigley_three_ways),
		cmocka_unit_test(prisms_three_ways),
		cmocka_unit_test(ellipsoid_by_mesh_and_surface),
		cmocka_unit_test(out_of_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
