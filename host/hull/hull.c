/* The life of a hull, and what the public interface shows of it. */
#include "hull/hull.h"

#include "core/runs.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

batten_hull *hull_allocate(batten_context *context, size_t station_count, size_t waterline_count)
{
	batten_hull *hull = batten_allocate(context, 1, sizeof *hull);
	if (!hull)
		return NULL;
	hull->context = context;
	hull->depth_m = NAN;
	hull->station_count = station_count;
	hull->waterline_count = waterline_count;
	/* At most 4096 by 4096: the product cannot overflow. */
	size_t nodes = station_count * waterline_count;
	hull->x_m = batten_allocate(context, station_count, sizeof *hull->x_m);
	hull->z_m = batten_allocate(context, waterline_count, sizeof *hull->z_m);
	hull->y_m = batten_allocate(context, nodes, sizeof *hull->y_m);
	hull->nodes = batten_allocate(context, nodes, sizeof *hull->nodes);
	if (!hull->x_m || !hull->z_m || !hull->y_m || !hull->nodes) {
		batten_hull_destroy(hull);
		return NULL;
	}
	return hull;
}

static size_t label_count(const batten_hull *hull)
{
	return hull->layout == HULL_LAYOUT_LONG_STATIONS ? hull->station_count : hull->waterline_count;
}

void batten_hull_destroy(batten_hull *hull)
{
	if (!hull)
		return;
	batten_context *context = hull->context;
	if (hull->labels)
		for (size_t i = 0; i < label_count(hull); i++)
			batten_release(context, hull->labels[i]);
	batten_release(context, hull->labels);
	batten_release(context, hull->name);
	batten_release(context, hull->source);
	batten_release(context, hull->x_m);
	batten_release(context, hull->z_m);
	batten_release(context, hull->y_m);
	batten_release(context, hull->nodes);
	batten_release(context, hull->ends);
	batten_release(context, hull->profile);
	batten_release(context, hull->knuckles);
	batten_release(context, hull);
}

/* NULL when memory is out; *good is then false. */
static void *copy_array(batten_context *context, const void *array, size_t count, size_t size,
                        bool *good)
{
	if (!array)
		return NULL;
	void *copy = batten_allocate(context, count, size);
	if (!copy)
		*good = false;
	else if (count > 0)
		memcpy(copy, array, count * size);
	return copy;
}

static char *copy_text(batten_context *context, const char *text, bool *good)
{
	char *copy = batten_copy_text(context, text);
	if (!copy)
		*good = false;
	return copy;
}

static bool copy_parts(batten_context *context, const batten_hull *from, batten_hull *to)
{
	bool good = true;
	to->name = copy_text(context, from->name, &good);
	to->source = copy_text(context, from->source, &good);
	to->ends = copy_array(context, from->ends, from->end_count, sizeof *from->ends, &good);
	to->profile = copy_array(context, from->profile, from->profile_count, sizeof *from->profile,
	                         &good);
	to->knuckles = copy_array(context, from->knuckles, from->knuckle_count, sizeof *from->knuckles,
	                          &good);
	if (from->labels) {
		to->labels = batten_allocate(context, label_count(from), sizeof *to->labels);
		good = good && to->labels;
		for (size_t i = 0; good && i < label_count(from); i++)
			to->labels[i] = copy_text(context, from->labels[i], &good);
	}
	return good;
}

