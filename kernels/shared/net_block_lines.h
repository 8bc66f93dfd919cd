/* Lines of samples in the block search over a net: the state of a search, derivatives line by line, the objective
 * and the probes.
 *
 * Defined before this is included: NET_FAIRNESS, NET_ORDER_U, NET_ORDER_V, NET_POINTS_U, NET_POINTS_V (samples a
 * span); constants in OpenCL, in C they may look into `s`, the state at hand. */
#ifndef BATTEN_SHARED_NET_BLOCK_LINES_H
#define BATTEN_SHARED_NET_BLOCK_LINES_H

#include "net_block_probes.h"
#include "surface_layout.h"

#if BATTEN_DOUBLE
#define NET_BLOCK_ANGLE LITERAL(SURFACE_ANGLE_F64)
#else
#define NET_BLOCK_ANGLE LITERAL(SURFACE_ANGLE_F32)
#endif

#define NET_BLOCK_BENDS (NET_FAIRNESS == NET_FAIRNESS_BENDING)

typedef struct block_state {
	int lines, length, nodes; /* poles: columns, those of one, all */
	int count_u, count_v;     /* samples */
	int band, slots, followers;
	int fairness, order_u, order_v, points_u, points_v; /* of the C path */
	GLOBAL const int *first_u, *first_v;                /* the first pole a sample sees */
	GLOBAL const int *follower;             /* a pole and the one it goes with, in turn */
	GLOBAL const scalar *table_u, *table_v; /* NET_TABLE_SIZE a sample */
	STATE stored *arrays;                   /* [BLOCK_STATE_COUNT][nodes] */
	STATE stored *samples;                  /* [count_v][count_u][NET_BLOCK_SAMPLE] */
	STATE stored *rows;                     /* [nodes][band] */
	STATE stored *bottom;                   /* [nodes]: slopes along the poles, the way */
	STATE stored *work;                     /* [slots][NET_BLOCK_LINE_NUMBERS] */
	STATE stored *sums;                     /* [BLOCK_SUM_COUNT][lines] */
	LOCAL int *vote;
	STATE stored *terms; /* of the objective, a line of samples each */
} block_state;

SHARED_FUNCTION STATE stored *block_array(const block_state *s, int array)
{
	return s->arrays + array * s->nodes;
}

#include "block_rows.h"

/* What is worked of a line of samples. */
typedef struct net_line {
	STATE stored *columns; /* [lines][3]: taken together along v, with two derivatives */
	STATE stored *probes;  /* [NET_POINTS_U][NET_BLOCK_PROBED] */
	STATE stored *span;    /* [NET_POINTS_U][NET_ORDER_U][NET_BLOCK_COLUMN_SIZE] */
	STATE stored *slopes;  /* [lines][3]: along columns, their first and second derivatives by v */
	STATE stored *pairs;   /* [lines][NET_ORDER_U][9] */
} net_line;

SHARED_FUNCTION net_line net_line_of(const block_state *s, int slot)
{
	net_line line;
	line.columns = s->work + slot * NET_BLOCK_LINE_NUMBERS(s->lines, NET_ORDER_U, NET_POINTS_U);
	line.probes = line.columns + 3 * s->lines;
	line.span = line.probes + NET_BLOCK_PROBED * NET_POINTS_U;
	line.slopes = line.span + NET_BLOCK_COLUMN_SIZE * (NET_POINTS_U * NET_ORDER_U);
	line.pairs = line.slopes + 3 * s->lines;
	return line;
}

SHARED_FUNCTION STATE stored *net_sample(const block_state *s, int line, int sample)
{
	return s->samples + (line * s->count_u + sample) * NET_BLOCK_SAMPLE;
}

