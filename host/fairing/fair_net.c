/* Fairing by the control net of a surface fitted to the offsets (thesis 3.2.3.2 and 7, Letcher
 * 4.9). */
#include "fairing/discrepancy.h"
#include "fairing/net_fairing.h"

#include <math.h>

/* Noise that least squares leave in the surface: white noise of n offsets, projected on the
 * surfaces that p poles can make, keeps the part p / n of its variance. */
static double noise_left(const net_fairing *n)
{
	const batten_fairing *fairing = n->fairing;
	const struct batten_surface *s = fairing->fitted_surface;
	double poles = 0.0;
	double offsets = 0.0;
	for (size_t p = 0; p < s->count_u * s->count_v; p++)
		poles += s->poles[3 * p + 1] != 0.0;
	for (size_t node = 0; node < hull_node_count(fairing->smoothed); node++)
		offsets += fairing->smoothed->nodes[node] == BATTEN_NODE_GIVEN &&
		           fairing->smoothed->y_m[node] > 0.0;
	return fairing->facts.noise_m * sqrt(fmin(1.0, poles / fmax(1.0, offsets)));
}

/* Number of the search whose weight is taken. */
static size_t choose(net_fairing *n, size_t count, const double *y)
{
	const size_t poles = n->fairing->faired_surface->count_u * n->fairing->faired_surface->count_v;
	double changes[DISCREPANCY_RATIOS];
	for (size_t i = 0; i < count; i++) {
		net_fairing_put(n, y + i * poles);
		changes[i] = net_fairing_change(n).rms_m;
	}
	return n->options->weights_given ? 0 : discrepancy_choose(count, changes, noise_left(n));
}

/* The half-breadths of the faired hull, and how they came about. A positive offset stays positive. */
static void read_offsets(const net_fairing *n)
{
	batten_fairing *fairing = n->fairing;
	batten_hull *faired = fairing->faired;
	for (size_t node = 0; node < hull_node_count(faired); node++) {
		if (faired->nodes[node] != BATTEN_NODE_GIVEN || !(faired->y_m[node] > 0.0))
			continue;
		const struct net_place *at = &n->places[node];
		const double y = net_fairing_moves(n, node)
		                     ? net_place_y(at, fairing->fitted_surface, fairing->faired_surface)
		                     : 0.0;
		fairing->net.on_count += at->kind != NET_PLACE_NONE;
		fairing->net.beyond_count += at->kind == NET_PLACE_BEYOND;
		if (y > 0.0)
			faired->y_m[node] = y;
		else
			fairing->net.kept_count++;
	}
}

/* Whether the line of a line end is locked. */
static bool is_end_locked(const net_fairing *n, const hull_line_end *end)
{
	const batten_hull *hull = n->fairing->smoothed;
	for (size_t l = 0; l < n->options->lock_count; l++) {
		const batten_lock *lock = &n->options->locks[l];
		if (end->on_waterline ? lock->kind == BATTEN_LOCK_WATERLINE &&
		                            hull_waterline_at(hull, lock->z_m) == end->line
		                      : lock->kind == BATTEN_LOCK_STATION &&
		                            hull_station_at(hull, lock->x_m) == end->line)
			return true;
	}
	return false;
}

/* The line ends off the table, as a transom has them: lines would have a kink before one that did
 * not move with them. */
static void read_ends(const net_fairing *n)
{
	batten_fairing *fairing = n->fairing;
	batten_hull *faired = fairing->faired;
	for (size_t e = 0; e < faired->end_count; e++) {
		const struct net_place *at = &n->places[hull_node_count(faired) + e];
		hull_line_end *end = &faired->ends[e];
		if (!(end->y_m > 0.0) || at->kind == NET_PLACE_NONE || is_end_locked(n, end))
			continue;
		const double y = net_place_y(at, fairing->fitted_surface, fairing->faired_surface);
		if (y > 0.0)
			end->y_m = y;
	}
}

static void count_poles(const net_fairing *n)
{
	batten_fairing *fairing = n->fairing;
	const struct batten_surface *s = fairing->faired_surface;
	const struct net_box *box = &n->box;
	const size_t poles = s->count_u * s->count_v;
	fairing->net.pole_count = poles;
	fairing->net.locked_count = box->locked_count;
	fairing->facts.variable_count = poles - box->locked_count;
	for (size_t p = 0; p < poles; p++)
		if (box->lower_m[p] < box->upper_m[p] &&
		    (s->poles[3 * p + 1] <= box->lower_m[p] || s->poles[3 * p + 1] >= box->upper_m[p]))
			fairing->facts.at_limit_count++;
}

static batten_status measure(const net_fairing *n)
{
	batten_fairing *fairing = n->fairing;
	const batten_surface *surfaces[2] = { fairing->fitted_surface, fairing->faired_surface };
	batten_surface_energies energies[2];
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = n->options->search.device;
	options.precision = n->options->search.precision;
	options.variation = true;
	const batten_status status = batten_surface_energy_batch(fairing->context, 2, surfaces,
	                                                         &options, energies, NULL);
	if (status == BATTEN_OK) {
		fairing->net.before = energies[0];
		fairing->net.after = energies[1];
	}
	return status;
}

static batten_status search(net_fairing *n)
{
	batten_fairing *fairing = n->fairing;
	const batten_fair_options *options = n->options;
	const size_t poles = fairing->fitted_surface->count_u * fairing->fitted_surface->count_v;
	const size_t count = options->weights_given ? 1 : DISCREPANCY_RATIOS;
	batten_net_problem problems[DISCREPANCY_RATIOS];
	batten_search_result results[DISCREPANCY_RATIOS];
	for (size_t i = 0; i < count; i++)
		problems[i] = net_fairing_problem(n, options->weights_given ? options->w1 : 1.0,
		                                  options->weights_given ? options->w2
		                                                         : discrepancy_ratio(i));
	double *y = batten_allocate(fairing->context, count, poles * sizeof *y);
	if (!y)
		return BATTEN_MEMORY;
	batten_status status = net_fairing_search(n, count, problems, y, results);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE) {
		const size_t chosen = choose(n, count, y);
		status = net_fairing_conclude(n, &problems[chosen], y + chosen * poles, &results[chosen]);
		net_fairing_put(n, y + chosen * poles);
		fairing->facts.rms_change_m = net_fairing_change(n).rms_m;
		fairing->result = results[chosen];
		fairing->facts.w1 = problems[chosen].w1;
		fairing->facts.w2 = problems[chosen].w2;
	}
	batten_release(fairing->context, y);
	return status;
}

batten_status fair_net(batten_fairing *fairing, const batten_fair_options *options)
{
	net_fairing n;
	batten_status status = net_fairing_open(fairing, options, &n);
	if (status == BATTEN_OK)
		status = search(&n);
	if (status == BATTEN_OK)
		status = measure(&n);
	if (status == BATTEN_OK) {
		read_offsets(&n);
		read_ends(&n);
		count_poles(&n);
	}
	net_fairing_close(&n);
	return status;
}
