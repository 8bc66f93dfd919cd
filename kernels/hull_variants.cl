/* Many hulls on one table: variants of a parent by rows of parameters, or half-breadths that are given,
 * and their hydrostatics at every draft, whole hulls in one launch.
 *
 * A work-group has BATTEN_LANES hulls side by side, one a lane of `real`; its work-items share
 * waterlines, stations and drafts. On a CPU: many lanes, one work-item. On a GPU: one lane, some
 * work-items. Every line and every sum is worked in one fixed order by one work-item, so the shape does
 * not change a bit of the result.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE (local, or global for tables whose room does
 * not fit local memory). */
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/variants_course.h"

/* shape: VARIANTS_SHAPE_SIZE numbers, lists and tables: variants_layout.h. asked
 * [group][VARIANTS_ASK_COUNT], y [group][N], out [group][VARIANTS_OUT_COUNT + drafts *
 * VARIANTS_FORM_COUNT], all of real. room: VARIANTS_ROOM and VARIANTS_ITEM_ROOM a work-item, of real a
 * group. */
kernel void hull_variants(global const int *shape, global const int *lists,
                          global const scalar *tables, global const real *asked, global real *y,
                          global real *out, STATE real *room)
{
	const size_t group = get_group_id(0);
	const int stations = shape[VARIANTS_STATIONS], waterlines = shape[VARIANTS_WATERLINES];
	const int drafts = shape[VARIANTS_DRAFTS];
#if defined(STATE_IS_GLOBAL)
	room += group * (size_t)(VARIANTS_ROOM(stations, waterlines, drafts) +
	                         WORK_ITEMS * VARIANTS_ITEM_ROOM(stations, waterlines));
#endif
	const variants_state s = variants_state_in(shape, lists, tables, room, WORK_ITEM);
	variants_run_group(&s, asked + group * VARIANTS_ASK_COUNT,
	                   y + group * (size_t)(waterlines * stations),
	                   out + group * (size_t)(VARIANTS_OUT_COUNT + drafts * VARIANTS_FORM_COUNT));
}
