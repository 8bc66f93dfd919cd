#include "oracle_net.h"
#include "oracle_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PARTS = 5 /* y_u y_v y_uu y_uv y_vv */, ORDER_MOST = ORACLE_ORDER_MOST };

/* One direction at all its Gauss nodes. */
typedef struct net_side {
	size_t count, order;
	size_t *first;       /* the first pole a node sees */
	long double *basis;  /* [node][derivative 0..2][order] */
	long double *weight; /* of the integral */
} net_side;

/* One node of the integral. */
typedef struct net_node {
	size_t pole[ORDER_MOST * ORDER_MOST];
	long double value[ORDER_MOST * ORDER_MOST];
	long double part[PARTS][ORDER_MOST * ORDER_MOST]; /* derivative by the pole's y */
	size_t count;
	oracle_jet jet; /* of x and z; y is filled in */
	long double fair, close;
} net_node;

typedef struct net_space {
	const oracle_net_problem *problem;
	net_side u, v;
	size_t poles;
} net_space;

static void side_release(net_side *side)
{
	free(side->first);
	free(side->basis);
	free(side->weight);
}

/* Values and derivatives of the basis: curves whose poles are 0 but one. */
static bool side_basis(size_t order, size_t count, const double *knots, size_t node, long double t,
                       net_side *side)
{
	double *poles = calloc(count + 1, sizeof *poles);
	const oracle_curve curve = { order, count, 1, knots, poles, NULL };
	bool ok = poles != NULL;
	for (size_t i = 0; ok && i < order; i++) {
		long double d[ORACLE_ORDERS][3];
		poles[side->first[node] + i] = 1;
		ok = oracle_curve_at(&curve, t, d);
		poles[side->first[node] + i] = 0;
		for (size_t n = 0; ok && n < 3; n++)
			side->basis[(node * 3 + n) * order + i] = d[n][0];
	}
	free(poles);
	return ok;
}

static bool side_create(size_t order, size_t count, const double *knots, size_t nodes,
                        net_side *side)
{
	long double at[64];
	long double weight[64];
	size_t spans = 0;
	for (size_t s = order - 1; s < count; s++)
		spans += knots[s] < knots[s + 1];
	side->order = order;
	side->count = spans * nodes;
	if (side->count == 0)
		return false;
	side->first = calloc(side->count, sizeof *side->first);
	side->basis = oracle_reals(side->count * 3 * order);
	side->weight = oracle_reals(side->count);
	bool ok = side->first && side->basis && side->weight && nodes <= 64;
	size_t n = 0;
	if (ok)
		oracle_gauss(nodes, at, weight);
	for (size_t s = order - 1; ok && s < count; s++) {
		if (!(knots[s] < knots[s + 1]))
			continue;
		const long double half = ((long double)knots[s + 1] - knots[s]) / 2;
		for (size_t g = 0; ok && g < nodes; g++, n++) {
			side->first[n] = s + 1 - order;
			side->weight[n] = half * weight[g];
			ok = side_basis(order, count, knots, n, knots[s] + half * (1 + at[g]), side);
		}
	}
	return ok;
}

static bool space_open(const oracle_net_problem *problem, net_space *space)
{
	const oracle_surface *s = problem->surface;
	*space = (net_space){ .problem = problem, .poles = s->count_u * s->count_v };
	return side_create(s->order_u, s->count_u, s->knots_u, problem->nodes, &space->u) &&
	       side_create(s->order_v, s->count_v, s->knots_v, problem->nodes, &space->v);
}

static void space_close(net_space *space)
{
	side_release(&space->u);
	side_release(&space->v);
}

static const size_t part_orders[PARTS][2] = { { 1, 0 }, { 0, 1 }, { 2, 0 }, { 1, 1 }, { 0, 2 } };

