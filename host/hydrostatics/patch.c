#include "hydrostatics/patch.h"

#include "core/number.h"

#include <math.h>
#include <stdlib.h>

/* ------------------------------------------------------------------------------------------------
 * Roots and maxima of one parameter
 * --------------------------------------------------------------------------------------------- */

/* Between a, where the function is fa, and b, where it is fb of the other sign: false position,
 * the end that stays halved (Illinois), by bisection where that is slow. */
static double root_between(patch_function *function, const void *closure, double a, double fa,
                           double b, double fb)
{
	enum { TURNS = 120 };
	int side = 0;
	for (int turn = 0; turn < TURNS && fabs(b - a) > 4e-16 * (fabs(a) + fabs(b)); turn++) {
		double middle = 0.5 * (a + b);
		double t = turn % 4 == 3 ? middle : b - fb * (b - a) / (fb - fa);
		if (!(t > fmin(a, b) && t < fmax(a, b)))
			t = middle;
		double f = function(closure, t);
		if (f == 0)
			return t;
		if ((f > 0) == (fb > 0)) {
			b = t;
			fb = f;
			fa *= side == 1 ? 0.5 : 1;
			side = 1;
		} else {
			a = t;
			fa = f;
			fb *= side == -1 ? 0.5 : 1;
			side = -1;
		}
	}
	return 0.5 * (a + b);
}

size_t patch_roots(patch_function *function, const void *closure, double a, double b,
                   double roots[PATCH_ROOTS_MOST])
{
	size_t count = 0;
	double from = a, at_from = function(closure, a);
	for (int i = 1; i <= PATCH_ROOTS_MOST; i++) {
		double to = i == PATCH_ROOTS_MOST ? b : a + (b - a) * i / PATCH_ROOTS_MOST;
		double at_to = function(closure, to);
		if ((at_from > 0) != (at_to > 0))
			roots[count++] = root_between(function, closure, from, at_from, to, at_to);
		from = to;
		at_from = at_to;
	}
	return count;
}

double patch_largest(patch_function *function, const void *closure, double a, double b, double *at)
{
	enum { TURNS = 50 };
	const double golden = 0.61803398874989484820;
	double inner = b - golden * (b - a), outer = a + golden * (b - a);
	double f = function(closure, inner), g = function(closure, outer);
	for (int turn = 0; turn < TURNS; turn++) {
		if (f > g) {
			b = outer;
			outer = inner;
			g = f;
			inner = b - golden * (b - a);
			f = function(closure, inner);
		} else {
			a = inner;
			inner = outer;
			f = g;
			outer = a + golden * (b - a);
			g = function(closure, outer);
		}
	}
	double low = function(closure, a), high = function(closure, b);
	double most = fmax(fmax(f, g), fmax(low, high));
	*at = most == f ? inner : most == g ? outer : most == low ? a : b;
	return most;
}

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static size_t take_lines(size_t order, size_t count, const double *knots, double *lines)
{
	size_t spans = 0;
	lines[0] = knots[order - 1];
	for (size_t i = order - 1; i < count; i++)
		if (knots[i + 1] > knots[i])
			lines[++spans] = knots[i + 1];
	return spans;
}

struct y_line {
	const struct patch *patch;
	bool along_u;
	double other;
};

static double y_along(const void *closure, double t)
{
	const struct y_line *line = closure;
	surface_jet d;
	surface_evaluate(line->patch->surface, line->along_u ? t : line->other,
	                 line->along_u ? line->other : t, 0, d);
	return d[0][0][1];
}

/* From the largest y of the samples along u and v in turn. */
static void refine_half_beam(struct patch *patch, double u, double v, double step_u, double step_v)
{
	enum { TURNS = 3 };
	for (int turn = 0; turn < TURNS; turn++) {
		struct y_line line = { patch, true, v };
		double low = fmax(patch->u[0], u - step_u);
		double high = fmin(patch->u[patch->u_count], u + step_u), at = u;
		double y = patch_largest(y_along, &line, low, high, &at);
		if (y > patch->half_beam_m) {
			patch->half_beam_m = y;
			u = at;
		}
		line = (struct y_line){ patch, false, u };
		low = fmax(patch->v[0], v - step_v);
		high = fmin(patch->v[patch->v_count], v + step_v);
		y = patch_largest(y_along, &line, low, high, &at);
		if (y > patch->half_beam_m) {
			patch->half_beam_m = y;
			v = at;
		}
	}
}

enum { SAMPLES = 8 }; /* a span */

static double sample_at(const double *lines, size_t spans, size_t n)
{
	size_t span = n / SAMPLES;
	if (span >= spans)
		return lines[spans];
	return lines[span] + (lines[span + 1] - lines[span]) * (double)(n % SAMPLES) / SAMPLES;
}

static void take_extents(struct patch *patch)
{
	double best_u = patch->u[0], best_v = patch->v[0];
	patch->lowest_m = patch->aftmost_m = INFINITY;
	patch->highest_m = patch->foremost_m = patch->half_beam_m = -INFINITY;
	for (size_t j = 0; j <= SAMPLES * patch->v_count; j++) {
		for (size_t i = 0; i <= SAMPLES * patch->u_count; i++) {
			double u = sample_at(patch->u, patch->u_count, i);
			double v = sample_at(patch->v, patch->v_count, j);
			surface_jet d;
			surface_evaluate(patch->surface, u, v, 0, d);
			const double *p = d[0][0];
			patch->aftmost_m = fmin(patch->aftmost_m, p[0]);
			patch->foremost_m = fmax(patch->foremost_m, p[0]);
			patch->lowest_m = fmin(patch->lowest_m, p[2]);
			patch->highest_m = fmax(patch->highest_m, p[2]);
			if (p[1] > patch->half_beam_m) {
				patch->half_beam_m = p[1];
				best_u = u;
				best_v = v;
			}
		}
	}
	double step_u = (patch->u[patch->u_count] - patch->u[0]) / (double)patch->u_count;
	double step_v = (patch->v[patch->v_count] - patch->v[0]) / (double)patch->v_count;
	refine_half_beam(patch, best_u, best_v, step_u / SAMPLES, step_v / SAMPLES);
}

