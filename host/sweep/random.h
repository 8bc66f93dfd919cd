/* Random numbers by counter: the same for the same seed, number and purpose, on every machine and in
 * any order (Philox4x32-10 of Random123, Salmon et al. 2011). */
#ifndef BATTEN_SWEEP_RANDOM_H
#define BATTEN_SWEEP_RANDOM_H

#include <stdint.h>

/* What a number is for; no two purposes share one. */
typedef enum sweep_purpose {
	SWEEP_RANDOM_POINT,    /* coordinates of a point */
	SWEEP_RANDOM_SHUFFLE,  /* rounds of a permutation */
	SWEEP_RANDOM_SCRAMBLE, /* bits of Sobol's points */
} sweep_purpose;

uint64_t sweep_random(uint64_t seed, uint64_t number, uint32_t dimension, sweep_purpose purpose);

/* In [0, 1), multiples of 2^-53. */
double sweep_random_unit(uint64_t seed, uint64_t number, uint32_t dimension);

/* Where number i of count goes in a random permutation of 0..count-1, one for each seed and dimension,
 * without making the whole of it: a Feistel network over the least even number of bits that holds
 * count, walked on until it comes back below count. i < count <= 2^62. */
uint64_t sweep_permuted(uint64_t seed, uint32_t dimension, uint64_t count, uint64_t i);

#endif
