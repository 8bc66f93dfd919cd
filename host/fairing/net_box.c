#include "fairing/net_box.h"

#include "fairing/box.h"

#include <math.h>

enum { SAMPLES_A_SPAN = 8 };

/* What is known while the box is made. */
struct work {
	const struct batten_surface *surface;
	struct net_box *box;
	uint8_t *locked; /* [rows][columns] */
};

/* Holds all poles that count in the spans that end the basis functions span_u and span_v. */
static void hold_span(struct work *work, size_t span_u, size_t span_v)
{
	const struct batten_surface *s = work->surface;
	for (size_t j = span_v + 1 - s->order_v; j <= span_v; j++)
		for (size_t i = span_u + 1 - s->order_u; i <= span_u; i++)
			work->locked[j * s->count_u + i] = 1;
}

/* Holds the offsets of the table that are locked. */
static void hold_places(struct work *work, const batten_fairing *fairing,
                        const struct net_place *places)
{
	const struct batten_surface *s = work->surface;
	for (size_t n = 0; n < hull_node_count(fairing->smoothed); n++)
		if (fairing->locked[n] && places[n].kind != NET_PLACE_NONE)
			hold_span(work, bspline_span(s->order_u, s->count_u, s->knots_u, places[n].edge_u),
			          bspline_span(s->order_v, s->count_v, s->knots_v, places[n].edge_v));
}

/* Whether a coordinate takes a value within a span, as far as its samples tell. */
static bool span_has(const struct batten_surface *s, size_t span_u, size_t span_v,
                     size_t coordinate, double value)
{
	double least = INFINITY;
	double most = -INFINITY;
	for (size_t j = 0; j <= SAMPLES_A_SPAN; j++)
		for (size_t i = 0; i <= SAMPLES_A_SPAN; i++) {
			const double part_u = (double)i / SAMPLES_A_SPAN;
			const double part_v = (double)j / SAMPLES_A_SPAN;
			surface_jet jet;
			surface_evaluate(
				s, (1.0 - part_u) * s->knots_u[span_u] + part_u * s->knots_u[span_u + 1],
				(1.0 - part_v) * s->knots_v[span_v] + part_v * s->knots_v[span_v + 1], 0, jet);
			least = fmin(least, jet[0][0][coordinate]);
			most = fmax(most, jet[0][0][coordinate]);
		}
	return least <= value && value <= most;
}

/* Holds a station or waterline between its offsets too. */
static void hold_line(struct work *work, const batten_lock *lock)
{
	const struct batten_surface *s = work->surface;
	const bool station = lock->kind == BATTEN_LOCK_STATION;
	for (size_t j = s->order_v - 1; j < s->count_v; j++)
		for (size_t i = s->order_u - 1; i < s->count_u; i++)
			if (s->knots_u[i] < s->knots_u[i + 1] && s->knots_v[j] < s->knots_v[j + 1] &&
			    span_has(s, i, j, station ? 0 : 2, station ? lock->x_m : lock->z_m))
				hold_span(work, i, j);
}

/* Number of pole k of an edge, or of the line of poles beside it (in = 1); SIZE_MAX past its end. */
static size_t edge_pole(const struct batten_surface *s, unsigned edge, size_t in, size_t k)
{
	const size_t nu = s->count_u;
	const size_t nv = s->count_v;
	if (k >= (edge & (BATTEN_EDGE_KEEL | BATTEN_EDGE_DECK) ? nu : nv))
		return SIZE_MAX;
	switch (edge) {
	case BATTEN_EDGE_KEEL:
		return in * nu + k;
	case BATTEN_EDGE_DECK:
		return (nv - 1 - in) * nu + k;
	case BATTEN_EDGE_STERN:
		return k * nu + in;
	default:
		return k * nu + nu - 1 - in;
	}
}

static void hold_edges(struct work *work, const batten_fair_options *options, double half_beam)
{
	const struct batten_surface *s = work->surface;
	for (unsigned edge = BATTEN_EDGE_KEEL; edge <= BATTEN_EDGE_DECK; edge <<= 1) {
		size_t pole = 0;
		for (size_t k = 0; (pole = edge_pole(s, edge, 0, k)) != SIZE_MAX; k++) {
			const bool flat = edge != BATTEN_EDGE_DECK &&
			                  fabs(s->poles[3 * pole + 1]) <= NET_BOX_CENTREPLANE * half_beam;
			if (flat || options->locked_edges & edge)
				work->locked[pole] = 1;
		}
	}
}

