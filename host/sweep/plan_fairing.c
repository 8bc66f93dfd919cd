/* "fair" of a plan. */
#include "sweep/plan_parts.h"

#include "hull/hull.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define NUMBER(field) offsetof(plan_fairing_numbers, field)

/* Which ways to fair take a key. */
enum { BY_OFFSETS = 1, BY_NET = 2, BY_SEARCH = BY_OFFSETS | BY_NET, BY_PASS = 4, BY_ANY = 15 };

static const struct {
	plan_setting setting;
	unsigned takers;
} known_numbers[] = {
	{ { "w2_over_w1", NUMBER(w2_over_w1), 1e-12, 1e12 }, BY_SEARCH },
	{ { "max_distance_part", NUMBER(max_distance_part), 0.0, 1.0 }, BY_SEARCH },
	{ { "max_distance_m", NUMBER(max_distance_m), 0.0, 1e6 }, BY_SEARCH },
	{ { "first_step", NUMBER(first_step), 1e-9, 1.0 }, BY_SEARCH },
	{ { "last_step", NUMBER(last_step), 1e-12, 1.0 }, BY_SEARCH },
	{ { "iteration_limit", NUMBER(iteration_limit), 1.0, 1e6 }, BY_SEARCH },
	{ { "longitudinal", NUMBER(longitudinal), 1e-6, 1e6 }, BY_OFFSETS },
	{ { "transverse", NUMBER(transverse), 1e-6, 1e6 }, BY_OFFSETS },
	{ { "order", NUMBER(order), 2.0, 8.0 }, BY_PASS },
	{ { "order_sections", NUMBER(order_sections), 2.0, 8.0 }, BY_PASS },
	{ { "iterations", NUMBER(iterations), 1.0, 1e4 }, BY_PASS },
	{ { "max_cn_pct", NUMBER(max_cn_pct), 0.0, 100.0 }, BY_PASS },
	{ { "least_gain_pct", NUMBER(least_gain_pct), 0.0, 100.0 }, BY_PASS },
};
enum { NUMBER_COUNT = sizeof known_numbers / sizeof known_numbers[0] };

static const struct {
	const char *name;
	unsigned takers;
} known_words[] = { { "method", BY_ANY },
	                { "smooth", BY_ANY },
	                { "variables", BY_SEARCH },
	                { "locks", BY_OFFSETS },
	                { "fairness", BY_SEARCH },
	                { "search", BY_OFFSETS },
	                { "precision", BY_SEARCH | BY_PASS } };
enum { WORD_COUNT = sizeof known_words / sizeof known_words[0] };

static batten_status check_keys(const plan_place *place, unsigned way)
{
	const char *keys[NUMBER_COUNT + WORD_COUNT + 1];
	size_t count = 0;
	for (size_t i = 0; i < WORD_COUNT; i++)
		if (known_words[i].takers & way)
			keys[count++] = known_words[i].name;
	for (size_t i = 0; i < NUMBER_COUNT; i++)
		if (known_numbers[i].takers & way)
			keys[count++] = known_numbers[i].setting.name;
	keys[count] = NULL;
	return plan_keys(place, keys);
}

/* A member that may be missing. */
static batten_status read_word(const plan_place *place, const char *name, const char *const *words,
                               size_t *index)
{
	const plan_place member = plan_member(place, name);
	return member.json ? plan_word(&member, words, index) : BATTEN_OK;
}

/* The method and what it moves: all else depends on them. */
static batten_status read_way(const plan_place *place, batten_fair_options *options, unsigned *way)
{
	static const char *const methods[] = { "search",      "smooth",  "forward-approximation",
		                                   "forward-fit", "inverse", NULL };
	static const batten_fair_method codes[] = { BATTEN_METHOD_SEARCH, BATTEN_METHOD_SMOOTH,
		                                        BATTEN_METHOD_FORWARD_APPROXIMATION,
		                                        BATTEN_METHOD_FORWARD_FIT, BATTEN_METHOD_INVERSE };
	static const char *const variables[] = { "offsets", "net", NULL };
	size_t method = 0;
	size_t moved = 0;
	if (!json_is_object(place->json))
		return plan_expect(place, "an object");
	batten_status status = read_word(place, "method", methods, &method);
	if (status == BATTEN_OK && method == 0)
		status = read_word(place, "variables", variables, &moved);
	options->method = codes[method];
	options->pass.method = codes[method];
	options->variables = moved == 1 ? BATTEN_VARIABLES_NET : BATTEN_VARIABLES_OFFSETS;
	*way = method == 0 ? (moved == 1 ? BY_NET : BY_OFFSETS) : method == 1 ? 8 : BY_PASS;
	return status;
}

