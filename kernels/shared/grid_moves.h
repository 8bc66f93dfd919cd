/* Moves of a pattern search over an offset grid along hats, and the terms of the objective that they can
 * change.
 *
 * A single offset changes the derivatives of its 3 x 3 nodes by so much a step, at the corners y_xz alone:
 * they are made once for all its probes. A wider hat is moved in place, from where its nodes were, which is
 * kept in trial: no other direction of its colour reads them. The terms at y are kept, so that nothing need be
 * worked where the step is 0; single offsets come last in an iteration and leave them behind. */
#ifndef BATTEN_SHARED_GRID_MOVES_H
#define BATTEN_SHARED_GRID_MOVES_H

#include "dialect.h"
#include "grid_state.h"
#include "multilevel.h"

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
			const real from = kept ? s->trial[node] : s->y[node];
			if (!kept)
				s->trial[node] = from;
			s->y[node] = step_from(s, from, height * move->step, s->lower[node], s->upper[node]);
		}
	}
}

/* Differences of three neighbours along x. */
typedef struct row_slopes {
	real here, first, second;
} row_slopes;

SHARED_FUNCTION row_slopes row_of(const search_state *s, const scalar *x, int node)
{
	const real here = s->y[node];
	const real below = here - s->y[node - 1];
	const real above = s->y[node + 1] - here;
	const row_slopes row = { here, x[0] * below + x[1] * above, x[3] * above - x[2] * below };
	return row;
}

/* Those of the variation of curvature: see column_objective(). */
SHARED_FUNCTION real column_third_objective(const search_state *s, int station, int first_k,
                                            int last_k, STATE real *terms)
{
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int k = first_k; k <= last_k; k++) {
		const int node = node_of(s, station, k);
		real term = third_objective(s, s->y, station, k);
		if (GRID_PENALTY)
			term += node_penalty(s->penalty, s->y[node], s->lower[node], s->upper[node]);
		terms[node] = term;
		sum += term;
	}
	return sum;
}

/* The terms of a station's nodes first_k .. last_k, into `terms` too. */
SHARED_FUNCTION real column_objective(const search_state *s, int station, int first_k, int last_k,
                                      STATE real *terms)
{
	if (GRID_FAIRNESS == GRID_VARIATION)
		return column_third_objective(s, station, first_k, last_k, terms);
	scalar x[STENCIL_SIZE];
	real sum = SPREAD(LITERAL(0.0));
	UNROLLED
	for (int w = 0; w < STENCIL_SIZE; w++)
		x[w] = s->along_x[station * STENCIL_SIZE + w];
	int node = node_of(s, station, first_k);
	row_slopes here = row_of(s, x, node);
	const row_slopes low = row_of(s, x, node - s->stride);
	real below = here.here - low.here;
	real twist = here.first - low.first;
	ROLLED
	for (int k = first_k; k <= last_k; k++) {
		GLOBAL const scalar *z = s->along_z + k * STENCIL_SIZE;
		const row_slopes next = row_of(s, x, node + s->stride);
		const real above = next.here - here.here;
		const real turn = next.first - here.first;
		const node_slopes slopes = { here.first, z[0] * below + z[1] * above, here.second,
			                         z[0] * twist + z[1] * turn, z[3] * above - z[2] * below };
		real term = node_objective(GRID_FAIRNESS, s->weights, slopes, s->bend[node], s->close[node],
		                           here.here, s->target[node]);
		if (GRID_PENALTY)
			term += node_penalty(s->penalty, here.here, s->lower[node], s->upper[node]);
		terms[node] = term;
		sum += term;
		here = next;
		below = above;
		twist = turn;
		node += s->stride;
	}
	return sum;
}

/* The terms at y of all nodes, to begin with. */
SHARED_FUNCTION void grid_terms_begin(const search_state *s)
{
	ROLLED
	for (int i = WORK_ITEM; i < s->stations; i += WORK_ITEMS)
		(void)column_objective(s, i, 0, s->waterlines - 1, s->terms);
	WAIT;
}

