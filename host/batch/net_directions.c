/* The directions of a search over a control net: hats over the poles, several widths, by colour. */
#include "batch/net_plan.h"

#include <math.h>
#include <string.h>

/* The poles that move with each leader, itself among them: numbers first[leader] to first[leader + 1]
 * of poles. */
typedef struct follower_list {
	size_t *first, *poles;
} follower_list;

/* Memory to build with, and what is built. */
typedef struct builder {
	const net_plan *plan;
	follower_list followers;
	uint8_t *movable; /* in at least one search of the stretch */
	uint8_t *taken;   /* spans that directions of the colour at hand see, [v][u] */
	uint8_t *placed;  /* directions of the level at hand that have a colour */
	net_directions made;
	size_t spans_u;
	bool counting; /* sizes only */
} builder;

typedef struct hat {
	int column, row; /* centre */
	search_width width;
} hat;

static double height_at(const hat *h, size_t column, size_t row)
{
	const double u = 1.0 - fabs((double)column - h->column) / h->width.a;
	const double v = 1.0 - fabs((double)row - h->row) / h->width.b;
	return u > 0.0 && v > 0.0 ? u * v : 0.0;
}

static batten_status list_followers(const net_plan *plan, follower_list *list)
{
	const size_t poles = net_plan_poles(plan);
	list->first = batten_allocate(plan->context, poles + 1, sizeof *list->first);
	list->poles = batten_allocate(plan->context, poles, sizeof *list->poles);
	if (!list->first || !list->poles)
		return BATTEN_MEMORY;
	for (size_t n = 0; n < poles; n++)
		list->first[plan->leader[n] + 1]++;
	for (size_t n = 0; n < poles; n++)
		list->first[n + 1] += list->first[n];
	/* Filling moves each beginning to its end, which is the next one's beginning. */
	for (size_t n = 0; n < poles; n++)
		list->poles[list->first[plan->leader[n]]++] = n;
	memmove(list->first + 1, list->first, poles * sizeof *list->first);
	list->first[0] = 0;
	return BATTEN_OK;
}

/* Poles under the hat and what follows them into members and heights (may be NULL); returns how many,
 * and the rectangle they lie in. */
static size_t gather_members(const builder *b, const hat *h, int32_t *members, double *heights,
                             size_t columns[2], size_t rows[2])
{
	const net_plan *plan = b->plan;
	size_t count = 0;
	columns[0] = plan->u.poles;
	rows[0] = plan->v.poles;
	columns[1] = rows[1] = 0;
	for (int k = h->row - h->width.b + 1; k < h->row + h->width.b; k++)
		for (int i = h->column - h->width.a + 1; i < h->column + h->width.a; i++) {
			if (k < 0 || i < 0 || k >= (int)plan->v.poles || i >= (int)plan->u.poles)
				continue;
			const size_t leader = (size_t)k * plan->u.poles + (size_t)i;
			const size_t *first = b->followers.first + leader;
			for (size_t f = first[0]; f < first[1]; f++, count++) {
				const size_t pole = b->followers.poles[f];
				const size_t column = pole % plan->u.poles;
				const size_t row = pole / plan->u.poles;
				columns[0] = column < columns[0] ? column : columns[0];
				columns[1] = column > columns[1] ? column : columns[1];
				rows[0] = row < rows[0] ? row : rows[0];
				rows[1] = row > rows[1] ? row : rows[1];
				if (members) {
					members[count] = (int32_t)pole;
					heights[count] = height_at(h, (size_t)i, (size_t)k);
				}
			}
		}
	return count;
}

/* The samples that see one of the poles first to last. */
static void see(const net_samples *samples, const size_t poles[2], int32_t *first, int32_t *end)
{
	size_t n = 0;
	while (n < samples->count && (size_t)samples->first[n] + samples->order - 1 < poles[0])
		n++;
	*first = (int32_t)n;
	while (n < samples->count && (size_t)samples->first[n] <= poles[1])
		n++;
	*end = (int32_t)n;
}

