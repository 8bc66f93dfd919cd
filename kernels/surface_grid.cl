/* Surfaces of one topology on a grid of parameters (Letcher 4.9): points, curvatures, or integrals.
 *
 * A work-group has one line (v fixed) of BATTEN_LANES surfaces, one a lane of `real`. It first takes
 * the net together along v, which leaves one row of poles with two derivatives, and then goes along
 * the line; its work-items share the samples. On a CPU: many lanes, one work-item. On a GPU: one lane,
 * many work-items. Every sum is worked in one fixed order by one work-item, so the shape does not
 * change a bit of the result; host/reference/surface_grid_body.h is the same in plain C.
 *
 * Samples are worked in runs of as many as there are lanes: first the forms of all with the root and
 * the division, then the curvatures of all, so that the long wait for a root is filled with the next
 * sample's sums; then a run's values, a square of numbers, are turned so that each surface's lie side
 * by side as the caller wants them. One work-item lets its first two and its last two runs overlap:
 * the samples of both are worked twice, but the runs between fill whole lines of the cache, whatever
 * the caller's address, and none is short.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES and those below. */
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/surface_layout.h"
#include "shared/surface_variation.h"
#include "shared/turn.h"

#if !defined(SURFACE_OUTPUT)
#define SURFACE_OUTPUT SURFACE_OUTPUT_EVERYTHING
#define ORDER_U 4
#define ORDER_V 4
#define RATIONAL 1
#define OUT_DOUBLE BATTEN_DOUBLE
#endif
#define DIMENSION (3 + RATIONAL)
#define DERIVATIVES SURFACE_DERIVATIVES(SURFACE_OUTPUT)
#define TABLE_SIZE(order) SURFACE_TABLE_SIZE(SURFACE_TABLE_ROWS(SURFACE_OUTPUT), order)
#define VALUES                                                                                     \
	(SURFACE_OUTPUT == SURFACE_OUTPUT_POSITION    ? SURFACE_POSITION_COUNT                         \
	 : SURFACE_OUTPUT == SURFACE_OUTPUT_CURVATURE ? SURFACE_CURVATURE_COUNT                        \
	                                              : SURFACE_EVERYTHING_COUNT)

/* One column of the net taken together along v: the point and its derivatives. */
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
			weight = FUSED(value, poles[b * DIMENSION + 3], weight);
	}
	return RATIONAL ? surface_divide_at(at, weight) : at;
}

/* The weight of a rational surface and its derivatives. */
static inline surface_weight weight_of(const local real *poles, global const scalar *table)
{
	const real zero = SPREAD(LITERAL(0.0));
	surface_weight w = { zero, zero, zero, zero, zero, zero };
	UNROLLED
	for (int b = 0; b < ORDER_U; b++) {
		const local real *pole = poles + b * DERIVATIVES * DIMENSION;
		const real value = SPREAD(table[b]);
		const real slope = SPREAD(table[ORDER_U + b]);
		const real bend = SPREAD(table[2 * ORDER_U + b]);
		const real at_w = pole[3];
		const real v_w = pole[DIMENSION + 3];
		w.at = FUSED(value, at_w, w.at);
		w.u = FUSED(slope, at_w, w.u);
		w.uu = FUSED(bend, at_w, w.uu);
		w.v = FUSED(value, v_w, w.v);
		w.uv = FUSED(slope, v_w, w.uv);
		w.vv = FUSED(value, pole[2 * DIMENSION + 3], w.vv);
	}
	return w;
}

static inline surface_jet jet_of(const local real *poles, global const scalar *table)
{
	const surface_triple none = triple_zero();
	surface_jet j = { none, none, none, none, none, none };
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
	}
	return RATIONAL ? surface_divide(j, weight_of(poles, table)) : j;
}

#if SURFACE_OUTPUT == SURFACE_OUTPUT_VARIATION
/* What the jet leaves out. */
static inline surface_third third_of(const local real *poles, global const scalar *table,
                                     surface_jet j)
{
	const surface_triple none = triple_zero();
	const real zero = SPREAD(LITERAL(0.0));
	surface_third t = { none, none, none, none };
	surface_weight_third w = { zero, zero, zero, zero };
	UNROLLED
	for (int b = 0; b < ORDER_U; b++) {
		const local real *pole = poles + b * DERIVATIVES * DIMENSION;
		const real value = SPREAD(table[b]);
		const real slope = SPREAD(table[ORDER_U + b]);
		const real bend = SPREAD(table[2 * ORDER_U + b]);
		const real turn = SPREAD(table[3 * ORDER_U + b]);
		t.uuu = triple_add(turn, triple_at(pole), t.uuu);
		t.uuv = triple_add(bend, triple_at(pole + DIMENSION), t.uuv);
		t.uvv = triple_add(slope, triple_at(pole + 2 * DIMENSION), t.uvv);
		t.vvv = triple_add(value, triple_at(pole + 3 * DIMENSION), t.vvv);
		if (RATIONAL) {
			w.uuu = FUSED(turn, pole[3], w.uuu);
			w.uuv = FUSED(bend, pole[DIMENSION + 3], w.uuv);
			w.uvv = FUSED(slope, pole[2 * DIMENSION + 3], w.uvv);
			w.vvv = FUSED(value, pole[3 * DIMENSION + 3], w.vvv);
		}
	}
	return RATIONAL ? surface_divide_third(t, weight_of(poles, table), w, j) : t;
}
#endif

