/* What variation refuses, many rows of which some fail, and memory that runs out. */
#include "support/failing_heap.h"
#include "unit/vary_fixture.h"

static void refuse(batten_context *context, const batten_hull *hull,
                   const batten_vary_options *options, batten_status status, const char *part)
{
	batten_hull *variant = NULL;
	batten_vary_outcome outcome;
	const batten_status found = batten_hull_vary(context, hull, options, &variant, &outcome);
	if (found != status || !strstr(outcome.reason, part))
		fail_msg("status %d, '%s'; expected %d, '%s'", found, outcome.reason, status, part);
	assert_null(variant);
	assert_int_equal(outcome.status, status);
	assert_null(strchr(outcome.reason, '\n'));
}

static void test_options(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	const batten_hull *const others[] = { hull, NULL };
	const double numbers[] = { 0, 0.5, 0.5 }, wild[] = { 0, NAN, 1 };
	batten_vary_options options = method(BATTEN_VARY_SWING);
	options.struct_size = 1;
	refuse(*state, hull, &options, BATTEN_USAGE, "batten_vary_options_default()");
	options = method(BATTEN_VARY_METHOD_COUNT);
	refuse(*state, hull, &options, BATTEN_USAGE, "no such method");
	double *const fields[] = { &options.dcp_pct,         &options.dlcb_pct,
		                       &options.dcwp_pct,        &options.dlcf_pct,
		                       &options.dp_fore_pct,     &options.dp_aft_pct,
		                       &options.scale_x,         &options.scale_y,
		                       &options.scale_z,         &options.volume_m3,
		                       &options.lcb_pct_lbp_fwd, &options.cp,
		                       &options.lcb_used_pct,    &options.lcf_used_pct,
		                       &options.middle_aft_m,    &options.middle_fore_m };
	for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
		for (int sign = -1; sign <= 1; sign += 2) {
			options = method(BATTEN_VARY_LACKENBY);
			*fields[i] = sign * (double)INFINITY;
			refuse(*state, hull, &options, BATTEN_USAGE, "inf, expected");
		}
	for (size_t i = 0; i < 9; i++) {
		options = method(BATTEN_VARY_LACKENBY);
		*fields[i] = NAN;
		refuse(*state, hull, &options, BATTEN_USAGE, "nan, expected");
	}
	options = method(BATTEN_VARY_AFFINE);
	options.scale_y = 0;
	refuse(*state, hull, &options, BATTEN_USAGE, "scale_y is 0");
	options = method(BATTEN_VARY_AVERAGE);
	refuse(*state, hull, &options, BATTEN_USAGE, "0 hulls");
	options.other_count = 2;
	options.others = others;
	options.weights = numbers;
	refuse(*state, hull, &options, BATTEN_USAGE, "hull 2 is missing");
	options.other_count = 1;
	options.weights = wild + 1;
	refuse(*state, hull, &options, BATTEN_USAGE, "weight 1 is nan");
	options = method(BATTEN_VARY_STRETCH);
	refuse(*state, hull, &options, BATTEN_USAGE, "0 points");
	options.point_count = 3;
	options.from_part = numbers;
	options.to_part = numbers;
	refuse(*state, hull, &options, BATTEN_USAGE, "would fold");
	options.from_part = wild;
	refuse(*state, hull, &options, BATTEN_USAGE, "parts of LBP");
	batten_hull_destroy(hull);
}

