#include "batch/net_block_pack.h"

#include "batch/net_pack.h"
#include "batch/number.h"
#include "batch/search_result.h"

/* Most numbers of a group's state in one lane: 128 MiB a group of 8 lanes of f64. */
enum { STATE_MOST = 1 << 21 };

static bool is_turned(const net_plan *plan)
{
	return plan->u.poles < plan->v.poles;
}

/* The number in turn of every pole: the inverse of net_plan_in_turn(). */
static size_t turn_of(const net_plan *plan, size_t pole)
{
	const size_t columns = plan->u.poles;
	if (columns == 0)
		return 0;
	return is_turned(plan) ? pole : pole % columns * plan->v.poles + pole / columns;
}

static size_t apart(size_t a, size_t b)
{
	return a < b ? b - a : a - b;
}

static size_t larger(size_t a, size_t b)
{
	return a > b ? a : b;
}

/* How far a pole is apart from those that share a sample with it, of later rows. */
static size_t pole_reach(const net_plan *plan, const size_t *turns, size_t row, size_t column)
{
	const size_t columns = plan->u.poles;
	const size_t n = row * columns + column;
	const size_t first = column + 1 > plan->u.order ? column + 1 - plan->u.order : 0;
	size_t reach = 0;
	for (size_t k = row; k < plan->v.poles && k < row + plan->v.order; k++)
		for (size_t i = first; i < columns && i < column + plan->u.order; i++) {
			const size_t m = k * columns + i;
			const size_t a[2] = { turns[n], turns[plan->leader[n]] };
			const size_t b[2] = { turns[m], turns[plan->leader[m]] };
			for (int pair = 0; pair < 4; pair++)
				reach = larger(reach, apart(a[pair & 1], b[pair >> 1]));
		}
	return reach;
}

/* How far poles that share a sample are apart in the table, before and after those that go with others are part of
 * these. */
static size_t reach_of(const net_plan *plan, const size_t *turns)
{
	const size_t columns = plan->u.poles;
	const size_t rows = plan->v.poles;
	size_t reach = 0;
	for (size_t row = 0; row < rows; row++)
		for (size_t column = 0; column < columns; column++)
			reach = larger(reach, pole_reach(plan, turns, row, column));
	return reach;
}

batten_status net_block_shape_of(const net_plan *plan, net_block_shape *out)
{
	const size_t poles = net_plan_poles(plan);
	const bool turned = is_turned(plan);
	*out = (net_block_shape){ .u = turned ? &plan->v : &plan->u,
		                      .v = turned ? &plan->u : &plan->v };
	size_t *turns = batten_allocate(plan->context, poles + 1, sizeof *turns);
	if (!turns)
		return BATTEN_MEMORY;
	for (size_t n = 0; n < poles; n++) {
		turns[n] = turn_of(plan, n);
		out->followers += plan->leader[n] != n;
	}
	out->band = reach_of(plan, turns) + 1;
	batten_release(plan->context, turns);
	return BATTEN_OK;
}

size_t net_block_slots(const net_block_shape *shape, bool alone)
{
	return alone ? shape->v->points : shape->v->count;
}

size_t net_block_state_numbers(const net_block_shape *shape, bool alone)
{
	return NET_BLOCK_STATE_NUMBERS(shape->u->poles, shape->v->poles, shape->u->count,
	                               shape->v->count, shape->band, net_block_slots(shape, alone),
	                               shape->u->order, shape->u->points);
}

batten_status net_block_knows(const net_plan *plan, bool *knows)
{
	net_block_shape shape;
	*knows = plan->fairness == NET_FAIRNESS_BENDING || plan->fairness == NET_FAIRNESS_MEAN;
	if (!*knows)
		return BATTEN_OK;
	const batten_status status = net_block_shape_of(plan, &shape);
	if (status == BATTEN_OK)
		*knows = net_block_state_numbers(&shape, true) <= STATE_MOST;
	return status;
}

