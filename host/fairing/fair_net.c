/* Fairing by the control net of a surface fitted to the offsets (thesis 3.2.3.2 and 7, Letcher
 * 4.9). */
#include "fairing/conclude.h"
#include "fairing/discrepancy.h"
#include "fairing/fairing.h"
#include "fairing/net_box.h"
#include "fairing/net_fit.h"
#include "fairing/net_places.h"
#include "fairing/net_space.h"

#include <math.h>

struct work {
	batten_fairing *fairing;
	const batten_fair_options *options;
	struct net_place *places; /* of the nodes */
	struct net_box box;
	double *y; /* [searches][rows][columns] */
};

/* Whether a node takes its half-breadth from the surface. A profile zero stays. */
static bool is_moved(const struct work *work, size_t node)
{
	const batten_fairing *fairing = work->fairing;
	const batten_hull *hull = fairing->smoothed;
	return hull->nodes[node] == BATTEN_NODE_GIVEN && hull->y_m[node] > 0.0 &&
	       !fairing->locked[node] && work->places[node].kind != NET_PLACE_NONE;
}

static void set_y(struct batten_surface *surface, const double *y)
{
	for (size_t p = 0; p < surface->count_u * surface->count_v; p++)
		surface->poles[3 * p + 1] = y[p];
}

/* Root mean square distance of the faired surface from the fitted one, at the offsets. */
static double rms_change(const struct work *work)
{
	const batten_fairing *fairing = work->fairing;
	double sum = 0.0;
	size_t count = 0;
	for (size_t n = 0; n < hull_node_count(fairing->smoothed); n++)
		if (is_moved(work, n)) {
			const struct net_place *at = &work->places[n];
			const double change = net_place_y(at, fairing->fitted_surface,
			                                  fairing->faired_surface) -
			                      net_place_y(at, fairing->fitted_surface, fairing->fitted_surface);
			sum += change * change;
			count++;
		}
	return count > 0 ? sqrt(sum / (double)count) : 0.0;
}

/* Noise that least squares leave in the surface: white noise of n offsets, projected on the
 * surfaces that p poles can make, keeps the part p / n of its variance. */
static double noise_left(const struct work *work)
{
	const batten_fairing *fairing = work->fairing;
	const struct batten_surface *s = fairing->fitted_surface;
	double poles = 0.0;
	double offsets = 0.0;
	for (size_t p = 0; p < s->count_u * s->count_v; p++)
		poles += s->poles[3 * p + 1] != 0.0;
	for (size_t n = 0; n < hull_node_count(fairing->smoothed); n++)
		offsets += fairing->smoothed->nodes[n] == BATTEN_NODE_GIVEN &&
		           fairing->smoothed->y_m[n] > 0.0;
	return fairing->facts.noise_m * sqrt(fmin(1.0, poles / fmax(1.0, offsets)));
}

/* Number of the search whose weight is taken. */
static size_t choose(struct work *work, size_t count)
{
	struct batten_surface *faired = work->fairing->faired_surface;
	const size_t poles = faired->count_u * faired->count_v;
	double changes[DISCREPANCY_RATIOS];
	for (size_t i = 0; i < count; i++) {
		set_y(faired, work->y + i * poles);
		changes[i] = rms_change(work);
	}
	return work->options->weights_given ? 0 : discrepancy_choose(count, changes, noise_left(work));
}

/* The half-breadths of the faired hull, and how they came about. A positive offset stays positive. */
static void read_offsets(struct work *work)
{
	batten_fairing *fairing = work->fairing;
	batten_hull *faired = fairing->faired;
	for (size_t n = 0; n < hull_node_count(faired); n++) {
		if (faired->nodes[n] != BATTEN_NODE_GIVEN || !(faired->y_m[n] > 0.0))
			continue;
		const struct net_place *at = &work->places[n];
		const double y = is_moved(work, n)
		                     ? net_place_y(at, fairing->fitted_surface, fairing->faired_surface)
		                     : 0.0;
		fairing->net.on_count += at->kind != NET_PLACE_NONE;
		fairing->net.beyond_count += at->kind == NET_PLACE_BEYOND;
		if (y > 0.0)
			faired->y_m[n] = y;
		else
			fairing->net.kept_count++;
	}
}

