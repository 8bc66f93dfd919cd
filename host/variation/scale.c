/* Hulls whose coordinates change while the table stays a table: affine (Letcher 10.1) and x' = f(x)
 * (Letcher 10.3). */
#include "variation/monotone.h"
#include "variation/variation.h"

#include <math.h>

/* Where x goes; any other coordinate is scaled. */
typedef double along(double x_m, const void *user);

static void scale_extras(batten_hull *variant, along *f, const void *user, double beta,
                         double delta)
{
	for (size_t i = 0; i < variant->end_count; i++) {
		hull_line_end *end = &variant->ends[i];
		end->along_m = end->on_waterline ? f(end->along_m, user) : delta * end->along_m;
		end->y_m *= beta;
	}
	for (size_t i = 0; i < variant->profile_count; i++) {
		hull_profile_point *point = &variant->profile[i];
		point->x_m = f(point->x_m, user);
		point->y_m *= beta;
		point->z_m *= delta;
	}
	for (size_t i = 0; i < variant->knuckle_count; i++) {
		variant->knuckles[i].x_m = f(variant->knuckles[i].x_m, user);
		variant->knuckles[i].z_m *= delta;
	}
}

/* Everything of a hull but its length, which the caller knows. */
static batten_status scale(batten_hull *variant, along *f, const void *user, double beta,
                           double delta)
{
	for (size_t s = 0; s < variant->station_count; s++)
		variant->x_m[s] = f(variant->x_m[s], user);
	for (size_t w = 0; w < variant->waterline_count; w++)
		variant->z_m[w] *= delta;
	for (size_t i = 0; i < hull_node_count(variant); i++)
		variant->y_m[i] *= beta;
	variant->draft_m *= delta;
	variant->depth_m *= delta;
	scale_extras(variant, f, user, beta, delta);
	const batten_status status = variation_check_size(variant);
	size_t filled = 0;
	return status == BATTEN_OK ? hull_fill_unknown(variant, &filled) : status;
}

batten_status variation_check_size(const batten_hull *variant)
{
	const double *x = variant->x_m, *z = variant->z_m;
	bool good = variant->lbp_m >= HULL_SMALLEST_STEP_M && variant->lbp_m <= HULL_LARGEST_M &&
	            variant->draft_m >= HULL_SMALLEST_STEP_M && variant->draft_m <= HULL_LARGEST_M &&
	            fabs(x[0]) <= HULL_LARGEST_M && fabs(z[0]) <= HULL_LARGEST_M &&
	            fabs(x[variant->station_count - 1]) <= HULL_LARGEST_M &&
	            fabs(z[variant->waterline_count - 1]) <= HULL_LARGEST_M;
	for (size_t s = 1; good && s < variant->station_count; s++)
		good = x[s] - x[s - 1] >= HULL_SMALLEST_STEP_M;
	for (size_t w = 1; good && w < variant->waterline_count; w++)
		good = z[w] - z[w - 1] >= HULL_SMALLEST_STEP_M;
	for (size_t i = 0; good && i < hull_node_count(variant); i++)
		good = variant->y_m[i] >= 0 && variant->y_m[i] <= HULL_LARGEST_M;
	for (size_t i = 1; good && i < variant->end_count; i++) {
		const hull_line_end *before = &variant->ends[i - 1], *end = &variant->ends[i];
		good = before->on_waterline != end->on_waterline || before->line != end->line ||
		       end->along_m > before->along_m;
	}
	if (!good)
		return batten_fail(variant->context, BATTEN_INPUT,
		                   "%s: the variant's table would not ascend or be larger than %g m",
		                   variant->name, HULL_LARGEST_M);
	return BATTEN_OK;
}

static double times(double x_m, const void *user)
{
	return *(const double *)user * x_m;
}

batten_status variation_affine(batten_context *context, const batten_hull *parent,
                               const batten_vary_options *options, batten_hull **out)
{
	batten_hull *variant = NULL;
	batten_status status = batten_hull_clone(context, parent, &variant);
	if (status != BATTEN_OK)
		return status;
	variant->lbp_m *= options->scale_x;
	status = scale(variant, times, &options->scale_x, options->scale_y, options->scale_z);
	if (status != BATTEN_OK) {
		batten_hull_destroy(variant);
		return status;
	}
	*out = variant;
	return BATTEN_OK;
}

batten_status variation_stretch_along(batten_context *context, const batten_hull *parent,
                                      size_t count, const double *from_m, const double *to_m,
                                      bool straight, batten_hull **out)
{
	batten_hull *variant = NULL;
	batten_status status = batten_hull_clone(context, parent, &variant);
	if (status != BATTEN_OK)
		return status;
	struct monotone map;
	status = monotone_create(context, count, from_m, to_m, straight, &map);
	if (status == BATTEN_OK) {
		/* The aft perpendicular stays the origin. */
		map.origin = 0;
		map.origin = monotone_value(0, &map);
		variant->lbp_m = monotone_value(parent->lbp_m, &map);
		status = scale(variant, monotone_value, &map, 1, 1);
		monotone_destroy(&map);
	}
	if (status != BATTEN_OK) {
		batten_hull_destroy(variant);
		return status;
	}
	*out = variant;
	return BATTEN_OK;
}

batten_status variation_stretch(batten_context *context, const batten_hull *parent,
                                const batten_vary_options *options, batten_hull **out)
{
	const size_t count = options->point_count;
	double *from = batten_allocate(context, count, 2 * sizeof *from);
	if (!from)
		return BATTEN_MEMORY;
	double *to = from + count;
	for (size_t i = 0; i < count; i++) {
		from[i] = options->from_part[i] * parent->lbp_m;
		to[i] = options->to_part[i] * parent->lbp_m;
	}
	const batten_status status = variation_stretch_along(context, parent, count, from, to, false,
	                                                     out);
	batten_release(context, from);
	return status;
}
