/* Body of host/reference/surface_grid_f64.c and _f32.c, compiled once per precision: the includer
 * defines BATTEN_DOUBLE and SURFACE_GRID_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#include "shared/dialect.h"
#include "shared/surface_layout.h"

#include "reference/inlined.h"
#include "shared/surface_variation.h"

INLINED int derivatives_of(const reference_surface_grid *shared)
{
	return SURFACE_DERIVATIVES(shared->output);
}

INLINED int table_size(const reference_surface_grid *shared, int order)
{
	return SURFACE_TABLE_SIZE(SURFACE_TABLE_ROWS(shared->output), order);
}

/* One column of the net taken together along v: the point and its derivatives. */
INLINED void collapse_column(const reference_surface_grid *shared, const scalar *poles,
                             const scalar *table, scalar *pole)
{
	const int dimension = 3 + shared->rational;
	const int derivatives = derivatives_of(shared);
	for (int n = 0; n < derivatives * dimension; n++)
		pole[n] = LITERAL(0.0);
	for (int a = 0; a < shared->order_v; a++)
		for (int c = 0; c < dimension; c++)
			for (int d = 0; d < derivatives; d++)
				pole[d * dimension + c] = FUSED(table[d * shared->order_v + a],
				                                poles[a * dimension + c], pole[d * dimension + c]);
}

INLINED surface_triple triple_at(const scalar *pole)
{
	const surface_triple t = { pole[0], pole[1], pole[2] };
	return t;
}

INLINED surface_triple point_of(const reference_surface_grid *shared, const scalar *poles,
                                const scalar *table)
{
	const int dimension = 3 + shared->rational;
	surface_triple at = triple_zero();
	scalar weight = LITERAL(0.0);
	for (int b = 0; b < shared->order_u; b++) {
		at = triple_add(table[b], triple_at(poles + b * dimension), at);
		if (shared->rational)
			weight = FUSED(table[b], poles[b * dimension + 3], weight);
	}
	return shared->rational ? surface_divide_at(at, weight) : at;
}

/* The weight of a rational surface and its derivatives. */
INLINED surface_weight weight_of(const reference_surface_grid *shared, const scalar *poles,
                                 const scalar *table)
{
	surface_weight w = { 0, 0, 0, 0, 0, 0 };
	for (int b = 0; b < shared->order_u; b++) {
		const scalar *pole = poles + b * derivatives_of(shared) * 4;
		const scalar value = table[b];
		const scalar slope = table[shared->order_u + b];
		const scalar bend = table[2 * shared->order_u + b];
		w.at = FUSED(value, pole[3], w.at);
		w.u = FUSED(slope, pole[3], w.u);
		w.uu = FUSED(bend, pole[3], w.uu);
		w.v = FUSED(value, pole[7], w.v);
		w.uv = FUSED(slope, pole[7], w.uv);
		w.vv = FUSED(value, pole[11], w.vv);
	}
	return w;
}

INLINED surface_jet jet_of(const reference_surface_grid *shared, const scalar *poles,
                           const scalar *table)
{
	const int dimension = 3 + shared->rational;
	const surface_triple none = triple_zero();
	surface_jet j = { none, none, none, none, none, none };
	for (int b = 0; b < shared->order_u; b++) {
		const scalar *pole = poles + b * derivatives_of(shared) * dimension;
		const scalar value = table[b];
		const scalar slope = table[shared->order_u + b];
		const scalar bend = table[2 * shared->order_u + b];
		const surface_triple at = triple_at(pole);
		const surface_triple v = triple_at(pole + dimension);
		j.at = triple_add(value, at, j.at);
		j.u = triple_add(slope, at, j.u);
		j.uu = triple_add(bend, at, j.uu);
		j.v = triple_add(value, v, j.v);
		j.uv = triple_add(slope, v, j.uv);
		j.vv = triple_add(value, triple_at(pole + 2 * dimension), j.vv);
	}
	return shared->rational ? surface_divide(j, weight_of(shared, poles, table)) : j;
}

/* What the jet leaves out; only with SURFACE_OUTPUT_VARIATION. */
INLINED surface_third third_of(const reference_surface_grid *shared, const scalar *poles,
                               const scalar *table, surface_jet j)
{
	const int dimension = 3 + shared->rational;
	const surface_triple none = triple_zero();
	surface_third t = { none, none, none, none };
	surface_weight_third w = { 0, 0, 0, 0 };
	for (int b = 0; b < shared->order_u; b++) {
		const scalar *pole = poles + b * 4 * dimension;
		const scalar value = table[b];
		const scalar slope = table[shared->order_u + b];
		const scalar bend = table[2 * shared->order_u + b];
		const scalar turn = table[3 * shared->order_u + b];
		t.uuu = triple_add(turn, triple_at(pole), t.uuu);
		t.uuv = triple_add(bend, triple_at(pole + dimension), t.uuv);
		t.uvv = triple_add(slope, triple_at(pole + 2 * dimension), t.uvv);
		t.vvv = triple_add(value, triple_at(pole + 3 * dimension), t.vvv);
		if (shared->rational) {
			w.uuu = FUSED(turn, pole[3], w.uuu);
			w.uuv = FUSED(bend, pole[dimension + 3], w.uuv);
			w.uvv = FUSED(slope, pole[2 * dimension + 3], w.uvv);
			w.vvv = FUSED(value, pole[3 * dimension + 3], w.vvv);
		}
	}
	return shared->rational ? surface_divide_third(t, weight_of(shared, poles, table), w, j) : t;
}

