/* Surfaces of IGES and STEP that other entities cut or move: read as what they are, or left out by a
 * line that names why; never a wrong hull. */
#include "unit/exchange_fixture.h"

static const char patch[] = PATCH;

static void reads_one_surface(fixture *f, const char *path)
{
	batten_surfaces *list = read_file(f, path);
	assert_int_equal(batten_surfaces_count(list), 1);
	assert_int_equal(batten_surfaces_warning_count(list), 0);
	batten_surfaces_destroy(list);
}

/* ------------------------------------------------------------------------------------------------
 * IGES
 * --------------------------------------------------------------------------------------------- */

/* A closed polygon in the parameters. */
#define LOOP(last, knots, points)                                                                  \
	"126," #last ",1,1,1,1,0,\n" knots "\n" points "\n0.," #last ".,0.,0.,1.;"

/* Cut to a half, to a triangle, a hole: none is the surface it lies on. The boundary that goes round
 * the whole of it is no cut. */
static void test_iges_loops(void **state)
{
	static const char whole[] = LOOP(4, "0.,0.,1.,2.,3.,4.,4.,1.,1.,1.,1.,1.,",
	                                 "0.,0.,0.,1.,0.,0.,1.,1.,0.,0.,1.,0.,0.,0.,0.,");
	static const char half[] = LOOP(4, "0.,0.,1.,2.,3.,4.,4.,1.,1.,1.,1.,1.,",
	                                "0.,0.,0.,.5,0.,0.,.5,1.,0.,0.,1.,0.,0.,0.,0.,");
	static const char triangle[] = LOOP(3, "0.,0.,1.,2.,3.,3.,1.,1.,1.,1.,",
	                                    "0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,0.,0.,");
	static const char hole[] = LOOP(3, "0.,0.,1.,2.,3.,3.,1.,1.,1.,1.,",
	                                ".25,.25,0.,.25,.75,0.,.75,.25,0.,.25,.25,0.,");
	static const int types[] = { 128, 126, 142, 144, 126, 142 };
	static const struct {
		const char *outer, *inner;
		bool cut;
	} cases[] = { { whole, NULL, false },
		          { half, NULL, true },
		          { triangle, NULL, true },
		          { whole, hole, true } };
	fixture *f = *state;
	const char *path = path_of(f, "loops.igs");
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		const char *const parameters[] = { patch,
			                               cases[i].outer,
			                               "142,0,1,3,0,1;",
			                               cases[i].inner ? "144,1,1,1,5,11;" : "144,1,1,0,5;",
			                               cases[i].inner,
			                               "142,0,1,9,0,1;" };
		put_iges(path, 6, "M", cases[i].inner ? 6 : 4, types, NULL, parameters);
		if (cases[i].cut)
			assert_refused(f, path, BATTEN_INPUT, "trimmed");
		else
			reads_one_surface(f, path);
	}
	assert_int_equal(unlink(path), 0);
}

/* A quarter turn about z and a way: the poles are where the matrix puts them, in the unit of the file;
 * where a matrix moves the matrix, both do. */
static void test_iges_matrices(void **state)
{
	static const int types[] = { 128, 124, 124 };
	static const int once[] = { 3, 0, 0 }, twice[] = { 3, 5, 0 };
	static const char *const parameters[] = { patch, "124,0.,-1.,0.,10.,1.,0.,0.,20.,0.,0.,1.,30.;",
		                                      "124,1.,0.,0.,100.,0.,1.,0.,0.,0.,0.,1.,0.;" };
	static const double moved_mm[4][3] = {
		{ 10, 20, 30 }, { 10, 1254.5, 30 }, { -15, 20, 31 }, { -15, 1254.5, 31 }
	};
	fixture *f = *state;
	const char *path = path_of(f, "moved.igs");
	for (size_t round = 0; round < 2; round++) {
		put_iges(path, 2, "MM", 2 + round, types, round ? twice : once, parameters);
		batten_surfaces *list = read_file(f, path);
		assert_int_equal(batten_surfaces_count(list), 1);
		const batten_surface_net net = batten_surface_describe(batten_surfaces_at(list, 0));
		for (size_t n = 0; n < 12; n++) {
			const double expected = moved_mm[n / 3][n % 3] + (n % 3 == 0 && round ? 100 : 0);
			if (!(fabs(net.poles_m[n] - 1e-3 * expected) < 1e-12))
				fail_msg("number %zu: %g mm, expected %g", n, 1e3 * net.poles_m[n], expected);
		}
		batten_surfaces_destroy(list);
	}
	assert_int_equal(unlink(path), 0);
}

