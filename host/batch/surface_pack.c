#include "batch/surface_pack.h"

#include "batch/number.h"

#include <string.h>

static size_t number_size(const surface_plan *plan)
{
	return plan->precision == BATTEN_F64 ? sizeof(double) : sizeof(float);
}

size_t surface_pack_table_size(const surface_plan *plan, const surface_samples *samples)
{
	return samples->count * SURFACE_TABLE_SIZE(samples->rows, samples->order) * number_size(plan);
}

void surface_pack_table(const surface_plan *plan, const surface_samples *samples, void *table)
{
	for (size_t n = 0; n < samples->count * SURFACE_TABLE_SIZE(samples->rows, samples->order); n++)
		number_put(plan->precision, table, n, samples->table[n]);
}

size_t surface_pack_net_count(const surface_plan *plan)
{
	return plan->u.poles * plan->v.poles * surface_plan_dimension(plan);
}

/* The poles of a surface into lane `lane` of a net, along v first. */
#define PACK(name, number)                                                                         \
	static void name(const surface_plan *plan, const surface_item *item, size_t lanes, number *to) \
	{                                                                                              \
		for (size_t i = 0; i < plan->u.poles; i++)                                                 \
			for (size_t k = 0; k < plan->v.poles; k++) {                                           \
				const size_t from = k * plan->u.poles + i;                                         \
				const double weight = plan->rational ? item->weights[from] : 1.0;                  \
				for (size_t c = 0; c < 3; c++, to += lanes)                                        \
					*to = (number)(item->poles_m[3 * from + c] * weight);                          \
				if (plan->rational) {                                                              \
					*to = (number)weight;                                                          \
					to += lanes;                                                                   \
				}                                                                                  \
			}                                                                                      \
	}
PACK(pack_doubles, double)
PACK(pack_floats, float)

void surface_pack_net(const surface_plan *plan, const surface_item *item, size_t lane, size_t lanes,
                      void *net, void *least_area)
{
	const double angle = plan->precision == BATTEN_F64 ? SURFACE_ANGLE_F64 : SURFACE_ANGLE_F32;
	if (plan->precision == BATTEN_F64)
		pack_doubles(plan, item, lanes, (double *)net + lane);
	else
		pack_floats(plan, item, lanes, (float *)net + lane);
	number_put(plan->precision, least_area, lane, (angle * item->area) * (angle * item->area));
}

/* The loops over all that was computed, written for both precisions: a test for each number would
 * take as long as computing it. */
#define TAKE(name, number, wanted)                                                                 \
	static void name(const surface_plan *plan, wanted *values, const number *numbers,              \
	                 size_t value_stride, size_t stride)                                           \
	{                                                                                              \
		const size_t plane = plan->u.count * plan->v.count;                                        \
		for (size_t v = 0; v < surface_plan_values(plan); v++)                                     \
			for (size_t i = 0; i < plan->u.count; i++)                                             \
				values[v * plane + i] = (wanted)numbers[v * value_stride + i * stride];            \
	}
TAKE(take_doubles, double, double)
TAKE(widen_floats, float, double)
TAKE(take_floats, float, float)

/* The number in the plan's values where a line of a value begins. */
static size_t line_of(const surface_plan *plan, size_t which, size_t value, size_t line)
{
	return ((which * surface_plan_values(plan) + value) * plan->v.count + line) * plan->u.count;
}

void surface_take_line(const surface_plan *plan, size_t which, size_t line, const void *numbers,
                       bool doubles, size_t value_stride, size_t stride)
{
	const size_t at = line_of(plan, which, 0, line);
	if (plan->floats)
		take_floats(plan, (float *)plan->values + at, numbers, value_stride, stride);
	else if (doubles)
		take_doubles(plan, (double *)plan->values + at, numbers, value_stride, stride);
	else
		widen_floats(plan, (double *)plan->values + at, numbers, value_stride, stride);
}

/* Points whose mean curvature is the mark are singular, and have none. */
#define MARK(name, number)                                                                         \
	static void name(number *mean, number none, size_t count, uint8_t *singular)                   \
	{                                                                                              \
		for (size_t i = 0; i < count; i++)                                                         \
			if (mean[i] == none) {                                                                 \
				mean[i] = 0;                                                                       \
				if (singular)                                                                      \
					singular[i] = 1;                                                               \
			}                                                                                      \
	}
MARK(mark_doubles, double)
MARK(mark_floats, float)

void surface_mark_line(const surface_plan *plan, size_t which, size_t line, bool missing)
{
	const size_t plane = plan->u.count * plan->v.count;
	uint8_t *singular = plan->singular ? plan->singular + which * plane + line * plan->u.count
	                                   : NULL;
	if (singular)
		memset(singular, 0, plan->u.count);
	if (!missing || plan->output == SURFACE_OUTPUT_POSITION)
		return;
	const double none = plan->precision == BATTEN_F64 ? SURFACE_NO_NORMAL
	                                                  : (double)(float)SURFACE_NO_NORMAL;
	const size_t value = plan->output == SURFACE_OUTPUT_CURVATURE ? 1 : SURFACE_MEAN;
	const size_t mean = line_of(plan, which, value, line);
	if (plan->floats)
		mark_floats((float *)plan->values + mean, (float)none, plan->u.count, singular);
	else
		mark_doubles((double *)plan->values + mean, none, plan->u.count, singular);
}

void surface_add_sums(const surface_plan *plan, size_t which, size_t line, size_t lane,
                      size_t lanes, const void *numbers)
{
	const size_t size = SURFACE_TABLE_SIZE(plan->v.rows, plan->v.order);
	const double weight = plan->v.table[line * size + size - 1];
	double *sums = (double *)plan->values + which * SURFACE_SUM_COUNT;
	for (size_t v = 0; v < SURFACE_SUM_COUNT; v++) {
		const double sum = number_get(plan->precision, numbers, v * lanes + lane);
		const bool counts = v == SURFACE_SUM_SINGULAR || v == SURFACE_SUM_LEFT_OUT;
		sums[v] = (line == 0 ? 0.0 : sums[v]) + (counts ? sum : weight * sum);
	}
}
