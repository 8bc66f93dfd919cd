#include "variation/targets.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

#define MEASURE(name) (offsetof(batten_measures, name) / sizeof(double))

double variation_target_value(const variation_target *target, const batten_measures *measures)
{
	/* The struct is an array of doubles in the order of the names (batten.h). */
	return ((const double *)measures)[target->measure];
}

struct batten_vary_target variation_target_tell(const variation_target *target,
                                                const batten_measures *parent, double asked,
                                                double got)
{
	return (struct batten_vary_target){ .name = target->name,
		                                .parent = variation_target_value(target, parent),
		                                .asked = target->zero + asked / target->scale,
		                                .got = got };
}

/* A change in percent of the parent's value. */
static variation_target part(size_t measure, const batten_measures *parent, double asked)
{
	variation_target target = {
		.name = batten_measure_name(measure), .measure = measure, .asked = asked, .relative = true
	};
	target.zero = variation_target_value(&target, parent);
	target.scale = 100 / target.zero;
	return target;
}

/* A difference from the parent's value. */
static variation_target difference(size_t measure, const batten_measures *parent, double asked)
{
	variation_target target = { .name = batten_measure_name(measure),
		                        .measure = measure,
		                        .asked = asked,
		                        .scale = 1,
		                        .relative = true };
	target.zero = variation_target_value(&target, parent);
	return target;
}

/* A value; NaN takes the parent's. */
static variation_target value(size_t measure, const batten_measures *parent, double asked)
{
	variation_target target = { .name = batten_measure_name(measure),
		                        .measure = measure,
		                        .scale = 1 };
	target.asked = isnan(asked) ? variation_target_value(&target, parent) : asked;
	return target;
}

size_t variation_targets(const batten_vary_options *options, const batten_measures *parent,
                         variation_target *out)
{
	const size_t lcb = MEASURE(lcb_pct_lbp_fwd), cp = MEASURE(cp);
	switch (options->method) {
	case BATTEN_VARY_SWING:
		out[0] = difference(lcb, parent, options->dlcb_pct);
		return 1;
	case BATTEN_VARY_ONE_MINUS_PRISMATIC:
	case BATTEN_VARY_LACKENBY:
		out[0] = part(cp, parent, options->dcp_pct);
		out[1] = difference(lcb, parent, options->dlcb_pct);
		return 2;
	case BATTEN_VARY_MOOR:
		out[0] = part(MEASURE(cb), parent, options->dcp_pct);
		out[1] = difference(lcb, parent, options->dlcb_pct);
		out[2] = part(MEASURE(cwp), parent, options->dcwp_pct);
		out[3] = difference(MEASURE(lcf_pct_lbp_fwd), parent, options->dlcf_pct);
		return 4;
	case BATTEN_VARY_THREE_BODY:
		out[0] = value(MEASURE(volume_m3), parent, options->volume_m3);
		out[1] = value(lcb, parent, options->lcb_pct_lbp_fwd);
		out[2] = value(cp, parent, options->cp);
		return 3;
	default:
		return 0;
	}
}

void variation_tell_reach(char *text, size_t size, batten_vary_method method, const char *why,
                          size_t count, const variation_target *targets, const double *asked,
                          const batten_measures *parent, double least, double most)
{
	char range[256] = "";
	size_t used = 0;
	for (size_t i = 0; i < count && used < sizeof range; i++) {
		const double zero = variation_target_value(&targets[i], parent);
		const double step = asked[i] / targets[i].scale + targets[i].zero - zero;
		const double a = zero + least * step, b = zero + most * step;
		const int length = snprintf(range + used, sizeof range - used, "%s%s %.4g to %.4g",
		                            i > 0 ? ", " : "", targets[i].name, fmin(a, b), fmax(a, b));
		used += length > 0 ? (size_t)length : 0;
	}
	(void)snprintf(text, size,
	               "%s: out of reach (%s); in the proportion asked for %s can be reached",
	               batten_vary_method_name((size_t)method), why, range);
}
