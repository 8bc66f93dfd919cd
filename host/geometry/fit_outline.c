/* Where a hull's surface ends: keel, stern, stem and deck, found in the ends of its lines.  * From
 * the lowest waterline up, the ends of the waterlines belong to the keel as long as they go out by
 * more than they rise; from the corner where they stop doing so they are stern or stem. */
#include "geometry/fit_ends.h"

#include <math.h>
#include <string.h>

/* Rise of a keel over its run, at most. */
static const double steepest_keel = 1.0 / 3.0;

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

/* Whether a waterline ends at the deck, not at stern or stem: the hull goes on, but lower. */
static bool ends_at_deck(const batten_hull *hull, const struct fit_sections *sections,
                         const struct fit_ends *ends, size_t i, int side)
{
	for (size_t s = 0; s < hull->station_count; s++) {
		const bool beyond = side == FIT_AFT ? hull->x_m[s] < ends->x[side][i]
		                                    : hull->x_m[s] > ends->x[side][i];
		if (beyond && sections->high[s] < ends->z[i])
			return true;
	}
	return false;
}

/* Number of the end where the keel meets stern or stem. Profile points on a grid go up in steps: an
 * end that is not steep above the last one of the keel is on it too. */
static size_t find_corner(const struct fit_ends *ends, int side)
{
	const double *x = ends->x[side];
	size_t corner = 0;
	for (size_t i = 1; i < ends->count; i++) {
		const double run = side == FIT_AFT ? x[corner] - x[i] : x[i] - x[corner];
		if (run > 0.0 && ends->z[i] - ends->z[corner] < steepest_keel * run)
			corner = i;
	}
	return corner;
}

/* Places of the profile that the table gives: ends of waterlines on the keel, feet of sections,
 * keel points. Only those with y = 0. */
static void collect_keel(const batten_hull *hull, const struct fit_sections *sections,
                         const struct fit_ends *ends, const size_t corner[2], struct fit_line *keel)
{
	for (int side = FIT_AFT; side <= FIT_FORWARD; side++)
		for (size_t i = 0; i <= corner[side] && i < ends->count; i++)
			if (ends->y[side][i] == 0.0)
				line_insert(keel, ends->x[side][i], ends->z[i]);
	for (size_t s = 0; s < hull->station_count; s++)
		if (sections->low_y[s] == 0.0)
			line_insert(keel, hull->x_m[s], sections->low[s]);
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
static void follow_sections(const batten_hull *hull, const struct fit_sections *sections,
                            const struct fit_line *keel, double aft, double forward,
                            struct fit_outline *out)
{
	for (size_t s = 0; s < hull->station_count; s++) {
		if (isnan(sections->low[s]))
			continue;
		const double x = hull->x_m[s];
		line_insert(&out->high, x, sections->high[s]);
		if (x < aft || x > forward)
			continue;
		double foot = sections->low[s];
		const double under = keel_at(keel, x);
		if (sections->low_y[s] > 0.0 && under < foot) {
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

static batten_status build(const batten_hull *hull, const struct fit_sections *sections,
                           const struct fit_ends *ends, struct fit_line *keel,
                           struct fit_outline *out)
{
	const size_t corner[2] = { find_corner(ends, FIT_AFT), find_corner(ends, FIT_FORWARD) };
	if (ends->count == 0)
		return batten_fail(hull->context, BATTEN_INPUT, "%s: no point is on the hull", hull->name);
	collect_keel(hull, sections, ends, corner, keel);
	follow_sections(hull, sections, keel, ends->x[FIT_AFT][corner[FIT_AFT]],
	                ends->x[FIT_FORWARD][corner[FIT_FORWARD]], out);
	struct fit_line *lines[2] = { [FIT_AFT] = &out->stern, [FIT_FORWARD] = &out->stem };
	for (int side = FIT_AFT; side <= FIT_FORWARD; side++)
		for (size_t i = corner[side]; i < ends->count; i++)
			if (i == corner[side] || !ends_at_deck(hull, sections, ends, i, side))
				line_insert(lines[side], ends->z[i], ends->x[side][i]);
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
	const size_t most = 2 * hull->waterline_count + 3 * hull->station_count +
	                    3 * hull->profile_count;
	struct fit_ends ends = { 0 };
	struct fit_sections sections = { 0 };
	struct fit_line keel = { 0 };
	batten_status status = fit_ends_create(hull, &ends);
	if (status == BATTEN_OK)
		status = fit_sections_create(hull, &ends, &sections);
	if (status == BATTEN_OK)
		fit_ends_extend(hull, &sections, &ends);
	struct fit_line *lines[] = { &keel, &out->low, &out->high, &out->stern, &out->stem };
	for (size_t i = 0; status == BATTEN_OK && i < sizeof lines / sizeof lines[0]; i++)
		status = line_allocate(context, most, lines[i]);
	if (status == BATTEN_OK) {
		out->closed_x = batten_allocate(context, hull->station_count, sizeof *out->closed_x);
		out->closed_z = batten_allocate(context, hull->station_count, sizeof *out->closed_z);
		if (!out->closed_x || !out->closed_z)
			status = BATTEN_MEMORY;
	}
	if (status == BATTEN_OK)
		status = build(hull, &sections, &ends, &keel, out);
	fit_sections_release(context, &sections);
	fit_ends_release(context, &ends);
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
