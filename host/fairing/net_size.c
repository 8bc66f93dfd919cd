#include "fairing/net_size.h"

/* Points of the longest line of one direction. */
static batten_status longest_line(const batten_hull *hull, bool waterlines, size_t *out)
{
	const size_t lines = waterlines ? hull->waterline_count : hull->station_count;
	*out = 0;
	for (size_t i = 0; i < lines; i++) {
		hull_line line;
		const batten_status status = hull_line_collect(hull, waterlines, i, false, &line);
		if (status != BATTEN_OK)
			return status;
		if (line.count > *out)
			*out = line.count;
		hull_line_release(hull, &line);
	}
	return BATTEN_OK;
}

static size_t between(size_t value, size_t least, size_t most)
{
	return value < least ? least : value > most ? most : value;
}

batten_status net_size_choose(const batten_hull *hull, batten_fit_options *fit)
{
	size_t along = 0;
	size_t up = 0;
	batten_status status = longest_line(hull, true, &along);
	if (status == BATTEN_OK)
		status = longest_line(hull, false, &up);
	if (status != BATTEN_OK)
		return status;
	size_t points = hull->end_count + hull->profile_count;
	for (size_t n = 0; n < hull_node_count(hull); n++)
		points += hull->nodes[n] == BATTEN_NODE_GIVEN;
	const size_t most = 7 * points / 10;
	const bool choose_u = fit->count_u == 0;
	const bool choose_v = fit->count_v == 0;
	if (choose_u)
		fit->count_u = between((8 * along + 9) / 10, fit->order_u, NET_SIZE_MOST);
	if (choose_v)
		fit->count_v = between((7 * up + 9) / 10, fit->order_v, NET_SIZE_MOST);
	while (choose_v && fit->count_v > fit->order_v && fit->count_u * fit->count_v > most)
		fit->count_v--;
	while (choose_u && fit->count_u > fit->order_u && fit->count_u * fit->count_v > most)
		fit->count_u--;
	return BATTEN_OK;
}