void net_block_pack_shape(const net_plan *plan, const net_block_shape *shape, bool alone,
                          int32_t numbers[NET_BLOCK_SHAPE_SIZE])
{
	numbers[NET_BLOCK_COLUMNS] = (int32_t)shape->u->poles;
	numbers[NET_BLOCK_ROWS] = (int32_t)shape->v->poles;
	numbers[NET_BLOCK_COUNT_U] = (int32_t)shape->u->count;
	numbers[NET_BLOCK_COUNT_V] = (int32_t)shape->v->count;
	numbers[NET_BLOCK_BAND] = (int32_t)shape->band;
	numbers[NET_BLOCK_SLOTS] = (int32_t)net_block_slots(shape, alone);
	numbers[NET_BLOCK_FOLLOWERS] = (int32_t)shape->followers;
	numbers[NET_BLOCK_ITERATIONS] = (int32_t)plan->options.iteration_limit;
}

void net_block_pack_followers(const net_plan *plan, int32_t *followers)
{
	size_t count = 0;
	for (size_t n = 0; n < net_plan_poles(plan); n++)
		if (plan->leader[n] != n) {
			followers[count++] = (int32_t)turn_of(plan, n);
			followers[count++] = (int32_t)turn_of(plan, plan->leader[n]);
		}
}

size_t net_block_table_count(const net_block_shape *shape)
{
	return shape->u->count * NET_TABLE_SIZE(shape->u->order) +
	       shape->v->count * NET_TABLE_SIZE(shape->v->order);
}

void net_block_pack_tables(const net_plan *plan, const net_block_shape *shape, void *tables)
{
	const size_t along_u = shape->u->count * NET_TABLE_SIZE(shape->u->order);
	for (size_t n = 0; n < net_block_table_count(shape); n++)
		number_put(plan->options.precision, tables, n,
		           n < along_u ? shape->u->table[n] : shape->v->table[n - along_u]);
}

void net_block_pack(const net_plan *plan, size_t which, void *input, void *settings,
                    net_room *rooms)
{
	const net_item *item = &plan->items[which];
	const size_t poles = net_plan_poles(plan);
	const double h = item->half_beam_m;
	net_rooms_of(plan, item, rooms);
	for (size_t n = 0; n < poles; n++) {
		const double way = net_start_of(item, n) - item->target_y_m[n];
		const double values[BLOCK_INPUT_COUNT] = { [BLOCK_INPUT_START] = way,
			                                       [BLOCK_INPUT_LOWER] = way + rooms[n].down,
			                                       [BLOCK_INPUT_UPPER] = way + rooms[n].up,
			                                       [BLOCK_INPUT_TARGET] = item->target_y_m[n],
			                                       [BLOCK_INPUT_X] = item->poles_m[3 * n],
			                                       [BLOCK_INPUT_Z] = item->poles_m[3 * n + 2] };
		for (size_t a = 0; a < BLOCK_INPUT_COUNT; a++)
			number_put(plan->options.precision, input, a * poles + turn_of(plan, n), values[a]);
	}
	const double chosen[BLOCK_SETTING_COUNT] = {
		[BLOCK_SETTING_LONGEST] = 4.0 * plan->options.first_step * h,
		[BLOCK_SETTING_LAST_STEP] = plan->options.last_step * h,
		[BLOCK_SETTING_CURVATURE] = 1.0 / h,
		[BLOCK_SETTING_FAIR] = item->w1,
		[BLOCK_SETTING_CLOSE] = item->w2 / (h * h * (h * h)),
	};
	for (size_t v = 0; v < BLOCK_SETTING_COUNT; v++)
		number_put(plan->options.precision, settings, v, chosen[v]);
}

void net_block_unpack(const net_plan *plan, size_t which, const void *input, const void *outcome)
{
	double values[BLOCK_OUTCOME_COUNT];
	const size_t poles = net_plan_poles(plan);
	for (size_t v = 0; v < BLOCK_OUTCOME_COUNT; v++)
		values[v] = number_get(plan->options.precision, outcome, v);
	plan->results[which] = search_result_of_block(values, NET_BLOCK_PROBES,
	                                              plan->u.count * plan->v.count);
	if (plan->results[which].end == BATTEN_SEARCH_REFUSED)
		return;
	for (size_t n = 0; n < poles; n++)
		net_pack_take(plan, which, n,
		              number_get(plan->options.precision, input,
		                         BLOCK_INPUT_START * poles + turn_of(plan, plan->leader[n])));
}
