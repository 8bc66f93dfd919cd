/* Searches packed lane by lane, in the precision of the plan: what a device or the C path reads and
 * writes. Value v of lane l is number v * lanes + l. */
#ifndef BATTEN_BATCH_SEARCH_PACK_H
#define BATTEN_BATCH_SEARCH_PACK_H

#include "batch/search_plan.h"

/* Bytes of one number in the precision of the plan. */
size_t search_scalar_size(const search_plan *plan);

/* Stencils of the stations, then of the waterlines, in the precision of the plan. */
size_t search_stencil_count(const search_plan *plan);
void search_pack_stencils(const search_plan *plan, void *stencils);

/* What a search found at its nodes becomes, in its place, where it left them: within the bounds, and what did
 * not move as it went in, not rounded to f32. */
void search_take_ends(const search_plan *plan, const batten_search_problem *problem, double *y_m);

/* A box as a search with an interior penalty takes it: its bounds rounded inwards, so that what is inside
 * in f32 is inside in f64. false: no number of the precision is inside, and the node is held. */
bool search_box_inside(batten_precision precision, double *lower, double *upper);

/* Writes number `which` of the plan's problems into lane `lane` of arrays[SEARCH_ARRAY_COUNT][node_count][lanes] and
 * settings[SEARCH_SETTING_COUNT][lanes], all zero before. A lane left at zero is idle. */
void search_pack(const search_plan *plan, const batten_search_problem *problems, size_t which,
                 size_t lane, size_t lanes, void *arrays, void *settings);

/* Takes a lane's end: y_m of the nodes on the hull (the others get the start) and the result. */
void search_unpack(const search_plan *plan, const batten_search_problem *problem, size_t lane,
                   size_t lanes, const void *y, const void *outcome, double *y_m,
                   batten_search_result *result);

#endif