INLINED void put_triple(scalar *out, surface_triple t)
{
	out[0] = t.x;
	out[1] = t.y;
	out[2] = t.z;
}

INLINED void put_everything(scalar *out, surface_jet j, surface_shape s, surface_triple light)
{
	const scalar spread = surface_spread_of(s);
	const surface_frame frame = surface_frame_of(j, s);
	const surface_directions d = surface_directions_of(frame, surface_rounding_of(j, s));
	const surface_sections k = surface_sections_of(frame);
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
	put_triple(out + SURFACE_DIRECTION1, d.first);
	put_triple(out + SURFACE_DIRECTION2, d.second);
	out[SURFACE_ALONG_X] = k.along;
	out[SURFACE_ACROSS_X] = k.across;
	out[SURFACE_ISOPHOTE] = triple_inner(s.normal, light);
}

INLINED int values_of(int output)
{
	return output == SURFACE_OUTPUT_POSITION    ? (int)SURFACE_POSITION_COUNT
	       : output == SURFACE_OUTPUT_CURVATURE ? (int)SURFACE_CURVATURE_COUNT
	                                            : (int)SURFACE_EVERYTHING_COUNT;
}

/* The values of a line's samples. */
INLINED void work_line(const reference_surface_grid *shared, const scalar *row,
                       const scalar *table_u, scalar least_area, scalar *out)
{
	const int pole_size = derivatives_of(shared) * (3 + shared->rational);
	const int values = values_of(shared->output);
	const surface_triple light = { (scalar)shared->light[0], (scalar)shared->light[1],
		                           (scalar)shared->light[2] };
	for (int n = 0; n < shared->segments * shared->segment_length; n++) {
		const scalar *mine = row + shared->first_u[n] * pole_size;
		const scalar *table = table_u + n * table_size(shared, shared->order_u);
		scalar *to = out + (size_t)n * (size_t)values;
		if (shared->output == SURFACE_OUTPUT_POSITION) {
			put_triple(to, point_of(shared, mine, table));
			continue;
		}
		const surface_jet j = jet_of(shared, mine, table);
		const surface_shape s = surface_shape_of(j, least_area);
		if (shared->output == SURFACE_OUTPUT_EVERYTHING) {
			put_everything(to, j, s, light);
		} else {
			to[0] = s.gauss;
			to[1] = surface_mark(s);
		}
	}
}

/* The sums of a line: of each segment, then of the segments. */
INLINED void sum_line(const reference_surface_grid *shared, const scalar *row,
                      const scalar *table_u, scalar least_area, scalar *out)
{
	const int pole_size = derivatives_of(shared) * (3 + shared->rational);
	const int rows = SURFACE_TABLE_ROWS(shared->output);
	for (int u = 0; u < SURFACE_SUM_COUNT; u++)
		out[u] = LITERAL(0.0);
	for (int n = 0; n < shared->segments * shared->segment_length;) {
		surface_sums sums = surface_sums_zero();
		for (int end = n + shared->segment_length; n < end; n++) {
			const scalar *table = table_u + n * table_size(shared, shared->order_u);
			const scalar weight = table[rows * shared->order_u];
			const scalar *poles = row + shared->first_u[n] * pole_size;
			const surface_jet j = jet_of(shared, poles, table);
			const surface_shape s = surface_shape_of(j, least_area);
			surface_sums_add(&sums, s, weight);
			if (shared->output == SURFACE_OUTPUT_VARIATION)
				surface_sums_add_variation(
					&sums, s, surface_variation_of(j, third_of(shared, poles, table, j), s),
					weight);
		}
		out[SURFACE_SUM_BENDING] += sums.bending;
		out[SURFACE_SUM_MEAN] += sums.mean;
		out[SURFACE_SUM_GAUSS] += sums.gauss;
		out[SURFACE_SUM_AREA] += sums.area;
		out[SURFACE_SUM_SINGULAR] += sums.singular;
		out[SURFACE_SUM_VARIATION] += sums.variation;
		out[SURFACE_SUM_LEFT_OUT] += sums.left_out;
	}
}

INLINED void work_surface(const reference_surface_grid *shared, const scalar *table_v,
                          const scalar *table_u, const scalar *net, scalar least_area, scalar *out,
                          scalar *row)
{
	const size_t dimension = shared->rational ? 4 : 3;
	const size_t pole_size = dimension * (size_t)derivatives_of(shared);
	const size_t samples = (size_t)shared->segments * (size_t)shared->segment_length;
	const bool sums_up = SURFACE_SUMS(shared->output);
	const size_t line_size = sums_up ? SURFACE_SUM_COUNT
	                                 : samples * (size_t)values_of(shared->output);
	for (int k = 0; k < shared->lines; k++) {
		const scalar *table = table_v + k * table_size(shared, shared->order_v);
		const scalar *column = net + (size_t)shared->first_v[k] * dimension;
		for (size_t i = 0; i < (size_t)shared->columns; i++)
			collapse_column(shared, column + i * (size_t)shared->column_length * dimension, table,
			                row + i * pole_size);
		scalar *to = out + (size_t)k * line_size;
		if (sums_up)
			sum_line(shared, row, table_u, least_area, to);
		else
			work_line(shared, row, table_u, least_area, to);
	}
}

WITH_FMA_WHERE_THERE_IS(SURFACE_GRID_FUNCTION, work_surface,
                        (const reference_surface_grid *shared, const scalar *table_v,
                         const scalar *table_u, const scalar *net, scalar least_area, scalar *out,
                         scalar *scratch),
                        (shared, table_v, table_u, net, least_area, out, scratch))