static batten_status read_words(const plan_place *place, batten_fair_options *options)
{
	static const char *const precisions[] = { "f64", "f32", NULL };
	static const char *const fairnesses[] = { "bending", "mean", "gauss", "mvc", NULL };
	static const batten_fairness fairness_codes[] = { BATTEN_FAIRNESS_BENDING, BATTEN_FAIRNESS_MEAN,
		                                              BATTEN_FAIRNESS_GAUSS,
		                                              BATTEN_FAIRNESS_VARIATION };
	static const char *const searches[] = { "auto", "textbook", "multilevel", "block", NULL };
	static const batten_search_algorithm algorithms[] = { BATTEN_ALGORITHM_AUTO,
		                                                  BATTEN_ALGORITHM_TEXTBOOK,
		                                                  BATTEN_ALGORITHM_MULTILEVEL,
		                                                  BATTEN_ALGORITHM_BLOCK };
	size_t precision = 0;
	size_t fairness = 0;
	size_t algorithm = 0;
	const plan_place smooth = plan_member(place, "smooth");
	const plan_place chosen = plan_member(place, "fairness");
	const plan_place search = plan_member(place, "search");
	/* The parent is smoothed where the plan says so; a method of this name does nothing else. */
	options->smooth = options->method == BATTEN_METHOD_SMOOTH;
	batten_status status = smooth.json ? plan_flag(&smooth, &options->smooth) : BATTEN_OK;
	if (status == BATTEN_OK)
		status = read_word(place, "precision", precisions, &precision);
	if (status == BATTEN_OK)
		status = read_word(place, "fairness", fairnesses, &fairness);
	if (status == BATTEN_OK)
		status = read_word(place, "search", searches, &algorithm);
	if (status != BATTEN_OK)
		return status;
	options->search.precision = precision == 1 ? BATTEN_F32 : BATTEN_F64;
	options->pass.precision = options->search.precision;
	options->fairness = options->search.fairness = fairness_codes[fairness];
	options->search.algorithm = algorithms[algorithm];
	const bool plain = fairness == 0 && !plan_member(place, "longitudinal").json &&
	                   !plan_member(place, "transverse").json;
	if (fairness == 3 &&
	    (plan_member(place, "longitudinal").json || plan_member(place, "transverse").json))
		return plan_expect(&chosen, "bending, mean or gauss with weights of directions");
	if (options->search.algorithm == BATTEN_ALGORITHM_BLOCK && !plain)
		return plan_expect(&search, "auto or multilevel: block knows plain bending only");
	return BATTEN_OK;
}

static batten_status read_lock(const plan_place *place, batten_lock *lock)
{
	static const char *const keys[] = { "station_m", "waterline_m", NULL };
	const plan_place station = plan_member(place, "station_m");
	const plan_place waterline = plan_member(place, "waterline_m");
	batten_status status = json_is_object(place->json) ? plan_keys(place, keys) : BATTEN_OK;
	if (status == BATTEN_OK && !station.json && !waterline.json)
		return plan_expect(place, "an object with station_m, waterline_m or both");
	lock->kind = !waterline.json ? BATTEN_LOCK_STATION
	             : !station.json ? BATTEN_LOCK_WATERLINE
	                             : BATTEN_LOCK_POINT;
	if (status == BATTEN_OK && station.json)
		status = plan_number(&station, -HULL_LARGEST_M, HULL_LARGEST_M, &lock->x_m);
	if (status == BATTEN_OK && waterline.json)
		status = plan_number(&waterline, -HULL_LARGEST_M, HULL_LARGEST_M, &lock->z_m);
	return status;
}

static batten_status read_locks(const plan_place *place, plan_fairing *fairing)
{
	const plan_place locks = plan_member(place, "locks");
	if (!locks.json)
		return BATTEN_OK;
	batten_status status = plan_array(&locks, 1, PLAN_LOCKS_MOST, &fairing->lock_count);
	for (size_t l = 0; l < fairing->lock_count && status == BATTEN_OK; l++) {
		const plan_place item = plan_item(&locks, l);
		status = read_lock(&item, &fairing->locks[l]);
	}
	return status;
}

static bool is_auto(const plan_place *place)
{
	return json_is_string(place->json) && strcmp(json_string_value(place->json), "auto") == 0;
}