/* Node (i, k): what each pole has to do with it, x and z, and whether the start has a normal. */
static void node_at(const net_space *space, size_t i, size_t k, net_node *node)
{
	const oracle_surface *s = space->problem->surface;
	const size_t order = space->u.order;
	const long double *bu = space->u.basis + i * 3 * order;
	const long double *bv = space->v.basis + k * 3 * space->v.order;
	memset(node, 0, sizeof *node);
	for (size_t b = 0; b < space->v.order; b++)
		for (size_t a = 0; a < order; a++) {
			const size_t pole = (space->v.first[k] + b) * s->count_u + space->u.first[i] + a;
			const size_t n = node->count++;
			node->pole[n] = pole;
			node->value[n] = bu[a] * bv[b];
			for (size_t p = 0; p < PARTS; p++) {
				const size_t *d = part_orders[p];
				node->part[p][n] = bu[d[0] * order + a] * bv[d[1] * space->v.order + b];
				for (size_t c = 0; c < 3; c++)
					node->jet[d[0]][d[1]][c] += node->part[p][n] * s->poles[3 * pole + c];
			}
		}
	oracle_forms forms;
	oracle_surface_forms(node->jet, &forms);
	const long double weight = space->u.weight[i] * space->v.weight[k];
	const long double h = space->problem->h;
	const long double flat = node->jet[1][0][0] * node->jet[0][1][2] -
	                         node->jet[0][1][0] * node->jet[1][0][2];
	node->fair = forms.regular ? space->problem->w1 * weight : 0;
	node->close = space->problem->w2 * weight * fabsl(flat) / (h * h * h * h);
}

static long double density(const net_space *space, const net_node *node, const long double *part)
{
	oracle_jet jet;
	oracle_forms forms;
	memcpy(jet, node->jet, sizeof jet);
	for (size_t p = 0; p < PARTS; p++)
		jet[part_orders[p][0]][part_orders[p][1]][1] = part[p];
	oracle_surface_forms(jet, &forms);
	const long double a = forms.k[0];
	const long double b = forms.k[1];
	const long double e = space->problem->rounding;
	switch (space->problem->fairness) {
	case ORACLE_FAIRNESS_MEAN:
		return (a + b) * (a + b) / 4 * forms.area;
	case ORACLE_FAIRNESS_GAUSS:
		return sqrtl(a * b * a * b + e * e) * forms.area;
	default:
		return (a * a + b * b) * forms.area;
	}
}

static void parts_of(const net_space *space, const net_node *node, const long double *y,
                     long double part[PARTS], long double *off)
{
	*off = 0;
	for (size_t p = 0; p < PARTS; p++)
		part[p] = 0;
	for (size_t n = 0; n < node->count; n++) {
		const size_t pole = node->pole[n];
		*off += node->value[n] * (y[pole] - space->problem->target[pole]);
		for (size_t p = 0; p < PARTS; p++)
			part[p] += node->part[p][n] * y[pole];
	}
}

static long double share_of_node(const net_space *space, size_t i, size_t k, const long double *y)
{
	net_node node;
	long double part[PARTS];
	long double off;
	node_at(space, i, k, &node);
	parts_of(space, &node, y, part, &off);
	const long double close = node.close * off * off;
	return node.fair > 0 ? close + node.fair * density(space, &node, part) : close;
}

static long double objective_at(const net_space *space, const long double *y)
{
	long double sum = 0;
	for (size_t k = 0; k < space->v.count; k++)
		for (size_t i = 0; i < space->u.count; i++)
			sum += share_of_node(space, i, k, y);
	return sum;
}

/* The same of the nodes alone that a pole has to do with. */
static long double objective_around(const net_space *space, size_t pole, const long double *y)
{
	const size_t a = pole % space->problem->surface->count_u;
	const size_t b = pole / space->problem->surface->count_u;
	long double sum = 0;
	for (size_t k = 0; k < space->v.count; k++)
		for (size_t i = 0; i < space->u.count; i++)
			if (b - space->v.first[k] < space->v.order && a - space->u.first[i] < space->u.order)
				sum += share_of_node(space, i, k, y);
	return sum;
}

long double oracle_net_objective(const oracle_net_problem *problem, const double *y)
{
	net_space space;
	long double sum = (long double)NAN;
	bool ok = space_open(problem, &space);
	long double *exact = oracle_reals(space.poles);
	if (ok && exact) {
		for (size_t n = 0; n < space.poles; n++)
			exact[n] = y[n];
		sum = objective_at(&space, exact);
	}
	free(exact);
	space_close(&space);
	return sum;
}

bool oracle_net_slopes(const oracle_net_problem *problem, const double *y, double step,
                       double *slopes)
{
	net_space space;
	bool ok = space_open(problem, &space);
	long double *exact = oracle_reals(space.poles);
	ok = ok && exact;
	for (size_t n = 0; ok && n < space.poles; n++)
		exact[n] = y[n];
	for (size_t n = 0; ok && n < space.poles; n++) {
		exact[n] = (long double)y[n] + step;
		const long double above = objective_around(&space, n, exact);
		exact[n] = (long double)y[n] - step;
		slopes[n] = (double)((above - objective_around(&space, n, exact)) /
		                     (2 * (long double)step));
		exact[n] = y[n];
	}
	free(exact);
	space_close(&space);
	return ok;
}

