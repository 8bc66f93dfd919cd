/* Newton's method on x(u, v) = x, z(u, v) = z. It begins at the place of the node before, on the same
 * waterline or below, and where that does not lead to the node's own half-breadth, at the nearest
 * sample of the surface. */
#include "fairing/net_places.h"

#include <math.h>

enum {
	SAMPLES_A_SPAN = 4,
	STEPS = 40,
};

/* Residuals below this part of the size of the surface are rounding. */
static const double settled = 1e-13;
/* Newton may leave the range of a parameter by this part of it. */
static const double margin = 0.02;
/* A start from the neighbour is trusted up to this part of the half-beam. */
static const double trusted = 0.02;

struct sample {
	double u, v, place[3];
};

struct search {
	const struct batten_surface *surface;
	double first_u, last_u, first_v, last_v;
	double size; /* of the surface, for what is small */
	size_t count;
	struct sample *samples;
};

static double limit(double value, double first, double last)
{
	return value < first ? first : value > last ? last : value;
}

static void search_release(struct search *search)
{
	batten_release(search->surface->context, search->samples);
}

static batten_status search_create(const struct batten_surface *surface, struct search *out)
{
	*out = (struct search){
		.surface = surface,
		.first_u = surface->knots_u[surface->order_u - 1],
		.last_u = surface->knots_u[surface->count_u],
		.first_v = surface->knots_v[surface->order_v - 1],
		.last_v = surface->knots_v[surface->count_v],
	};
	const size_t along = SAMPLES_A_SPAN * (surface->count_u - surface->order_u + 1) + 1;
	const size_t up = SAMPLES_A_SPAN * (surface->count_v - surface->order_v + 1) + 1;
	out->samples = batten_allocate(surface->context, along * up, sizeof *out->samples);
	if (!out->samples)
		return BATTEN_MEMORY;
	for (size_t j = 0; j < up; j++)
		for (size_t i = 0; i < along; i++) {
			struct sample *at = &out->samples[out->count++];
			const double part_u = (double)i / (double)(along - 1);
			const double part_v = (double)j / (double)(up - 1);
			at->u = out->first_u + part_u * (out->last_u - out->first_u);
			at->v = out->first_v + part_v * (out->last_v - out->first_v);
			surface_jet jet;
			surface_evaluate(surface, at->u, at->v, 0, jet);
			for (size_t c = 0; c < 3; c++) {
				at->place[c] = jet[0][0][c];
				out->size = fmax(out->size, fabs(jet[0][0][c]));
			}
		}
	return BATTEN_OK;
}

/* From (*u, *v) to x and z; false when it does not get there. *y: the half-breadth there. */
static bool newton(const struct search *search, double x, double z, double *u, double *v, double *y)
{
	const double range_u = search->last_u - search->first_u;
	const double range_v = search->last_v - search->first_v;
	bool last = false; /* one step after it has settled takes the rest away */
	for (int step = 0; step < STEPS; step++) {
		surface_jet jet;
		surface_evaluate(search->surface, *u, *v, 1, jet);
		const double *by_u = jet[1][0];
		const double *by_v = jet[0][1];
		const double away_x = x - jet[0][0][0];
		const double away_z = z - jet[0][0][2];
		*y = jet[0][0][1];
		if (last)
			return fmax(fabs(away_x), fabs(away_z)) <= 8.0 * settled * search->size;
		last = fmax(fabs(away_x), fabs(away_z)) <= settled * search->size;
		const double determinant = by_u[0] * by_v[2] - by_v[0] * by_u[2];
		if (determinant == 0.0)
			return last;
		const double step_u = (away_x * by_v[2] - away_z * by_v[0]) / determinant;
		const double step_v = (by_u[0] * away_z - by_u[2] * away_x) / determinant;
		/* No more than a tenth of the way at once: a step from a bad place leads anywhere. */
		*u = limit(*u + limit(step_u, -0.1 * range_u, 0.1 * range_u),
		           search->first_u - margin * range_u, search->last_u + margin * range_u);
		*v = limit(*v + limit(step_v, -0.1 * range_v, 0.1 * range_v),
		           search->first_v - margin * range_v, search->last_v + margin * range_v);
	}
	return false;
}

