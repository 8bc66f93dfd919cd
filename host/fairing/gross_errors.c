#include "fairing/gross_errors.h"

#include "core/number.h"

#include "core/spline.h"
#include "fairing/lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* NPL's misprint stands at 121 times its line's median; no sound offset of the shipped hulls passes
 * all conditions at more than 9 times. */
#define GROSS_ERROR_SCALE 12.0
#define CROSSING_SCALE 5.0
#define LEAST_PART_OF_HALF_BEAM 0.005
enum { PASS_LIMIT = 10 };

/* How far each node is off its lines. */
typedef struct evidence {
	double *off[2]; /* [section, waterline]: distance from the neighbours' cubic; NaN: no telling */
	double *ratio[2]; /* the same over the line's median */
	uint8_t *mark[2]; /* 1 where the second differences alternate */
} evidence;

static void evidence_release(batten_context *context, evidence *e)
{
	for (int d = 0; d < 2; d++) {
		batten_release(context, e->off[d]);
		batten_release(context, e->ratio[d]);
		batten_release(context, e->mark[d]);
	}
}

static batten_status evidence_create(batten_context *context, size_t nodes, evidence *e)
{
	for (int d = 0; d < 2; d++) {
		e->off[d] = batten_allocate(context, nodes, sizeof(double));
		e->ratio[d] = batten_allocate(context, nodes, sizeof(double));
		e->mark[d] = batten_allocate(context, nodes, 1);
		if (!e->off[d] || !e->ratio[d] || !e->mark[d])
			return BATTEN_MEMORY;
	}
	return BATTEN_OK;
}

/* Distance of point j from the cubic through points j-2, j-1, j+1, j+2. */
static double off_cubic(const hull_line *line, size_t j)
{
	const size_t around[4] = { j - 2, j - 1, j + 1, j + 2 };
	double value = 0.0;
	for (int a = 0; a < 4; a++) {
		double weight = 1.0;
		for (int b = 0; b < 4; b++)
			if (a != b)
				weight *= (line->along_m[j] - line->along_m[around[b]]) /
				          (line->along_m[around[a]] - line->along_m[around[b]]);
		value += weight * line->value_m[around[a]];
	}
	return line->value_m[j] - value;
}

static double second_difference(const hull_line *line, size_t j)
{
	double difference = 0.0;
	lines_second_differences(3, line->along_m + j - 1, line->value_m + j - 1, &difference);
	return difference;
}

/* One wrong value at j adds e, -(..) e, e to the second differences at j-1, j, j+1, with weights that
 * the spacing gives. Both neighbours must show at least a quarter of what it would leave there. */
static bool shows_single_error(const hull_line *line, size_t j)
{
	const double *x = line->along_m;
	const double below = x[j] - x[j - 1];
	const double above = x[j + 1] - x[j];
	const double here = -(1.0 / below + 1.0 / above) / (0.5 * (below + above));
	const double aft = 1.0 / below / (0.5 * (x[j] - x[j - 2]));
	const double fore = 1.0 / above / (0.5 * (x[j + 2] - x[j]));
	const double size = second_difference(line, j) / here;
	return second_difference(line, j - 1) / aft / size > 0.25 &&
	       second_difference(line, j + 1) / fore / size > 0.25;
}

static bool judged(const batten_hull *hull, bool waterline, size_t number, const hull_line *line,
                   size_t j)
{
	return j >= 2 && j + 2 < line->count &&
	       !hull_knuckle_between(hull, waterline, number, line->along_m[j - 2],
	                             line->along_m[j + 2]);
}

/* Fills in the evidence of one line. sorted has room for its points. */
static void examine(const batten_hull *hull, bool waterline, size_t number, const hull_line *line,
                    double *sorted, evidence *e)
{
	size_t count = 0;
	for (size_t j = 0; j < line->count; j++)
		if (judged(hull, waterline, number, line, j))
			sorted[count++] = fabs(off_cubic(line, j));
	if (count == 0)
		return;
	qsort(sorted, count, sizeof *sorted, batten_number_compare);
	const double median = sorted[count / 2];
	for (size_t j = 0; j < line->count; j++) {
		if (line->place[j] == SIZE_MAX || !judged(hull, waterline, number, line, j))
			continue;
		const size_t node = waterline ? number * hull->station_count + line->place[j]
		                              : line->place[j] * hull->station_count + number;
		const double off = off_cubic(line, j);
		e->off[waterline][node] = off;
		e->ratio[waterline][node] = median > 0.0 ? fabs(off) / median : off != 0.0 ? HUGE_VAL : 0.0;
		e->mark[waterline][node] = shows_single_error(line, j);
	}
}

