/* Body of host/reference/fairing_pass_f64.c and _f32.c, compiled once per precision: the includer
 * defines BATTEN_DOUBLE and FAIRING_PASS_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#include "shared/dialect.h"
#include "shared/pass_run.h"
#include "shared/pass_stretch.h"

#include <string.h>

/* The same source for processors with a multiply-add of their own, where FUSED is one instruction, and
 * for others, where it is a call: the bits are the same. */
static inline void run_stretches(const pass_program *program, scalar *state)
{
	const int operations = program->shape[PASS_SHAPE_OPERATIONS];
	for (int n = 0; n < operations * program->shape[PASS_SHAPE_ITERATIONS]; n++) {
		const int *operation = program->operations + n % operations * PASS_OPERATION_SIZE;
		const int first = operation[PASS_FIRST] * STRETCH_PARTS;
		for (int part = first; part < first + operation[PASS_COUNT] * STRETCH_PARTS; part++) {
			scalar sum[STRETCH_HULLS][STRETCH_SUMS];
			stretch_sum(program, part, state, 0, sum);
			memcpy(state + stretch_target(program, part), sum[0], sizeof sum[0]);
		}
	}
}

static inline void run_either(const pass_program *program, scalar *state)
{
	if (program->shape[PASS_SHAPE_STRETCHES])
		run_stretches(program, state);
	else
		pass_run(program, state, NULL);
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"), flatten)) static void run_with_fma(const pass_program *program,
                                                                      scalar *state)
{
	run_either(program, state);
}
#endif

static void run(const pass_program *program, scalar *state)
{
#if defined(__x86_64__)
	if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
		run_with_fma(program, state);
		return;
	}
#endif
	run_either(program, state);
}

bool FAIRING_PASS_FUNCTION(const reference_fairing_pass *shared, const scalar *term_factor,
                           const scalar *point_along, scalar *state)
{
	const pass_program program = {
		.shape = shared->shape,
		.operations = shared->operations,
		.row_first = shared->row_first,
		.row_target = shared->row_target,
		.term_index = shared->term_index,
		.term_factor = term_factor,
		.line_first = shared->line_first,
		.point_from = shared->point_from,
		.point_to = shared->point_to,
		.point_along = point_along,
	};
	const bool sound = pass_refused(shared->shape, state) == 0;
	if (sound)
		run(&program, state);
	return sound;
}
