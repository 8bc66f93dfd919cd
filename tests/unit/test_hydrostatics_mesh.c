/* Hydrostatics of triangle meshes: exact on bodies with plane sides (Letcher 5.1, 9.4), at the second
 * order on Wigley's hull, whose printed errors are met; what a mesh must be. */
#include "unit/hydrostatics_fixture.h"

#include <unistd.h>

static batten_mesh *mesh_of(batten_context *context, size_t vertex_count, const double *vertices,
                            size_t triangle_count, const uint32_t *triangles, bool half)
{
	batten_mesh_table table = { vertex_count, triangle_count, vertices, triangles, half };
	batten_mesh *mesh = NULL;
	if (batten_mesh_create(context, &table, &mesh) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return mesh;
}

/* ------------------------------------------------------------------------------------------------
 * Bodies with plane sides
 * --------------------------------------------------------------------------------------------- */

static const uint32_t pyramid_faces[12] = { 0, 1, 2, 1, 4, 2, 4, 3, 2, 3, 0, 2 };

/* Letcher's mesh (figure 24): five vertices, four triangles, open below. */
/* Each triangle cut into four at the middles of its sides, vertices and triangles in place. */
static void split(size_t *vertex_count, double *vertices, size_t *face_count, uint32_t *faces)
{
	const size_t before = *face_count;
	for (size_t t = 0; t < before; t++) {
		uint32_t *f = faces + 3 * t, corner[3] = { f[0], f[1], f[2] }, middle[3];
		for (size_t k = 0; k < 3; k++) {
			double at[3];
			for (size_t c = 0; c < 3; c++)
				at[c] = 0.5 * (vertices[3 * (size_t)corner[k] + c] +
				               vertices[3 * (size_t)corner[(k + 1) % 3] + c]);
			size_t i = 0;
			while (i < *vertex_count && memcmp(vertices + 3 * i, at, sizeof at) != 0)
				i++;
			if (i == *vertex_count)
				memcpy(vertices + 3 * (*vertex_count)++, at, sizeof at);
			middle[k] = (uint32_t)i;
		}
		for (size_t k = 0; k < 3; k++) {
			const uint32_t cut[3] = { corner[k], middle[k], middle[(k + 2) % 3] };
			memcpy(faces + 3 * (*face_count)++, cut, sizeof cut);
		}
		memcpy(f, middle, sizeof middle);
	}
}

/* Its vertices, edges and faces as it is split: one more vertex and face than edges (7.1). */
static void pyramid_split(void **state)
{
	(void)state;
	static const size_t counts[3][3] = { { 5, 8, 4 }, { 13, 28, 16 }, { 41, 104, 64 } };
	double vertices[3 * 41] = { -1, -1, 0, 1, -1, 0, 0, 0, 2, -1, 1, 0, 1, 1, 0 };
	uint32_t faces[3 * 64];
	size_t vertex_count = 5, face_count = 4;
	batten_context *context = make_context();
	memcpy(faces, pyramid_faces, 12 * sizeof *faces);
	for (size_t k = 0; k < 3; k++) {
		if (k > 0)
			split(&vertex_count, vertices, &face_count, faces);
		batten_mesh *mesh = mesh_of(context, vertex_count, vertices, face_count, faces, false);
		const batten_mesh_facts facts = batten_mesh_describe(mesh);
		assert_int_equal(facts.vertex_count, counts[k][0]);
		assert_int_equal(facts.edge_count, counts[k][1]);
		assert_int_equal(facts.triangle_count, counts[k][2]);
		assert_relative(facts.area_m2, 4 * sqrt(5), 1e-14);
		batten_mesh_destroy(mesh);
	}
	batten_context_destroy(context);
}

static void pyramid_of_the_book(void **state)
{
	(void)state;
	static const double up[15] = { -1, -1, 0, 1, -1, 0, 0, 0, 2, -1, 1, 0, 1, 1, 0 };
	batten_context *context = make_context();
	batten_mesh *mesh = mesh_of(context, 5, up, 4, pyramid_faces, false);
	batten_mesh_facts facts = batten_mesh_describe(mesh);
	assert_true(facts.vertex_count == 5 && facts.triangle_count == 4 && facts.edge_count == 8);
	assert_int_equal(facts.open_edge_count, 4);
	assert_int_equal(facts.first_open_triangle, 0);
	assert_relative(facts.area_m2, 4 * sqrt(5), 1e-14);
	batten_mesh_destroy(mesh);
	/* point down, the other way round: afloat at a height of 2 */
	double down[15];
	uint32_t faces[12];
	for (size_t i = 0; i < 15; i++)
		down[i] = i % 3 == 2 ? 2 - up[i] : up[i];
	for (size_t i = 0; i < 12; i++)
		faces[i] = pyramid_faces[3 * (i / 3) + 2 - i % 3];
	mesh = mesh_of(context, 5, down, 4, faces, false);
	batten_hydrostatics_options options = with_lbp(2);
	batten_hydrostatics h = mesh_at(context, mesh, &options, 2);
	assert_relative(h.volume_m3, 8.0 / 3, 1e-14);
	assert_relative(h.kb_m, 1.5, 1e-14);
	assert_relative(h.waterplane_area_m2, 4, 1e-14);
	assert_relative(h.i_t_m4, 4.0 / 3, 1e-14);
	assert_relative(h.i_l_m4, 4.0 / 3, 1e-14);
	assert_relative(h.wetted_surface_m2, 4 * sqrt(5), 1e-14);
	assert_near(h.xcb_from_ap_m, 0, 1e-15);
	assert_true(h.lwl_m == 2 && h.beam_wl_m == 2);
	assert_true(h.volume_mismatch_pct < 1e-10);
	h = mesh_at(context, mesh, &options, 1);
	assert_relative(h.volume_m3, 1.0 / 3, 1e-14);
	assert_relative(h.kb_m, 0.75, 1e-14);
	batten_mesh_destroy(mesh);
	batten_context_destroy(context);
}

/* The barge of 100 x 20 x 5, without a deck: whole, and as its port half without its ends. */
static void barge(void **state)
{
	(void)state;
	const double l = 100, b = 10, d = 8;
	const double vertices[24] = { 0, -b, 0, l, -b, 0, l, b, 0, 0, b, 0,
		                          0, -b, d, l, -b, d, l, b, d, 0, b, d };
	const uint32_t faces[30] = { 0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 2, 3, 7,
		                         2, 7, 6, 3, 0, 4, 3, 4, 7, 1, 2, 6, 1, 6, 5 };
	batten_context *context = make_context();
	batten_mesh *mesh = mesh_of(context, 8, vertices, 10, faces, false);
	for (int half = 0; half < 2; half++) {
		batten_hydrostatics h = mesh_at(context, mesh, NULL, 5);
		assert_relative(h.volume_m3, 10000, 1e-14);
		assert_relative(h.kb_m, 2.5, 1e-14);
		assert_relative(h.waterplane_area_m2, 2000, 1e-14);
		assert_relative(h.i_t_m4, 200000.0 / 3, 1e-13);
		assert_relative(h.i_l_m4 + 2000 * 2500, 2e7 / 3, 1e-13);
		assert_relative(h.xcb_from_ap_m, 50, 1e-14);
		assert_relative(h.wetted_surface_m2, half ? 3000 : 3200, 1e-14);
		assert_relative(h.midship_area_m2, 100, 1e-14);
		assert_relative(h.cb, 1, 1e-13);
		assert_true(half ? h.transom_area_m2 == 200 : h.transom_area_m2 == 0);
		assert_true(h.volume_mismatch_pct < 1e-10);
		const double x[] = { 0, 3, 100, 101 }, z[] = { 1, 8 };
		double areas[8];
		assert_int_equal(batten_mesh_section_areas(context, mesh, NULL, 4, x, 2, z, areas),
		                 BATTEN_OK);
		assert_relative(areas[1], 20, 1e-14);
		assert_relative(areas[6], 160, 1e-14);
		assert_true(areas[0] == 0 && areas[3] == 0 && areas[7] == 0);
		double draft = 0;
		assert_int_equal(batten_mesh_draft_at(context, mesh, NULL, 2.05 * 3000, &draft), BATTEN_OK);
		assert_relative(draft, 3, 1e-12);
		batten_mesh_destroy(mesh);
		if (half)
			break;
		const double port[18] = { 0, 0, 0, l, 0, 0, l, b, 0, 0, b, 0, l, b, d, 0, b, d };
		const uint32_t shell[12] = { 0, 2, 1, 0, 3, 2, 2, 3, 5, 2, 5, 4 };
		mesh = mesh_of(context, 6, port, 4, shell, true);
		/* two upright edges at either end and the sheer are open, the centreline is not */
		assert_int_equal(batten_mesh_describe(mesh).open_edge_count, 5);
	}
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Wigley's hull, 100 x 10 x 6.25
 * --------------------------------------------------------------------------------------------- */

static void wigley_place(double along, double up, double at[3])
{
	/* the bow is at 0 in the source; here x runs forward, so that the diagonals are mirrored */
	double t = 1 - up;
	at[0] = 100 * along;
	at[1] = 20 * along * (1 - along) * (1 - t * t);
	at[2] = 6.25 * up;
}

/* The errors of Letcher's formulas on N x M cells with one-sided diagonals; their bias of the centre
 * is gone with alternate ones. */
static void wigley_errors(void **state)
{
	(void)state;
	static const struct {
		size_t n, m;
		double volume, wetted, plane, i_t, z_b, x_b;
	} rows[] = {
		{ 10, 5, -1.990e-2, -1.20045e-3, -1.0e-2, -2.3101e-2, -3.367e-3, 49.747475 },
		{ 20, 10, -4.99375e-3, -2.96047e-4, -2.5e-3, -5.81877e-3, -8.354e-4, 49.937343 },
		{ 40, 20, -1.249609e-3, -7.37718e-5, -6.25e-4, -1.45742e-3, -2.085e-4, 49.984365 },
		{ 80, 40, -3.12476e-4, -1.84281e-5, -1.5625e-4, -3.64526e-4, -5.209e-5, 49.996093 },
	};
	batten_context *context = make_context();
	for (size_t k = 0; k < 4; k++) {
		batten_mesh *mesh = make_mesh(context, wigley_place, rows[k].n, rows[k].m, false);
		batten_hydrostatics h = mesh_at(context, mesh, NULL, 6.25);
		/* as many digits as are printed */
		assert_near(h.volume_m3 / (25000.0 / 9) - 1, rows[k].volume, 6e-7);
		assert_near(h.wetted_surface_m2 / 1487.9063104958 - 1, rows[k].wetted, 6e-9);
		assert_near(h.waterplane_area_m2 / (2000.0 / 3) - 1, rows[k].plane, 1e-12);
		assert_near(h.i_t_m4 / (80000.0 / 21) - 1, rows[k].i_t, 6e-7);
		assert_near((6.25 - h.kb_m) / 2.34375 - 1, rows[k].z_b, 6e-7);
		assert_near(fabs(h.xcb_from_ap_m - 50), 50 - rows[k].x_b, 6e-7);
		assert_true(h.volume_mismatch_pct < 1e-9);
		batten_mesh_destroy(mesh);
		mesh = make_mesh(context, wigley_place, rows[k].n, rows[k].m, true);
		h = mesh_at(context, mesh, NULL, 6.25);
		assert_near(h.xcb_from_ap_m, 50, rows[k].m % 2 ? 0.02 : 1e-11);
		batten_mesh_destroy(mesh);
	}
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * What a mesh must be
 * --------------------------------------------------------------------------------------------- */

static void expect_refusal(batten_context *context, batten_mesh_table table, batten_status status,
                           const char *what)
{
	batten_mesh *mesh = NULL;
	assert_int_equal(batten_mesh_create(context, &table, &mesh), status);
	assert_null(mesh);
	if (!strstr(batten_context_error(context), what))
		fail_msg("'%s' where '%s' is expected", batten_context_error(context), what);
}

static void bad_meshes(void **state)
{
	(void)state;
	const double good[15] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1 };
	const uint32_t solid[12] = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3 };
	batten_context *context = make_context();
	batten_mesh_table table = { 5, 4, good, solid, false };
	double vertices[15];
	uint32_t faces[15];
	for (int c = 0; c < 3; c++) {
		static const double wrong[] = { NAN, INFINITY, -2e6 };
		memcpy(vertices, good, sizeof good);
		vertices[6 + c] = wrong[c];
		table.vertices_m = vertices;
		expect_refusal(context, table, BATTEN_INPUT, "vertex 2");
	}
	table.vertices_m = good;
	table.triangles = faces;
	memcpy(faces, solid, sizeof solid);
	faces[7] = 5;
	expect_refusal(context, table, BATTEN_INPUT, "triangle 2: vertex 5, expected less than 5");
	faces[7] = 3;
	expect_refusal(context, table, BATTEN_INPUT, "triangle 2: a vertex twice");
	memcpy(faces, solid, sizeof solid);
	faces[9] = 0;
	faces[10] = 2;
	expect_refusal(context, table, BATTEN_INPUT, "triangle 3: runs the other way round");
	memcpy(faces, solid, sizeof solid);
	faces[12] = 0;
	faces[13] = 1;
	faces[14] = 4;
	table.triangle_count = 5;
	expect_refusal(context, table, BATTEN_INPUT, "triangle 0: its edge 1-0 belongs to 3 triangles");
	table.triangle_count = 4;
	for (size_t i = 0; i < 12; i++)
		faces[i] = solid[3 * (i / 3) + 2 - i % 3];
	expect_refusal(context, table, BATTEN_INPUT, "inside out");
	table.triangles = solid;
	table.half = true;
	memcpy(vertices, good, sizeof good);
	vertices[13] = -0.5;
	table.vertices_m = vertices;
	expect_refusal(context, table, BATTEN_INPUT, "vertex 4: y is -0.5");
	expect_refusal(context, (batten_mesh_table){ 2, 1, good, solid, false }, BATTEN_USAGE, "2");
	expect_refusal(context, (batten_mesh_table){ 3, 0, good, solid, false }, BATTEN_USAGE, "0 tri");
	expect_refusal(context, (batten_mesh_table){ 3, 1, NULL, solid, false }, BATTEN_USAGE, "3");
	batten_mesh_destroy(NULL);
	batten_context_destroy(context);
}

/* A hole below the draft is named; a draft or weight out of reach is refused. */
static void holes_and_drafts(void **state)
{
	(void)state;
	const double vertices[24] = { 0, -1, 0, 4, -1, 0, 4, 1, 0, 0, 1, 0,
		                          0, -1, 2, 4, -1, 2, 4, 1, 2, 0, 1, 2 };
	const uint32_t faces[27] = { 0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 2, 3,
		                         7, 3, 0, 4, 3, 4, 7, 1, 2, 6, 1, 6, 5 };
	batten_context *context = make_context();
	batten_mesh *mesh = mesh_of(context, 8, vertices, 9, faces, false);
	batten_hydrostatics h;
	const double one = 1;
	assert_int_equal(batten_mesh_hydrostatics(context, mesh, NULL, 1, &one, &h), BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(context),
	                       "triangle 4: its edge 7-2 borders a hole below the draft of 1 m"));
	static const double drafts[] = { 0, 2.1, NAN };
	for (size_t k = 0; k < 3; k++)
		assert_int_equal(batten_mesh_hydrostatics(context, mesh, NULL, 1, &drafts[k], &h),
		                 BATTEN_USAGE);
	double draft = 0;
	assert_int_equal(batten_mesh_draft_at(context, mesh, NULL, 17, &draft), BATTEN_USAGE);
	batten_mesh_destroy(mesh);
	batten_context_destroy(context);
}

