#include "batch/net_terms.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/surface_variation.h"

/* Of derivatives, in the order of net_patch. */
enum { D_U, D_V, D_UU, D_UV, D_VV, D_UUU, D_UUV, D_UVV, D_VVV };

void net_patch_of(const net_plan *plan, size_t line, size_t sample, net_patch *out)
{
	static const size_t by[NET_TERM_VARIABLES_MOST][2] = { { 1, 0 }, { 0, 1 }, { 2, 0 },
		                                                   { 1, 1 }, { 0, 2 }, { 3, 0 },
		                                                   { 2, 1 }, { 1, 2 }, { 0, 3 } };
	const size_t order_u = plan->u.order;
	const size_t order_v = plan->v.order;
	const double *u = plan->u.table + sample * NET_TABLE_SIZE(order_u);
	const double *v = plan->v.table + line * NET_TABLE_SIZE(order_v);
	out->variables = plan->fairness == NET_FAIRNESS_VARIATION ? NET_TERM_VARIABLES_MOST
	                                                          : NET_TERM_VARIABLES;
	out->count = 0;
	for (size_t k = 0; k < order_v; k++)
		for (size_t i = 0; i < order_u; i++) {
			const size_t n = out->count++;
			out->poles[n] = ((size_t)plan->v.first[line] + k) * plan->u.poles +
			                (size_t)plan->u.first[sample] + i;
			out->at[n] = u[i] * v[k];
			for (int d = 0; d < out->variables; d++)
				out->weight[d][n] = u[by[d][0] * order_u + i] * v[by[d][1] * order_v + k];
		}
}

typedef struct jet_vector {
	jet x, y, z;
} jet_vector;

/* Three numbers that often stand together. */
typedef struct jet_triple {
	jet uu, uv, vv;
} jet_triple;

static jet inner(const jet_vector *a, const jet_vector *b)
{
	return jet_add(jet_add(jet_multiply(a->x, b->x), jet_multiply(a->y, b->y)),
	               jet_multiply(a->z, b->z));
}

/* a b - c d */
static jet crossed(jet a, jet b, jet c, jet d)
{
	return jet_subtract(jet_multiply(a, b), jet_multiply(c, d));
}

static jet_vector outer(const jet_vector *a, const jet_vector *b)
{
	return (jet_vector){ crossed(a->y, b->z, a->z, b->y), crossed(a->z, b->x, a->x, b->z),
		                 crossed(a->x, b->y, a->y, b->x) };
}

/* The surface at a sample: derivatives of the position, and what the forms make of them. */
typedef struct net_forms {
	jet_vector d[NET_TERM_VARIABLES_MOST];
	jet_vector normal; /* x_v x x_u over its length */
	jet_triple first, second;
	jet square, area; /* E G - F^2 = (dA / (du dv))^2 */
} net_forms;

static void read_vectors(const double *sample, const double *way, int variables, net_forms *f)
{
	for (int d = 0; d < variables; d++) {
		const bool third = d >= NET_TERM_VARIABLES;
		const int n = third ? d - NET_TERM_VARIABLES : d;
		const int x = third ? NET_SAMPLE_X_THIRD : NET_SAMPLE_X;
		const int z = third ? NET_SAMPLE_Z_THIRD : NET_SAMPLE_Z;
		const int target = third ? NET_SAMPLE_TARGET_THIRD : NET_SAMPLE_TARGET;
		f->d[d] = (jet_vector){ jet_constant(sample[x + n]),
			                    jet_variable(sample[target + n] + way[d], d, variables),
			                    jet_constant(sample[z + n]) };
	}
}

static void find_forms(net_forms *f)
{
	f->first = (jet_triple){ inner(&f->d[D_U], &f->d[D_U]), inner(&f->d[D_U], &f->d[D_V]),
		                     inner(&f->d[D_V], &f->d[D_V]) };
	f->square = crossed(f->first.uu, f->first.vv, f->first.uv, f->first.uv);
	f->area = jet_root(f->square);
	const jet inverse = jet_inverse(f->area);
	const jet_vector normal = outer(&f->d[D_V], &f->d[D_U]);
	f->normal = (jet_vector){ jet_multiply(normal.x, inverse), jet_multiply(normal.y, inverse),
		                      jet_multiply(normal.z, inverse) };
	f->second = (jet_triple){ inner(&f->normal, &f->d[D_UU]), inner(&f->normal, &f->d[D_UV]),
		                      inner(&f->normal, &f->d[D_VV]) };
}

