/* Many surfaces of one topology afloat, at every draft: volumes, waterplanes, waterlines, sections.
 *
 * A work-group has BATTEN_LANES surfaces side by side, one a lane of `real`; its work-items share the
 * drafts. On a CPU: many lanes, one work-item. On a GPU: one lane, some work-items. Every sum is worked in
 * one fixed order by one work-item, so the shape does not change a bit of the result.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE (local, or global for nets whose room does not
 * fit local memory). */
#define BATTEN_DIALECT_OPENCL
#include "shared/afloat_course.h"
#include "shared/dialect.h"

/* shape: AFLOAT_SHAPE_SIZE numbers, lists and tables: afloat_layout.h. poles [group][v][u][dimension], out
 * [group][AFLOAT_OUTCOME], all of real. room: AFLOAT_ROOM a work-item, of real a group. */
kernel void surface_hydrostatics(global const int *shape, global const int *lists,
                                 global const scalar *tables, global const real *poles,
                                 global real *out, STATE real *room)
{
	const size_t group = get_group_id(0);
	const int count_u = shape[AFLOAT_COUNT], count_v = shape[AFLOAT_COUNT + 1];
	const int drafts = shape[AFLOAT_DRAFTS], size = AFLOAT_ROOM(count_u, count_v);
#if defined(STATE_IS_GLOBAL)
	room += group * (size_t)(WORK_ITEMS * size);
#endif
	const afloat_state s = afloat_state_in(
		shape, lists, tables, poles + group * (size_t)(count_u * count_v * shape[AFLOAT_DIMENSION]),
		room + WORK_ITEM * size);
	afloat_run_group(&s, out + group * (size_t)AFLOAT_OUTCOME(drafts));
}
