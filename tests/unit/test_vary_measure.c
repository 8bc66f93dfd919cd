/* Many variants made and measured at once: those of batten_hull_vary(), bits alike in every shape. */
#include "unit/vary_fixture.h"

enum { ROWS = 45, DRAFTS = 5, NODES_MOST = 4096 };

/* A batch, and room for what it gives. */
struct batch {
	batten_vary_row rows[ROWS];
	batten_vary_result results[ROWS];
	double y[ROWS * NODES_MOST];
	uint8_t nodes[ROWS * NODES_MOST];
	batten_hydrostatics out[ROWS * DRAFTS];
	double drafts[DRAFTS];
};

static double chance(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

/* Rows within reach, and from row 40 on some that are not. */
static struct batch *make_batch(const batten_hull *parent, bool body)
{
	static const double parts[DRAFTS] = { 1, 0.5, 0.83, 0.24, 0.7 };
	struct batch *b = calloc(1, sizeof *b);
	assert_non_null(b);
	uint32_t state = 11;
	for (size_t i = 0; i < ROWS; i++)
		b->rows[i] = (batten_vary_row){ .dcp_pct = 8 * chance(&state),
			                            .dlcb_pct = 3 * chance(&state),
			                            .dp_fore_pct = body && i % 2 ? 3 + 3 * chance(&state) : 0,
			                            .dp_aft_pct = body && i % 3 ? 3 + 3 * chance(&state) : 0 };
	b->rows[0] = (batten_vary_row){ 0 };
	b->rows[40].dlcb_pct = 30;
	b->rows[41].dcp_pct = NAN;
	b->rows[42].dlcb_pct = -40;
	b->rows[43].dlcb_pct = 101;
	for (size_t d = 0; d < DRAFTS; d++)
		b->drafts[d] = parts[d] * batten_hull_draft_m(parent);
	b->drafts[4] = batten_hull_z_m(parent)[batten_hull_waterline_count(parent) / 2];
	return b;
}

static void run(batten_context *context, const batten_hull *parent,
                const batten_vary_options *options, int device, unsigned lanes, unsigned group,
                struct batch *b, size_t first, size_t count, batten_run *told)
{
	const size_t nodes = batten_hull_station_count(parent) * batten_hull_waterline_count(parent);
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = device;
	batch.lanes = lanes;
	batch.work_group = group;
	const batten_variants variants = { .count = count,
		                               .rows = b->rows + first,
		                               .draft_count = DRAFTS,
		                               .drafts_m = b->drafts,
		                               .results = b->results + first,
		                               .y_m = b->y + first * nodes,
		                               .nodes = b->nodes + first * nodes,
		                               .out = b->out + first * DRAFTS };
	const batten_status status = batten_hull_vary_measure(context, parent, options, NULL, &batch,
	                                                      &variants, told);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		fail_msg("%s", batten_context_error(context));
}

static void assert_alike(const double *found, const double *known, size_t count, double least,
                         const char *what, size_t row)
{
	for (size_t i = 0; i < count; i++)
		if (!(fabs(found[i] - known[i]) <= 1e-9 * fmax(fabs(known[i]), least)) &&
		    !(isnan(found[i]) && isnan(known[i])))
			fail_msg("%s, row %zu: %zu is %.17g, by itself %.17g", what, row, i, found[i],
			         known[i]);
}

/* A row against batten_hull_vary() and batten_hull_hydrostatics(). */
static void check_row(batten_context *context, const batten_hull *parent,
                      const batten_vary_options *options, const struct batch *b, size_t row)
{
	const size_t nodes = batten_hull_station_count(parent) * batten_hull_waterline_count(parent);
	batten_vary_options one = *options;
	batten_vary_outcome outcome;
	batten_hull *variant = NULL;
	batten_hydrostatics known[DRAFTS];
	one.dcp_pct = b->rows[row].dcp_pct;
	one.dlcb_pct = b->rows[row].dlcb_pct;
	one.dp_fore_pct = b->rows[row].dp_fore_pct;
	one.dp_aft_pct = b->rows[row].dp_aft_pct;
	const batten_status status = batten_hull_vary(context, parent, &one, &variant, &outcome);
	if (b->results[row].status != status)
		fail_msg("row %zu: %s; by itself %s", row, b->results[row].reason, outcome.reason);
	if (status != BATTEN_OK) {
		assert_true(b->results[row].reason[0] != '\0');
		assert_true(isnan(b->out[row * DRAFTS].volume_m3));
		return;
	}
	assert_int_equal(b->results[row].passes, outcome.passes);
	assert_memory_equal(b->nodes + row * nodes, batten_hull_nodes(variant), nodes);
	assert_alike(b->y + row * nodes, batten_hull_y_m(variant), nodes, 1, "half-breadths", row);
	assert_int_equal(batten_hull_hydrostatics(context, variant, NULL, DRAFTS, b->drafts, known),
	                 BATTEN_OK);
	for (size_t d = 0; d < DRAFTS; d++)
		assert_alike((const double *)&b->out[row * DRAFTS + d], (const double *)&known[d],
		             BATTEN_HYDROSTATICS_COUNT, 1e-1, "hydrostatics", row);
	batten_hull_destroy(variant);
}

static void check_method(batten_context *context, const char *name, batten_vary_method which,
                         bool body, bool first_pass)
{
	batten_hull *parent = read_hull(context, name);
	batten_vary_options options = method(which);
	options.first_pass = first_pass;
	struct batch *b = make_batch(parent, body);
	batten_run told;
	run(context, parent, &options, BATTEN_DEVICE_REFERENCE, 0, 0, b, 0, ROWS, &told);
	assert_string_equal(told.warning, "");
	for (size_t row = 0; row < ROWS; row++)
		/* what cannot be reached takes the one-by-one call long to explain: one such row will do */
		if (row < 41 || row == 43)
			check_row(context, parent, &options, b, row);
	free(b);
	batten_hull_destroy(parent);
}

static void test_lackenby_agrees(void **state)
{
	check_method(*state, "bsra_trawler", BATTEN_VARY_LACKENBY, false, false);
	check_method(*state, "bsra_trawler", BATTEN_VARY_LACKENBY, true, false);
	check_method(*state, "wigley", BATTEN_VARY_LACKENBY, false, false);
}

static void test_the_other_methods_agree(void **state)
{
	check_method(*state, "bsra_trawler", BATTEN_VARY_SWING, false, false);
	check_method(*state, "wigley", BATTEN_VARY_ONE_MINUS_PRISMATIC, false, false);
	check_method(*state, "bsra_trawler", BATTEN_VARY_ONE_MINUS_PRISMATIC, false, true);
}

static void test_bits_in_every_shape(void **state)
{
	static const unsigned lanes[] = { 8, 1 }, groups[] = { 1, 16 };
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	const size_t nodes = batten_hull_station_count(parent) * batten_hull_waterline_count(parent);
	const batten_vary_options options = method(BATTEN_VARY_LACKENBY);
	struct batch *known = make_batch(parent, true), *found = make_batch(parent, true);
	batten_run told;
	run(*state, parent, &options, BATTEN_DEVICE_REFERENCE, 0, 0, known, 0, ROWS, &told);
	for (size_t k = 0; k < 3; k++) {
		if (k < 2)
			run(*state, parent, &options, 0, lanes[k], groups[k], found, 0, ROWS, &told);
		/* in pieces, the last first */
		for (size_t end = ROWS; k == 2 && end > 0; end -= 9)
			run(*state, parent, &options, BATTEN_DEVICE_AUTO, 0, 0, found, end - 9, 9, &told);
		assert_true(told.strict);
		assert_memory_equal(found->y, known->y, ROWS * nodes * sizeof *known->y);
		assert_memory_equal(found->nodes, known->nodes, ROWS * nodes);
		assert_memory_equal(found->out, known->out, sizeof known->out);
		for (size_t i = 0; i < ROWS; i++) {
			assert_int_equal(found->results[i].passes, known->results[i].passes);
			assert_int_equal(found->results[i].status, known->results[i].status);
			assert_string_equal(found->results[i].reason, known->results[i].reason);
		}
		memset(found->out, 0, sizeof found->out);
	}
	free(known);
	free(found);
	batten_hull_destroy(parent);
}

/* Long layouts go one by one, and the result says so. */
static void test_other_parents_go_one_by_one(void **state)
{
	batten_hull *parent = read_hull(*state, "highspeed_craft");
	const batten_vary_options options = method(BATTEN_VARY_SWING);
	struct batch *b = make_batch(parent, false);
	batten_run told;
	for (size_t i = 0; i < 3; i++)
		b->rows[i].dlcb_pct = 0.2 * (double)i;
	run(*state, parent, &options, BATTEN_DEVICE_AUTO, 0, 0, b, 0, 3, &told);
	assert_string_equal(told.warning, "3 of 3 hulls worked one by one");
	for (size_t row = 0; row < 3; row++)
		check_row(*state, parent, &options, b, row);
	free(b);
	batten_hull_destroy(parent);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_lackenby_agrees),
		cmocka_unit_test(test_the_other_methods_agree),
		cmocka_unit_test(test_bits_in_every_shape),
		cmocka_unit_test(test_other_parents_go_one_by_one),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