static batten_status hold_net_lock(struct work *work, const batten_net_lock *lock)
{
	const struct batten_surface *s = work->surface;
	const bool needs_row = lock->kind != BATTEN_NET_LOCK_COLUMN;
	const bool needs_column = lock->kind != BATTEN_NET_LOCK_ROW;
	if (needs_row && lock->row >= s->count_v)
		return batten_fail(s->context, BATTEN_USAGE,
		                   "lock: found row %zu, expected 0 to %zu: the net has %zu x %zu poles",
		                   lock->row, s->count_v - 1, s->count_u, s->count_v);
	if (needs_column && lock->column >= s->count_u)
		return batten_fail(s->context, BATTEN_USAGE,
		                   "lock: found column %zu, expected 0 to %zu: the net has %zu x %zu poles",
		                   lock->column, s->count_u - 1, s->count_u, s->count_v);
	for (size_t j = 0; j < s->count_v; j++)
		for (size_t i = 0; i < s->count_u; i++)
			if ((!needs_row || j == lock->row) && (!needs_column || i == lock->column))
				work->locked[j * s->count_u + i] = 1;
	return BATTEN_OK;
}

static size_t lead(size_t *leader, size_t pole)
{
	while (leader[pole] != pole)
		pole = leader[pole] = leader[leader[pole]];
	return pole;
}

/* Poles of the edges and those beside them into groups led by their first; a group that has a held
 * pole is held. */
static void link_edges(struct work *work, unsigned edges)
{
	const struct batten_surface *s = work->surface;
	size_t *leader = work->box->leader;
	const size_t poles = s->count_u * s->count_v;
	for (size_t p = 0; p < poles; p++)
		leader[p] = p;
	for (unsigned edge = BATTEN_EDGE_KEEL; edge <= BATTEN_EDGE_DECK; edge <<= 1) {
		size_t pole = 0;
		for (size_t k = 0; edges & edge && (pole = edge_pole(s, edge, 0, k)) != SIZE_MAX; k++) {
			const size_t a = lead(leader, pole);
			const size_t b = lead(leader, edge_pole(s, edge, 1, k));
			leader[a > b ? a : b] = a > b ? b : a;
		}
	}
	for (size_t p = 0; p < poles; p++) {
		leader[p] = lead(leader, p);
		work->locked[leader[p]] |= work->locked[p];
	}
	for (size_t p = 0; p < poles; p++)
		work->locked[p] |= work->locked[leader[p]];
}

static void bound(struct work *work, double distance, double half_beam)
{
	const struct batten_surface *s = work->surface;
	for (size_t p = 0; p < s->count_u * s->count_v; p++) {
		const double y = s->poles[3 * p + 1];
		double lower = fmax(fmin(y, 0.0), y - FAIRING_LIMIT_MARGIN * distance);
		double upper = fmin(fmax(y, FAIRING_HALF_BEAM_LIMIT * half_beam),
		                    y + FAIRING_LIMIT_MARGIN * distance);
		if (work->locked[p])
			lower = upper = y;
		work->box->lower_m[p] = lower;
		work->box->upper_m[p] = upper;
		work->box->locked_count += !(lower < upper);
	}
}

static batten_status fill(struct work *work, const batten_fairing *fairing,
                          const batten_fair_options *options, const struct net_place *places)
{
	const double half_beam = batten_hull_half_beam_m(fairing->smoothed);
	hold_edges(work, options, half_beam);
	hold_places(work, fairing, places);
	for (size_t l = 0; l < options->lock_count; l++)
		if (options->locks[l].kind != BATTEN_LOCK_POINT)
			hold_line(work, &options->locks[l]);
	for (size_t l = 0; l < options->net_lock_count; l++) {
		const batten_status status = hold_net_lock(work, &options->net_locks[l]);
		if (status != BATTEN_OK)
			return status;
	}
	link_edges(work, options->fixed_tangents);
	bound(work, fairing->facts.max_distance_m, half_beam);
	return BATTEN_OK;
}

batten_status net_box_create(const batten_fairing *fairing, const batten_fair_options *options,
                             const struct net_place *places, struct net_box *out)
{
	batten_context *context = fairing->context;
	const struct batten_surface *surface = fairing->fitted_surface;
	const size_t poles = surface->count_u * surface->count_v;
	struct net_box box = {
		.lower_m = batten_allocate(context, poles, sizeof(double)),
		.upper_m = batten_allocate(context, poles, sizeof(double)),
		.leader = batten_allocate(context, poles, sizeof(size_t)),
	};
	struct work work = {
		.surface = surface,
		.box = &box,
		.locked = batten_allocate(context, poles, 1),
	};
	batten_status status = BATTEN_MEMORY;
	if (box.lower_m && box.upper_m && box.leader && work.locked)
		status = fill(&work, fairing, options, places);
	batten_release(context, work.locked);
	if (status != BATTEN_OK) {
		net_box_release(context, &box);
		return status;
	}
	*out = box;
	return BATTEN_OK;
}

void net_box_release(batten_context *context, struct net_box *box)
{
	batten_release(context, box->lower_m);
	batten_release(context, box->upper_m);
	batten_release(context, box->leader);
	*box = (struct net_box){ 0 };
}
