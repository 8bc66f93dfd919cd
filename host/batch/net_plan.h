/* A batch of searches over control nets made ready to run: what all share (tables of the bases at the
 * samples, directions) and what each has of its own. Whoever knows knots fills in the tables; here
 * they are only numbers. */
#ifndef BATTEN_BATCH_NET_PLAN_H
#define BATTEN_BATCH_NET_PLAN_H

#include "batch/search_plan.h"
#include "shared/net_layout.h"

enum { NET_STRETCH_MOST = 12 };

/* One direction of the net: its basis at every sample. */
typedef struct net_samples {
	size_t order, poles, count;
	size_t points;  /* samples a span */
	int32_t *first; /* the first of `order` poles the sample sees */
	double *table;  /* NET_TABLE_SIZE(order) a sample */
} net_samples;

/* One search; arrays borrowed, [v][u]. */
typedef struct net_item {
	const double *poles_m; /* of the start, x, y, z each */
	const double *target_y_m, *lower_y_m, *upper_y_m;
	double w1, w2, half_beam_m;
	const char *fault; /* why it cannot be searched, or NULL */
	/* How much wider poles lie along u than along v: log2, rounded, within NET_STRETCH_MOST; 0 where nothing
	 * asks for it. */
	int stretch;
} net_item;

/* The directions of a search, by colour. Those of one colour share no sample, so that neither reads a
 * pole the other moves. */
typedef struct net_directions {
	size_t colour_count, direction_count, member_count;
	int32_t *colours;    /* first direction of each colour and the end of the last */
	int32_t *directions; /* NET_DIRECTION_SIZE each */
	int32_t *members;    /* poles */
	double *heights;     /* of the members */
} net_directions;

typedef struct net_plan {
	batten_context *context;
	batten_search_options options; /* with every 0 replaced by what it chooses */
	int fairness;                  /* NET_FAIRNESS_... */
	bool block;                    /* by the block search, else by the multilevel one */
	net_samples u, v;
	const size_t *leader; /* [v][u], never NULL */
	size_t count;
	net_item *items;
	double *y_m; /* [count][v][u] */
	batten_search_result *results;
	net_directions directions; /* of the searches of one stretch */
} net_plan;

/* Lays out the directions for the searches of a stretch: those that can move a pole of at least one.
 * net_directions_release() afterwards. Errors: MEMORY. */
batten_status net_directions_create(const net_plan *plan, int stretch, net_directions *out);
void net_directions_release(batten_context *context, net_directions *directions);

/* How far a leader and what follows it may move from the start, kept in the box: down <= 0 <= up. */
typedef struct net_room {
	double down, up;
} net_room;

/* Room of every pole, [v][u]: that of its leader. */
void net_rooms_of(const net_plan *plan, const net_item *item, net_room *rooms);

/* Directions of the plan that can move at least one pole with these rooms. */
uint64_t net_directions_moving(const net_plan *plan, const net_room *rooms);

/* y kept within bounds. Every pole of a batch asks several times: no call of fmin() and fmax(). */
static inline double net_within(double y, double lower, double upper)
{
	const double above = y > lower ? y : lower;
	return above < upper ? above : upper;
}

/* The start of a pole, moved into its box. */
double net_start_of(const net_item *item, size_t pole);

/* The o-th pole where the shorter direction runs first, for a narrow band. */
size_t net_plan_in_turn(const net_plan *plan, size_t o);

/* Poles of the net; numbers of a sample. */
size_t net_plan_poles(const net_plan *plan);
size_t net_plan_sample_size(const net_plan *plan);

#endif
