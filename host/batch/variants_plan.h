/* A batch of hulls on one table made ready to run: tables that all share and what each row asks for.
 * Whoever knows hulls fills in the tables (shared/variants_layout.h); here they are only numbers. */
#ifndef BATTEN_BATCH_VARIANTS_PLAN_H
#define BATTEN_BATCH_VARIANTS_PLAN_H

#include "core/context.h"
#include "shared/variants_layout.h"

/* Larger tables are no batch: their weights grow with the square of the waterlines. */
enum { VARIANTS_LINES_MOST = 256, VARIANTS_DRAFTS_MOST = 64 };

typedef struct variants_plan {
	batten_context *context;
	int32_t shape[VARIANTS_SHAPE_SIZE];
	int32_t *lists; /* offsets [waterlines], then the lists; made by whoever has '?' nodes */
	size_t list_count;
	double *tables;
	size_t table_count;
	int device;
	unsigned lanes, work_group; /* 0 chooses */
	/* the rows */
	size_t count;
	const double *asked;  /* [count][VARIANTS_ASK_COUNT]; NULL where half-breadths are given */
	const double *y_m;    /* given: [count][N] */
	const uint8_t *nodes; /* batten_node, [count][N]; of all hulls alike [N] */
	bool nodes_alike;
	double *found_y_m; /* [count][N], below 0: outside; or NULL */
	double *out;       /* [count][variants_plan_outcome()] */
} variants_plan;

/* Sizes and tables, all 0, ends NONE. Errors: MEMORY. */
batten_status variants_plan_create(batten_context *context, size_t stations, size_t waterlines,
                                   size_t drafts, variants_plan *out);
void variants_plan_destroy(variants_plan *plan);

/* The table that begins at shape[at]. */
double *variants_plan_table(const variants_plan *plan, int at);

size_t variants_plan_nodes(const variants_plan *plan);   /* N */
size_t variants_plan_outcome(const variants_plan *plan); /* numbers known of a row */
size_t variants_plan_room(const variants_plan *plan, size_t work_items);

/* Fills what no options given means, and checks; a device is looked for when the batch runs. Errors:
 * USAGE. */
batten_status variants_options(batten_context *context, const batten_batch_options *options,
                               batten_batch_options *out);

/* Adds to what ran a batch that so many of its hulls were worked one by one, on the host. */
void variants_tell_singly(batten_run *run, size_t singly, size_t count);

/* Writes row `which` into lane `lane`: asked [VARIANTS_ASK_COUNT][lanes], y [N][lanes]. */
void variants_pack(const variants_plan *plan, size_t which, size_t lane, size_t lanes,
                   double *asked, double *y);
/* Takes it back from y and out [variants_plan_outcome()][lanes]. */
void variants_unpack(const variants_plan *plan, size_t which, size_t lane, size_t lanes,
                     const double *y, const double *out);

#endif
