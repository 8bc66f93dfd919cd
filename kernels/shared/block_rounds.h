/* The way of an iteration of the block search by several rounds over the model that its probes made: lines
 * (and hats) alone find its bottom only roughly where lines are coupled, and do not know which offsets the
 * way will stop at their bounds. A round is a step of conjugate gradients (Hestenes and Stiefel; the lines
 * and hats are the preconditioner) along which the model says how far; slopes go on by the curvatures
 * probed, nothing is probed again. Lines alone end a round within the box: offsets that meet a bound are
 * held, those that the model's slope draws off theirs go free, and tables are factored anew (hats would
 * have to be gathered anew; what they span stays as it is through the iteration). A search that did not
 * gain takes one round the next time. */
#ifndef BATTEN_SHARED_BLOCK_ROUNDS_H
#define BATTEN_SHARED_BLOCK_ROUNDS_H

#include "block_tables.h"
#include "multilevel.h"

#define BLOCK_ROUNDS(s) ((s)->rounds)

/* What a round says of all lanes. */
typedef struct block_round {
	real steep, share; /* slope . bottom; part of the way before that goes into this one */
	real part;         /* of the way that is gone */
} block_round;

/* What rounds begin with: tables not yet factored, slopes, places. */
SHARED_FUNCTION void block_begin_rounds(const block_state *s, int line, block_stay stay)
{
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		const real self = AT(block_array(s, BLOCK_STATE_TRIAL)[n]);
		AT(block_array(s, BLOCK_STATE_SELF)[n]) = self + (stay.part * self + stay.weight);
		AT(block_array(s, BLOCK_STATE_NEXT)[n]) = AT(block_array(s, BLOCK_STATE_FACTOR_1)[n]);
		AT(block_array(s, BLOCK_STATE_OVER)[n]) = AT(block_array(s, BLOCK_STATE_FACTOR_2)[n]);
		AT(block_array(s, BLOCK_STATE_GOING)[n]) = AT(block_array(s, BLOCK_STATE_SLOPE)[n]);
		AT(block_array(s, BLOCK_STATE_TRIAL)[n]) = AT(block_array(s, BLOCK_INPUT_START)[n]);
	}
}

/* Hats leave the box to the trial. */
SHARED_FUNCTION real block_round_end(const block_state *s, int n, real step)
{
	const real place = AT(block_array(s, BLOCK_STATE_TRIAL)[n]);
	if (s->hats > 0)
		return place + step;
	return move_clamped(place, step, AT(block_array(s, BLOCK_INPUT_LOWER)[n]),
	                    AT(block_array(s, BLOCK_INPUT_UPPER)[n]));
}

/* The step of a line, and where it ends in place of the bottom; offsets that the box stops, slope . step, and
 * closeness and the weight of staying along it go into the sums. */
SHARED_FUNCTION void block_step_line(const block_state *s, int line, real share, real weight)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *going = block_array(s, BLOCK_STATE_GOING);
	const STATE stored *close = block_array(s, BLOCK_INPUT_CLOSE);
	const STATE stored *place = block_array(s, BLOCK_STATE_TRIAL);
	STATE stored *bottom = block_array(s, BLOCK_STATE_BOTTOM);
	STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	real stopped = zero, fall = zero, square = zero;
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		const real wanted = CHOOSE(share > zero, share * AT(way[n]), zero) - AT(bottom[n]);
		const real end = block_round_end(s, n, wanted);
		const real step = end - AT(place[n]);
		stopped += CHOOSE(end != AT(place[n]) + wanted, SPREAD(LITERAL(1.0)), zero);
		fall += AT(going[n]) * step;
		square += ((AT(close[n]) + AT(close[n])) + weight) * (step * step);
		AT(bottom[n]) = end;
		AT(way[n]) = step;
	}
	AT(s->sums[s->lines + line]) = stopped;
	AT(s->sums[2 * s->lines + line]) = fall;
	AT(s->sums[3 * s->lines + line]) = square;
}

