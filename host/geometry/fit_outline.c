/* Where a hull's surface ends: keel, stern, stem and deck, found in the ends of its lines.  * From
 * the lowest waterline up, the ends of the waterlines belong to the keel as long as they go out by
 * more than they rise; from the corner where they stop doing so they are stern or stem. */
#include "geometry/fit.h"

#include <math.h>
#include <string.h>

/* Rise of a keel over its run, at most. */
static const double steepest_keel = 1.0 / 3.0;

/* First and last point of every waterline that has any. */
struct ends {
	size_t count;
	double *z, *x[2], *y[2]; /* [0] aft, [1] forward */
};

enum { AFT, FORWARD };

double fit_line_value(const struct fit_line *line, double at)
{
	if (line->count == 0)
		return NAN;
	if (at <= line->at[0])
		return line->value[0];
	if (at >= line->at[line->count - 1])
		return line->value[line->count - 1];
	size_t i = 0; /* at lies between i and after */
	size_t after = line->count - 1;
	while (after - i > 1) {
		const size_t middle = i + (after - i) / 2;
		if (at < line->at[middle])
			after = middle;
		else
			i = middle;
	}
	if (at == line->at[i])
		return line->value[i];
	const double part = (at - line->at[i]) / (line->at[after] - line->at[i]);
	return line->value[i] + part * (line->value[after] - line->value[i]);
}

static batten_status line_allocate(batten_context *context, size_t capacity, struct fit_line *line)
{
	line->at = batten_allocate(context, capacity, sizeof *line->at);
	line->value = batten_allocate(context, capacity, sizeof *line->value);
	return line->at && line->value ? BATTEN_OK : BATTEN_MEMORY;
}

static void line_release(batten_context *context, struct fit_line *line)
{
	batten_release(context, line->at);
	batten_release(context, line->value);
}

/* Puts a place in its order; of two at one place the lower value stays. */
static void line_insert(struct fit_line *line, double at, double value)
{
	size_t i = line->count;
	while (i > 0 && line->at[i - 1] > at)
		i--;
	if (i > 0 && line->at[i - 1] == at) {
		if (value < line->value[i - 1])
			line->value[i - 1] = value;
		return;
	}
	memmove(line->at + i + 1, line->at + i, (line->count - i) * sizeof *line->at);
	memmove(line->value + i + 1, line->value + i, (line->count - i) * sizeof *line->value);
	line->at[i] = at;
	line->value[i] = value;
	line->count++;
}

static void ends_release(batten_context *context, struct ends *ends)
{
	batten_release(context, ends->z);
	for (int side = AFT; side <= FORWARD; side++) {
		batten_release(context, ends->x[side]);
		batten_release(context, ends->y[side]);
	}
}

static batten_status ends_create(const batten_hull *hull, struct ends *ends)
{
	batten_context *context = hull->context;
	memset(ends, 0, sizeof *ends);
	double **arrays[] = { &ends->z, &ends->x[AFT], &ends->x[FORWARD], &ends->y[AFT],
		                  &ends->y[FORWARD] };
	for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
		*arrays[i] = batten_allocate(context, hull->waterline_count, sizeof **arrays[i]);
		if (!*arrays[i])
			return BATTEN_MEMORY;
	}
	for (size_t w = 0; w < hull->waterline_count; w++) {
		hull_line line;
		const batten_status status = hull_line_collect(hull, true, w, true, &line);
		if (status != BATTEN_OK)
			return status;
		if (line.count > 0) {
			const size_t n = ends->count++;
			ends->z[n] = hull->z_m[w];
			ends->x[AFT][n] = line.along_m[0];
			ends->y[AFT][n] = line.value_m[0];
			ends->x[FORWARD][n] = line.along_m[line.count - 1];
			ends->y[FORWARD][n] = line.value_m[line.count - 1];
		}
		hull_line_release(hull, &line);
	}
	return BATTEN_OK;
}

/* Number of the end where the keel meets stern or stem. Profile points on a grid go up in steps: an
 * end that is not steep above the last one of the keel is on it too. */
static size_t find_corner(const struct ends *ends, int side)
{
	const double *x = ends->x[side];
	size_t corner = 0;
	for (size_t i = 1; i < ends->count; i++) {
		const double run = side == AFT ? x[corner] - x[i] : x[i] - x[corner];
		if (run > 0.0 && ends->z[i] - ends->z[corner] < steepest_keel * run)
			corner = i;
	}
	return corner;
}

/* Lowest and highest node of a section that lies on the hull, '?' included; false without any. */
static bool section_range(const batten_hull *hull, size_t station, size_t *lowest, size_t *highest)
{
	bool any = false;
	for (size_t w = 0; w < hull->waterline_count; w++)
		if (hull->nodes[w * hull->station_count + station] != BATTEN_NODE_OUTSIDE) {
			if (!any)
				*lowest = w;
			*highest = w;
			any = true;
		}
	return any;
}

/* Places of the profile that the table gives: ends of waterlines on the keel, feet of sections,
 * keel points. Only those with y = 0. */
