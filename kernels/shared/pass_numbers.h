/* Half-breadths as they come to a fairing pass and go, LOAD and STORE: doubles, or numbers of its precision;
 * and vectors of numbers that lie side by side, READ and WRITE. OpenCL only.
 *
 * Defined by the host: NUMBER_DOUBLE, whether they are doubles. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_NUMBERS_H
#define BATTEN_SHARED_PASS_NUMBERS_H

#if !defined(NUMBER_DOUBLE)
#define NUMBER_DOUBLE BATTEN_DOUBLE
#endif
#if NUMBER_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define NUMBER_NAME double
#else
#define NUMBER_NAME float
#endif
typedef NUMBER_NAME number;
#if BATTEN_LANES == 1
#define LOAD(from) ((real)(*(from)))
#define STORE(a, to) (*(to) = (number)(a))
#define READ(from) (*(from))
#define WRITE(a, to) (*(to) = (a))
#else
#define AS(name, lanes) BATTEN_PASTE(convert_, BATTEN_PASTE(name, lanes))
/* Vectors that begin anywhere: PoCL makes two stores of a vstore. */
typedef struct __attribute__((packed)) loose_numbers {
	BATTEN_PASTE(NUMBER_NAME, BATTEN_LANES) vector;
} loose_numbers;
typedef struct __attribute__((packed)) loose_real {
	real vector;
} loose_real;
#define LOAD(from)                                                                                 \
	AS(BATTEN_REAL_NAME, BATTEN_LANES)(((global const loose_numbers *)(from))->vector)
#define STORE(a, to) (((global loose_numbers *)(to))->vector = AS(NUMBER_NAME, BATTEN_LANES)(a))
#define READ(from) (((global const loose_real *)(from))->vector)
#define WRITE(a, to) (((global loose_real *)(to))->vector = (a))
#endif

#endif