/* What the step bends at the nodes of a line, in place of the slopes probed there, and what that comes to
 * along the step. */
SHARED_FUNCTION void block_bend_line(const block_state *s, int line)
{
	const real zero = SPREAD(LITERAL(0.0));
	real square = zero;
	AT(s->sums[4 * s->lines + line]) = zero;
	if (!block_is_inside(line, s->lines))
		return;
	const STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	block_window window = block_window_at(s, way, line);
	ROLLED
	for (int k = 1; k + 1 < s->length; k++) {
		STATE stored *probes = block_ring(s, line) + k * BLOCK_PROBE_COUNT;
		block_walk(s, way, line, k, &window);
		const node_slopes d = block_slopes_at(s, &window, k);
		const real r = (AT(probes[BLOCK_PROBE_RR]) * d.y_xx + AT(probes[BLOCK_PROBE_RS]) * d.y_xz) +
		               AT(probes[BLOCK_PROBE_RT]) * d.y_zz;
		const real m = (AT(probes[BLOCK_PROBE_RS]) * d.y_xx + AT(probes[BLOCK_PROBE_SS]) * d.y_xz) +
		               AT(probes[BLOCK_PROBE_ST]) * d.y_zz;
		const real t = (AT(probes[BLOCK_PROBE_RT]) * d.y_xx + AT(probes[BLOCK_PROBE_ST]) * d.y_xz) +
		               AT(probes[BLOCK_PROBE_TT]) * d.y_zz;
		square += (r * d.y_xx + m * d.y_xz) + t * d.y_zz;
		AT(probes[BLOCK_PROBE_R]) = r;
		AT(probes[BLOCK_PROBE_S]) = m;
		AT(probes[BLOCK_PROBE_T]) = t;
	}
	AT(s->sums[4 * s->lines + line]) = square;
}

/* What the step bends at node k of a line and of those beside it, as the offsets below, at and above it feel it. */
typedef struct block_pull {
	real below, here, above;
} block_pull;

SHARED_FUNCTION block_pull block_pull_at(const block_state *s, const block_sides *sides, int k)
{
	const real zero = SPREAD(LITERAL(0.0));
	const block_side *each[3] = { &sides->own, &sides->aft, &sides->fore };
	block_pull pull = { zero, zero, zero };
	if (!block_is_inside(k, s->length))
		return pull;
	GLOBAL const scalar *w = s->along + k * STENCIL_SIZE;
	real here = zero, mixed = zero, second = zero;
	for (int i = 0; i < 3; i++)
		if (each[i]->probes) {
			const STATE stored *bent = each[i]->probes + k * BLOCK_PROBE_COUNT;
			here += each[i]->second * AT(bent[BLOCK_PROBE_R]);
			mixed += each[i]->first * AT(bent[BLOCK_PROBE_S]);
			if (i == 0)
				second = AT(bent[BLOCK_PROBE_T]);
		}
	pull.below = w[2] * second - w[0] * mixed;
	pull.here = here + ((w[0] - w[1]) * mixed - (w[2] + w[3]) * second);
	pull.above = w[1] * mixed + w[3] * second;
	return pull;
}

/* Where the part of its step takes an offset. */
SHARED_FUNCTION real block_round_place(const block_state *s, int n, real part)
{
	const real end = AT(block_array(s, BLOCK_STATE_BOTTOM)[n]);
	const real there = block_round_end(s, n, part * AT(block_array(s, BLOCK_STATE_WAY)[n]));
	return CHOOSE(part == SPREAD(LITERAL(1.0)), end, there);
}

