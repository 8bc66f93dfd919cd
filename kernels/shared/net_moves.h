/* Exploratory moves of a pattern search (Hooke and Jeeves; thesis 7.2) over a control net.
 *
 * The derivatives at y are kept for every sample. A direction changes them by what its moved poles are to the
 * sample, and is probed so: y stays. No other direction of its colour sees the samples that it does. The terms at
 * y are kept too, so that nothing need be worked where the step is 0. */
#ifndef BATTEN_SHARED_NET_MOVES_H
#define BATTEN_SHARED_NET_MOVES_H

#include "multilevel.h"
#include "net_layout.h"

/* A direction: the members that move, the rectangle of poles they lie in, the samples that see it. */
typedef struct net_move {
	int first, end, column, column_end, row, row_end, line, line_end, sample, sample_end;
} net_move;

/* What is done to a direction's samples, one after the other: both steps; the bottom of their parabola;
 * the step to take, where that was not the last; its taking. */
enum { NET_PASS_PAIR, NET_PASS_BOTTOM, NET_PASS_AGAIN, NET_PASS_TAKE };

#define NET_PROBES 2 /* at a time: what a sample is is read once for both */

/* The moves of the whole rectangle are 0 to begin with: it may hold others than members. */
SHARED_FUNCTION void net_move_begin(const search_state *s, int direction, net_move *move)
{
	GLOBAL const int *d = s->directions + direction * NET_DIRECTION_SIZE;
	move->first = d[NET_DIRECTION_FIRST];
	move->end = d[NET_DIRECTION_END];
	move->column = d[NET_DIRECTION_COLUMN];
	move->column_end = d[NET_DIRECTION_COLUMN_END];
	move->row = d[NET_DIRECTION_ROW];
	move->row_end = d[NET_DIRECTION_ROW_END];
	move->line = d[NET_DIRECTION_LINE];
	move->line_end = d[NET_DIRECTION_LINE_END];
	move->sample = d[NET_DIRECTION_SAMPLE];
	move->sample_end = d[NET_DIRECTION_SAMPLE_END];
	ROLLED
	for (int k = move->row; k < move->row_end; k++) {
		ROLLED
		for (int i = move->column; i < move->column_end; i++) {
			AT(s->moves[k * s->columns + i]) = SPREAD(LITERAL(0.0));
			AT(s->moves[s->nodes + k * s->columns + i]) = SPREAD(LITERAL(0.0));
		}
	}
}

/* Where a step leads a member. */
SHARED_FUNCTION real net_member_at(const search_state *s, int member, real step)
{
	const int n = s->members[member];
	return step_from(s, AT(s->y[n]), SPREAD(s->heights[member]) * step, AT(s->lower[n]),
	                 AT(s->upper[n]));
}

/* How far it moves each, as the moves of one of the probes. */
SHARED_FUNCTION void net_move_place(const search_state *s, const net_move *move, int probe,
                                    real step)
{
	ROLLED
	for (int m = move->first; m < move->end; m++) {
		const int n = s->members[m];
		AT(s->moves[probe * s->nodes + n]) = net_member_at(s, m, step) - AT(s->y[n]);
	}
}

/* The terms at y. */
SHARED_FUNCTION real net_move_before(const search_state *s, const net_move *move)
{
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int line = move->line; line < move->line_end; line++) {
		const int at = line * s->length + move->sample;
		GLOBAL const stored *kept = s->kept + (size_t)at * (size_t)NET_KEPT_NUMBERS;
		real line_sum = SPREAD(LITERAL(0.0));
		ROLLED
		for (int i = move->sample; i < move->sample_end; i++, kept += NET_KEPT_NUMBERS)
			line_sum += AT(kept[NET_KEPT_TERM]);
		sum += line_sum;
	}
	return sum;
}

