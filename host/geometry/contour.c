/* batten_surface_contour: lines along which a value of a surface is the same (Letcher 4.19). A mesh of
 * parameters has its value at every node; a link whose ends lie on different sides of the level is
 * crossed, the crossing is found on the surface itself, not on the chord, and crossings of one cell are
 * joined. */
#include "geometry/contour.h"

#include "geometry/surface_batch.h"

#include <math.h>

/* Where a link is crossed and by what it is joined to. */
typedef struct crossing {
	bool there;
	double u, v;
	size_t joined[2]; /* crossings in the cells on its two sides; NONE: the line ends */
} crossing;

enum { ROOT_STEPS = 60 };
#define NONE SIZE_MAX

/* Links along u come first, row by row, then those along v. */
typedef struct mesh {
	batten_context *context;
	const batten_surface *surface;
	const batten_surface_samples *samples;
	batten_surface_value value;
	double level;
	double *above; /* [v][u]: value less level, NaN where there is none */
	crossing *links;
	size_t link_count;
} mesh;

static bool is_position(batten_surface_value value)
{
	return value <= BATTEN_SURFACE_VALUE_z;
}

/* Of the value at samples: above [v][u]. */
static batten_status evaluate(const mesh *m, const batten_surface_samples *samples, double *above)
{
	const size_t points = samples->u_count * samples->v_count;
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.output = is_position(m->value) ? BATTEN_SURFACE_POSITION : BATTEN_SURFACE_EVERYTHING;
	const size_t values = batten_surface_output_count(options.output);
	double *all = batten_allocate(m->context, points, values * sizeof *all);
	uint8_t *singular = batten_allocate(m->context, points, sizeof *singular);
	batten_status status = all && singular ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = batten_surface_grid_batch(m->context, 1, &m->surface, samples, &options, all,
		                                   singular, NULL);
	for (size_t n = 0; n < points && status == BATTEN_OK; n++)
		above[n] = singular[n] && m->value >= BATTEN_SURFACE_VALUE_area
		               ? NAN
		               : all[(size_t)m->value * points + n] - m->level;
	batten_release(m->context, all);
	batten_release(m->context, singular);
	return status;
}

static batten_status value_at(const mesh *m, double u, double v, double *above)
{
	const batten_surface_samples one = { 1, 1, &u, &v };
	return evaluate(m, &one, above);
}

/* The root between two ends of different signs: Illinois' chords, which keep it between them. */
static batten_status find_root(const mesh *m, const double from[2], double below,
                               const double to[2], double above, crossing *found)
{
	double low = 0.0;
	double high = 1.0;
	double t = below / (below - above);
	batten_status status = BATTEN_OK;
	for (int step = 0, side = 0; step < ROOT_STEPS; step++) {
		double here = 0.0;
		status = value_at(m, from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]),
		                  &here);
		if (status != BATTEN_OK || here == 0.0 || isnan(here))
			break;
		const bool beyond = (here < 0.0) == (above < 0.0);
		*(beyond ? &high : &low) = t;
		*(beyond ? &above : &below) = here;
		if (side == (beyond ? 1 : -1))
			*(beyond ? &below : &above) *= 0.5;
		side = beyond ? 1 : -1;
		const double next = low + (high - low) * (below / (below - above));
		if (!(fabs(next - t) > 1e-15))
			break;
		t = next;
	}
	found->there = true;
	found->u = from[0] + t * (to[0] - from[0]);
	found->v = from[1] + t * (to[1] - from[1]);
	found->joined[0] = found->joined[1] = NONE;
	return status;
}

static size_t links_along_u(const mesh *m)
{
	return (m->samples->u_count - 1) * m->samples->v_count;
}

/* The link from node (i, k) to the next along u, or along v. */
static size_t link_at(const mesh *m, size_t i, size_t k, bool along_v)
{
	return along_v ? links_along_u(m) + k * m->samples->u_count + i
	               : k * (m->samples->u_count - 1) + i;
}

