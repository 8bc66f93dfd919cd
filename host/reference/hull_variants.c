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

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) static void
work_with_fma(const int32_t *shape, const int32_t *lists, const double *tables, const double *asked,
              double *y, double *out, double *room)
{
	work_hull(shape, lists, tables, asked, y, out, room);
}
#endif

void reference_hull_variants(const int32_t *shape, const int32_t *lists, const double *tables,
                             const double *asked, double *y, double *out, double *room)
{
#if defined(__x86_64__)
	if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
		work_with_fma(shape, lists, tables, asked, y, out, room);
		return;
	}
#endif
	work_hull(shape, lists, tables, asked, y, out, room);
}
