/* "vary" of a plan: one variation or several, each on what the one before it made. This file and
 * stage_vary.c are the places that know how variants come about; another generator of hulls is another
 * word of "method" here and another branch there. */
#include "sweep/plan_parts.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define TAKES(symbol) (1u << BATTEN_VARY_##symbol)
#define OPTION(field) offsetof(plan_variation, options.field)

/* The numbers of the methods, who takes them, and their range. */
static const struct known_number {
	plan_setting setting;
	unsigned takers;
} known_numbers[] = {
#define HALVES (TAKES(ONE_MINUS_PRISMATIC) | TAKES(LACKENBY))
#define MOVED (HALVES | TAKES(SWING) | TAKES(MOOR))
	{ { "dcp_pct", OPTION(dcp_pct), -100, 1000 }, HALVES },
	{ { "dcb_pct", OPTION(dcp_pct), -100, 1000 }, TAKES(MOOR) },
	{ { "dlcb_pct", OPTION(dlcb_pct), -100, 100 }, MOVED },
	{ { "dcwp_pct", OPTION(dcwp_pct), -100, 1000 }, TAKES(MOOR) },
	{ { "dlcf_pct", OPTION(dlcf_pct), -100, 100 }, TAKES(MOOR) },
	{ { "dp_fore_pct", OPTION(dp_fore_pct), -100, 100 }, TAKES(LACKENBY) },
	{ { "dp_aft_pct", OPTION(dp_aft_pct), -100, 100 }, TAKES(LACKENBY) },
	{ { "scale_x", OPTION(scale_x), 1e-6, 1e6 }, TAKES(AFFINE) },
	{ { "scale_y", OPTION(scale_y), 1e-6, 1e6 }, TAKES(AFFINE) },
	{ { "scale_z", OPTION(scale_z), 1e-6, 1e6 }, TAKES(AFFINE) },
	{ { "volume_m3", OPTION(volume_m3), 1e-12, 1e12 }, TAKES(THREE_BODY) },
	{ { "lcb_pct_lbp_fwd", OPTION(lcb_pct_lbp_fwd), -50, 50 }, TAKES(THREE_BODY) },
	{ { "cp", OPTION(cp), 1e-3, 1 }, TAKES(THREE_BODY) },
	{ { "middle_aft_m", OPTION(middle_aft_m), 0, 1e6 }, TAKES(THREE_BODY) },
	{ { "middle_fore_m", OPTION(middle_fore_m), 0, 1e6 }, TAKES(THREE_BODY) },
#undef MOVED
#undef HALVES
};
enum { NUMBER_COUNT = sizeof known_numbers / sizeof known_numbers[0] };

/* What the method is read with. */
struct step_reader {
	sweep_plan *plan;
	const plan_source *source;
	const plan_place *place;
	plan_step *step;
};

static batten_status read_numbers(const struct step_reader *reader)
{
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < NUMBER_COUNT && status == BATTEN_OK; i++) {
		const plan_place place = plan_member(reader->place, known_numbers[i].setting.name);
		if (place.json && (known_numbers[i].takers & 1u << reader->step->fixed.options.method))
			status = plan_read_setting(reader->plan, &place, &known_numbers[i].setting,
			                           &reader->step->fixed, &reader->step->swept);
	}
	return status;
}

/* "with": files of other hulls, "weights": one each. */
static batten_status read_average(const struct step_reader *reader)
{
	plan_step *step = reader->step;
	const plan_place with = plan_member(reader->place, "with");
	const plan_place weights = plan_member(reader->place, "weights");
	size_t count = 0;
	batten_status status = plan_array(&with, 1, PLAN_LIST_MOST, &count);
	if (status == BATTEN_OK)
		status = plan_array(&weights, count, count, &count);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		const plan_place file = plan_item(&with, i);
		const plan_place weight = plan_item(&weights, i);
		const plan_setting setting = { "weights",
			                           offsetof(plan_variation, weights) + i * sizeof(double), -100,
			                           100 };
		const char *text = NULL;
		size_t length = 0;
		char role[32];
		(void)snprintf(role, sizeof role, "with:%zu:%zu", reader->plan->step_count, i);
		status = plan_take_file(reader->plan, reader->source, &file, role, &text, &length);
		if (status == BATTEN_OK)
			status = batten_hull_parse(reader->plan->context, json_string_value(file.json), text,
			                           length, &step->others[i]);
		if (status == BATTEN_OK)
			status = plan_read_setting(reader->plan, &weight, &setting, &step->fixed, &step->swept);
	}
	step->fixed.options.other_count = count;
	return status;
}