/* Slope and bend of the density by the parts: differences of fourth order, steps a small part of the
 * surface's own derivatives. */
static void differentiate(const net_space *space, const net_node *node, long double part[PARTS],
                          long double slope[PARTS], long double bend[PARTS][PARTS])
{
	long double step[PARTS];
	const long double here = density(space, node, part);
	for (size_t p = 0; p < PARTS; p++) {
		long double size = 0;
		const long double *j =
			node->jet[part_orders[p < 2 ? p : p == 4][0]][part_orders[p < 2 ? p : p == 4][1]];
		for (size_t c = 0; c < 3; c += 2)
			size += j[c] * j[c];
		step[p] = 2e-4L * sqrtl(size + part[p] * part[p] + 1e-12L);
	}
	for (size_t p = 0; p < PARTS; p++) {
		const long double middle = part[p];
		long double f[5];
		for (int t = 0; t < 5; t++) {
			part[p] = middle + (t - 2) * step[p];
			f[t] = t == 2 ? here : density(space, node, part);
		}
		part[p] = middle;
		slope[p] = (8 * (f[3] - f[1]) - (f[4] - f[0])) / (12 * step[p]);
		bend[p][p] = (16 * (f[3] + f[1]) - (f[4] + f[0]) - 30 * here) / (12 * step[p] * step[p]);
	}
	for (size_t p = 0; p < PARTS; p++)
		for (size_t q = 0; q < p; q++) {
			long double sum = 0;
			for (int corner = 0; corner < 4; corner++) {
				const int a = corner & 1 ? 1 : -1;
				const int b = corner & 2 ? 1 : -1;
				long double moved[PARTS];
				memcpy(moved, part, sizeof moved);
				moved[p] += a * step[p];
				moved[q] += b * step[q];
				sum += a * b * density(space, node, moved);
			}
			bend[p][q] = bend[q][p] = sum / (4 * step[p] * step[q]);
		}
}

/* Gradient and dense Hessian by all poles. */
static void expand(const net_space *space, const long double *y, long double *gradient,
                   long double *hessian)
{
	const size_t poles = space->poles;
	memset(gradient, 0, poles * sizeof *gradient);
	memset(hessian, 0, poles * poles * sizeof *hessian);
	for (size_t at = 0; at < space->v.count * space->u.count; at++) {
		net_node node;
		long double part[PARTS];
		long double slope[PARTS] = { 0 };
		long double bend[PARTS][PARTS] = { { 0 } };
		long double off;
		node_at(space, at % space->u.count, at / space->u.count, &node);
		parts_of(space, &node, y, part, &off);
		if (node.fair > 0)
			differentiate(space, &node, part, slope, bend);
		for (size_t a = 0; a < node.count; a++) {
			long double *row = hessian + node.pole[a] * poles;
			long double mixed[PARTS] = { 0 };
			gradient[node.pole[a]] += 2 * node.close * off * node.value[a];
			for (size_t p = 0; p < PARTS; p++) {
				gradient[node.pole[a]] += node.fair * slope[p] * node.part[p][a];
				for (size_t q = 0; q < PARTS; q++)
					mixed[q] += node.fair * bend[p][q] * node.part[p][a];
			}
			for (size_t b = 0; b < node.count; b++) {
				row[node.pole[b]] += 2 * node.close * node.value[a] * node.value[b];
				for (size_t q = 0; q < PARTS; q++)
					row[node.pole[b]] += mixed[q] * node.part[q][b];
			}
		}
	}
}

typedef struct net_newton {
	net_space space;
	size_t count; /* free poles */
	size_t *free, *first;
	long double *y, *trial, *gradient, *hessian, *factor, *step;
} net_newton;

static long double kept(const oracle_net_problem *p, size_t n, long double y)
{
	return fminl(fmaxl(y, p->lower[n]), p->upper[n]);
}