/* Bending, mean or Gauss, by the entries of the shape operator I^-1 II: k1^2 + k2^2 is the trace of its
 * square, 2 H its trace, K its determinant. */
static jet fairness_of(int fairness, const net_forms *f, double rounding)
{
	const jet inverse = jet_inverse(f->square);
	const jet_triple *i = &f->first;
	const jet_triple *ii = &f->second;
	const jet a11 = jet_multiply(crossed(i->vv, ii->uu, i->uv, ii->uv), inverse);
	const jet a12 = jet_multiply(crossed(i->vv, ii->uv, i->uv, ii->vv), inverse);
	const jet a21 = jet_multiply(crossed(i->uu, ii->uv, i->uv, ii->uu), inverse);
	const jet a22 = jet_multiply(crossed(i->uu, ii->vv, i->uv, ii->uv), inverse);
	if (fairness == NET_FAIRNESS_MEAN)
		return jet_scale(jet_square(jet_add(a11, a22)), 0.25);
	if (fairness == NET_FAIRNESS_GAUSS)
		return jet_root(
			jet_add(jet_square(crossed(a11, a22, a12, a21)), jet_constant(rounding * rounding)));
	return jet_add(jet_add(jet_square(a11), jet_square(a22)),
	               jet_scale(jet_multiply(a12, a21), 2.0));
}

/* h_ul G^l and h_vl G^l of the Christoffel symbols of a second derivative. */
static void connect(const net_forms *f, const jet_vector *d, jet *u, jet *v)
{
	const jet inverse = jet_inverse(f->square);
	const jet a = inner(&f->d[D_U], d);
	const jet b = inner(&f->d[D_V], d);
	const jet g_u = jet_multiply(crossed(f->first.vv, a, f->first.uv, b), inverse);
	const jet g_v = jet_multiply(crossed(f->first.uu, b, f->first.uv, a), inverse);
	*u = jet_add(jet_multiply(f->second.uu, g_u), jet_multiply(f->second.uv, g_v));
	*v = jet_add(jet_multiply(f->second.uv, g_u), jet_multiply(f->second.vv, g_v));
}

/* The covariant derivative of the second form: uuu, uuv, uvv, vvv. */
static void derive_second(const net_forms *f, jet c[4])
{
	jet u_uu, v_uu, u_uv, v_uv, u_vv, v_vv;
	connect(f, &f->d[D_UU], &u_uu, &v_uu);
	connect(f, &f->d[D_UV], &u_uv, &v_uv);
	connect(f, &f->d[D_VV], &u_vv, &v_vv);
	c[0] = jet_subtract(inner(&f->normal, &f->d[D_UUU]), jet_scale(u_uu, 3.0));
	c[1] = jet_subtract(inner(&f->normal, &f->d[D_UUV]), jet_add(jet_scale(u_uv, 2.0), v_uu));
	c[2] = jet_subtract(inner(&f->normal, &f->d[D_UVV]), jet_add(jet_scale(v_uv, 2.0), u_vv));
	c[3] = jet_subtract(inner(&f->normal, &f->d[D_VVV]), jet_scale(v_vv, 3.0));
}

/* A symmetric form with `degree` of its arguments (-shear, 1), the others (1, 0), by its values along the
 * axes: c[n] has n arguments (0, 1). */
static jet sheared(const jet *c, jet shear, int degree)
{
	jet sum = c[degree];
	jet power = jet_constant(1.0);
	double binomial = 1.0;
	for (int n = 1; n <= degree; n++) {
		power = jet_scale(jet_multiply(power, shear), -1.0);
		binomial = binomial * (double)(degree - n + 1) / (double)n;
		sum = jet_add(sum, jet_scale(jet_multiply(power, c[degree - n]), binomial));
	}
	return sum;
}

