/* Surfaces in IGES and STEP: every number comes back, units are converted, and what is damaged or no
 * B-spline surface is refused by name. */
#include "exchange/module.h"
#include "support/failing_heap.h"
#include "unit/exchange_fixture.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

static void assert_same_net(const batten_surface *first, const batten_surface *second)
{
	const batten_surface_net a = batten_surface_describe(first);
	const batten_surface_net b = batten_surface_describe(second);
	assert_string_equal(a.name, b.name);
	assert_int_equal(a.order_u, b.order_u);
	assert_int_equal(a.order_v, b.order_v);
	assert_int_equal(a.count_u, b.count_u);
	assert_int_equal(a.count_v, b.count_v);
	assert_memory_equal(a.knots_u, b.knots_u, (a.count_u + a.order_u) * sizeof(double));
	assert_memory_equal(a.knots_v, b.knots_v, (a.count_v + a.order_v) * sizeof(double));
	assert_memory_equal(a.poles_m, b.poles_m, 3 * a.count_u * a.count_v * sizeof(double));
	assert_true((a.weights == NULL) == (b.weights == NULL));
	if (a.weights)
		assert_memory_equal(a.weights, b.weights, a.count_u * a.count_v * sizeof(double));
}

/* ------------------------------------------------------------------------------------------------
 * Round trips
 * --------------------------------------------------------------------------------------------- */

enum { MANY = 14 };

/* Orders 2 to 8 in both directions, with repeated and unclamped knots, half of them rational. */
static void make_many(fixture *f, batten_surface *surfaces[MANY])
{
	uint64_t seed = 17;
	static const char *const names[] = { "hull", "", "a name that is longer than a label",
		                                 "it's; a, 'quoted' \\ name" };
	for (size_t i = 0; i < MANY; i++) {
		drawn d;
		draw_net(&seed, 2 + i % 7, 8 - i % 7, i % 2 == 1, &d);
		d.net.name = names[i % 4];
		d.poles[0] = -1e9 * draw_real(&seed, 0.5, 1);
		d.poles[1] = -0.0;
		d.poles[2] = 1e-98 * draw_real(&seed, -1, -0.5);
		assert_int_equal(batten_surface_create(f->context, &d.net, &surfaces[i]), BATTEN_OK);
	}
}

static void check_round_trip(fixture *f, const char *name)
{
	batten_surface *surfaces[MANY];
	make_many(f, surfaces);
	const char *path = path_of(f, name);
	if (batten_surfaces_write(f->context, MANY, (const batten_surface *const *)surfaces, path) !=
	    BATTEN_OK)
		fail_msg("%s", batten_context_error(f->context));
	batten_surfaces *list = read_file(f, path);
	assert_int_equal(batten_surfaces_warning_count(list), 0);
	assert_int_equal(batten_surfaces_count(list), MANY);
	for (size_t i = 0; i < MANY; i++) {
		assert_same_net(surfaces[i], batten_surfaces_at(list, i));
		batten_surface_destroy(surfaces[i]);
	}
	assert_null(batten_surfaces_at(list, MANY));
	assert_null(batten_surfaces_warning(list, 0));
	batten_surfaces_destroy(list);
	assert_int_equal(unlink(path), 0);
}

static void test_round_trips(void **state)
{
	check_round_trip(*state, "many.igs");
	check_round_trip(*state, "many.IGES");
	check_round_trip(*state, "many.stp");
	check_round_trip(*state, "many.step");
}

static batten_surface *make_one(fixture *f, const char *name, double weight, double first)
{
	const double poles[] = { first, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1 };
	const double weights[] = { 1, 1, 1, weight };
	const batten_surface_net net = { .name = name,
		                             .order_u = 2,
		                             .order_v = 2,
		                             .count_u = 2,
		                             .count_v = 2,
		                             .poles_m = poles,
		                             .weights = weight > 0 ? weights : NULL };
	batten_surface *surface = NULL;
	assert_int_equal(batten_surface_create(f->context, &net, &surface), BATTEN_OK);
	return surface;
}

static void write_one(fixture *f, const batten_surface *surface, const char *path)
{
	if (batten_surfaces_write(f->context, 1, &surface, path) != BATTEN_OK)
		fail_msg("%s", batten_context_error(f->context));
}

