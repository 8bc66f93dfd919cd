/* A search over an offset grid at work: its part of memory, and the whole objective.
 *
 * Defined before this is included: GRID_FAIRNESS (search_layout.h); a constant in OpenCL, in C it may look
 * into `s`, the state at hand. GRID_PENALTY: 1 where the objective has an interior penalty, in C as well by
 * `s`; 0 where it is not defined. */
#ifndef BATTEN_SHARED_GRID_STATE_H
#define BATTEN_SHARED_GRID_STATE_H

#if !defined(GRID_PENALTY)
#define GRID_PENALTY 0
#endif

#include "dialect.h"
#include "grid_energy.h"
#include "multilevel.h"
#include "search_layout.h"

typedef struct search_state {
	int stations, waterlines, stride, nodes;
	GLOBAL const scalar *along_x, *along_z;
	GLOBAL const scalar *third_x, *third_z; /* STENCIL_THIRD a line each, of GRID_VARIATION */
	STATE stored *y, *base, *trial;
	STATE stored *terms, *found; /* the objective's at y; as a probe found them */
	STATE stored *ways;          /* of iterations before */
	STATE stored_slopes *slopes; /* derivatives at y, kept from move to move */
	GLOBAL const stored *lower, *upper, *target, *bend, *close;
	int level_count, colour_count, wide_colours; /* the rest is for those that work along hats */
	int hat_colours; /* of hats wider than a station, the first; of GRID_VARIATION, which keeps no derivatives, 0 */
	GLOBAL const int *levels, *centres;
	STATE stored *lines;    /* one sum a waterline */
	STATE stored *gathered; /* two numbers a work-item */
	LOCAL int *vote;
	grid_weights weights;
	real wide_probes;
	real penalty;  /* r of GRID_PENALTY */
	int fairness;  /* in C, for GRID_FAIRNESS */
	int penalised; /* in C, for GRID_PENALTY */
} search_state;

SHARED_FUNCTION int node_of(const search_state *s, int station, int waterline)
{
	return (waterline + 1) * s->stride + (station + 1);
}

SHARED_FUNCTION node_stencil stencil_of(const search_state *s, int station, int waterline)
{
	node_stencil stencil;
	for (int w = 0; w < STENCIL_SIZE; w++) {
		stencil.x[w] = s->along_x[station * STENCIL_SIZE + w];
		stencil.z[w] = s->along_z[waterline * STENCIL_SIZE + w];
	}
	return stencil;
}

#include "grid_third.h"

/* Where a step leads from y in a box. */
SHARED_FUNCTION real step_from(const search_state *s, real y, real step, real lower, real upper)
{
	(void)s;
	if (GRID_PENALTY)
		return move_inside(y, step, lower, upper);
	return move_clamped(y, step, lower, upper);
}

/* The part of the objective of a node of trial. */
SHARED_FUNCTION real trial_objective(const search_state *s, int station, int waterline)
{
	if (GRID_FAIRNESS == GRID_VARIATION)
		return third_objective(s, s->trial, station, waterline);
	const int node = node_of(s, station, waterline);
	const STATE stored *b = s->trial + (node - s->stride);
	const STATE stored *h = s->trial + node;
	const STATE stored *a = s->trial + (node + s->stride);
	const node_row below = { AT(b[-1]), AT(b[0]), AT(b[1]) };
	const node_row here = { AT(h[-1]), AT(h[0]), AT(h[1]) };
	const node_row above = { AT(a[-1]), AT(a[0]), AT(a[1]) };
	return node_objective(GRID_FAIRNESS, s->weights,
	                      slopes_of(stencil_of(s, station, waterline), below, here, above),
	                      AT(s->bend[node]), AT(s->close[node]), here.here, AT(s->target[node]));
}

/* The whole objective at s->trial, the same in every work-item. */
SHARED_FUNCTION real whole_objective(const search_state *s)
{
	ROLLED
	for (int k = WORK_ITEM; k < s->waterlines; k += WORK_ITEMS) {
		real line = SPREAD(LITERAL(0.0));
		ROLLED
		for (int i = 0; i < s->stations; i++) {
			line += trial_objective(s, i, k);
			if (GRID_PENALTY) {
				const int node = node_of(s, i, k);
				line += node_penalty(s->penalty, AT(s->trial[node]), AT(s->lower[node]),
				                     AT(s->upper[node]));
			}
		}
		AT(s->lines[k]) = line;
	}
	WAIT;
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int k = 0; k < s->waterlines; k++)
		sum += AT(s->lines[k]);
	WAIT;
	return sum;
}

/* The state of a group: its part of the arrays, and SEARCH_STATE_NUMBERS to work in. */
SHARED_FUNCTION search_state state_of(int stations, int waterlines, GLOBAL const scalar *stencils,
                                      GLOBAL const stored *arrays, GLOBAL const stored *settings,
                                      STATE stored *room)
{
	search_state s;
	s.stations = stations;
	s.waterlines = waterlines;
	s.stride = stations + 2;
	s.nodes = (stations + 2) * (waterlines + 2);
	s.along_x = stencils;
	s.along_z = stencils + stations * STENCIL_SIZE;
	s.third_x = s.along_z + waterlines * STENCIL_SIZE;
	s.third_z = s.third_x + stations * STENCIL_THIRD;
	s.y = room;
	s.base = room + s.nodes;
	s.trial = room + 2 * s.nodes;
	s.terms = room + 3 * s.nodes;
	s.found = room + 4 * s.nodes;
	s.ways = room + 5 * s.nodes;
	s.slopes = (STATE stored_slopes *)(room + (5 + GRID_WAYS - 1) * s.nodes);
	s.lines = room + SEARCH_STATE_COUNT * s.nodes;
	s.gathered = s.lines + waterlines;
	s.lower = arrays + SEARCH_ARRAY_LOWER * s.nodes;
	s.upper = arrays + SEARCH_ARRAY_UPPER * s.nodes;
	s.target = arrays + SEARCH_ARRAY_TARGET * s.nodes;
	s.bend = arrays + SEARCH_ARRAY_BEND * s.nodes;
	s.close = arrays + SEARCH_ARRAY_CLOSE * s.nodes;
	s.weights.along = AT(settings[SEARCH_SETTING_ALONG]);
	s.weights.across = AT(settings[SEARCH_SETTING_ACROSS]);
	s.weights.blunt = AT(settings[SEARCH_SETTING_BLUNT]);
	s.wide_probes = AT(settings[SEARCH_SETTING_WIDE_PROBES]);
	s.penalty = AT(settings[SEARCH_SETTING_PENALTY]);
	return s;
}

#endif
