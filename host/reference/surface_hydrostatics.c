/* The plain C path of kernels/surface_hydrostatics.cl. */
#include "reference/surface_hydrostatics.h"

#define BATTEN_DOUBLE 1
#define BATTEN_DIALECT_C
#include "shared/dialect.h"

#include "reference/inlined.h"
#include "shared/afloat_course.h"

INLINED void work_surface(const int32_t *shape, const int32_t *lists, const double *tables,
                          const double *poles, double *out, double *room)
{
	const afloat_state s = afloat_state_in(shape, lists, tables, poles, room);
	afloat_run_group(&s, out);
}

WITH_FMA_WHERE_THERE_IS(reference_surface_hydrostatics, work_surface,
                        (const int32_t *shape, const int32_t *lists, const double *tables,
                         const double *poles, double *out, double *room),
                        (shape, lists, tables, poles, out, room))