/* Below 1e-99 there is nothing; a single surface may go through .json. */
static void test_smallest_and_json(void **state)
{
	static const char *const names[] = { "a.igs", "a.step" };
	fixture *f = *state;
	batten_surface *surface = make_one(f, "one", 0, -1e-120);
	for (size_t i = 0; i < 2; i++) {
		const char *path = path_of(f, names[i]);
		write_one(f, surface, path);
		batten_surfaces *list = read_file(f, path);
		assert_true(batten_surface_describe(batten_surfaces_at(list, 0)).poles_m[0] == 0.0);
		batten_surfaces_destroy(list);
		assert_int_equal(unlink(path), 0);
	}
	const char *path = path_of(f, "a.json");
	write_one(f, surface, path);
	batten_surfaces *list = read_file(f, path);
	assert_same_net(surface, batten_surfaces_at(list, 0));
	batten_surfaces_destroy(list);
	assert_int_equal(unlink(path), 0);
	batten_surface_destroy(surface);
}

/* ------------------------------------------------------------------------------------------------
 * IGES as other programs write it
 * --------------------------------------------------------------------------------------------- */

static void test_units(void **state)
{
	static const struct {
		int flag;
		const char *name;
		double length_m, breadth_m;
	} cases[] = { { 1, "IN", 1234.5 * 0.0254, 25 * 0.0254 },
		          { 2, "MM", 1.2345, 0.025 },
		          { 3, "MM", 1.2345, 0.025 },
		          { 4, "FT", 1234.5 * 0.3048, 25 * 0.3048 },
		          { 6, "M", 1234.5, 25 },
		          { 10, "CM", 12.345, 0.25 } };
	fixture *f = *state;
	const char *path = path_of(f, "unit.igs");
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		put_patch(path, cases[i].flag, cases[i].name, PATCH);
		batten_surfaces *list = read_file(f, path);
		assert_int_equal(batten_surfaces_count(list), 1);
		const batten_surface_net net = batten_surface_describe(batten_surfaces_at(list, 0));
		assert_string_equal(net.name, "by hand");
		assert_null(net.weights);
		assert_true(net.poles_m[3] == cases[i].length_m);
		assert_true(net.poles_m[7] == cases[i].breadth_m);
		batten_surfaces_destroy(list);
	}
	assert_int_equal(unlink(path), 0);
}

static void test_refused_patches(void **state)
{
	static const struct {
		int flag;
		const char *unit, *parameters, *part;
	} cases[] = {
		{ 12, "XX", PATCH, "the unit is flag 12" },
		{ 3, "CUBIT", PATCH, "name 'CUBIT'" },
		{ 6, "M", "128,1,1,1,1,0,0,1,1,0,\n" PATCH_KNOTS PATCH_POLES "0.,1.,0.,1.;", "periodic" },
		{ 6, "M", "128,1,1,1,1,0,0,1,0,0,\n" PATCH_KNOTS PATCH_POLES "0.,0.5,0.,1.;",
		  "cut to a part of its range" },
		{ 6, "M", "128,65535,65535,1,1,0,0,1,0,0,\n" PATCH_KNOTS PATCH_POLES "0.,1.,0.,1.;",
		  "bad.igs: " },
		{ 6, "M", "128,1,1,1,1,0,0,1,0,0,\n0.,0.,1.,1.;", "" },
		{ 6, "M", "128,-3,1,1,1,0,0,1,0,0,\n" PATCH_KNOTS PATCH_POLES "0.,1.,0.,1.;", "" },
		{ 6, "M",
		  "128,1,1,1,1,0,0,1,0,0,\n0.,1.,0.,1.,0.,0.,1.,1.,1.,1.,1.,1.,\n" PATCH_POLES
		  "0.,1.,0.,1.;",
		  "" },
	};
	fixture *f = *state;
	const char *path = path_of(f, "bad.igs");
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		put_patch(path, cases[i].flag, cases[i].unit, cases[i].parameters);
		assert_refused(f, path, BATTEN_INPUT, cases[i].part);
	}
	assert_int_equal(unlink(path), 0);
}

