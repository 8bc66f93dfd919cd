/* Hydrostatics of many hulls of one table: those of each by itself, bits alike in every shape. */
#include "support/kernel_compile.h"
#include "unit/vary_fixture.h"

enum { HULLS = 37, DRAFTS = 5, NODES_MOST = 4096 };

static const char *const names[] = { "bsra_trawler", "npl_parent", "highspeed_craft", "wigley",
	                                 "wigley_noisy" };

/* Hulls of one table: half-breadths off by some percent, smoothly and by chance. */
struct family {
	batten_hull *table;
	size_t nodes;
	double drafts[DRAFTS];
	double y[HULLS * NODES_MOST];
	uint8_t kind[HULLS * NODES_MOST];
};

static double chance(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

static struct family *make_family(batten_context *context, const char *name)
{
	struct family *f = calloc(1, sizeof *f);
	assert_non_null(f);
	f->table = read_hull(context, name);
	const size_t lines = batten_hull_waterline_count(f->table);
	f->nodes = batten_hull_station_count(f->table) * lines;
	assert_true(f->nodes <= NODES_MOST);
	const double low = batten_hull_z_m(f->table)[0], high = batten_hull_z_m(f->table)[lines - 1];
	static const double parts[DRAFTS] = { 1, 0.5, 0.83, 0.24, 0.7 };
	for (size_t d = 0; d < DRAFTS; d++)
		f->drafts[d] = low + parts[d] * (high - low);
	f->drafts[4] = batten_hull_z_m(f->table)[lines / 2];
	uint32_t state = 7;
	for (size_t h = 0; h < HULLS; h++) {
		const double scale = h == 0 ? 1 : 1 + 0.3 * chance(&state);
		for (size_t n = 0; n < f->nodes; n++) {
			const double noise = h == 0 ? 0 : 0.01 * chance(&state);
			f->y[h * f->nodes + n] = batten_hull_y_m(f->table)[n] * (scale + noise);
		}
		memcpy(f->kind + h * f->nodes, batten_hull_nodes(f->table), f->nodes);
	}
	return f;
}

static void end_family(struct family *f)
{
	batten_hull_destroy(f->table);
	free(f);
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
	if (batten_hull_hydrostatics_batch(context, f->table, NULL, &options, count,
	                                   f->y + first * f->nodes, f->kind + first * f->nodes, DRAFTS,
	                                   f->drafts, out, told) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
}

/* A hull of the family by itself. */
static void measure(batten_context *context, const struct family *f, size_t which,
                    batten_hydrostatics *out)
{
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_clone(context, f->table, &hull), BATTEN_OK);
	assert_int_equal(batten_hull_set_y(context, hull, f->y + which * f->nodes), BATTEN_OK);
	if (batten_hull_hydrostatics(context, hull, NULL, DRAFTS, f->drafts, out) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	batten_hull_destroy(hull);
}

static void assert_alike(const batten_hydrostatics *found, const batten_hydrostatics *known,
                         const char *name, size_t which)
{
	const double *a = (const double *)found, *b = (const double *)known;
	for (size_t i = 0; i < BATTEN_HYDROSTATICS_COUNT; i++) {
		if (isnan(a[i]) && isnan(b[i]))
			continue;
		/* percent from amidships may be nought */
		const double size = fmax(fabs(b[i]), 1e-3);
		if (!(fabs(a[i] - b[i]) <= 1e-10 * size))
			fail_msg("%s, hull %zu, draft %g: %s is %.17g, by itself %.17g", name, which,
			         known->draft_m, batten_hydrostatics_name(i), a[i], b[i]);
	}
}

static void test_agrees_with_each_hull_by_itself(void **state)
{
	for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
		struct family *f = make_family(*state, names[k]);
		static batten_hydrostatics found[HULLS * DRAFTS], known[DRAFTS];
		batten_run told;
		run(*state, f, BATTEN_DEVICE_REFERENCE, 0, 0, 0, HULLS, found, &told);
		assert_string_equal(told.warning, "");
		for (size_t h = 0; h < HULLS; h++) {
			measure(*state, f, h, known);
			for (size_t d = 0; d < DRAFTS; d++)
				assert_alike(&found[h * DRAFTS + d], &known[d], names[k], h);
		}
		end_family(f);
	}
}

static void test_bits_in_every_shape(void **state)
{
	static const unsigned lanes[] = { 8, 1 }, groups[] = { 1, 16 };
	static batten_hydrostatics known[HULLS * DRAFTS], found[HULLS * DRAFTS];
	struct family *f = make_family(*state, "bsra_trawler");
	batten_run told;
	run(*state, f, BATTEN_DEVICE_REFERENCE, 0, 0, 0, HULLS, known, &told);
	for (size_t k = 0; k < sizeof lanes / sizeof lanes[0]; k++) {
		memset(found, 0, sizeof found);
		kernels_unoptimised(groups[k] > 1);
		run(*state, f, 0, lanes[k], groups[k], 0, HULLS, found, &told);
		assert_true(told.strict);
		assert_memory_equal(found, known, sizeof found);
	}
	kernels_unoptimised(false);
	/* one after the other, the last first */
	for (size_t h = HULLS; h-- > 0;)
		run(*state, f, BATTEN_DEVICE_AUTO, 0, 0, h, 1, found + h * DRAFTS, &told);
	assert_memory_equal(found, known, sizeof found);
	end_family(f);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_agrees_with_each_hull_by_itself),
		cmocka_unit_test(test_bits_in_every_shape),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
