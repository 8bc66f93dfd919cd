/* Moves of a pattern search over an offset grid along hats, and the terms of the objective that they can
 * change: the fairness of nodes (`terms`), and what each node has of its own, closeness and penalty.
 *
 * The derivatives at y are kept for every node. A single offset changes those of its 3 x 3 nodes by so much a
 * step, at the corners y_xz alone. A thin hat, one of offsets of one station, changes y_x, y_xx and y_xz alone
 * beside it. Both probe without moving y. A wider hat is moved in place, from where its nodes were, which is
 * kept in trial: no other direction of its colour reads them; derivatives are made anew when all of these are done. The
 * variation of curvature keeps none, and all its hats are of that kind. The terms at y are kept, so that nothing need be
 * worked where the step is 0; single offsets come last in an iteration and leave them behind. */
#ifndef BATTEN_SHARED_GRID_MOVES_H
#define BATTEN_SHARED_GRID_MOVES_H

#include "dialect.h"
#include "grid_state.h"
#include "multilevel.h"

SHARED_FUNCTION node_slopes slopes_kept(const STATE stored_slopes *kept)
{
	const node_slopes d = { AT(kept->y_x), AT(kept->y_z), AT(kept->y_xx), AT(kept->y_xz),
		                    AT(kept->y_zz) };
	return d;
}

SHARED_FUNCTION void slopes_put(STATE stored_slopes *kept, node_slopes d)
{
	AT(kept->y_x) = d.y_x;
	AT(kept->y_z) = d.y_z;
	AT(kept->y_xx) = d.y_xx;
	AT(kept->y_xz) = d.y_xz;
	AT(kept->y_zz) = d.y_zz;
}

/* ---- hats ---- */
typedef struct search_move {
	int station, waterline; /* centre */
	int width_x, width_z;
	scalar inverse_x, inverse_z;
	real step;
} search_move;

SHARED_FUNCTION int within(int at, int first, int last)
{
	return at < first ? first : at > last ? last : at;
}

/* First and last node under a hat along one direction, or, `beside` GRID_REACH, of those whose terms it
 * changes. */
SHARED_FUNCTION int hat_first(int centre, int width, int beside)
{
	return centre - width + 1 - beside < 0 ? 0 : centre - width + 1 - beside;
}

SHARED_FUNCTION int hat_last(int centre, int width, int beside, int count)
{
	return centre + width - 1 + beside < count ? centre + width - 1 + beside : count - 1;
}

/* Moves the nodes under a hat, from y where they are not kept yet. */
SHARED_FUNCTION void hat_place(const search_state *s, const search_move *move, int kept)
{
	const int first_k = hat_first(move->waterline, move->width_z, 0);
	const int last_k = hat_last(move->waterline, move->width_z, 0, s->waterlines);
	const int last_i = hat_last(move->station, move->width_x, 0, s->stations);
	ROLLED
	for (int i = hat_first(move->station, move->width_x, 0); i <= last_i; i++) {
		const scalar height_x = hat_height(i - move->station, move->inverse_x);
		int node = node_of(s, i, first_k);
		ROLLED
		for (int k = first_k; k <= last_k; k++, node += s->stride) {
			const scalar height = height_x * hat_height(k - move->waterline, move->inverse_z);
			const real from = kept ? AT(s->trial[node]) : AT(s->y[node]);
			if (!kept)
				AT(s->trial[node]) = from;
			AT(s->y[node]) = step_from(s, from, height * move->step, AT(s->lower[node]),
			                           AT(s->upper[node]));
		}
	}
}

/* What a node has of its own, at y. */
SHARED_FUNCTION real node_own(const search_state *s, int node, real y)
{
	real own = node_closeness(AT(s->close[node]), y, AT(s->target[node]));
	if (GRID_PENALTY)
		own += node_penalty(s->penalty, y, AT(s->lower[node]), AT(s->upper[node]));
	return own;
}

/* Differences of three neighbours along x. */
typedef struct row_slopes {
	real here, first, second;
} row_slopes;

SHARED_FUNCTION row_slopes row_of(const search_state *s, const scalar *x, int node)
{
	const real aft = AT(s->y[node - 1]);
	const real here = AT(s->y[node]);
	const real fore = AT(s->y[node + 1]);
	const row_slopes row = { here, stencil_first(x[0], x[1], aft, here, fore),
		                     stencil_second(x[2], x[3], aft, here, fore) };
	return row;
}

/* The objective over a station's nodes first_k .. last_k; its terms go into `terms`. */
SHARED_FUNCTION real column_third_objective(const search_state *s, int station, int first_k,
                                            int last_k, STATE stored *terms)
{
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int k = first_k; k <= last_k; k++) {
		const int node = node_of(s, station, k);
		const real term = node_energy(AT(s->bend[node]), third_fairness(s, s->y, station, k));
		AT(terms[node]) = term;
		sum += term + node_own(s, node, AT(s->y[node]));
	}
	return sum;
}

