/* All lines of a hull with their fairness: stations, waterlines, and buttocks and diagonals cut out
 * of the sections (thesis 4.4). */
#include "batten.h"
#include "core/spline.h"
#include "fairing/lines.h"

#include <math.h>
#include <string.h>

/* Lines cut out of the sections: for every one and every station where it crosses, its value. */
struct cuts {
	size_t buttock_count, diagonal_count;
	double *at_m; /* y of the buttocks, then heights of the diagonals */
	/* [lines][stations]; NaN where a section is not crossed, infinite where '?' cells hide it */
	double *value_m;
};

static size_t cut_count(const struct cuts *cuts)
{
	return cuts->buttock_count + cuts->diagonal_count;
}

/* Buttocks at the fractions of the half-beam that the waterlines between the lowest and the highest
 * are of the table's depth; diagonals through every waterline's height but the lowest. */
static void count_cuts(const batten_hull *hull, struct cuts *cuts)
{
	cuts->buttock_count = hull->waterline_count - 2;
	cuts->diagonal_count = hull->waterline_count - 1;
}

static void place_cuts(const batten_hull *hull, struct cuts *cuts)
{
	double half_beam = batten_hull_half_beam_m(hull);
	double low = hull->z_m[0], depth = hull->z_m[hull->waterline_count - 1] - low;
	for (size_t i = 0; i < cuts->buttock_count; i++)
		cuts->at_m[i] = half_beam * ((hull->z_m[i + 1] - low) / depth);
	for (size_t i = 0; i < cuts->diagonal_count; i++)
		cuts->at_m[cuts->buttock_count + i] = hull->z_m[i + 1];
}

/* Height between points i and i + 1 of a section where y + lean z = wanted, which lies between the
 * values at both. Newton's steps, halving where one would leave the bracket. */
static double crossing(const struct spline *shape, size_t i, double lean, double wanted)
{
	double low = shape->x[i], high = shape->x[i + 1], at = 0.5 * (low + high);
	double enough = 1e-15 * (high - low) + 4e-16 * fmax(fabs(low), fabs(high));
	for (int k = 0; k < 64 && high - low > enough; k++) {
		double excess = spline_value(shape, at) + lean * at - wanted;
		if (excess < 0)
			low = at;
		else
			high = at;
		double next = at - excess / (spline_slope(shape, at) + lean);
		if (fabs(next - at) <= enough)
			return at;
		at = next > low && next < high ? next : 0.5 * (low + high);
	}
	return at;
}

/* Lowest heights at which a section crosses y + lean z = at[k], at ascending, lean 0 or 1; NaN
 * where it does not. A section that begins outside of the line is taken to have a flat bottom
 * there. All values up to the largest one met so far are found, so every interval is looked at
 * once. */
static void cut_section(const struct spline *shape, double lean, size_t count, const double *at,
                        double *height)
{
	double lowest = shape->x[0], reached = shape->y[0] + lean * lowest;
	size_t k = 0;
	for (; k < count && at[k] <= reached; k++)
		height[k] = at[k] > lean * lowest ? lowest : NAN;
	for (size_t i = 0; i + 1 < shape->count; i++) {
		double next = shape->y[i + 1] + lean * shape->x[i + 1];
		for (; k < count && at[k] <= next; k++)
			height[k] = crossing(shape, i, lean, at[k]);
	}
	for (; k < count; k++)
		height[k] = NAN;
}

static bool section_has_unknown(const batten_hull *hull, size_t station)
{
	for (size_t j = 0; j < hull->waterline_count; j++)
		if (hull->nodes[j * hull->station_count + station] == BATTEN_NODE_UNKNOWN)
			return true;
	return false;
}

/* What all cuts have at one station. */
static batten_status cut_station(const batten_hull *hull, size_t station, struct cuts *cuts,
                                 double *height)
{
	hull_line points;
	batten_status status = hull_line_collect(hull, false, station, false, &points);
	if (status != BATTEN_OK)
		return status;
	size_t total = cut_count(cuts), buttocks = cuts->buttock_count;
	struct spline shape = { 0 };
	if (points.count >= 2) {
		status = spline_create(hull->context, points.count, points.along_m, points.value_m,
		                       SPLINE_NOT_A_KNOT, &shape);
		if (status == BATTEN_OK) {
			cut_section(&shape, 0, buttocks, cuts->at_m, height);
			cut_section(&shape, 1, cuts->diagonal_count, cuts->at_m + buttocks, height + buttocks);
			spline_destroy(&shape);
		}
	}
	double unseen = section_has_unknown(hull, station) ? INFINITY : NAN;
	for (size_t k = 0; k < total; k++) {
		double value = points.count < 2 ? unseen : height[k];
		if (k >= buttocks)
			value = (cuts->at_m[k] - value) * sqrt(2);
		cuts->value_m[k * hull->station_count + station] = value;
	}
	hull_line_release(hull, &points);
	return status;
}

static void cuts_destroy(batten_context *context, struct cuts *cuts)
{
	batten_release(context, cuts->at_m);
	batten_release(context, cuts->value_m);
	*cuts = (struct cuts){ 0 };
}