/* Holds an offset, or lets it go, by the model's slope; 1 where that is new. Its row is left to be factored. */
SHARED_FUNCTION real block_hold_again(const block_state *s, int n)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real slope = AT(block_array(s, BLOCK_STATE_GOING)[n]);
	const real place = AT(block_array(s, BLOCK_STATE_TRIAL)[n]);
	const real self = AT(block_array(s, BLOCK_STATE_SELF)[n]);
	STATE stored *kept = block_array(s, BLOCK_STATE_INVERSE) + n;
	const mask down = (place > AT(block_array(s, BLOCK_INPUT_LOWER)[n])) & (slope >= zero);
	const mask up = (place < AT(block_array(s, BLOCK_INPUT_UPPER)[n])) & (slope <= zero);
	const mask is_free = (self > zero) & (down | up);
	const mask differs = is_free != (AT(*kept) > zero);
	AT(*kept) = CHOOSE(is_free, self, zero);
	AT(block_array(s, BLOCK_STATE_FACTOR_1)[n]) = AT(block_array(s, BLOCK_STATE_NEXT)[n]);
	AT(block_array(s, BLOCK_STATE_FACTOR_2)[n]) = AT(block_array(s, BLOCK_STATE_OVER)[n]);
	return CHOOSE(differs, SPREAD(LITERAL(1.0)), zero);
}

/* Offsets of a line go the part of their step, and their slopes with them. How many are held now and were not,
 * or the other way, goes into the sums. */
SHARED_FUNCTION void block_go_line(const block_state *s, int line, real part, real weight)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *close = block_array(s, BLOCK_INPUT_CLOSE);
	const STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	STATE stored *going = block_array(s, BLOCK_STATE_GOING);
	const block_sides sides = block_sides_of(s, line);
	real here = zero, above = zero, changed = zero;
	ROLLED
	for (int k = 1; k <= s->length; k++) {
		const block_pull pull = block_pull_at(s, &sides, k);
		const int n = line * s->length + k - 1;
		const real bends = (here + pull.below) +
		                   ((AT(close[n]) + AT(close[n])) + weight) * AT(way[n]);
		AT(going[n]) += part * bends;
		AT(block_array(s, BLOCK_STATE_TRIAL)[n]) = block_round_place(s, n, part);
		if (s->hats == 0)
			changed += block_hold_again(s, n);
		here = above + pull.here;
		above = pull.above;
	}
	AT(s->sums[5 * s->lines + line]) = changed;
}

/* The bottom of a line's parabola, and what the hats have beyond it, from the slopes as they are;
 * slope . bottom goes into the sums. */
SHARED_FUNCTION void block_bottom_line(const block_state *s, int line)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *going = block_array(s, BLOCK_STATE_GOING);
	STATE stored *bottom = block_array(s, BLOCK_STATE_BOTTOM);
	const int first = line * s->length;
	block_carry forth = { zero, zero }, back = { zero, zero };
	real steep = zero;
	ROLLED
	for (int n = first; n < first + s->length; n++)
		AT(bottom[n]) = block_solve_forth(s, n, AT(going[n]), &forth);
	ROLLED
	for (int n = first + s->length - 1; n >= first; n--) {
		const real own = block_solve_back(s, n, AT(bottom[n]), &back);
		const real whole = s->hats == 0 ? own : own + block_hats_beyond(s, line, n - first);
		steep += AT(going[n]) * whole;
		AT(bottom[n]) = whole;
	}
	AT(s->sums[line]) = steep;
}

/* All lines go on. Where offsets may be held anew their tables are factored, and lines look for their bottom, at
 * once: what a line needs is still at hand. */
SHARED_FUNCTION void block_go(const block_state *s, real part, real weight)
{
	int gone = 0;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS) {
		block_go_line(s, line, part, weight);
		gone++;
		if (s->hats == 0 && (gone == BLOCK_TOGETHER || line + WORK_ITEMS >= s->lines)) {
			const int first = line - (gone - 1) * WORK_ITEMS;
			block_factor_lines(s, first, WORK_ITEMS, gone);
			ROLLED
			for (int done = first; done <= line; done += WORK_ITEMS)
				block_bottom_line(s, done);
			gone = 0;
		}
	}
	WAIT;
}

