/* What a method is asked to meet, as measures of the variant. */
#ifndef BATTEN_VARIATION_TARGETS_H
#define BATTEN_VARIATION_TARGETS_H

#include "batten.h"

/* One measure, and the parameter of the method that asks for it: parameter = (value - zero) * scale. */
typedef struct variation_target {
	const char *name;
	size_t measure; /* number in batten_measures */
	double zero, scale;
	double asked;  /* as a parameter */
	bool relative; /* parameters of 0 leave the parent as it is */
} variation_target;

/* At most BATTEN_VARY_TARGETS_MOST; 0 for methods without. */
size_t variation_targets(const batten_vary_options *options, const batten_measures *parent,
                         variation_target *out);

double variation_target_value(const variation_target *target, const batten_measures *measures);

/* A target as outcomes tell it, asked being a parameter. */
struct batten_vary_target variation_target_tell(const variation_target *target,
                                                const batten_measures *parent, double asked,
                                                double got);

/* The reason of a variant out of reach: why, and of each of count targets what can be reached in the
 * proportion asked for (parameters, [count]): from least to most times the way from the parent. */
void variation_tell_reach(char *text, size_t size, batten_vary_method method, const char *why,
                          size_t count, const variation_target *targets, const double *asked,
                          const batten_measures *parent, double least, double most);

#endif
