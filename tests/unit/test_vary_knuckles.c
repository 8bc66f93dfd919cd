/* Knuckles when sections move: no spline runs across one, and chines go with their sections. */
#include "hull/hull.h"
#include "unit/vary_fixture.h"
#include "variation/variation.h"

/* Waterlines of half-breadth 1 up to x = 6 (the topmost grows by 1/100, so that there is no parallel
 * body), then straight to 0 at x = 10, broken there where marked;
 * a chine along the stations 2 to 8 at z = 0.3 + 0.05 x. */
static batten_hull *make_hull(batten_context *context, bool marked)
{
	char text[8192];
	size_t used = 0;
#define ADD(...) used += (size_t)snprintf(text + used, sizeof text - used, __VA_ARGS__)
	ADD("# batten-offsets: 1\n# name: wedge\n# unit: m\n# frame: ap-fwd\n# lbp: 10\n# draft: 1\n"
	    "# layout: grid\nz\\x");
	for (int x = 0; x <= 10; x++)
		ADD(",%d", x);
	for (int w = 0; w <= 4; w++) {
		ADD("\n%g", 0.25 * w);
		for (int x = 0; x <= 10; x++)
			ADD(",%g", x == 0 ? 0 : x <= 6 ? 1 + (w == 4 ? 0.01 * x : 0) : 1 - 0.25 * (x - 6));
	}
	ADD("\n");
	for (int w = 0; marked && w <= 4; w++)
		ADD("knuckle,waterline,6,%g\n", 0.25 * w);
	for (int w = 0; marked && w <= 4; w++)
		ADD("knuckle,waterline,1,%g\n", 0.25 * w);
	for (int x = 2; marked && x <= 8; x++)
		ADD("knuckle,station,%d,%.17g\n", x, 0.3 + 0.05 * x);
#undef ADD
	batten_hull *hull = NULL;
	if (batten_hull_parse(context, "wedge.csv", text, used, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

/* Largest difference from 1 of the half-breadths between x = 1 and 6, as far as they stay there. */
static double ripple(const batten_hull *variant)
{
	double most = 0;
	for (size_t s = 2; s <= 5; s++)
		most = fmax(most, fabs(batten_hull_y_m(variant)[s] - 1));
	return most;
}

static void test_waterlines(void **state)
{
	for (int m = BATTEN_VARY_SWING; m <= BATTEN_VARY_LACKENBY; m += BATTEN_VARY_LACKENBY) {
		batten_hull *marked = make_hull(*state, true), *plain = make_hull(*state, false);
		batten_vary_options options = method((batten_vary_method)m);
		options.dlcb_pct = 0.5;
		options.first_pass = true;
		batten_hull *straight = vary(*state, marked, &options, NULL);
		batten_hull *bent = vary(*state, plain, &options, NULL);
		assert_true(ripple(straight) < 1e-15);
		assert_true(ripple(bent) > 1e-5);
		/* the knuckle went along */
		for (size_t i = 0; i < marked->knuckle_count; i++)
			if (marked->knuckles[i].on_waterline && marked->knuckles[i].x_m > 5)
				assert_true(straight->knuckles[i].x_m > 6.01 && straight->knuckles[i].x_m < 7);
		batten_hull_destroy(bent);
		batten_hull_destroy(straight);
		batten_hull_destroy(plain);
		batten_hull_destroy(marked);
	}
}

/* The chine of the station at x comes from where its section comes from: up or down by the slope of
 * the chine times what the section moved. */
static void test_chines(void **state)
{
	batten_hull *hull = make_hull(*state, true);
	for (int m = BATTEN_VARY_SWING; m <= BATTEN_VARY_LACKENBY; m += BATTEN_VARY_LACKENBY) {
		batten_vary_options options = method((batten_vary_method)m);
		options.dlcb_pct = 0.5;
		options.first_pass = true;
		batten_hull *variant = vary(*state, hull, &options, NULL);
		size_t found = 0;
		for (size_t i = 0; i < variant->knuckle_count; i++) {
			const hull_knuckle *now = &variant->knuckles[i], *then = &hull->knuckles[i];
			if (now->on_waterline)
				continue;
			found++;
			assert_true(now->x_m == then->x_m);
			/* sections move forward, the chine rises so: what comes is lower */
			if (m == BATTEN_VARY_SWING && now->x_m > 2.5 && now->x_m < 7.5)
				assert_true(now->z_m < then->z_m - 1e-4);
			assert_near(now->z_m, then->z_m, 0.05, "chine");
		}
		assert_int_equal(found, 7);
		batten_hull_destroy(variant);
	}
	/* a chine that is straight and moved as far everywhere: exact */
	double at[11], wanted[11];
	batten_hull *variant = NULL;
	for (size_t s = 0; s < 11; s++) {
		wanted[s] = (double)s;
		at[s] = (double)s + 0.5;
	}
	assert_int_equal(batten_hull_clone(*state, hull, &variant), BATTEN_OK);
	assert_int_equal(variation_carry_chines(hull, at, wanted, variant), BATTEN_OK);
	for (size_t i = 0; i < variant->knuckle_count; i++) {
		const hull_knuckle *now = &variant->knuckles[i];
		if (!now->on_waterline)
			assert_near(now->z_m, 0.3 + 0.05 * fmax(now->x_m - 0.5, 2), 1e-14, "chine");
	}
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_waterlines, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_chines, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
