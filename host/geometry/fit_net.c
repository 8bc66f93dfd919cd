/* The poles of a surface through points by least squares: normal equations of few bands, solved by
 * Cholesky and refined on the residuals of the points, which takes away what the small stiffness
 * put in and what squaring the matrix lost. Poles that no point determines would lie where the net is
 * straightest: the caller says whether that will do. */
#include "core/band.h"
#include "geometry/fit.h"

#include <math.h>
#include <string.h>

static const double settled = 1e-15; /* a step against the largest coordinate: the last one */
enum { REFINEMENTS = 8, FIXED = -1 };

/* Unknown number of every pole for the coordinates x and z (linked where rounded) or y. */
struct system {
	batten_context *context;
	const struct fit_points *points;
	struct batten_surface *surface;
	double stiffness; /* against the mean of the diagonal */
	size_t unknowns, width;
	long *unknown;  /* [count_u][count_v], or FIXED: at 0 */
	double *matrix; /* band of the factor */
	double *vector;
	double *places; /* of the poles of one direction */
};

/* The basis functions that count at a point. */
struct support {
	size_t first_u, first_v;
	double value_u[BSPLINE_ORDER_MOST], value_v[BSPLINE_ORDER_MOST];
};

static void support_at(const struct batten_surface *s, const struct fit_point *point,
                       struct support *out)
{
	const size_t span_u = bspline_span(s->order_u, s->count_u, s->knots_u, point->u);
	const size_t span_v = bspline_span(s->order_v, s->count_v, s->knots_v, point->v);
	bspline_basis(s->order_u, s->knots_u, span_u, point->u, out->value_u);
	bspline_basis(s->order_v, s->knots_v, span_v, point->v, out->value_v);
	out->first_u = span_u - (s->order_u - 1);
	out->first_v = span_v - (s->order_v - 1);
}

/* A pole on a rounded edge has x and z of its neighbour inside (Letcher 4.13); its y is 0, and so
 * is that of every pole on a flat edge. */
static void number_unknowns(struct system *system, const struct fit_edges *edges, bool for_y)
{
	const struct batten_surface *s = system->surface;
	const size_t first_u = edges->rounded & BATTEN_ROUNDED_STERN ? 1 : 0;
	const size_t last_u = s->count_u - (edges->rounded & BATTEN_ROUNDED_STEM ? 2 : 1);
	const size_t first_v = edges->rounded & BATTEN_ROUNDED_KEEL ? 1 : 0;
	long next = 0;
	for (size_t i = 0; i < s->count_u; i++)
		for (size_t j = 0; j < s->count_v; j++) {
			const bool flat = (i == 0 && edges->stern_flat) || (j == 0 && edges->keel_flat) ||
			                  (i + 1 == s->count_u && edges->stem_flat);
			const bool linked = i < first_u || i > last_u || j < first_v;
			const bool unknown = for_y ? !flat : !linked;
			system->unknown[i * s->count_v + j] = unknown ? next++ : FIXED;
		}
	system->unknowns = (size_t)next;
	for (size_t i = 0; !for_y && i < s->count_u; i++)
		for (size_t j = 0; j < s->count_v; j++) {
			const size_t inside_u = i < first_u ? first_u : i > last_u ? last_u : i;
			const size_t inside_v = j < first_v ? first_v : j;
			system->unknown[i * s->count_v + j] = system->unknown[inside_u * s->count_v + inside_v];
		}
}

/* Adds the square of sum(coefficient[i] * unknown[i]) times weight. */
static void add_square(struct system *system, size_t count, const long *unknown,
                       const double *coefficient, double weight)
{
	for (size_t a = 0; a < count; a++)
		for (size_t b = 0; b < count; b++)
			if (unknown[a] != FIXED && unknown[b] != FIXED && unknown[b] <= unknown[a]) {
				const size_t row = (size_t)unknown[a];
				const size_t before = row - (size_t)unknown[b];
				system->matrix[row * (system->width + 1) + system->width - before] +=
					weight * coefficient[a] * coefficient[b];
			}
}

static void add_points(struct system *system)
{
	const struct batten_surface *s = system->surface;
	for (size_t p = 0; p < system->points->count; p++) {
		struct support support;
		long unknown[BSPLINE_ORDER_MOST * BSPLINE_ORDER_MOST];
		double coefficient[BSPLINE_ORDER_MOST * BSPLINE_ORDER_MOST];
		support_at(s, &system->points->point[p], &support);
		size_t count = 0;
		for (size_t i = 0; i < s->order_u; i++)
			for (size_t j = 0; j < s->order_v; j++) {
				const size_t pole = (support.first_u + i) * s->count_v + support.first_v + j;
				unknown[count] = system->unknown[pole];
				coefficient[count++] = support.value_u[i] * support.value_v[j];
			}
		add_square(system, count, unknown, coefficient, 1.0);
	}
}

/* Second differences of the net over the places of its poles (Greville): 0 for a straight one. */
static void add_stiffness(struct system *system, size_t count, const double *places, size_t across,
                          size_t step, size_t across_step, double weight)
{
	const double mean = (places[count - 1] - places[0]) / (double)(count - 1);
	for (size_t i = 1; i + 1 < count; i++) {
		const double before = mean / (places[i] - places[i - 1]);
		const double after = mean / (places[i + 1] - places[i]);
		const double coefficient[3] = { before, -before - after, after };
		for (size_t j = 0; j < across; j++) {
			const long *at = system->unknown + j * across_step + i * step;
			const long unknown[3] = { at[-(ptrdiff_t)step], at[0], at[step] };
			add_square(system, 3, unknown, coefficient, weight);
		}
	}
}