/* Numbers as they are given back: doubles, or those of the precision. */
#if OUT_DOUBLE
#if !BATTEN_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define NUMBER_NAME double
#else
#define NUMBER_NAME float
#endif
#if BATTEN_LANES == 1
typedef NUMBER_NAME number, numbers;
#define CONVERT(a) ((number)(a))
#define STORE(a, to) (*(to) = (a))
#else
typedef NUMBER_NAME number;
typedef BATTEN_PASTE(NUMBER_NAME, BATTEN_LANES) numbers;
#define CONVERT(a) BATTEN_PASTE(convert_, BATTEN_PASTE(NUMBER_NAME, BATTEN_LANES))(a)
#define STORE(a, to) BATTEN_PASTE(vstore, BATTEN_LANES)(a, 0, to)
#endif

/* Where the values of a run go: those of surface s, value v, sample n lie at out + (s * VALUES + v) *
 * plane + n. */
typedef struct target {
	global number *out;
	size_t plane;
	int surfaces; /* how many of the lanes */
} target;

/* Gives back count samples of the run in tile [VALUES][BATTEN_LANES]. */
static inline void give_back(const real *tile, int count, target to)
{
	ROLLED
	for (int v = 0; v < VALUES; v++, to.out += to.plane) {
		const real *from = tile + v * BATTEN_LANES;
		if (count == BATTEN_LANES) {
			real square[BATTEN_LANES];
			UNROLLED
			for (int i = 0; i < BATTEN_LANES; i++)
				square[i] = from[i];
			turn(square);
			UNROLLED
			for (int s = 0; s < BATTEN_LANES; s++)
				if (s < to.surfaces)
					STORE(CONVERT(square[s]), to.out + (size_t)(s * VALUES) * to.plane);
		} else {
			ROLLED
			for (int i = 0; i < count * BATTEN_LANES; i++) {
				const int s = i % BATTEN_LANES;
				if (s < to.surfaces)
					to.out[(size_t)(s * VALUES) * to.plane + (size_t)(i / BATTEN_LANES)] =
						(number)((const scalar *)from)[i];
			}
		}
	}
}

/* One value of sample i of a run. */
#define PUT(value, a) tile[(value)*BATTEN_LANES + i] = (a)

static inline void put_triple(real *tile, int i, int value, surface_triple t)
{
	PUT(value, t.x);
	PUT(value + 1, t.y);
	PUT(value + 2, t.z);
}

static inline void put_everything(real *tile, int i, surface_jet j, surface_shape s,
                                  surface_triple light)
{
	const real spread = surface_spread_of(s);
	const surface_frame frame = surface_frame_of(j, s);
	const surface_directions d = surface_directions_of(frame, surface_rounding_of(j, s));
	const surface_sections k = surface_sections_of(frame);
	put_triple(tile, i, SURFACE_AT, j.at);
	put_triple(tile, i, SURFACE_BY_U, j.u);
	put_triple(tile, i, SURFACE_BY_V, j.v);
	put_triple(tile, i, SURFACE_BY_UU, j.uu);
	put_triple(tile, i, SURFACE_BY_UV, j.uv);
	put_triple(tile, i, SURFACE_BY_VV, j.vv);
	PUT(SURFACE_FIRST_UU, s.first_uu);
	PUT(SURFACE_FIRST_UV, s.first_uv);
	PUT(SURFACE_FIRST_VV, s.first_vv);
	PUT(SURFACE_AREA, s.area);
	put_triple(tile, i, SURFACE_NORMAL, s.normal);
	PUT(SURFACE_SECOND_UU, s.second_uu);
	PUT(SURFACE_SECOND_UV, s.second_uv);
	PUT(SURFACE_SECOND_VV, s.second_vv);
	PUT(SURFACE_GAUSS, s.gauss);
	PUT(SURFACE_MEAN, surface_mark(s));
	PUT(SURFACE_K1, s.mean + spread);
	PUT(SURFACE_K2, s.mean - spread);
	PUT(SURFACE_BENDING, s.bending);
	put_triple(tile, i, SURFACE_DIRECTION1, d.first);
	put_triple(tile, i, SURFACE_DIRECTION2, d.second);
	PUT(SURFACE_ALONG_X, k.along);
	PUT(SURFACE_ACROSS_X, k.across);
	PUT(SURFACE_ISOPHOTE, triple_inner(s.normal, light));
}