/* A matrix of the trimmed surface moves what it is a part of. */
static void test_iges_moved_face(void **state)
{
	static const int types[] = { 128, 144, 124 }, matrices[] = { 0, 5, 0 };
	static const char *const parameters[] = { patch, "144,1,0,0,0;",
		                                      "124,1.,0.,0.,100.,0.,1.,0.,0.,0.,0.,1.,0.;" };
	fixture *f = *state;
	const char *path = path_of(f, "face.igs");
	put_iges(path, 6, "M", 3, types, matrices, parameters);
	assert_refused(f, path, BATTEN_INPUT, "moved by an entity it is part of");
	put_iges(path, 6, "M", 3, types, NULL, parameters);
	reads_one_surface(f, path);
	assert_int_equal(unlink(path), 0);
}

/* A matrix that moves itself through another. */
static void test_iges_matrices_in_a_ring(void **state)
{
	static const int types[] = { 128, 124, 124 }, ring[] = { 3, 5, 3 };
	static const char matrix[] = "124,1.,0.,0.,100.,0.,1.,0.,0.,0.,0.,1.,0.;";
	static const char *const parameters[] = { patch, matrix, matrix };
	fixture *f = *state;
	const char *path = path_of(f, "ring.igs");
	put_iges(path, 6, "M", 3, types, ring, parameters);
	assert_refused(f, path, BATTEN_INPUT, "matrices");
	assert_int_equal(unlink(path), 0);
}

/* A subfigure that an instance puts elsewhere is not read as if it lay where it is defined. */
static void test_iges_instances(void **state)
{
	static const int types[] = { 128, 308, 408 };
	static const char *const parameters[] = { patch, "308,0,4Hpart,1,1;", "408,3,100.,0.,0.,1.;" };
	fixture *f = *state;
	const char *path = path_of(f, "instance.igs");
	put_iges(path, 6, "M", 3, types, NULL, parameters);
	assert_refused(f, path, BATTEN_INPUT, "part of another entity");
	assert_int_equal(unlink(path), 0);
}

/* ------------------------------------------------------------------------------------------------
 * STEP
 * --------------------------------------------------------------------------------------------- */

/* A flat unit square in metres, #17, as the surface of face #16. */
static const char step_head[] =
	"ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
	"FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
	"#1=APPLICATION_CONTEXT('');\n#2=PRODUCT_CONTEXT('',#1,'mechanical');\n"
	"#3=PRODUCT('p','p','',(#2));\n#4=PRODUCT_DEFINITION_FORMATION('','',#3);\n"
	"#5=PRODUCT_DEFINITION_CONTEXT('',#1,'design');\n#6=PRODUCT_DEFINITION('','',#4,#5);\n"
	"#7=PRODUCT_DEFINITION_SHAPE('','',#6);\n#8=SHAPE_DEFINITION_REPRESENTATION(#7,#9);\n"
	"#9=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#14),#10);\n"
	"#10=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#18))"
	"GLOBAL_UNIT_ASSIGNED_CONTEXT((#11,#12,#13))REPRESENTATION_CONTEXT('',''));\n"
	"#11=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"
	"#12=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
	"#13=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
	"#14=SHELL_BASED_SURFACE_MODEL('',(#15));\n#15=OPEN_SHELL('',(#16));\n"
	"#17=B_SPLINE_SURFACE_WITH_KNOTS('flat',1,1,((#20,#21),(#22,#23)),.UNSPECIFIED.,.F.,.F.,.F.,"
	"(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.);\n"
	"#18=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-7),#11,'','');\n"
	"#20=CARTESIAN_POINT('',(0.,0.,0.));\n#21=CARTESIAN_POINT('',(0.,1.,0.));\n"
	"#22=CARTESIAN_POINT('',(1.,0.,0.));\n#23=CARTESIAN_POINT('',(1.,1.,0.));\n";