/* The objective over the nodes whose terms a hat can change, as known before its probes. */
SHARED_FUNCTION real hat_objective_before(const search_state *s, const search_move *move)
{
	const int reach = GRID_REACH(GRID_FAIRNESS);
	const int first_k = hat_first(move->waterline, move->width_z, reach);
	const int last_k = hat_last(move->waterline, move->width_z, reach, s->waterlines);
	const int last_i = hat_last(move->station, move->width_x, reach, s->stations);
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int i = hat_first(move->station, move->width_x, reach); i <= last_i; i++) {
		real column = SPREAD(LITERAL(0.0));
		int node = node_of(s, i, first_k);
		ROLLED
		for (int k = first_k; k <= last_k; k++, node += s->stride)
			column += s->terms[node];
		sum += column;
	}
	return sum;
}

/* The same after its step, from turn 1 on; the terms into s->found. */
SHARED_FUNCTION real hat_objective(const search_state *s, const search_move *move, int turn)
{
	const int reach = GRID_REACH(GRID_FAIRNESS);
	const int first_k = hat_first(move->waterline, move->width_z, reach);
	const int last_k = hat_last(move->waterline, move->width_z, reach, s->waterlines);
	const int last_i = hat_last(move->station, move->width_x, reach, s->stations);
	real sum = SPREAD(LITERAL(0.0));
	hat_place(s, move, turn > 1);
	ROLLED
	for (int i = hat_first(move->station, move->width_x, reach); i <= last_i; i++)
		sum += column_objective(s, i, first_k, last_k, s->found);
	return sum;
}

/* Takes the step and, where there is one, the terms that the last probe found: that of this step. */
SHARED_FUNCTION void hat_end(const search_state *s, const search_move *move)
{
	const int reach = GRID_REACH(GRID_FAIRNESS);
	const int first_k = hat_first(move->waterline, move->width_z, reach);
	const int last_k = hat_last(move->waterline, move->width_z, reach, s->waterlines);
	const int last_i = hat_last(move->station, move->width_x, reach, s->stations);
	const mask moved = move->step != SPREAD(LITERAL(0.0));
	hat_place(s, move, 1);
	if (!ANY(moved))
		return;
	ROLLED
	for (int i = hat_first(move->station, move->width_x, reach); i <= last_i; i++) {
		int node = node_of(s, i, first_k);
		ROLLED
		for (int k = first_k; k <= last_k; k++, node += s->stride)
			s->terms[node] = CHOOSE(moved, s->found[node], s->terms[node]);
	}
}

/* ---- single offsets ---- */

/* What a step of one does to the derivatives along one direction of the nodes before, at and behind the
 * offset. */
typedef struct single_stencil {
	scalar first[3], second[3];
} single_stencil;

typedef struct single_offset {
	int node;
	single_stencil x, z;
	node_slopes at[9]; /* of the 3 x 3 nodes, waterline by waterline, before the move */
	node_tangent corner[4];
	real bend[9];
	real y, lower, upper, target, close;
} single_offset;

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

/* The three nodes of one waterline, row 0 .. 2. */
SHARED_FUNCTION void single_row(const search_state *s, int station, int waterline, int row,
                                single_offset *o)
{
	const int last = s->stations - 1;
	const int k = within(waterline, 0, s->waterlines - 1);
	/* Beyond the ring nothing is read: what is beside it has no term. */
	const int aft = station > 0 ? -2 : -1;
	const int fore = station < last ? 2 : 1;
	const int here = node_of(s, station, waterline);
	const int below = here - (waterline >= 0 ? s->stride : 0);
	const int above = here + (waterline < s->waterlines ? s->stride : 0);
	const STATE real *b = s->y + below;
	const STATE real *h = s->y + here;
	const STATE real *a = s->y + above;
	const node_row b0 = { b[aft], b[-1], b[0] }, h0 = { h[aft], h[-1], h[0] },
				   a0 = { a[aft], a[-1], a[0] };
	const node_row b1 = { b[-1], b[0], b[1] }, h1 = { h[-1], h[0], h[1] },
				   a1 = { a[-1], a[0], a[1] };
	const node_row b2 = { b[0], b[1], b[fore] }, h2 = { h[0], h[1], h[fore] },
				   a2 = { a[0], a[1], a[fore] };
	o->at[3 * row] = slopes_of(stencil_of(s, within(station - 1, 0, last), k), b0, h0, a0);
	o->at[3 * row + 1] = slopes_of(stencil_of(s, station, k), b1, h1, a1);
	o->at[3 * row + 2] = slopes_of(stencil_of(s, within(station + 1, 0, last), k), b2, h2, a2);
	o->bend[3 * row] = s->bend[here - 1];
	o->bend[3 * row + 1] = s->bend[here];
	o->bend[3 * row + 2] = s->bend[here + 1];
}