static void test_reach(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_hull *craft = read_hull(*state, "highspeed_craft");
	batten_vary_options options = method(BATTEN_VARY_LACKENBY);
	options.dcp_pct = 50;
	refuse(*state, hull, &options, BATTEN_INPUT, "cp 0.4188 to 0.7575");
	options.first_pass = true;
	refuse(*state, hull, &options, BATTEN_INPUT, "would run into each other");
	options = method(BATTEN_VARY_LACKENBY);
	options.dp_fore_pct = -10;
	refuse(*state, hull, &options, BATTEN_INPUT, "would run into each other");
	options = method(BATTEN_VARY_SWING);
	options.dlcb_pct = 40;
	refuse(*state, hull, &options, BATTEN_INPUT, "out of reach");
	options = method(BATTEN_VARY_ONE_MINUS_PRISMATIC);
	options.dcp_pct = -5;
	refuse(*state, hull, &options, BATTEN_INPUT, "out of reach");
	options = method(BATTEN_VARY_MOOR);
	options.dcwp_pct = 60;
	refuse(*state, hull, &options, BATTEN_INPUT, "out of reach");
	refuse(*state, craft, &options, BATTEN_INPUT, "end off the grid");
	options = method(BATTEN_VARY_THREE_BODY);
	refuse(*state, hull, &options, BATTEN_INPUT, "told where its middle body is");
	options.middle_aft_m = 12;
	options.middle_fore_m = 18;
	options.cp = 1;
	refuse(*state, hull, &options, BATTEN_INPUT, "out of reach");
	options = method(BATTEN_VARY_SWING);
	options.thesis = true;
	refuse(*state, craft, &options, BATTEN_INPUT, "thesis's procedure");
	const batten_hull *const others[] = { craft };
	const double half = 0.5;
	options = method(BATTEN_VARY_AVERAGE);
	options.other_count = 1;
	options.others = others;
	options.weights = &half;
	refuse(*state, hull, &options, BATTEN_INPUT, "do not correspond");
	batten_hull_destroy(craft);
	batten_hull_destroy(hull);
}

/* Parents that are nothing to move sections of. */
static void test_parents(void **state)
{
	const double x[] = { 0, 1, 2, 3, 4 }, z[] = { 0, 0.5, 1 };
	const struct {
		double lbp, draft, middle;
		const char *part;
	} cases[] = {
		{ 4, 1, 0, "a full section amidships" },
		{ 40, 1, 1, "stations on both sides" },
		{ 4, 2, 1, "draft" },
	};
	for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
		double y[15] = { 0 };
		for (size_t w = 1; w < 3; w++) {
			y[5 * w + 1] = y[5 * w + 3] = 0.6;
			y[5 * w + 2] = cases[k].middle;
		}
		const batten_hull_table table = {
			"odd", cases[k].lbp, cases[k].draft, 5, 3, x, z, y, NULL
		};
		batten_hull *hull = NULL;
		assert_int_equal(batten_hull_create(*state, &table, &hull), BATTEN_OK);
		batten_vary_options options = method(BATTEN_VARY_SWING);
		options.dlcb_pct = 1;
		refuse(*state, hull, &options, BATTEN_INPUT, cases[k].part);
		batten_hull_destroy(hull);
	}
}

static void test_warning(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_vary_options options = method(BATTEN_VARY_SWING);
	batten_vary_outcome outcome;
	options.dlcb_pct = 0.02;
	batten_hull_destroy(vary(*state, hull, &options, &outcome));
	assert_non_null(strstr(outcome.warning, "is percent what is meant?"));
	options.dlcb_pct = 1;
	batten_hull_destroy(vary(*state, hull, &options, &outcome));
	assert_string_equal(outcome.warning, "");
	/* every number of percent, on either side of 0.2 and 30 */
	options = method(BATTEN_VARY_MOOR);
	options.first_pass = true;
	double *const numbers[] = { &options.dcp_pct, &options.dlcb_pct, &options.dcwp_pct,
		                        &options.dlcf_pct };
	for (size_t i = 0; i < 4; i++)
		for (int k = 0; k < 2; k++) {
			*numbers[i] = k == 0 ? -0.19 : 0.21;
			batten_hull_destroy(vary(*state, hull, &options, &outcome));
			assert_int_equal(strstr(outcome.warning, "is percent what is meant?") != NULL, k == 0);
			*numbers[i] = 0;
		}
	options = method(BATTEN_VARY_ONE_MINUS_PRISMATIC);
	options.first_pass = true;
	batten_hull *full = read_hull(*state, "wigley");
	for (int k = 0; k < 2; k++) {
		options.dcp_pct = k == 0 ? 30.1 : 29.9;
		batten_hull_destroy(vary(*state, full, &options, &outcome));
		assert_int_equal(strstr(outcome.warning, "dcp is 30.1 percent") != NULL, k == 0);
	}
	batten_hull_destroy(full);
	batten_hull_destroy(hull);
}

