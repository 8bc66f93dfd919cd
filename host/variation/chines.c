/* Knuckles of stations when sections move along the ship: they are points of chines. */
#include "variation/variation.h"

#include <math.h>

/* The knuckles of one station: all in one run, since they are sorted. */
struct knuckles {
	size_t first, count;
};

static void find_knuckles(const batten_hull *hull, struct knuckles *stations)
{
	for (size_t i = 0; i < hull->knuckle_count; i++) {
		const size_t s = hull_station_at(hull, hull->knuckles[i].x_m);
		if (hull->knuckles[i].on_waterline || s == SIZE_MAX)
			continue;
		if (stations[s].count == 0)
			stations[s].first = i;
		stations[s].count++;
	}
}

/* The chine of one number over stations first .. first + count - 1. */
static batten_status carry_chine(const batten_hull *parent, const struct knuckles *stations,
                                 size_t number, size_t first, size_t count, const double *at_m,
                                 const double *wanted_m, double *heights, batten_hull *variant)
{
	for (size_t i = 0; i < count; i++)
		heights[i] = parent->knuckles[stations[first + i].first + number].z_m;
	struct spline chine;
	const batten_status status = spline_create(parent->context, count, at_m + first, heights,
	                                           SPLINE_NATURAL, &chine);
	if (status != BATTEN_OK)
		return status == BATTEN_USAGE ? BATTEN_INPUT : status;
	for (size_t i = 0; i < count; i++) {
		const double at = fmin(fmax(wanted_m[first + i], at_m[first]), at_m[first + count - 1]);
		variant->knuckles[stations[first + i].first + number].z_m = spline_value(&chine, at);
	}
	spline_destroy(&chine);
	return BATTEN_OK;
}

static batten_status carry_number(const batten_hull *parent, const struct knuckles *stations,
                                  size_t number, const double *at_m, const double *wanted_m,
                                  double *heights, batten_hull *variant)
{
	batten_status status = BATTEN_OK;
	for (size_t first = 0; first < parent->station_count && status == BATTEN_OK;) {
		size_t count = 0;
		while (first + count < parent->station_count && stations[first + count].count > number)
			count++;
		if (count > 1)
			status = carry_chine(parent, stations, number, first, count, at_m, wanted_m, heights,
			                     variant);
		first += count + 1;
	}
	return status;
}

batten_status variation_carry_chines(const batten_hull *parent, const double *at_m,
                                     const double *wanted_m, batten_hull *variant)
{
	if (parent->knuckle_count == 0)
		return BATTEN_OK;
	batten_context *context = parent->context;
	struct knuckles *stations = batten_allocate(context, parent->station_count, sizeof *stations);
	double *heights = batten_allocate(context, parent->station_count, sizeof *heights);
	batten_status status = stations && heights ? BATTEN_OK : BATTEN_MEMORY;
	size_t most = 0;
	if (status == BATTEN_OK)
		find_knuckles(parent, stations);
	for (size_t s = 0; s < parent->station_count && status == BATTEN_OK; s++)
		most = stations[s].count > most ? stations[s].count : most;
	for (size_t k = 0; k < most && status == BATTEN_OK; k++)
		status = carry_number(parent, stations, k, at_m, wanted_m, heights, variant);
	hull_knuckle_sort(variant);
	batten_release(context, heights);
	batten_release(context, stations);
	return status;
}
