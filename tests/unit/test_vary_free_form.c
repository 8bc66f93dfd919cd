/* Free-form deformation: lattices, their files, and hulls that they displace. */
#include "unit/vary_fixture.h"

#include <unistd.h>

/* Poles moved by an affine map move everything by it, the table included. */
static void test_affine(void **state)
{
	static const char *const hulls[] = { "bsra_trawler", "npl_parent", "highspeed_craft" };
	const double by[3] = { 0.25, -0.1, 0.5 };
	for (size_t h = 0; h < 3; h++) {
		batten_hull *hull = read_hull(*state, hulls[h]);
		batten_vary_options options = method(BATTEN_VARY_FREE_FORM);
		batten_lattice *lattice = affine_lattice(*state, hull, by);
		options.lattice = lattice;
		batten_hull *variant = vary(*state, hull, &options, NULL);
		options = method(BATTEN_VARY_AFFINE);
		options.scale_x = 1 + by[0];
		options.scale_y = 1 + by[1];
		options.scale_z = 1 + by[2];
		batten_hull *expected = vary(*state, hull, &options, NULL);
		const size_t stations = batten_hull_station_count(hull);
		const size_t waterlines = batten_hull_waterline_count(hull);
		const double near = 1e-13 * batten_hull_lbp_m(hull);
		for (size_t s = 0; s < stations; s++)
			assert_near(batten_hull_x_m(variant)[s], batten_hull_x_m(expected)[s], near, "x");
		for (size_t w = 0; w < waterlines; w++)
			assert_near(batten_hull_z_m(variant)[w], batten_hull_z_m(expected)[w], near, "z");
		assert_memory_equal(batten_hull_nodes(variant), batten_hull_nodes(expected),
		                    stations * waterlines);
		for (size_t i = 0; i < stations * waterlines; i++)
			assert_near(batten_hull_y_m(variant)[i], batten_hull_y_m(expected)[i], near, "y");
		assert_near(batten_hull_lbp_m(variant), batten_hull_lbp_m(hull), 0, "LBP");
		batten_hull_destroy(expected);
		batten_hull_destroy(variant);
		batten_lattice_destroy(lattice);
		batten_hull_destroy(hull);
	}
}

/* One inner pole of a lattice moved outward: what is far away does not change, what is near grows. */
static void test_local(void **state)
{
	static double shift[5 * 4 * 5 * 3];
	batten_lattice_net net = { .from_m = { 18, 0, 0.2 },
		                       .to_m = { 30, 4, 2.4 },
		                       .count = { 5, 4, 5 },
		                       .order = { 4, 3, 4 },
		                       .shift_m = shift };
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	memset(shift, 0, sizeof shift);
	shift[3 * ((2 * 4 + 1) * 5 + 2) + 1] = 0.5;
	shift[3 * ((2 * 4 + 2) * 5 + 2) + 1] = 0.5;
	batten_lattice *lattice = NULL;
	assert_int_equal(batten_lattice_create(*state, &net, &lattice), BATTEN_OK);
	batten_vary_options options = method(BATTEN_VARY_FREE_FORM);
	options.lattice = lattice;
	batten_hull *variant = vary(*state, hull, &options, NULL);
	const size_t stations = batten_hull_station_count(hull);
	for (size_t i = 0; i < stations * 10; i++) {
		const double x = batten_hull_x_m(hull)[i % stations],
					 z = batten_hull_z_m(hull)[i / stations];
		const double y = batten_hull_y_m(hull)[i], place[3] = { x, y, z };
		const double change = batten_hull_y_m(variant)[i] - y;
		double moved[3];
		batten_lattice_shift(lattice, place, moved);
		assert_true(moved[0] == 0 && moved[2] == 0);
		if (batten_hull_nodes(hull)[i] == BATTEN_NODE_GIVEN)
			assert_true(change == (y > 0 ? (y + moved[1]) - y : 0));
		if (x <= 18 || x >= 30 || z <= 0.2 || z >= 2.4)
			assert_true(moved[1] == 0);
	}
	assert_true(offset_at(variant, 24.384, 1.006) > offset_at(hull, 24.384, 1.006) + 0.05);
	batten_hull_destroy(variant);
	batten_lattice_destroy(lattice);
	batten_hull_destroy(hull);
}

static void refuse(batten_context *context, const batten_lattice_net *net, const char *part)
{
	batten_lattice *lattice = NULL;
	assert_int_equal(batten_lattice_create(context, net, &lattice), BATTEN_USAGE);
	assert_null(lattice);
	if (!strstr(batten_context_error(context), part))
		fail_msg("'%s' was expected in '%s'", part, batten_context_error(context));
}

