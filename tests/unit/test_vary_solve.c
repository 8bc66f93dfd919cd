/* Form-parameter design: targets met by parameters of methods. */
#include "support/failing_heap.h"
#include "unit/vary_fixture.h"

#define RANGE .least = NAN, .most = NAN

static double measure_named(const batten_measures *measures, const char *name)
{
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++)
		if (strcmp(batten_measure_name(i), name) == 0)
			return ((const double *)measures)[i];
	fail_msg("no measure %s", name);
	return NAN;
}

static batten_hull *solve(batten_context *context, const batten_hull *parent, size_t count,
                          const batten_solve_target *targets,
                          const batten_solve_parameter *parameters, batten_vary_outcome *outcome)
{
	batten_hull *variant = NULL;
	if (batten_hull_solve(context, parent, count, targets, parameters, &variant, outcome) !=
	    BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	const batten_measures measures = measures_of(context, variant);
	assert_int_equal(outcome->target_count, count);
	assert_int_equal(outcome->parameter_count, count);
	for (size_t i = 0; i < count; i++) {
		assert_near(measure_named(&measures, targets[i].measure), targets[i].value, 1e-6,
		            targets[i].measure);
		assert_near(outcome->targets[i].got, targets[i].value, 1e-6, "got");
		assert_true(outcome->targets[i].asked == targets[i].value);
		assert_string_equal(outcome->targets[i].name, targets[i].measure);
		assert_string_equal(outcome->parameters[i].name, parameters[i].name);
	}
	return variant;
}

/* Every measure that is spoken of, on every hull the methods take. */
static void test_targets(void **state)
{
	static const batten_solve_parameter scale[] = {
		{ "affine.x", RANGE },
		{ "affine.y", RANGE },
		{ "affine.z", RANGE },
	};
	static const batten_solve_parameter form[] = {
		{ "affine.x", RANGE },     { "affine.y", RANGE },      { "nonlinear.u-ness", RANGE },
		{ "lackenby.dcp", RANGE }, { "lackenby.dlcb", RANGE },
	};
	static const batten_solve_parameter moor[] = {
		{ "moor.dcb", RANGE },
		{ "moor.dlcb", RANGE },
		{ "moor.dcwp", RANGE },
		{ "moor.dlcf", RANGE },
	};
	batten_vary_outcome outcome;
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	const batten_measures p = measures_of(*state, hull);
	const batten_solve_target main_dimensions[] = { { "lbp_m", 33 },
		                                            { "beam_wl_m", 6 },
		                                            { "draft_m", 2.7 } };
	batten_hull *variant = solve(*state, hull, 3, main_dimensions, scale, &outcome);
	assert_near(parameter(&outcome, "affine.z"), 2.7 / 2.515, 1e-9, "affine.z");
	batten_hull_destroy(variant);
	const batten_solve_target coefficients[] = { { "volume_m3", 1.1 * p.volume_m3 },
		                                         { "beam_wl_m", 6.2 },
		                                         { "cm", p.cm + 0.01 },
		                                         { "cb", p.cb + 0.01 },
		                                         { "lcb_pct_lbp_fwd", -1 } };
	variant = solve(*state, hull, 5, coefficients, form, &outcome);
	batten_hull_destroy(variant);
	const batten_solve_target planes[] = { { "cp", 1.02 * p.cp },
		                                   { "lcb_pct_lbp_fwd", -1 },
		                                   { "cwp", 1.01 * p.cwp },
		                                   { "lcf_pct_lbp_fwd", -3.7 } };
	variant = solve(*state, hull, 4, planes, moor, &outcome);
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

/* One method's own iteration and the solve with its parameters end at one hull. */
static void test_same_as_method(void **state)
{
	static const batten_solve_parameter parameters[] = { { "lackenby.dlcb", RANGE },
		                                                 { "lackenby.dcp", RANGE } };
	batten_hull *hull = read_hull(*state, "npl_parent");
	batten_vary_options options = method(BATTEN_VARY_LACKENBY);
	options.dcp_pct = 3;
	options.dlcb_pct = 0.5;
	batten_vary_outcome outcome;
	batten_hull *expected = vary(*state, hull, &options, &outcome);
	const batten_solve_target targets[] = { { "lcb_pct_lbp_fwd", outcome.targets[1].asked },
		                                    { "cp", outcome.targets[0].asked } };
	batten_hull *variant = solve(*state, hull, 2, targets, parameters, &outcome);
	for (size_t i = 0; i < batten_hull_station_count(hull) * batten_hull_waterline_count(hull); i++)
		assert_near(batten_hull_y_m(variant)[i], batten_hull_y_m(expected)[i], 1e-8, "y");
	batten_hull_destroy(variant);
	batten_hull_destroy(expected);
	batten_hull_destroy(hull);
}

/* Wetted surface over the root of volume and length is least at some breadth: two breadths, one or
 * none have what is asked for. */
static void test_several_and_none(void **state)
{
	const batten_solve_parameter breadth = { "affine.y", 0.5, 4 };
	batten_hull *hull = read_hull(*state, "wigley"), *variant = NULL;
	batten_vary_outcome outcome;
	batten_solve_target target = { "cws", 2.7 };
	const batten_measures p = measures_of(*state, hull);
	target.value = p.cws;
	variant = solve(*state, hull, 1, &target, &breadth, &outcome);
	assert_near(outcome.parameters[0].value, 1, 1e-6, "the parent itself");
	assert_non_null(strstr(outcome.warning, "2 solutions"));
	const char *second = strstr(outcome.warning, "affine.y ");
	assert_non_null(second);
	const double other = strtod(second + strlen("affine.y "), NULL);
	batten_hull_destroy(variant);
	batten_vary_options options = method(BATTEN_VARY_AFFINE);
	options.scale_y = other;
	variant = vary(*state, hull, &options, NULL);
	assert_true(fabs(other - 1) > 0.1);
	const batten_measures q = measures_of(*state, variant);
	assert_near(q.cws, p.cws, 1e-4, "the other solution as printed");
	batten_hull_destroy(variant);
	target.value = 0.7 * p.cws;
	variant = NULL;
	assert_int_equal(batten_hull_solve(*state, hull, 1, &target, &breadth, &variant, &outcome),
	                 BATTEN_INPUT);
	assert_null(variant);
	assert_non_null(strstr(outcome.reason, "no solution found within the ranges; nearest comes "
	                                       "affine.y"));
	batten_hull_destroy(hull);
}

static void refuse(batten_context *context, const batten_hull *hull, size_t count,
                   const batten_solve_target *targets, const batten_solve_parameter *parameters,
                   const char *part)
{
	batten_hull *variant = NULL;
	batten_vary_outcome outcome;
	assert_int_equal(
		batten_hull_solve(context, hull, count, targets, parameters, &variant, &outcome),
		BATTEN_USAGE);
	assert_null(variant);
	assert_int_equal(outcome.status, BATTEN_USAGE);
	if (!strstr(outcome.reason, part))
		fail_msg("'%s', expected '%s'", outcome.reason, part);
}

static void test_refusals(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	const batten_solve_target good[] = { { "cb", 0.5 }, { "cp", 0.6 } };
	const batten_solve_parameter by[] = { { "affine.y", RANGE }, { "affine.x", RANGE } };
	refuse(*state, hull, 0, good, by, "solve for 0 targets");
	refuse(*state, hull, 9, good, by, "solve for 9 targets");
	refuse(*state, hull, 2, NULL, by, "solve for 2 targets");
	refuse(*state, hull, 2, (const batten_solve_target[]){ { "cb", 1 }, { "noise_m", 1 } }, by,
	       "target 'noise_m'");
	refuse(*state, hull, 2, (const batten_solve_target[]){ { "cb", 1 }, { NULL, 1 } }, by,
	       "target ''");
	refuse(*state, hull, 2, (const batten_solve_target[]){ { "cb", 1 }, { "cb", 2 } }, by,
	       "target cb is given twice");
	refuse(*state, hull, 1, (const batten_solve_target[]){ { "cb", NAN } }, by, "target cb is nan");
	refuse(*state, hull, 1, good, (const batten_solve_parameter[]){ { "affine.w", RANGE } },
	       "parameter 'affine.w'");
	refuse(*state, hull, 2, good,
	       (const batten_solve_parameter[]){ { "affine.y", RANGE }, { "affine.y", RANGE } },
	       "parameter affine.y is given twice");
	refuse(*state, hull, 1, good, (const batten_solve_parameter[]){ { "affine.y", 2, 1 } },
	       "affine.y from 2 to 1");
	/* a range without any variant in it: the reason says why there is none */
	batten_hull *variant = NULL;
	assert_int_equal(batten_hull_solve(*state, hull, 1, good,
	                                   &(const batten_solve_parameter){ "affine.y", -2, -1 },
	                                   &variant, NULL),
	                 BATTEN_INPUT);
	assert_non_null(
		strstr(batten_context_error(*state), "no variant anywhere in the ranges (scale_y"));
	batten_hull_destroy(hull);
}

static void test_names(void **state)
{
	(void)state;
	double least, most, none;
	size_t count = 0;
	for (const char *name; (name = batten_solve_parameter_name(count, &least, &most, &none));
	     count++)
		assert_true(strchr(name, '.') && least < most && none >= least && none <= most);
	assert_int_equal(count, 19);
}

static batten_status solve_once(batten_context *context, void *user)
{
	static const batten_solve_parameter by[] = { { "affine.y", 0.9, 1.2 },
		                                         { "affine.x", 0.9, 1.2 } };
	const batten_solve_target targets[] = { { "beam_wl_m", 1.7 }, { "lbp_m", 15 } };
	batten_hull *variant = NULL;
	const batten_status status = batten_hull_solve(context, user, 2, targets, by, &variant, NULL);
	assert_int_equal(variant != NULL, status == BATTEN_OK);
	batten_hull_destroy(variant);
	return status;
}

/* An allocation that fails anywhere on the way ends the search, and nothing is kept. (All of them, one
 * after another, would be some 1e5 searches.) */
static void test_memory(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_hull *hull = read_hull(context, "wigley");
	const size_t before = heap.live;
	for (size_t at = 1; at < 20000; at += at / 3 + 1) {
		heap.count = 0;
		heap.fail_at = at;
		assert_int_equal(solve_once(context, hull), BATTEN_MEMORY);
		assert_int_equal(heap.live, before);
	}
	heap.fail_at = 0;
	assert_int_equal(solve_once(context, hull), BATTEN_OK);
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_targets, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_same_as_method, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_several_and_none, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test(test_names),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
