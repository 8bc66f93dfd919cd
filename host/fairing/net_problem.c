/* Surfaces, boxes and weights made into the plan of a batch. */
#include "fairing/net_problem.h"

#include "batch/net_block_pack.h"
#include "batch/search_result.h"
#include "core/gauss.h"
#include "core/number.h"
#include "fairing/net_tables.h"

#include <math.h>
#include <stdlib.h>

_Static_assert((int)BATTEN_FAIRNESS_BENDING == NET_FAIRNESS_BENDING &&
                   (int)BATTEN_FAIRNESS_MEAN == NET_FAIRNESS_MEAN &&
                   (int)BATTEN_FAIRNESS_GAUSS == NET_FAIRNESS_GAUSS &&
                   (int)BATTEN_FAIRNESS_VARIATION == NET_FAIRNESS_VARIATION,
               "one list");

enum { POLES_MOST = 65536 };

void batten_net_options_default(batten_net_options *options)
{
	*options = (batten_net_options){ .struct_size = sizeof *options,
		                             .fairness = BATTEN_FAIRNESS_BENDING };
	batten_search_options_default(&options->search);
	/* Poles move far where little closeness is asked for: shorter first steps find the way sooner. */
	options->search.first_step = 0.01;
}

static batten_status check_options(batten_context *context, const batten_net_options *given,
                                   batten_net_options *chosen)
{
	batten_net_options_default(chosen);
	if (given)
		*chosen = *given;
	if (chosen->struct_size != sizeof *chosen)
		return batten_fail(context, BATTEN_USAGE,
		                   "net search options of another version of batten");
	if ((int)chosen->fairness < NET_FAIRNESS_BENDING ||
	    (int)chosen->fairness > NET_FAIRNESS_VARIATION)
		return batten_fail(context, BATTEN_USAGE, "fairness %d: 0 to 3 are expected",
		                   (int)chosen->fairness);
	if (chosen->search.fairness != BATTEN_FAIRNESS_BENDING ||
	    chosen->search.longitudinal_weight != 1.0 || chosen->search.transverse_weight != 1.0)
		return batten_fail(context, BATTEN_USAGE,
		                   "a search over nets takes its fairness from the net's options, and both "
		                   "directions alike");
	if (chosen->gauss_points > GAUSS_POINTS_MOST)
		return batten_fail(context, BATTEN_USAGE, "%u Gauss points a span: at most %d are expected",
		                   chosen->gauss_points, GAUSS_POINTS_MOST);
	return BATTEN_OK;
}

/* What all searches share: topology, tables, leaders. */
static batten_status check_topology(batten_context *context, size_t count,
                                    const batten_net_problem *problems, surface_topology *out)
{
	const batten_surface **surfaces = batten_allocate(context, count, sizeof *surfaces);
	if (!surfaces)
		return BATTEN_MEMORY;
	for (size_t p = 0; p < count; p++)
		surfaces[p] = problems[p].start;
	batten_status status = surface_topology_of(context, count, surfaces, out);
	batten_release(context, surfaces);
	if (status != BATTEN_OK)
		return status;
	if (out->rational)
		return batten_fail(context, BATTEN_USAGE,
		                   "a surface with weights: the net search takes none");
	if (out->count_u * out->count_v > POLES_MOST)
		return batten_fail(context, BATTEN_USAGE, "a net of %zu x %zu poles: at most %d in all",
		                   out->count_u, out->count_v, POLES_MOST);
	return BATTEN_OK;
}

/* The leaders given, or every pole its own. */
static batten_status take_leaders(batten_context *context, size_t poles, const size_t *given,
                                  size_t **out)
{
	for (size_t n = 0; given && n < poles; n++)
		if (given[n] >= poles || given[given[n]] != given[n])
			return batten_fail(context, BATTEN_USAGE, "pole %zu follows pole %zu of %zu, which %s",
			                   n, given[n], poles,
			                   given[n] >= poles ? "does not exist" : "follows another itself");
	size_t *leader = batten_allocate(context, poles, sizeof *leader);
	if (!leader)
		return BATTEN_MEMORY;
	for (size_t n = 0; n < poles; n++)
		leader[n] = given ? given[n] : n;
	*out = leader;
	return BATTEN_OK;
}

static bool is_length(double value)
{
	return fabs(value) <= BSPLINE_POLE_LARGEST;
}

static const char *fault_of(const net_plan *plan, const batten_net_problem *problem)
{
	const char *fault = search_weights_fault(plan->options.precision, problem->w1, problem->w2,
	                                         problem->half_beam_m);
	if (fault)
		return fault;
	if (!problem->lower_y_m || !problem->upper_y_m)
		return "no bounds are given";
	for (size_t n = 0; n < net_plan_poles(plan); n++) {
		if (problem->target_y_m && !is_length(problem->target_y_m[n]))
			return "a target value is not finite or beyond 1e9 m";
		if (!is_length(problem->lower_y_m[n]) || !is_length(problem->upper_y_m[n]) ||
		    problem->lower_y_m[n] > problem->upper_y_m[n])
			return "a lower bound is above its upper bound, not finite or beyond 1e9 m";
	}
	return NULL;
}

/* The median distance from pole to pole along one direction: `step` from one to the next. */
static double spacing_of(const double *poles_m, size_t columns, size_t rows, size_t step,
                         double *room)
{
	size_t count = 0;
	for (size_t k = 0; k + (step == columns) < rows; k++)
		for (size_t i = 0; i + (step == 1) < columns; i++) {
			const double *a = poles_m + 3 * (k * columns + i);
			const double *b = a + 3 * step;
			room[count++] = sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
			                     (a[2] - b[2]) * (a[2] - b[2]));
		}
	qsort(room, count, sizeof *room, batten_number_compare);
	return room[count / 2];
}