/* Marks the spans a direction sees, unless one is taken. */
static bool take_spans(builder *b, const int32_t *direction)
{
	const size_t first_u = (size_t)direction[NET_DIRECTION_SAMPLE] / b->plan->u.points;
	const size_t end_u = (size_t)direction[NET_DIRECTION_SAMPLE_END] / b->plan->u.points;
	const size_t first_v = (size_t)direction[NET_DIRECTION_LINE] / b->plan->v.points;
	const size_t end_v = (size_t)direction[NET_DIRECTION_LINE_END] / b->plan->v.points;
	for (size_t k = first_v; k < end_v; k++)
		for (size_t i = first_u; i < end_u; i++)
			if (b->taken[k * b->spans_u + i])
				return false;
	for (size_t k = first_v; k < end_v; k++)
		memset(b->taken + k * b->spans_u + first_u, 1, end_u - first_u);
	return true;
}

static bool can_move(const builder *b, const hat *h)
{
	const net_plan *plan = b->plan;
	for (int k = h->row - h->width.b + 1; k < h->row + h->width.b; k++)
		for (int i = h->column - h->width.a + 1; i < h->column + h->width.a; i++)
			if (k >= 0 && i >= 0 && k < (int)plan->v.poles && i < (int)plan->u.poles &&
			    b->movable[(size_t)k * plan->u.poles + (size_t)i])
				return true;
	return false;
}

/* Adds a direction if no other of its colour sees what it sees. Whether it is kept depends on the
 * batch, which colour it has does not: a search's result must not depend on its batch. */
static bool add_direction(builder *b, const hat *h)
{
	net_directions *made = &b->made;
	int32_t direction[NET_DIRECTION_SIZE] = { 0 };
	size_t columns[2];
	size_t rows[2];
	const size_t count = gather_members(b, h, NULL, NULL, columns, rows);
	if (count == 0)
		return true;
	see(&b->plan->u, columns, &direction[NET_DIRECTION_SAMPLE],
	    &direction[NET_DIRECTION_SAMPLE_END]);
	see(&b->plan->v, rows, &direction[NET_DIRECTION_LINE], &direction[NET_DIRECTION_LINE_END]);
	if (!take_spans(b, direction))
		return false;
	if (!can_move(b, h))
		return true;
	direction[NET_DIRECTION_COLUMN] = (int32_t)columns[0];
	direction[NET_DIRECTION_COLUMN_END] = (int32_t)columns[1] + 1;
	direction[NET_DIRECTION_ROW] = (int32_t)rows[0];
	direction[NET_DIRECTION_ROW_END] = (int32_t)rows[1] + 1;
	direction[NET_DIRECTION_FIRST] = (int32_t)made->member_count;
	direction[NET_DIRECTION_END] = (int32_t)(made->member_count + count);
	if (!b->counting) {
		(void)gather_members(b, h, made->members + made->member_count,
		                     made->heights + made->member_count, columns, rows);
		memcpy(made->directions + made->direction_count * NET_DIRECTION_SIZE, direction,
		       sizeof direction);
	}
	made->member_count += count;
	made->direction_count++;
	return true;
}

/* Colour after colour takes the directions it can, until none is left. */
static void add_level(builder *b, search_width width)
{
	const net_plan *plan = b->plan;
	const size_t along_u = search_centre_count(plan->u.poles, width.a);
	const size_t along_v = search_centre_count(plan->v.poles, width.b);
	size_t left = along_u * along_v;
	memset(b->placed, 0, left);
	while (left > 0) {
		memset(b->taken, 0, b->spans_u * (plan->v.count / plan->v.points));
		if (!b->counting)
			b->made.colours[b->made.colour_count] = (int32_t)b->made.direction_count;
		b->made.colour_count++;
		for (size_t n = 0; n < along_u * along_v; n++) {
			const hat h = { (int)(n % along_u) * width.a, (int)(n / along_u) * width.b, width };
			if (b->placed[n] || !add_direction(b, &h))
				continue;
			b->placed[n] = 1;
			left--;
		}
	}
}