batten_status batten_hull_clone(batten_context *context, const batten_hull *hull, batten_hull **out)
{
	*out = NULL;
	batten_hull *clone = hull_allocate(context, hull->station_count, hull->waterline_count);
	if (!clone)
		return BATTEN_MEMORY;
	size_t nodes = hull_node_count(hull);
	clone->unit = hull->unit;
	clone->frame = hull->frame;
	clone->layout = hull->layout;
	clone->lbp_m = hull->lbp_m;
	clone->draft_m = hull->draft_m;
	clone->depth_m = hull->depth_m;
	clone->end_count = hull->end_count;
	clone->profile_count = hull->profile_count;
	clone->knuckle_count = hull->knuckle_count;
	memcpy(clone->x_m, hull->x_m, hull->station_count * sizeof *hull->x_m);
	memcpy(clone->z_m, hull->z_m, hull->waterline_count * sizeof *hull->z_m);
	memcpy(clone->y_m, hull->y_m, nodes * sizeof *hull->y_m);
	memcpy(clone->nodes, hull->nodes, nodes * sizeof *hull->nodes);
	if (!copy_parts(context, hull, clone)) {
		batten_hull_destroy(clone);
		return BATTEN_MEMORY;
	}
	*out = clone;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * From arrays
 * --------------------------------------------------------------------------------------------- */

static batten_status check_coordinates(batten_context *context, const char *what, size_t count,
                                       const double *values)
{
	if (count < 2 || count > HULL_LINES_MOST)
		return batten_fail(context, BATTEN_USAGE, "%zu %s, expected 2 to %d", count, what,
		                   HULL_LINES_MOST);
	for (size_t i = 0; i < count; i++) {
		if (!(fabs(values[i]) <= HULL_LARGEST_M))
			return batten_fail(context, BATTEN_USAGE,
			                   "%s: number %zu is %g, expected a length of at most %g m", what,
			                   i + 1, values[i], HULL_LARGEST_M);
		if (i > 0 && !(values[i] - values[i - 1] >= HULL_SMALLEST_STEP_M))
			return batten_fail(context, BATTEN_USAGE,
			                   "%s: number %zu is %g, expected more than the %g before it", what,
			                   i + 1, values[i], values[i - 1]);
	}
	return BATTEN_OK;
}

static batten_status check_length(batten_context *context, const char *what, double value)
{
	if (!(value >= HULL_SMALLEST_STEP_M && value <= HULL_LARGEST_M))
		return batten_fail(context, BATTEN_USAGE,
		                   "%s is %g, expected a length above 0 and up to %g m", what, value,
		                   HULL_LARGEST_M);
	return BATTEN_OK;
}

static batten_status check_table(batten_context *context, const batten_hull_table *table)
{
	batten_status status = check_coordinates(context, "stations", table->station_count, table->x_m);
	if (status == BATTEN_OK)
		status = check_coordinates(context, "waterlines", table->waterline_count, table->z_m);
	if (status == BATTEN_OK)
		status = check_length(context, "lbp", table->lbp_m);
	if (status == BATTEN_OK)
		status = check_length(context, "draft", table->draft_m);
	size_t nodes = status == BATTEN_OK ? table->station_count * table->waterline_count : 0;
	for (size_t i = 0; i < nodes; i++) {
		if (table->nodes && table->nodes[i] > BATTEN_NODE_UNKNOWN)
			return batten_fail(context, BATTEN_USAGE, "node %zu is of no known kind", i);
		bool given = !table->nodes || table->nodes[i] == BATTEN_NODE_GIVEN;
		if (given && !(table->y_m[i] >= 0 && table->y_m[i] <= HULL_LARGEST_M))
			return batten_fail(context, BATTEN_USAGE,
			                   "node %zu: half-breadth %g, expected 0 to %g m", i, table->y_m[i],
			                   HULL_LARGEST_M);
	}
	return status;
}

static void take_table(batten_hull *hull, const batten_hull_table *table)
{
	hull->lbp_m = table->lbp_m;
	hull->draft_m = table->draft_m;
	/* Adding 0 turns a negative zero into 0. */
	for (size_t i = 0; i < hull->station_count; i++)
		hull->x_m[i] = table->x_m[i] + 0.0;
	for (size_t i = 0; i < hull->waterline_count; i++)
		hull->z_m[i] = table->z_m[i] + 0.0;
	for (size_t i = 0; i < hull_node_count(hull); i++) {
		hull->nodes[i] = table->nodes ? table->nodes[i] : (uint8_t)BATTEN_NODE_GIVEN;
		hull->y_m[i] = hull->nodes[i] == BATTEN_NODE_GIVEN ? table->y_m[i] + 0.0 : 0;
	}
}

batten_status batten_hull_create(batten_context *context, const batten_hull_table *table,
                                 batten_hull **out)
{
	*out = NULL;
	batten_status status = check_table(context, table);
	if (status != BATTEN_OK)
		return status;
	batten_hull *hull = hull_allocate(context, table->station_count, table->waterline_count);
	if (!hull)
		return BATTEN_MEMORY;
	take_table(hull, table);
	const char *name = table->name && table->name[0] ? table->name : "hull";
	status = hull_clean_text(context, name, strlen(name), &hull->name);
	if (status == BATTEN_OK)
		status = hull_clean_text(context, "", 0, &hull->source);
	size_t filled = 0;
	if (status == BATTEN_OK)
		status = hull_fill_unknown(hull, &filled);
	if (status != BATTEN_OK) {
		batten_hull_destroy(hull);
		return status == BATTEN_INPUT ? BATTEN_USAGE : status;
	}
	*out = hull;
	return BATTEN_OK;
}

batten_status batten_hull_set_y(batten_context *context, batten_hull *hull, const double *y_m)
{
	size_t nodes = hull_node_count(hull);
	for (size_t i = 0; i < nodes; i++)
		if (hull->nodes[i] != BATTEN_NODE_OUTSIDE && !(y_m[i] >= 0 && y_m[i] <= HULL_LARGEST_M))
			return batten_fail(context, BATTEN_USAGE,
			                   "node %zu: half-breadth %g, expected 0 to %g m", i, y_m[i],
			                   HULL_LARGEST_M);
	for (size_t i = 0; i < nodes; i++)
		if (hull->nodes[i] != BATTEN_NODE_OUTSIDE)
			hull->y_m[i] = y_m[i] + 0.0;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Views
 * --------------------------------------------------------------------------------------------- */

const char *hull_unit_text(hull_unit unit)
{
	static const char *const texts[] = {
		[HULL_UNIT_M] = "m", [HULL_UNIT_MM] = "mm", [HULL_UNIT_FT] = "ft"
	};
	return texts[unit];
}

const char *hull_frame_text(hull_frame frame)
{
	static const char *const texts[] = { [HULL_FRAME_AP_FWD] = "ap-fwd",
		                                 [HULL_FRAME_MID_FWD] = "mid-fwd",
		                                 [HULL_FRAME_FP_AFT] = "fp-aft",
		                                 [HULL_FRAME_GHS] = "ghs",
		                                 [HULL_FRAME_WATERLINE] = "waterline" };
	return texts[frame];
}

const char *batten_hull_name(const batten_hull *hull)
{
	return hull->name;
}

const char *batten_hull_source(const batten_hull *hull)
{
	return hull->source;
}

const char *batten_hull_unit(const batten_hull *hull)
{
	return hull_unit_text(hull->unit);
}

const char *batten_hull_frame(const batten_hull *hull)
{
	return hull_frame_text(hull->frame);
}

const char *batten_hull_layout(const batten_hull *hull)
{
	return hull->layout == HULL_LAYOUT_GRID ? "grid" : "long";
}

double batten_hull_lbp_m(const batten_hull *hull)
{
	return hull->lbp_m;
}

double batten_hull_draft_m(const batten_hull *hull)
{
	return hull->draft_m;
}

size_t batten_hull_station_count(const batten_hull *hull)
{
	return hull->station_count;
}

size_t batten_hull_waterline_count(const batten_hull *hull)
{
	return hull->waterline_count;
}

const double *batten_hull_x_m(const batten_hull *hull)
{
	return hull->x_m;
}

const double *batten_hull_z_m(const batten_hull *hull)
{
	return hull->z_m;
}

const double *batten_hull_y_m(const batten_hull *hull)
{
	return hull->y_m;
}

const uint8_t *batten_hull_nodes(const batten_hull *hull)
{
	return hull->nodes;
}

size_t hull_node_count(const batten_hull *hull)
{
	return hull->station_count * hull->waterline_count;
}

bool hull_same_table(const batten_hull *a, const batten_hull *b)
{
	return a == b ||
	       (a->station_count == b->station_count && a->waterline_count == b->waterline_count &&
	        memcmp(a->x_m, b->x_m, a->station_count * sizeof *a->x_m) == 0 &&
	        memcmp(a->z_m, b->z_m, a->waterline_count * sizeof *a->z_m) == 0);
}

/* Nodes looked at together. */
enum { LOOK = 64 };

/* Filled '?' nodes do not count: a spline may overshoot the given breadth. */
INLINED void look_widest(size_t count, const uint8_t *restrict nodes, const double *restrict y_m,
                         double *restrict out)
{
	double given[LOOK] = { 0 }, most[RUN_LENGTH] = { 0 };
	for (size_t first = 0; first < count; first += LOOK) {
		const size_t here = first + LOOK < count ? LOOK : count - first;
		for (size_t l = 0; l < here; l++) {
			const double y = y_m[first + l];
			given[l] = nodes[first + l] == BATTEN_NODE_GIVEN ? y : 0.0;
		}
		/* What is left of the nodes before is looked at twice. */
		for (size_t r = 0; r < LOOK; r += RUN_LENGTH)
			RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++)
			most[l] = given[r + l] > most[l] ? given[r + l] : most[l];
	}
	double largest = 0;
	for (size_t l = 0; l < RUN_LENGTH; l++)
		largest = most[l] > largest ? most[l] : largest;
	*out = largest;
}

RUNS_FUNCTION(find_widest, look_widest,
              (size_t count, const uint8_t *nodes, const double *y_m, double *out),
              (count, nodes, y_m, out))

double hull_widest_node_m(size_t count, const uint8_t *nodes, const double *y_m)
{
	double largest = 0;
	find_widest(count, nodes, y_m, &largest);
	return largest;
}

double batten_hull_half_beam_m(const batten_hull *hull)
{
	double largest = hull_widest_node_m(hull_node_count(hull), hull->nodes, hull->y_m);
	for (size_t i = 0; i < hull->end_count; i++)
		if (hull->ends[i].y_m > largest)
			largest = hull->ends[i].y_m;
	return largest;
}