/* Poles that are not held at a bound the gradient pushes against. */
static void choose_free(net_newton *n)
{
	const oracle_net_problem *p = n->space.problem;
	n->count = 0;
	for (size_t k = 0; k < n->space.poles; k++) {
		const bool held = (n->y[k] <= p->lower[k] && n->gradient[k] >= 0) ||
		                  (n->y[k] >= p->upper[k] && n->gradient[k] <= 0);
		if (p->lower[k] < p->upper[k] && !held)
			n->free[n->count++] = k;
	}
}

/* Solves for the step, more and more weight on the diagonal until the factor exists. Returns what the
 * step promises. */
static long double solve_step(net_newton *n)
{
	const size_t poles = n->space.poles;
	bool sound = false;
	long double extra = 0;
	while (!sound) {
		for (size_t a = 0; a < n->count; a++)
			for (size_t b = 0; b < n->count; b++) {
				const long double here = n->hessian[n->free[a] * poles + n->free[b]];
				n->factor[a * n->count + b] = a == b ? here + extra * (fabsl(here) + 1) : here;
			}
		sound = oracle_cholesky(n->count, n->factor, n->first);
		extra = extra > 0 ? 4 * extra : 1e-6L;
	}
	for (size_t a = 0; a < n->count; a++)
		n->trial[a] = -n->gradient[n->free[a]];
	oracle_cholesky_solve(n->count, n->factor, n->first, n->trial);
	long double promise = 0;
	long double largest = 0;
	memset(n->step, 0, poles * sizeof *n->step);
	for (size_t a = 0; a < n->count; a++) {
		n->step[n->free[a]] = n->trial[a];
		promise -= n->trial[a] * n->gradient[n->free[a]] / 2;
		largest = fmaxl(largest, fabsl(n->trial[a]));
	}
	const long double limit = 0.04L * n->space.problem->h;
	for (size_t k = 0; k < poles && largest > limit; k++)
		n->step[k] *= limit / largest;
	return promise;
}

/* As far along the step, cut at the bounds, as the objective falls. */
static bool go(net_newton *n, long double *objective)
{
	const size_t poles = n->space.poles;
	long double length = 1;
	for (int halving = 0; halving < 50; halving++) {
		for (size_t k = 0; k < poles; k++)
			n->trial[k] = kept(n->space.problem, k, n->y[k] + length * n->step[k]);
		const long double value = objective_at(&n->space, n->trial);
		if (value < *objective) {
			memcpy(n->y, n->trial, poles * sizeof *n->y);
			*objective = value;
			return true;
		}
		length /= 2;
	}
	return false;
}

static void iterate(net_newton *n, oracle_minimum *out)
{
	out->objective = objective_at(&n->space, n->y);
	for (out->iterations = 0; out->iterations < 400; out->iterations++) {
		expand(&n->space, n->y, n->gradient, n->hessian);
		choose_free(n);
		out->promise = solve_step(n) / out->objective;
		out->converged = out->promise < 1e-12L;
		const bool gained = go(n, &out->objective);
		if (!gained || out->promise < 1e-15L)
			break;
	}
}

bool oracle_net_minimise(const oracle_net_problem *problem, double *y, oracle_minimum *out)
{
	net_newton n = { 0 };
	*out = (oracle_minimum){ 0 };
	bool ok = space_open(problem, &n.space);
	const size_t poles = n.space.poles;
	n.free = calloc(poles, sizeof *n.free);
	n.first = calloc(poles, sizeof *n.first);
	n.y = oracle_reals(poles);
	n.trial = oracle_reals(poles);
	n.gradient = oracle_reals(poles);
	n.step = oracle_reals(poles);
	n.hessian = oracle_reals(poles * poles);
	n.factor = oracle_reals(poles * poles);
	ok = ok && n.free && n.first && n.y && n.trial && n.gradient && n.step && n.hessian && n.factor;
	for (size_t k = 0; ok && k < poles; k++)
		n.y[k] = kept(problem, k, problem->surface->poles[3 * k + 1]);
	if (ok)
		iterate(&n, out);
	for (size_t k = 0; ok && k < poles; k++) {
		y[k] = (double)n.y[k];
		out->variables += problem->lower[k] < problem->upper[k];
		out->at_bound += problem->lower[k] < problem->upper[k] &&
		                 (n.y[k] <= problem->lower[k] || n.y[k] >= problem->upper[k]);
	}
	free(n.free);
	free(n.first);
	free(n.y);
	free(n.trial);
	free(n.gradient);
	free(n.step);
	free(n.hessian);
	free(n.factor);
	space_close(&n.space);
	return ok;
}
