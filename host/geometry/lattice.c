/* A B-spline solid as displacements over a box (Letcher 7, equation 46). */
#include "geometry/bspline.h"

#include <math.h>
#include <string.h>

enum { POLES_MOST = 64 };

/* Largest displacement of a pole. */
#define SHIFT_LARGEST_M 1e6

struct batten_lattice {
	batten_context *context;
	double from_m[3], to_m[3];
	size_t count[3], order[3];
	double *knots[3]; /* clamped, 0..1 */
	double *shift_m;  /* [count z][count y][count x][3] */
};

static batten_status check(batten_context *context, const batten_lattice_net *net)
{
	static const char axes[] = "xyz";
	for (size_t c = 0; c < 3; c++) {
		const size_t order = net->order[c], count = net->count[c];
		if (order < BSPLINE_ORDER_LEAST || order > BSPLINE_ORDER_MOST || count < order ||
		    count > POLES_MOST)
			return batten_fail(context, BATTEN_USAGE,
			                   "lattice along %c: order %zu and %zu poles, expected order %d to %d "
			                   "and as many poles at least, %d at most",
			                   axes[c], order, count, BSPLINE_ORDER_LEAST, BSPLINE_ORDER_MOST,
			                   POLES_MOST);
		const double from = net->from_m[c], to = net->to_m[c];
		if (!(fabs(from) <= SHIFT_LARGEST_M && fabs(to) <= SHIFT_LARGEST_M && to - from >= 1e-9))
			return batten_fail(context, BATTEN_USAGE,
			                   "lattice along %c: from %g to %g m, expected a range within %g m",
			                   axes[c], from, to, SHIFT_LARGEST_M);
	}
	const size_t poles = net->count[0] * net->count[1] * net->count[2];
	for (size_t i = 0; i < 3 * poles; i++)
		if (!(fabs(net->shift_m[i]) <= SHIFT_LARGEST_M))
			return batten_fail(
				context, BATTEN_USAGE,
				"lattice: pole %zu,%zu,%zu moves by %g m along %c, expected %g at most",
				i / 3 % net->count[0], i / 3 / net->count[0] % net->count[1],
				i / 3 / net->count[0] / net->count[1], net->shift_m[i], axes[i % 3],
				SHIFT_LARGEST_M);
	return BATTEN_OK;
}

batten_status batten_lattice_create(batten_context *context, const batten_lattice_net *net,
                                    batten_lattice **out)
{
	*out = NULL;
	if (!net->shift_m)
		return batten_fail(context, BATTEN_USAGE, "lattice: no displacements");
	batten_status status = check(context, net);
	if (status != BATTEN_OK)
		return status;
	struct batten_lattice *lattice = batten_allocate(context, 1, sizeof *lattice);
	if (!lattice)
		return BATTEN_MEMORY;
	lattice->context = context;
	const size_t numbers = 3 * net->count[0] * net->count[1] * net->count[2];
	lattice->shift_m = batten_allocate(context, numbers, sizeof *lattice->shift_m);
	bool good = lattice->shift_m != NULL;
	for (size_t c = 0; c < 3; c++) {
		lattice->from_m[c] = net->from_m[c];
		lattice->to_m[c] = net->to_m[c];
		lattice->count[c] = net->count[c];
		lattice->order[c] = net->order[c];
		lattice->knots[c] = batten_allocate(context, net->count[c] + net->order[c], sizeof(double));
		good = good && lattice->knots[c];
	}
	if (!good) {
		batten_lattice_destroy(lattice);
		return BATTEN_MEMORY;
	}
	for (size_t c = 0; c < 3; c++)
		bspline_knots_clamped(net->order[c], net->count[c], lattice->knots[c]);
	memcpy(lattice->shift_m, net->shift_m, numbers * sizeof *lattice->shift_m);
	*out = lattice;
	return BATTEN_OK;
}

void batten_lattice_destroy(batten_lattice *lattice)
{
	if (!lattice)
		return;
	for (size_t c = 0; c < 3; c++)
		batten_release(lattice->context, lattice->knots[c]);
	batten_release(lattice->context, lattice->shift_m);
	batten_release(lattice->context, lattice);
}

void batten_lattice_shift(const batten_lattice *lattice, const double place_m[3], double shift_m[3])
{
	double values[3][BSPLINE_ORDER_MOST] = { { 0 } };
	size_t first[3];
	for (size_t c = 0; c < 3; c++) {
		const double part = (place_m[c] - lattice->from_m[c]) /
		                    (lattice->to_m[c] - lattice->from_m[c]);
		const double t = fmin(fmax(part, 0), 1);
		const size_t order = lattice->order[c];
		const size_t span = bspline_span(order, lattice->count[c], lattice->knots[c], t);
		bspline_basis(order, lattice->knots[c], span, t, values[c]);
		first[c] = span + 1 - order;
	}
	shift_m[0] = shift_m[1] = shift_m[2] = 0;
	for (size_t k = 0; k < lattice->order[2]; k++)
		for (size_t j = 0; j < lattice->order[1]; j++) {
			const double weight = values[2][k] * values[1][j];
			const size_t row = (first[2] + k) * lattice->count[1] + first[1] + j;
			const double *pole = lattice->shift_m + 3 * (row * lattice->count[0] + first[0]);
			for (size_t i = 0; i < lattice->order[0]; i++, pole += 3)
				for (size_t c = 0; c < 3; c++)
					shift_m[c] += weight * values[0][i] * pole[c];
		}
}
