#include "sweep/sobol.h"
#include "sweep/random.h"

/* Joe and Kuo, Notes on generating Sobol sequences (2008), equation 2. */
void sobol_directions(unsigned dimension, uint32_t directions[SOBOL_BITS])
{
	if (dimension == 0) {
		for (unsigned b = 0; b < SOBOL_BITS; b++)
			directions[b] = 1u << (SOBOL_BITS - 1 - b);
		return;
	}
	const struct sobol_row *row = &sobol_rows[dimension - 1];
	const unsigned degree = row->degree;
	for (unsigned b = 0; b < SOBOL_BITS; b++) {
		if (b < degree) {
			directions[b] = (uint32_t)row->m[b] << (SOBOL_BITS - 1 - b);
			continue;
		}
		directions[b] = directions[b - degree] ^ (directions[b - degree] >> degree);
		for (unsigned k = 1; k < degree; k++)
			if (row->coefficients >> (degree - 1 - k) & 1)
				directions[b] ^= directions[b - k];
	}
}

uint32_t sobol_coordinate(const uint32_t directions[SOBOL_BITS], uint32_t i)
{
	uint32_t coordinate = 0;
	uint32_t gray = i ^ (i >> 1);
	for (unsigned b = 0; gray != 0; b++, gray >>= 1)
		if (gray & 1)
			coordinate ^= directions[b];
	return coordinate;
}

uint32_t sobol_scramble(uint64_t seed, uint32_t dimension, uint32_t coordinate)
{
	uint32_t scrambled = coordinate;
	for (unsigned b = 0; b < SOBOL_BITS; b++) {
		/* The bits before this one; the leading 1 keeps 0 and 00 apart. */
		const uint64_t before = (uint64_t)1 << b | ((uint64_t)coordinate >> (SOBOL_BITS - b));
		const uint64_t word = sweep_random(seed, before, dimension, SWEEP_RANDOM_SCRAMBLE);
		scrambled ^= (uint32_t)(word & 1) << (SOBOL_BITS - 1 - b);
	}
	return scrambled;
}
