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

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) static void
work_with_fma(const int32_t *shape, const int32_t *lists, const double *tables, const double *poles,
              double *out, double *room)
{
	work_surface(shape, lists, tables, poles, out, room);
}
#endif

void reference_surface_hydrostatics(const int32_t *shape, const int32_t *lists,
                                    const double *tables, const double *poles, double *out,
                                    double *room)
{
#if defined(__x86_64__)
	if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
		work_with_fma(shape, lists, tables, poles, out, room);
		return;
	}
#endif
	work_surface(shape, lists, tables, poles, out, room);
}
