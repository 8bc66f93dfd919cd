/* A batch of surfaces made ready to run: what all share (tables of the bases at the samples) and what
 * each has of its own. Whoever knows knots fills in the tables; here they are only numbers. */
#ifndef BATTEN_BATCH_SURFACE_PLAN_H
#define BATTEN_BATCH_SURFACE_PLAN_H

#include "core/context.h"
#include "shared/surface_layout.h"

enum { SURFACE_ORDER_LEAST = 2, SURFACE_ORDER_MOST = 8 };

/* One direction: its basis at every sample. */
typedef struct surface_samples {
	size_t order, poles, count, rows; /* rows: SURFACE_TABLE_ROWS of the output */
	int32_t *first;                   /* the first of `order` poles the sample sees */
	double *table;                    /* SURFACE_TABLE_SIZE(rows, order) a sample */
} surface_samples;

/* One surface of the batch; arrays borrowed. */
typedef struct surface_item {
	const double *poles_m, *weights; /* [v][u][3]; [v][u] or NULL, as all in the batch */
	double area; /* an area element the net has: smaller ones by far are rounding */
} surface_item;

typedef struct surface_plan {
	batten_context *context;
	int output; /* SURFACE_OUTPUT_... */
	bool rational;
	surface_samples u, v;
	double light[3];       /* a unit vector, of isophotes */
	size_t segment_length; /* samples along u summed together; divides their number */
	int device;
	batten_precision precision;
	unsigned lanes, work_group; /* 0 chooses */
	size_t count;
	const surface_item *items;
	/* [count][values][v][u] of the output, doubles or floats; or [count][SURFACE_SUM_COUNT], doubles */
	void *values;
	bool floats;       /* values are floats; with f32 only, not for sums */
	uint8_t *singular; /* [count][v][u] or NULL; not for sums */
} surface_plan;

/* Lanes and work-items in the ranges of the public options. Errors: USAGE. */
batten_status surface_plan_check(const surface_plan *plan);

/* Values of a sample; of a line where there are sums. */
size_t surface_plan_values(const surface_plan *plan);
/* Numbers of a line. */
size_t surface_plan_line_size(const surface_plan *plan);
/* Bytes of a number of the plan's values. */
size_t surface_plan_number(const surface_plan *plan);
/* Coordinates of a pole, homogeneous where rational. */
size_t surface_plan_dimension(const surface_plan *plan);
/* Derivatives kept when the net is taken together along v, the point among them. */
size_t surface_plan_derivatives(const surface_plan *plan);

#endif