/* Nearest sample to a point of the hull. */
static const struct sample *nearest(const struct search *search, const double place[3])
{
	const struct sample *best = search->samples;
	double least = INFINITY;
	for (size_t s = 0; s < search->count; s++) {
		const double *at = search->samples[s].place;
		const double away = (at[0] - place[0]) * (at[0] - place[0]) +
		                    (at[1] - place[1]) * (at[1] - place[1]) +
		                    (at[2] - place[2]) * (at[2] - place[2]);
		if (away < least) {
			least = away;
			best = &search->samples[s];
		}
	}
	return best;
}

/* On, beyond, or too far beyond an edge. */
static void classify(const struct search *search, const double place[3], double reach,
                     struct net_place *at)
{
	at->edge_u = limit(at->u, search->first_u, search->last_u);
	at->edge_v = limit(at->v, search->first_v, search->last_v);
	at->kind = NET_PLACE_ON;
	if (at->edge_u == at->u && at->edge_v == at->v)
		return;
	surface_jet jet;
	surface_evaluate(search->surface, at->edge_u, at->edge_v, 0, jet);
	const double away = hypot(jet[0][0][0] - place[0], jet[0][0][2] - place[2]);
	if (away <= settled * search->size) {
		at->u = at->edge_u; /* on the edge but for rounding */
		at->v = at->edge_v;
	} else {
		at->kind = away <= reach ? NET_PLACE_BEYOND : NET_PLACE_NONE;
	}
}

static void find(const struct search *search, const double place[3], double close, double reach,
                 const struct net_place *neighbour, struct net_place *out)
{
	double y = 0.0;
	bool found = false;
	if (neighbour && neighbour->kind != NET_PLACE_NONE) {
		out->u = neighbour->u;
		out->v = neighbour->v;
		found = newton(search, place[0], place[2], &out->u, &out->v, &y);
	}
	if (!found || fabs(y - place[1]) > close) {
		const struct sample *start = nearest(search, place);
		double u = start->u;
		double v = start->v;
		double other = 0.0;
		if (newton(search, place[0], place[2], &u, &v, &other) &&
		    (!found || fabs(other - place[1]) < fabs(y - place[1]))) {
			out->u = u;
			out->v = v;
			found = true;
		}
	}
	if (found)
		classify(search, place, reach, out);
}

batten_status net_places_find(const batten_hull *hull, const struct batten_surface *surface,
                              double reach_m, struct net_place **out)
{
	const size_t nx = hull->station_count;
	struct search search;
	struct net_place *places = NULL;
	batten_status status = search_create(surface, &search);
	if (status == BATTEN_OK) {
		places = batten_allocate(hull->context, hull_node_count(hull) + hull->end_count,
		                         sizeof *places);
		status = places ? BATTEN_OK : BATTEN_MEMORY;
	}
	if (status == BATTEN_OK) {
		const double close = trusted * batten_hull_half_beam_m(hull);
		for (size_t n = 0; n < hull_node_count(hull); n++) {
			if (hull->nodes[n] == BATTEN_NODE_OUTSIDE)
				continue;
			const double place[3] = { hull->x_m[n % nx], hull->y_m[n], hull->z_m[n / nx] };
			const bool before = n % nx > 0 && places[n - 1].kind != NET_PLACE_NONE;
			const struct net_place *below = n >= nx ? &places[n - nx] : NULL;
			find(&search, place, close, reach_m, before ? &places[n - 1] : below, &places[n]);
		}
		for (size_t e = 0; e < hull->end_count; e++) {
			const hull_line_end *end = &hull->ends[e];
			const double place[3] = { end->on_waterline ? end->along_m : hull->x_m[end->line],
				                      end->y_m,
				                      end->on_waterline ? hull->z_m[end->line] : end->along_m };
			find(&search, place, close, reach_m, NULL, &places[hull_node_count(hull) + e]);
		}
		*out = places;
	}
	search_release(&search);
	return status;
}

double net_place_y(const struct net_place *place, const struct batten_surface *fitted,
                   const struct batten_surface *faired)
{
	surface_jet jet;
	surface_evaluate(faired, place->edge_u, place->edge_v, 0, jet);
	const double moved = jet[0][0][1];
	if (place->kind != NET_PLACE_BEYOND)
		return moved;
	surface_evaluate(fitted, place->edge_u, place->edge_v, 0, jet);
	const double edge = jet[0][0][1];
	surface_evaluate(fitted, place->u, place->v, 0, jet);
	return jet[0][0][1] + (moved - edge);
}
