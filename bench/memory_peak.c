/* What memory gives one core: a triad over arrays that no cache holds (STREAM's counting: two reads
 * and a write an element). */
#include "bench.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

enum { NUMBERS = 1 << 22, TURNS = 2 };

void *bench_allocate_large(size_t size)
{
	const size_t page = (size_t)2 << 20;
	if (size > SIZE_MAX - page)
		return NULL;
	const size_t rounded = (size + page - 1) / page * page;
	void *memory = aligned_alloc(page, rounded);
	if (memory)
		(void)madvise(memory, rounded, MADV_HUGEPAGE);
	return memory;
}

double bench_stream(void)
{
	double *memory = bench_allocate_large(3 * sizeof *memory * NUMBERS);
	if (!memory)
		return 0.0;
	double *a = memory, *b = memory + NUMBERS, *c = memory + 2 * (size_t)NUMBERS;
	for (size_t n = 0; n < NUMBERS; n++) {
		a[n] = 0.0;
		b[n] = 1.0;
		c[n] = 2.0;
	}
	const double begun = bench_cpu_seconds();
	for (int t = 0; t < TURNS; t++) {
		for (size_t n = 0; n < NUMBERS; n++)
			a[n] = b[n] + 0.5 * c[n];
		/* Nothing of it may be left out. */
		__asm__ volatile("" : : "r"(a) : "memory");
	}
	const double seconds = bench_cpu_seconds() - begun;
	free(memory);
	return 3.0 * sizeof(double) * NUMBERS * TURNS / seconds;
}
