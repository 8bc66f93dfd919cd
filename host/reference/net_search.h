/* The pattern search over a control net in plain C, one search at a time: what kernels/net_search.cl
 * does, equal to it bit for bit. Layout is the kernel's (shared/net_layout.h), with one lane. */
#ifndef BATTEN_REFERENCE_NET_SEARCH_H
#define BATTEN_REFERENCE_NET_SEARCH_H

#include <stdint.h>

/* What all searches of a batch share, beyond the tables. */
typedef struct reference_net_search {
	int order_u, order_v, fairness;
	const int32_t *shape; /* NET_SHAPE_SIZE */
	const int32_t *first_u, *first_v;
	const int32_t *colours, *directions, *members;
} reference_net_search;

/* tables: NET_TABLE_SIZE(order_u) a sample along u, then of v. arrays [NET_ARRAY_COUNT][poles],
 * settings [NET_SETTING_COUNT], outcome [SEARCH_OUTCOME_COUNT]; kept has room for NET_KEPT_SIZE (_THIRD) numbers
 * a sample, scratch for NET_STATE_NUMBERS of one work-item. */
void reference_net_search_f64(const reference_net_search *shared, const double *tables,
                              const double *heights, const double *samples, double *arrays,
                              const double *settings, double *outcome, double *kept,
                              double *scratch);
void reference_net_search_f32(const reference_net_search *shared, const float *tables,
                              const float *heights, const float *samples, float *arrays,
                              const float *settings, float *outcome, float *kept, float *scratch);

#endif
