#include "batch/net_certificate.h"

#include "batch/net_pack.h"
#include "batch/net_terms.h"
#include "batch/newton.h"
#include "batch/search_result.h"
#include "core/band.h"

#include <float.h>
#include <math.h>

void net_certifier_release(net_certifier *c)
{
	batten_context *context = c->plan.context;
	batten_release(context, c->samples);
	batten_release(context, c->arrays);
	batten_release(context, c->rooms);
	batten_release(context, c->way);
	batten_release(context, c->gradient);
	batten_release(context, c->step);
	batten_release(context, c->number);
}

batten_status net_certifier_create(const net_plan *plan, net_certifier *c)
{
	batten_context *context = plan->context;
	const size_t poles = net_plan_poles(plan);
	/* What a search gives back has been through y = start + way: a few roundings. */
	const double epsilon = plan->options.precision == BATTEN_F32 ? (double)FLT_EPSILON
	                                                             : DBL_EPSILON;
	*c = (net_certifier){ .plan = *plan, .rounding = 4.0 * epsilon };
	c->plan.options.precision = BATTEN_F64;
	c->samples = batten_allocate(context, net_pack_sample_count(&c->plan), sizeof *c->samples);
	c->arrays = batten_allocate(context, poles, NET_ARRAY_COUNT * sizeof *c->arrays);
	c->rooms = batten_allocate(context, poles, sizeof *c->rooms);
	c->way = batten_allocate(context, poles, sizeof *c->way);
	c->gradient = batten_allocate(context, poles, sizeof *c->gradient);
	c->step = batten_allocate(context, poles, sizeof *c->step);
	c->number = batten_allocate(context, poles, sizeof *c->number);
	const bool all = c->samples && c->arrays && c->rooms && c->way && c->gradient && c->step &&
	                 c->number;
	return all ? BATTEN_OK : BATTEN_MEMORY;
}

/* Makes ready for an item. */
static void begin(net_certifier *c, size_t which)
{
	double settings[NET_SETTING_COUNT];
	c->item = &c->plan.items[which];
	net_pack(&c->plan, which, 0, 1, c->samples, c->arrays, settings, c->rooms);
	c->rounded = sqrt(settings[NET_SETTING_ROUNDING]);
}

static const double *sample_of(const net_certifier *c, size_t line, size_t sample)
{
	return c->samples + (line * c->plan.u.count + sample) * net_plan_sample_size(&c->plan);
}

/* The energy of a sample; false where it has none. off: y less target there. */
static bool term_of(const net_certifier *c, const net_patch *patch, const double *sample,
                    double *off, jet *term)
{
	double way[NET_TERM_VARIABLES_MOST] = { 0.0 };
	*off = 0.0;
	for (size_t n = 0; n < patch->count; n++)
		*off += patch->at[n] * c->way[patch->poles[n]];
	if (!(sample[NET_SAMPLE_FAIR] > 0.0))
		return false;
	for (int d = 0; d < patch->variables; d++)
		for (size_t n = 0; n < patch->count; n++)
			way[d] += patch->weight[d][n] * c->way[patch->poles[n]];
	*term = jet_scale(net_density_of(c->plan.fairness, sample, way, c->rounded),
	                  sample[NET_SAMPLE_FAIR]);
	return true;
}

/* The objective at `way`, and its gradient at every pole by itself. */
static search_objective differentiate(net_certifier *c)
{
	search_objective sum = { 0 };
	for (size_t n = 0; n < net_plan_poles(&c->plan); n++)
		c->gradient[n] = 0.0;
	for (size_t line = 0; line < c->plan.v.count; line++)
		for (size_t i = 0; i < c->plan.u.count; i++) {
			const double *sample = sample_of(c, line, i);
			net_patch patch;
			double off;
			jet term = { 0 };
			net_patch_of(&c->plan, line, i, &patch);
			const bool bends = term_of(c, &patch, sample, &off, &term);
			sum.closeness += sample[NET_SAMPLE_CLOSE] * off * off;
			sum.fairness += term.value;
			for (size_t n = 0; n < patch.count; n++) {
				double slope = 2.0 * sample[NET_SAMPLE_CLOSE] * off * patch.at[n];
				for (int d = 0; bends && d < patch.variables; d++)
					slope += term.first[d] * patch.weight[d][n];
				c->gradient[patch.poles[n]] += slope;
			}
		}
	return sum;
}

/* Numbers the leaders that are free: with room, and not held at its end by the gradient. last: what those
 * held still gain by the slope on their last way to the bound, the rounding of the search. */
static size_t number_unknowns(net_certifier *c, double *last)
{
	const net_plan *plan = &c->plan;
	const size_t poles = net_plan_poles(plan);
	size_t count = 0;
	for (size_t n = 0; n < poles; n++)
		if (plan->leader[n] != n)
			c->gradient[plan->leader[n]] += c->gradient[n];
	for (size_t o = 0; o < poles; o++) {
		const size_t n = net_plan_in_turn(plan, o);
		const double start = net_start_of(c->item, n);
		const double gone = c->item->target_y_m[n] + c->way[n] - start;
		const double near = c->rounding * (fabs(start) + fabs(gone) + fabs(c->item->target_y_m[n]));
		const bool moves = plan->leader[n] == n && c->rooms[n].down < c->rooms[n].up;
		c->number[n] = NEWTON_HELD;
		c->step[n] = 0.0;
		if (moves && !newton_holds(gone - c->rooms[n].down, c->rooms[n].up - gone, near,
		                           c->gradient[n], &c->step[n], last))
			c->number[n] = count++;
	}
	for (size_t n = 0; n < poles; n++) {
		c->number[n] = c->number[plan->leader[n]];
		c->gradient[n] = c->gradient[plan->leader[n]];
	}
	return count;
}

