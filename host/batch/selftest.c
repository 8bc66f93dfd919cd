/* batten_device_selftest: every kernel in the shape a device would run it in. */
#include "batch/afloat_engine.h"
#include "batch/block_engine.h"
#include "batch/net_block_engine.h"
#include "batch/net_engine.h"
#include "batch/pass_engine.h"
#include "batch/search_engine.h"
#include "batch/surface_engine.h"
#include "batch/variants_engine.h"

/* The smallest grid: of it only the numbers that choose a shape count. */
static batten_status plan_searches(batten_context *context, batten_precision precision,
                                   batten_search_algorithm algorithm, search_plan **out)
{
	const double x[] = { 0.0, 1.0, 2.0 };
	const batten_grid grid = { 3, 3, x, x };
	batten_search_options options;
	batten_search_options_default(&options);
	options.precision = precision;
	options.algorithm = algorithm;
	return search_plan_create(context, &grid, 0, NULL, &options, out);
}

static batten_status test_offsets(batten_context *context, size_t index,
                                  const batten_device *device, batten_precision precision,
                                  batten_search_algorithm algorithm, batten_selftest *result)
{
	search_plan *plan = NULL;
	search_engine *engine = NULL;
	const batten_status made = plan_searches(context, precision, algorithm, &plan);
	if (made != BATTEN_OK)
		return made;
	const search_shape shape = search_shape_choose(plan, index, device);
	search_plan_destroy(plan);
	return search_engine_open(context, &shape, &engine, result);
}

static batten_status test_search(batten_context *context, size_t index, const batten_device *device,
                                 batten_precision precision, batten_selftest *result)
{
	return test_offsets(context, index, device, precision, BATTEN_ALGORITHM_MULTILEVEL, result);
}

static batten_status test_textbook(batten_context *context, size_t index,
                                   const batten_device *device, batten_precision precision,
                                   batten_selftest *result)
{
	return test_offsets(context, index, device, precision, BATTEN_ALGORITHM_TEXTBOOK, result);
}

static batten_status test_block(batten_context *context, size_t index, const batten_device *device,
                                batten_precision precision, batten_selftest *result)
{
	search_plan *plan = NULL;
	batch_engine *engine = NULL;
	batten_status status = plan_searches(context, precision, BATTEN_ALGORITHM_BLOCK, &plan);
	if (status == BATTEN_OK)
		status = block_engine_open(plan, index, device, &engine, result);
	search_plan_destroy(plan);
	return status;
}

static batten_status test_surfaces(batten_context *context, size_t index,
                                   const batten_device *device, batten_precision precision,
                                   batten_selftest *result)
{
	/* The commonest hull: bicubic, all that is known of a point. */
	const surface_plan plan = { .context = context,
		                        .output = SURFACE_OUTPUT_EVERYTHING,
		                        .u = { .order = 4 },
		                        .v = { .order = 4 },
		                        .precision = precision };
	batch_engine *engine = NULL;
	return surface_engine_open(&plan, index, device, &engine, result);
}

/* The commonest: bending of a bicubic hull. */
static net_plan plan_nets(batten_context *context, batten_precision precision)
{
	return (net_plan){ .context = context,
		               .options = { .precision = precision },
		               .fairness = NET_FAIRNESS_BENDING,
		               .u = { .order = 4, .points = 4 },
		               .v = { .order = 4, .points = 4 } };
}

static batten_status test_nets(batten_context *context, size_t index, const batten_device *device,
                               batten_precision precision, batten_selftest *result)
{
	const net_plan plan = plan_nets(context, precision);
	batch_engine *engine = NULL;
	return net_engine_open(&plan, index, device, &engine, result);
}

static batten_status test_net_block(batten_context *context, size_t index,
                                    const batten_device *device, batten_precision precision,
                                    batten_selftest *result)
{
	const net_plan plan = plan_nets(context, precision);
	batch_engine *engine = NULL;
	return net_block_engine_open(&plan, index, device, &engine, result);
}

static batten_status test_pass(batten_context *context, size_t index, const batten_device *device,
                               batten_precision precision, bool stretches, batten_selftest *result)
{
	pass_program_numbers program = { .row_count = 0 };
	program.shape[PASS_SHAPE_STRETCHES] = stretches;
	const pass_plan plan = { .context = context, .program = &program, .precision = precision };
	batch_engine *engine = NULL;
	return pass_engine_open(&plan, index, device, &engine, result);
}

static batten_status test_passes(batten_context *context, size_t index, const batten_device *device,
                                 batten_precision precision, batten_selftest *result)
{
	return test_pass(context, index, device, precision, false, result);
}

static batten_status test_stretches(batten_context *context, size_t index,
                                    const batten_device *device, batten_precision precision,
                                    batten_selftest *result)
{
	return test_pass(context, index, device, precision, true, result);
}

/* These are of one precision only. */
static batten_status test_afloat(batten_context *context, size_t index, const batten_device *device,
                                 batten_selftest *result)
{
	const size_t net = AFLOAT_ORDER_MOST;
	const afloat_plan plan = {
		.context = context,
		.shape = { [AFLOAT_COUNT] = (int32_t)net, [AFLOAT_COUNT + 1] = (int32_t)net },
	};
	batch_engine *engine = NULL;
	return afloat_engine_open(&plan, index, device, &engine, result);
}

static batten_status test_variants(batten_context *context, size_t index,
                                   const batten_device *device, batten_selftest *result)
{
	const variants_plan plan = { .context = context };
	batch_engine *engine = NULL;
	return variants_engine_open(&plan, index, device, &engine, result);
}

batten_status batten_device_selftest(batten_context *context, size_t index,
                                     batten_selftest *results, size_t capacity, size_t *count)
{
	batten_device device;
	const batten_status status = batten_device_describe(context, index, &device);
	if (status != BATTEN_OK)
		return status;
	static const batten_precision precisions[] = { BATTEN_F64, BATTEN_F32 };
	static batten_status (*const tests[])(
		batten_context *, size_t, const batten_device *, batten_precision,
		batten_selftest *) = { test_search, test_textbook,  test_block,  test_surfaces,
		                       test_nets,   test_net_block, test_passes, test_stretches };
	static batten_status (*const double_tests[])(batten_context *, size_t, const batten_device *,
	                                             batten_selftest *) = { test_variants,
		                                                                test_afloat };
	enum { PRECISIONS = 2, BOTH = 8 * PRECISIONS, TESTS = BOTH + 2 };
	*count = TESTS;
	for (size_t t = 0; t < TESTS && t < capacity; t++) {
		const batten_status opened = t < BOTH ? tests[t / PRECISIONS](context, index, &device,
		                                                              precisions[t % PRECISIONS],
		                                                              &results[t])
		                                      : double_tests[t - BOTH](context, index, &device,
		                                                               &results[t]);
		if (opened == BATTEN_MEMORY)
			return opened;
	}
	return BATTEN_OK;
}