/* The same for all kinds. Where it `keeps`, derivatives too. */
SHARED_FUNCTION real column_objective(const search_state *s, int station, int first_k, int last_k,
                                      STATE stored *terms, int keeps)
{
	if (GRID_FAIRNESS == GRID_VARIATION)
		return column_third_objective(s, station, first_k, last_k, terms);
	scalar x[STENCIL_SIZE];
	real sum = SPREAD(LITERAL(0.0));
	UNROLLED
	for (int w = 0; w < STENCIL_SIZE; w++)
		x[w] = s->along_x[station * STENCIL_SIZE + w];
	int node = node_of(s, station, first_k);
	row_slopes below = row_of(s, x, node - s->stride);
	row_slopes here = row_of(s, x, node);
	ROLLED
	for (int k = first_k; k <= last_k; k++, node += s->stride) {
		GLOBAL const scalar *z = s->along_z + k * STENCIL_SIZE;
		const row_slopes above = row_of(s, x, node + s->stride);
		const node_slopes d = { here.first,
			                    stencil_first(z[0], z[1], below.here, here.here, above.here),
			                    here.second,
			                    stencil_first(z[0], z[1], below.first, here.first, above.first),
			                    stencil_second(z[2], z[3], below.here, here.here, above.here) };
		const real term = node_energy(AT(s->bend[node]),
		                              node_fairness(GRID_FAIRNESS, s->weights, d));
		AT(terms[node]) = term;
		if (keeps)
			slopes_put(s->slopes + node, d);
		sum += term + node_own(s, node, here.here);
		below = here;
		here = above;
	}
	return sum;
}

/* Terms and derivatives at y of the nodes of so many stations, all or none. */
SHARED_FUNCTION void grid_terms_begin(const search_state *s, int stations)
{
	ROLLED
	for (int i = WORK_ITEM; i < stations; i += WORK_ITEMS)
		(void)column_objective(s, i, 0, s->waterlines - 1, s->terms, 1);
	WAIT;
}

/* Nodes whose terms a hat can change. */
typedef struct hat_window {
	int first_i, last_i, first_k, last_k;
} hat_window;

SHARED_FUNCTION hat_window hat_window_of(const search_state *s, const search_move *move)
{
	const int reach = GRID_REACH(GRID_FAIRNESS);
	const hat_window w = { hat_first(move->station, move->width_x, reach),
		                   hat_last(move->station, move->width_x, reach, s->stations),
		                   hat_first(move->waterline, move->width_z, reach),
		                   hat_last(move->waterline, move->width_z, reach, s->waterlines) };
	return w;
}

/* The objective there as known before a hat's probes, stations own_first .. own_last with what nodes have of
 * their own. */
SHARED_FUNCTION real hat_objective_before(const search_state *s, const hat_window *w, int own_first,
                                          int own_last)
{
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int i = w->first_i; i <= w->last_i; i++) {
		const int owns = i >= own_first && i <= own_last;
		real column = SPREAD(LITERAL(0.0));
		int node = node_of(s, i, w->first_k);
		ROLLED
		for (int k = w->first_k; k <= w->last_k; k++, node += s->stride) {
			column += AT(s->terms[node]);
			if (owns)
				column += node_own(s, node, AT(s->y[node]));
		}
		sum += column;
	}
	return sum;
}

/* The same at y; the terms into s->found. */
SHARED_FUNCTION real hat_objective(const search_state *s, const hat_window *w)
{
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int i = w->first_i; i <= w->last_i; i++)
		sum += column_objective(s, i, w->first_k, w->last_k, s->found, 0);
	return sum;
}

/* Keeps the terms that were found, in the lanes that moved. */
SHARED_FUNCTION void hat_terms_take(const search_state *s, const hat_window *w, mask moved)
{
	ROLLED
	for (int i = w->first_i; i <= w->last_i; i++) {
		const int first = node_of(s, i, w->first_k);
		const int last = node_of(s, i, w->last_k);
		ROLLED
		for (int node = first; node <= last; node += s->stride)
			AT(s->terms[node]) = CHOOSE(moved, AT(s->found[node]), AT(s->terms[node]));
	}
}

/* What a step of one offset does to the derivatives along one direction of the nodes before, at and behind
 * it. */
typedef struct single_stencil {
	scalar first[3], second[3];
} single_stencil;