/* A loop of straight edges through corners; ten numbers an edge from that of the bound on. */
static void put_loop(FILE *stream, size_t bound, size_t count, const double (*at)[2])
{
	(void)fprintf(stream, "#%zu=FACE_BOUND('',#%zu,.T.);\n#%zu=EDGE_LOOP('',(", bound, bound + 1,
	              bound + 1);
	for (size_t k = 0; k < count; k++)
		(void)fprintf(stream, "%s#%zu", k ? "," : "", bound + 10 * (k + 1));
	(void)fprintf(stream, "));\n");
	for (size_t k = 0; k < count; k++) {
		const size_t n = bound + 10 * (k + 1), next = bound + 10 * ((k + 1) % count + 1);
		const double *here = at[k], *there = at[(k + 1) % count];
		(void)fprintf(stream, "#%zu=ORIENTED_EDGE('',*,*,#%zu,.T.);\n", n, n + 1);
		(void)fprintf(stream, "#%zu=EDGE_CURVE('',#%zu,#%zu,#%zu,.T.);\n", n + 1, n + 2, next + 2,
		              n + 4);
		(void)fprintf(stream, "#%zu=VERTEX_POINT('',#%zu);\n", n + 2, n + 3);
		(void)fprintf(stream, "#%zu=CARTESIAN_POINT('',(%#g,%#g,0.));\n", n + 3, here[0], here[1]);
		(void)fprintf(stream, "#%zu=LINE('',#%zu,#%zu);\n", n + 4, n + 3, n + 5);
		(void)fprintf(stream, "#%zu=VECTOR('',#%zu,1.);\n", n + 5, n + 6);
		(void)fprintf(stream, "#%zu=DIRECTION('',(%#g,%#g,0.));\n", n + 6, there[0] - here[0],
		              there[1] - here[1]);
	}
}

static void put_step(const char *path, size_t count, const double (*outer)[2], bool hole,
                     const char *more)
{
	static const double inner[3][2] = { { 0.25, 0.25 }, { 0.25, 0.75 }, { 0.75, 0.25 } };
	FILE *stream = fopen(path, "wb");
	assert_non_null(stream);
	(void)fprintf(stream, "%s#16=ADVANCED_FACE('',(#100%s),#17,.T.);\n", step_head,
	              hole ? ",#200" : "");
	put_loop(stream, 100, count, outer);
	if (hole)
		put_loop(stream, 200, 3, inner);
	(void)fprintf(stream, "%sENDSEC;\nEND-ISO-10303-21;\n", more);
	assert_int_equal(fclose(stream), 0);
}

static const double square[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };

static void test_step_loops(void **state)
{
	static const double half[4][2] = { { 0, 0 }, { 0.5, 0 }, { 0.5, 1 }, { 0, 1 } };
	static const double triangle[3][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 } };
	fixture *f = *state;
	const char *path = path_of(f, "loops.step");
	put_step(path, 4, square, false, "");
	reads_one_surface(f, path);
	put_step(path, 4, half, false, "");
	assert_refused(f, path, BATTEN_INPUT, "trimmed");
	put_step(path, 3, triangle, false, "");
	assert_refused(f, path, BATTEN_INPUT, "trimmed");
	put_step(path, 4, square, true, "");
	assert_refused(f, path, BATTEN_INPUT, "trimmed");
	assert_int_equal(unlink(path), 0);
}

/* An instance of the whole: refused where it moves it, read where it leaves it. */
static void test_step_instances(void **state)
{
	static const char *const ways[] = { "5.", "0." };
	fixture *f = *state;
	const char *path = path_of(f, "instance.step");
	for (size_t i = 0; i < 2; i++) {
		char more[1024];
		(void)snprintf(more, sizeof more,
		               "#300=CARTESIAN_POINT('',(0.,0.,0.));\n"
		               "#301=CARTESIAN_POINT('',(%s,0.,0.));\n"
		               "#302=AXIS2_PLACEMENT_3D('',#300,$,$);\n"
		               "#303=AXIS2_PLACEMENT_3D('',#301,$,$);\n"
		               "#304=REPRESENTATION_MAP(#302,#9);\n#305=MAPPED_ITEM('',#304,#303);\n"
		               "#306=SHAPE_REPRESENTATION('',(#305),#10);\n",
		               ways[i]);
		put_step(path, 4, square, false, more);
		if (i == 0)
			assert_refused(f, path, BATTEN_INPUT, "an assembly of parts that are moved");
		else
			reads_one_surface(f, path);
	}
	assert_int_equal(unlink(path), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_iges_loops, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_iges_matrices, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_iges_moved_face, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_iges_matrices_in_a_ring, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_iges_instances, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_step_loops, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_step_instances, make_fixture, end_fixture),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