/* A line, a plane, a trimmed surface without limits of its own, which is whole. */
static void test_other_entities(void **state)
{
	static const int types[] = { 110, 128, 144, 108 };
	static const char *const parameters[] = { "110,0.,0.,0.,1.,1.,1.;", PATCH, "144,3,0,0,0;",
		                                      "108,0.,0.,1.,0.,0,0.,0.,0.,0.;" };
	fixture *f = *state;
	const char *path = path_of(f, "mixed.igs");
	put_iges(path, 6, "M", 4, types, NULL, parameters);
	batten_surfaces *list = read_file(f, path);
	assert_int_equal(batten_surfaces_count(list), 1);
	assert_int_equal(batten_surfaces_warning_count(list), 2);
	bool line = false, plane = false;
	for (size_t i = 0; i < 2; i++) {
		line = line || strstr(batten_surfaces_warning(list, i), "1 x line (110)");
		plane = plane || strstr(batten_surfaces_warning(list, i), "1 x plane (108)");
	}
	assert_true(line && plane);
	batten_surfaces_destroy(list);
	put_iges(path, 6, "M", 1, types, NULL, parameters);
	assert_refused(f, path, BATTEN_INPUT, "line (110)");
	assert_int_equal(unlink(path), 0);
}

/* ------------------------------------------------------------------------------------------------
 * What is no such file
 * --------------------------------------------------------------------------------------------- */

static void test_foreign_files(void **state)
{
	static const char *const names[] = { "x.igs", "x.step" };
	fixture *f = *state;
	for (size_t i = 0; i < 2; i++) {
		const char *path = path_of(f, names[i]);
		assert_refused(f, path, BATTEN_IO, "cannot be read");
		put_text(path, "", 0);
		assert_refused(f, path, BATTEN_INPUT, "is empty");
		put_text(path, "\0\1\2\3", 4);
		assert_refused(f, path, BATTEN_INPUT, "");
		put_text(path, "solid cube\nfacet normal 0 0 1\n", 30);
		assert_refused(f, path, BATTEN_INPUT, "");
		put_text(path, "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n", 63);
		assert_refused(f, path, BATTEN_INPUT, "");
		assert_int_equal(truncate(path, (off_t)300 << 20), 0); /* sparse */
		assert_refused(f, path, BATTEN_INPUT, "longer than");
		assert_int_equal(unlink(path), 0);
		assert_int_equal(mkfifo(path, 0600), 0);
		assert_refused(f, path, BATTEN_IO, "no plain file");
		assert_int_equal(unlink(path), 0);
		assert_int_equal(mkdir(path, 0700), 0);
		assert_refused(f, path, BATTEN_IO, "folder");
		assert_int_equal(rmdir(path), 0);
	}
	assert_refused(f, path_of(f, "x.stl"), BATTEN_USAGE, ".step");
	assert_refused(f, path_of(f, "igs"), BATTEN_USAGE, ".step");
}

static void test_refused_writes(void **state)
{
	fixture *f = *state;
	const batten_surface *surface = make_one(f, "one", 0, 0);
	const batten_surface *light = make_one(f, "light", 1e-8, 0);
	const batten_surface *const two[] = { surface, surface };
	assert_int_equal(batten_surfaces_write(f->context, 1, &surface, "x.stl"), BATTEN_USAGE);
	assert_int_equal(batten_surfaces_write(f->context, 0, &surface, "x.igs"), BATTEN_USAGE);
	assert_int_equal(batten_surfaces_write(f->context, 2, two, path_of(f, "x.json")), BATTEN_USAGE);
	assert_says(f, "2 surfaces");
	assert_int_equal(batten_surfaces_write(f->context, 1, &light, path_of(f, "x.igs")),
	                 BATTEN_USAGE);
	assert_says(f, "weight");
	assert_int_equal(batten_surfaces_write(f->context, 1, &surface, path_of(f, "none/x.step")),
	                 BATTEN_IO);
	batten_surface_destroy((batten_surface *)surface);
	batten_surface_destroy((batten_surface *)light);
}

static void test_missing_module(void **state)
{
	fixture *f = *state;
	const char *kept = getenv("BATTEN_MODULE_PATH");
	assert_non_null(kept);
	char *folder = strdup(kept);
	assert_int_equal(setenv("BATTEN_MODULE_PATH", f->folder, 1), 0);
	const batten_surface *surface = make_one(f, "one", 0, 0);
	const char *path = path_of(f, "x.igs");
	assert_int_equal(batten_surfaces_write(f->context, 1, &surface, path), BATTEN_MISSING);
	assert_says(f, "libocct-data-exchange-dev");
	assert_int_equal(access(path, F_OK), -1);
	put_patch(path, 6, "M", PATCH);
	assert_refused(f, path, BATTEN_MISSING, "libocct-data-exchange-dev");
	char module[160];
	(void)snprintf(module, sizeof module, "%s/batten_opencascade.so", f->folder);
	put_text(module, "no module", 9);
	assert_refused(f, path, BATTEN_MISSING, "libocct-data-exchange-dev");
	assert_int_equal(unlink(module), 0);
	assert_int_equal(unlink(path), 0);
	assert_int_equal(setenv("BATTEN_MODULE_PATH", folder, 1), 0);
	free(folder);
	batten_surface_destroy((batten_surface *)surface);
}

