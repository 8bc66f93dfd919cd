/* The points of a front over the offsets of the table. */
#include "fairing/box.h"
#include "fairing/front.h"
#include "fairing/offset_space.h"

typedef struct sweep {
	const front *f;
	fairing_box box;
	batten_search_options how;
	batten_search_problem *problems;
	double *y_m;
} sweep;

static batten_status prepare(sweep *s)
{
	const front *f = s->f;
	const batten_hull *hull = f->fairing->smoothed;
	batten_context *context = f->fairing->context;
	const batten_status status = fairing_box_create(context, hull, f->options, f->fairing->locked,
	                                                f->fairing->facts.max_distance_m, &s->box);
	if (status != BATTEN_OK)
		return status;
	s->how = f->options->search;
	s->how.fairness = f->options->fairness;
	s->problems = batten_allocate(context, f->count, sizeof *s->problems);
	s->y_m = batten_allocate(context, f->count, hull_node_count(hull) * sizeof *s->y_m);
	if (!s->problems || !s->y_m)
		return BATTEN_MEMORY;
	for (size_t p = 0; p < f->count; p++)
		s->problems[p] = fairing_problem(hull, &s->box, 1.0, f->points[p].ratio);
	return BATTEN_OK;
}

static void release(sweep *s)
{
	batten_context *context = s->f->fairing->context;
	fairing_box_release(context, &s->box);
	batten_release(context, s->problems);
	batten_release(context, s->y_m);
}

/* One after the other. */
static batten_status conclude(sweep *s)
{
	const front *f = s->f;
	const size_t nodes = hull_node_count(f->fairing->smoothed);
	batten_status status = BATTEN_OK;
	for (size_t p = 0; p < f->count && status == BATTEN_OK; p++) {
		offset_space one = { f->fairing, &s->box, &s->how, s->problems[p], NULL };
		status = offset_space_conclude(&one, f->options, s->y_m + p * nodes, &f->results[p]);
		front_take_concluded(f, p);
	}
	return status;
}

static batten_status measure_closeness(const sweep *s)
{
	batten_fairing *fairing = s->f->fairing;
	batten_hull *faired = fairing->faired;
	const size_t nodes = hull_node_count(faired);
	batten_status status = BATTEN_OK;
	for (size_t p = 0; p < s->f->count && status == BATTEN_OK; p++) {
		for (size_t n = 0; n < nodes; n++)
			if (faired->nodes[n] != BATTEN_NODE_OUTSIDE)
				faired->y_m[n] = s->y_m[p * nodes + n];
		status = batten_hull_closeness(fairing->context, faired, fairing->smoothed,
		                               &s->f->points[p].closeness);
	}
	return status;
}

static batten_status search(sweep *s)
{
	const front *f = s->f;
	const batten_hull *hull = f->fairing->smoothed;
	const batten_grid grid = { hull->station_count, hull->waterline_count, hull->x_m, hull->z_m };
	batten_status status = offset_space_search(f->fairing, f->count, s->problems, &s->how, s->y_m,
	                                           f->results);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		return status;
	status = front_concludes(f)
	             ? conclude(s)
	             : batten_search_certify_batch(f->fairing->context, &grid, f->count, s->problems,
	                                           &s->how, s->y_m, f->certificates);
	return status == BATTEN_OK ? measure_closeness(s) : status;
}

batten_status front_offsets(const front *f)
{
	sweep s = { .f = f };
	batten_status status = prepare(&s);
	if (status == BATTEN_OK)
		status = search(&s);
	release(&s);
	return status;
}
