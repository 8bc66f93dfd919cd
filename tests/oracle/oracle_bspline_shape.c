/* Curvatures of B-spline surfaces from the eigenproblem of the shape operator, and integrals over
 * them by Gauss quadrature per span. */
#include "oracle_bspline.h"

#include "oracle_internal.h"

#include <math.h>

enum { U, V };

static long double dot(const long double *a, const long double *b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const long double *a, const long double *b, long double *out)
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Eigenvalues of the symmetric ((a, b), (b, c)), the smaller first, and the turn of the axes to the
 * direction of the first: one Jacobi rotation. */
static void eigen(long double a, long double b, long double c, long double value[2],
                  long double axis[2])
{
	long double tangent = 0;
	if (fabsl(b) > 0) {
		long double cotangent = (c - a) / (2 * b);
		tangent = copysignl(1, cotangent) / (fabsl(cotangent) + sqrtl(1 + cotangent * cotangent));
	}
	long double cosine = 1 / sqrtl(1 + tangent * tangent), sine = tangent * cosine;
	value[0] = a - tangent * b;
	value[1] = c + tangent * b;
	axis[0] = cosine;
	axis[1] = -sine;
	if (value[0] > value[1]) {
		long double other = value[0];
		value[0] = value[1];
		value[1] = other;
		axis[0] = sine;
		axis[1] = cosine;
	}
}

/* An orthonormal frame of the tangent plane by Gram and Schmidt: x_u = r00 t0,
 * x_v = r01 t0 + r11 t1. The second form in that frame is the shape operator, a symmetric
 * matrix. */
static void shape_operator(const oracle_jet d, oracle_forms *out)
{
	const long double *x_u = d[1][0], *x_v = d[0][1];
	long double t0[3], t1[3], r00 = sqrtl(dot(x_u, x_u)), r01 = 0, r11 = out->area / r00;
	for (size_t c = 0; c < 3; c++)
		t0[c] = x_u[c] / r00;
	r01 = dot(t0, x_v);
	cross(out->normal, t0, t1);
	long double e = out->second[0], f = out->second[1], g = out->second[2];
	long double a = e / (r00 * r00);
	long double b = (f - r01 * e / r00) / (r00 * r11);
	long double c = (g - 2 * r01 * f / r00 + r01 * r01 * e / (r00 * r00)) / (r11 * r11);
	long double axis[2];
	eigen(a, b, c, out->k, axis);
	for (size_t i = 0; i < 3; i++) {
		out->direction[0][i] = axis[0] * t0[i] + axis[1] * t1[i];
		out->direction[1][i] = -axis[1] * t0[i] + axis[0] * t1[i];
	}
	out->gauss = out->k[0] * out->k[1];
	out->mean = (out->k[0] + out->k[1]) / 2;
}

void oracle_surface_forms(const oracle_jet d, oracle_forms *out)
{
	*out = (oracle_forms){ 0 };
	const long double *x_u = d[1][0], *x_v = d[0][1];
	long double normal[3];
	out->first[0] = dot(x_u, x_u);
	out->first[1] = dot(x_u, x_v);
	out->first[2] = dot(x_v, x_v);
	cross(x_u, x_v, normal);
	out->area = sqrtl(dot(normal, normal));
	out->regular = out->area > 1e-12L * sqrtl(out->first[0] * out->first[2]);
	if (!out->regular)
		return;
	for (size_t c = 0; c < 3; c++)
		out->normal[c] = normal[c] / out->area;
	out->second[0] = dot(d[2][0], out->normal);
	out->second[1] = dot(d[1][1], out->normal);
	out->second[2] = dot(d[0][2], out->normal);
	shape_operator(d, out);
}

/* The principal curvature `which` at a step from (u, v) along the parameters' direction. */
static long double curvature_beside(const oracle_surface *surface, const size_t span[2],
                                    const long double at[2], const long double step[2],
                                    size_t which)
{
	oracle_jet jet;
	oracle_forms forms;
	if (!oracle_surface_in_span(surface, span, at[U] + step[U], at[V] + step[V], jet))
		return (long double)NAN;
	oracle_surface_forms(jet, &forms);
	return forms.regular ? forms.k[which] : (long double)NAN;
}

long double oracle_surface_variation(const oracle_surface *surface, long double u, long double v,
                                     long double apart)
{
	oracle_jet jet;
	oracle_forms forms;
	size_t span[2];
	if (!oracle_surface_spans(surface, u, v, span) ||
	    !oracle_surface_in_span(surface, span, u, v, jet))
		return (long double)NAN;
	oracle_surface_forms(jet, &forms);
	if (!forms.regular || !(forms.k[1] - forms.k[0] > apart))
		return (long double)NAN;
	long double width_u = surface->knots_u[span[U] + 1] - (long double)surface->knots_u[span[U]];
	long double width_v = surface->knots_v[span[V] + 1] - (long double)surface->knots_v[span[V]];
	long double sum = 0, at[2] = { u, v };
	for (size_t which = 0; which < 2; which++) {
		/* direction = x_u du + x_v dv, with the first form as the matrix of the equations */
		long double a = dot(forms.direction[which], jet[1][0]);
		long double b = dot(forms.direction[which], jet[0][1]);
		long double area2 = forms.area * forms.area;
		long double along[2] = { (a * forms.first[2] - b * forms.first[1]) / area2,
			                     (b * forms.first[0] - a * forms.first[1]) / area2 };
		long double scale = 0.01L / fmaxl(fabsl(along[U]) / width_u, fabsl(along[V]) / width_v);
		long double column[ORACLE_LEVELS];
		for (size_t i = 0; i < ORACLE_LEVELS; i++, scale /= 2) {
			long double step[2] = { scale * along[U], scale * along[V] };
			long double back[2] = { -step[U], -step[V] };
			column[i] = (curvature_beside(surface, span, at, step, which) -
			             curvature_beside(surface, span, at, back, which)) /
			            (2 * scale);
		}
		long double slope = oracle_extrapolate(column);
		sum += slope * slope;
	}
	return sum;
}

