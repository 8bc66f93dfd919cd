/* batten_surface_grid_batch and batten_surface_energy_batch. */
#include "geometry/surface_batch.h"

#include "geometry/surface_quadrature.h"

#include "batch/surface_batch.h"

#include <math.h>
#include <string.h>

/* The values of the public list are those of the kernel, in its order. */
_Static_assert((int)BATTEN_SURFACE_VALUE_COUNT == (int)SURFACE_EVERYTHING_COUNT, "one list");
_Static_assert((int)BATTEN_SURFACE_VALUE_area == (int)SURFACE_AREA, "one list");
_Static_assert((int)BATTEN_SURFACE_VALUE_normal_x == (int)SURFACE_NORMAL, "one list");
_Static_assert((int)BATTEN_SURFACE_VALUE_mean == (int)SURFACE_MEAN, "one list");
_Static_assert((int)BATTEN_SURFACE_VALUE_direction1_x == (int)SURFACE_DIRECTION1, "one list");
_Static_assert((int)BATTEN_SURFACE_VALUE_along_x == (int)SURFACE_ALONG_X, "one list");

void batten_surface_batch_options_default(batten_surface_batch_options *options)
{
	*options = (batten_surface_batch_options){ .struct_size = sizeof *options,
		                                       .device = BATTEN_DEVICE_AUTO,
		                                       .precision = BATTEN_F64,
		                                       .output = BATTEN_SURFACE_CURVATURE,
		                                       .light = { 0.0, 1.0, 0.0 } };
}

size_t batten_surface_output_count(batten_surface_output output)
{
	switch (output) {
	case BATTEN_SURFACE_POSITION:
		return SURFACE_POSITION_COUNT;
	case BATTEN_SURFACE_CURVATURE:
		return SURFACE_CURVATURE_COUNT;
	case BATTEN_SURFACE_EVERYTHING:
		return SURFACE_EVERYTHING_COUNT;
	}
	return 0;
}

static bool same_knots(const double *a, const double *b, size_t count)
{
	for (size_t n = 0; n < count; n++)
		if (a[n] != b[n])
			return false;
	return true;
}

const char *surface_unlike(const batten_surface *first, const batten_surface *other)
{
	if (!other)
		return "is NULL";
	if (other->order_u != first->order_u || other->order_v != first->order_v)
		return "has other orders than surface 0";
	if (other->count_u != first->count_u || other->count_v != first->count_v)
		return "has another number of poles than surface 0";
	if ((other->weights != NULL) != (first->weights != NULL))
		return "has weights and surface 0 has none, or the other way round";
	if (!same_knots(other->knots_u, first->knots_u, first->count_u + first->order_u) ||
	    !same_knots(other->knots_v, first->knots_v, first->count_v + first->order_v))
		return "has other knots than surface 0";
	return NULL;
}

batten_status surface_topology_of(batten_context *context, size_t count,
                                  const batten_surface *const *surfaces, surface_topology *out)
{
	if (count == 0 || !surfaces || !surfaces[0])
		return batten_fail(context, BATTEN_USAGE, "no surface: at least one is expected");
	const batten_surface *first = surfaces[0];
	const surface_topology t = { first->order_u,        first->order_v, first->count_u,
		                         first->count_v,        first->knots_u, first->knots_v,
		                         first->weights != NULL };
	for (size_t s = 1; s < count; s++) {
		const char *fault = surface_unlike(first, surfaces[s]);
		if (fault)
			return batten_fail(context, BATTEN_USAGE, "surface %zu of %zu %s", s, count, fault);
	}
	*out = t;
	return BATTEN_OK;
}

static double largest_of(surface_range range)
{
	return fmax(-range.least, range.most);
}

static double largest_of_table(const surface_samples *samples)
{
	const size_t numbers = samples->count * SURFACE_TABLE_SIZE(samples->rows, samples->order);
	return (double)samples->order * largest_of(surface_range_of(samples->table, numbers));
}

