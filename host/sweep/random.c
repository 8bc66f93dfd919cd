#include "sweep/random.h"

#include <Random123/philox.h>

/* Luby and Rackoff need 4 rounds of a good function; a few more cost little. */
enum { FEISTEL_ROUNDS = 6, FEISTEL_HALF_MOST = 31 };

uint64_t sweep_random(uint64_t seed, uint64_t number, uint32_t dimension, sweep_purpose purpose)
{
	const philox4x32_ctr_t counter = { { (uint32_t)number, (uint32_t)(number >> 32), dimension,
		                                 (uint32_t)purpose } };
	const philox4x32_key_t key = { { (uint32_t)seed, (uint32_t)(seed >> 32) } };
	const philox4x32_ctr_t words = philox4x32(counter, key);
	return (uint64_t)words.v[1] << 32 | words.v[0];
}

double sweep_random_unit(uint64_t seed, uint64_t number, uint32_t dimension)
{
	return (double)(sweep_random(seed, number, dimension, SWEEP_RANDOM_POINT) >> 11) * 0x1p-53;
}

static uint64_t feistel(uint64_t seed, uint32_t dimension, unsigned half, uint64_t i)
{
	const uint64_t mask = ((uint64_t)1 << half) - 1;
	uint64_t left = i >> half;
	uint64_t right = i & mask;
	for (uint64_t round = 0; round < FEISTEL_ROUNDS; round++) {
		/* half is at most 31 bits, so that the round has room above it. */
		const uint64_t word = sweep_random(seed, right | round << FEISTEL_HALF_MOST, dimension,
		                                   SWEEP_RANDOM_SHUFFLE);
		const uint64_t next = left ^ (word & mask);
		left = right;
		right = next;
	}
	return left << half | right;
}

uint64_t sweep_permuted(uint64_t seed, uint32_t dimension, uint64_t count, uint64_t i)
{
	unsigned half = 1;
	while (half < FEISTEL_HALF_MOST && (uint64_t)1 << (2 * half) < count)
		half++;
	/* A permutation of more numbers than count: following it from i leads back below count, in fewer
	 * than four steps on average, and to a different number from every i. */
	do
		i = feistel(seed, dimension, half, i);
	while (i >= count);
	return i;
}
