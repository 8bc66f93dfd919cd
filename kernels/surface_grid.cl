/* Surfaces of one topology on a grid of parameters (Letcher 4.9): points, curvatures, or integrals.
 *
 * A work-group has one line (v fixed) of BATTEN_LANES surfaces, one a lane of `real`. It first takes
 * the net together along v, which leaves one row of poles with two derivatives, and then goes along
 * the line; its work-items share the samples. On a CPU: many lanes, one work-item. On a GPU: one lane,
 * many work-items. Every sum is worked in one fixed order by one work-item, so the shape does not
 * change a bit of the result; host/reference/surface_grid_body.h is the same in plain C.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES and those below. */
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/surface_layout.h"
#include "shared/surface_point.h"

#if !defined(SURFACE_OUTPUT)
#define SURFACE_OUTPUT SURFACE_OUTPUT_EVERYTHING
#define ORDER_U 4
#define ORDER_V 4
#define RATIONAL 1
#endif
#define DIMENSION (3 + RATIONAL)
#define WEIGHT (3 * RATIONAL) /* its place in a pole, or one that is there */
#define DERIVATIVES (SURFACE_OUTPUT == SURFACE_OUTPUT_POSITION ? 1 : 3)
#define VALUES                                                                                     \
	(SURFACE_OUTPUT == SURFACE_OUTPUT_POSITION    ? SURFACE_POSITION_COUNT                         \
	 : SURFACE_OUTPUT == SURFACE_OUTPUT_CURVATURE ? SURFACE_CURVATURE_COUNT                        \
	                                              : SURFACE_EVERYTHING_COUNT)

/* The loops over a basis are short, fixed and worth unrolling; the others are not. PoCL needs to be
 * told both. */
#define ROLLED _Pragma("unroll 1")
#define UNROLLED _Pragma("unroll")

/* One column of the net taken together along v: point, first and second derivative. */
static inline void collapse_column(global const real *poles, global const scalar *table,
                                   local real *pole)
{
	real sum[DERIVATIVES * DIMENSION];
	UNROLLED
	for (int n = 0; n < DERIVATIVES * DIMENSION; n++)
		sum[n] = SPREAD(LITERAL(0.0));
	UNROLLED
	for (int a = 0; a < ORDER_V; a++) {
		UNROLLED
		for (int c = 0; c < DIMENSION; c++) {
			const real given = poles[a * DIMENSION + c];
			UNROLLED
			for (int d = 0; d < DERIVATIVES; d++)
				sum[d * DIMENSION + c] = FUSED(SPREAD(table[d * ORDER_V + a]), given,
				                               sum[d * DIMENSION + c]);
		}
	}
	UNROLLED
	for (int n = 0; n < DERIVATIVES * DIMENSION; n++)
		pole[n] = sum[n];
}

static inline surface_triple triple_at(const local real *pole)
{
	const surface_triple t = { pole[0], pole[1], pole[2] };
	return t;
}

static inline surface_triple point_of(const local real *poles, global const scalar *table)
{
	surface_triple at = triple_zero();
	real weight = SPREAD(LITERAL(0.0));
	UNROLLED
	for (int b = 0; b < ORDER_U; b++) {
		const real value = SPREAD(table[b]);
		at = triple_add(value, triple_at(poles + b * DIMENSION), at);
		if (RATIONAL)
			weight = FUSED(value, poles[b * DIMENSION + WEIGHT], weight);
	}
	return RATIONAL ? surface_divide_at(at, weight) : at;
}

static inline surface_jet jet_of(const local real *poles, global const scalar *table)
{
	const surface_triple none = triple_zero();
	const real zero = SPREAD(LITERAL(0.0));
	surface_jet j = { none, none, none, none, none, none };
	surface_weight w = { zero, zero, zero, zero, zero, zero };
	UNROLLED
	for (int b = 0; b < ORDER_U; b++) {
		const local real *pole = poles + b * DERIVATIVES * DIMENSION;
		const real value = SPREAD(table[b]);
		const real slope = SPREAD(table[ORDER_U + b]);
		const real bend = SPREAD(table[2 * ORDER_U + b]);
		const surface_triple at = triple_at(pole);
		const surface_triple v = triple_at(pole + DIMENSION);
		j.at = triple_add(value, at, j.at);
		j.u = triple_add(slope, at, j.u);
		j.uu = triple_add(bend, at, j.uu);
		j.v = triple_add(value, v, j.v);
		j.uv = triple_add(slope, v, j.uv);
		j.vv = triple_add(value, triple_at(pole + 2 * DIMENSION), j.vv);
		if (RATIONAL) {
			const real at_w = pole[WEIGHT];
			const real v_w = pole[DIMENSION + WEIGHT];
			w.at = FUSED(value, at_w, w.at);
			w.u = FUSED(slope, at_w, w.u);
			w.uu = FUSED(bend, at_w, w.uu);
			w.v = FUSED(value, v_w, w.v);
			w.uv = FUSED(slope, v_w, w.uv);
			w.vv = FUSED(value, pole[2 * DIMENSION + WEIGHT], w.vv);
		}
	}
	return RATIONAL ? surface_divide(j, w) : j;
}

static inline void put_triple(global real *out, surface_triple t)
{
	out[0] = t.x;
	out[1] = t.y;
	out[2] = t.z;
}

