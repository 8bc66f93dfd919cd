/* What one core can do: multiply-adds in independent chains, so many that none waits for another. */
#include "bench.h"

#if defined(__x86_64__)
#include <immintrin.h>

enum { CHAINS = 12, TURNS = 1 << 20 };

/* The chains run towards 1, so that no number ever becomes tiny or huge. */
#define PEAK(name, vector, features, spread, multiply_add)                                         \
	__attribute__((target(features))) static vector name(void)                                     \
	{                                                                                              \
		const vector half = spread(0.5);                                                           \
		vector a = half, b = half, c = half, d = half, e = half, f = half;                         \
		vector g = half, h = half, i = half, j = half, k = half, l = half;                         \
		for (int t = 0; t < TURNS; t++) {                                                          \
			a = multiply_add(a, half, half), b = multiply_add(b, half, half);                      \
			c = multiply_add(c, half, half), d = multiply_add(d, half, half);                      \
			e = multiply_add(e, half, half), f = multiply_add(f, half, half);                      \
			g = multiply_add(g, half, half), h = multiply_add(h, half, half);                      \
			i = multiply_add(i, half, half), j = multiply_add(j, half, half);                      \
			k = multiply_add(k, half, half), l = multiply_add(l, half, half);                      \
			/* Twelve equal chains would be made one. */                                           \
			__asm__ volatile(""                                                                    \
			                 : "+v"(a), "+v"(b), "+v"(c), "+v"(d), "+v"(e), "+v"(f), "+v"(g),      \
			                   "+v"(h), "+v"(i), "+v"(j), "+v"(k), "+v"(l));                       \
		}                                                                                          \
		return a + b + c + d + e + f + g + h + i + j + k + l;                                      \
	}
PEAK(chains_f64_512, __m512d, "avx512f", _mm512_set1_pd, _mm512_fmadd_pd)
PEAK(chains_f32_512, __m512, "avx512f", _mm512_set1_ps, _mm512_fmadd_ps)
PEAK(chains_f64_256, __m256d, "avx2,fma", _mm256_set1_pd, _mm256_fmadd_pd)
PEAK(chains_f32_256, __m256, "avx2,fma", _mm256_set1_ps, _mm256_fmadd_ps)

#define WORK(name, features)                                                                       \
	__attribute__((target(features))) static void work_##name(volatile double *sum)                \
	{                                                                                              \
		*sum = (double)chains_##name()[0];                                                         \
	}
WORK(f64_512, "avx512f")
WORK(f32_512, "avx512f")
WORK(f64_256, "avx2,fma")
WORK(f32_256, "avx2,fma")

double bench_peak(batten_precision precision)
{
	const bool f64 = precision == BATTEN_F64;
	const bool wide = __builtin_cpu_supports("avx512f");
	if (!wide && !(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")))
		return 0.0;
	void (*work)(volatile double *) = wide ? (f64 ? work_f64_512 : work_f32_512)
	                                       : (f64 ? work_f64_256 : work_f32_256);
	const double operations = 2.0 * (wide ? 64.0 : 32.0) / (f64 ? 8.0 : 4.0) * CHAINS * TURNS;
	volatile double sum = 0.0;
	const double begun = bench_cpu_seconds();
	work(&sum);
	return operations / (bench_cpu_seconds() - begun);
}

#else

double bench_peak(batten_precision precision)
{
	(void)precision;
	return 0.0;
}

#endif
