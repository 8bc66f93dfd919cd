#include "batch/certificate.h"

#include "batch/grid_terms.h"
#include "batch/search_pack.h"
#include "core/band.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Numbers of the largest band that is factored: half a gigabyte. */
#define BAND_LIMIT ((size_t)1 << 26)
static const size_t none = SIZE_MAX;

batten_status certifier_create(const search_plan *plan, batten_precision precision, certifier *out)
{
	batten_context *context = plan->context;
	/* f32 rounds a bound, and so leaves an offset that far from it. */
	certifier c = { .plan = plan, .rounding = precision == BATTEN_F32 ? 0x1p-22 : 0.0 };
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

/* Places of a stencil's nodes. */
static void stencil_places(const certifier *c, size_t node, size_t places[GRID_STENCIL_NODES])
{
	const size_t stride = c->plan->station_count + 2;
	for (size_t n = 0; n < GRID_STENCIL_NODES; n++)
		places[n] = node + n / 3 * stride + n % 3 - stride - 1;
}

/* The term of a node, its stencil and the places it stands on; false where the energy has none. */
static bool term_of(const certifier *c, size_t node, double half_beam_m, grid_stencil *stencil,
                    size_t places[GRID_STENCIL_NODES], jet *term)
{
	const double bend = array_of(c, SEARCH_ARRAY_BEND)[node];
	if (!(bend > 0.0))
		return false;
	const size_t stride = c->plan->station_count + 2;
	const double *y = array_of(c, SEARCH_ARRAY_Y);
	double values[GRID_STENCIL_NODES];
	stencil_places(c, node, places);
	for (size_t n = 0; n < GRID_STENCIL_NODES; n++)
		values[n] = y[places[n]];
	*stencil = grid_stencil_of(c->plan, node % stride - 1, node / stride - 1);
	*term = jet_scale(grid_density(c->plan, half_beam_m, stencil, values), bend);
	return true;
}

/* The objective, its part of fairness, and its gradient at every node. */
static double differentiate(certifier *c, double half_beam_m, double *fairness)
{
	const size_t nodes = c->plan->node_count;
	const double *y = array_of(c, SEARCH_ARRAY_Y);
	const double *target = array_of(c, SEARCH_ARRAY_TARGET);
	const double *close = array_of(c, SEARCH_ARRAY_CLOSE);
	double sum = 0.0;
	for (size_t n = 0; n < nodes; n++) {
		const double off = y[n] - target[n];
		c->gradient[n] = 2.0 * close[n] * off;
		sum += close[n] * off * off;
	}
	for (size_t node = 0; node < nodes; node++) {
		grid_stencil stencil;
		size_t places[GRID_STENCIL_NODES];
		jet term;
		if (!term_of(c, node, half_beam_m, &stencil, places, &term))
			continue;
		*fairness += term.value;
		for (size_t n = 0; n < GRID_STENCIL_NODES; n++)
			for (int v = 0; v < JET_VARIABLES; v++)
				c->gradient[places[n]] += term.first[v] * stencil.weight[v][n];
	}
	return sum + *fairness;
}

/* Numbers the nodes that are free: not fixed, and not held at a bound by the gradient. last: what those
 * held still gain by the slope on their last way to the bound, the rounding of f32. */
static size_t number_unknowns(certifier *c, double *last)
{
	const double *y = array_of(c, SEARCH_ARRAY_Y);
	const double *lower = array_of(c, SEARCH_ARRAY_LOWER);
	const double *upper = array_of(c, SEARCH_ARRAY_UPPER);
	size_t count = 0;
	for (size_t n = 0; n < c->plan->node_count; n++) {
		c->number[n] = none;
		c->step[n] = 0.0;
	}
	for (size_t o = 0; o < c->plan->station_count * c->plan->waterline_count; o++) {
		const size_t n = c->order[o];
		const double near = c->rounding * fabs(y[n]);
		const bool down = y[n] <= lower[n] + near && c->gradient[n] >= 0.0;
		const bool up = y[n] >= upper[n] - near && c->gradient[n] <= 0.0;
		if (!(lower[n] < upper[n]))
			continue;
		if (down || up) {
			c->step[n] = y[n] - (down ? lower[n] : upper[n]);
			*last += c->gradient[n] * c->step[n];
		} else {
			c->number[n] = count++;
		}
	}
	return count;
}

/* The furthest that two unknowns of one term lie apart. */
static size_t band_width(const certifier *c)
{
	size_t width = 0;
	for (size_t node = 0; node < c->plan->node_count; node++) {
		size_t places[GRID_STENCIL_NODES];
		size_t least = none;
		size_t most = 0;
		if (!(array_of(c, SEARCH_ARRAY_BEND)[node] > 0.0))
			continue;
		stencil_places(c, node, places);
		for (size_t n = 0; n < GRID_STENCIL_NODES; n++) {
			const size_t number = c->number[places[n]];
			if (number == none)
				continue;
			least = number < least ? number : least;
			most = number > most ? number : most;
		}
		if (least != none && most - least > width)
			width = most - least;
	}
	return width;
}

/* C^T S C of a term into the band: what each pair of its nodes has of the Hessian. */
static void add_term(const certifier *c, size_t width, const grid_stencil *stencil,
                     const size_t places[GRID_STENCIL_NODES], const jet *term, double *band)
{
	for (size_t n = 0; n < GRID_STENCIL_NODES; n++) {
		const size_t row = c->number[places[n]];
		double by[JET_VARIABLES] = { 0.0 };
		if (row == none)
			continue;
		for (int i = 0, at = 0; i < JET_VARIABLES; i++)
			for (int j = 0; j <= i; j++, at++) {
				by[j] += stencil->weight[i][n] * term->second[at];
				if (i != j)
					by[i] += stencil->weight[j][n] * term->second[at];
			}
		for (size_t m = 0; m < GRID_STENCIL_NODES; m++) {
			const size_t column = c->number[places[m]];
			if (column == none || column > row)
				continue;
			double sum = 0.0;
			for (int v = 0; v < JET_VARIABLES; v++)
				sum += by[v] * stencil->weight[v][m];
			band[row * (width + 1) + width - (row - column)] += sum;
		}
	}
}

static void assemble(const certifier *c, double half_beam_m, size_t width, double *band)
{
	const double *close = array_of(c, SEARCH_ARRAY_CLOSE);
	for (size_t node = 0; node < c->plan->node_count; node++) {
		grid_stencil stencil;
		size_t places[GRID_STENCIL_NODES];
		jet term;
		if (c->number[node] != none)
			band[c->number[node] * (width + 1) + width] += 2.0 * close[node];
		if (term_of(c, node, half_beam_m, &stencil, places, &term))
			add_term(c, width, &stencil, places, &term, band);
	}
}

/* 1/2 g^T H^-1 g over the unknowns; NaN where H is not positive definite. */
static double decrement(certifier *c, size_t count, size_t width, double *band, double *step)
{
	for (size_t n = 0; n < c->plan->node_count; n++)
		if (c->number[n] != none)
			step[c->number[n]] = c->gradient[n];
	if (band_factor(count, width, band) < count)
		return NAN;
	band_solve(count, width, band, step);
	double sum = 0.0;
	for (size_t n = 0; n < c->plan->node_count; n++)
		if (c->number[n] != none) {
			c->step[n] = step[c->number[n]];
			sum += c->gradient[n] * c->step[n];
		}
	return 0.5 * sum;
}

static void say(batten_certificate *out, const char *message)
{
	(void)snprintf(out->message, sizeof out->message, "%s", message);
}

static batten_status estimate(certifier *c, double half_beam_m, double last,
                              batten_certificate *out)
{
	batten_context *context = c->plan->context;
	const size_t count = out->free_count;
	const size_t width = band_width(c);
	/* An objective of 0 cannot fall. */
	const double scale = out->objective > 0.0 ? 1.0 / out->objective : 0.0;
	if (count == 0) {
		out->gap_estimate = last * scale;
		return BATTEN_OK;
	}
	if (width + 1 > BAND_LIMIT / count) {
		say(out, "the grid is too large for the factor of its Hessian");
		return BATTEN_OK;
	}
	double *band = batten_allocate(context, count, (width + 1) * sizeof *band);
	double *step = batten_allocate(context, count, sizeof *step);
	const batten_status status = band && step ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		assemble(c, half_beam_m, width, band);
		const double gain = decrement(c, count, width, band, step);
		out->gap_estimate = (gain + last) * scale;
		if (isnan(out->gap_estimate))
			say(out, "the Hessian is not positive definite over the free offsets");
	}
	batten_release(context, band);
	batten_release(context, step);
	return status;
}

