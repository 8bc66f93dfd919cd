/* Variants and their hydrostatics in every number of lanes, and with work-items that share a hull: the
 * bits of the C path, failing rows and parallel bodies among them. */
#include "support/kernel_compile.h"
#include "unit/vary_fixture.h"

enum { ROWS = 35, DRAFTS = 3, NODES = 150 };

struct batch {
	batten_vary_row rows[ROWS];
	batten_vary_result results[ROWS];
	double y[ROWS * NODES];
	uint8_t nodes[ROWS * NODES];
	batten_hydrostatics out[ROWS * DRAFTS];
};

static void run(batten_context *context, const batten_hull *parent, int device, unsigned lanes,
                unsigned group, struct batch *b)
{
	static const double drafts[DRAFTS] = { 2.515, 1.9, 1.0 };
	const batten_vary_options options = method(BATTEN_VARY_LACKENBY);
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = device;
	batch.lanes = lanes;
	batch.work_group = group;
	const batten_variants variants = { .count = ROWS,
		                               .rows = b->rows,
		                               .draft_count = DRAFTS,
		                               .drafts_m = drafts,
		                               .results = b->results,
		                               .y_m = b->y,
		                               .nodes = b->nodes,
		                               .out = b->out };
	batten_run told;
	for (size_t i = 0; i < ROWS; i++) {
		const double part = (double)i / (ROWS - 1) - 0.5;
		/* the last rows are out of reach */
		b->rows[i] = (batten_vary_row){ i > 32 ? 90 : 8 * part, 3 * part * part,
			                            i % 4 ? 0 : 2 + part, i % 3 ? 0 : 2 - part };
	}
	const batten_status status = batten_hull_vary_measure(context, parent, &options, NULL, &batch,
	                                                      &variants, &told);
	assert_int_equal(status, BATTEN_INCOMPLETE);
	assert_true(told.strict);
	assert_string_equal(told.warning, "");
}

static void test_every_shape(void **state)
{
	static const unsigned lanes[] = { 2, 4, 16, 8 }, groups[] = { 1, 1, 1, 3 };
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	assert_int_equal(batten_hull_station_count(parent) * batten_hull_waterline_count(parent),
	                 NODES);
	kernels_unoptimised(true);
	struct batch *known = calloc(1, sizeof *known);
	assert_non_null(known);
	run(*state, parent, BATTEN_DEVICE_REFERENCE, 0, 0, known);
	for (size_t k = 0; k < sizeof lanes / sizeof lanes[0]; k++) {
		struct batch *found = calloc(1, sizeof *found);
		assert_non_null(found);
		run(*state, parent, 0, lanes[k], groups[k], found);
		assert_memory_equal(found->y, known->y, sizeof known->y);
		assert_memory_equal(found->nodes, known->nodes, sizeof known->nodes);
		assert_memory_equal(found->out, known->out, sizeof known->out);
		for (size_t i = 0; i < ROWS; i++) {
			assert_int_equal(found->results[i].status, known->results[i].status);
			assert_int_equal(found->results[i].passes, known->results[i].passes);
			assert_string_equal(found->results[i].reason, known->results[i].reason);
		}
		free(found);
	}
	assert_int_equal(known->results[34].status, BATTEN_INPUT);
	free(known);
	batten_hull_destroy(parent);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_every_shape),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
