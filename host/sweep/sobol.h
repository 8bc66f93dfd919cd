/* Sobol's sequence with the direction numbers of Joe and Kuo (2008), and its scrambling. */
#ifndef BATTEN_SWEEP_SOBOL_H
#define BATTEN_SWEEP_SOBOL_H

#include "sweep/sobol_table.h"

enum { SOBOL_BITS = 32 };

/* The 32 direction numbers of a dimension (from 0), the leading bit first. */
void sobol_directions(unsigned dimension, uint32_t directions[SOBOL_BITS]);

/* Coordinate of point number i in Gray code order (Antonov and Saleev 1979), times 2^32. */
uint32_t sobol_coordinate(const uint32_t directions[SOBOL_BITS], uint32_t i);

/* Owen's nested uniform scrambling (1995): each bit is flipped or not at random, by what stands before
 * it. Within one seed and dimension different coordinates stay different, and the net stays a net. */
uint32_t sobol_scramble(uint64_t seed, uint32_t dimension, uint32_t coordinate);

#endif
