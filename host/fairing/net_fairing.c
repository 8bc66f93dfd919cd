#include "fairing/net_fairing.h"

#include "fairing/net_fit.h"
#include "fairing/net_space.h"

#include <math.h>

static batten_status fit(batten_fairing *fairing, const batten_fair_options *options)
{
	batten_status status = net_fit(fairing->smoothed, &options->fit, fairing->facts.noise_m,
	                               &fairing->fitted_surface, &fairing->net.deviation);
	if (status == BATTEN_OK)
		status = batten_surface_clone(fairing->context, fairing->fitted_surface,
		                              &fairing->faired_surface);
	return status;
}

batten_status net_fairing_open(batten_fairing *fairing, const batten_fair_options *options,
                               net_fairing *out)
{
	*out = (net_fairing){ .fairing = fairing, .options = options };
	batten_status status = fit(fairing, options);
	if (status == BATTEN_OK)
		status = net_places_find(fairing->smoothed, fairing->fitted_surface,
		                         fairing->net.deviation.max_m, &out->places);
	if (status == BATTEN_OK)
		status = net_box_create(fairing, options, out->places, &out->box);
	batten_net_options_default(&out->how);
	out->how.search = options->search;
	out->how.fairness = options->fairness;
	out->how.leader = out->box.leader;
	return status;
}

void net_fairing_close(net_fairing *n)
{
	net_box_release(n->fairing->context, &n->box);
	batten_release(n->fairing->context, n->places);
}

batten_net_problem net_fairing_problem(const net_fairing *n, double w1, double w2)
{
	return (batten_net_problem){ .start = n->fairing->fitted_surface,
		                         .lower_y_m = n->box.lower_m,
		                         .upper_y_m = n->box.upper_m,
		                         .w1 = w1,
		                         .w2 = w2,
		                         .half_beam_m = batten_hull_half_beam_m(n->fairing->smoothed) };
}

batten_status net_fairing_search(net_fairing *n, size_t count, const batten_net_problem *problems,
                                 double *y, batten_search_result *results)
{
	batten_fairing *fairing = n->fairing;
	const batten_status status = batten_net_search_batch(fairing->context, count, problems, &n->how,
	                                                     y, results, &fairing->run);
	for (size_t i = 0; status == BATTEN_INCOMPLETE && i < count; i++)
		if (results[i].end == BATTEN_SEARCH_REFUSED)
			return batten_fail(
				fairing->context, BATTEN_INPUT, "%s: the fitted surface, w1 = %g, w2 = %g: %s",
				fairing->smoothed->name, problems[i].w1, problems[i].w2, results[i].message);
	return status;
}

batten_status net_fairing_conclude(net_fairing *n, const batten_net_problem *problem, double *y,
                                   batten_search_result *result)
{
	net_space one = { .fairing = n->fairing, .box = &n->box, .how = &n->how, .problem = *problem };
	return net_space_conclude(&one, n->options, y, result);
}

void net_fairing_put(net_fairing *n, const double *y)
{
	struct batten_surface *surface = n->fairing->faired_surface;
	for (size_t p = 0; p < surface->count_u * surface->count_v; p++)
		surface->poles[3 * p + 1] = y[p];
}

bool net_fairing_moves(const net_fairing *n, size_t node)
{
	const batten_hull *hull = n->fairing->smoothed;
	return hull->nodes[node] == BATTEN_NODE_GIVEN && hull->y_m[node] > 0.0 &&
	       !n->fairing->locked[node] && n->places[node].kind != NET_PLACE_NONE;
}

net_change net_fairing_change(const net_fairing *n)
{
	const struct batten_surface *fitted = n->fairing->fitted_surface;
	double sum = 0.0;
	double most = 0.0;
	size_t count = 0;
	for (size_t node = 0; node < hull_node_count(n->fairing->smoothed); node++)
		if (net_fairing_moves(n, node)) {
			const struct net_place *at = &n->places[node];
			const double change = net_place_y(at, fitted, n->fairing->faired_surface) -
			                      net_place_y(at, fitted, fitted);
			sum += change * change;
			most = fmax(most, fabs(change));
			count++;
		}
	return (net_change){ count > 0 ? sqrt(sum / (double)count) : 0.0, most };
}
