/* The plain C path of kernels/hull_variants.cl. */
#include "reference/hull_variants.h"

#define BATTEN_DOUBLE 1
#define BATTEN_DIALECT_C
#include "shared/dialect.h"

#include "reference/inlined.h"
#include "shared/variants_course.h"

INLINED void work_hull(const int32_t *shape, const int32_t *lists, const double *tables,
                       const double *asked, double *y, double *out, double *room)
{
	const variants_state s = variants_state_in(shape, lists, tables, room, 0);
	variants_run_group(&s, asked, y, out);
}

WITH_FMA_WHERE_THERE_IS(reference_hull_variants, work_hull,
                        (const int32_t *shape, const int32_t *lists, const double *tables,
                         const double *asked, double *y, double *out, double *room),
                        (shape, lists, tables, asked, y, out, room))
