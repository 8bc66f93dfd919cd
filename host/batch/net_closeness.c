#include "batch/net_closeness.h"

#include "batch/net_pack.h"
#include "batch/net_terms.h"
#include "batch/newton.h"
#include "core/band.h"

#include <math.h>

/* A pole whose closeness is this part of the largest has none: it moves along the surface. */
#define LEAST_PART 1e-12

typedef struct parabola {
	net_plan plan; /* in f64, of plain bending: samples as short as they come */
	double *samples, *arrays;
	net_room *rooms;
	size_t *number;   /* of the unknown that a pole moves with, or none */
	double *diagonal; /* room for the right side, then */
	double *band;
	size_t count, width;
} parabola;

static void release(parabola *p)
{
	batten_context *context = p->plan.context;
	batten_release(context, p->samples);
	batten_release(context, p->arrays);
	batten_release(context, p->rooms);
	batten_release(context, p->number);
	batten_release(context, p->diagonal);
	batten_release(context, p->band);
}

/* Calls add() with every sample's poles and the second derivative of its closeness. */
typedef void add_sample(parabola *p, const net_patch *patch, double second);
static void each_sample(parabola *p, add_sample *add)
{
	for (size_t line = 0; line < p->plan.v.count; line++)
		for (size_t i = 0; i < p->plan.u.count; i++) {
			const double *sample = p->samples + (line * p->plan.u.count + i) * NET_SAMPLE_SIZE;
			net_patch patch;
			net_patch_of(&p->plan, line, i, &patch);
			add(p, &patch, 2.0 * sample[NET_SAMPLE_CLOSE]);
		}
}

static void add_diagonal(parabola *p, const net_patch *patch, double second)
{
	for (size_t n = 0; n < patch->count; n++)
		p->diagonal[p->plan.leader[patch->poles[n]]] += second * patch->at[n] * patch->at[n];
}

static void find_width(parabola *p, const net_patch *patch, double second)
{
	(void)second;
	const size_t reach = newton_reach(patch->count, patch->poles, p->number);
	p->width = reach > p->width ? reach : p->width;
}

static void add_second(parabola *p, const net_patch *patch, double second)
{
	jet square = jet_scale(jet_square(jet_variable(0.0, 0, 1)), 0.5 * second);
	const newton_term term = { patch->count, patch->poles, patch->at, NET_PATCH_POLES, &square };
	newton_add_term(&term, p->number, p->width, p->band);
}

/* Leaders that have room and feel closeness. */
static void number_unknowns(parabola *p)
{
	const size_t poles = net_plan_poles(&p->plan);
	double largest = 0.0;
	for (size_t n = 0; n < poles; n++)
		largest = fmax(largest, p->diagonal[n]);
	for (size_t o = 0; o < poles; o++) {
		const size_t n = net_plan_in_turn(&p->plan, o);
		const bool moves = p->rooms[n].down < p->rooms[n].up &&
		                   p->diagonal[n] > LEAST_PART * largest;
		p->number[n] = p->plan.leader[n] == n && moves ? p->count++ : NEWTON_HELD;
	}
	for (size_t n = 0; n < poles; n++)
		p->number[n] = p->number[p->plan.leader[n]];
}

static batten_status factor(parabola *p)
{
	batten_context *context = p->plan.context;
	each_sample(p, add_diagonal);
	number_unknowns(p);
	each_sample(p, find_width);
	p->band = batten_allocate(context, p->count, (p->width + 1) * sizeof *p->band);
	if (!p->band)
		return BATTEN_MEMORY;
	each_sample(p, add_second);
	if (band_factor(p->count, p->width, p->band) < p->count)
		return batten_fail(context, BATTEN_INPUT,
		                   "closeness does not hold every pole: seen along y, poles lie upon each "
		                   "other");
	return BATTEN_OK;
}

batten_status net_closeness_invert(const net_plan *plan, size_t which, size_t count,
                                   const double *slopes, double *ways)
{
	batten_context *context = plan->context;
	const size_t poles = net_plan_poles(plan);
	double settings[NET_SETTING_COUNT];
	parabola p = { .plan = *plan };
	p.plan.options.precision = BATTEN_F64;
	p.plan.fairness = NET_FAIRNESS_BENDING;
	p.samples = batten_allocate(context, net_pack_sample_count(&p.plan), sizeof *p.samples);
	p.arrays = batten_allocate(context, poles, NET_ARRAY_COUNT * sizeof *p.arrays);
	p.rooms = batten_allocate(context, poles, sizeof *p.rooms);
	p.number = batten_allocate(context, poles, sizeof *p.number);
	p.diagonal = batten_allocate(context, poles, sizeof *p.diagonal);
	batten_status status = BATTEN_MEMORY;
	if (p.samples && p.arrays && p.rooms && p.number && p.diagonal) {
		net_pack(&p.plan, which, 0, 1, p.samples, p.arrays, settings, p.rooms);
		status = factor(&p);
	}
	const newton_factor factored = { poles, p.count, p.width, p.number, p.band, p.diagonal };
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		newton_answer(&factored, slopes + i * poles, ways + i * poles);
	release(&p);
	return status;
}