/* "from" and "to": parts of LBP from the aft perpendicular. */
static batten_status read_stretch(const struct step_reader *reader)
{
	plan_step *step = reader->step;
	const plan_place from = plan_member(reader->place, "from");
	const plan_place to = plan_member(reader->place, "to");
	size_t count = 0;
	batten_status status = plan_array(&from, 2, PLAN_LIST_MOST, &count);
	if (status == BATTEN_OK)
		status = plan_array(&to, count, count, &count);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		const plan_place old = plan_item(&from, i);
		const plan_place new = plan_item(&to, i);
		const size_t at = i * sizeof(double);
		const plan_setting settings[] = { { "from", offsetof(plan_variation, from) + at, -100,
			                                100 },
			                              { "to", offsetof(plan_variation, to) + at, -100, 100 } };
		status = plan_read_setting(reader->plan, &old, &settings[0], &step->fixed, &step->swept);
		if (status == BATTEN_OK)
			status = plan_read_setting(reader->plan, &new, &settings[1], &step->fixed,
			                           &step->swept);
	}
	step->fixed.options.point_count = count;
	return status;
}

/* The keys that a method has. */
static void list_keys(batten_vary_method method, const char *keys[NUMBER_COUNT + 5])
{
	const unsigned iterated = TAKES(SWING) | TAKES(ONE_MINUS_PRISMATIC) | TAKES(LACKENBY) |
	                          TAKES(MOOR) | TAKES(THREE_BODY);
	size_t count = 0;
	keys[count++] = "method";
	for (size_t i = 0; i < NUMBER_COUNT; i++)
		if (known_numbers[i].takers & 1u << method)
			keys[count++] = known_numbers[i].setting.name;
	if (iterated & 1u << method)
		keys[count++] = "first_pass";
	if (method == BATTEN_VARY_AVERAGE || method == BATTEN_VARY_STRETCH) {
		keys[count++] = method == BATTEN_VARY_AVERAGE ? "with" : "from";
		keys[count++] = method == BATTEN_VARY_AVERAGE ? "weights" : "to";
	}
	keys[count] = NULL;
}

static batten_status read_step(const struct step_reader *reader)
{
	const char *words[BATTEN_VARY_METHOD_COUNT + 1] = { NULL };
	for (size_t m = 0; m < BATTEN_VARY_METHOD_COUNT; m++)
		words[m] = batten_vary_method_name(m);
	const plan_place method = plan_member(reader->place, "method");
	const plan_place first_pass = plan_member(reader->place, "first_pass");
	batten_vary_options *options = &reader->step->fixed.options;
	batten_vary_options_default(options);
	size_t word = 0;
	if (!json_is_object(reader->place->json))
		return plan_expect(reader->place, "a variation");
	batten_status status = plan_word(&method, words, &word);
	if (status != BATTEN_OK)
		return status;
	const char *keys[NUMBER_COUNT + 5];
	options->method = (batten_vary_method)word;
	list_keys(options->method, keys);
	status = plan_keys(reader->place, keys);
	if (status == BATTEN_OK)
		status = read_numbers(reader);
	if (status == BATTEN_OK && first_pass.json)
		status = plan_flag(&first_pass, &options->first_pass);
	if (status == BATTEN_OK && options->method == BATTEN_VARY_AVERAGE)
		status = read_average(reader);
	if (status == BATTEN_OK && options->method == BATTEN_VARY_STRETCH)
		status = read_stretch(reader);
	return status;
}

batten_status plan_read_variation(sweep_plan *plan, const plan_source *source,
                                  const plan_place *root)
{
	const plan_place vary = plan_member(root, "vary");
	size_t count = 1;
	batten_status status = BATTEN_OK;
	if (!vary.json)
		return BATTEN_OK;
	if (!json_is_object(vary.json))
		status = plan_array(&vary, 0, PLAN_STEPS_MOST, &count);
	for (size_t s = 0; s < count && status == BATTEN_OK; s++) {
		const plan_place item = plan_item(&vary, s);
		const struct step_reader reader = { plan, source, json_is_object(vary.json) ? &vary : &item,
			                                &plan->steps[s] };
		status = read_step(&reader);
		plan->step_count = s + 1;
	}
	return status;
}
