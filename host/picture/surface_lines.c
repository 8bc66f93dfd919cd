#include "picture/surface_lines.h"

#include <math.h>

double picture_hermite(double from, double to, double from_slope, double to_slope, double t)
{
	double s = 1.0 - t;
	return s * s * ((1.0 + 2.0 * t) * from + t * from_slope) +
	       t * t * ((1.0 + 2.0 * s) * to - s * to_slope);
}

double picture_hermite_slope(double from, double to, double from_slope, double to_slope, double t)
{
	double s = 1.0 - t;
	return 6.0 * s * t * (to - from) + s * (1.0 - 3.0 * t) * from_slope +
	       t * (3.0 * t - 2.0) * to_slope;
}

void picture_keep_positive(double from, double to, double *from_slope, double *to_slope)
{
	/* The inner points of the cubic's Bezier polygon are from + slope / 3 and to - slope / 3. */
	*from_slope = fmax(*from_slope, -3.0 * from);
	*to_slope = fmin(*to_slope, 3.0 * to);
}

/* Slope at the middle point of the parabola through three, from its two chords; at most three
 * times the flatter one, so that the cubics beside it do not swing past their ends (Fritsch and
 * Carlson). */
static double parabola_slope(double step_before, double step_after, double before, double after)
{
	double slope = (step_after * before + step_before * after) / (step_before + step_after);
	double most = 3.0 * fmin(fabs(before), fabs(after));
	return fmin(fmax(slope, -most), most);
}

/* Slope at the end of the parabola that has this chord and this slope at the other end of it, with
 * the same limit. */
static double end_slope(double chord, double inner_slope)
{
	double ratio = chord != 0.0 ? 2.0 - inner_slope / chord : 0.0;
	return chord * fmin(fmax(ratio, 0.0), 3.0);
}

/* A slope that keeps the cubic between its ends (Fritsch and Butland): 0 at a peak, else a weighted
 * harmonic mean of the chords. Colours must not show curvature beyond that of the nodes. */
static double limited_slope(double step_before, double step_after, double before, double after)
{
	if (!(before * after > 0.0))
		return 0.0;
	double sum = 3.0 * (step_before + step_after);
	return sum /
	       ((2.0 * step_after + step_before) / before + (step_after + 2.0 * step_before) / after);
}

/* Fills the slopes of one unbroken run of points, first..last. */
static void fill_slopes(const surface_line *line, size_t first, size_t last)
{
	if (first == last)
		return;
	const double *x = line->along_m;
	const double *y = line->y_m;
	const double *v = line->value;
	for (size_t i = first; i <= last; i++) {
		size_t a = i > first ? i - 1 : i;
		size_t c = i < last ? i + 1 : i;
		double before = (y[a == i ? c : i] - y[a]) / (x[a == i ? c : i] - x[a]);
		double after = (y[c] - y[c == i ? a : i]) / (x[c] - x[c == i ? a : i]);
		double value_before = (v[a == i ? c : i] - v[a]) / (x[a == i ? c : i] - x[a]);
		double value_after = (v[c] - v[c == i ? a : i]) / (x[c] - x[c == i ? a : i]);
		bool inner = a < i && i < c;
		line->slope[i] = inner ? parabola_slope(x[i] - x[a], x[c] - x[i], before, after) : before;
		line->value_slope[i] = inner ? limited_slope(x[i] - x[a], x[c] - x[i], value_before,
		                                             value_after)
		                             : value_before;
	}
	if (last < first + 2)
		return;
	/* At the ends, the slope there of the parabola through the last three points. */
	double chord = (y[first + 1] - y[first]) / (x[first + 1] - x[first]);
	line->slope[first] = end_slope(chord, line->slope[first + 1]);
	chord = (y[last] - y[last - 1]) / (x[last] - x[last - 1]);
	line->slope[last] = end_slope(chord, line->slope[last - 1]);
}