/* A point at the level counts as above it. */
static batten_status cross_link(mesh *m, size_t i, size_t k, bool along_v)
{
	const batten_surface_samples *s = m->samples;
	const size_t next_i = along_v ? i : i + 1;
	const size_t next_k = along_v ? k + 1 : k;
	const double from[] = { s->u[i], s->v[k] };
	const double to[] = { s->u[next_i], s->v[next_k] };
	const double first = m->above[k * s->u_count + i];
	const double last = m->above[next_k * s->u_count + next_i];
	if (isnan(first) || isnan(last) || (first < 0.0) == (last < 0.0))
		return BATTEN_OK;
	return find_root(m, from, first, to, last, &m->links[link_at(m, i, k, along_v)]);
}

static void join(mesh *m, size_t a, size_t b)
{
	crossing *ends[] = { &m->links[a], &m->links[b] };
	ends[0]->joined[ends[0]->joined[0] == NONE ? 0 : 1] = b;
	ends[1]->joined[ends[1]->joined[0] == NONE ? 0 : 1] = a;
}

/* Joins the crossings of a cell: two of them, or four, which the middle of the cell tells apart: its side
 * of the level is not cut off from the corners that lie there too. */
static batten_status join_cell(mesh *m, size_t i, size_t k)
{
	const batten_surface_samples *s = m->samples;
	const size_t around[] = { link_at(m, i, k, false), link_at(m, i + 1, k, true),
		                      link_at(m, i, k + 1, false), link_at(m, i, k, true) };
	size_t crossed[4] = { 0 };
	size_t count = 0;
	for (size_t n = 0; n < 4; n++)
		if (m->links[around[n]].there)
			crossed[count++] = around[n];
	if (count == 2)
		join(m, crossed[0], crossed[1]);
	if (count != 4)
		return BATTEN_OK; /* none; or nodes without a value */
	double middle = 0.0;
	const batten_status status = value_at(m, 0.5 * (s->u[i] + s->u[i + 1]),
	                                      0.5 * (s->v[k] + s->v[k + 1]), &middle);
	/* The corner between the links along u and v that begin there: cut off, or not. */
	const bool cut = (middle < 0.0) != (m->above[k * s->u_count + i] < 0.0);
	join(m, around[0], around[cut ? 3 : 1]);
	join(m, around[2], around[cut ? 1 : 3]);
	return status;
}

static batten_status march(mesh *m)
{
	const size_t columns = m->samples->u_count;
	const size_t rows = m->samples->v_count;
	batten_status status = evaluate(m, m->samples, m->above);
	for (size_t k = 0; k < rows && status == BATTEN_OK; k++)
		for (size_t i = 0; i < columns && status == BATTEN_OK; i++) {
			if (i + 1 < columns)
				status = cross_link(m, i, k, false);
			if (k + 1 < rows && status == BATTEN_OK)
				status = cross_link(m, i, k, true);
		}
	for (size_t k = 0; k + 1 < rows && status == BATTEN_OK; k++)
		for (size_t i = 0; i + 1 < columns && status == BATTEN_OK; i++)
			status = join_cell(m, i, k);
	return status;
}

/* Follows a line from a crossing, taking its points out of the mesh. */
static size_t follow(mesh *m, size_t from, double *u, double *v, bool *closed)
{
	size_t count = 0;
	size_t at = from;
	*closed = false;
	while (at != NONE) {
		crossing *here = &m->links[at];
		u[count] = here->u;
		v[count++] = here->v;
		here->there = false;
		const size_t *joined = here->joined;
		const bool first = joined[0] != NONE && m->links[joined[0]].there;
		const bool second = joined[1] != NONE && m->links[joined[1]].there;
		*closed = !first && !second && count > 2 && (joined[0] == from || joined[1] == from);
		at = first ? joined[0] : second ? joined[1] : NONE;
	}
	return count;
}

