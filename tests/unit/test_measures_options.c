/* Names, options and errors of the measures, what does not exist, closeness, lack of memory. */
#include "support/failing_heap.h"
#include "unit/measures_fixture.h"

static const batten_quadrature spline = BATTEN_QUADRATURE_SPLINE;

static double wigley(double x, double z)
{
	double s = x / 100, t = 1 - z / 6.25;
	return 5 * 4 * s * (1 - s) * (1 - t * t);
}

static double wedge(double x, double z)
{
	(void)x;
	return 5 * z / 4;
}

static void names(void **state)
{
	(void)state;
	assert_string_equal(batten_measure_name(0), "lbp_m");
	assert_string_equal(batten_measure_name(6), "volume_m3");
	assert_string_equal(batten_measure_name(BATTEN_MEASURE_COUNT - 1), "inflections");
	assert_int_equal(offsetof(batten_measures, volume_m3), 6 * sizeof(double));
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++) {
		assert_true(strlen(batten_measure_text(i)) > 3);
		for (size_t k = 0; k < i; k++)
			assert_string_not_equal(batten_measure_name(i), batten_measure_name(k));
	}
	assert_null(batten_measure_name(BATTEN_MEASURE_COUNT));
	assert_null(batten_measure_text(BATTEN_MEASURE_COUNT));
}

static double nothing(double x, double z)
{
	(void)x;
	(void)z;
	return 0;
}

static double outside(double x, double z)
{
	(void)x;
	(void)z;
	return NAN;
}

static void what_does_not_exist_is_nan(void **state)
{
	(void)state;
	form *const forms[] = { nothing, outside };
	for (size_t k = 0; k < 2; k++) {
		batten_measures m = measure_form(forms[k], 10, 1, 5, 5, spline, 0);
		assert_true(m.volume_m3 == 0 && m.waterplane_area_m2 == 0 && m.noise_m == 0);
		assert_true(isnan(m.cb) && isnan(m.cp) && isnan(m.cwp) && isnan(m.kb_m) && isnan(m.bmt_m));
		assert_true(isnan(m.lcb_pct_lbp_fwd) && isnan(m.xcf_from_ap_m) && isnan(m.i_l_m4));
	}
	batten_measures m = measure_form(outside, 10, 1, 5, 5, spline, 0);
	assert_true(isnan(m.lwl_m) && isnan(m.beam_wl_m) && isnan(m.fn_per_m2));
	assert_true(isnan(m.energy_bending) && isnan(m.midship_area_m2));
	/* too few stations for any second difference along them */
	m = measure_form(wedge, 60, 4, 2, 3, spline, 0);
	assert_true(isnan(m.fn_per_m2) && !isnan(m.fn_sections_per_m2) && isnan(m.energy_bending));
	assert_relative(m.volume_m3, 60 * 10 * 4 / 2.0, 1e-12);
}

static void wrong_options(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 21, 10);
	batten_measures m = { .lbp_m = -1 };
	batten_measure_options good, options;
	batten_measure_options_default(&good);
	assert_true(good.density_t_per_m3 == 1.025 && good.draft_m == 0);
	static const double drafts[] = { 6.2501, 1e9, -1, NAN, INFINITY };
	for (size_t k = 0; k < 5; k++) {
		options = good;
		options.draft_m = drafts[k];
		assert_int_equal(batten_hull_measure(context, hull, &options, &m), BATTEN_USAGE);
	}
	options = good;
	options.density_t_per_m3 = 0;
	assert_int_equal(batten_hull_measure(context, hull, &options, &m), BATTEN_USAGE);
	options = good;
	options.quadrature = (batten_quadrature)7;
	assert_int_equal(batten_hull_measure(context, hull, &options, &m), BATTEN_USAGE);
	options = good;
	options.struct_size = 3;
	assert_int_equal(batten_hull_measure(context, hull, &options, &m), BATTEN_USAGE);
	options = good;
	options.quadrature = BATTEN_QUADRATURE_SIMPSON; /* nine intervals */
	assert_int_equal(batten_hull_measure(context, hull, &options, &m), BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(context), "even number"));
	assert_true(m.lbp_m == -1);
	options = good;
	options.draft_m = 6.25 * (1 + 1e-15);
	assert_int_equal(batten_hull_measure(context, hull, &options, &m), BATTEN_OK);
	assert_int_equal(batten_hull_measure(context, hull, NULL, &m), BATTEN_OK);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static void closeness(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_hull *before = make_hull(context, wigley, 100, 6.25, 21, 11), *after = NULL;
	assert_int_equal(batten_hull_clone(context, before, &after), BATTEN_OK);
	double y[21 * 11];
	memcpy(y, batten_hull_y_m(before), sizeof y);
	y[5 * 21 + 10] += 0.25;
	y[10 * 21 + 3] -= 0.125;
	assert_int_equal(batten_hull_set_y(context, after, y), BATTEN_OK);
	batten_closeness close;
	assert_int_equal(batten_hull_closeness(context, after, before, &close), BATTEN_OK);
	assert_relative(close.cn_max_m, 0.25, 1e-12);
	assert_relative(close.cn_pct, 5, 1e-12);
	/* 19 stations and 10 waterlines are positive */
	assert_relative(close.cn_rms_m, sqrt((0.0625 + 0.015625) / 190), 1e-12);
	/* the waterline at the top has half a spacing */
	assert_relative(close.closeness_m4, 5 * 0.625 * (0.0625 + 0.015625 / 2), 1e-12);
	assert_int_equal(batten_hull_closeness(context, before, before, &close), BATTEN_OK);
	assert_true(close.cn_pct == 0 && close.cn_rms_m == 0 && close.closeness_m4 == 0);
	batten_hull *other = make_hull(context, wigley, 100, 6.25, 11, 11);
	assert_int_equal(batten_hull_closeness(context, other, before, &close), BATTEN_USAGE);
	batten_hull_destroy(other);
	batten_hull_destroy(after);
	batten_hull_destroy(before);
	batten_context_destroy(context);
}

static batten_status measure_once(batten_context *context, void *user)
{
	batten_measures m = { .lbp_m = -1 };
	const batten_status status = batten_hull_measure(context, user, NULL, &m);
	assert_true(status == BATTEN_OK || m.lbp_m == -1);
	return status;
}

static batten_status cut_once(batten_context *context, void *user)
{
	batten_line lines[64];
	size_t count = 0;
	const batten_status status = batten_hull_lines(context, user, user, lines, 64, &count);
	assert_true(status == BATTEN_OK || count == 0);
	return status;
}

/* Whichever allocation fails, the call says so, keeps nothing and leaves its result alone. */
static void out_of_memory(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 7, 6);
	assert_true(failing_heap_each(&heap, context, measure_once, hull) > 100);
	assert_true(failing_heap_each(&heap, context, cut_once, hull) > 0);
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(names),         cmocka_unit_test(what_does_not_exist_is_nan),
		cmocka_unit_test(wrong_options), cmocka_unit_test(closeness),
		cmocka_unit_test(out_of_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
