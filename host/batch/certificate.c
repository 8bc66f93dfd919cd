#include "batch/certificate.h"

#include "batch/grid_terms.h"
#include "batch/newton.h"
#include "batch/search_pack.h"
#include "batch/search_result.h"

#include <math.h>
#include <string.h>

/* Part of its box's width within which an interior penalty leaves an offset that its bound holds. */
#define INSIDE 1e-3

batten_status certifier_create(const search_plan *plan, batten_precision precision,
                               bool interior_penalty, certifier *out)
{
	batten_context *context = plan->context;
	/* f32 rounds a bound, and so leaves an offset that far from it. */
	certifier c = { .plan = plan,
		            .rounding = precision == BATTEN_F32 ? 0x1p-22 : 0.0,
		            .inside = interior_penalty ? INSIDE : 0.0 };
	const size_t nodes = plan->node_count;
	c.arrays = batten_allocate(context, nodes, SEARCH_ARRAY_COUNT * sizeof(double));
	c.gradient = batten_allocate(context, nodes, sizeof(double));
	c.step = batten_allocate(context, nodes, sizeof(double));
	c.number = batten_allocate(context, nodes, sizeof(size_t));
	c.order = batten_allocate(context, plan->station_count * plan->waterline_count, sizeof(size_t));
	if (!c.arrays || !c.gradient || !c.step || !c.number || !c.order) {
		certifier_release(&c);
		return BATTEN_MEMORY;
	}
	/* The band is as wide as two lines of the direction that runs first. */
	const size_t nx = plan->station_count;
	const size_t nz = plan->waterline_count;
	size_t at = 0;
	for (size_t a = 0; a < (nx < nz ? nz : nx); a++)
		for (size_t b = 0; b < (nx < nz ? nx : nz); b++)
			c.order[at++] = nx < nz ? (a + 1) * (nx + 2) + (b + 1) : (b + 1) * (nx + 2) + (a + 1);
	*out = c;
	return BATTEN_OK;
}

void certifier_release(certifier *c)
{
	if (!c->plan)
		return;
	batten_context *context = c->plan->context;
	batten_release(context, c->arrays);
	batten_release(context, c->gradient);
	batten_release(context, c->step);
	batten_release(context, c->number);
	batten_release(context, c->order);
	*c = (certifier){ 0 };
}

static double *array_of(const certifier *c, int array)
{
	return c->arrays + (size_t)array * c->plan->node_count;
}

/* The term of a node, its stencil and the places it stands on; false where the energy has none. */
static bool term_of(const certifier *c, size_t node, grid_stencil *stencil,
                    size_t places[GRID_STENCIL_MOST], jet *term)
{
	const double bend = array_of(c, SEARCH_ARRAY_BEND)[node];
	if (!(bend > 0.0))
		return false;
	const size_t stride = c->plan->station_count + 2;
	const double *y = array_of(c, SEARCH_ARRAY_Y);
	double values[GRID_STENCIL_MOST];
	*stencil = grid_stencil_of(c->plan, node % stride - 1, node / stride - 1);
	grid_stencil_places(grid_stencil_count(c->plan), node, c->plan->station_count + 2, places);
	for (size_t n = 0; n < stencil->count; n++)
		values[n] = y[places[n]];
	*term = jet_scale(grid_density(c->plan, c->problem->half_beam_m, stencil, values), bend);
	return true;
}

/* The objective, and its gradient at every node. */
static search_objective differentiate(certifier *c)
{
	const size_t nodes = c->plan->node_count;
	const double *y = array_of(c, SEARCH_ARRAY_Y);
	const double *target = array_of(c, SEARCH_ARRAY_TARGET);
	const double *close = array_of(c, SEARCH_ARRAY_CLOSE);
	search_objective sum = { 0 };
	for (size_t n = 0; n < nodes; n++) {
		const double off = y[n] - target[n];
		c->gradient[n] = 2.0 * close[n] * off;
		sum.closeness += close[n] * off * off;
	}
	for (size_t node = 0; node < nodes; node++) {
		grid_stencil stencil;
		size_t places[GRID_STENCIL_MOST];
		jet term;
		if (!term_of(c, node, &stencil, places, &term))
			continue;
		sum.fairness += term.value;
		for (size_t n = 0; n < stencil.count; n++)
			for (int v = 0; v < stencil.variables; v++)
				c->gradient[places[n]] += term.first[v] * stencil.weight[v][n];
	}
	return sum;
}

/* Numbers the nodes that are free: not fixed, and not held at a bound by the gradient. last: what those
 * held still gain by the slope on their last way to the bound, the rounding of f32 or what an interior
 * penalty leaves. */