/* Squares of derivatives must stay finite in the precision. */
static batten_status check_size(const surface_plan *plan, const batten_surface_net *net,
                                const surface_box *box, size_t s, double tables)
{
	const double far = fmax(largest_of(box->along[0]),
	                        fmax(largest_of(box->along[1]), largest_of(box->along[2])));
	double size = far * tables;
	if (net->weights) {
		const surface_range weights = surface_range_of(net->weights, net->count_u * net->count_v);
		if (!(weights.least >= 1e-6 && weights.most <= 1e6))
			return batten_fail(plan->context, BATTEN_USAGE,
			                   "surface %zu of %zu: weights %g to %g, 1e-6 to 1e6 are expected", s,
			                   plan->count, weights.least, weights.most);
		size *= weights.most / weights.least * (weights.most / weights.least);
	}
	const double limit = plan->precision == BATTEN_F64 ? 1e150 : 1e18;
	if (size <= limit)
		return BATTEN_OK;
	return batten_fail(plan->context, BATTEN_USAGE,
	                   "surface %zu of %zu: derivatives up to %g, too large for %s", s, plan->count,
	                   size, plan->precision == BATTEN_F64 ? "f64" : "f32");
}

/* What each surface has of its own; batten_release() the items. Errors: USAGE (numbers too large for
 * the precision), MEMORY. */
static batten_status make_items(batten_context *context, size_t count,
                                const batten_surface *const *surfaces, const surface_plan *plan,
                                surface_item **out)
{
	const double tables = largest_of_table(&plan->u) * largest_of_table(&plan->v);
	batten_status status = BATTEN_OK;
	surface_item *items = batten_allocate(context, count, sizeof *items);
	if (!items)
		return BATTEN_MEMORY;
	for (size_t s = 0; s < count && status == BATTEN_OK; s++) {
		const batten_surface_net net = batten_surface_describe(surfaces[s]);
		const surface_box box = surface_box_of(&net);
		status = check_size(plan, &net, &box, s, tables);
		items[s] = (surface_item){ .poles_m = net.poles_m,
			                       .weights = net.weights,
			                       .area = surface_net_area(&net, &box) };
	}
	if (status == BATTEN_OK)
		*out = items;
	else
		batten_release(context, items);
	return status;
}

/* Of length 1, by way of its largest coordinate so that no square is too large or too small. */
static batten_status make_unit(batten_context *context, double light[3])
{
	const double most = fmax(fabs(light[0]), fmax(fabs(light[1]), fabs(light[2])));
	if (!(most > 0.0) || !isfinite(light[0]) || !isfinite(light[1]) || !isfinite(light[2]))
		return batten_fail(context, BATTEN_USAGE,
		                   "light from (%g, %g, %g): finite numbers, not all 0, are expected",
		                   light[0], light[1], light[2]);
	double square = 0.0;
	for (size_t c = 0; c < 3; c++) {
		light[c] /= most;
		square += light[c] * light[c];
	}
	for (size_t c = 0; c < 3; c++)
		light[c] /= sqrt(square);
	return BATTEN_OK;
}

batten_status surface_batch_options_check(batten_context *context,
                                          const batten_surface_batch_options *given,
                                          batten_surface_batch_options *chosen)
{
	batten_surface_batch_options_default(chosen);
	if (given)
		*chosen = *given;
	if (chosen->struct_size != sizeof *chosen)
		return batten_fail(context, BATTEN_USAGE,
		                   "surface batch options of another version of batten");
	if (batten_surface_output_count(chosen->output) == 0)
		return batten_fail(context, BATTEN_USAGE, "surface output %d: 0 to 2 are expected",
		                   (int)chosen->output);
	return make_unit(context, chosen->light);
}

static surface_plan plan_of(batten_context *context, size_t count, const surface_topology *topology,
                            const batten_surface_batch_options *options)
{
	return (surface_plan){ .context = context,
		                   .rational = topology->rational,
		                   .light = { options->light[0], options->light[1], options->light[2] },
		                   .segment_length = 1,
		                   .device = options->device,
		                   .precision = options->precision,
		                   .lanes = options->lanes,
		                   .work_group = options->work_group,
		                   .count = count };
}

/* Takes the tables of the plan along. */
static batten_status run_plan(surface_plan *plan, const batten_surface *const *surfaces,
                              batten_run *run)
{
	surface_item *items = NULL;
	batten_status status = make_items(plan->context, plan->count, surfaces, plan, &items);
	plan->items = items;
	if (status == BATTEN_OK)
		status = surface_batch_run(plan, run);
	batten_release(plan->context, items);
	return status;
}