static inline void put_everything(global real *out, surface_jet j, surface_shape s)
{
	const real spread = surface_spread_of(s);
	put_triple(out + SURFACE_AT, j.at);
	put_triple(out + SURFACE_BY_U, j.u);
	put_triple(out + SURFACE_BY_V, j.v);
	put_triple(out + SURFACE_BY_UU, j.uu);
	put_triple(out + SURFACE_BY_UV, j.uv);
	put_triple(out + SURFACE_BY_VV, j.vv);
	out[SURFACE_FIRST_UU] = s.first_uu;
	out[SURFACE_FIRST_UV] = s.first_uv;
	out[SURFACE_FIRST_VV] = s.first_vv;
	out[SURFACE_AREA] = s.area;
	put_triple(out + SURFACE_NORMAL, s.normal);
	out[SURFACE_SECOND_UU] = s.second_uu;
	out[SURFACE_SECOND_UV] = s.second_uv;
	out[SURFACE_SECOND_VV] = s.second_vv;
	out[SURFACE_GAUSS] = s.gauss;
	out[SURFACE_MEAN] = surface_mark(s);
	out[SURFACE_K1] = s.mean + spread;
	out[SURFACE_K2] = s.mean - spread;
	out[SURFACE_BENDING] = s.bending;
}

/* One sample of a line: its values to out, or what it adds to the sums. */
static inline void work_sample(const local real *poles, global const scalar *table, real least_area,
                               global real *out, surface_sums *sums)
{
	if (SURFACE_OUTPUT == SURFACE_OUTPUT_POSITION) {
		put_triple(out, point_of(poles, table));
		return;
	}
	const surface_jet j = jet_of(poles, table);
	const surface_shape s = surface_shape_of(j, least_area);
	if (SURFACE_OUTPUT == SURFACE_OUTPUT_CURVATURE) {
		out[0] = s.gauss;
		out[1] = surface_mark(s);
	} else if (SURFACE_OUTPUT == SURFACE_OUTPUT_EVERYTHING) {
		put_everything(out, j, s);
	} else {
		surface_sums_add(sums, s, table[3 * ORDER_U]);
	}
}

/* The sums of all segments, in their order. */
static inline void gather(const local real *gathered, int segments, global real *out)
{
	ROLLED
	for (int v = (int)get_local_id(0); v < SURFACE_SUM_COUNT; v += (int)get_local_size(0)) {
		real sum = SPREAD(LITERAL(0.0));
		ROLLED
		for (int s = 0; s < segments; s++)
			sum += gathered[s * SURFACE_SUM_COUNT + v];
		out[v] = sum;
	}
}

/* The lines first_line, first_line + 1 ... of the blocks first_block, first_block + 1 ...
 * first_v, first_u: the first pole each line and each sample of a line sees. tables:
 * SURFACE_TABLE_SIZE a line, a sample. nets [block][columns][column_length][DIMENSION], least_areas
 * [block], all of real. There are segments times segment_length samples: a segment is summed by one
 * work-item. out: [block][lines][samples][VALUES], or [block][lines][SURFACE_SUM_COUNT] of sums, both
 * counted from the first. row: DERIVATIVES * DIMENSION reals a column of the net. gathered:
 * SURFACE_SUM_COUNT reals a segment where there are sums, else one. */
kernel void surface_grid(int first_block, int first_line, int lines, int segments,
                         int segment_length, int columns, int column_length,
                         global const int *first_v, global const int *first_u,
                         global const scalar *table_v, global const scalar *table_u,
                         global const real *nets, global const real *least_areas, global real *out,
                         local real *row, local real *gathered)
{
	const size_t block = (size_t)first_block + get_group_id(0) / (size_t)lines;
	const int line = first_line + (int)(get_group_id(0) % (size_t)lines);
	const size_t samples = (size_t)segments * (size_t)segment_length;
	const real least_area = least_areas[block];
	nets += (block * (size_t)columns * (size_t)column_length + (size_t)first_v[line]) * DIMENSION;
	table_v += line * SURFACE_TABLE_SIZE(ORDER_V);
	ROLLED
	for (int i = (int)get_local_id(0); i < columns; i += (int)get_local_size(0))
		collapse_column(nets + (size_t)i * (size_t)column_length * DIMENSION, table_v,
		                row + i * DERIVATIVES * DIMENSION);
	barrier(CLK_LOCAL_MEM_FENCE);

	const bool sums_up = SURFACE_OUTPUT == SURFACE_OUTPUT_ENERGY;
	out += get_group_id(0) * (sums_up ? SURFACE_SUM_COUNT : samples * VALUES);
	const real zero = SPREAD(LITERAL(0.0));
	ROLLED
	for (int s = (int)get_local_id(0); s < segments; s += (int)get_local_size(0)) {
		surface_sums sums = { zero, zero, zero, zero, zero };
		ROLLED
		for (int n = s * segment_length; n < (s + 1) * segment_length; n++)
			work_sample(row + first_u[n] * DERIVATIVES * DIMENSION,
			            table_u + n * SURFACE_TABLE_SIZE(ORDER_U), least_area,
			            out + (sums_up ? 0 : (size_t)n * VALUES), &sums);
		if (sums_up) {
			local real *mine = gathered + s * SURFACE_SUM_COUNT;
			mine[SURFACE_SUM_BENDING] = sums.bending;
			mine[SURFACE_SUM_MEAN] = sums.mean;
			mine[SURFACE_SUM_GAUSS] = sums.gauss;
			mine[SURFACE_SUM_AREA] = sums.area;
			mine[SURFACE_SUM_SINGULAR] = sums.singular;
		}
	}
	if (sums_up) {
		barrier(CLK_LOCAL_MEM_FENCE);
		gather(gathered, segments, out);
	}
}
