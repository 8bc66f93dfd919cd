/* The course of a group: rows corrected until their hulls measure what is asked of them, Broyden's way
 * (host/variation/iterate.c), then the forms at every draft. */
#ifndef BATTEN_SHARED_VARIANTS_COURSE_H
#define BATTEN_SHARED_VARIANTS_COURSE_H

#include "variants_body.h"
#include "variants_move.h"

#define VARIANTS_PASSES_MOST 60
#define VARIANTS_HALVINGS 12
/* Done below the first, good enough below the second when rounding ends it before. */
#define VARIANTS_TIGHT LITERAL(1e-10)
#define VARIANTS_LOOSE LITERAL(1e-5)

/* Where the rows of a group stand. Every work-item has the same numbers. */
typedef struct variants_quest {
	real asked[2];     /* percent of Cp, percent of LBP */
	real p[2], off[2]; /* accepted parameters; measured less asked */
	real trial[2], step[2];
	real inverse[4]; /* of the derivatives */
	real best, part, tries, passes, turns;
	real started; /* 1: a first hull is there */
	real end;     /* VARIANTS_END_...; below 0: at work */
	real cp, lcb;
} variants_quest;

SHARED_FUNCTION void variants_quest_begin(const variants_state *s, variants_quest *q,
                                          GLOBAL const real *asked)
{
	const int swing = s->shape[VARIANTS_METHOD] == VARIANTS_SWING;
	q->asked[0] = swing ? ZERO : asked[VARIANTS_ASK_FULLNESS];
	q->asked[1] = asked[VARIANTS_ASK_CENTRE];
	for (int i = 0; i < 2; i++) {
		q->p[i] = q->off[i] = q->step[i] = ZERO;
		q->trial[i] = q->asked[i];
	}
	q->inverse[0] = q->inverse[3] = ONE;
	q->inverse[1] = q->inverse[2] = ZERO;
	q->best = NONE;
	q->part = ONE;
	q->tries = q->passes = q->turns = q->started = q->cp = q->lcb = ZERO;
	q->end = -ONE;
}

/* What the trial measures; true where it is a hull with these measures. */
SHARED_FUNCTION mask variants_measure(const variants_state *s, variants_quest *q, real off[2])
{
	GLOBAL const scalar *formula = TABLE(s, FORMULA);
	STATE const real *form = s->forms + s->drafts * VARIANTS_FORM_COUNT;
	const real volume = form[VARIANTS_VOLUME], midship = form[VARIANTS_MIDSHIP];
	const real length = SPREAD(formula[VARIANTS_FORMULA_LENGTH]);
	const real parent_cp = SPREAD(formula[VARIANTS_FORMULA_PARENT_CP]);
	const mask there = (volume > ZERO) & (midship > ZERO) & (midship < NONE);
	const real cp = volume / (length * midship);
	const real lcb = NUMBER(100) * (form[VARIANTS_MOMENT_X] / volume - length / NUMBER(2)) / length;
	const mask at_work = q->end < ZERO;
	q->cp = CHOOSE(at_work, cp, q->cp);
	q->lcb = CHOOSE(at_work, lcb, q->lcb);
	off[0] = s->shape[VARIANTS_METHOD] == VARIANTS_SWING
	             ? ZERO
	             : NUMBER(100) * (cp - parent_cp) / parent_cp - q->asked[0];
	off[1] = lcb - SPREAD(formula[VARIANTS_FORMULA_PARENT_LCB]) - q->asked[1];
	return there & (off[0] - off[0] == ZERO) & (off[1] - off[1] == ZERO);
}

SHARED_FUNCTION real variants_size(real a)
{
	return CHOOSE(a < ZERO, -a, a);
}

SHARED_FUNCTION real variants_residual(const variants_quest *q)
{
	return MOST_OF(variants_size(q->off[0]), variants_size(q->off[1]));
}

/* Broyden's update of the inverse, where the mask says. */
SHARED_FUNCTION void variants_learn(variants_quest *q, mask where, const real change[2])
{
	real *k = q->inverse;
	const real image0 = FUSED(k[0], change[0], k[1] * change[1]);
	const real image1 = FUSED(k[2], change[0], k[3] * change[1]);
	const real row0 = FUSED(q->step[0], k[0], q->step[1] * k[2]);
	const real row1 = FUSED(q->step[0], k[1], q->step[1] * k[3]);
	const real along = FUSED(q->step[0], image0, q->step[1] * image1);
	const mask learns = where & (variants_size(along) > ZERO);
	const real by0 = (q->step[0] - image0) / along, by1 = (q->step[1] - image1) / along;
	k[0] = CHOOSE(learns, FUSED(by0, row0, k[0]), k[0]);
	k[1] = CHOOSE(learns, FUSED(by0, row1, k[1]), k[1]);
	k[2] = CHOOSE(learns, FUSED(by1, row0, k[2]), k[2]);
	k[3] = CHOOSE(learns, FUSED(by1, row1, k[3]), k[3]);
}