/* The normal equations, with stiffness or without. */
static void assemble(struct system *system, bool stiff)
{
	const struct batten_surface *s = system->surface;
	memset(system->matrix, 0,
	       s->count_u * s->count_v * (system->width + 1) * sizeof *system->matrix);
	add_points(system);
	if (!stiff)
		return;
	double trace = 0.0;
	for (size_t i = 0; i < system->unknowns; i++)
		trace += system->matrix[i * (system->width + 1) + system->width];
	const double weight = system->stiffness * trace / (double)system->unknowns;
	bspline_knots_greville(s->order_u, s->count_u, s->knots_u, system->places);
	add_stiffness(system, s->count_u, system->places, s->count_v, s->count_v, 1, weight);
	bspline_knots_greville(s->order_v, s->count_v, s->knots_v, system->places);
	add_stiffness(system, s->count_v, system->places, s->count_u, 1, s->count_v, weight);
}

static double *pole_at(const struct batten_surface *s, size_t i, size_t j)
{
	return s->poles + 3 * (j * s->count_u + i);
}

/* One coordinate: the residuals of the points against the poles so far, and the step they ask for.
 * False when that was too small to matter. */
static bool refine(struct system *system, size_t coordinate)
{
	const struct batten_surface *s = system->surface;
	memset(system->vector, 0, system->unknowns * sizeof *system->vector);
	for (size_t p = 0; p < system->points->count; p++) {
		const struct fit_point *point = &system->points->point[p];
		struct support at;
		support_at(s, point, &at);
		double residual = point->place[coordinate];
		for (size_t i = 0; i < s->order_u; i++)
			for (size_t j = 0; j < s->order_v; j++)
				residual -= at.value_u[i] * at.value_v[j] *
				            pole_at(s, at.first_u + i, at.first_v + j)[coordinate];
		for (size_t i = 0; i < s->order_u; i++)
			for (size_t j = 0; j < s->order_v; j++) {
				const size_t pole = (at.first_u + i) * s->count_v + at.first_v + j;
				if (system->unknown[pole] != FIXED)
					system->vector[system->unknown[pole]] += at.value_u[i] * at.value_v[j] *
					                                         residual;
			}
	}
	band_solve(system->unknowns, system->width, system->matrix, system->vector);
	double largest_step = 0.0;
	double largest = 0.0;
	for (size_t i = 0; i < s->count_u; i++)
		for (size_t j = 0; j < s->count_v; j++) {
			const long unknown = system->unknown[i * s->count_v + j];
			if (unknown == FIXED)
				continue;
			double *value = pole_at(s, i, j) + coordinate;
			*value += system->vector[unknown];
			largest_step = fmax(largest_step, fabs(system->vector[unknown]));
			largest = fmax(largest, fabs(*value));
		}
	return largest_step > settled * largest;
}

/* Number of the first pole that the unknown belongs to. */
static size_t pole_of(const struct system *system, size_t unknown)
{
	const struct batten_surface *s = system->surface;
	for (size_t j = 0; j < s->count_v; j++)
		for (size_t i = 0; i < s->count_u; i++)
			if (system->unknown[i * s->count_v + j] == (long)unknown)
				return j * s->count_u + i;
	return SIZE_MAX;
}

/* Returns SIZE_MAX or the pole for want of which there is no net. */
static size_t solve(struct system *system, const struct fit_edges *edges, bool for_y, bool fill)
{
	number_unknowns(system, edges, for_y);
	if (system->unknowns == 0)
		return SIZE_MAX; /* all of it lies in the centreplane */
	if (!fill) {
		assemble(system, false);
		const size_t done = band_factor(system->unknowns, system->width, system->matrix);
		if (done < system->unknowns)
			return pole_of(system, done);
	}
	assemble(system, true);
	const size_t done = band_factor(system->unknowns, system->width, system->matrix);
	if (done < system->unknowns)
		return pole_of(system, done);
	const size_t coordinates[2] = { for_y ? 1 : 0, 2 };
	for (size_t c = 0; c < (for_y ? 1 : 2); c++)
		for (size_t round = 0; round < REFINEMENTS; round++)
			if (!refine(system, coordinates[c]))
				break;
	return SIZE_MAX;
}

batten_status fit_net_solve(const struct fit_points *points, const struct fit_edges *edges,
                            double stiffness, struct batten_surface *surface, bool fill,
                            size_t *free_pole)
{
	const size_t poles = surface->count_u * surface->count_v;
	/* Poles of one point or of one second difference are at most this far apart. */
	const size_t reach_u = surface->order_u > 3 ? surface->order_u : 3;
	const size_t reach_v = surface->order_v > 3 ? surface->order_v : 3;
	struct system system = {
		.context = points->context,
		.points = points,
		.surface = surface,
		.stiffness = stiffness,
		.width = (reach_u - 1) * surface->count_v + reach_v - 1,
	};
	system.unknown = batten_allocate(points->context, poles, sizeof *system.unknown);
	system.vector = batten_allocate(points->context, poles, sizeof *system.vector);
	system.places = batten_allocate(points->context, poles, sizeof *system.places);
	size_t places = 0;
	if (__builtin_mul_overflow(poles, system.width + 1, &places))
		places = SIZE_MAX;
	system.matrix = batten_allocate(points->context, places, sizeof *system.matrix);
	const bool room = system.unknown && system.vector && system.places && system.matrix;
	memset(surface->poles, 0, 3 * poles * sizeof *surface->poles);
	if (room) {
		*free_pole = solve(&system, edges, false, fill);
		if (*free_pole == SIZE_MAX)
			*free_pole = solve(&system, edges, true, fill);
	}
	batten_release(points->context, system.unknown);
	batten_release(points->context, system.vector);
	batten_release(points->context, system.places);
	batten_release(points->context, system.matrix);
	return room ? BATTEN_OK : BATTEN_MEMORY;
}
