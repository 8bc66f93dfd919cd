#include "batch/net_pack.h"

#include "batch/number.h"
#include "batch/search_result.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/surface_point.h"

double net_pack_rounded(const net_plan *plan, double value)
{
	return plan->options.precision == BATTEN_F64 ? value : (double)(float)value;
}

void net_pack_shape(const net_plan *plan, int32_t shape[NET_SHAPE_SIZE])
{
	shape[NET_SHAPE_COLUMNS] = (int32_t)plan->u.poles;
	shape[NET_SHAPE_ROWS] = (int32_t)plan->v.poles;
	shape[NET_SHAPE_LENGTH] = (int32_t)plan->u.count;
	shape[NET_SHAPE_LINES] = (int32_t)plan->v.count;
	shape[NET_SHAPE_COLOURS] = (int32_t)plan->directions.colour_count;
	shape[NET_SHAPE_ITERATIONS] = (int32_t)plan->options.iteration_limit;
}

size_t net_pack_table_count(const net_plan *plan)
{
	return plan->u.count * NET_TABLE_SIZE(plan->u.order) +
	       plan->v.count * NET_TABLE_SIZE(plan->v.order);
}

void net_pack_tables(const net_plan *plan, void *tables)
{
	const size_t along_u = plan->u.count * NET_TABLE_SIZE(plan->u.order);
	for (size_t n = 0; n < along_u; n++)
		number_put(plan->options.precision, tables, n, plan->u.table[n]);
	for (size_t n = along_u; n < net_pack_table_count(plan); n++)
		number_put(plan->options.precision, tables, n, plan->v.table[n - along_u]);
}

void net_pack_heights(const net_plan *plan, void *heights)
{
	for (size_t n = 0; n < plan->directions.member_count; n++)
		number_put(plan->options.precision, heights, n, plan->directions.heights[n]);
}

size_t net_pack_sample_count(const net_plan *plan)
{
	return plan->u.count * plan->v.count * net_plan_sample_size(plan);
}

size_t net_pack_kept_count(const net_plan *plan)
{
	const size_t numbers = plan->fairness == NET_FAIRNESS_VARIATION ? NET_KEPT_SIZE_THIRD
	                                                                : NET_KEPT_SIZE;
	return plan->u.count * plan->v.count * numbers;
}

/* x, the start's y, z and the target's y: the fields of a sample. */
enum { FIELD_X, FIELD_START, FIELD_Z, FIELD_TARGET, FIELD_COUNT };

/* Derivatives of a sample's fields: [by u][by v]. */
typedef double sample_jet[FIELD_COUNT][4][4];

static void add_pole(const net_item *item, size_t pole, const double by_u[4], const double by_v[4],
                     sample_jet jet)
{
	const double fields[FIELD_COUNT] = { item->poles_m[3 * pole], net_start_of(item, pole),
		                                 item->poles_m[3 * pole + 2], item->target_y_m[pole] };
	for (int a = 0; a < 4; a++)
		for (int b = 0; a + b < 4; b++)
			for (int f = 0; f < FIELD_COUNT; f++)
				jet[f][a][b] += by_u[a] * by_v[b] * fields[f];
}

static void sample_jet_at(const net_plan *plan, const net_item *item, size_t line, size_t sample,
                          sample_jet jet)
{
	const double *u = plan->u.table + sample * NET_TABLE_SIZE(plan->u.order);
	const double *v = plan->v.table + line * NET_TABLE_SIZE(plan->v.order);
	for (int f = 0; f < FIELD_COUNT; f++)
		for (int n = 0; n < 16; n++)
			jet[f][n / 4][n % 4] = 0.0;
	for (size_t k = 0; k < plan->v.order; k++)
		for (size_t i = 0; i < plan->u.order; i++) {
			const size_t pole = ((size_t)plan->v.first[line] + k) * plan->u.poles +
			                    (size_t)plan->u.first[sample] + i;
			double by_u[4];
			double by_v[4];
			for (size_t d = 0; d < 4; d++) {
				by_u[d] = u[d * plan->u.order + i];
				by_v[d] = v[d * plan->v.order + k];
			}
			add_pole(item, pole, by_u, by_v, jet);
		}
}

static surface_triple start_triple(sample_jet jet, int by_u, int by_v)
{
	const surface_triple t = { jet[FIELD_X][by_u][by_v], jet[FIELD_START][by_u][by_v],
		                       jet[FIELD_Z][by_u][by_v] };
	return t;
}

/* Whether the start has a normal there, by the rule of integrals over surfaces. */
static bool is_regular(const net_plan *plan, sample_jet jet)
{
	const surface_triple u = start_triple(jet, 1, 0);
	const surface_triple v = start_triple(jet, 0, 1);
	const surface_triple normal = triple_outer(v, u);
	const double angle = plan->options.precision == BATTEN_F64 ? SURFACE_ANGLE_F64
	                                                           : SURFACE_ANGLE_F32;
	return triple_inner(normal, normal) >
	       (angle * angle) * (triple_inner(u, u) * triple_inner(v, v));
}

static const int field_places[3][2] = { { NET_SAMPLE_X, NET_SAMPLE_X_THIRD },
	                                    { NET_SAMPLE_Z, NET_SAMPLE_Z_THIRD },
	                                    { NET_SAMPLE_TARGET, NET_SAMPLE_TARGET_THIRD } };