/* Where the trial gave no hull: nearer to the parent, or a shorter step; too often is the end. */
SHARED_FUNCTION void variants_retreat(variants_quest *q, mask where)
{
	const mask starts = where & (q->started == ZERO), steps = where & (q->started > ZERO);
	q->tries = CHOOSE(where, q->tries + ONE, q->tries);
	q->end = CHOOSE(where & (q->tries >= NUMBER(VARIANTS_HALVINGS)), NUMBER(VARIANTS_END_FOLDED),
	                q->end);
	q->part = CHOOSE(
		starts,
		CHOOSE(q->tries + ONE < NUMBER(VARIANTS_HALVINGS), SPREAD(LITERAL(0.5)) * q->part, ZERO),
		q->part);
	for (int i = 0; i < 2; i++) {
		q->step[i] = CHOOSE(steps, SPREAD(LITERAL(0.5)) * q->step[i], q->step[i]);
		q->trial[i] = CHOOSE(starts, q->part * q->asked[i],
		                     CHOOSE(steps, q->p[i] + q->step[i], q->trial[i]));
	}
}

/* Where the trial is a hull: it is where the row stands now; on from there, or done. */
SHARED_FUNCTION void variants_accept(variants_quest *q, mask where, const real off[2], int once)
{
	real change[2];
	for (int i = 0; i < 2; i++) {
		change[i] = off[i] - q->off[i];
		q->p[i] = CHOOSE(where, q->trial[i], q->p[i]);
		q->off[i] = CHOOSE(where, off[i], q->off[i]);
	}
	variants_learn(q, where & (q->started > ZERO), change);
	q->passes = CHOOSE(where & (q->started > ZERO), q->passes + ONE, q->passes);
	q->started = CHOOSE(where, ONE, q->started);
	const real now = variants_residual(q);
	const mask last = q->passes >= NUMBER(VARIANTS_PASSES_MOST);
	const mask loose = now <= SPREAD(VARIANTS_LOOSE);
	const mask met = (now <= SPREAD(VARIANTS_TIGHT)) |
	                 (loose & (now > SPREAD(LITERAL(0.5)) * q->best)) | (last & loose);
	const mask done = where & (met | last | (NUMBER(once) > ZERO));
	q->end = CHOOSE(
		done,
		CHOOSE(met | (NUMBER(once) > ZERO), NUMBER(VARIANTS_END_GOOD), NUMBER(VARIANTS_END_MISSED)),
		q->end);
	const mask on = where & !done;
	q->best = CHOOSE(on, LEAST_OF(q->best, now), q->best);
	q->tries = CHOOSE(on, ZERO, q->tries);
	for (int i = 0; i < 2; i++) {
		const real step = -FUSED(q->inverse[2 * i], q->off[0], q->inverse[2 * i + 1] * q->off[1]);
		q->step[i] = CHOOSE(on, step, q->step[i]);
		q->trial[i] = CHOOSE(on, q->p[i] + step, q->trial[i]);
	}
}

/* Any line of a lane that the tables do not hold for. */
SHARED_FUNCTION mask variants_irregular(const variants_state *s, int first_draft, int drafts)
{
	const int lines = s->waterlines + s->stations;
	real most = ZERO;
	ROLLED
	for (int i = 0; i < lines; i++)
		most = MOST_OF(most, s->bad[i]);
	ROLLED
	for (int d = first_draft; d < first_draft + drafts; d++)
		most = MOST_OF(most, s->bad[lines + d]);
	return most > ZERO;
}

/* Sections below draft d, then the ship; one work-item goes along the ship. */
SHARED_FUNCTION void variants_take_targets(const variants_state *s)
{
	ROLLED
	for (int i = WORK_ITEM; i < s->stations; i += WORK_ITEMS)
		variants_take_area(s, s->drafts, i, variants_foot_of(s, i), 0);
	WAIT;
	if (WORK_ITEM == 0)
		variants_take_body(s, s->drafts, 0, s->forms + s->drafts * VARIANTS_FORM_COUNT);
	WAIT;
}

SHARED_FUNCTION void variants_vary(const variants_state *s, variants_quest *q,
                                   GLOBAL const real *asked)
{
	const int method = s->shape[VARIANTS_METHOD], most = s->shape[VARIANTS_TURNS];
	variants_quest_begin(s, q, asked);
	ROLLED
	for (int turn = 0; ANY(q->end < ZERO) && (most == 0 || turn < most); turn++) {
		const mask at_work = q->end < ZERO;
		real off[2];
		variants_shift shift = method == VARIANTS_SWING
		                           ? variants_swing(s, q->trial[1])
		                           : variants_halves(s, q->trial[0], q->trial[1],
		                                             asked[VARIANTS_ASK_BODY_AFT],
		                                             asked[VARIANTS_ASK_BODY_FORE]);
		mask good = variants_move(s, &shift);
		variants_find_lines(s);
		variants_take_targets(s);
		const mask irregular = good & variants_irregular(s, s->drafts, 1);
		good = good & variants_measure(s, q, off);
		q->turns = CHOOSE(at_work, q->turns + ONE, q->turns);
		variants_retreat(q, at_work & !good & !irregular);
		if (s->shape[VARIANTS_ONCE])
			q->end = CHOOSE(at_work & !good, NUMBER(VARIANTS_END_FOLDED), q->end);
		variants_accept(q, at_work & good & !irregular, off, s->shape[VARIANTS_ONCE]);
		q->end = CHOOSE(at_work & irregular, NUMBER(VARIANTS_END_IRREGULAR), q->end);
	}
	q->end = CHOOSE(q->end < ZERO, NUMBER(VARIANTS_END_UNFINISHED), q->end);
}

