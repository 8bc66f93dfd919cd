/* Body of c_vectors_f64_peer.c and _f32_peer.c, which define BATTEN_DOUBLE, OUT_DOUBLE and PRECISION. No
 * include guard, on purpose. */
#include "c_vectors_peer.h"

#include <stdlib.h>

#include "c_vectors.h"

#define SURFACE_OUTPUT SURFACE_OUTPUT_CURVATURE
#define ORDER_U 4
#define ORDER_V 4
#define RATIONAL 0
#include "surface_grid.cl"

struct c_vectors {
	size_t groups, columns, column_length, lines, samples;
	int *first_u, *first_v, *missing;
	scalar *table_u, *table_v;
	real *nets, *least_areas, *row;
};

/* A derivative of basis function i of order k (Cox and de Boor; Letcher 3.7), 0/0 = 0. */
static double basis(const double *knots, size_t i, size_t k, size_t derivative, double t, bool end)
{
	if (k == 1)
		return (knots[i] <= t && t < knots[i + 1]) || (end && t == knots[i + 1]) ? 1.0 : 0.0;
	const double before = knots[i + k - 1] - knots[i];
	const double after = knots[i + k] - knots[i + 1];
	const double lower = before > 0.0
	                         ? basis(knots, i, k - 1, derivative ? derivative - 1 : 0, t, end)
	                         : 0.0;
	const double upper = after > 0.0
	                         ? basis(knots, i + 1, k - 1, derivative ? derivative - 1 : 0, t, end)
	                         : 0.0;
	const double one = derivative ? (double)(k - 1) : t - knots[i];
	const double other = derivative ? -(double)(k - 1) : knots[i + k] - t;
	return (before > 0.0 ? one / before * lower : 0.0) +
	       (after > 0.0 ? other / after * upper : 0.0);
}

static void fill_table(const double *knots, size_t poles, size_t count, const double *at,
                       int *first, scalar *table)
{
	for (size_t n = 0; n < count; n++) {
		size_t span = ORDER_U - 1;
		while (span + 1 < poles && at[n] >= knots[span + 1])
			span++;
		first[n] = (int)(span - (ORDER_U - 1));
		for (size_t d = 0; d < 3; d++)
			for (size_t b = 0; b < ORDER_U; b++)
				table[n * TABLE_SIZE(ORDER_U) + d * ORDER_U + b] = (scalar)basis(
					knots, (size_t)first[n] + b, ORDER_U, d, at[n], span + 1 == poles);
	}
}

static void *zeroed(size_t count, size_t size)
{
	const size_t bytes = (count * size + 63) / 64 * 64;
	void *memory = aligned_alloc(64, bytes);
	if (memory)
		memset(memory, 0, bytes);
	return memory;
}

C_VECTORS_EXPORT void PRECISION(c_vectors_close)(c_vectors *work)
{
	void *all[] = { work->first_u, work->first_v, work->missing,     work->table_u,
		            work->table_v, work->nets,    work->least_areas, work->row };
	for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
		free(all[i]);
	free(work);
}

C_VECTORS_EXPORT c_vectors *PRECISION(c_vectors_open)(size_t count, const batten_surface_net *nets,
                                                      const batten_surface_samples *samples)
{
	if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq"))
		return NULL;
	c_vectors *w = calloc(1, sizeof *w);
	if (!w)
		return NULL;
	w->groups = count / BATTEN_LANES;
	w->columns = nets->count_u;
	w->column_length = nets->count_v;
	w->samples = samples->u_count;
	w->lines = samples->v_count;
	w->first_u = zeroed(w->samples, sizeof(int));
	w->first_v = zeroed(w->lines, sizeof(int));
	w->missing = zeroed(w->lines * w->groups, sizeof(int));
	w->table_u = zeroed(w->samples * TABLE_SIZE(ORDER_U), sizeof(scalar));
	w->table_v = zeroed(w->lines * TABLE_SIZE(ORDER_V), sizeof(scalar));
	w->nets = zeroed(w->groups * w->columns * w->column_length * 3, sizeof(real));
	w->least_areas = zeroed(w->groups, sizeof(real));
	w->row = zeroed(w->columns * DERIVATIVES * 3, sizeof(real));
	if (!w->first_u || !w->first_v || !w->missing || !w->table_u || !w->table_v || !w->nets ||
	    !w->least_areas || !w->row) {
		PRECISION(c_vectors_close)(w);
		return NULL;
	}
	fill_table(nets->knots_u, w->columns, w->samples, samples->u, w->first_u, w->table_u);
	fill_table(nets->knots_v, w->column_length, w->lines, samples->v, w->first_v, w->table_v);
	scalar *to = (scalar *)w->nets;
	for (size_t g = 0; g < w->groups; g++)
		for (size_t i = 0; i < w->columns; i++)
			for (size_t k = 0; k < w->column_length; k++)
				for (size_t c = 0; c < 3; c++)
					for (size_t l = 0; l < BATTEN_LANES; l++)
						*to++ = (scalar)nets[g * BATTEN_LANES + l]
						            .poles_m[3 * (k * w->columns + i) + c];
	return w;
}

C_VECTORS_EXPORT void PRECISION(c_vectors_run)(c_vectors *w, void *values)
{
	real gathered[1];
	for (work_group = 0; work_group < w->groups * w->lines; work_group++)
		surface_grid(0, 0, (int)w->lines, (int)(w->groups * BATTEN_LANES), (int)w->samples, 1,
		             (int)w->columns, (int)w->column_length, LITERAL(0.0), LITERAL(1.0),
		             LITERAL(0.0), w->first_v, w->first_u, w->table_v, w->table_u, w->nets,
		             w->least_areas, values, NULL, w->missing, w->row, gathered);
}
