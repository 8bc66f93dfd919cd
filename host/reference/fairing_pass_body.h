/* Body of host/reference/fairing_pass_f64.c and _f32.c, compiled once per precision: the includer
 * defines BATTEN_DOUBLE and FAIRING_PASS_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#include "shared/dialect.h"
#include "shared/pass_run.h"

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
		pass_run(&program, state);
	return sound;
}