static void add_levels(builder *b, int stretch, bool counting)
{
	search_width widths[SEARCH_LEVEL_LIMIT];
	const int levels = search_widths_choose(b->plan->u.poles, ldexp(1.0, stretch), b->plan->v.poles,
	                                        1.0, widths);
	b->counting = counting;
	b->made.colour_count = b->made.direction_count = b->made.member_count = 0;
	for (int l = levels - 1; l >= 0; l--)
		add_level(b, widths[l]);
	if (!counting)
		b->made.colours[b->made.colour_count] = (int32_t)b->made.direction_count;
}

static batten_status allocate_directions(batten_context *context, net_directions *made)
{
	made->colours = batten_allocate(context, made->colour_count + 1, sizeof *made->colours);
	made->directions = batten_allocate(context, made->direction_count + 1,
	                                   NET_DIRECTION_SIZE * sizeof *made->directions);
	made->members = batten_allocate(context, made->member_count + 1, sizeof *made->members);
	made->heights = batten_allocate(context, made->member_count + 1, sizeof *made->heights);
	return made->colours && made->directions && made->members && made->heights ? BATTEN_OK
	                                                                           : BATTEN_MEMORY;
}

static void mark_movable(const net_plan *plan, const net_item *item, net_room *rooms,
                         uint8_t *movable)
{
	net_rooms_of(plan, item, rooms);
	for (size_t n = 0; n < net_plan_poles(plan); n++)
		movable[n] |= rooms[n].down < rooms[n].up;
}

batten_status net_directions_create(const net_plan *plan, int stretch, net_directions *out)
{
	batten_context *context = plan->context;
	const size_t poles = net_plan_poles(plan);
	builder b = { .plan = plan, .spans_u = plan->u.count / plan->u.points };
	net_room *rooms = batten_allocate(context, poles, sizeof *rooms);
	b.movable = batten_allocate(context, poles, 1);
	/* A direction more along each side than there are poles, its centre beyond the last. */
	b.placed = batten_allocate(context, plan->u.poles + 1, plan->v.poles + 1);
	b.taken = batten_allocate(context, b.spans_u, plan->v.count / plan->v.points);
	batten_status status = rooms && b.movable && b.placed && b.taken ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = list_followers(plan, &b.followers);
	if (status == BATTEN_OK) {
		for (size_t p = 0; p < plan->count; p++)
			if (!plan->items[p].fault && plan->items[p].stretch == stretch)
				mark_movable(plan, &plan->items[p], rooms, b.movable);
		add_levels(&b, stretch, true);
		status = allocate_directions(context, &b.made);
	}
	if (status == BATTEN_OK) {
		add_levels(&b, stretch, false);
		*out = b.made;
	} else {
		net_directions_release(context, &b.made);
	}
	batten_release(context, b.followers.first);
	batten_release(context, b.followers.poles);
	batten_release(context, rooms);
	batten_release(context, b.movable);
	batten_release(context, b.placed);
	batten_release(context, b.taken);
	return status;
}

void net_directions_release(batten_context *context, net_directions *directions)
{
	batten_release(context, directions->colours);
	batten_release(context, directions->directions);
	batten_release(context, directions->members);
	batten_release(context, directions->heights);
	*directions = (net_directions){ 0 };
}

uint64_t net_directions_moving(const net_plan *plan, const net_room *rooms)
{
	const net_directions *made = &plan->directions;
	uint64_t moving = 0;
	for (size_t d = 0; d < made->direction_count; d++) {
		const int32_t *direction = made->directions + d * NET_DIRECTION_SIZE;
		bool moves = false;
		for (int32_t m = direction[NET_DIRECTION_FIRST]; m < direction[NET_DIRECTION_END]; m++)
			moves |= rooms[made->members[m]].down < rooms[made->members[m]].up;
		moving += moves;
	}
	return moving;
}
