/* batten_device_selftest: every kernel in the shape a device would run it in. */
#include "batch/afloat_engine.h"
#include "batch/block_engine.h"
#include "batch/net_block_engine.h"
#include "batch/net_engine.h"
#include "batch/pass_engine.h"
#include "batch/search_engine.h"
#include "batch/surface_engine.h"
#include "batch/variants_engine.h"

#include <string.h>

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

static batten_status test_variants(batten_context *context, size_t index,
                                   const batten_device *device, batten_precision precision,
                                   batten_selftest *result)
{
	(void)precision;
	const variants_plan plan = { .context = context };
	batch_engine *engine = NULL;
	return variants_engine_open(&plan, index, device, &engine, result);
}

static batten_status test_afloat(batten_context *context, size_t index, const batten_device *device,
                                 batten_precision precision, batten_selftest *result)
{
	(void)precision;
	const size_t net = AFLOAT_ORDER_MOST;
	const afloat_plan plan = {
		.context = context,
		.shape = { [AFLOAT_COUNT] = (int32_t)net, [AFLOAT_COUNT + 1] = (int32_t)net },
	};
	batch_engine *engine = NULL;
	return afloat_engine_open(&plan, index, device, &engine, result);
}

static const struct {
	const char *name;
	batten_status (*test)(batten_context *, size_t, const batten_device *, batten_precision,
	                      batten_selftest *);
	bool f64_alone;
} kernels[] = {
	{ "multilevel", test_search, false },     { "textbook", test_textbook, false },
	{ "block_search", test_block, false },    { "surface_grid", test_surfaces, false },
	{ "net_search", test_nets, false },       { "net_block", test_net_block, false },
	{ "fairing_pass", test_passes, false },   { "fairing_stretches", test_stretches, false },
	{ "hull_variants", test_variants, true }, { "surface_hydrostatics", test_afloat, true },
};
enum { KERNELS = sizeof kernels / sizeof kernels[0] };

const char *batten_device_kernel_name(size_t number)
{
	return number < KERNELS ? kernels[number].name : NULL;
}

batten_status batten_device_selftest(batten_context *context, size_t index, const char *kernel,
                                     batten_selftest *results, size_t capacity, size_t *count)
{
	batten_device device;
	const batten_status status = batten_device_describe(context, index, &device);
	if (status != BATTEN_OK)
		return status;
	static const batten_precision precisions[] = { BATTEN_F64, BATTEN_F32 };
	*count = 0;
	for (size_t k = 0; k < KERNELS; k++) {
		if (kernel && strcmp(kernel, kernels[k].name) != 0)
			continue;
		for (size_t p = 0; p < (kernels[k].f64_alone ? 1 : 2); p++, ++*count)
			if (*count < capacity && kernels[k].test(context, index, &device, precisions[p],
			                                         &results[*count]) == BATTEN_MEMORY)
				return BATTEN_MEMORY;
	}
	if (*count == 0)
		return batten_fail(context, BATTEN_USAGE, "kernel: '%s' is none of batten's", kernel);
	return BATTEN_OK;
}