static int stretch_of(const batten_surface *surface, double *room)
{
	const double u = spacing_of(surface->poles, surface->count_u, surface->count_v, 1, room);
	const double v = spacing_of(surface->poles, surface->count_u, surface->count_v,
	                            surface->count_u, room);
	if (!(u > 0.0) || !(v > 0.0))
		return 0;
	return (int)fmin(fmax(round(log2(u / v)), -NET_STRETCH_MOST), NET_STRETCH_MOST);
}

/* The y of the starts, for those whose target they are. */
static void take_items(net_plan *plan, const batten_net_problem *problems, double *targets,
                       double *room)
{
	const size_t poles = net_plan_poles(plan);
	for (size_t p = 0; p < plan->count; p++) {
		double *target = targets + p * poles;
		const double *given = problems[p].target_y_m;
		for (size_t n = 0; n < poles; n++)
			target[n] = given ? given[n] : problems[p].start->poles[3 * n + 1];
		plan->items[p] = (net_item){ .poles_m = problems[p].start->poles,
			                         .target_y_m = target,
			                         .lower_y_m = problems[p].lower_y_m,
			                         .upper_y_m = problems[p].upper_y_m,
			                         .w1 = problems[p].w1,
			                         .w2 = problems[p].w2,
			                         .half_beam_m = problems[p].half_beam_m,
			                         .fault = fault_of(plan, &problems[p]),
			                         .stretch = plan->block ? 0
			                                                : stretch_of(problems[p].start, room) };
	}
}

static batten_status make_tables(net_plan *plan, const surface_topology *t, unsigned points)
{
	const size_t along_u = points ? points : t->order_u;
	const size_t along_v = points ? points : t->order_v;
	batten_status status = net_tables_create(plan->context, t->order_u, t->count_u, t->knots_u,
	                                         along_u, &plan->u);
	if (status == BATTEN_OK)
		status = net_tables_create(plan->context, t->order_v, t->count_v, t->knots_v, along_v,
		                           &plan->v);
	return status;
}

/* The block search where it is asked for, or knows the plan's searches and none is. */
static batten_status choose_algorithm(net_plan *plan)
{
	const batten_search_algorithm asked = plan->options.algorithm;
	if (asked != BATTEN_ALGORITHM_AUTO && asked != BATTEN_ALGORITHM_MULTILEVEL &&
	    asked != BATTEN_ALGORITHM_BLOCK)
		return batten_fail(plan->context, BATTEN_USAGE,
		                   "search algorithm %s: auto, block or multilevel is expected for a net",
		                   batten_search_algorithm_text(asked));
	if (asked == BATTEN_ALGORITHM_MULTILEVEL)
		return BATTEN_OK;
	const batten_status status = net_block_knows(plan, &plan->block);
	if (status == BATTEN_OK && asked == BATTEN_ALGORITHM_BLOCK && !plan->block)
		return batten_fail(
			plan->context, BATTEN_USAGE,
			"the block search over nets knows bending and mean on nets whose table is "
			"of moderate size, not %s on %zu x %zu poles: multilevel or auto is expected",
			batten_fairness_text((batten_fairness)plan->fairness), plan->u.poles, plan->v.poles);
	return status;
}

static batten_status take_batch(net_problems *p, const batten_net_problem *problems,
                                const batten_net_options *chosen)
{
	net_plan *plan = &p->plan;
	surface_topology topology = { 0 };
	batten_status status = check_topology(plan->context, plan->count, problems, &topology);
	if (status != BATTEN_OK)
		return status;
	const size_t poles = topology.count_u * topology.count_v;
	status = take_leaders(plan->context, poles, chosen->leader, &p->leader);
	if (status != BATTEN_OK)
		return status;
	plan->leader = p->leader;
	status = make_tables(plan, &topology, chosen->gauss_points);
	if (status == BATTEN_OK)
		status = choose_algorithm(plan);
	if (status != BATTEN_OK)
		return status;
	p->targets = batten_allocate(plan->context, plan->count, poles * sizeof *p->targets);
	double *room = batten_allocate(plan->context, poles, sizeof *room);
	plan->items = batten_allocate(plan->context, plan->count, sizeof *plan->items);
	if (p->targets && room && plan->items)
		take_items(plan, problems, p->targets, room);
	else
		status = BATTEN_MEMORY;
	batten_release(plan->context, room);
	return status;
}

batten_status net_problems_open(batten_context *context, size_t count,
                                const batten_net_problem *problems,
                                const batten_net_options *options, net_problems *out)
{
	batten_net_options chosen;
	*out = (net_problems){ .plan = { .context = context, .count = count } };
	batten_status status = check_options(context, options, &chosen);
	if (status == BATTEN_OK)
		status = search_options_check(context, &chosen.search, &out->plan.options);
	if (status == BATTEN_OK && chosen.search.interior_penalty)
		status = batten_fail(
			context, BATTEN_USAGE,
			"an interior penalty is of searches over offsets: none is expected over "
			"nets");
	out->plan.fairness = (int)chosen.fairness;
	if (status == BATTEN_OK && count > 0)
		status = take_batch(out, problems, &chosen);
	return status;
}

void net_problems_close(net_problems *p)
{
	batten_context *context = p->plan.context;
	net_tables_release(context, &p->plan.u);
	net_tables_release(context, &p->plan.v);
	batten_release(context, p->plan.items);
	batten_release(context, p->targets);
	batten_release(context, p->leader);
}