static batten_status read_numbers(sweep_plan *plan, const plan_place *place, unsigned way)
{
	plan_fairing *fairing = &plan->fairing;
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < NUMBER_COUNT && status == BATTEN_OK; i++) {
		const plan_place member = plan_member(place, known_numbers[i].setting.name);
		const bool is_weight = i == 0 && known_numbers[i].takers & way;
		if (is_weight && is_auto(&member))
			fairing->weight_by_noise = true;
		/* The weight must be there, all else may. */
		else if (member.json || is_weight)
			status = plan_read_setting(plan, &member, &known_numbers[i].setting, &fairing->fixed,
			                           &fairing->swept);
	}
	const plan_place metres = plan_member(place, "max_distance_m");
	const plan_place part = plan_member(place, "max_distance_part");
	if (status == BATTEN_OK && metres.json && part.json)
		return plan_expect(&metres, "one of max_distance_m and max_distance_part");
	const plan_place last = plan_member(place, "last_step");
	const bool both_fixed = json_is_number(last.json) &&
	                        !json_is_string(plan_member(place, "first_step").json);
	if (status == BATTEN_OK && both_fixed &&
	    !(fairing->fixed.last_step < fairing->fixed.first_step))
		return plan_expect(&last, "a number below first_step, %g", fairing->fixed.first_step);
	return status;
}

static batten_status check_parent(const sweep_plan *plan, const plan_place *place)
{
	const batten_hull *parent = plan->parent;
	if (parent->station_count < 3)
		return plan_expect(place, "a parent of 3 stations at least");
	if (parent->waterline_count < 3)
		return plan_expect(place, "a parent of 3 waterlines at least");
	if (plan->fairing.options.variables == BATTEN_VARIABLES_NET && parent->end_count > 0)
		return plan_expect(place, "a parent without points off the grid, as a net is fitted");
	return BATTEN_OK;
}

batten_status plan_read_fairing(sweep_plan *plan, const plan_place *root)
{
	plan_fairing *fairing = &plan->fairing;
	batten_fair_options *options = &fairing->options;
	unsigned way = BY_OFFSETS;
	batten_fair_options_default(options);
	fairing->fixed = (plan_fairing_numbers){ .w2_over_w1 = NAN,
		                                     .max_distance_m = -1.0,
		                                     .max_distance_part = options->max_distance_part,
		                                     .first_step = options->search.first_step,
		                                     .last_step = options->search.last_step,
		                                     .iteration_limit = options->search.iteration_limit,
		                                     .longitudinal = 1.0,
		                                     .transverse = 1.0,
		                                     .order = options->pass.order,
		                                     .order_sections = options->pass.order_sections,
		                                     .iterations = options->iterations };
	const plan_place place = plan_member(root, "fair");
	if (!place.json)
		return BATTEN_OK;
	plan->fairs = true;
	batten_status status = read_way(&place, options, &way);
	if (status == BATTEN_OK)
		status = check_keys(&place, way);
	if (status == BATTEN_OK)
		status = read_words(&place, options);
	if (status == BATTEN_OK)
		status = read_locks(&place, fairing);
	if (status == BATTEN_OK)
		status = read_numbers(plan, &place, way);
	return status == BATTEN_OK ? check_parent(plan, &place) : status;
}

batten_fair_options plan_fairing_options(const plan_fairing *fairing,
                                         const plan_fairing_numbers *numbers)
{
	batten_fair_options options = fairing->options;
	options.weights_given = !isnan(numbers->w2_over_w1);
	if (options.weights_given) {
		options.w1 = 1.0;
		options.w2 = numbers->w2_over_w1;
	}
	options.max_distance_m = numbers->max_distance_m;
	options.max_distance_part = numbers->max_distance_part;
	options.locks = fairing->locks;
	options.lock_count = fairing->lock_count;
	options.search.first_step = numbers->first_step;
	options.search.last_step = numbers->last_step;
	options.search.iteration_limit = (unsigned)numbers->iteration_limit;
	options.search.longitudinal_weight = numbers->longitudinal;
	options.search.transverse_weight = numbers->transverse;
	options.pass.order = (unsigned)numbers->order;
	options.pass.order_sections = (unsigned)numbers->order_sections;
	options.iterations = (unsigned)numbers->iterations;
	options.max_cn_pct = numbers->max_cn_pct;
	options.least_gain_pct = numbers->least_gain_pct;
	return options;
}