/* at_m of the cuts is that of hull like, so that both are cut by the same planes. */
static batten_status cuts_create(batten_context *context, const batten_hull *hull,
                                 const batten_hull *like, struct cuts *out)
{
	struct cuts cuts;
	count_cuts(hull, &cuts);
	size_t total = cut_count(&cuts);
	cuts.at_m = batten_allocate(context, total, sizeof *cuts.at_m);
	cuts.value_m = batten_allocate(context, total * hull->station_count, sizeof *cuts.value_m);
	double *height = batten_allocate(context, total, sizeof *height);
	batten_status status = cuts.at_m && cuts.value_m && height ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		place_cuts(like, &cuts);
	for (size_t i = 0; i < hull->station_count && status == BATTEN_OK; i++)
		status = cut_station(hull, i, &cuts, height);
	batten_release(context, height);
	if (status != BATTEN_OK) {
		cuts_destroy(context, &cuts);
		return status;
	}
	*out = cuts;
	return BATTEN_OK;
}

/* One cut as a line: the stations it has a value at, in pieces where a section between is not
 * crossed. Stations that '?' cells hide are passed over. */
static batten_status describe_cut(const batten_hull *hull, const double *value,
                                  const double *reference, batten_line *out)
{
	hull_line points = { 0 };
	points.along_m = batten_allocate(hull->context, hull->station_count, sizeof(double));
	points.value_m = batten_allocate(hull->context, hull->station_count, sizeof(double));
	batten_status status = points.along_m && points.value_m ? BATTEN_OK : BATTEN_MEMORY;
	double sum = 0;
	size_t interior = 0;
	for (size_t i = 0; status == BATTEN_OK && i <= hull->station_count; i++) {
		if (i < hull->station_count && isinf(value[i]))
			continue;
		if (i < hull->station_count && !isnan(value[i])) {
			points.along_m[points.count] = hull->x_m[i];
			points.value_m[points.count++] = value[i];
			out->point_count++;
			if (reference && isfinite(reference[i]))
				out->change_max_m = fmax(out->change_max_m, fabs(value[i] - reference[i]));
			continue;
		}
		if (points.count >= 3) {
			sum += lines_fairness(points.count, points.along_m, points.value_m);
			interior += points.count - 2;
			out->inflections += lines_inflections(points.count, points.along_m, points.value_m);
		}
		points.count = 0;
	}
	out->fn_per_m2 = interior > 0 ? sum : NAN;
	hull_line_release(hull, &points);
	return status;
}

static batten_status describe_cuts(batten_context *context, const batten_hull *hull,
                                   const batten_hull *reference, batten_line *lines)
{
	const batten_hull *like = reference ? reference : hull;
	struct cuts cuts = { 0 }, before = { 0 };
	batten_status status = cuts_create(context, hull, like, &cuts);
	if (status == BATTEN_OK && reference)
		status = cuts_create(context, reference, like, &before);
	for (size_t k = 0; status == BATTEN_OK && k < cut_count(&cuts); k++) {
		lines[k] = (batten_line){
			.kind = k < cuts.buttock_count ? BATTEN_LINE_BUTTOCK : BATTEN_LINE_DIAGONAL,
			.coordinate_m = cuts.at_m[k],
		};
		size_t first = k * hull->station_count;
		status = describe_cut(hull, cuts.value_m + first, reference ? before.value_m + first : NULL,
		                      &lines[k]);
	}
	cuts_destroy(context, &before);
	cuts_destroy(context, &cuts);
	return status;
}

static batten_status describe_own_line(const batten_hull *hull, const batten_hull *reference,
                                       bool waterline, size_t line, batten_line *out)
{
	hull_line points;
	batten_status status = hull_line_collect(hull, waterline, line, false, &points);
	if (status != BATTEN_OK)
		return status;
	lines_sum sum = lines_of_points(hull, waterline, line, &points);
	*out = (batten_line){
		.kind = waterline ? BATTEN_LINE_WATERLINE : BATTEN_LINE_STATION,
		.coordinate_m = waterline ? hull->z_m[line] : hull->x_m[line],
		.point_count = points.count,
		.fn_per_m2 = sum.interior_count > 0 ? sum.fn_per_m2 : NAN,
		.inflections = sum.inflections,
	};
	for (size_t i = 0; reference && i < points.count; i++) {
		if (points.place[i] == SIZE_MAX)
			continue;
		size_t node = waterline ? line * hull->station_count + points.place[i]
		                        : points.place[i] * hull->station_count + line;
		out->change_max_m = fmax(out->change_max_m, fabs(hull->y_m[node] - reference->y_m[node]));
	}
	hull_line_release(hull, &points);
	return BATTEN_OK;
}

batten_status batten_hull_lines(batten_context *context, const batten_hull *hull,
                                const batten_hull *reference, batten_line *lines, size_t capacity,
                                size_t *count)
{
	struct cuts cuts;
	count_cuts(hull, &cuts);
	size_t own = hull->station_count + hull->waterline_count;
	size_t total = own + cut_count(&cuts);
	if (capacity == 0) {
		*count = total;
		return BATTEN_OK;
	}
	if (capacity < total)
		return batten_fail(context, BATTEN_USAGE, "room for %zu lines, expected %zu", capacity,
		                   total);
	batten_closeness unused;
	batten_status status = BATTEN_OK;
	if (reference) /* refuses another table */
		status = batten_hull_closeness(context, hull, reference, &unused);
	if (status != BATTEN_OK)
		return status;
	batten_line *made = batten_allocate(context, total, sizeof *made);
	if (!made)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < own && status == BATTEN_OK; i++) {
		bool waterline = i >= hull->station_count;
		status = describe_own_line(hull, reference, waterline,
		                           waterline ? i - hull->station_count : i, &made[i]);
	}
	if (status == BATTEN_OK)
		status = describe_cuts(context, hull, reference, made + own);
	if (status == BATTEN_OK) {
		memcpy(lines, made, total * sizeof *made);
		*count = total;
	}
	batten_release(context, made);
	return status;
}