static batten_status gather(const batten_hull *hull, double *sorted, evidence *e)
{
	for (size_t n = 0; n < hull_node_count(hull); n++)
		for (int d = 0; d < 2; d++) {
			e->off[d][n] = NAN;
			e->ratio[d][n] = 0.0;
			e->mark[d][n] = 0;
		}
	for (int waterline = 0; waterline < 2; waterline++) {
		const size_t lines = waterline ? hull->waterline_count : hull->station_count;
		for (size_t number = 0; number < lines; number++) {
			hull_line line = { 0 };
			const batten_status status = hull_line_collect(hull, waterline, number, false, &line);
			if (status != BATTEN_OK)
				return status;
			examine(hull, waterline, number, &line, sorted, e);
			hull_line_release(hull, &line);
		}
	}
	return BATTEN_OK;
}

static bool is_positive(const batten_hull *hull, size_t station, size_t waterline)
{
	return hull->y_m[waterline * hull->station_count + station] > 0.0;
}

/* A 0 with positive offsets on all four sides is no profile point but a wrong value. */
static bool is_profile(const batten_hull *hull, size_t node)
{
	const size_t i = node % hull->station_count;
	const size_t k = node / hull->station_count;
	if (hull->y_m[node] > 0.0)
		return false;
	if (i == 0 || k == 0 || i + 1 == hull->station_count || k + 1 == hull->waterline_count)
		return true;
	return !is_positive(hull, i - 1, k) || !is_positive(hull, i + 1, k) ||
	       !is_positive(hull, i, k - 1) || !is_positive(hull, i, k + 1);
}

/* How strongly a node is a gross error as direction d shows it; 0 when it is none. */
static double strength(const batten_hull *hull, const evidence *e, size_t node, int d, double least)
{
	const double off = e->off[d][node];
	const double crossing = e->off[1 - d][node];
	if (hull->nodes[node] != BATTEN_NODE_GIVEN || is_profile(hull, node) || !e->mark[d][node] ||
	    !(fabs(off) > least))
		return 0.0;
	const double ratio = e->ratio[d][node];
	if (isnan(crossing))
		return ratio > 2.0 * GROSS_ERROR_SCALE && fabs(off) > 2.0 * least ? ratio : 0.0;
	const bool agrees = crossing * off > 0.0 && e->ratio[1 - d][node] > CROSSING_SCALE;
	return agrees && ratio > GROSS_ERROR_SCALE ? ratio : 0.0;
}

static double node_strength(const batten_hull *hull, const evidence *e, size_t node, double least,
                            bool *waterline)
{
	const double section = strength(hull, e, node, 0, least);
	const double along = strength(hull, e, node, 1, least);
	if (waterline)
		*waterline = along > section;
	return fmax(section, along);
}

/* Whether no node within two nodes shows more: an error spoils what is measured there. */
static bool is_worst_around(const batten_hull *hull, const evidence *e, size_t station,
                            size_t waterline, double own, double least)
{
	const size_t nx = hull->station_count;
	for (size_t k = waterline > 2 ? waterline - 2 : 0;
	     k <= waterline + 2 && k < hull->waterline_count; k++)
		for (size_t i = station > 2 ? station - 2 : 0; i <= station + 2 && i < nx; i++) {
			const size_t node = k * nx + i;
			const double other = node_strength(hull, e, node, least, NULL);
			if (other > own || (other == own && node < waterline * nx + station))
				return false;
		}
	return true;
}