batten_status certifier_run(certifier *c, const batten_search_problem *problem, const double *y_m,
                            batten_certificate *out)
{
	const search_plan *plan = c->plan;
	const batten_search_problem ended = { .nodes = problem->nodes,
		                                  .start_m = y_m,
		                                  .target_m = problem->target_m,
		                                  .lower_m = problem->lower_m,
		                                  .upper_m = problem->upper_m,
		                                  .closeness_weight = problem->closeness_weight,
		                                  .w1 = problem->w1,
		                                  .w2 = problem->w2,
		                                  .half_beam_m = problem->half_beam_m };
	double settings[SEARCH_SETTING_COUNT];
	*out = (batten_certificate){ .gap_estimate = NAN };
	memset(c->arrays, 0, plan->node_count * SEARCH_ARRAY_COUNT * sizeof *c->arrays);
	search_pack(plan, &ended, 0, 1, c->arrays, settings);
	out->objective = differentiate(c, problem->half_beam_m, &out->fairness);
	out->fairness = problem->w1 > 0.0 ? out->fairness / problem->w1 : NAN;
	double last = 0.0;
	out->free_count = number_unknowns(c, &last);
	double square = 0.0;
	for (size_t n = 0; n < plan->node_count; n++)
		if (c->number[n] != none)
			square += c->gradient[n] * c->gradient[n];
	out->gradient_per_m = sqrt(square);
	if (!isfinite(out->objective) || !isfinite(square)) {
		say(out, "the objective is not finite");
		return BATTEN_OK;
	}
	return estimate(c, problem->half_beam_m, last, out);
}

