/* "fair" of a plan. */
#include "sweep/plan_parts.h"

#include "hull/hull.h"

#include <stddef.h>

#define NUMBER(field) offsetof(plan_fairing_numbers, field)

static batten_status read_search(const plan_place *place, batten_search_options *search)
{
	static const char *const precisions[] = { "f64", "f32", NULL };
	const plan_place precision = plan_member(place, "precision");
	const plan_place first = plan_member(place, "first_step");
	const plan_place last = plan_member(place, "last_step");
	const plan_place limit = plan_member(place, "iteration_limit");
	size_t word = 0;
	uint64_t iterations = search->iteration_limit;
	batten_status status = BATTEN_OK;
	if (precision.json)
		status = plan_word(&precision, precisions, &word);
	if (status == BATTEN_OK && first.json)
		status = plan_number(&first, 1e-9, 1.0, &search->first_step);
	if (status == BATTEN_OK && last.json)
		status = plan_number(&last, 1e-12, search->first_step, &search->last_step);
	if (status == BATTEN_OK && limit.json)
		status = plan_whole(&limit, 1, 1000000, &iterations);
	search->precision = word == 1 ? BATTEN_F32 : BATTEN_F64;
	search->iteration_limit = (unsigned)iterations;
	return status;
}

batten_status plan_read_fairing(sweep_plan *plan, const plan_place *root)
{
	static const char *const keys[] = { "w2_over_w1",      "max_distance_part",
		                                "max_distance_m",  "precision",
		                                "first_step",      "last_step",
		                                "iteration_limit", NULL };
	static const plan_setting settings[] = {
		{ "w2_over_w1", NUMBER(w2_over_w1), 1e-12, 1e12 },
		{ "max_distance_part", NUMBER(max_distance_part), 0.0, 1.0 },
		{ "max_distance_m", NUMBER(max_distance_m), 0.0, 1e6 },
	};
	plan_fairing *fairing = &plan->fairing;
	fairing->fixed = (plan_fairing_numbers){ .max_distance_m = -1.0, .max_distance_part = 0.01 };
	batten_search_options_default(&fairing->search);
	const plan_place place = plan_member(root, "fair");
	if (!place.json)
		return BATTEN_OK;
	plan->fairs = true;
	batten_status status = plan_keys(&place, keys);
	for (size_t i = 0; i < sizeof settings / sizeof settings[0] && status == BATTEN_OK; i++) {
		const plan_place member = plan_member(&place, settings[i].name);
		/* The weight must be there, one of the two distances may. */
		if (member.json || i == 0)
			status = plan_read_setting(plan, &member, &settings[i], &fairing->fixed,
			                           &fairing->swept);
	}
	const plan_place metres = plan_member(&place, "max_distance_m");
	const plan_place part = plan_member(&place, "max_distance_part");
	if (status == BATTEN_OK && metres.json && part.json)
		return plan_expect(&metres, "one of max_distance_m and max_distance_part");
	if (status == BATTEN_OK && plan->parent->station_count < 3)
		return plan_expect(&place, "a parent of 3 stations at least");
	if (status == BATTEN_OK && plan->parent->waterline_count < 3)
		return plan_expect(&place, "a parent of 3 waterlines at least");
	return status == BATTEN_OK ? read_search(&place, &fairing->search) : status;
}
