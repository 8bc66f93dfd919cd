/* Rows of any method in one batch: each the hull and the numbers it gives by itself, failing ones beside. */
#include "unit/vary_fixture.h"

enum { ROWS = 2 * BATTEN_VARY_METHOD_COUNT };

/* Two rows of each method, the second without a variant. */
struct batch {
	batten_hull *parent, *other;
	batten_lattice *lattice;
	const batten_hull *others[1];
	batten_vary_options rows[ROWS];
	batten_vary_result results[ROWS];
	batten_vary_outcome outcomes[ROWS];
	batten_hydrostatics out[ROWS];
	batten_hull *hulls[ROWS];
};

static void make_batch(batten_context *context, struct batch *b)
{
	static const double by[3] = { 0.01, 0.02, 0 }, weights[2] = { 0.3, 200 };
	static const double from[3] = { 0, 0.5, 1 }, to[2][3] = { { 0, 0.52, 1 }, { 0, 1.1, 1 } };
	b->parent = read_hull(context, "bsra_trawler");
	batten_vary_options lackenby = method(BATTEN_VARY_LACKENBY);
	lackenby.dcp_pct = 3;
	b->other = vary(context, b->parent, &lackenby, NULL);
	b->others[0] = b->other;
	b->lattice = affine_lattice(context, b->parent, by);
	for (size_t i = 0; i < ROWS; i++) {
		const bool bad = i % 2;
		batten_vary_options *row = &b->rows[i];
		*row = method((batten_vary_method)(i / 2));
		row->first_pass = bad; /* what is out of reach takes long to explain */
		row->dcp_pct = bad ? 300 : 2;
		row->dlcb_pct = bad ? 60 : 0.5;
		row->dcwp_pct = 1;
		row->other_count = 1;
		row->others = b->others;
		row->weights = &weights[bad];
		row->scale_y = bad && row->method == BATTEN_VARY_AFFINE ? -1 : 0.9;
		row->scale_z = 1.25;
		row->volume_m3 = 255;
		row->middle_aft_m = bad ? NAN : 12;
		row->middle_fore_m = bad ? NAN : 18;
		row->point_count = 3;
		row->from_part = from;
		row->to_part = to[bad];
		row->preset = BATTEN_VARY_U_NESS;
		row->amount = bad ? 0.2 : 0.05;
		row->lattice = bad ? NULL : b->lattice;
	}
}

static void end_batch(struct batch *b)
{
	for (size_t i = 0; i < ROWS; i++)
		batten_hull_destroy(b->hulls[i]);
	batten_lattice_destroy(b->lattice);
	batten_hull_destroy(b->other);
	batten_hull_destroy(b->parent);
}

static batten_status run(batten_context *context, struct batch *b, size_t first, size_t count,
                         batten_run *told)
{
	const batten_variants variants = { .count = count,
		                               .draft_count = 1,
		                               .results = b->results + first,
		                               .out = b->out + first,
		                               .row_options = b->rows + first,
		                               .outcomes = b->outcomes + first,
		                               .hulls = b->hulls + first };
	return batten_hull_vary_measure(context, b->parent, NULL, NULL, NULL, &variants, told);
}

/* batten_hull_vary() and batten_hull_hydrostatics() of a row, bit for bit. */
static void check_row(batten_context *context, const struct batch *b, size_t i)
{
	batten_vary_outcome outcome;
	batten_hull *variant = NULL;
	batten_hydrostatics form;
	const batten_status status = batten_hull_vary(context, b->parent, &b->rows[i], &variant,
	                                              &outcome);
	assert_int_equal(b->results[i].status, status);
	assert_int_equal(b->outcomes[i].status, status);
	if ((status == BATTEN_OK) != (i % 2 == 0))
		fail_msg("row %zu: %s", i, status == BATTEN_OK ? "a variant" : outcome.reason);
	if (status != BATTEN_OK) {
		assert_string_equal(b->outcomes[i].reason, outcome.reason);
		assert_memory_equal(b->results[i].reason, outcome.reason, strnlen(outcome.reason, 119));
		assert_null(b->hulls[i]);
		assert_true(isnan(b->out[i].volume_m3));
		return;
	}
	const double draft = batten_hull_draft_m(variant);
	assert_int_equal(batten_hull_hydrostatics(context, variant, NULL, 1, &draft, &form), BATTEN_OK);
	assert_memory_equal(&b->out[i], &form, sizeof form);
	assert_string_equal(batten_hull_source(b->hulls[i]), batten_hull_source(variant));
	const size_t nodes = batten_hull_station_count(variant) * batten_hull_waterline_count(variant);
	assert_memory_equal(batten_hull_y_m(b->hulls[i]), batten_hull_y_m(variant),
	                    nodes * sizeof(double));
	assert_memory_equal(batten_hull_z_m(b->hulls[i]), batten_hull_z_m(variant),
	                    batten_hull_waterline_count(variant) * sizeof(double));
	assert_int_equal(b->outcomes[i].target_count, outcome.target_count);
	for (size_t t = 0; t < outcome.target_count; t++)
		assert_true(b->outcomes[i].targets[t].got == outcome.targets[t].got &&
		            b->outcomes[i].targets[t].asked == outcome.targets[t].asked);
	batten_hull_destroy(variant);
}

