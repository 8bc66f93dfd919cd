#include "batch/surface_pack.h"

static void put(const surface_plan *plan, void *numbers, size_t at, double value)
{
	if (plan->precision == BATTEN_F64)
		((double *)numbers)[at] = value;
	else
		((float *)numbers)[at] = (float)value;
}

static size_t number_size(const surface_plan *plan)
{
	return plan->precision == BATTEN_F64 ? sizeof(double) : sizeof(float);
}

size_t surface_pack_table_size(const surface_plan *plan, const surface_samples *samples)
{
	return samples->count * SURFACE_TABLE_SIZE(samples->order) * number_size(plan);
}

void surface_pack_table(const surface_plan *plan, const surface_samples *samples, void *table)
{
	for (size_t n = 0; n < samples->count * SURFACE_TABLE_SIZE(samples->order); n++)
		put(plan, table, n, samples->table[n]);
}

size_t surface_pack_net_count(const surface_plan *plan)
{
	return plan->u.poles * plan->v.poles * surface_plan_dimension(plan);
}

void surface_pack_net(const surface_plan *plan, const surface_item *item, size_t lane, size_t lanes,
                      void *net, void *least_area)
{
	const size_t dimension = surface_plan_dimension(plan);
	const double angle = plan->precision == BATTEN_F64 ? SURFACE_ANGLE_F64 : SURFACE_ANGLE_F32;
	for (size_t i = 0; i < plan->u.poles; i++)
		for (size_t k = 0; k < plan->v.poles; k++) {
			const size_t from = k * plan->u.poles + i;
			const size_t to = (i * plan->v.poles + k) * dimension;
			const double weight = plan->rational ? item->weights[from] : 1.0;
			for (size_t c = 0; c < 3; c++)
				put(plan, net, (to + c) * lanes + lane, item->poles_m[3 * from + c] * weight);
			if (plan->rational)
				put(plan, net, (to + 3) * lanes + lane, weight);
		}
	put(plan, least_area, lane, (angle * item->area) * (angle * item->area));
}

/* The loops over all that was computed, written for both precisions: a test for each number would
 * take as long as computing it. The mean curvature, number `mean` of a sample, tells where there is
 * no normal. */
#define UNPACK(name, number)                                                                       \
	static void name(const surface_plan *plan, size_t mean, double *values, uint8_t *singular,     \
	                 size_t stride, const number *out)                                             \
	{                                                                                              \
		const number none = (number)SURFACE_NO_NORMAL;                                             \
		const size_t count = surface_plan_values(plan);                                            \
		const size_t plane = plan->u.count * plan->v.count;                                        \
		for (size_t v = 0; v < count; v++) {                                                       \
			double *to = values + v * plane;                                                       \
			const number *from = out + v * stride;                                                 \
			for (size_t i = 0; i < plan->u.count; i++) {                                           \
				const number value = from[i * count * stride];                                     \
				to[i] = v == mean && value == none ? 0.0 : (double)value;                          \
			}                                                                                      \
		}                                                                                          \
		for (size_t i = 0; singular && i < plan->u.count; i++)                                     \
			singular[i] = mean < count && out[(i * count + mean) * stride] == none;                \
	}
UNPACK(unpack_line_f64, double)
UNPACK(unpack_line_f32, float)

static double get(const surface_plan *plan, const void *numbers, size_t at)
{
	if (plan->precision == BATTEN_F64)
		return ((const double *)numbers)[at];
	return (double)((const float *)numbers)[at];
}

/* The weight of a line along v times its sums; points are counted. */
static void add_sums(const surface_plan *plan, size_t line, double *sums, size_t lane, size_t lanes,
                     const void *out)
{
	const size_t size = SURFACE_TABLE_SIZE(plan->v.order);
	const double weight = plan->v.table[line * size + size - 1];
	for (size_t v = 0; v < SURFACE_SUM_COUNT; v++) {
		const double sum = get(plan, out, v * lanes + lane);
		sums[v] = (line == 0 ? 0.0 : sums[v]) + (v == SURFACE_SUM_SINGULAR ? sum : weight * sum);
	}
}

void surface_unpack(const surface_plan *plan, size_t which, size_t line, size_t lane, size_t lanes,
                    const void *out)
{
	const size_t plane = plan->u.count * plan->v.count;
	const size_t mean = plan->output == SURFACE_OUTPUT_CURVATURE    ? 1
	                    : plan->output == SURFACE_OUTPUT_EVERYTHING ? SURFACE_MEAN
	                                                                : SURFACE_EVERYTHING_COUNT;
	if (plan->output == SURFACE_OUTPUT_ENERGY) {
		add_sums(plan, line, plan->values + which * SURFACE_SUM_COUNT, lane, lanes, out);
		return;
	}
	double *values = plan->values + which * surface_plan_values(plan) * plane +
	                 line * plan->u.count;
	uint8_t *singular = plan->singular ? plan->singular + which * plane + line * plan->u.count
	                                   : NULL;
	if (plan->precision == BATTEN_F64)
		unpack_line_f64(plan, mean, values, singular, lanes, (const double *)out + lane);
	else
		unpack_line_f32(plan, mean, values, singular, lanes, (const float *)out + lane);
}
