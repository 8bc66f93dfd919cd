/* A batch of surfaces of one topology made ready to be put into the water: tables that all share, and the
 * poles of each. Here they are only numbers. */
#ifndef BATTEN_BATCH_AFLOAT_PLAN_H
#define BATTEN_BATCH_AFLOAT_PLAN_H

#include "core/context.h"
#include "shared/afloat_layout.h"

/* What all surfaces share; u first. Orders 2..AFLOAT_ORDER_MOST, knots [count + order] not decreasing,
 * points of Gauss's rule 1..GAUSS_POINTS_MOST an interval. */
typedef struct afloat_topology {
	size_t order[2], count[2];
	const double *knots[2];
	bool rational;
	size_t points;
} afloat_topology;

/* One surface; arrays borrowed. */
typedef struct afloat_item {
	const double *poles_m, *weights; /* [v][u][3]; [v][u] or NULL, as all in the batch */
} afloat_item;

typedef struct afloat_plan {
	batten_context *context;
	int32_t shape[AFLOAT_SHAPE_SIZE];
	int32_t *lists;
	size_t list_count;
	double *tables;
	size_t table_count;
	int device;
	unsigned lanes, work_group; /* 0 chooses */
	size_t count;
	const afloat_item *items;
	double *out; /* [count][afloat_plan_outcome()] */
} afloat_plan;

/* Sizes and tables; lbp 0 takes x of the foremost point of each. Errors: MEMORY. */
batten_status afloat_plan_create(batten_context *context, const afloat_topology *topology,
                                 size_t draft_count, const double *drafts_m, double lbp_m,
                                 afloat_plan *out);
void afloat_plan_destroy(afloat_plan *plan);

size_t afloat_plan_net(const afloat_plan *plan);     /* numbers of a net */
size_t afloat_plan_outcome(const afloat_plan *plan); /* numbers known of a surface */
size_t afloat_plan_room(const afloat_plan *plan, size_t work_items);

/* Writes surface `which` into lane `lane` of poles [v][u][dimension][lanes]. */
void afloat_pack(const afloat_plan *plan, size_t which, size_t lane, size_t lanes, double *poles);
/* Takes what is known of it from out [afloat_plan_outcome()][lanes]. */
void afloat_unpack(const afloat_plan *plan, size_t which, size_t lane, size_t lanes,
                   const double *out);

#endif