/* One pass over a line's samples: the probes' terms into sums, or what is kept after the move. */
SHARED_FUNCTION void net_move_line(const search_state *s, const net_move *move, int line, int pass,
                                   mask taken, real *sums)
{
	const int probes = pass == NET_PASS_PAIR ? NET_PROBES : 1;
	const int at = line * s->length + move->sample;
	const int row = s->first_v[line];
	const int first_row = move->row > row ? move->row - row : 0;
	const int end_row = move->row_end - row < NET_ORDER_V ? move->row_end - row : NET_ORDER_V;
	GLOBAL const scalar *table = s->table_v + line * NET_TABLE_SIZE(NET_ORDER_V);
	GLOBAL const scalar *along = s->table_u + move->sample * NET_TABLE_SIZE(NET_ORDER_U);
	GLOBAL const stored *sample = s->samples + (size_t)at * (size_t)NET_SAMPLE_NUMBERS;
	GLOBAL stored *kept = s->kept + (size_t)at * (size_t)NET_KEPT_NUMBERS;
	net_pole ring[NET_PROBES * NET_ORDER_MOST];
	real found[NET_PROBES] = { SPREAD(LITERAL(0.0)), SPREAD(LITERAL(0.0)) };
	int reached = move->column;
	ROLLED
	for (int i = move->sample; i < move->sample_end; i++) {
		const int first = s->first_u[i];
		const int begin = first > move->column ? first : move->column;
		const int end = first + NET_ORDER_U < move->column_end ? first + NET_ORDER_U
		                                                       : move->column_end;
		ROLLED
		for (; reached < end; reached++) {
			ROLLED
			for (int p = 0; p < probes; p++)
				ring[reached % NET_ORDER_U * NET_PROBES + p] = net_collapse(
					s, s->moves + p * s->nodes + row * s->columns + reached, first_row, end_row,
					table);
		}
		ROLLED
		for (int p = 0; p < probes; p++) {
			net_jet j = net_jet_kept(s, kept);
			ROLLED
			for (int c = begin; c < end; c++)
				net_jet_add(s, &j, ring + c % NET_ORDER_U * NET_PROBES + p, c - first, along);
			if (pass == NET_PASS_TAKE) {
				AT(kept[NET_KEPT_TERM]) = CHOOSE(taken, AT(kept[NET_KEPT_FOUND]),
				                                 AT(kept[NET_KEPT_TERM]));
				net_jet_keep(s, kept, &j);
				continue;
			}
			const real term = net_sample_objective(s, sample, j);
			AT(kept[NET_KEPT_FOUND]) = term;
			found[p] += term;
		}
		along += NET_TABLE_SIZE(NET_ORDER_U);
		sample += NET_SAMPLE_NUMBERS;
		kept += NET_KEPT_NUMBERS;
	}
	ROLLED
	for (int p = 0; p < probes; p++)
		sums[p] += found[p];
}

/* An exploratory move along one direction. Returns the length of the step taken. */
SHARED_FUNCTION real direction_explore(const search_state *s, int colour, int direction, real h,
                                       real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	search_trial trial = search_trial_begin();
	real step = h;
	net_move move;
	(void)colour;
	net_move_begin(s, direction, &move);
	(void)search_trial_next(&trial, 0, h, net_move_before(s, &move), extra);
	net_move_place(s, &move, 1, -h);
	ROLLED
	for (int pass = NET_PASS_PAIR;;) {
		real sums[NET_PROBES] = { zero, zero };
		net_move_place(s, &move, 0, step);
		ROLLED
		for (int line = move.line; line < move.line_end; line++)
			net_move_line(s, &move, line, pass, step != zero, sums);
		if (pass == NET_PASS_TAKE)
			break;
		if (pass == NET_PASS_AGAIN) {
			pass = NET_PASS_TAKE;
			continue;
		}
		/* Of a pair, the second is the last: its terms are those that were found. */
		const real probed = pass == NET_PASS_PAIR ? -h : step;
		int turn = 3;
		if (pass == NET_PASS_PAIR) {
			(void)search_trial_next(&trial, 1, h, sums[0], extra);
			sums[0] = sums[1];
			turn = 2;
		}
		if (search_trial_next(&trial, turn, h, sums[0], extra)) {
			step = trial.next;
			pass = NET_PASS_BOTTOM;
			continue;
		}
		step = search_trial_end(&trial);
		if (!ANY(step != zero))
			return zero;
		pass = ANY((step != zero) & (step != probed)) ? NET_PASS_AGAIN : NET_PASS_TAKE;
	}
	ROLLED
	for (int m = move.first; m < move.end; m++)
		AT(s->y[s->members[m]]) = net_member_at(s, m, step);
	return CHOOSE(step < zero, -step, step);
}

#endif