/* How far the step goes: to the bottom of the model along it, but where the box stops offsets, whole, so that
 * they are at their bounds. bold: 0 where the search takes one round. */
SHARED_FUNCTION real block_round_part(const block_state *s, int round, int last, real bold)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real alone = round == 0 ? one : zero;
	const real most = s->hats > 0 ? SPREAD(LITERAL(4.0)) : one;
	real part = one;
	if (s->hats > 0 || !last) {
		const real fall = -block_total(s, 2);
		const real square = block_total(s, 3) + block_total(s, 4);
		const mask goes = (fall > zero) & (square > zero);
		const real bottom = CHOOSE(goes, fall / CHOOSE(goes, square, one), zero);
		part = CHOOSE(bottom < most, bottom, most);
		if (s->hats == 0)
			part = CHOOSE(block_total(s, 1) > zero, one, part);
	}
	return CHOOSE(bold > zero, part, alone);
}

/* The bottom of all lines, where going on has not found it. */
SHARED_FUNCTION void block_bottoms(const block_state *s)
{
	if (s->hats > 0)
		block_choose_hats(s, block_array(s, BLOCK_STATE_GOING));
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_bottom_line(s, line);
	WAIT;
}

/* How much of the way before goes into this one: 0 in the first round, and where offsets are held anew. */
SHARED_FUNCTION void block_round_share(const block_state *s, int round, block_round *r)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real steep = block_total(s, 0);
	mask goes_on = (r->steep > zero) & (steep > zero);
	if (round > 0 && s->hats == 0)
		goes_on = goes_on & (block_total(s, 5) == zero);
	r->share = round > 0 ? CHOOSE(goes_on, steep / CHOOSE(goes_on, r->steep, steep), zero) : zero;
	r->steep = steep;
}

/* Steps of all lines, and, where bends is not 0, what they bend, a line of nodes when those beside it have
 * stepped. */
SHARED_FUNCTION void block_round_step(const block_state *s, real share, real weight, int bends)
{
	const int at_once = WORK_ITEMS;
	ROLLED
	for (int first = 0; first <= s->lines; first += at_once) {
		const int line = first + WORK_ITEM;
		if (line < s->lines)
			block_step_line(s, line, share, weight);
		WAIT;
		if (bends && line > 0 && line <= s->lines)
			block_bend_line(s, line - 1);
		WAIT;
	}
}

/* The way of all rounds, where they ended: TRIAL less y, by the last step. Its longest part, slope . way and way . way go
 * into the sums. */
SHARED_FUNCTION void block_sum_line(const block_state *s, int line, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *y = block_array(s, BLOCK_INPUT_START);
	const STATE stored *slope = block_array(s, BLOCK_STATE_SLOPE);
	STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	real longest = zero, fall = zero, square = zero;
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		const real whole = block_round_place(s, n, part) - AT(y[n]);
		const real size = CHOOSE(whole < zero, -whole, whole);
		longest = CHOOSE(size > longest, size, longest);
		AT(way[n]) = whole;
		fall -= AT(slope[n]) * whole;
		square += whole * whole;
	}
	AT(s->sums[line]) = longest;
	AT(s->sums[s->lines + line]) = fall;
	AT(s->sums[2 * s->lines + line]) = square;
}

/* Leaves the way of all rounds. */
SHARED_FUNCTION void block_go_rounds(const block_state *s, real weight, real bold)
{
	block_round r;
	r.steep = r.share = r.part = SPREAD(LITERAL(0.0));
	ROLLED
	for (int round = 0; round < s->rounds; round++) {
		const int last = round + 1 == s->rounds;
		if (round == 0 || s->hats > 0)
			block_bottoms(s);
		block_round_share(s, round, &r);
		block_round_step(s, r.share, weight, s->hats > 0 || !last);
		r.part = block_round_part(s, round, last, bold);
		WAIT;
		if (!last)
			block_go(s, r.part, weight);
	}
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_sum_line(s, line, r.part);
	WAIT;
}

#endif