/* A line ready to be gone along. */
typedef struct line {
	const local real *row;
	global const int *first_u;
	global const scalar *table_u;
	real least_area;
	surface_triple light;
} line;

static inline surface_jet jet_at(line l, int n)
{
	return jet_of(l.row + l.first_u[n] * DERIVATIVES * DIMENSION,
	              l.table_u + n * TABLE_SIZE(ORDER_U));
}

/* The forms of count samples from number n. */
static inline void find_forms(line l, int n, int count, surface_forms *forms)
{
	ROLLED
	for (int i = 0; i < count; i++) {
		const surface_jet j = jet_at(l, n + i);
		forms[i] = surface_forms_of(j, triple_outer(j.v, j.u), l.least_area);
	}
}

/* The values of count samples from number n. missing grows to 1 in a lane without a normal. */
static inline void work_run(line l, int n, int count, real *tile, real *missing)
{
	const real one = SPREAD(LITERAL(1.0));
	if (SURFACE_OUTPUT == SURFACE_OUTPUT_CURVATURE) {
		surface_forms forms[BATTEN_LANES];
		find_forms(l, n, count, forms);
		ROLLED
		for (int i = 0; i < count; i++) {
			const surface_shape s = surface_shape_from(forms[i], triple_zero());
			*missing = CHOOSE(s.regular, *missing, one);
			PUT(0, s.gauss);
			PUT(1, surface_mark(s));
		}
		return;
	}
	ROLLED
	for (int i = 0; i < count; i++) {
		if (SURFACE_OUTPUT == SURFACE_OUTPUT_POSITION) {
			put_triple(tile, i, 0,
			           point_of(l.row + l.first_u[n + i] * DIMENSION,
			                    l.table_u + (n + i) * TABLE_SIZE(ORDER_U)));
			continue;
		}
		const surface_jet j = jet_at(l, n + i);
		const surface_shape s = surface_shape_of(j, l.least_area);
		*missing = CHOOSE(s.regular, *missing, one);
		put_everything(tile, i, j, s, l.light);
	}
}

/* Bytes that memory is written by at once. */
enum { CACHE_LINE = 64 };

/* Where the run after the one from n begins. */
static inline int run_after(int n, int samples, target to)
{
	const int last = samples - BATTEN_LANES;
	int next = n + (int)get_local_size(0) * BATTEN_LANES;
	if (BATTEN_LANES == 1 || get_local_size(0) > 1 || n >= last)
		return next;
	if (n == 0)
		next -= (int)((size_t)to.out % CACHE_LINE / sizeof(number)) % BATTEN_LANES;
	return next < last ? next : last;
}

/* All runs of a line that are this work-item's; whether a sample of them has no normal. */
static inline int work_line(line l, int samples, target to)
{
	real missing = SPREAD(LITERAL(0.0));
	ROLLED
	for (int n = (int)get_local_id(0) * BATTEN_LANES; n < samples; n = run_after(n, samples, to)) {
		const int left = samples - n;
		const int count = left < BATTEN_LANES ? left : BATTEN_LANES;
		target here = to;
		real tile[VALUES * BATTEN_LANES];
		here.out += n;
		work_run(l, n, count, tile, &missing);
		give_back(tile, count, here);
	}
	return ANY(missing != SPREAD(LITERAL(0.0))) ? 1 : 0;
}

/* The weight of sample n in an integral. */
static inline scalar weight_at(line l, int n)
{
	return l.table_u[(n + 1) * TABLE_SIZE(ORDER_U) - 1];
}

