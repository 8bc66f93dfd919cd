/* Passes over many hulls: devices equal the C path bit for bit; a hull's result is its own. */
#include "batch/pass_engine.h"
#include "unit/pass_fixture.h"

enum { HULLS = 150 }; /* more than the groups of a device take at a time */

typedef struct batch {
	size_t values;
	double *y, *found, *known;
} batch;

static batten_pass *make_pass_of(batten_context *context, const batten_hull *hull,
                                 batten_pass_options options, int device)
{
	batten_pass *pass = NULL;
	options.device = device;
	if (batten_pass_create(context, hull, &options, &pass) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return pass;
}

static batten_pass_options options_of(int method, batten_precision precision)
{
	batten_pass_options options;
	batten_pass_options_default(&options);
	options.method = (batten_fair_method)method;
	options.order = 4;
	options.order_sections = 3;
	options.precision = precision;
	return options;
}

static batten_pass *make_pass(batten_context *context, const batten_hull *hull, int method,
                              batten_precision precision, int device)
{
	return make_pass_of(context, hull, options_of(method, precision), device);
}

/* The hull, each time with other noise and one of five breadths: points of neighbouring lanes lie in other
 * spans of a fit. */
static batch make_batch(const batten_pass *pass, const batten_hull *hull)
{
	batch b = { .values = batten_pass_describe(pass).value_count };
	b.y = malloc(HULLS * b.values * sizeof *b.y);
	b.found = malloc(HULLS * b.values * sizeof *b.found);
	b.known = malloc(HULLS * b.values * sizeof *b.known);
	assert_true(b.y && b.found && b.known);
	uint32_t state = 7;
	for (size_t h = 0; h < HULLS; h++)
		batten_pass_values(pass, hull, b.y + h * b.values);
	for (size_t n = 0; n < HULLS * b.values; n++) {
		state = state * 1664525u + 1013904223u;
		if (b.y[n] > 0)
			b.y[n] *= (double)(1 + n / b.values % 5) + 0.01 * (double)(state >> 8) / (1u << 24);
	}
	return b;
}

static void release_batch(batch *b)
{
	free(b->y);
	free(b->found);
	free(b->known);
}

/* Batches the other way round: hull by hull the same. */
static void check_order(batten_context *context, const batten_pass *pass, const batch *b)
{
	const size_t size = b->values * sizeof *b->y;
	double *turned = malloc(2 * HULLS * size);
	assert_non_null(turned);
	double *out = turned + HULLS * b->values;
	for (size_t h = 0; h < HULLS; h++)
		memcpy(turned + h * b->values, b->y + (HULLS - 1 - h) * b->values, size);
	assert_int_equal(batten_pass_batch(context, pass, HULLS, 3, turned, out, NULL), BATTEN_OK);
	for (size_t h = 0; h < HULLS; h++)
		assert_memory_equal(out + h * b->values, b->known + (HULLS - 1 - h) * b->values, size);
	free(turned);
}

static void check_equal(batten_context *context, const batten_hull *hull,
                        batten_pass_options options)
{
	const batten_precision precision = options.precision;
	batten_pass *pass = make_pass_of(context, hull, options, BATTEN_DEVICE_AUTO);
	batten_pass *plain = make_pass_of(context, hull, options, BATTEN_DEVICE_REFERENCE);
	batch b = make_batch(pass, hull);
	const size_t size = HULLS * b.values * sizeof *b.y;
	batten_run run;
	assert_int_equal(batten_pass_batch(context, pass, HULLS, 3, b.y, b.found, &run), BATTEN_OK);
	assert_true(run.strict);
	assert_int_equal(batten_pass_batch(context, plain, HULLS, 3, b.y, b.known, NULL), BATTEN_OK);
	assert_memory_equal(b.found, b.known, size);
	check_order(context, pass, &b);
	/* Alone, as in the batch; and three iterations are three times one. */
	double *one = b.found;
	const size_t last = (HULLS - 1) * b.values;
	assert_int_equal(batten_pass_batch(context, plain, 1, 3, b.y + last, one, NULL), BATTEN_OK);
	assert_memory_equal(one, b.known + last, b.values * sizeof *one);
	if (precision == BATTEN_F64) {
		double *two = b.found + b.values;
		double *three = b.found + 2 * b.values;
		assert_int_equal(batten_pass_batch(context, plain, 1, 1, b.y, one, NULL), BATTEN_OK);
		assert_int_equal(batten_pass_batch(context, plain, 1, 1, one, two, NULL), BATTEN_OK);
		assert_int_equal(batten_pass_batch(context, plain, 1, 1, two, three, NULL), BATTEN_OK);
		assert_memory_equal(three, b.known, b.values * sizeof *one);
	}
	release_batch(&b);
	batten_pass_destroy(pass);
	batten_pass_destroy(plain);
}

static void test_equal(void **state)
{
	static const char *const names[] = { "wigley_noisy", "npl_parent", "highspeed_craft" };
	for (size_t n = 0; n < 3; n++) {
		batten_hull *hull = read_hull(*state, names[n]);
		for (int m = BATTEN_METHOD_FORWARD_APPROXIMATION; m <= BATTEN_METHOD_INVERSE; m++) {
			check_equal(*state, hull, options_of(m, BATTEN_F64));
			check_equal(*state, hull, options_of(m, BATTEN_F32));
		}
		/* The closed forms of order 3, and fields that are fitted. */
		for (int precision = BATTEN_F64; precision <= BATTEN_F32; precision++) {
			batten_pass_options options = options_of(BATTEN_METHOD_FORWARD_FIT,
			                                         (batten_precision)precision);
			options.order = 3;
			check_equal(*state, hull, options);
			options = options_of(BATTEN_METHOD_INVERSE, (batten_precision)precision);
			options.vertices = 5;
			check_equal(*state, hull, options);
		}
		batten_hull_destroy(hull);
	}
}

/* A context that allots little: launches are cut to it, and the hulls come out as they do without. */
static void test_launches_are_cut(void **state)
{
	enum { MEMORY = 100000 };
	batten_context_options little;
	batten_context *context = NULL;
	batten_context_options_default(&little);
	little.max_memory = MEMORY;
	assert_int_equal(batten_context_create(&little, &context), BATTEN_OK);
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const int method = BATTEN_METHOD_FORWARD_APPROXIMATION;
	batten_pass *pass = make_pass(context, hull, method, BATTEN_F64, BATTEN_DEVICE_AUTO);
	batten_pass *plain = make_pass(*state, hull, method, BATTEN_F64, BATTEN_DEVICE_REFERENCE);
	batch b = make_batch(pass, hull);
	assert_true(HULLS * b.values * sizeof *b.y > 4 * (size_t)MEMORY);
	batten_run run;
	assert_int_equal(batten_pass_batch(context, pass, HULLS, 3, b.y, b.found, &run), BATTEN_OK);
	assert_string_not_equal(run.device, "reference");
	assert_int_equal(batten_pass_batch(*state, plain, HULLS, 3, b.y, b.known, NULL), BATTEN_OK);
	assert_memory_equal(b.found, b.known, HULLS * b.values * sizeof *b.y);
	pass_program_numbers program = { 0 };
	program.shape[PASS_SHAPE_VALUES] = (int32_t)b.values;
	program.shape[PASS_SHAPE_STRETCHES] = 1;
	const pass_plan plan = { .context = context, .program = &program, .precision = BATTEN_F64 };
	batten_device device;
	batch_engine *engine = NULL;
	assert_int_equal(batten_device_describe(context, 0, &device), BATTEN_OK);
	assert_int_equal(pass_engine_open(&plan, 0, &device, &engine, NULL), BATTEN_OK);
	const size_t hulls = pass_engine_block(engine, &plan);
	assert_true(hulls >= engine->recipe.lanes);
	assert_true(hulls * b.values * sizeof *b.y <= MEMORY);
	release_batch(&b);
	batten_pass_destroy(pass);
	batten_pass_destroy(plain);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static void test_refusals(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley");
	batten_pass *pass = make_pass(*state, hull, BATTEN_METHOD_INVERSE, BATTEN_F64,
	                              BATTEN_DEVICE_REFERENCE);
	batch b = make_batch(pass, hull);
	assert_int_equal(batten_pass_batch(*state, pass, 1, 0, b.y, b.found, NULL), BATTEN_USAGE);
	assert_int_equal(batten_pass_batch(*state, pass, 1, 10001, b.y, b.found, NULL), BATTEN_USAGE);
	b.y[b.values + 3] = NAN;
	assert_int_equal(batten_pass_batch(*state, pass, 2, 1, b.y, b.found, NULL), BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(*state), "number 3 of hull 1"));
	batten_pass *there = make_pass(*state, hull, BATTEN_METHOD_INVERSE, BATTEN_F64, 0);
	static const double bad[] = { NAN, INFINITY, -1.1e6 };
	for (size_t n = 0; n < 3; n++) {
		b.y[b.values + 3] = bad[n];
		assert_int_equal(batten_pass_batch(*state, there, 20, 1, b.y, b.found, NULL), BATTEN_USAGE);
		assert_non_null(strstr(batten_context_error(*state), "number 3 of hull 1 is "));
	}
	batten_pass_destroy(there);
	assert_int_equal(batten_pass_batch(*state, pass, 0, 1, b.y, b.found, NULL), BATTEN_OK);
	release_batch(&b);
	batten_pass_destroy(pass);
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_equal, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_launches_are_cut, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