/* values: doubles or floats. */
static batten_status run_grid(batten_context *context, size_t count,
                              const batten_surface *const *surfaces,
                              const batten_surface_samples *samples,
                              const batten_surface_batch_options *options, void *values,
                              bool floats, uint8_t *singular, batten_run *run)
{
	static const int outputs[] = { [BATTEN_SURFACE_POSITION] = SURFACE_OUTPUT_POSITION,
		                           [BATTEN_SURFACE_CURVATURE] = SURFACE_OUTPUT_CURVATURE,
		                           [BATTEN_SURFACE_EVERYTHING] = SURFACE_OUTPUT_EVERYTHING };
	batten_surface_batch_options chosen;
	surface_topology t = { 0 };
	batten_status status = surface_batch_options_check(context, options, &chosen);
	if (status == BATTEN_OK)
		status = surface_topology_of(context, count, surfaces, &t);
	if (status == BATTEN_OK && floats && chosen.precision != BATTEN_F32)
		status = batten_fail(context, BATTEN_USAGE,
		                     "values as floats of precision %d: f32 is expected",
		                     (int)chosen.precision);
	if (status != BATTEN_OK)
		return status;
	surface_plan plan = plan_of(context, count, &t, &chosen);
	plan.output = outputs[chosen.output];
	plan.values = values;
	plan.floats = floats;
	plan.singular = singular;
	status = surface_samples_at(context, "u", t.order_u, t.count_u, t.knots_u, samples->u_count,
	                            samples->u, &plan.u);
	if (status == BATTEN_OK)
		status = surface_samples_at(context, "v", t.order_v, t.count_v, t.knots_v, samples->v_count,
		                            samples->v, &plan.v);
	if (status == BATTEN_OK)
		status = run_plan(&plan, surfaces, run);
	surface_samples_release(context, &plan.u);
	surface_samples_release(context, &plan.v);
	return status;
}

batten_status batten_surface_grid_batch(batten_context *context, size_t count,
                                        const batten_surface *const *surfaces,
                                        const batten_surface_samples *samples,
                                        const batten_surface_batch_options *options, double *values,
                                        uint8_t *singular, batten_run *run)
{
	return run_grid(context, count, surfaces, samples, options, values, false, singular, run);
}

batten_status batten_surface_grid_batch_float(batten_context *context, size_t count,
                                              const batten_surface *const *surfaces,
                                              const batten_surface_samples *samples,
                                              const batten_surface_batch_options *options,
                                              float *values, uint8_t *singular, batten_run *run)
{
	return run_grid(context, count, surfaces, samples, options, values, true, singular, run);
}

batten_status batten_surface_energy_batch(batten_context *context, size_t count,
                                          const batten_surface *const *surfaces,
                                          const batten_surface_batch_options *options,
                                          batten_surface_energies *energies, batten_run *run)
{
	batten_surface_batch_options chosen;
	surface_topology t = { 0 };
	batten_status status = surface_batch_options_check(context, options, &chosen);
	if (status == BATTEN_OK)
		status = surface_topology_of(context, count, surfaces, &t);
	if (status != BATTEN_OK)
		return status;
	const size_t along_u = chosen.gauss_points ? chosen.gauss_points : t.order_u + 1;
	const size_t along_v = chosen.gauss_points ? chosen.gauss_points : t.order_v + 1;
	surface_plan plan = plan_of(context, count, &t, &chosen);
	plan.output = chosen.variation ? SURFACE_OUTPUT_VARIATION : SURFACE_OUTPUT_ENERGY;
	plan.segment_length = along_u;
	const size_t rows = SURFACE_TABLE_ROWS(plan.output);
	double *values = batten_allocate(context, count, SURFACE_SUM_COUNT * sizeof *values);
	if (!values)
		return BATTEN_MEMORY;
	plan.values = values;
	status = surface_samples_gauss(context, t.order_u, rows, t.count_u, t.knots_u, along_u,
	                               &plan.u);
	if (status == BATTEN_OK)
		status = surface_samples_gauss(context, t.order_v, rows, t.count_v, t.knots_v, along_v,
		                               &plan.v);
	if (status == BATTEN_OK)
		status = run_plan(&plan, surfaces, run);
	for (size_t s = 0; s < count && status == BATTEN_OK; s++) {
		const double *sums = values + s * SURFACE_SUM_COUNT;
		energies[s] = (batten_surface_energies){
			.bending = sums[SURFACE_SUM_BENDING],
			.mean = sums[SURFACE_SUM_MEAN],
			.gauss = sums[SURFACE_SUM_GAUSS],
			.area_m2 = sums[SURFACE_SUM_AREA],
			.singular = (size_t)sums[SURFACE_SUM_SINGULAR],
			.variation_per_m2 = sums[SURFACE_SUM_VARIATION],
			.variation_left_out = (size_t)sums[SURFACE_SUM_LEFT_OUT]
		};
	}
	surface_samples_release(context, &plan.u);
	surface_samples_release(context, &plan.v);
	batten_release(context, values);
	return status;
}
