#include "sweep/log_scale.h"

#include <math.h>

/* ln 2, the first part with enough zeros at its end that small multiples of it are exact. */
#define LN2_HIGH 0x1.62e42fefa0000p-1
#define LN2_LOW 0x1.cf79abc9e3b3ap-40

enum { LOG_TERMS = 16, EXP_TERMS = 18 };

/* By the series of atanh((m - 1) / (m + 1)), m in [sqrt(1/2), sqrt(2)). */
static double logarithm(double x)
{
	int exponent = 0;
	double m = frexp(x, &exponent);
	if (m < 0.70710678118654752) {
		m *= 2.0;
		exponent--;
	}
	const double s = (m - 1.0) / (m + 1.0);
	double sum = 0.0;
	for (int k = LOG_TERMS; k >= 0; k--)
		sum = sum * (s * s) + 1.0 / (2 * k + 1);
	return exponent * LN2_HIGH + (exponent * LN2_LOW + 2.0 * s * sum);
}

/* By Taylor's series about the nearest multiple of ln 2. */
static double exponential(double x)
{
	const double n = floor(x / (LN2_HIGH + LN2_LOW) + 0.5);
	const double r = (x - n * LN2_HIGH) - n * LN2_LOW;
	double sum = 1.0;
	for (int k = EXP_TERMS; k >= 1; k--)
		sum = 1.0 + sum * r / k;
	return ldexp(sum, (int)n);
}

double log_scale_between(double from, double to, double part)
{
	if (part <= 0.0)
		return from;
	if (part >= 1.0)
		return to;
	return from * exponential(part * (logarithm(to) - logarithm(from)));
}