/* In the frame of two unit vectors at right angles, x_u / sqrt E and (x_v - F/E x_u) sqrt E / W: the second
 * form a, b, c and its derivative, the cubic p. */
static void turn_to_frame(const net_forms *f, const jet cubic[4], jet form[3], jet p[4])
{
	const jet root = jet_root(f->first.uu);
	const jet r = jet_inverse(root);
	const jet q = jet_multiply(root, jet_inverse(f->area));
	const jet shear = jet_multiply(f->first.uv, jet_square(r));
	const jet second[3] = { f->second.uu, f->second.uv, f->second.vv };
	const jet powers_r[4] = { jet_constant(1.0), r, jet_square(r), jet_multiply(r, jet_square(r)) };
	const jet powers_q[4] = { jet_constant(1.0), q, jet_square(q), jet_multiply(q, jet_square(q)) };
	for (int n = 0; n < 3; n++)
		form[n] = jet_multiply(sheared(second, shear, n),
		                       jet_multiply(powers_r[2 - n], powers_q[n]));
	for (int n = 0; n < 4; n++)
		p[n] = jet_multiply(sheared(cubic, shear, n), jet_multiply(powers_r[3 - n], powers_q[n]));
}

/* (dk1/de1)^2 + (dk2/de2)^2. Along the direction at the angle t the cubic is a wave of t and one of 3 t,
 * (p1, q1) and (p3, q3); of the sum of its squares along two directions at right angles the waves of 2 t
 * and 6 t are gone, and 4 t is known from the second form by divisions alone. */
static jet variation_of(const jet form[3], const jet c[4])
{
	const jet p1 = jet_scale(jet_add(c[0], c[2]), 0.75);
	const jet q1 = jet_scale(jet_add(c[1], c[3]), 0.75);
	const jet p3 = jet_scale(jet_subtract(c[0], jet_scale(c[2], 3.0)), 0.25);
	const jet q3 = jet_scale(jet_subtract(jet_scale(c[1], 3.0), c[3]), 0.25);
	const jet d = jet_scale(jet_subtract(form[0], form[2]), 0.5);
	const jet inverse = jet_inverse(jet_add(jet_square(d), jet_square(form[1])));
	const jet cosine = jet_multiply(crossed(d, d, form[1], form[1]), inverse);
	const jet sine = jet_scale(jet_multiply(jet_multiply(d, form[1]), inverse), 2.0);
	const jet even = crossed(p1, p3, q1, q3);
	const jet odd = jet_add(jet_multiply(p1, q3), jet_multiply(q1, p3));
	const jet steady = jet_add(jet_add(jet_square(p1), jet_square(q1)),
	                           jet_add(jet_square(p3), jet_square(q3)));
	return jet_add(steady,
	               jet_scale(jet_add(jet_multiply(even, cosine), jet_multiply(odd, sine)), 2.0));
}

/* Whether the principal directions exist, by the rule of surface_variation.h. */
static bool has_directions(const jet form[3])
{
	const double a = form[0].value;
	const double b = form[1].value;
	const double c = form[2].value;
	const double square = (a - c) * (a - c) + 4.0 * b * b;
	return square > SURFACE_UMBILIC_F64 * SURFACE_UMBILIC_F64 * (a * a + c * c + 2.0 * b * b);
}

jet net_density_of(int fairness, const double *sample, const double way[NET_TERM_VARIABLES_MOST],
                   double rounding)
{
	const bool third = fairness == NET_FAIRNESS_VARIATION;
	net_forms f;
	read_vectors(sample, way, third ? NET_TERM_VARIABLES_MOST : NET_TERM_VARIABLES, &f);
	find_forms(&f);
	if (!third)
		return jet_multiply(fairness_of(fairness, &f, rounding), f.area);
	jet cubic[4], form[3], turned[4];
	derive_second(&f, cubic);
	turn_to_frame(&f, cubic, form, turned);
	if (!(f.square.value > 0.0) || !has_directions(form))
		return jet_constant(0.0);
	return jet_multiply(variation_of(form, turned), f.area);
}
