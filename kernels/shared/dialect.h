/* One spelling for C11 and OpenCL C 1.2. The includer defines, before including anything of this
 * folder, BATTEN_DIALECT_C or BATTEN_DIALECT_OPENCL, BATTEN_DOUBLE (1: f64, 0: f32) and, in OpenCL,
 * BATTEN_LANES (1, 2, 4, 8 or 16).
 *
 *   scalar   float or double
 *   real     BATTEN_LANES scalars side by side, one search a lane (in C always one)
 *   mask     what comparing two reals gives; only CHOOSE, ANY and & look into it
 *
 * What is worked by a group of work-items in OpenCL is worked by the only one in C: WORK_ITEM of
 * WORK_ITEMS, which WAIT for each other (BATTEN_ALONE, which the host may define:
 * there is but one). GLOBAL and LOCAL say where memory lies, STATE where the state
 * of a search does (local, or global where it is too large; defined by the host).
 *
 *   stored   a real in a search's own memory; AT(one) is the number itself
 *
 * Where BATTEN_ABREAST is defined, a group works so many searches, one each of its work-items side by side, and what
 * is stored of one lies beside the same of the next: a GPU reads what its work-items want at a time in one go. STATE
 * is global then. Where the group has more work-items, each search is shared by as many.
 *
 * A C compiler with vector types can compile kernels too, where the includer has spelled OpenCL C's words
 * in its own beforehand, SPREAD and what turn.h calls for among them (bench/c_vectors.h).
 *
 * Strict arithmetic: only + - * / sqrt and comparisons, no contraction, so that C and every device
 * agree bit for bit. */
#ifndef BATTEN_SHARED_DIALECT_H
#define BATTEN_SHARED_DIALECT_H

#if defined(BATTEN_DIALECT_C) == defined(BATTEN_DIALECT_OPENCL)
#error "define exactly one of BATTEN_DIALECT_C and BATTEN_DIALECT_OPENCL"
#endif

#define BATTEN_PASTE_(a, b) a##b
#define BATTEN_PASTE(a, b) BATTEN_PASTE_(a, b)

#if defined(BATTEN_DIALECT_C)
#include <math.h>

#if BATTEN_DOUBLE
typedef double scalar;
#define SQUARE_ROOT(a) sqrt(a)
#define LITERAL(a) a
#else
typedef float scalar;
#define SQUARE_ROOT(a) sqrtf(a)
#define LITERAL(a) BATTEN_PASTE(a, f)
#endif
typedef scalar real;
typedef int mask;
#define CHOOSE(condition, when_true, when_false) ((condition) ? (when_true) : (when_false))
#define ANY(condition) (condition)
#define SPREAD(a) (a)
#define SHARED_FUNCTION static inline
#define GLOBAL
#define LOCAL
#define STATE
#define BATTEN_ALONE
#define ROLLED
#define UNROLLED

#else

#pragma OPENCL FP_CONTRACT OFF
#if BATTEN_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double scalar;
#define LITERAL(a) a
#define BATTEN_REAL_NAME double
#define BATTEN_MASK_NAME long
#else
typedef float scalar;
#define LITERAL(a) BATTEN_PASTE(a, f)
#define BATTEN_REAL_NAME float
#define BATTEN_MASK_NAME int
#endif
#define SQUARE_ROOT(a) sqrt(a)
#if BATTEN_LANES == 1
typedef BATTEN_REAL_NAME real;
typedef int mask;
#define CHOOSE(condition, when_true, when_false) ((condition) ? (when_true) : (when_false))
#define ANY(condition) (condition)
#else
typedef BATTEN_PASTE(BATTEN_REAL_NAME, BATTEN_LANES) real;
typedef BATTEN_PASTE(BATTEN_MASK_NAME, BATTEN_LANES) mask;
#define CHOOSE(condition, when_true, when_false) select(when_false, when_true, condition)
/* A lane as a byte, all bytes as a number: PoCL makes a branch a lane pair of any(). */
#define BATTEN_BYTES BATTEN_PASTE(convert_char, BATTEN_LANES)
#if BATTEN_LANES == 2
#define ANY(condition) (as_ushort(BATTEN_BYTES(condition)) != 0)
#elif BATTEN_LANES == 4
#define ANY(condition) (as_uint(BATTEN_BYTES(condition)) != 0)
#elif BATTEN_LANES == 8
#define ANY(condition) (as_ulong(BATTEN_BYTES(condition)) != 0)
#else
#define ANY(condition) any(as_long2(BATTEN_BYTES(condition)) != 0)
#endif
#endif
#if !defined(SPREAD)
#define SPREAD(a) ((real)(a))
#endif
#define SHARED_FUNCTION static inline
/* A number of global memory that is about to be read or written comes near: PoCL's prefetch() does
 * nothing. BATTEN_PREFETCH, which the host may define: clang's word for it is known, and all memory is one
 * space of addresses, as on a CPU. */