/* Half-breadths given: below 0 the node is not on the hull. */
SHARED_FUNCTION void variants_take_given(const variants_state *s, GLOBAL const real *y)
{
	ROLLED
	for (int w = WORK_ITEM; w < s->waterlines; w += WORK_ITEMS) {
		s->bad[w] = ZERO;
		ROLLED
		for (int n = w * s->stations; n < (w + 1) * s->stations; n++) {
			s->y[n] = MOST_OF(y[n], ZERO);
			s->on[n] = CHOOSE(y[n] >= ZERO, ONE, ZERO);
		}
	}
	WAIT;
	variants_find_lines(s);
}

/* Everything at every draft. No condition stands around a barrier: without drafts there are no lines to go
 * along. */
SHARED_FUNCTION void variants_take_forms(const variants_state *s)
{
	const int waterlines = s->drafts > 0 ? s->waterlines : 0;
	const int stations = s->drafts > 0 ? s->stations : 0;
	variants_knots knots = { 0, ZERO, ZERO };
	ROLLED
	for (int w = WORK_ITEM; w < waterlines; w += WORK_ITEMS)
		variants_find_slopes(s, w, &knots);
	WAIT;
	ROLLED
	for (int i = WORK_ITEM; i < stations; i += WORK_ITEMS) {
		const variants_foot foot = variants_foot_of(s, i);
		ROLLED
		for (int d = 0; d < s->drafts; d++)
			variants_take_area(s, d, i, foot, 1);
		variants_take_girths(s, i, foot);
	}
	WAIT;
	ROLLED
	for (int d = WORK_ITEM; d < s->drafts; d += WORK_ITEMS)
		variants_take_body(s, d, 1, s->forms + d * VARIANTS_FORM_COUNT);
	WAIT;
}

/* Largest half-breadth of a variant, '?' nodes left out. */
SHARED_FUNCTION real variants_half_beam(const variants_state *s)
{
	GLOBAL const scalar *nodes = TABLE(s, NODES);
	real most = ZERO;
	ROLLED
	for (int n = 0; n < s->waterlines * s->stations; n++)
		if (!((int)nodes[n] & VARIANTS_NODE_UNKNOWN))
			most = MOST_OF(most, s->y[n]);
	ROLLED
	for (int w = 0; w < s->waterlines; w++) {
		GLOBAL const scalar *ends = TABLE(s, ENDS) + 4 * w;
		if (ends[0] < LITERAL(VARIANTS_NONE))
			most = MOST_OF(most, SPREAD(ends[1]));
		if (ends[2] < LITERAL(VARIANTS_NONE))
			most = MOST_OF(most, SPREAD(ends[3]));
	}
	return most;
}

/* What is no number has other bits on every device, and is NONE. */
SHARED_FUNCTION real variants_told(real a)
{
	return CHOOSE(a - a == ZERO, a, NONE);
}

/* y: [N], what is given, or what is found. out: VARIANTS_OUT_COUNT, then the forms of each draft. */
SHARED_FUNCTION void variants_run_group(const variants_state *s, GLOBAL const real *asked,
                                        GLOBAL real *y, GLOBAL real *out)
{
	const int given = s->shape[VARIANTS_METHOD] == VARIANTS_GIVEN;
	variants_quest quest;
	if (given) {
		variants_take_given(s, y);
		variants_quest_begin(s, &quest, asked);
		quest.end = NUMBER(VARIANTS_END_GOOD);
	} else {
		variants_vary(s, &quest, asked);
	}
	variants_take_forms(s);
	quest.end = CHOOSE((quest.end == NUMBER(VARIANTS_END_GOOD)) &
	                       variants_irregular(s, 0, s->drafts),
	                   NUMBER(VARIANTS_END_IRREGULAR), quest.end);
	ROLLED
	for (int n = WORK_ITEM; n < s->drafts * VARIANTS_FORM_COUNT; n += WORK_ITEMS)
		out[VARIANTS_OUT_COUNT + n] = variants_told(s->forms[n]);
	ROLLED
	for (int n = WORK_ITEM; !given && n < s->waterlines * s->stations; n += WORK_ITEMS)
		y[n] = CHOOSE(s->on[n] > ZERO, s->y[n], -ONE);
	if (WORK_ITEM > 0)
		return;
	out[VARIANTS_OUT_END] = quest.end;
	out[VARIANTS_OUT_TURNS] = quest.turns;
	out[VARIANTS_OUT_OFF] = variants_told(variants_residual(&quest));
	out[VARIANTS_OUT_CP] = variants_told(quest.cp);
	out[VARIANTS_OUT_LCB] = variants_told(quest.lcb);
	out[VARIANTS_OUT_HALF_BEAM] = variants_half_beam(s);
}

#endif