static void test_all_methods(void **state)
{
	struct batch b = { 0 };
	batten_run told;
	make_batch(*state, &b);
	assert_int_equal(run(*state, &b, 0, ROWS, &told), BATTEN_INCOMPLETE);
	assert_string_equal(told.warning, "20 of 20 hulls worked one by one");
	for (size_t i = 0; i < ROWS; i++)
		check_row(*state, &b, i);
	end_batch(&b);
}

/* The same bits from four threads and from one, in one go and row by row. */
static void test_threads_and_pieces(void **state)
{
	batten_context_options options;
	batten_context *context = NULL;
	struct batch b = { 0 }, apart = { 0 };
	batten_run told;
	batten_context_options_default(&options);
	options.threads = 4;
	assert_int_equal(batten_context_create(&options, &context), BATTEN_OK);
	make_batch(context, &b);
	make_batch(*state, &apart);
	assert_int_equal(run(context, &b, 0, ROWS, &told), BATTEN_INCOMPLETE);
	for (size_t i = 0; i < ROWS; i++) {
		/* a batch of one method that moves sections goes to a device: others bits within 1e-9 */
		if (i / 2 <= BATTEN_VARY_LACKENBY)
			continue;
		const batten_status status = run(*state, &apart, i, 1, &told);
		assert_int_equal(status, i % 2 ? BATTEN_INCOMPLETE : BATTEN_OK);
		assert_memory_equal(&b.out[i], &apart.out[i], sizeof b.out[i]);
		assert_string_equal(b.results[i].reason, apart.results[i].reason);
	}
	end_batch(&b);
	end_batch(&apart);
	batten_context_destroy(context);
}

/* Options that differ in the four numbers only go to the device, as rows of numbers do. */
static void test_options_on_a_device(void **state)
{
	struct batch b = { 0 };
	batten_run told;
	make_batch(*state, &b);
	for (size_t i = 0; i < ROWS; i++) {
		b.rows[i] = method(BATTEN_VARY_LACKENBY);
		b.rows[i].dcp_pct = i == 7 ? NAN : 0.3 * (double)i;
	}
	b.rows[3].amount = 100; /* of no use to the method, and out of its range */
	assert_int_equal(run(*state, &b, 0, ROWS, &told), BATTEN_INCOMPLETE);
	assert_string_equal(told.warning, "");
	for (size_t i = 0; i < ROWS; i++) {
		batten_vary_outcome outcome;
		batten_hull *variant = NULL;
		assert_int_equal(batten_hull_vary(*state, b.parent, &b.rows[i], &variant, &outcome),
		                 b.results[i].status);
		assert_int_equal(b.results[i].status, i == 3 || i == 7 ? BATTEN_USAGE : BATTEN_OK);
		assert_string_equal(b.outcomes[i].reason, outcome.reason);
		assert_string_equal(b.outcomes[i].warning, outcome.warning);
		assert_int_equal(b.outcomes[i].target_count, outcome.target_count);
		for (size_t t = 0; t < outcome.target_count; t++) {
			assert_string_equal(b.outcomes[i].targets[t].name, outcome.targets[t].name);
			assert_near(b.outcomes[i].targets[t].asked, outcome.targets[t].asked, 1e-12, "asked");
			assert_near(b.outcomes[i].targets[t].got, outcome.targets[t].got, 1e-9, "got");
		}
		if (variant) {
			assert_string_equal(batten_hull_source(b.hulls[i]), batten_hull_source(variant));
			assert_near(measures_of(*state, b.hulls[i]).cp, b.results[i].cp, 1e-10, "C_P");
		}
		batten_hull_destroy(variant);
	}
	end_batch(&b);
}

static void test_refusals(void **state)
{
	struct batch b = { 0 };
	make_batch(*state, &b);
	double y[1];
	batten_variants variants = {
		.count = ROWS, .results = b.results, .row_options = b.rows, .y_m = y
	};
	assert_int_equal(batten_hull_vary_measure(*state, b.parent, NULL, NULL, NULL, &variants, NULL),
	                 BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(*state), "row 8: half-breadths"));
	variants = (batten_variants){
		.count = 1, .draft_count = 2, .results = b.results, .row_options = b.rows, .out = b.out
	};
	assert_int_equal(batten_hull_vary_measure(*state, b.parent, NULL, NULL, NULL, &variants, NULL),
	                 BATTEN_USAGE);
	/* a draft above the table of one variant, within that of another */
	const double draft = 1.1 * batten_hull_draft_m(b.parent);
	variants = (batten_variants){ .count = 2,
		                          .draft_count = 1,
		                          .drafts_m = &draft,
		                          .results = b.results,
		                          .row_options = &b.rows[(size_t)BATTEN_VARY_AFFINE * 2],
		                          .out = b.out };
	b.rows[BATTEN_VARY_AFFINE * 2 + 1].scale_y = 1;
	b.rows[BATTEN_VARY_AFFINE * 2 + 1].scale_z = 1;
	assert_int_equal(batten_hull_vary_measure(*state, b.parent, NULL, NULL, NULL, &variants, NULL),
	                 BATTEN_INCOMPLETE);
	assert_int_equal(b.results[0].status, BATTEN_OK);
	assert_true(b.out[0].draft_m == draft);
	assert_int_equal(b.results[1].status, BATTEN_USAGE);
	assert_non_null(strstr(b.results[1].reason, "draft"));
	end_batch(&b);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_all_methods),
		cmocka_unit_test(test_threads_and_pieces),
		cmocka_unit_test(test_options_on_a_device),
		cmocka_unit_test(test_refusals),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
