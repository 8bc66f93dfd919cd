/* Many surfaces of one topology afloat: those of each by itself, closed forms, bits alike in every
 * shape. */
#include "unit/hydrostatics_fixture.h"

#include <stdio.h>

enum { SURFACES = 11, DRAFTS = 4, POLES_MOST = 256 };

static double chance(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

/* Surfaces of one topology and drafts for them. */
struct family {
	size_t count;
	batten_surface *surfaces[SURFACES];
	const batten_surface *list[SURFACES];
	double drafts[DRAFTS];
};

/* One surface and others like it: poles off the edges moved by some percent of the draft; round bodies only
 * wider or narrower, as their parts meet smoothly. Takes it over. */
static struct family make_family(batten_context *context, batten_surface *first, double draft)
{
	struct family f = { SURFACES, { first }, { first }, { draft, 0.36, 0.1, 0.7 } };
	const batten_surface_net net = batten_surface_describe(first);
	uint32_t state = 11;
	for (size_t d = 1; d < DRAFTS; d++)
		f.drafts[d] *= draft;
	for (size_t k = 1; k < SURFACES; k++) {
		double poles[3 * POLES_MOST];
		batten_surface_net other = net;
		assert_true(net.count_u * net.count_v <= POLES_MOST);
		const double wider = 1 + 0.1 * chance(&state);
		for (size_t n = 0; n < net.count_u * net.count_v; n++) {
			const size_t i = n % net.count_u, j = n / net.count_u;
			const bool moves = i > 0 && i + 1 < net.count_u && j > 0 && j + 1 < net.count_v &&
			                   !net.weights;
			for (size_t c = 0; c < 3; c++)
				poles[3 * n + c] = net.poles_m[3 * n + c] * (net.weights && c == 1 ? wider : 1) +
				                   (moves ? 0.02 * draft * chance(&state) : 0);
		}
		other.poles_m = poles;
		f.list[k] = f.surfaces[k] = make_surface(context, &other);
	}
	return f;
}

static struct family fitted_family(batten_context *context, const char *name)
{
	char path[4096];
	batten_hull *hull = NULL;
	batten_surface *first = NULL;
	batten_fit_options options;
	batten_fit_options_default(&options);
	options.count_u = 9;
	options.count_v = 6;
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	assert_int_equal(batten_hull_read(context, path, &hull), BATTEN_OK);
	if (batten_hull_fit(context, hull, &options, &first, NULL) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	const double draft = batten_hull_draft_m(hull);
	batten_hull_destroy(hull);
	return make_family(context, first, draft);
}

static void end_family(struct family *f)
{
	for (size_t k = 0; k < f->count; k++)
		batten_surface_destroy(f->surfaces[k]);
}

static void run(batten_context *context, const struct family *f, int device, unsigned lanes,
                unsigned group, size_t first, size_t count, batten_hydrostatics *out,
                batten_run *told)
{
	batten_batch_options options;
	batten_batch_options_default(&options);
	options.device = device;
	options.lanes = lanes;
	options.work_group = group;
	if (batten_surface_hydrostatics_batch(context, count, f->list + first, NULL, &options, DRAFTS,
	                                      f->drafts, out, NULL, told) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
}

static void assert_alike(const batten_hydrostatics *found, const batten_hydrostatics *known,
                         const char *name, size_t which)
{
	const double *a = (const double *)found, *b = (const double *)known;
	for (size_t i = 0; i < BATTEN_HYDROSTATICS_COUNT; i++) {
		if (isnan(a[i]) && isnan(b[i]))
			continue;
		/* percents may be nought */
		const double size = fmax(fabs(b[i]), 1e-2);
		if (!(fabs(a[i] - b[i]) <= 1e-10 * size))
			fail_msg("%s, surface %zu, draft %g: %s is %.17g, by itself %.17g", name, which,
			         known->draft_m, batten_hydrostatics_name(i), a[i], b[i]);
	}
}

static void assert_as_each_by_itself(batten_context *context, struct family f, const char *name)
{
	static batten_hydrostatics found[SURFACES * DRAFTS], known[DRAFTS];
	batten_run told;
	run(context, &f, BATTEN_DEVICE_REFERENCE, 0, 0, 0, f.count, found, &told);
	assert_string_equal(told.warning, "");
	for (size_t k = 0; k < f.count; k++) {
		assert_int_equal(
			batten_surface_hydrostatics(context, f.list[k], NULL, DRAFTS, f.drafts, known),
			BATTEN_OK);
		for (size_t d = 0; d < DRAFTS; d++)
			assert_alike(&found[k * DRAFTS + d], &known[d], name, k);
	}
	end_family(&f);
}

static void test_agrees_with_each_by_itself(void **state)
{
	(void)state;
	batten_context *context = make_context();
	assert_as_each_by_itself(context, fitted_family(context, "bsra_trawler"), "trawler");
	assert_as_each_by_itself(context, fitted_family(context, "npl_parent"), "npl");
	assert_as_each_by_itself(
		context, make_family(context, ellipsoid_surface(context, 100, 10, 6), 6), "ellipsoid");
	assert_as_each_by_itself(
		context, make_family(context, wigley_surface(context, 100, 10, 6.25), 6.25), "wigley");
	batten_context_destroy(context);
}

/* Wigley's hull and half an ellipsoid, both stretched from row to row: volumes and waterplanes by formula
 * (Letcher 4.1, 9.4, 10.1). */
static void test_closed_forms(void **state)
{
	(void)state;
	enum { ROWS = 5 };
	const double half_pi = 0.5 * pi, draft = 6.25;
	batten_context *context = make_context();
	for (int round = 0; round < 2; round++) {
		batten_surface *list[ROWS];
		batten_hydrostatics found[ROWS];
		for (int k = 0; k < ROWS; k++)
			list[k] = round ? ellipsoid_surface(context, 100 + 3 * k, 10 + k, draft)
			                : wigley_surface(context, 100 + 3 * k, 10 + k, draft);
		assert_int_equal(
			batten_surface_hydrostatics_batch(context, ROWS, (const batten_surface *const *)list,
		                                      NULL, NULL, 1, &draft, found, NULL, NULL),
			BATTEN_OK);
		for (int k = 0; k < ROWS; k++) {
			const double length = 100 + 3 * k, box = length * (10 + k),
						 within = round ? 2e-8 : 1e-12;
			assert_relative(found[k].volume_m3, box * draft * (round ? half_pi / 3 : 4.0 / 9),
			                within);
			assert_relative(found[k].waterplane_area_m2, box * (round ? half_pi / 2 : 2.0 / 3),
			                within);
			assert_relative(found[k].kb_m, draft * 0.625, within);
			assert_relative(found[k].cm, round ? pi / 4 : 2.0 / 3, within);
			assert_relative(found[k].bml_m, length * length / draft * (round ? 3.0 / 32 : 3.0 / 40),
			                within);
			assert_relative(found[k].lwl_m, length, 1e-12);
			assert_relative(found[k].beam_max_m, 10 + k, 1e-12);
		}
		for (int k = 0; k < ROWS; k++)
			batten_surface_destroy(list[k]);
	}
	batten_context_destroy(context);
}

/* A surface that a draft is beyond says so; the others have the numbers they have without it. */
static void test_bad_rows(void **state)
{
	(void)state;
	enum { ROWS = 3 };
	const double drafts[2] = { 4, 6.5 };
	batten_context *context = make_context();
	batten_surface *surfaces[ROWS];
	batten_hydrostatics found[ROWS][2], alone[2];
	batten_afloat_result results[ROWS];
	for (int k = 0; k < ROWS; k++)
		surfaces[k] = wigley_surface(context, 100, 10, k == 1 ? 6.25 : 7 + k);
	const batten_surface *const *list = (const batten_surface *const *)surfaces;
	assert_int_equal(batten_surface_hydrostatics_batch(context, ROWS, list, NULL, NULL, 2, drafts,
	                                                   found[0], results, NULL),
	                 BATTEN_OK);
	assert_true(results[0].status == BATTEN_OK && results[2].status == BATTEN_OK);
	assert_string_equal(results[0].reason, "");
	assert_int_equal(results[1].status, BATTEN_USAGE);
	assert_string_equal(results[1].reason,
	                    "draft 6.5 m: the hull goes from 0 to 6.25 m, expected a draft within it");
	assert_true(isnan(found[1][0].volume_m3) && isnan(found[1][1].lbp_m));
	assert_int_equal(batten_surface_hydrostatics_batch(context, 1, list + 2, NULL, NULL, 2, drafts,
	                                                   alone, NULL, NULL),
	                 BATTEN_OK);
	assert_memory_equal(found[2], alone, sizeof alone);
	/* without results it is the error of the batch */
	assert_int_equal(batten_surface_hydrostatics_batch(context, ROWS, list, NULL, NULL, 2, drafts,
	                                                   found[0], NULL, NULL),
	                 BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(context), "6.25"));
	/* another topology, no numbers for drafts */
	batten_surface *box = ellipsoid_surface(context, 100, 10, 6);
	const batten_surface *unlike[2] = { surfaces[0], box };
	assert_int_equal(batten_surface_hydrostatics_batch(context, 2, unlike, NULL, NULL, 1, drafts,
	                                                   alone, NULL, NULL),
	                 BATTEN_USAGE);
	const double none = NAN;
	assert_int_equal(batten_surface_hydrostatics_batch(context, 1, list, NULL, NULL, 1, &none,
	                                                   alone, NULL, NULL),
	                 BATTEN_USAGE);
	batten_surface_destroy(box);
	for (int k = 0; k < ROWS; k++)
		batten_surface_destroy(surfaces[k]);
	batten_context_destroy(context);
}

static void test_bits_in_every_shape(void **state)
{
	(void)state;
	static const unsigned lanes[] = { 8, 1 }, groups[] = { 1, 7 };
	static batten_hydrostatics known[SURFACES * DRAFTS], found[SURFACES * DRAFTS];
	batten_context *context = make_context();
	struct family f = fitted_family(context, "bsra_trawler");
	batten_run told;
	run(context, &f, BATTEN_DEVICE_REFERENCE, 0, 0, 0, SURFACES, known, &told);
	for (size_t k = 0; k < sizeof lanes / sizeof lanes[0]; k++) {
		memset(found, 0, sizeof found);
		run(context, &f, 0, lanes[k], groups[k], 0, SURFACES, found, &told);
		assert_true(told.strict);
		assert_memory_equal(found, known, sizeof found);
	}
	/* one after the other, the last first */
	for (size_t h = SURFACES; h-- > 0;)
		run(context, &f, BATTEN_DEVICE_AUTO, 0, 0, h, 1, found + h * DRAFTS, &told);
	assert_memory_equal(found, known, sizeof found);
	end_family(&f);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_agrees_with_each_by_itself),
		cmocka_unit_test(test_closed_forms),
		cmocka_unit_test(test_bad_rows),
		cmocka_unit_test(test_bits_in_every_shape),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