/* Gives points without a value that of the nearest point of the line that has one. */
static void spread_values(surface_line *line, const bool *known)
{
	size_t last = SIZE_MAX;
	for (size_t i = 0; i < line->count; i++) {
		if (known[i]) {
			last = i;
			continue;
		}
		size_t next = i;
		while (next < line->count && !known[next])
			next++;
		if (last == SIZE_MAX && next == line->count)
			return; /* none on the whole line */
		for (; i < line->count && !known[i]; i++) {
			bool take_next = last == SIZE_MAX ||
			                 (next < line->count && line->along_m[next] - line->along_m[i] <
			                                            line->along_m[i] - line->along_m[last]);
			line->value[i] = line->value[take_next ? next : last];
		}
		i--;
	}
	line->has_value = line->count > 0;
}

static bool line_allocate(batten_context *context, surface_line *line, size_t count)
{
	enum { ARRAYS = 5 };
	double *block = batten_allocate(context, count, ARRAYS * sizeof *block);
	line->along_m = block;
	line->open_after = batten_allocate(context, count, sizeof *line->open_after);
	if (!block || !line->open_after)
		return false;
	line->count = count;
	line->y_m = block + count;
	line->slope = block + 2 * count;
	line->value = block + 3 * count;
	line->value_slope = block + 4 * count;
	return true;
}

bool picture_hole_after(const batten_hull *hull, const hull_line *points, size_t i)
{
	size_t here = points->place[i];
	size_t next = points->place[i + 1];
	return hull->layout == HULL_LAYOUT_GRID && here != SIZE_MAX && next != SIZE_MAX &&
	       next > here + 1;
}

static bool take_points(const surface_lines *lines, size_t k, const hull_line *points,
                        const picture_field *field, surface_line *line)
{
	batten_context *context = lines->context;
	bool *known = batten_allocate(context, points->count, sizeof *known);
	if (!known || !line_allocate(context, line, points->count)) {
		batten_release(context, known);
		return false;
	}
	size_t stations = lines->hull->station_count;
	for (size_t i = 0; i < line->count; i++) {
		line->along_m[i] = points->along_m[i];
		line->y_m[i] = points->value_m[i];
		line->open_after[i] = i + 1 == line->count || picture_hole_after(lines->hull, points, i);
		size_t place = points->place[i];
		if (place == SIZE_MAX)
			continue;
		size_t node = lines->waterlines ? k * stations + place : place * stations + k;
		known[i] = field->known[node] != 0 && isfinite(field->value[node]);
		line->value[i] = known[i] ? field->value[node] : 0.0;
	}
	spread_values(line, known);
	batten_release(context, known);
	return true;
}

static batten_status fill_line(const surface_lines *lines, size_t k, const picture_field *field,
                               surface_line *line)
{
	hull_line points = { 0 };
	batten_status status = hull_line_collect(lines->hull, lines->waterlines, k, true, &points);
	if (status != BATTEN_OK)
		return status;
	bool taken = take_points(lines, k, &points, field, line);
	hull_line_release(lines->hull, &points);
	if (!taken)
		return BATTEN_MEMORY;
	size_t first = 0;
	for (size_t i = 0; i < line->count; i++) {
		if (!line->open_after[i])
			continue;
		fill_slopes(line, first, i);
		first = i + 1;
	}
	return BATTEN_OK;
}

batten_status surface_lines_create(batten_context *context, const batten_hull *hull,
                                   const picture_field *field, surface_lines **out)
{
	surface_lines *lines = batten_allocate(context, 1, sizeof *lines);
	if (!lines)
		return BATTEN_MEMORY;
	lines->context = context;
	lines->hull = hull;
	lines->waterlines = hull->layout != HULL_LAYOUT_LONG_STATIONS;
	lines->across_m = lines->waterlines ? hull->z_m : hull->x_m;
	size_t count = lines->waterlines ? hull->waterline_count : hull->station_count;
	lines->lines = batten_allocate(context, count, sizeof *lines->lines);
	batten_status status = lines->lines ? BATTEN_OK : BATTEN_MEMORY;
	if (lines->lines)
		lines->count = count;
	for (size_t k = 0; status == BATTEN_OK && k < count; k++)
		status = fill_line(lines, k, field, &lines->lines[k]);
	if (status != BATTEN_OK) {
		surface_lines_destroy(lines);
		return status;
	}
	*out = lines;
	return BATTEN_OK;
}

