/* The plain C path of kernels/fairing_pass.cl: one hull after another, the same bits. */
#ifndef BATTEN_REFERENCE_FAIRING_PASS_H
#define BATTEN_REFERENCE_FAIRING_PASS_H

#include <stdbool.h>
#include <stdint.h>

/* What the hulls of a batch share; the meaning of each is that of pass_program (pass_run.h). */
typedef struct reference_fairing_pass {
	const int32_t *shape, *operations, *row_first, *row_target, *term_index, *line_first,
		*point_from, *point_to;
} reference_fairing_pass;

/* state: the hull's values and constants, and room; in the end its new values. false: one of them is no
 * length. */
bool reference_fairing_pass_f64(const reference_fairing_pass *shared, const double *term_factor,
                                const double *point_along, double *state);
bool reference_fairing_pass_f32(const reference_fairing_pass *shared, const float *term_factor,
                                const float *point_along, float *state);

#endif