/* A row that fails says why and stops no other; each is what it would be alone. */
static void test_batch(void **state)
{
	enum { ROWS = 5 };
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_vary_options options[ROWS];
	batten_hull *variants[ROWS];
	batten_vary_outcome outcomes[ROWS];
	for (size_t i = 0; i < ROWS; i++)
		options[i] = method(BATTEN_VARY_LACKENBY);
	options[0].dcp_pct = 5;
	options[1].dcp_pct = 50;
	options[2].scale_x = NAN;
	options[3].dlcb_pct = 1;
	options[3].thesis = true;
	options[4] = method(BATTEN_VARY_AFFINE);
	assert_int_equal(batten_hull_vary_batch(*state, hull, ROWS, options, variants, outcomes),
	                 BATTEN_INCOMPLETE);
	assert_non_null(strstr(batten_context_error(*state), "2 of 5"));
	for (size_t i = 0; i < ROWS; i++) {
		const bool fails = i == 1 || i == 2;
		assert_int_equal(outcomes[i].status, i == 1   ? BATTEN_INPUT
		                                     : i == 2 ? BATTEN_USAGE
		                                              : BATTEN_OK);
		assert_int_equal(outcomes[i].reason[0] != '\0', fails);
		assert_int_equal(variants[i] == NULL, fails);
		if (fails)
			continue;
		batten_hull *alone = vary(*state, hull, &options[i], NULL);
		const size_t size = batten_hull_station_count(hull) * batten_hull_waterline_count(hull) *
		                    sizeof(double);
		assert_memory_equal(batten_hull_y_m(alone), batten_hull_y_m(variants[i]), size);
		batten_hull_destroy(alone);
		batten_hull_destroy(variants[i]);
	}
	assert_int_equal(batten_hull_vary_batch(*state, hull, 0, NULL, NULL, NULL), BATTEN_OK);
	batten_hull_destroy(hull);
}

struct variation {
	const batten_hull *hull;
	batten_vary_options options;
};

static batten_status vary_once(batten_context *context, void *user)
{
	const struct variation *v = user;
	batten_hull *variant = NULL;
	const batten_status status = batten_hull_vary(context, v->hull, &v->options, &variant, NULL);
	assert_int_equal(variant != NULL, status == BATTEN_OK);
	batten_hull_destroy(variant);
	return status;
}

static void test_memory(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_hull *hull = read_hull(context, "bsra_trawler");
	const batten_hull *const others[] = { hull };
	const double parts[] = { 0, 1 };
	batten_lattice *lattice = affine_lattice(context, hull, (const double[3]){ 0, 0, 0.1 });
	for (int m = 0; m <= BATTEN_VARY_METHOD_COUNT; m++) {
		/* the last: the thesis's procedure */
		const bool thesis = m == BATTEN_VARY_METHOD_COUNT;
		batten_vary_options options = method(thesis ? BATTEN_VARY_LACKENBY : (batten_vary_method)m);
		options.first_pass = true;
		options.thesis = thesis;
		options.dcp_pct = 3;
		options.dlcb_pct = 1;
		options.other_count = 1;
		options.others = others;
		options.weights = parts + 1;
		options.point_count = 2;
		options.from_part = options.to_part = parts;
		options.middle_aft_m = 12;
		options.middle_fore_m = 18;
		options.preset = BATTEN_VARY_RISE_OF_FLOOR;
		options.amount = 0.1;
		options.lattice = lattice;
		struct variation variation = { hull, options };
		assert_true(failing_heap_each(&heap, context, vary_once, &variation) > 20);
	}
	batten_lattice_destroy(lattice);
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_options, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_reach, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_parents, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_warning, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_batch, make_context, end_context),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