static size_t band_width(const void *of)
{
	const net_certifier *c = (const net_certifier *)of;
	size_t width = 0;
	for (size_t line = 0; line < c->plan.v.count; line += c->plan.v.points)
		for (size_t i = 0; i < c->plan.u.count; i += c->plan.u.points) {
			net_patch patch;
			net_patch_of(&c->plan, line, i, &patch);
			const size_t reach = newton_reach(patch.count, patch.poles, c->number);
			width = reach > width ? reach : width;
		}
	return width;
}

static void assemble(const void *of, size_t width, double *band)
{
	const net_certifier *c = (const net_certifier *)of;
	for (size_t line = 0; line < c->plan.v.count; line++)
		for (size_t i = 0; i < c->plan.u.count; i++) {
			const double *sample = sample_of(c, line, i);
			net_patch patch;
			double off;
			jet term = { 0 };
			net_patch_of(&c->plan, line, i, &patch);
			if (term_of(c, &patch, sample, &off, &term)) {
				const newton_term bends = { patch.count, patch.poles, &patch.weight[0][0],
					                        NET_PATCH_POLES, &term };
				newton_add_term(&bends, c->number, width, band);
			}
			const jet square = jet_scale(jet_square(jet_variable(off, 0, 1)),
			                             sample[NET_SAMPLE_CLOSE]);
			const newton_term close = { patch.count, patch.poles, patch.at, NET_PATCH_POLES,
				                        &square };
			newton_add_term(&close, c->number, width, band);
		}
}

static void stand(net_certifier *c, const double *y_m)
{
	for (size_t n = 0; n < net_plan_poles(&c->plan); n++)
		c->way[n] = y_m[n] - c->item->target_y_m[n];
}

static batten_status judge(void *of, const double *y_m, batten_certificate *out)
{
	net_certifier *c = (net_certifier *)of;
	const size_t poles = net_plan_poles(&c->plan);
	const net_item *item = c->item;
	double last = 0.0;
	stand(c, y_m);
	*out = search_objective_told(differentiate(c), item->w1, item->w2, item->half_beam_m,
	                             c->plan.fairness == NET_FAIRNESS_VARIATION);
	const size_t count = number_unknowns(c, &last);
	const newton_system system = { .context = c->plan.context,
		                           .places = poles,
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

batten_status net_certifier_answer(net_certifier *c, size_t which, const double *y_m, size_t count,
                                   const double *slopes, double *ways, bool *known)
{
	const size_t poles = net_plan_poles(&c->plan);
	double last = 0.0;
	begin(c, which);
	stand(c, y_m);
	(void)differentiate(c);
	const size_t unknowns = number_unknowns(c, &last);
	const size_t width = band_width(c);
	double *band = batten_allocate(c->plan.context, unknowns, (width + 1) * sizeof *band);
	if (!band)
		return BATTEN_MEMORY;
	assemble(c, width, band);
	*known = band_factor(unknowns, width, band) == unknowns;
	const newton_factor factored = { poles, unknowns, width, c->number, band, c->step };
	for (size_t i = 0; i < count && *known; i++)
		newton_answer(&factored, slopes + i * poles, ways + i * poles);
	batten_release(c->plan.context, band);
	return BATTEN_OK;
}

static double go(void *of, const double *from, double part, double *y_m)
{
	net_certifier *c = (net_certifier *)of;
	for (size_t n = 0; n < net_plan_poles(&c->plan); n++) {
		const size_t leader = c->plan.leader[n];
		const double start = net_start_of(c->item, leader);
		const double gone = fmin(
			fmax(from[leader] - part * c->step[leader] - start, c->rooms[leader].down),
			c->rooms[leader].up);
		y_m[n] = from[n];
		if (c->rooms[leader].down < c->rooms[leader].up)
			y_m[n] = fmin(fmax(net_start_of(c->item, n) + gone, c->item->lower_y_m[n]),
			              c->item->upper_y_m[n]);
		c->way[n] = y_m[n] - c->item->target_y_m[n];
	}
	return search_objective_whole(differentiate(c));
}

batten_status net_certifier_run(net_certifier *c, size_t which, const double *y_m,
                                batten_certificate *out)
{
	begin(c, which);
	return judge(c, y_m, out);
}

batten_status net_certifier_polish(net_certifier *c, size_t which, double gap, double *y_m,
                                   batten_certificate *out)
{
	const newton_way way = { .context = c->plan.context,
		                     .count = net_plan_poles(&c->plan),
		                     .judge = judge,
		                     .go = go,
		                     .of = c };
	begin(c, which);
	return newton_polish(&way, gap, y_m, out);
}