void oracle_gauss(size_t count, long double *node, long double *weight)
{
	const long double pi = acosl(-1);
	for (size_t i = 0; i < count; i++) {
		long double x = -cosl(pi * ((long double)i + 0.75L) / ((long double)count + 0.5L));
		long double slope = 1;
		for (int newton = 0; newton < 12; newton++) {
			long double before = 1, value = x;
			for (size_t n = 2; n <= count; n++) {
				long double next = ((2 * (long double)n - 1) * x * value -
				                    ((long double)n - 1) * before) /
				                   (long double)n;
				before = value;
				value = next;
			}
			slope = (long double)count * (before - x * value) / (1 - x * x);
			x -= value / slope;
		}
		node[i] = x;
		weight[i] = 2 / ((1 - x * x) * slope * slope);
	}
}

enum { NODES_MOST = 64 };

typedef struct quadrature {
	size_t nodes;
	long double node[NODES_MOST], weight[NODES_MOST];
	size_t regular, singular;
} quadrature;

/* Integral over the span; NaN where the surface has no value. */
static long double integrate_span(const oracle_surface *s, const size_t span[2], quadrature *q,
                                  oracle_density *density, const void *data)
{
	long double u0 = s->knots_u[span[U]], half_u = (s->knots_u[span[U] + 1] - u0) / 2;
	long double v0 = s->knots_v[span[V]], half_v = (s->knots_v[span[V] + 1] - v0) / 2, sum = 0;
	for (size_t j = 0; j < q->nodes; j++) {
		for (size_t i = 0; i < q->nodes; i++) {
			oracle_jet jet;
			oracle_forms forms;
			if (!oracle_surface_in_span(s, span, u0 + half_u * (1 + q->node[i]),
			                            v0 + half_v * (1 + q->node[j]), jet))
				return (long double)NAN;
			oracle_surface_forms(jet, &forms);
			*(forms.regular ? &q->regular : &q->singular) += 1;
			if (forms.regular)
				sum += q->weight[i] * q->weight[j] * forms.area * density(jet, &forms, data);
		}
	}
	return sum * half_u * half_v;
}

static bool integrate(const oracle_surface *s, quadrature *q, oracle_density *density,
                      const void *data, long double *out)
{
	size_t span[2];
	if (q->nodes < 1 || q->nodes > NODES_MOST || !oracle_surface_spans(s, 0, 0, span))
		return false;
	oracle_gauss(q->nodes, q->node, q->weight);
	q->regular = q->singular = 0;
	*out = 0;
	for (span[V] = s->order_v - 1; span[V] < s->count_v; span[V]++)
		for (span[U] = s->order_u - 1; span[U] < s->count_u; span[U]++)
			if (s->knots_u[span[U]] < s->knots_u[span[U] + 1] &&
			    s->knots_v[span[V]] < s->knots_v[span[V] + 1])
				*out += integrate_span(s, span, q, density, data);
	return !isnan(*out);
}

bool oracle_surface_integral(const oracle_surface *surface, size_t nodes, oracle_density *density,
                             const void *data, long double *out, size_t *singular)
{
	quadrature q = { .nodes = nodes };
	if (!integrate(surface, &q, density, data, out))
		return false;
	if (singular)
		*singular = q.singular;
	return true;
}

static long double density_bending(const oracle_jet d, const oracle_forms *f, const void *data)
{
	(void)d, (void)data;
	return f->k[0] * f->k[0] + f->k[1] * f->k[1];
}

static long double density_mean(const oracle_jet d, const oracle_forms *f, const void *data)
{
	(void)d, (void)data;
	return f->mean * f->mean;
}

static long double density_gauss(const oracle_jet d, const oracle_forms *f, const void *data)
{
	(void)d;
	return hypotl(f->gauss, *(const double *)data);
}

static long double density_area(const oracle_jet d, const oracle_forms *f, const void *data)
{
	(void)d, (void)f, (void)data;
	return 1;
}

bool oracle_surface_energy(const oracle_surface *surface, size_t nodes, double rounding,
                           oracle_energies *out)
{
	quadrature q = { .nodes = nodes };
	*out = (oracle_energies){ 0 };
	if (!integrate(surface, &q, density_bending, NULL, &out->bending) ||
	    !integrate(surface, &q, density_mean, NULL, &out->mean) ||
	    !integrate(surface, &q, density_gauss, &rounding, &out->gauss) ||
	    !integrate(surface, &q, density_area, NULL, &out->area))
		return false;
	out->terms = q.regular;
	return true;
}
