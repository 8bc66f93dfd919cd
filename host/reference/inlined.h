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

#endif