/* Takes the net y together along v for a line of samples. */
SHARED_FUNCTION void net_collapse_line(const block_state *s, const STATE stored *y, int line,
                                       STATE stored *columns)
{
	const real zero = SPREAD(LITERAL(0.0));
	GLOBAL const scalar *table = s->table_v + line * NET_TABLE_SIZE(NET_ORDER_V);
	const STATE stored *poles = y + s->first_v[line];
	ROLLED
	for (int i = 0; i < s->lines; i++) {
		real value = zero, once = zero, twice = zero;
		UNROLLED
		for (int k = 0; k < NET_ORDER_V; k++) {
			const real pole = AT(poles[i * s->length + k]);
			value = FUSED(SPREAD(table[k]), pole, value);
			once = FUSED(SPREAD(table[NET_ORDER_V + k]), pole, once);
			twice = FUSED(SPREAD(table[2 * NET_ORDER_V + k]), pole, twice);
		}
		AT(columns[3 * i]) = value;
		AT(columns[3 * i + 1]) = once;
		AT(columns[3 * i + 2]) = twice;
	}
}

/* The derivatives at a sample of the line. */
SHARED_FUNCTION net_way net_way_at(const block_state *s, const STATE stored *columns, int sample)
{
	const real zero = SPREAD(LITERAL(0.0));
	GLOBAL const scalar *table = s->table_u + sample * NET_TABLE_SIZE(NET_ORDER_U);
	const STATE stored *column = columns + 3 * s->first_u[sample];
	net_way way = { zero, zero, zero, zero, zero, zero };
	UNROLLED
	for (int i = 0; i < NET_ORDER_U; i++) {
		const real t0 = SPREAD(table[i]);
		const real t1 = SPREAD(table[NET_ORDER_U + i]);
		const real t2 = SPREAD(table[2 * NET_ORDER_U + i]);
		way.at = FUSED(t0, AT(column[3 * i]), way.at);
		way.u = FUSED(t1, AT(column[3 * i]), way.u);
		way.uu = FUSED(t2, AT(column[3 * i]), way.uu);
		way.v = FUSED(t0, AT(column[3 * i + 1]), way.v);
		way.uv = FUSED(t1, AT(column[3 * i + 1]), way.uv);
		way.vv = FUSED(t0, AT(column[3 * i + 2]), way.vv);
	}
	return way;
}

/* ------------------------------------------------------------------------------------------------
 * Samples
 * --------------------------------------------------------------------------------------------- */

/* What of a sample x and z decide. */
SHARED_FUNCTION void net_place_sample(STATE stored *sample, net_way x, net_way z)
{
	AT(sample[NET_BLOCK_XU]) = x.u;
	AT(sample[NET_BLOCK_XV]) = x.v;
	AT(sample[NET_BLOCK_ZU]) = z.u;
	AT(sample[NET_BLOCK_ZV]) = z.v;
	AT(sample[NET_BLOCK_UU]) = FUSED(x.v, z.uu, -(z.v * x.uu));
	AT(sample[NET_BLOCK_UU + 1]) = FUSED(z.u, x.uu, -(x.u * z.uu));
	AT(sample[NET_BLOCK_UV]) = FUSED(x.v, z.uv, -(z.v * x.uv));
	AT(sample[NET_BLOCK_UV + 1]) = FUSED(z.u, x.uv, -(x.u * z.uv));
	AT(sample[NET_BLOCK_VV]) = FUSED(x.v, z.vv, -(z.v * x.vv));
	AT(sample[NET_BLOCK_VV + 1]) = FUSED(z.u, x.vv, -(x.u * z.vv));
}