#if defined(BATTEN_PREFETCH)
#define FETCH(from) __builtin_prefetch((const void *)(size_t)(from), 0, 3)
#define FETCH_TO_WRITE(to) __builtin_prefetch((const void *)(size_t)(to), 1, 3)
#else
#define FETCH(from) prefetch(from, 1)
#define FETCH_TO_WRITE(to) ((void)(to))
#endif
#define GLOBAL global
#define LOCAL local
/* Unrolled loops cost PoCL half a minute of compiling and gain nothing: the lanes are unrolled
 * already. */
#define ROLLED _Pragma("unroll 1")
/* Loops over a basis or over lanes are short, fixed and worth it; PoCL needs to be told both. */
#if !defined(UNROLLED)
#define UNROLLED _Pragma("unroll")
#endif

#endif

#if defined(BATTEN_ABREAST)
#if BATTEN_LANES != 1
#error "searches abreast have a lane each"
#endif
typedef struct stored {
	real it[BATTEN_ABREAST];
} stored;
#define AT(a) ((a).it[0])
#define STORED_LANES BATTEN_ABREAST
#else
typedef real stored;
#define AT(a) (a)
#define STORED_LANES BATTEN_LANES /* scalars from one stored to the next */
#endif

/* Where a search's own numbers are, so many, in the global memory of all of them, and in that of STATE.
 * QUEUE_NUMBER: of those who work together: a group, or abreast a lane. */
#if defined(BATTEN_ABREAST)
#define ABREAST_LANE (get_local_id(0) % BATTEN_ABREAST)
#define QUEUE_NUMBER ((int)(get_group_id(0) * BATTEN_ABREAST + ABREAST_LANE))
#define OWN_GLOBAL(memory, count)                                                                  \
	((global stored *)((global real *)((global stored *)(memory) +                                 \
	                                   get_group_id(0) * (size_t)(count)) +                        \
	                   ABREAST_LANE))
#else
#define QUEUE_NUMBER ((int)get_group_id(0))
#define OWN_GLOBAL(memory, count) ((memory) + get_group_id(0) * (size_t)(count))
#endif
#if defined(STATE_IS_GLOBAL)
#define OWN_STATE(memory, count) OWN_GLOBAL(memory, count)
#else
#define OWN_STATE(memory, count) (memory)
#endif

/* Around barriers, though nobody waits at them, PoCL takes the kernel apart: three times the compiling. */
#if defined(BATTEN_ALONE)
#define ALONE 1
#define WORK_ITEM 0
#define WORK_ITEMS 1
#define WAIT ((void)0)
#else
#define ALONE 0
#if defined(BATTEN_ABREAST)
#define WORK_ITEM ((int)(get_local_id(0) / BATTEN_ABREAST))
#define WORK_ITEMS ((int)(get_local_size(0) / BATTEN_ABREAST))
#else
#define WORK_ITEM ((int)get_local_id(0))
#define WORK_ITEMS ((int)get_local_size(0))
#endif
#define WAIT barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)
#endif

/* Whether a condition holds for any search that waits at the same barriers: a way past one must be all's. `s` has
 * vote, LOCAL int *, one of the group. */
#if defined(BATTEN_ABREAST) && !ALONE
static inline int group_any(local int *vote, int condition)
{
	WAIT;
	if (get_local_id(0) == 0)
		*vote = 0;
	WAIT;
	if (condition)
		*vote = 1;
	WAIT;
	return *vote;
}
#define ANY_BESIDE(s, condition) group_any((s)->vote, condition)
#else
#define ANY_BESIDE(s, condition) ANY(condition)
#endif

/* a * b + c rounded once. Correct on every device, so strict arithmetic may use it. */
#if defined(BATTEN_DIALECT_C) && !BATTEN_DOUBLE
#define FUSED(a, b, c) fmaf(a, b, c)
#else
#define FUSED(a, b, c) fma(a, b, c)
#endif

#endif