SHARED_FUNCTION void single_begin(const search_state *s, int station, int waterline,
                                  single_offset *o)
{
	o->node = node_of(s, station, waterline);
	o->x = single_stencil_of(s->along_x, station, s->stations);
	o->z = single_stencil_of(s->along_z, waterline, s->waterlines);
	o->y = s->y[o->node];
	o->lower = s->lower[o->node];
	o->upper = s->upper[o->node];
	o->target = s->target[o->node];
	o->close = s->close[o->node];
	single_row(s, station, waterline - 1, 0, o);
	single_row(s, station, waterline, 1, o);
	single_row(s, station, waterline + 1, 2, o);
	UNROLLED
	for (int c = 0; c < 4; c++) {
		const node_slopes d = o->at[c / 2 * 6 + c % 2 * 2];
		o->corner[c] = tangent_of(GRID_FAIRNESS, d.y_x, d.y_z);
	}
}

/* The fairness of a corner: y_xz alone changes, and with it neither root nor division. */
SHARED_FUNCTION real single_corner(const search_state *s, const single_offset *o, int row,
                                   int column, real moved)
{
	const int n = 3 * row + column;
	const node_slopes d = o->at[n];
	const real y_xz = d.y_xz + (o->x.first[column] * o->z.first[row]) * moved;
	return node_energy(o->bend[n], fairness_of(GRID_FAIRNESS, s->weights,
	                                           o->corner[row + column / 2], d.y_xx, y_xz, d.y_zz));
}

/* That of the nodes aft and forward of the offset. */
SHARED_FUNCTION real single_side(const search_state *s, const single_offset *o, int column,
                                 real moved)
{
	const int n = 3 + column;
	node_slopes d = o->at[n];
	d.y_x += o->x.first[column] * moved;
	d.y_xx += o->x.second[column] * moved;
	d.y_xz += (o->x.first[column] * o->z.first[1]) * moved;
	return node_energy(o->bend[n], node_fairness(GRID_FAIRNESS, s->weights, d));
}

/* That of the nodes below and above, or, with what its station adds, of the offset's own. */
SHARED_FUNCTION real single_upright(const search_state *s, const single_offset *o, int row,
                                    real moved)
{
	const int n = 3 * row + 1;
	node_slopes d = o->at[n];
	if (row == 1) {
		d.y_x += o->x.first[1] * moved;
		d.y_xx += o->x.second[1] * moved;
	}
	d.y_z += o->z.first[row] * moved;
	d.y_zz += o->z.second[row] * moved;
	d.y_xz += (o->x.first[1] * o->z.first[row]) * moved;
	return node_energy(o->bend[n], node_fairness(GRID_FAIRNESS, s->weights, d));
}

/* The objective over the nodes whose terms the offset can change, after a step. */
SHARED_FUNCTION real single_objective(const search_state *s, const single_offset *o, real step)
{
	const real y = step_from(s, o->y, step, o->lower, o->upper);
	const real moved = y - o->y;
	const real below = (single_corner(s, o, 0, 0, moved) + single_upright(s, o, 0, moved)) +
	                   single_corner(s, o, 0, 2, moved);
	const real above = (single_corner(s, o, 2, 0, moved) + single_upright(s, o, 2, moved)) +
	                   single_corner(s, o, 2, 2, moved);
	const real here = (single_side(s, o, 0, moved) + single_upright(s, o, 1, moved)) +
	                  single_side(s, o, 2, moved);
	real own = node_closeness(o->close, y, o->target);
	if (GRID_PENALTY)
		own += node_penalty(s->penalty, y, o->lower, o->upper);
	return ((below + here) + above) + own;
}

SHARED_FUNCTION void single_end(const search_state *s, const single_offset *o, real step)
{
	s->y[o->node] = step_from(s, o->y, step, o->lower, o->upper);
}

#endif