void surface_lines_destroy(surface_lines *lines)
{
	if (!lines)
		return;
	for (size_t k = 0; lines->lines && k < lines->count; k++) {
		batten_release(lines->context, lines->lines[k].along_m);
		batten_release(lines->context, lines->lines[k].open_after);
	}
	batten_release(lines->context, lines->lines);
	batten_release(lines->context, lines);
}

line_sample surface_line_at(const surface_line *line, double along_m)
{
	line_sample sample = { 0 };
	size_t count = line->count;
	if (count == 0 || !(along_m >= line->along_m[0] && along_m <= line->along_m[count - 1]))
		return sample;
	size_t low = 0;
	size_t high = count;
	while (high - low > 1) {
		size_t middle = low + (high - low) / 2;
		if (line->along_m[middle] <= along_m)
			low = middle;
		else
			high = middle;
	}
	bool on_point = line->along_m[low] == along_m;
	if (line->open_after[low] && !on_point)
		return sample;
	sample.covered = true;
	sample.known = line->has_value ? 1.0 : 0.0;
	sample.y_m = line->y_m[low];
	sample.slope = line->slope[low];
	sample.value = line->value[low];
	if (on_point)
		return sample;
	double step = line->along_m[low + 1] - line->along_m[low];
	double t = (along_m - line->along_m[low]) / step;
	const double *y = line->y_m + low;
	double slopes[2] = { step * line->slope[low], step * line->slope[low + 1] };
	picture_keep_positive(y[0], y[1], &slopes[0], &slopes[1]);
	sample.y_m = picture_hermite(y[0], y[1], slopes[0], slopes[1], t);
	sample.slope = picture_hermite_slope(y[0], y[1], slopes[0], slopes[1], t) / step;
	const double *v = line->value + low;
	const double *w = line->value_slope + low;
	sample.value = picture_hermite(v[0], v[1], step * w[0], step * w[1], t);
	return sample;
}

/* Slope at the edge of the parabola through a line and the next two on one side; the chord where
 * the second is missing. towards is +1 for the lines above, -1 for those below. */
static double edge_slope(const surface_lines *lines, size_t k, double along_m, double y,
                         double next_y, int towards)
{
	size_t next = towards > 0 ? k + 1 : k - 1;
	double step = lines->across_m[next] - lines->across_m[k];
	double chord = (next_y - y) / step;
	if (towards > 0 ? next + 1 >= lines->count : next == 0)
		return chord;
	size_t far = towards > 0 ? next + 1 : next - 1;
	line_sample beyond = surface_line_at(&lines->lines[far], along_m);
	if (!beyond.covered)
		return chord;
	double far_step = lines->across_m[far] - lines->across_m[next];
	double far_chord = (beyond.y_m - next_y) / far_step;
	return end_slope(chord, parabola_slope(step, far_step, chord, far_chord));
}

void surface_slope_across(const surface_lines *lines, size_t k, double along_m, double *slope,
                          double *value_slope)
{
	line_sample here = surface_line_at(&lines->lines[k], along_m);
	line_sample below = { 0 };
	line_sample above = { 0 };
	if (k > 0)
		below = surface_line_at(&lines->lines[k - 1], along_m);
	if (k + 1 < lines->count)
		above = surface_line_at(&lines->lines[k + 1], along_m);
	*slope = 0.0;
	*value_slope = 0.0;
	if (below.covered && above.covered) {
		double down = lines->across_m[k] - lines->across_m[k - 1];
		double up = lines->across_m[k + 1] - lines->across_m[k];
		*slope = parabola_slope(down, up, (here.y_m - below.y_m) / down,
		                        (above.y_m - here.y_m) / up);
		*value_slope = limited_slope(down, up, (here.value - below.value) / down,
		                             (above.value - here.value) / up);
	} else if (above.covered) {
		*slope = edge_slope(lines, k, along_m, here.y_m, above.y_m, 1);
	} else if (below.covered) {
		*slope = edge_slope(lines, k, along_m, here.y_m, below.y_m, -1);
	}
}