/* The value the rest of the line asks for at one of its points. */
static batten_status spline_through_rest(const batten_hull *hull, bool waterline, size_t number,
                                         size_t place, double *value)
{
	hull_line line = { 0 };
	batten_status status = hull_line_collect(hull, waterline, number, false, &line);
	if (status != BATTEN_OK)
		return status;
	double at = 0.0;
	size_t rest = 0;
	for (size_t j = 0; j < line.count; j++) {
		if (line.place[j] == place) {
			at = line.along_m[j];
			continue;
		}
		line.along_m[rest] = line.along_m[j];
		line.value_m[rest++] = line.value_m[j];
	}
	struct spline spline;
	status = spline_create(hull->context, rest, line.along_m, line.value_m, SPLINE_NOT_A_KNOT,
	                       &spline);
	if (status == BATTEN_OK) {
		*value = fmax(0.0, spline_value(&spline, at));
		spline_destroy(&spline);
	}
	hull_line_release(hull, &line);
	return status;
}

/* Replaces the worst offsets of this pass; *found counts them. entry: 1 + number in list of a node. */
static batten_status replace(batten_hull *hull, const evidence *e, const uint8_t *locked,
                             double least, batten_replacement *list, size_t *entry, size_t *count,
                             size_t *found)
{
	const size_t nx = hull->station_count;
	*found = 0;
	for (size_t i = 0; i < nx; i++)
		for (size_t k = 0; k < hull->waterline_count; k++) {
			const size_t node = k * nx + i;
			bool waterline = false;
			const double own = node_strength(hull, e, node, least, &waterline);
			/* A locked offset is right, but still the reason why its neighbours look wrong. */
			if (own == 0.0 || (locked && locked[node]) ||
			    !is_worst_around(hull, e, i, k, own, least))
				continue;
			double value = 0.0;
			const batten_status status = spline_through_rest(hull, waterline, waterline ? k : i,
			                                                 waterline ? i : k, &value);
			if (status != BATTEN_OK)
				return status;
			/* Replaced again in a later pass, it stays one replacement. */
			if (entry[node] == 0) {
				list[*count] = (batten_replacement){
					i, k, hull->x_m[i], hull->z_m[k], hull->y_m[node], 0.0
				};
				entry[node] = ++*count;
			}
			list[entry[node] - 1].new_m = value;
			hull->y_m[node] = value;
			++*found;
		}
	return BATTEN_OK;
}

static int compare_replacements(const void *a, const void *b)
{
	const batten_replacement *left = a;
	const batten_replacement *right = b;
	if (left->station != right->station)
		return left->station < right->station ? -1 : 1;
	return left->waterline < right->waterline ? -1 : left->waterline > right->waterline;
}

batten_status gross_errors_replace(batten_hull *hull, const uint8_t *locked,
                                   batten_replacement **replacements, size_t *count)
{
	batten_context *context = hull->context;
	const size_t nodes = hull_node_count(hull);
	const double least = LEAST_PART_OF_HALF_BEAM * batten_hull_half_beam_m(hull);
	evidence e = { { NULL, NULL }, { NULL, NULL }, { NULL, NULL } };
	size_t done = 0;
	double *sorted = batten_allocate(context, nodes + hull->end_count + hull->profile_count + 1,
	                                 sizeof *sorted);
	size_t *entry = batten_allocate(context, nodes, sizeof *entry);
	batten_replacement *list = batten_allocate(context, nodes, sizeof *list);
	batten_status status = sorted && entry && list ? evidence_create(context, nodes, &e)
	                                               : BATTEN_MEMORY;
	for (int pass = 0; pass < PASS_LIMIT && status == BATTEN_OK; pass++) {
		size_t found = 0;
		status = gather(hull, sorted, &e);
		if (status == BATTEN_OK)
			status = replace(hull, &e, locked, least, list, entry, &done, &found);
		if (found == 0)
			break;
	}
	evidence_release(context, &e);
	batten_release(context, sorted);
	batten_release(context, entry);
	if (status != BATTEN_OK) {
		batten_release(context, list);
		return status;
	}
	qsort(list, done, sizeof *list, compare_replacements);
	*count = done;
	*replacements = list;
	return BATTEN_OK;
}