size_t patch_points(size_t order_u, size_t order_v, size_t points)
{
	enum { POINTS_LEAST = 12 };
	const size_t degree = (order_u > order_v ? order_u : order_v) - 1;
	if (points > 0)
		return points;
	return 2 * degree > POINTS_LEAST ? 2 * degree : POINTS_LEAST;
}

batten_status patch_create(batten_context *context, const struct batten_surface *surface,
                           size_t points, struct patch *out)
{
	struct patch made = { .context = context, .surface = surface };
	made.points = patch_points(surface->order_u, surface->order_v, points);
	gauss_points(made.points, made.nodes, made.weights);
	for (size_t k = 0; k < made.points; k++) {
		made.nodes[k] = 0.5 * (1 + made.nodes[k]);
		made.weights[k] *= 0.5;
	}
	made.u = batten_allocate(context, surface->count_u + 1, sizeof *made.u);
	made.v = batten_allocate(context, surface->count_v + 1, sizeof *made.v);
	made.breaks = batten_allocate(context, surface->count_v + 1, PATCH_ROOTS_MOST * sizeof(double));
	if (!made.u || !made.v || !made.breaks) {
		patch_destroy(&made);
		return BATTEN_MEMORY;
	}
	made.u_count = take_lines(surface->order_u, surface->count_u, surface->knots_u, made.u);
	made.v_count = take_lines(surface->order_v, surface->count_v, surface->knots_v, made.v);
	take_extents(&made);
	*out = made;
	return BATTEN_OK;
}

void patch_destroy(struct patch *patch)
{
	batten_release(patch->context, patch->u);
	batten_release(patch->context, patch->v);
	batten_release(patch->context, patch->breaks);
	*patch = (struct patch){ .context = patch->context };
}

double patch_draft_edge(const struct patch *patch, double draft_m)
{
	return draft_m + 1e-14 * (fabs(draft_m) + patch->highest_m - patch->lowest_m);
}

/* ------------------------------------------------------------------------------------------------
 * The waterline across the knot lines
 * --------------------------------------------------------------------------------------------- */

/* Lowest and highest pole of the span that begins at u and v: the surface lies between them. */
static void span_heights(const struct batten_surface *surface, double u, double v, double *low,
                         double *high)
{
	size_t i = bspline_span(surface->order_u, surface->count_u, surface->knots_u, u);
	size_t j = bspline_span(surface->order_v, surface->count_v, surface->knots_v, v);
	*low = INFINITY;
	*high = -INFINITY;
	for (size_t row = j + 1 - surface->order_v; row <= j; row++) {
		for (size_t pole = i + 1 - surface->order_u; pole <= i; pole++) {
			double z = surface->poles[3 * (row * surface->count_u + pole) + 2];
			*low = fmin(*low, z);
			*high = fmax(*high, z);
		}
	}
}

struct height_line {
	const struct batten_surface *surface;
	bool along_u;
	double other, draft_m;
};

static double height_along(const void *closure, double t)
{
	const struct height_line *line = closure;
	surface_jet d;
	surface_evaluate(line->surface, line->along_u ? t : line->other,
	                 line->along_u ? line->other : t, 0, d);
	return d[0][0][2] - line->draft_m;
}

size_t patch_breaks(const struct patch *patch, size_t i, double draft_m)
{
	size_t count = 0;
	for (size_t j = 0; j <= patch->v_count; j++) {
		double low, high;
		struct height_line line = { patch->surface, true, patch->v[j],
			                        patch_draft_edge(patch, draft_m) };
		span_heights(patch->surface, patch->u[i], patch->v[j], &low, &high);
		if (low <= line.draft_m && high > line.draft_m)
			count += patch_roots(height_along, &line, patch->u[i], patch->u[i + 1],
			                     patch->breaks + count);
	}
	if (count > 1)
		qsort(patch->breaks, count, sizeof *patch->breaks, batten_number_compare);
	return count;
}

static void visit_interval(const struct patch *patch, double u, double from, double to,
                           patch_visit *visit, void *closure)
{
	for (size_t k = 0; k < patch->points; k++)
		visit(closure, u, from + (to - from) * patch->nodes[k], (to - from) * patch->weights[k]);
}

void patch_along_v(const struct patch *patch, double u, double draft_m, patch_visit *visit,
                   void *closure)
{
	struct height_line line = { patch->surface, false, u, patch_draft_edge(patch, draft_m) };
	for (size_t j = 0; j < patch->v_count; j++) {
		double low, high, roots[PATCH_ROOTS_MOST];
		span_heights(patch->surface, u, patch->v[j], &low, &high);
		if (low > line.draft_m)
			continue;
		size_t count = 0;
		if (high > line.draft_m)
			count = patch_roots(height_along, &line, patch->v[j], patch->v[j + 1], roots);
		double from = patch->v[j];
		for (size_t k = 0; k <= count; k++) {
			double to = k < count ? roots[k] : patch->v[j + 1];
			bool wet = high <= line.draft_m || height_along(&line, 0.5 * (from + to)) <= 0;
			if (wet && to > from)
				visit_interval(patch, u, from, to, visit, closure);
			from = to;
		}
	}
}