static size_t number_unknowns(certifier *c, double *last)
{
	const double *y = array_of(c, SEARCH_ARRAY_Y);
	const double *lower = array_of(c, SEARCH_ARRAY_LOWER);
	const double *upper = array_of(c, SEARCH_ARRAY_UPPER);
	size_t count = 0;
	for (size_t n = 0; n < c->plan->node_count; n++) {
		c->number[n] = NEWTON_HELD;
		c->step[n] = 0.0;
	}
	for (size_t o = 0; o < c->plan->station_count * c->plan->waterline_count; o++) {
		const size_t n = c->order[o];
		const double near = c->rounding * fabs(y[n]) + c->inside * (upper[n] - lower[n]);
		if (lower[n] < upper[n] && !newton_holds(y[n] - lower[n], upper[n] - y[n], near,
		                                         c->gradient[n], &c->step[n], last))
			c->number[n] = count++;
	}
	return count;
}

static size_t band_width(const void *of)
{
	const certifier *c = (const certifier *)of;
	const size_t count = grid_stencil_count(c->plan);
	size_t width = 0;
	for (size_t node = 0; node < c->plan->node_count; node++) {
		size_t places[GRID_STENCIL_MOST];
		if (!(array_of(c, SEARCH_ARRAY_BEND)[node] > 0.0))
			continue;
		grid_stencil_places(count, node, c->plan->station_count + 2, places);
		const size_t reach = newton_reach(count, places, c->number);
		width = reach > width ? reach : width;
	}
	return width;
}

static void assemble(const void *of, size_t width, double *band)
{
	const certifier *c = (const certifier *)of;
	const double *close = array_of(c, SEARCH_ARRAY_CLOSE);
	for (size_t node = 0; node < c->plan->node_count; node++) {
		grid_stencil stencil;
		size_t places[GRID_STENCIL_MOST];
		jet term;
		if (c->number[node] != NEWTON_HELD)
			band[c->number[node] * (width + 1) + width] += 2.0 * close[node];
		if (!term_of(c, node, &stencil, places, &term))
			continue;
		const newton_term added = { stencil.count, places, &stencil.weight[0][0], GRID_STENCIL_MOST,
			                        &term };
		newton_add_term(&added, c->number, width, band);
	}
}

static void pack_end(certifier *c, const double *y_m)
{
	batten_search_problem ended = *c->problem;
	double settings[SEARCH_SETTING_COUNT];
	ended.start_m = y_m;
	memset(c->arrays, 0, c->plan->node_count * SEARCH_ARRAY_COUNT * sizeof *c->arrays);
	search_pack(c->plan, &ended, 0, 0, 1, c->arrays, settings);
}

double certifier_objective(certifier *c, const batten_search_problem *problem, const double *y_m)
{
	c->problem = problem;
	pack_end(c, y_m);
	return search_objective_whole(differentiate(c));
}

static batten_status judge(void *of, const double *y_m, batten_certificate *out)
{
	certifier *c = (certifier *)of;
	const batten_search_problem *problem = c->problem;
	pack_end(c, y_m);
	*out = search_objective_told(differentiate(c), problem->w1, problem->w2, problem->half_beam_m,
	                             c->plan->fairness == GRID_VARIATION);
	double last = 0.0;
	const size_t count = number_unknowns(c, &last);
	const newton_system system = { .context = c->plan->context,
		                           .places = c->plan->node_count,
		                           .number = c->number,
		                           .gradient = c->gradient,
		                           .step = c->step,
		                           .count = count,
		                           .last = last,
		                           .width = band_width,
		                           .assemble = assemble,
		                           .of = c };
	return newton_judge(&system, out);
}

batten_status certifier_run(certifier *c, const batten_search_problem *problem, const double *y_m,
                            batten_certificate *out)
{
	c->problem = problem;
	return judge(c, y_m, out);
}

static double go(void *of, const double *from, double part, double *y_m)
{
	certifier *c = (certifier *)of;
	const search_plan *plan = c->plan;
	double *now = array_of(c, SEARCH_ARRAY_Y);
	const double *lower = array_of(c, SEARCH_ARRAY_LOWER);
	const double *upper = array_of(c, SEARCH_ARRAY_UPPER);
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++) {
			const size_t node = k * plan->station_count + i;
			const size_t n = (k + 1) * (plan->station_count + 2) + (i + 1);
			if (lower[n] < upper[n])
				now[n] = fmin(fmax(from[node] - part * c->step[n], lower[n]), upper[n]);
			if (!c->problem->nodes || c->problem->nodes[node] != BATTEN_NODE_OUTSIDE)
				y_m[node] = now[n];
		}
	return search_objective_whole(differentiate(c));
}

batten_status certifier_polish(certifier *c, const batten_search_problem *problem, double gap,
                               double *y_m, batten_certificate *out)
{
	const newton_way way = { .context = c->plan->context,
		                     .count = c->plan->station_count * c->plan->waterline_count,
		                     .judge = judge,
		                     .go = go,
		                     .of = c };
	c->problem = problem;
	return newton_polish(&way, gap, y_m, out);
}