/* Whether the line of a line end is locked. */
static bool is_end_locked(const struct work *work, const hull_line_end *end)
{
	const batten_hull *hull = work->fairing->smoothed;
	for (size_t l = 0; l < work->options->lock_count; l++) {
		const batten_lock *lock = &work->options->locks[l];
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
static void read_ends(struct work *work)
{
	batten_fairing *fairing = work->fairing;
	batten_hull *faired = fairing->faired;
	for (size_t e = 0; e < faired->end_count; e++) {
		const struct net_place *at = &work->places[hull_node_count(faired) + e];
		hull_line_end *end = &faired->ends[e];
		if (!(end->y_m > 0.0) || at->kind == NET_PLACE_NONE || is_end_locked(work, end))
			continue;
		const double y = net_place_y(at, fairing->fitted_surface, fairing->faired_surface);
		if (y > 0.0)
			end->y_m = y;
	}
}

static void count_poles(struct work *work)
{
	batten_fairing *fairing = work->fairing;
	const struct batten_surface *s = fairing->faired_surface;
	const struct net_box *box = &work->box;
	const size_t poles = s->count_u * s->count_v;
	fairing->net.pole_count = poles;
	fairing->net.locked_count = box->locked_count;
	fairing->facts.variable_count = poles - box->locked_count;
	for (size_t p = 0; p < poles; p++)
		if (box->lower_m[p] < box->upper_m[p] &&
		    (s->poles[3 * p + 1] <= box->lower_m[p] || s->poles[3 * p + 1] >= box->upper_m[p]))
			fairing->facts.at_limit_count++;
}

static batten_status measure(struct work *work)
{
	batten_fairing *fairing = work->fairing;
	const batten_surface *surfaces[2] = { fairing->fitted_surface, fairing->faired_surface };
	batten_surface_energies energies[2];
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = work->options->search.device;
	options.precision = work->options->search.precision;
	options.variation = true;
	const batten_status status = batten_surface_energy_batch(fairing->context, 2, surfaces,
	                                                         &options, energies, NULL);
	if (status == BATTEN_OK) {
		fairing->net.before = energies[0];
		fairing->net.after = energies[1];
	}
	return status;
}

static batten_status search(struct work *work)
{
	batten_fairing *fairing = work->fairing;
	const batten_fair_options *options = work->options;
	const struct batten_surface *s = fairing->fitted_surface;
	const size_t count = options->weights_given ? 1 : DISCREPANCY_RATIOS;
	batten_net_problem problems[DISCREPANCY_RATIOS];
	batten_search_result results[DISCREPANCY_RATIOS];
	for (size_t i = 0; i < count; i++)
		problems[i] = (batten_net_problem){
			.start = s,
			.lower_y_m = work->box.lower_m,
			.upper_y_m = work->box.upper_m,
			.w1 = options->weights_given ? options->w1 : 1.0,
			.w2 = options->weights_given ? options->w2 : discrepancy_ratio(i),
			.half_beam_m = batten_hull_half_beam_m(fairing->smoothed),
		};
	batten_net_options how;
	batten_net_options_default(&how);
	how.search = options->search;
	how.fairness = options->fairness;
	how.leader = work->box.leader;
	work->y = batten_allocate(fairing->context, count, s->count_u * s->count_v * sizeof *work->y);
	if (!work->y)
		return BATTEN_MEMORY;
	const batten_status status = batten_net_search_batch(fairing->context, count, problems, &how,
	                                                     work->y, results, &fairing->run);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		return status;
	for (size_t i = 0; i < count; i++)
		if (results[i].end == BATTEN_SEARCH_REFUSED)
			return batten_fail(fairing->context, BATTEN_INPUT, "%s: the fitted surface: %s",
			                   fairing->smoothed->name, results[i].message);
	const size_t chosen = choose(work, count);
	double *y = work->y + chosen * s->count_u * s->count_v;
	net_space one = { .fairing = fairing, .box = &work->box, .how = &how };
	one.problem = problems[chosen];
	fairing_space space;
	batten_status concluded = net_space_open(&one, &space);
	if (concluded == BATTEN_OK)
		concluded = fairing_conclude(fairing, options, &space, y, &results[chosen]);
	net_space_close(&one);
	if (concluded != BATTEN_OK)
		return concluded;
	set_y(fairing->faired_surface, y);
	fairing->facts.rms_change_m = rms_change(work);
	fairing->result = results[chosen];
	fairing->facts.w1 = problems[chosen].w1;
	fairing->facts.w2 = problems[chosen].w2;
	return BATTEN_OK;
}

static batten_status fit(struct work *work)
{
	batten_fairing *fairing = work->fairing;
	batten_status status = net_fit(fairing->smoothed, &work->options->fit, fairing->facts.noise_m,
	                               &fairing->fitted_surface, &fairing->net.deviation);
	if (status == BATTEN_OK)
		status = batten_surface_clone(fairing->context, fairing->fitted_surface,
		                              &fairing->faired_surface);
	return status;
}

batten_status fair_net(batten_fairing *fairing, const batten_fair_options *options)
{
	struct work work = { .fairing = fairing, .options = options };
	batten_status status = fit(&work);
	if (status == BATTEN_OK)
		status = net_places_find(fairing->smoothed, fairing->fitted_surface,
		                         fairing->net.deviation.max_m, &work.places);
	if (status == BATTEN_OK)
		status = net_box_create(fairing, options, work.places, &work.box);
	if (status == BATTEN_OK)
		status = search(&work);
	if (status == BATTEN_OK)
		status = measure(&work);
	if (status == BATTEN_OK) {
		read_offsets(&work);
		read_ends(&work);
		count_poles(&work);
	}
	net_box_release(fairing->context, &work.box);
	batten_release(fairing->context, work.places);
	batten_release(fairing->context, work.y);
	return status;
}