static void pack_sample(const net_plan *plan, const net_item *item, size_t line, size_t sample,
                        size_t lane, size_t lanes, void *samples)
{
	static const int fields[3] = { FIELD_X, FIELD_Z, FIELD_TARGET };
	const size_t size = net_plan_sample_size(plan);
	const size_t at = (line * plan->u.count + sample) * size;
	const double h = item->half_beam_m;
	const double weight = plan->u.table[(sample + 1) * NET_TABLE_SIZE(plan->u.order) - 1] *
	                      plan->v.table[(line + 1) * NET_TABLE_SIZE(plan->v.order) - 1];
	sample_jet jet;
	sample_jet_at(plan, item, line, sample, jet);
	for (int f = 0; f < 3; f++) {
		double(*d)[4] = jet[fields[f]];
		const double first[5] = { d[1][0], d[0][1], d[2][0], d[1][1], d[0][2] };
		const double third[4] = { d[3][0], d[2][1], d[1][2], d[0][3] };
		for (size_t n = 0; n < 5; n++)
			number_put(plan->options.precision, samples,
			           (at + (size_t)field_places[f][0] + n) * lanes + lane, first[n]);
		for (size_t n = 0; n < 4 && size == NET_SAMPLE_SIZE_THIRD; n++)
			number_put(plan->options.precision, samples,
			           (at + (size_t)field_places[f][1] + n) * lanes + lane, third[n]);
	}
	const double flat = fabs(jet[FIELD_X][1][0] * jet[FIELD_Z][0][1] -
	                         jet[FIELD_X][0][1] * jet[FIELD_Z][1][0]);
	const double scale = plan->fairness == NET_FAIRNESS_VARIATION ? h * h : 1.0;
	number_put(plan->options.precision, samples, (at + NET_SAMPLE_FAIR) * lanes + lane,
	           is_regular(plan, jet) ? item->w1 * scale * weight : 0.0);
	number_put(plan->options.precision, samples, (at + NET_SAMPLE_CLOSE) * lanes + lane,
	           item->w2 * weight * flat / (h * h * (h * h)));
}

void net_pack(const net_plan *plan, size_t which, size_t lane, size_t lanes, void *samples,
              void *arrays, void *settings, net_room *rooms)
{
	const net_item *item = &plan->items[which];
	const size_t poles = net_plan_poles(plan);
	const double h = item->half_beam_m;
	net_rooms_of(plan, item, rooms);
	for (size_t n = 0; n < poles; n++) {
		const double way = net_start_of(item, n) - item->target_y_m[n];
		const double values[NET_ARRAY_COUNT] = { [NET_ARRAY_Y] = way,
			                                     [NET_ARRAY_LOWER] = way + rooms[n].down,
			                                     [NET_ARRAY_UPPER] = way + rooms[n].up };
		for (size_t a = 0; a < NET_ARRAY_COUNT; a++)
			number_put(plan->options.precision, arrays, (a * poles + n) * lanes + lane, values[a]);
	}
	for (size_t k = 0; k < plan->v.count; k++)
		for (size_t i = 0; i < plan->u.count; i++)
			pack_sample(plan, item, k, i, lane, lanes, samples);
	const double rounding = GAUSS_ROUNDING / (h * h);
	number_put(plan->options.precision, settings, SEARCH_SETTING_FIRST_STEP * lanes + lane,
	           plan->options.first_step * h);
	number_put(plan->options.precision, settings, SEARCH_SETTING_LAST_STEP * lanes + lane,
	           plan->options.last_step * h);
	number_put(plan->options.precision, settings, NET_SETTING_ROUNDING * lanes + lane,
	           rounding * rounding);
}

void net_pack_take(const net_plan *plan, size_t which, size_t pole, double way)
{
	/* What follows goes exactly as far as its leader; what did not move comes back as it was. */
	const net_item *item = &plan->items[which];
	const size_t leader = plan->leader[pole];
	const double from = net_start_of(item, leader) - item->target_y_m[leader];
	const double moved = way - net_pack_rounded(plan, from);
	plan->y_m[which * net_plan_poles(plan) + pole] = net_within(
		net_start_of(item, pole) + moved, item->lower_y_m[pole], item->upper_y_m[pole]);
}

void net_unpack(const net_plan *plan, size_t which, size_t lane, size_t lanes, const void *y,
                const void *outcome, net_room *rooms)
{
	const net_item *item = &plan->items[which];
	const size_t poles = net_plan_poles(plan);
	double values[SEARCH_OUTCOME_COUNT];
	for (size_t v = 0; v < SEARCH_OUTCOME_COUNT; v++)
		values[v] = number_get(plan->options.precision, outcome, v * lanes + lane);
	batten_search_result *result = &plan->results[which];
	*result = search_result_of(&plan->options, item->half_beam_m, values);
	if (result->end == BATTEN_SEARCH_REFUSED)
		return;
	net_rooms_of(plan, item, rooms);
	result->probes += 2 * (uint64_t)result->iterations * net_directions_moving(plan, rooms);
	for (size_t n = 0; n < poles; n++)
		net_pack_take(plan, which, n,
		              number_get(plan->options.precision, y, plan->leader[n] * lanes + lane));
}