/* A ring node next to the grid has no term, whatever its weights. */
SHARED_FUNCTION single_stencil single_stencil_of(GLOBAL const scalar *along, int at, int count)
{
	GLOBAL const scalar *before = along + within(at - 1, 0, count - 1) * STENCIL_SIZE;
	GLOBAL const scalar *here = along + at * STENCIL_SIZE;
	GLOBAL const scalar *behind = along + within(at + 1, 0, count - 1) * STENCIL_SIZE;
	const single_stencil stencil = { { before[1], here[0] - here[1], -behind[0] },
		                             { before[3], -(here[3] + here[2]), behind[2] } };
	return stencil;
}

/* ---- thin hats ---- */

/* How far a hat moves the node at waterline k, and those below and above it. */
typedef struct thin_moves {
	real below, here, above;
} thin_moves;

SHARED_FUNCTION real thin_move(const search_state *s, const search_move *move, int node, int k)
{
	const scalar height = hat_height(k - move->waterline, move->inverse_z);
	const real y = AT(s->y[node]);
	return step_from(s, y, height * move->step, AT(s->lower[node]), AT(s->upper[node])) - y;
}

/* What these do to the derivatives along z. */
typedef struct thin_change {
	real first, second;
} thin_change;

SHARED_FUNCTION thin_change thin_change_of(GLOBAL const scalar *z, const thin_moves *m)
{
	const thin_change change = { stencil_first(z[0], z[1], m->below, m->here, m->above),
		                         stencil_second(z[2], z[3], m->below, m->here, m->above) };
	return change;
}

/* The derivatives of a node aft (column 0), of (1) or forward (2) of the hat's station after its move. */
SHARED_FUNCTION node_slopes thin_slopes(const STATE stored_slopes *kept, const single_stencil *x,
                                        int column, real moved, thin_change change)
{
	const real first = SPREAD(x->first[column]);
	node_slopes d = slopes_kept(kept);
	d.y_x = PRODUCT_AND(first, moved, d.y_x);
	d.y_xx = PRODUCT_AND(SPREAD(x->second[column]), moved, d.y_xx);
	d.y_xz = PRODUCT_AND(first, change.first, d.y_xz);
	if (column == 1) {
		d.y_z += change.first;
		d.y_zz += change.second;
	}
	return d;
}

SHARED_FUNCTION real thin_term(const search_state *s, const single_stencil *x, int node, int column,
                               real moved, thin_change change)
{
	const int at = node + column - 1;
	const node_slopes d = thin_slopes(s->slopes + at, x, column, moved, change);
	const real term = node_energy(AT(s->bend[at]), node_fairness(GRID_FAIRNESS, s->weights, d));
	AT(s->found[at]) = term;
	return term;
}

/* The objective after the hat's step; the terms into s->found. */
SHARED_FUNCTION real thin_objective(const search_state *s, const search_move *move,
                                    const hat_window *w, const single_stencil *x)
{
	const real zero = SPREAD(LITERAL(0.0));
	int node = node_of(s, move->station, w->first_k);
	thin_moves m = { zero, zero, thin_move(s, move, node, w->first_k) };
	real sum = zero;
	ROLLED
	for (int k = w->first_k; k <= w->last_k; k++, node += s->stride) {
		m.below = m.here;
		m.here = m.above;
		m.above = thin_move(s, move, node + s->stride, k + 1);
		const thin_change change = thin_change_of(s->along_z + k * STENCIL_SIZE, &m);
		const real aft = thin_term(s, x, node, 0, m.here, change);
		const real here = thin_term(s, x, node, 1, m.here, change);
		const real fore = thin_term(s, x, node, 2, m.here, change);
		sum += ((aft + here) + fore) + node_own(s, node, AT(s->y[node]) + m.here);
	}
	return sum;
}

/* Takes the step: offsets, derivatives, and the terms that the last probe found, which was of this step. */
SHARED_FUNCTION void thin_end(const search_state *s, const search_move *move, const hat_window *w,
                              const single_stencil *x)
{
	const real zero = SPREAD(LITERAL(0.0));
	const mask taken = move->step != zero;
	int node = node_of(s, move->station, w->first_k);
	thin_moves m = { zero, zero, thin_move(s, move, node, w->first_k) };
	ROLLED
	for (int k = w->first_k; k <= w->last_k; k++, node += s->stride) {
		m.below = m.here;
		m.here = m.above;
		m.above = thin_move(s, move, node + s->stride, k + 1);
		const thin_change change = thin_change_of(s->along_z + k * STENCIL_SIZE, &m);
		UNROLLED
		for (int column = 0; column < 3; column++) {
			const int at = node + column - 1;
			slopes_put(s->slopes + at, thin_slopes(s->slopes + at, x, column, m.here, change));
			AT(s->terms[at]) = CHOOSE(taken, AT(s->found[at]), AT(s->terms[at]));
		}
		AT(s->y[node]) += m.here;
	}
}