/* A surface as triangles through a binary STL file: its corners are joined again, and it measures what the
 * surface does but for its facets. */
static void through_stl(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	batten_mesh *mesh = NULL;
	char path[] = "/tmp/batten_mesh_XXXXXX.stl";
	const int file = mkstemps(path, 4);
	assert_true(file >= 0);
	(void)close(file);
	assert_int_equal(batten_surface_write_stl(context, surface, 20, path), BATTEN_OK);
	if (batten_mesh_read(context, path, &mesh) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	(void)unlink(path);
	const batten_mesh_facts facts = batten_mesh_describe(mesh);
	/* both halves, without the triangle at the forefoot that lies in the centreplane; open at the deck */
	assert_int_equal(facts.triangle_count, 2 * (2 * 20 * 20 - 1));
	assert_int_equal(facts.open_edge_count, 2 * 20);
	const batten_hydrostatics_options options = with_lbp(100);
	const batten_hydrostatics found = mesh_at(context, mesh, &options, 6.25);
	assert_relative(found.volume_m3, 25000.0 / 9, 5e-3);
	assert_relative(found.kb_m, 3.90625, 1e-3);
	assert_relative(found.beam_max_m, 10, 1e-6);
	batten_mesh_destroy(mesh);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(through_stl),      cmocka_unit_test(pyramid_of_the_book),
		cmocka_unit_test(pyramid_split),    cmocka_unit_test(barge),
		cmocka_unit_test(wigley_errors),    cmocka_unit_test(bad_meshes),
		cmocka_unit_test(holes_and_drafts),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
