/* How a kernel of one item for a whole problem is compiled as C. fma() is one instruction where the processor
 * has it and a function of the C library elsewhere, ten times slower with the same result: all is inlined into
 * one function for each, formulas too. Not where a sanitizer's checks make that function a burden to its
 * compiler: 42 s in place of 2 for surfaces afloat. */
#ifndef BATTEN_REFERENCE_INLINED_H
#define BATTEN_REFERENCE_INLINED_H

#define BATTEN_DOUBLE 1
#define BATTEN_DIALECT_C
#include "shared/dialect.h"

#ifdef BATTEN_SANITIZED
#define INLINED static inline
#else
#define INLINED static inline __attribute__((always_inline))
#endif
#undef SHARED_FUNCTION
#define SHARED_FUNCTION INLINED

#endif
