/* Lines of a surface that hydrostatics asks for: its waterline, its sections. */
#include "hydrostatics/patch.h"

#include <math.h>

/* ------------------------------------------------------------------------------------------------
 * The waterline
 * --------------------------------------------------------------------------------------------- */

struct cut {
	const struct patch *patch;
	double u, x_m, draft_m;
};

static double height_over_draft(const void *closure, double v)
{
	const struct cut *cut = closure;
	surface_jet d;
	surface_evaluate(cut->patch->surface, cut->u, v, 0, d);
	return d[0][0][2] - cut->draft_m;
}

static void take_point(const struct patch *patch, double u, double v, bool *any, double at[2])
{
	surface_jet d;
	surface_evaluate(patch->surface, u, v, 0, d);
	if (*any && d[0][0][1] <= at[1])
		return;
	*any = true;
	at[0] = d[0][0][0];
	at[1] = d[0][0][1];
}

/* x and y of the outermost point of the waterline at one u. */
static bool waterline_at(const struct patch *patch, double u, double draft_m, double at[2])
{
	bool any = false;
	struct cut cut = { .patch = patch, .u = u, .draft_m = patch_draft_edge(patch, draft_m) };
	const double near = 1e-9 * (patch->highest_m - patch->lowest_m);
	for (size_t j = 0; j <= patch->v_count; j++) {
		double roots[PATCH_ROOTS_MOST];
		if (fabs(height_over_draft(&cut, patch->v[j])) <= near)
			take_point(patch, u, patch->v[j], &any, at);
		if (j == patch->v_count)
			break;
		size_t count = patch_roots(height_over_draft, &cut, patch->v[j], patch->v[j + 1], roots);
		for (size_t k = 0; k < count; k++)
			take_point(patch, u, roots[k], &any, at);
	}
	return any;
}

struct waterline {
	const struct patch *patch;
	double draft_m, aft_m, fore_m, best_y_m, best_u;
	bool any;
};

static double half_breadth_at(const void *closure, double u)
{
	const struct waterline *line = closure;
	double at[2];
	return waterline_at(line->patch, u, line->draft_m, at) ? at[1] : -INFINITY;
}

static void take_waterline_at(struct waterline *line, double u)
{
	double at[2];
	if (!waterline_at(line->patch, u, line->draft_m, at))
		return;
	line->any = true;
	line->aft_m = fmin(line->aft_m, at[0]);
	line->fore_m = fmax(line->fore_m, at[0]);
	if (at[1] > line->best_y_m) {
		line->best_y_m = at[1];
		line->best_u = u;
	}
}

void patch_waterline(const struct patch *patch, double draft_m, hydrostatics *out)
{
	enum { SAMPLES = 4 }; /* a span */
	struct waterline line = { patch, draft_m, INFINITY, -INFINITY, -INFINITY, 0, false };
	for (size_t i = 0; i < patch->u_count; i++) {
		double from = patch->u[i], wide = patch->u[i + 1] - from;
		size_t count = patch_breaks(patch, i, draft_m);
		for (size_t k = 0; k < count; k++)
			take_waterline_at(&line, patch->breaks[k]);
		for (int k = 0; k <= SAMPLES; k++)
			take_waterline_at(&line, k == SAMPLES ? patch->u[i + 1] : from + wide * k / SAMPLES);
	}
	out->waterline_length_m = line.any ? line.fore_m - line.aft_m : NAN;
	out->waterline_half_breadth_m = NAN;
	if (!line.any)
		return;
	double step = (patch->u[patch->u_count] - patch->u[0]) / (double)patch->u_count / SAMPLES;
	double low = fmax(patch->u[0], line.best_u - step), at = 0;
	double high = fmin(patch->u[patch->u_count], line.best_u + step);
	out->waterline_half_breadth_m = fmax(line.best_y_m,
	                                     patch_largest(half_breadth_at, &line, low, high, &at));
}

/* ------------------------------------------------------------------------------------------------
 * Sections
 * --------------------------------------------------------------------------------------------- */

/* u at which the line v of a surface crosses x; false where it does not. By Newton's method from a
 * guess, kept between bounds. */