/* The objective at y less `part` of the step, kept in the box; that is written to y_m. */
static double objective_on_the_way(certifier *c, const batten_search_problem *problem,
                                   const double *y, double part, double *y_m)
{
	const search_plan *plan = c->plan;
	double *now = array_of(c, SEARCH_ARRAY_Y);
	const double *lower = array_of(c, SEARCH_ARRAY_LOWER);
	const double *upper = array_of(c, SEARCH_ARRAY_UPPER);
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++) {
			const size_t node = k * plan->station_count + i;
			const size_t n = (k + 1) * (plan->station_count + 2) + (i + 1);
			if (lower[n] < upper[n])
				now[n] = fmin(fmax(y[node] - part * c->step[n], lower[n]), upper[n]);
			if (!problem->nodes || problem->nodes[node] != BATTEN_NODE_OUTSIDE)
				y_m[node] = now[n];
		}
	double fairness = 0.0;
	return differentiate(c, problem->half_beam_m, &fairness);
}

batten_status certifier_polish(certifier *c, const batten_search_problem *problem, double gap,
                               double *y_m, batten_certificate *out)
{
	enum { STEPS = 100, HALVINGS = 30 };
	const size_t nodes = c->plan->station_count * c->plan->waterline_count;
	double *before = batten_allocate(c->plan->context, nodes, sizeof *before);
	batten_status status = before ? certifier_run(c, problem, y_m, out) : BATTEN_MEMORY;
	for (unsigned step = 1; step <= STEPS && status == BATTEN_OK && out->gap_estimate > gap;
	     step++) {
		double part = 1.0;
		int halvings = 0;
		memcpy(before, y_m, nodes * sizeof *before);
		while (halvings < HALVINGS &&
		       !(objective_on_the_way(c, problem, before, part, y_m) < out->objective)) {
			part *= 0.5;
			halvings++;
		}
		if (halvings == HALVINGS) {
			memcpy(y_m, before, nodes * sizeof *before);
			break;
		}
		status = certifier_run(c, problem, y_m, out);
		out->steps = step;
	}
	batten_release(c->plan->context, before);
	return status;
}