/* Open lines from their ends first; what is left is closed. */
static void collect(mesh *m, struct batten_contours *out)
{
	for (int pass = 0; pass < 2; pass++)
		for (size_t n = 0; n < m->link_count; n++) {
			const crossing *c = &m->links[n];
			if (!c->there || (pass == 0 && c->joined[1] != NONE))
				continue;
			contour_line *line = &out->lines[out->count++];
			line->first = out->points;
			line->count = follow(m, n, out->u + out->points, out->v + out->points, &line->closed);
			out->points += line->count;
		}
	for (size_t p = 0; p < out->points; p++) {
		batten_surface_point point;
		if (batten_surface_evaluate(m->surface, out->u[p], out->v[p], &point) == BATTEN_OK)
			for (size_t c = 0; c < 3; c++)
				out->points_m[3 * p + c] = point.derivative[0][0][c];
	}
}

static batten_status contours_allocate(const mesh *m, struct batten_contours **out)
{
	size_t points = 0;
	for (size_t n = 0; n < m->link_count; n++)
		points += m->links[n].there;
	struct batten_contours *made = batten_allocate(m->context, 1, sizeof *made);
	if (!made)
		return BATTEN_MEMORY;
	made->context = m->context;
	const size_t room = points ? points : 1;
	made->lines = batten_allocate(m->context, room, sizeof *made->lines);
	made->u = batten_allocate(m->context, room, sizeof *made->u);
	made->v = batten_allocate(m->context, room, sizeof *made->v);
	made->points_m = batten_allocate(m->context, room, 3 * sizeof *made->points_m);
	if (made->lines && made->u && made->v && made->points_m) {
		*out = made;
		return BATTEN_OK;
	}
	batten_contours_destroy(made);
	return BATTEN_MEMORY;
}

static batten_status check(const mesh *m)
{
	const batten_surface_samples *s = m->samples;
	if (m->value < 0 || m->value >= BATTEN_SURFACE_VALUE_COUNT || !isfinite(m->level))
		return batten_fail(m->context, BATTEN_USAGE,
		                   "a contour of value %d at %g: one of the list and a finite level were "
		                   "expected",
		                   (int)m->value, m->level);
	if (surface_samples_check(m->context, "u", s->u_count) != BATTEN_OK ||
	    surface_samples_check(m->context, "v", s->v_count) != BATTEN_OK)
		return BATTEN_USAGE;
	if (s->u_count < 2 || s->v_count < 2)
		return batten_fail(m->context, BATTEN_USAGE,
		                   "a contour over %zu x %zu samples: at least 2 x 2 were expected",
		                   s->u_count, s->v_count);
	return BATTEN_OK;
}

batten_status batten_surface_contour(batten_context *context, const batten_surface *surface,
                                     batten_surface_value value, double level,
                                     const batten_surface_samples *samples, batten_contours **out)
{
	mesh m = {
		.context = context, .surface = surface, .samples = samples, .value = value, .level = level
	};
	batten_status status = check(&m);
	if (status != BATTEN_OK)
		return status;
	m.link_count = links_along_u(&m) + samples->u_count * (samples->v_count - 1);
	m.above = batten_allocate(context, samples->u_count * samples->v_count, sizeof *m.above);
	m.links = batten_allocate(context, m.link_count, sizeof *m.links);
	if (!m.above || !m.links)
		status = BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = march(&m);
	if (status == BATTEN_OK)
		status = contours_allocate(&m, out);
	if (status == BATTEN_OK)
		collect(&m, *out);
	batten_release(context, m.above);
	batten_release(context, m.links);
	return status;
}

void batten_contours_destroy(batten_contours *contours)
{
	if (!contours)
		return;
	batten_release(contours->context, contours->lines);
	batten_release(contours->context, contours->u);
	batten_release(contours->context, contours->v);
	batten_release(contours->context, contours->points_m);
	batten_release(contours->context, contours);
}

size_t batten_contours_count(const batten_contours *contours)
{
	return contours->count;
}

batten_contour batten_contours_at(const batten_contours *contours, size_t i)
{
	if (i >= contours->count)
		return (batten_contour){ 0 };
	const contour_line *line = &contours->lines[i];
	return (batten_contour){ .count = line->count,
		                     .closed = line->closed,
		                     .u = contours->u + line->first,
		                     .v = contours->v + line->first,
		                     .points_m = contours->points_m + 3 * line->first };
}
