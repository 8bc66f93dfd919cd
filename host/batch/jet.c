#include "batch/jet.h"

#include <math.h>

jet jet_constant(double value)
{
	return (jet){ .value = value };
}

jet jet_variable(double value, int variable, int variables)
{
	jet a = jet_constant(value);
	a.variables = variables;
	a.first[variable] = 1.0;
	return a;
}

/* p a + q b. */
static jet combine(jet a, double p, jet b, double q)
{
	jet c = jet_constant(p * a.value + q * b.value);
	c.variables = a.variables > b.variables ? a.variables : b.variables;
	for (int i = 0; i < c.variables; i++)
		c.first[i] = p * a.first[i] + q * b.first[i];
	for (int i = 0; i < c.variables * (c.variables + 1) / 2; i++)
		c.second[i] = p * a.second[i] + q * b.second[i];
	return c;
}

jet jet_add(jet a, jet b)
{
	return combine(a, 1.0, b, 1.0);
}

jet jet_subtract(jet a, jet b)
{
	return combine(a, 1.0, b, -1.0);
}

jet jet_scale(jet a, double factor)
{
	return combine(a, factor, a, 0.0);
}

jet jet_multiply(jet a, jet b)
{
	jet c = combine(a, b.value, b, a.value);
	int at = 0;
	c.value = a.value * b.value;
	for (int i = 0; i < c.variables; i++)
		for (int j = 0; j <= i; j++)
			c.second[at++] += a.first[i] * b.first[j] + a.first[j] * b.first[i];
	return c;
}

/* A function of a, given by its value and derivatives there. */
static jet apply(jet a, double value, double first, double second)
{
	jet c = combine(a, first, a, 0.0);
	int at = 0;
	c.value = value;
	for (int i = 0; i < c.variables; i++)
		for (int j = 0; j <= i; j++)
			c.second[at++] += second * a.first[i] * a.first[j];
	return c;
}

jet jet_square(jet a)
{
	return apply(a, a.value * a.value, 2.0 * a.value, 2.0);
}

jet jet_inverse(jet a)
{
	const double inverse = 1.0 / a.value;
	return apply(a, inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse);
}

jet jet_root(jet a)
{
	const double root = sqrt(a.value);
	return apply(a, root, 0.5 / root, -0.25 / (root * a.value));
}