static void collect_keel(const batten_hull *hull, const struct ends *ends, const size_t corner[2],
                         struct fit_line *keel)
{
	for (int side = AFT; side <= FORWARD; side++)
		for (size_t i = 0; i <= corner[side] && i < ends->count; i++)
			if (ends->y[side][i] == 0.0)
				line_insert(keel, ends->x[side][i], ends->z[i]);
	for (size_t s = 0; s < hull->station_count; s++) {
		size_t lowest = 0;
		size_t highest = 0;
		if (section_range(hull, s, &lowest, &highest) &&
		    hull->y_m[lowest * hull->station_count + s] == 0.0)
			line_insert(keel, hull->x_m[s], hull->z_m[lowest]);
	}
	for (size_t i = 0; i < hull->profile_count; i++)
		if (hull->profile[i].kind == HULL_PROFILE_KEEL && hull->profile[i].y_m == 0.0)
			line_insert(keel, hull->profile[i].x_m, hull->profile[i].z_m);
}

/* The keel at x, going on straight beyond the places that are known; NaN where nothing is. */
static double keel_at(const struct fit_line *keel, double x)
{
	const size_t n = keel->count;
	if (n < 2)
		return n == 1 && keel->at[0] == x ? keel->value[0] : NAN;
	size_t i = 0;
	if (x > keel->at[n - 1])
		i = n - 2;
	else if (x >= keel->at[0])
		return fit_line_value(keel, x);
	return keel->value[i] + (x - keel->at[i]) * (keel->value[i + 1] - keel->value[i]) /
	                            (keel->at[i + 1] - keel->at[i]);
}

/* Foot and top of every section. A section that begins above the keel with y > 0 is led down to it;
 * beyond the corners aft and forward its foot is on the stern or the stem. */
static void follow_sections(const batten_hull *hull, const struct fit_line *keel, double aft,
                            double forward, struct fit_outline *out)
{
	for (size_t s = 0; s < hull->station_count; s++) {
		size_t lowest = 0;
		size_t highest = 0;
		if (!section_range(hull, s, &lowest, &highest))
			continue;
		const double x = hull->x_m[s];
		line_insert(&out->high, x, hull->z_m[highest]);
		if (x < aft || x > forward)
			continue;
		double foot = hull->z_m[lowest];
		const double under = keel_at(keel, x);
		if (hull->y_m[lowest * hull->station_count + s] > 0.0 && under < foot) {
			foot = under;
			out->closed_x[out->closed_count] = x;
			out->closed_z[out->closed_count++] = foot;
		}
		line_insert(&out->low, x, foot);
	}
	/* Between the stations the ends of the waterlines tell where the keel is lower. */
	for (size_t i = 0; i < keel->count; i++) {
		if (keel->at[i] < aft || keel->at[i] > forward)
			continue;
		if (out->low.count == 0 || keel->value[i] < fit_line_value(&out->low, keel->at[i]) ||
		    keel->at[i] < out->low.at[0] || keel->at[i] > out->low.at[out->low.count - 1])
			line_insert(&out->low, keel->at[i], keel->value[i]);
	}
}

static batten_status build(const batten_hull *hull, const struct ends *ends, struct fit_line *keel,
                           struct fit_outline *out)
{
	const size_t corner[2] = { find_corner(ends, AFT), find_corner(ends, FORWARD) };
	if (ends->count == 0)
		return batten_fail(hull->context, BATTEN_INPUT, "%s: no point is on the hull", hull->name);
	collect_keel(hull, ends, corner, keel);
	follow_sections(hull, keel, ends->x[AFT][corner[AFT]], ends->x[FORWARD][corner[FORWARD]], out);
	for (size_t i = corner[AFT]; i < ends->count; i++)
		line_insert(&out->stern, ends->z[i], ends->x[AFT][i]);
	for (size_t i = corner[FORWARD]; i < ends->count; i++)
		line_insert(&out->stem, ends->z[i], ends->x[FORWARD][i]);
	if (out->low.count < 2 || out->stern.count == 0 || out->high.count < 2)
		return batten_fail(hull->context, BATTEN_INPUT,
		                   "%s: a surface needs points at two stations or more", hull->name);
	return BATTEN_OK;
}

batten_status fit_outline_create(const batten_hull *hull, struct fit_outline *out)
{
	batten_context *context = hull->context;
	memset(out, 0, sizeof *out);
	out->context = context;
	const size_t most = 2 * hull->waterline_count + hull->station_count + hull->profile_count;
	struct ends ends;
	struct fit_line keel = { 0 };
	batten_status status = ends_create(hull, &ends);
	struct fit_line *lines[] = { &keel, &out->low, &out->high, &out->stern, &out->stem };
	for (size_t i = 0; status == BATTEN_OK && i < sizeof lines / sizeof lines[0]; i++)
		status = line_allocate(context, most + hull->station_count, lines[i]);
	if (status == BATTEN_OK) {
		out->closed_x = batten_allocate(context, hull->station_count, sizeof *out->closed_x);
		out->closed_z = batten_allocate(context, hull->station_count, sizeof *out->closed_z);
		if (!out->closed_x || !out->closed_z)
			status = BATTEN_MEMORY;
	}
	if (status == BATTEN_OK)
		status = build(hull, &ends, &keel, out);
	ends_release(context, &ends);
	line_release(context, &keel);
	if (status != BATTEN_OK)
		fit_outline_destroy(out);
	return status;
}

void fit_outline_destroy(struct fit_outline *outline)
{
	batten_context *context = outline->context;
	struct fit_line *lines[] = { &outline->low, &outline->high, &outline->stern, &outline->stem };
	for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
		line_release(context, lines[i]);
	batten_release(context, outline->closed_x);
	batten_release(context, outline->closed_z);
	memset(outline, 0, sizeof *outline);
}