static void test_refusals(void **state)
{
	double shift[8 * 3] = { 0 };
	const batten_lattice_net good = {
		.to_m = { 30, 4, 2 }, .count = { 2, 2, 2 }, .order = { 2, 2, 2 }, .shift_m = shift
	};
	batten_lattice_net net = good;
	net.order[1] = 1;
	refuse(*state, &net, "along y: order 1 and 2 poles");
	net = good;
	net.count[2] = 65;
	refuse(*state, &net, "along z: order 2 and 65 poles");
	net = good;
	net.to_m[0] = 0;
	refuse(*state, &net, "along x: from 0 to 0 m");
	net = good;
	net.from_m[2] = NAN;
	refuse(*state, &net, "along z: from nan");
	net = good;
	net.shift_m = NULL;
	refuse(*state, &net, "no displacements");
	shift[3 * 6 + 2] = INFINITY;
	refuse(*state, &good, "pole 0,1,1 moves by inf m along z");
	/* a map that folds: the fore end goes where the after end is */
	batten_hull *hull = read_hull(*state, "bsra_trawler"), *variant = NULL;
	batten_vary_options options = method(BATTEN_VARY_FREE_FORM);
	assert_int_equal(batten_hull_vary(*state, hull, &options, &variant, NULL), BATTEN_USAGE);
	for (size_t i = 0; i < 8; i++)
		for (size_t c = 0; c < 3; c++)
			shift[3 * i + c] = c == 0 && i % 2 ? -31 : 0;
	batten_lattice *lattice = NULL;
	assert_int_equal(batten_lattice_create(*state, &good, &lattice), BATTEN_OK);
	options.lattice = lattice;
	assert_int_equal(batten_hull_vary(*state, hull, &options, &variant, NULL), BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(*state), "would fold the hull"));
	assert_null(variant);
	batten_lattice_destroy(lattice);
	batten_hull_destroy(hull);
}

/* ------------------------------------------------------------------------------------------------
 * Files
 * --------------------------------------------------------------------------------------------- */

#define HEAD                                                                                       \
	"{\"batten_lattice\": 1, \"unit\": \"m\", \"frame\": \"ap-fwd\", \"from\": [0, 0, 0], "        \
	"\"to\": [30, 4, 2], \"counts\": [4, 3, 2], "

static batten_status read_text(batten_context *context, const char *text, batten_lattice **out)
{
	char path[] = "/tmp/batten-lattice-XXXXXX";
	const int file = mkstemp(path);
	assert_true(file >= 0);
	assert_int_equal(write(file, text, strlen(text)), (ssize_t)strlen(text));
	assert_int_equal(close(file), 0);
	const batten_status status = batten_lattice_read(context, path, out);
	assert_int_equal(unlink(path), 0);
	return status;
}

static void test_file(void **state)
{
	batten_lattice *lattice = NULL;
	const double corner[3] = { 30, 4, 2 }, other[3] = { 0, 0, 0 };
	double shift[3];
	assert_int_equal(
		read_text(*state, HEAD "\"orders\": [4, 3, 2], \"moves\": [[3, 2, 1, 0.5, -0.25, 1e-3]]}",
	              &lattice),
		BATTEN_OK);
	batten_lattice_shift(lattice, corner, shift);
	assert_true(shift[0] == 0.5 && shift[1] == -0.25 && shift[2] == 1e-3);
	batten_lattice_shift(lattice, other, shift);
	assert_true(shift[0] == 0 && shift[1] == 0 && shift[2] == 0);
	batten_lattice_destroy(lattice);
}

static void test_bad_files(void **state)
{
	static const struct {
		const char *text, *part;
	} bad[] = {
		{ "[1]", "found an array, expected a lattice" },
		{ "{", ":1:" },
		{ HEAD "\"orders\": [4, 3, 2], \"moves\": [], \"x\": 1}", "member 'x'" },
		{ HEAD "\"orders\": [4, 3, 2]}", "moves: found nothing" },
		{ HEAD "\"orders\": [4, 3, 2], \"moves\": [[1, 2, 3]]}", "moves[0]: found 3 entries" },
		{ HEAD "\"orders\": [4, 3, 2], \"moves\": [[4, 0, 0, 1, 1, 1]]}", "moves[0][0]: found 4" },
		{ HEAD "\"orders\": [4, 3, 2], \"moves\": [[0, 0.5, 0, 1, 1, 1]]}",
		  "moves[0][1]: found 0.5" },
		{ HEAD "\"orders\": [4, 3, 2], \"moves\": [[0, 0, 0, 1, 1, 1], [0, 0, 0, 1, 1, 1]]}",
		  "moves[1]: pole 0,0,0 occurs before" },
		{ HEAD "\"orders\": [4, 3, 2], \"moves\": [[0, 0, 0, 1, 1, 1e9]]}", "pole 0,0,0 moves by" },
		{ HEAD "\"orders\": [5, 3, 2], \"moves\": []}", "along x: order 5 and 4 poles" },
		{ HEAD "\"orders\": [4, 3, 2.5], \"moves\": []}", "orders[2]: found 2.5" },
		{ HEAD "\"orders\": [4, 3], \"moves\": []}", "orders: found 2 entries" },
		{ "{\"batten_lattice\": 2}", "batten_lattice: found 2" },
		{ "{\"batten_lattice\": 1, \"unit\": \"ft\"}", "unit: found another text" },
	};
	for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
		batten_lattice *lattice = NULL;
		const batten_status status = read_text(*state, bad[i].text, &lattice);
		const char *error = batten_context_error(*state);
		if (status != BATTEN_INPUT || !strstr(error, bad[i].part) || strchr(error, '\n'))
			fail_msg("%d '%s', expected '%s'", status, error, bad[i].part);
		assert_null(lattice);
	}
	batten_lattice *lattice = NULL;
	assert_int_equal(batten_lattice_read(*state, "/none/lattice.json", &lattice), BATTEN_IO);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_affine, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_local, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_file, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_bad_files, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
