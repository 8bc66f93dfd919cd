#include "batch/net_plan.h"

#include <math.h>

size_t net_plan_poles(const net_plan *plan)
{
	return plan->u.poles * plan->v.poles;
}

size_t net_plan_in_turn(const net_plan *plan, size_t o)
{
	const size_t columns = plan->u.poles;
	const size_t rows = plan->v.poles;
	return columns < rows ? o : o % rows * columns + o / rows;
}

size_t net_plan_sample_size(const net_plan *plan)
{
	return plan->fairness == NET_FAIRNESS_VARIATION ? NET_SAMPLE_SIZE_THIRD : NET_SAMPLE_SIZE;
}

double net_start_of(const net_item *item, size_t pole)
{
	const double y = item->poles_m[3 * pole + 1];
	return net_within(y, item->lower_y_m[pole], item->upper_y_m[pole]);
}

void net_rooms_of(const net_plan *plan, const net_item *item, net_room *rooms)
{
	const size_t poles = net_plan_poles(plan);
	for (size_t n = 0; n < poles; n++)
		rooms[n] = (net_room){ -INFINITY, INFINITY };
	for (size_t n = 0; n < poles; n++) {
		const double start = net_start_of(item, n);
		net_room *room = &rooms[plan->leader[n]];
		const double down = item->lower_y_m[n] - start;
		const double up = item->upper_y_m[n] - start;
		room->down = down > room->down ? down : room->down;
		room->up = up < room->up ? up : room->up;
	}
	for (size_t n = 0; n < poles; n++)
		rooms[n] = rooms[plan->leader[n]];
}
