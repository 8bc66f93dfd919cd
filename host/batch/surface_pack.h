/* Surfaces packed lane by lane, in the precision of the plan: what a device or the C path reads and
 * writes. Value v of lane l is number v * lanes + l. */
#ifndef BATTEN_BATCH_SURFACE_PACK_H
#define BATTEN_BATCH_SURFACE_PACK_H

#include "batch/surface_plan.h"

/* Bytes of a table, and the table in the precision of the plan. */
size_t surface_pack_table_size(const surface_plan *plan, const surface_samples *samples);
void surface_pack_table(const surface_plan *plan, const surface_samples *samples, void *table);

/* Numbers of one net. */
size_t surface_pack_net_count(const surface_plan *plan);

/* Writes a surface into lane `lane` of net [u][v][coordinate][lanes] and least_area [lanes]. */
void surface_pack_net(const surface_plan *plan, const surface_item *item, size_t lane, size_t lanes,
                      void *net, void *least_area);

/* Takes one line into the plan's values of surface `which`: value v of sample n is number
 * v * value_stride + n * stride, all doubles or, where the plan
 * has f32, all floats. */
void surface_take_line(const surface_plan *plan, size_t which, size_t line, const void *numbers,
                       bool doubles, size_t value_stride, size_t stride);

/* Completes a line that is in the plan's values. missing: it may have points without a normal, whose
 * mean curvature is a mark; they become singular ones. */
void surface_mark_line(const surface_plan *plan, size_t which, size_t line, bool missing);

/* Adds the sums of one line of one lane, weighted, to those of surface `which`; points are counted.
 * The lines of a surface come in their order. */
void surface_add_sums(const surface_plan *plan, size_t which, size_t line, size_t lane,
                      size_t lanes, const void *numbers);

#endif