/* What the target decides of it, and where the search begins: whether there is a normal. */
SHARED_FUNCTION void net_weigh_sample(STATE stored *sample, net_way target, net_way start,
                                      mask fresh, real root, real close)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real angle = SPREAD(NET_BLOCK_ANGLE * NET_BLOCK_ANGLE);
	AT(sample[NET_BLOCK_TARGET]) = target.u;
	AT(sample[NET_BLOCK_TARGET + 1]) = target.v;
	AT(sample[NET_BLOCK_TARGET + 2]) = target.uu;
	AT(sample[NET_BLOCK_TARGET + 3]) = target.uv;
	AT(sample[NET_BLOCK_TARGET + 4]) = target.vv;
	const net_metric m = net_metric_of(sample, target.u + start.u, target.v + start.v);
	const mask regular = m.square > angle * (m.uu * m.vv);
	const real flat = CHOOSE(m.n_y < zero, -m.n_y, m.n_y);
	AT(sample[NET_BLOCK_ROOT]) = CHOOSE(fresh, CHOOSE(regular, root, zero),
	                                    AT(sample[NET_BLOCK_ROOT]));
	AT(sample[NET_BLOCK_CLOSE]) = close * flat;
}

/* The samples of searches that have just come into their lanes; those of others are found again, to the bit. */
SHARED_FUNCTION void block_arrive(const block_state *s, int begun, mask fresh, real fair,
                                  real close)
{
	const int lines = begun ? s->count_v : 0;
	const real root = SQUARE_ROOT(fair + fair);
	ROLLED
	for (int line = WORK_ITEM; line < lines; line += WORK_ITEMS) {
		/* Four nets in the place of one: there are no pairs yet. */
		const net_line room = net_line_of(s, line % s->slots);
		STATE stored *x = room.columns, *z = room.slopes;
		STATE stored *target = room.pairs, *start = target + 3 * s->lines;
		const scalar along_v = s->table_v[(line + 1) * NET_TABLE_SIZE(NET_ORDER_V) - 1];
		net_collapse_line(s, block_array(s, BLOCK_INPUT_X), line, x);
		net_collapse_line(s, block_array(s, BLOCK_INPUT_Z), line, z);
		net_collapse_line(s, block_array(s, BLOCK_INPUT_TARGET), line, target);
		net_collapse_line(s, block_array(s, BLOCK_INPUT_START), line, start);
		ROLLED
		for (int i = 0; i < s->count_u; i++) {
			STATE stored *sample = net_sample(s, line, i);
			const scalar area = s->table_u[(i + 1) * NET_TABLE_SIZE(NET_ORDER_U) - 1] * along_v;
			net_place_sample(sample, net_way_at(s, x, i), net_way_at(s, z, i));
			net_weigh_sample(sample, net_way_at(s, target, i), net_way_at(s, start, i), fresh,
			                 root * SPREAD(SQUARE_ROOT(area)), close * SPREAD(area));
		}
	}
	WAIT;
}

/* ------------------------------------------------------------------------------------------------
 * The objective and the probes
 * --------------------------------------------------------------------------------------------- */

/* The objective of a line with the net y. */
SHARED_FUNCTION real net_line_objective(const block_state *s, const STATE stored *y, int line)
{
	STATE stored *columns = net_line_of(s, line % s->slots).columns;
	real sum = SPREAD(LITERAL(0.0));
	net_collapse_line(s, y, line, columns);
	ROLLED
	for (int i = 0; i < s->count_u; i++) {
		const STATE stored *sample = net_sample(s, line, i);
		const net_forms forms = net_forms_of(sample, net_way_at(s, columns, i), NET_BLOCK_BENDS);
		sum += net_forms_objective(sample, &forms);
	}
	return sum;
}

/* Probes a sample; what y_u and y_v change counts `part`. Returns its part of the objective. */
SHARED_FUNCTION real net_probe_sample(const block_state *s, int line, int i, const net_ready *ready,
                                      real part, STATE stored *to)
{
	const STATE stored *sample = net_sample(s, line, i);
	const real close = AT(sample[NET_BLOCK_CLOSE]);
	const real at = ready->forms.at;
	const real energy = net_probe(sample, ready, part, to);
	AT(to[NET_BLOCK_CLOSE_SLOPE]) = (close + close) * at;
	AT(to[NET_BLOCK_CLOSE_CURVATURE]) = close + close;
	return FUSED(close * at, at, energy);
}

#endif