/* ------------------------------------------------------------------------------------------------
 * Damage
 * --------------------------------------------------------------------------------------------- */

/* Whatever the damage: a surface, or one line that names the file. */
static void check_damaged(fixture *f, const char *path)
{
	batten_surfaces *list = NULL;
	const batten_status status = batten_surfaces_read(f->context, path, &list);
	if (status == BATTEN_OK)
		assert_true(batten_surfaces_count(list) > 0);
	else if (status == BATTEN_INPUT)
		assert_says(f, path);
	else
		fail_msg("status %d: %s", (int)status, batten_context_error(f->context));
	batten_surfaces_destroy(list);
}

static void damage(fixture *f, const char *name, uint64_t seed)
{
	static const char marks[] = "0123456789-,;()#'.EHSGDPT *\n";
	enum { ROUNDS = 60, LONGEST = 1 << 16 };
	static char whole[LONGEST], text[LONGEST];
	const batten_surface *surface = make_one(f, "one", 2, 0.5);
	const char *path = path_of(f, name);
	write_one(f, surface, path);
	FILE *stream = fopen(path, "rb");
	assert_non_null(stream);
	const size_t length = fread(whole, 1, sizeof whole, stream);
	assert_int_equal(fclose(stream), 0);
	assert_true(length > 500 && length < sizeof whole);
	for (int round = 0; round < ROUNDS; round++) {
		size_t kept = round % 3 == 0 ? draw(&seed) % length : length;
		memcpy(text, whole, length);
		for (int i = 0; round % 3 != 0 && i <= round % 5; i++)
			text[draw(&seed) % length] = round % 3 == 1 ? marks[draw(&seed) % (sizeof marks - 1)]
			                                            : (char)(draw(&seed) % 256);
		put_text(path, text, kept);
		check_damaged(f, path);
	}
	assert_int_equal(unlink(path), 0);
	batten_surface_destroy((batten_surface *)surface);
}

static void test_damage(void **state)
{
	/* A child opens the module itself, which takes longer than such a file; what its parent has opened is
	 * there. */
	assert_non_null(exchange_module_open());
	damage(*state, "damaged.igs", 1);
	damage(*state, "damaged.step", 2);
}

struct passage {
	const batten_surface *surface;
	const char *path;
};

static batten_status write_once(batten_context *context, void *user)
{
	const struct passage *p = user;
	const batten_status status = batten_surfaces_write(context, 1, &p->surface, p->path);
	assert_int_equal(access(p->path, F_OK) == 0, status == BATTEN_OK);
	return status;
}

static batten_status read_once(batten_context *context, void *user)
{
	const struct passage *p = user;
	batten_surfaces *list = NULL;
	const batten_status status = batten_surfaces_read(context, p->path, &list);
	assert_int_equal(list != NULL, status == BATTEN_OK);
	batten_surfaces_destroy(list);
	return status;
}

/* Every allocation of a reading and a writing fails once. */
static void test_memory(void **state)
{
	fixture *f = *state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_surface *surface = make_one(f, "one", 2, 0);
	struct passage passage = { surface, path_of(f, "memory.igs") };
	const size_t written = failing_heap_each(&heap, context, write_once, &passage);
	assert_true(written > 0 && written < 100);
	const size_t read = failing_heap_each(&heap, context, read_once, &passage);
	assert_true(read > 0 && read < 100);
	failing_heap_close(&heap, context);
	batten_surface_destroy(surface);
	assert_int_equal(unlink(passage.path), 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_fixture, end_fixture)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(test_round_trips),     TEST(test_smallest_and_json), TEST(test_units),
		TEST(test_refused_patches), TEST(test_other_entities),    TEST(test_foreign_files),
		TEST(test_refused_writes),  TEST(test_missing_module),    TEST(test_damage),
		TEST(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
