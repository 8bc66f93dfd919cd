/* Nodes worked side by side: a row of a table in runs of one length, which compilers turn into vectors,
 * compiled for processors with a multiply-add of their own too. The bits are the same either way.
 *
 * A loop becomes vectors where it has no branch and where no pointer is read again after a store: structs are
 * copied first, what is found goes into arrays of the function's own. Bytes beside numbers, such as the kinds of
 * nodes, do so in loops of at least 64 only, where what is chosen by them is read whatever they are. */
#ifndef BATTEN_CORE_RUNS_H
#define BATTEN_CORE_RUNS_H

#include <stddef.h>

enum { RUN_LENGTH = 8 };

/* Not under sanitizers, whose checks make a function of all a burden to its compiler. */
#ifdef BATTEN_SANITIZED
#define INLINED static inline
#else
#define INLINED static inline __attribute__((always_inline))
#endif

/* Before a loop over a run: taken apart into its nodes it would become no vector. */
#if defined(__clang__)
#define RUN_LOOP _Pragma("clang loop unroll(disable)")
#elif defined(__GNUC__)
#define RUN_LOOP _Pragma("GCC unroll 1")
#else
#define RUN_LOOP
#endif

/* Where the run after first begins: the last one overlaps the one before it, so that all are whole where
 * the row is long enough for one. first: where a run begins that is not the last one. */
INLINED size_t run_after(size_t first, size_t end)
{
	return first + 2 * RUN_LENGTH <= end ? first + RUN_LENGTH : end - RUN_LENGTH;
}

/* GCC remembers conditions it has met and makes branches of them. */
#if defined(__GNUC__) && !defined(__clang__)
#define RUNS_PLAIN __attribute__((optimize("no-tree-pre")))
#else
#define RUNS_PLAIN
#endif

/* Defines name, which calls body with the same arguments, inlined, on what the processor has: declare is
 * the list of parameters, call that of arguments, each in parentheses. body: INLINED. */
#if defined(__x86_64__)
#define RUNS_FUNCTION(name, body, declare, call)                                                   \
	RUNS_PLAIN                                                                                     \
	__attribute__((                                                                                \
		target("avx512f,avx512bw,avx512dq,avx512vl,fma"))) static void name##_wide declare         \
	{                                                                                              \
		body call;                                                                                 \
	}                                                                                              \
	RUNS_PLAIN __attribute__((target("avx2,fma"))) static void name##_fused declare                \
	{                                                                                              \
		body call;                                                                                 \
	}                                                                                              \
	static void name declare                                                                       \
	{                                                                                              \
		if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&            \
		    __builtin_cpu_supports("avx512vl"))                                                    \
			name##_wide call;                                                                      \
		else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))                  \
			name##_fused call;                                                                     \
		else                                                                                       \
			body call;                                                                             \
	}
#else
#define RUNS_FUNCTION(name, body, declare, call)                                                   \
	static void name declare                                                                       \
	{                                                                                              \
		body call;                                                                                 \
	}
#endif

#endif
