/* The words of OpenCL C that surface_grid.cl speaks, for GNU C on a processor with AVX-512: what the same
 * source does in the hands of a C compiler. One work-item a group, as PoCL gets it. Defined before:
 * BATTEN_DOUBLE. */
#ifndef BATTEN_BENCH_C_VECTORS_H
#define BATTEN_BENCH_C_VECTORS_H

#include <immintrin.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#if BATTEN_DOUBLE
#define BATTEN_LANES 8
typedef __m512d double8;
typedef long long8 __attribute__((vector_size(64)));
#define TURNS_LOW(a, b) __builtin_shuffle(a, b, (long8){ 0, 8, 1, 9, 2, 10, 3, 11 })
#define TURNS_HIGH(a, b) __builtin_shuffle(a, b, (long8){ 4, 12, 5, 13, 6, 14, 7, 15 })
#define WORD(name) name##_pd
#define MASK_OF(a) _mm512_movepi64_mask((__m512i)(a))
#define convert_double8(a) (a)
#define convert_char8(a) (a)
#define as_ulong(a) MASK_OF(a)
#define vstore8(a, offset, to) _mm512_storeu_pd(to, a)
typedef double8 vector;
#else
#define BATTEN_LANES 16
typedef __m512 float16;
typedef int int16 __attribute__((vector_size(64)));
#define TURNS_LOW(a, b)                                                                            \
	__builtin_shuffle(a, b, (int16){ 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23 })
#define TURNS_HIGH(a, b)                                                                           \
	__builtin_shuffle(a, b, (int16){ 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31 })
#define WORD(name) name##_ps
#define MASK_OF(a) _mm512_movepi32_mask((__m512i)(a))
#define convert_float16(a) (a)
#define convert_char16(a) (a)
#define as_long2(a) (a)
#define vstore16(a, offset, to) _mm512_storeu_ps(to, a)
typedef float16 vector;
#endif

#define SPREAD(a) ((a) - (vector){ 0 }) /* a vector as it is, a scalar in every lane */
#define UNROLLED _Pragma("GCC unroll 16")
#define fma(a, b, c) WORD(_mm512_fmadd)(a, b, c)
#define sqrt(a) WORD(_mm512_sqrt)(a)
#define select(when_false, when_true, condition)                                                   \
	WORD(_mm512_mask_blend)(MASK_OF(condition), when_false, when_true)
#define any(condition) (MASK_OF(condition) != 0)

#define kernel static
#define global
#define local
#define barrier(fence) ((void)0)
static size_t work_group; /* the one at work */
#define get_group_id(dimension) work_group
#define get_local_id(dimension) ((size_t)0)
#define get_local_size(dimension) ((size_t)1)

#endif
