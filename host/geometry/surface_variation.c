#include "geometry/surface_variation.h"

#include "core/gauss.h"
#include "geometry/surface_quadrature.h"

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/surface_variation.h"

/* Gauss points and weights of one direction over -1..1. */
typedef struct rule {
	size_t count;
	double node[GAUSS_POINTS_MOST], weight[GAUSS_POINTS_MOST];
} rule;

static rule rule_of(size_t points, size_t order)
{
	rule made = { .count = points > 0 ? points : order + 1 };
	gauss_points(made.count, made.node, made.weight);
	return made;
}

static surface_triple triple_of(const double d[3])
{
	return (surface_triple){ d[0], d[1], d[2] };
}

static void add_point(const batten_surface *surface, double u, double v, double least_area,
                      double weight, surface_variation_sum *sum)
{
	batten_surface_point at;
	/* The parameters are finite: they lie between knots. */
	if (batten_surface_evaluate(surface, u, v, &at) != BATTEN_OK)
		return;
	const surface_jet jet = {
		.at = triple_of(at.derivative[0][0]),
		.u = triple_of(at.derivative[1][0]),
		.v = triple_of(at.derivative[0][1]),
		.uu = triple_of(at.derivative[2][0]),
		.uv = triple_of(at.derivative[1][1]),
		.vv = triple_of(at.derivative[0][2]),
	};
	const surface_third third = {
		.uuu = triple_of(at.derivative[3][0]),
		.uuv = triple_of(at.derivative[2][1]),
		.uvv = triple_of(at.derivative[1][2]),
		.vvv = triple_of(at.derivative[0][3]),
	};
	const surface_shape shape = surface_shape_of(jet, least_area);
	const surface_variation found = surface_variation_of(jet, third, shape);
	sum->per_m2 += weight * shape.area * found.density;
	sum->left_out += !found.known;
}

/* u and v: the first knot of the span, the second follows. */
static void add_span(const batten_surface *surface, const rule *along_u, const rule *along_v,
                     const double *u, const double *v, double least_area,
                     surface_variation_sum *sum)
{
	const double half_u = 0.5 * (u[1] - u[0]);
	const double half_v = 0.5 * (v[1] - v[0]);
	for (size_t j = 0; j < along_v->count; j++)
		for (size_t i = 0; i < along_u->count; i++)
			add_point(surface, u[0] + half_u * (1.0 + along_u->node[i]),
			          v[0] + half_v * (1.0 + along_v->node[j]), least_area,
			          half_u * along_u->weight[i] * (half_v * along_v->weight[j]), sum);
}

batten_status surface_variation_integrate(batten_context *context, const batten_surface *surface,
                                          size_t points, surface_variation_sum *out)
{
	if (points > GAUSS_POINTS_MOST)
		return batten_fail(context, BATTEN_USAGE,
		                   "%zu Gauss points a span: at most %d are expected", points,
		                   GAUSS_POINTS_MOST);
	const batten_surface_net net = batten_surface_describe(surface);
	const rule along_u = rule_of(points, net.order_u);
	const rule along_v = rule_of(points, net.order_v);
	const double least = SURFACE_ANGLE_F64 * surface_net_area(surface);
	surface_variation_sum sum = { 0 };
	for (size_t j = net.order_v - 1; j < net.count_v; j++)
		for (size_t i = net.order_u - 1; i < net.count_u; i++)
			if (net.knots_u[i] < net.knots_u[i + 1] && net.knots_v[j] < net.knots_v[j + 1])
				add_span(surface, &along_u, &along_v, net.knots_u + i, net.knots_v + j,
				         least * least, &sum);
	*out = sum;
	return BATTEN_OK;
}
