/* The points of a front over the poles of a surface fitted to the offsets, with their surfaces. */
#include "fairing/front.h"
#include "fairing/net_fairing.h"

typedef struct sweep {
	const front *f;
	net_fairing of;
	size_t poles;
	batten_net_problem *problems;
	double *y_m;
} sweep;

static batten_status prepare(sweep *s)
{
	const front *f = s->f;
	batten_context *context = f->fairing->context;
	const batten_status status = net_fairing_open(f->fairing, f->options, &s->of);
	if (status != BATTEN_OK)
		return status;
	s->poles = f->fairing->fitted_surface->count_u * f->fairing->fitted_surface->count_v;
	s->problems = batten_allocate(context, f->count, sizeof *s->problems);
	s->y_m = batten_allocate(context, f->count, s->poles * sizeof *s->y_m);
	if (!s->problems || !s->y_m)
		return BATTEN_MEMORY;
	for (size_t p = 0; p < f->count; p++)
		s->problems[p] = net_fairing_problem(&s->of, 1.0, f->points[p].ratio);
	return BATTEN_OK;
}

static void release(sweep *s)
{
	batten_context *context = s->f->fairing->context;
	net_fairing_close(&s->of);
	batten_release(context, s->problems);
	batten_release(context, s->y_m);
}

/* One after the other. */
static batten_status conclude(sweep *s)
{
	batten_status status = BATTEN_OK;
	for (size_t p = 0; p < s->f->count && status == BATTEN_OK; p++) {
		status = net_fairing_conclude(&s->of, &s->problems[p], s->y_m + p * s->poles,
		                              &s->f->results[p]);
		front_take_concluded(s->f, p);
	}
	return status;
}

static batten_status take_surfaces(sweep *s)
{
	const front *f = s->f;
	const double half_beam_m = batten_hull_half_beam_m(f->fairing->smoothed);
	batten_status status = BATTEN_OK;
	for (size_t p = 0; p < f->count && status == BATTEN_OK; p++) {
		net_fairing_put(&s->of, s->y_m + p * s->poles);
		const net_change change = net_fairing_change(&s->of);
		f->points[p].closeness = (batten_closeness){
			.cn_pct = 100.0 * change.max_m / half_beam_m,
			.cn_max_m = change.max_m,
			.cn_rms_m = change.rms_m,
			.closeness_m4 = f->certificates[p].closeness_m4
		};
		status = batten_surface_clone(f->fairing->context, f->fairing->faired_surface,
		                              &f->points[p].surface);
	}
	return status;
}

static batten_status search(sweep *s)
{
	const front *f = s->f;
	batten_status status = net_fairing_search(&s->of, f->count, s->problems, s->y_m, f->results);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		return status;
	status = front_concludes(f)
	             ? conclude(s)
	             : batten_net_certify_batch(f->fairing->context, f->count, s->problems, &s->of.how,
	                                        s->y_m, f->certificates);
	return status == BATTEN_OK ? take_surfaces(s) : status;
}

batten_status front_net(const front *f)
{
	sweep s = { .f = f };
	batten_status status = prepare(&s);
	if (status == BATTEN_OK)
		status = search(&s);
	release(&s);
	return status;
}
