/* How kernels that are one item for a whole problem are compiled as C; after shared/dialect.h. fma() is one
 * instruction where the processor has it and a function of the C library elsewhere, ten times slower with the same
 * result: all is inlined into one function for each, formulas too. Not where a sanitizer's checks make that
 * function a burden to its compiler: 42 s in place of 2 for surfaces afloat, 9 in place of 2 for nets; what runs is
 * as fast. */
#ifndef BATTEN_REFERENCE_INLINED_H
#define BATTEN_REFERENCE_INLINED_H

#ifdef BATTEN_SANITIZED
#define INLINED static inline
#else
#define INLINED static inline __attribute__((always_inline))
#endif
#undef SHARED_FUNCTION
#define SHARED_FUNCTION INLINED

/* Defines name, which does what body does, INLINED, with the instruction where there is one; one a file. declare:
 * the list of parameters, call: that of arguments, each in parentheses. Without it the calls are what takes time,
 * and that copy is compiled to be small: surfaces afloat take 10 s of processor time, not 15. */
#if defined(__x86_64__)
#define WITH_FMA_WHERE_THERE_IS(name, body, declare, call)                                         \
	__attribute__((target("avx2,fma"))) static void work_with_fma declare                          \
	{                                                                                              \
		body call;                                                                                 \
	}                                                                                              \
	__attribute__((cold, noinline)) static void work_without_fma declare                           \
	{                                                                                              \
		body call;                                                                                 \
	}                                                                                              \
	void name declare                                                                              \
	{                                                                                              \
		if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))                       \
			work_with_fma call;                                                                    \
		else                                                                                       \
			work_without_fma call;                                                                 \
	}
#else
#define WITH_FMA_WHERE_THERE_IS(name, body, declare, call)                                         \
	void name declare                                                                              \
	{                                                                                              \
		body call;                                                                                 \
	}
#endif

#endif
