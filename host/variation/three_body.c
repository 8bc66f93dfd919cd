#include "variation/three_body.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The moment about the bow as a form of two sets of factors; the moment itself for equal ones. */
static double moment(const three_body *body, const double p[3], const double q[3])
{
	const double *length = body->length, *volume = body->volume, *centre = body->centre;
	double sum = 0;
	for (size_t i = 0; i < 3; i++) {
		sum += volume[i] * centre[i] * length[i] * p[i] * q[i];
		for (size_t k = 0; k < i; k++)
			sum += volume[i] * length[k] * 0.5 * (p[i] * q[k] + p[k] * q[i]);
	}
	return sum;
}

static void waterlines(const three_body *body, double out[3])
{
	for (size_t i = 0; i < 3; i++)
		out[i] = body->waterline[i] * body->length[i];
}

three_body_target three_body_measure(const three_body *body, const double factors[3])
{
	double lines[3];
	waterlines(body, lines);
	const double volume = dot(body->volume, factors), length = dot(lines, factors);
	return (three_body_target){ .volume = volume,
		                        .centre = moment(body, factors, factors) / (volume * length),
		                        .cp = volume / (body->section_area * length) };
}

/* The point of the line a.p = ra, b.p = rb nearest to (1, 1, 1), and the line's direction. False
 * where the two equations are one. */
static bool find_line(const double a[3], double ra, const double b[3], double rb, double point[3],
                      double direction[3])
{
	const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
	const double determinant = aa * bb - ab * ab;
	if (!(determinant > 1e-14 * aa * bb))
		return false;
	const double one[3] = { 1, 1, 1 };
	const double da = ra - dot(a, one), db = rb - dot(b, one);
	const double u = (da * bb - db * ab) / determinant, v = (db * aa - da * ab) / determinant;
	for (size_t i = 0; i < 3; i++) {
		point[i] = 1 + u * a[i] + v * b[i];
		const size_t j = (i + 1) % 3, k = (i + 2) % 3;
		direction[i] = a[j] * b[k] - a[k] * b[j];
	}
	const double size = sqrt(dot(direction, direction));
	for (size_t i = 0; i < 3; i++)
		direction[i] /= size;
	return true;
}

/* Real roots of c2 t^2 + c1 t + c0, the one nearer to 0 first. */
static size_t find_roots(double c2, double c1, double c0, double roots[2])
{
	if (fabs(c2) <= 1e-13 * fabs(c1)) {
		roots[0] = -c0 / c1;
		return c1 != 0;
	}
	const double inside = c1 * c1 - 4 * c2 * c0;
	if (!(inside >= 0))
		return 0;
	/* Without cancellation. */
	const double q = -0.5 * (c1 + copysign(sqrt(inside), c1));
	if (q == 0) {
		roots[0] = 0;
		return 1;
	}
	const double r = c0 / q, s = q / c2;
	roots[0] = fabs(r) <= fabs(s) ? r : s;
	roots[1] = fabs(r) <= fabs(s) ? s : r;
	return 2;
}

size_t three_body_solve(const three_body *body, const three_body_target *target,
                        double factors[2][3], size_t *rejected)
{
	double lines[3], point[3], direction[3], roots[2] = { 0 };
	waterlines(body, lines);
	*rejected = 0;
	const double length = target->volume / (target->cp * body->section_area);
	if (!find_line(lines, length, body->volume, target->volume, point, direction))
		return 0;
	const double asked = target->volume * target->centre * length;
	const size_t count = find_roots(moment(body, direction, direction),
	                                2 * moment(body, point, direction),
	                                moment(body, point, point) - asked, roots);
	size_t found = 0;
	for (size_t r = 0; r < count; r++) {
		double candidate[3];
		bool good = true;
		for (size_t i = 0; i < 3; i++) {
			candidate[i] = point[i] + roots[r] * direction[i];
			good = good && candidate[i] > 0 && isfinite(candidate[i]);
		}
		if (good)
			memcpy(factors[found++], candidate, sizeof candidate);
		else
			++*rejected;
	}
	return found;
}