/* ---- single offsets ---- */

typedef struct single_offset {
	int node;
	single_stencil x, z;
	node_tangent corner[4];
	real y, lower, upper, target, close;
} single_offset;

/* One of its 3 x 3 nodes. Their derivatives and weights are read where they lie, by every probe: 54 numbers are
 * more than there are registers, and to keep them aside is to store them first. */
SHARED_FUNCTION int single_node(const search_state *s, const single_offset *o, int row, int column)
{
	return o->node + (row - 1) * s->stride + column - 1;
}

SHARED_FUNCTION void single_begin(const search_state *s, int station, int waterline,
                                  single_offset *o)
{
	o->node = node_of(s, station, waterline);
	o->x = single_stencil_of(s->along_x, station, s->stations);
	o->z = single_stencil_of(s->along_z, waterline, s->waterlines);
	o->y = AT(s->y[o->node]);
	o->lower = AT(s->lower[o->node]);
	o->upper = AT(s->upper[o->node]);
	o->target = AT(s->target[o->node]);
	o->close = AT(s->close[o->node]);
	UNROLLED
	for (int c = 0; c < 4; c++) {
		const STATE stored_slopes *d = s->slopes + single_node(s, o, c / 2 * 2, c % 2 * 2);
		o->corner[c] = tangent_of(GRID_FAIRNESS, AT(d->y_x), AT(d->y_z));
	}
}

/* The derivatives of one of the nodes after a move. */
SHARED_FUNCTION node_slopes single_slopes(const search_state *s, const single_offset *o, int row,
                                          int column, real moved)
{
	node_slopes d = slopes_kept(s->slopes + single_node(s, o, row, column));
	d.y_xz = PRODUCT_AND(SPREAD(o->x.first[column] * o->z.first[row]), moved, d.y_xz);
	if (row == 1) {
		d.y_x = PRODUCT_AND(SPREAD(o->x.first[column]), moved, d.y_x);
		d.y_xx = PRODUCT_AND(SPREAD(o->x.second[column]), moved, d.y_xx);
	}
	if (column == 1) {
		d.y_z = PRODUCT_AND(SPREAD(o->z.first[row]), moved, d.y_z);
		d.y_zz = PRODUCT_AND(SPREAD(o->z.second[row]), moved, d.y_zz);
	}
	return d;
}

/* The fairness of a corner: y_xz alone changes, and with it neither root nor division. */
SHARED_FUNCTION real single_corner(const search_state *s, const single_offset *o, int row,
                                   int column, real moved)
{
	const node_slopes d = single_slopes(s, o, row, column, moved);
	const real fairness = fairness_of(GRID_FAIRNESS, s->weights, o->corner[row + column / 2],
	                                  d.y_xx, d.y_xz, d.y_zz);
	return node_energy(AT(s->bend[single_node(s, o, row, column)]), fairness);
}

/* That of the other nodes. */
SHARED_FUNCTION real single_beside(const search_state *s, const single_offset *o, int row,
                                   int column, real moved)
{
	const node_slopes d = single_slopes(s, o, row, column, moved);
	return node_energy(AT(s->bend[single_node(s, o, row, column)]),
	                   node_fairness(GRID_FAIRNESS, s->weights, d));
}

/* The objective over the nodes whose terms the offset can change, after a step. */
SHARED_FUNCTION real single_objective(const search_state *s, const single_offset *o, real step)
{
	const real y = step_from(s, o->y, step, o->lower, o->upper);
	const real moved = y - o->y;
	const real below = (single_corner(s, o, 0, 0, moved) + single_beside(s, o, 0, 1, moved)) +
	                   single_corner(s, o, 0, 2, moved);
	const real above = (single_corner(s, o, 2, 0, moved) + single_beside(s, o, 2, 1, moved)) +
	                   single_corner(s, o, 2, 2, moved);
	const real here = (single_beside(s, o, 1, 0, moved) + single_beside(s, o, 1, 1, moved)) +
	                  single_beside(s, o, 1, 2, moved);
	real own = node_closeness(o->close, y, o->target);
	if (GRID_PENALTY)
		own += node_penalty(s->penalty, y, o->lower, o->upper);
	return ((below + here) + above) + own;
}

SHARED_FUNCTION void single_end(const search_state *s, const single_offset *o, real step)
{
	if (!ANY(step != SPREAD(LITERAL(0.0))))
		return;
	const real y = step_from(s, o->y, step, o->lower, o->upper);
	const real moved = y - o->y;
	AT(s->y[o->node]) = y;
	UNROLLED
	for (int n = 0; n < 9; n++)
		slopes_put(s->slopes + single_node(s, o, n / 3, n % 3),
		           single_slopes(s, o, n / 3, n % 3, moved));
}

#endif