#if SURFACE_OUTPUT == SURFACE_OUTPUT_VARIATION
static inline void sum_samples(line l, int begin, int end, surface_sums *sums)
{
	ROLLED
	for (int n = begin; n < end; n++) {
		const local real *poles = l.row + l.first_u[n] * DERIVATIVES * DIMENSION;
		global const scalar *table = l.table_u + n * TABLE_SIZE(ORDER_U);
		const surface_jet j = jet_of(poles, table);
		const surface_shape s = surface_shape_of(j, l.least_area);
		const surface_third t = third_of(poles, table, j);
		surface_sums_add(sums, s, weight_at(l, n));
		surface_sums_add_variation(sums, s, surface_variation_of(j, t, s), weight_at(l, n));
	}
}
#else
static inline void sum_samples(line l, int begin, int end, surface_sums *sums)
{
	ROLLED
	for (int n = begin; n < end; n += BATTEN_LANES) {
		const int count = end - n < BATTEN_LANES ? end - n : BATTEN_LANES;
		surface_forms forms[BATTEN_LANES];
		find_forms(l, n, count, forms);
		ROLLED
		for (int i = 0; i < count; i++)
			surface_sums_add(sums, surface_shape_from(forms[i], triple_zero()),
			                 weight_at(l, n + i));
	}
}
#endif

/* What a segment of a line adds up. */
static inline void sum_segment(line l, int begin, int end, local real *out)
{
	surface_sums sums = surface_sums_zero();
	sum_samples(l, begin, end, &sums);
	out[SURFACE_SUM_BENDING] = sums.bending;
	out[SURFACE_SUM_MEAN] = sums.mean;
	out[SURFACE_SUM_GAUSS] = sums.gauss;
	out[SURFACE_SUM_AREA] = sums.area;
	out[SURFACE_SUM_SINGULAR] = sums.singular;
	out[SURFACE_SUM_VARIATION] = sums.variation;
	out[SURFACE_SUM_LEFT_OUT] = sums.left_out;
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

/* The lines first_line, first_line + 1 ... of the blocks first_block, first_block + 1 ...; the first
 * `surfaces` lanes of those blocks are surfaces to be given back.
 * light: a unit vector, for isophotes (Letcher 4.5).
 * first_v, first_u: the first pole each line and each sample of a line sees. tables:
 * TABLE_SIZE a line, a sample. nets [block][columns][column_length][DIMENSION], least_areas
 * [block], all of real. There are segments times segment_length samples: a segment is summed by one
 * work-item. values: [surface][VALUES][lines][samples], sums: [block][lines][SURFACE_SUM_COUNT] of
 * real, missing: [block][lines][work-items], 1 where a sample has no normal; all counted from the
 * first of the launch, and only what the output calls for is written. row: DERIVATIVES * DIMENSION
 * reals a column of the net. gathered: SURFACE_SUM_COUNT reals a segment where there are sums, else
 * one. */
kernel void surface_grid(int first_block, int first_line, int lines, int surfaces, int segments,
                         int segment_length, int columns, int column_length, scalar light_x,
                         scalar light_y, scalar light_z, global const int *first_v,
                         global const int *first_u, global const scalar *table_v,
                         global const scalar *table_u, global const real *nets,
                         global const real *least_areas, global number *values, global real *sums,
                         global int *missing, local real *row, local real *gathered)
{
	const size_t group = get_group_id(0);
	const size_t block = group / (size_t)lines;
	const size_t k = group % (size_t)lines;
	const int samples = segments * segment_length;
	nets += (((size_t)first_block + block) * (size_t)columns * (size_t)column_length +
	         (size_t)first_v[first_line + (int)k]) *
	        DIMENSION;
	table_v += (first_line + (int)k) * TABLE_SIZE(ORDER_V);
	ROLLED
	for (int i = (int)get_local_id(0); i < columns; i += (int)get_local_size(0))
		collapse_column(nets + (size_t)i * (size_t)column_length * DIMENSION, table_v,
		                row + i * DERIVATIVES * DIMENSION);
	barrier(CLK_LOCAL_MEM_FENCE);

	const surface_triple light = { SPREAD(light_x), SPREAD(light_y), SPREAD(light_z) };
	const line l = { row, first_u, table_u, least_areas[(size_t)first_block + block], light };
	if (SURFACE_SUMS(SURFACE_OUTPUT)) {
		ROLLED
		for (int s = (int)get_local_id(0); s < segments; s += (int)get_local_size(0))
			sum_segment(l, s * segment_length, (s + 1) * segment_length,
			            gathered + s * SURFACE_SUM_COUNT);
		barrier(CLK_LOCAL_MEM_FENCE);
		gather(gathered, segments, sums + group * SURFACE_SUM_COUNT);
	} else {
		const size_t first = block * BATTEN_LANES;
		const int left = surfaces - (int)first;
		const size_t plane = (size_t)lines * (size_t)samples;
		const target to = { values + first * VALUES * plane + k * (size_t)samples, plane,
			                left < BATTEN_LANES ? left : BATTEN_LANES };
		missing[group * get_local_size(0) + get_local_id(0)] = work_line(l, samples, to);
	}
}
