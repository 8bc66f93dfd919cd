#include "fairing/discrepancy.h"

#include <math.h>

#define STIFFEST_RATIO 1e12
enum { RATIOS_A_DECADE = 4 };

double discrepancy_ratio(size_t i)
{
	return i + 1 < DISCREPANCY_RATIOS ? pow(10.0, (double)i / RATIOS_A_DECADE) : STIFFEST_RATIO;
}

size_t discrepancy_choose(size_t count, const double *changes_m, double noise_m)
{
	for (size_t i = 0; i < count; i++)
		if (changes_m[i] <= DISCREPANCY_NOISE_PART * noise_m)
			return i;
	return count - 1;
}
