/* A symmetric positive definite system whose rows reach back to a first column each, factored once and
 * written as rows of a fairing pass. */
#ifndef BATTEN_FAIRING_PASS_SYSTEM_H
#define BATTEN_FAIRING_PASS_SYSTEM_H

#include "fairing/pass_writer.h"

typedef struct pass_system {
	batten_context *context;
	size_t count;
	size_t *first;  /* [count]: first column of each row */
	size_t *start;  /* [count + 1]: place of row i's number in column j: start[i] + j - first[i] */
	double *values; /* lower triangle, zero at first; the factor later */
} pass_system;

/* first is copied. Errors: MEMORY. */
batten_status pass_system_create(batten_context *context, size_t count, const size_t *first,
                                 pass_system *out);
void pass_system_release(pass_system *system);

/* Adds to the number in row i and column j, in either order. */
void pass_system_add(pass_system *system, size_t i, size_t j, double value);

/* Cholesky; false where a pivot is nothing but rounding. */
bool pass_system_factor(pass_system *system);

/* Solves for the numbers at right[i], which the solution replaces: rows in tiles,
 * each multiplied by the inverse of its part of the diagonal. */
void pass_system_write(const pass_system *system, pass_writer *writer, const size_t *right);

#endif