static bool station_at(const struct cut *cut, double v, double *u, surface_jet d)
{
	enum { TURNS = 80 };
	const struct patch *patch = cut->patch;
	double low = patch->u[0], high = patch->u[patch->u_count];
	surface_evaluate(patch->surface, low, v, 0, d);
	double at_low = d[0][0][0] - cut->x_m;
	surface_evaluate(patch->surface, high, v, 0, d);
	double at_high = d[0][0][0] - cut->x_m;
	if ((at_low > 0) == (at_high > 0) && at_low != 0 && at_high != 0)
		return false;
	double t = *u;
	for (int turn = 0; turn < TURNS; turn++) {
		surface_evaluate(patch->surface, t, v, 1, d);
		double off = d[0][0][0] - cut->x_m;
		if ((off > 0) == (at_high > at_low))
			high = t;
		else
			low = t;
		double next = t - off / d[1][0][0];
		if (!(next >= low && next <= high))
			next = 0.5 * (low + high);
		bool done = fabs(next - t) <= 2e-16 * (fabs(low) + fabs(high)) || off == 0;
		t = next;
		if (done)
			break;
	}
	*u = t;
	return true;
}

static double section_height(const void *closure, double v)
{
	const struct cut *cut = closure;
	double u = cut->u;
	surface_jet d;
	return station_at(cut, v, &u, d) ? d[0][0][2] - cut->draft_m : INFINITY;
}

struct end_line {
	const struct cut *cut;
	double u;
};

static double end_before(const void *closure, double v)
{
	const struct end_line *line = closure;
	surface_jet d;
	surface_evaluate(line->cut->patch->surface, line->u, v, 0, d);
	return d[0][0][0] - line->cut->x_m;
}

/* 2 integral y dz of the section between two v, all of it below the draft. */
static double section_part(const struct cut *cut, double from, double to)
{
	const struct patch *patch = cut->patch;
	double sum = 0, u = cut->u;
	for (size_t k = 0; k < patch->points; k++) {
		surface_jet d;
		double v = from + (to - from) * patch->nodes[k];
		if (!station_at(cut, v, &u, d))
			continue;
		surface_evaluate(patch->surface, u, v, 1, d);
		double rise = d[0][1][2];
		if (d[1][0][0] != 0)
			rise -= d[1][0][2] * d[0][1][0] / d[1][0][0];
		sum += patch->weights[k] * d[0][0][1] * rise;
	}
	return 2 * (to - from) * sum;
}

/* Between two v with the station all along or not at all: cut at the draft. */
static double section_piece(const struct cut *cut, double from, double to)
{
	double roots[PATCH_ROOTS_MOST], sum = 0;
	if (!(to > from) || isinf(section_height(cut, 0.5 * (from + to))))
		return 0;
	size_t count = patch_roots(section_height, cut, from, to, roots);
	for (size_t k = 0; k <= count; k++) {
		double end = k < count ? roots[k] : to;
		if (end > from && section_height(cut, 0.5 * (from + end)) <= 0)
			sum += section_part(cut, from, end);
		from = end;
	}
	return sum;
}

double patch_section_area(const struct patch *patch, double x_m, double draft_m)
{
	const double first = patch->u[0], last = patch->u[patch->u_count];
	struct cut cut = { patch, 0.5 * (first + last), x_m, patch_draft_edge(patch, draft_m) };
	double sum = 0;
	for (size_t j = 0; j < patch->v_count; j++) {
		/* where the ends of the surface pass the station */
		double at[2 * PATCH_ROOTS_MOST], from = patch->v[j];
		struct end_line ends[2] = { { &cut, first }, { &cut, last } };
		size_t aft = patch_roots(end_before, &ends[0], from, patch->v[j + 1], at);
		size_t fore = patch_roots(end_before, &ends[1], from, patch->v[j + 1], at + aft);
		/* two ascending lists: the smaller head first */
		size_t a = 0, b = aft;
		while (a < aft || b < aft + fore) {
			bool take_aft = b == aft + fore || (a < aft && at[a] <= at[b]);
			double to = take_aft ? at[a++] : at[b++];
			sum += section_piece(&cut, from, to);
			from = to;
		}
		sum += section_piece(&cut, from, patch->v[j + 1]);
	}
	return fabs(sum);
}
