/* "parameters" and "sampling" of a plan. */
#include "sweep/plan_parts.h"

#include <math.h>
#include <string.h>

#define COUNT_MOST ((uint64_t)1 << 62)

enum { LEVELS_MOST = 1000000 };

/* Beyond this no setting goes, and sums of two stay finite. */
#define VALUE_MOST 1e100

static batten_status read_list(batten_context *context, const plan_place *place,
                               sampling_parameter *out)
{
	size_t count = 0;
	batten_status status = plan_array(place, 1, LEVELS_MOST, &count);
	if (status != BATTEN_OK)
		return status;
	out->levels = batten_allocate(context, count, sizeof *out->levels);
	if (!out->levels)
		return BATTEN_MEMORY;
	out->level_count = count;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		const plan_place item = plan_item(place, i);
		status = plan_number(&item, -VALUE_MOST, VALUE_MOST, &out->levels[i]);
	}
	return status;
}

/* Levels by their size: from, from + step ... up to the end, which must be one of them. */
static batten_status read_step(const plan_place *place, sampling_parameter *out)
{
	double step = 0.0;
	const double span = out->to - out->from;
	const batten_status status = plan_number(place, 0.0, VALUE_MOST, &step);
	if (status != BATTEN_OK)
		return status;
	const double count = step > 0.0 ? floor(span / step + 0.5) : 0.0;
	if (!(count >= 1.0 && count < LEVELS_MOST) || fabs(count * step - span) > 1e-9 * span)
		return plan_expect(place,
		                   "a step that divides the range of %g into whole steps, at most %d", span,
		                   LEVELS_MOST);
	out->level_count = (uint64_t)count + 1;
	return BATTEN_OK;
}

static batten_status read_scale(const plan_place *place, sampling_parameter *out)
{
	static const char *const words[] = { "linear", "log", NULL };
	size_t word = 0;
	const batten_status status = plan_word(place, words, &word);
	if (status != BATTEN_OK)
		return status;
	out->logarithmic = word == 1;
	if (out->logarithmic && !(out->from > 0.0))
		return plan_expect(place, "linear: a range from %g has no logarithm", out->from);
	return BATTEN_OK;
}

static batten_status read_range(const plan_place *place, sampling_parameter *out)
{
	const plan_place from = plan_member(place, "from");
	const plan_place to = plan_member(place, "to");
	const plan_place step = plan_member(place, "step");
	const plan_place steps = plan_member(place, "steps");
	const plan_place scale = plan_member(place, "scale");
	batten_status status = plan_number(&from, -VALUE_MOST, VALUE_MOST, &out->from);
	if (status == BATTEN_OK)
		status = plan_number(&to, -VALUE_MOST, VALUE_MOST, &out->to);
	if (status == BATTEN_OK && out->from > out->to)
		return plan_expect(&to, "at least %g, where the range begins", out->from);
	if (status == BATTEN_OK && scale.json)
		status = read_scale(&scale, out);
	if (status == BATTEN_OK && step.json && (steps.json || out->logarithmic))
		return plan_expect(&step, "steps, their number, or step, their size on a linear scale");
	if (status == BATTEN_OK && step.json)
		status = read_step(&step, out);
	if (status == BATTEN_OK && steps.json)
		status = plan_whole(&steps, 1, LEVELS_MOST, &out->level_count);
	return status;
}

static batten_status read_parameter(const sweep_plan *plan, const plan_place *place,
                                    const char *name, sampling_parameter *out)
{
	static const char *const keys[] = { "from", "to", "step", "steps", "scale", "values", NULL };
	static const char *const list_keys[] = { "values", NULL };
	if (!plan_is_name(name) || strcmp(name, "id") == 0 ||
	    sweep_measure_number(name, strlen(name)) != SIZE_MAX)
		return plan_expect(place,
		                   "a name of letters, digits and _, which no measure has, nor id, of at "
		                   "most %d",
		                   SAMPLING_NAME_MOST);
	memcpy(out->name, name, strlen(name) + 1);
	batten_status status = plan_keys(place, keys);
	const plan_place list = plan_member(place, "values");
	if (status != BATTEN_OK || !list.json)
		return status == BATTEN_OK ? read_range(place, out) : status;
	status = plan_keys(place, list_keys);
	return status == BATTEN_OK ? read_list(plan->context, &list, out) : status;
}

/* "parameters" alone: names, ranges, levels. */
static batten_status read_parameters(sweep_plan *plan, const plan_place *root)
{
	sweep_sampling *sampling = &plan->sampling;
	const plan_place place = plan_member(root, "parameters");
	const size_t count = json_object_size(place.json);
	if (!json_is_object(place.json) || count < 1 || count > SAMPLING_PARAMETERS_MOST)
		return plan_expect(&place, "an object of 1 to %d parameters", SAMPLING_PARAMETERS_MOST);
	sampling->parameters = batten_allocate(plan->context, count, sizeof *sampling->parameters);
	if (!sampling->parameters)
		return BATTEN_MEMORY;
	sampling->parameter_count = count;
	const char *name = NULL;
	const json_t *value = NULL;
	size_t p = 0;
	batten_status status = BATTEN_OK;
	json_object_foreach((json_t *)place.json, name, value)
	{
		const plan_place member = plan_member(&place, name);
		status = read_parameter(plan, &member, name, &sampling->parameters[p++]);
		if (status != BATTEN_OK)
			break;
	}
	return status;
}

static batten_status read_grid(sweep_plan *plan, const plan_place *root)
{
	if (sampling_grid_count(&plan->sampling, &plan->sampling.count))
		return BATTEN_OK;
	const plan_place parameters = plan_member(root, "parameters");
	for (size_t p = 0; p < plan->sampling.parameter_count; p++) {
		const plan_place place = plan_member(&parameters, plan->sampling.parameters[p].name);
		if (plan->sampling.parameters[p].level_count == 0)
			return plan_expect(&place, "steps, step or values: a grid needs levels");
	}
	return plan_expect(&parameters, "a grid of fewer than 2^62 designs");
}

static batten_status read_count(sweep_plan *plan, const plan_place *place)
{
	const uint64_t most = plan->sampling.method == SAMPLING_SOBOL ? (uint64_t)1 << SOBOL_BITS
	                                                              : COUNT_MOST;
	return plan_whole(place, 1, most, &plan->sampling.count);
}

static batten_status read_rows(sweep_plan *plan, const plan_source *source, const plan_place *root,
                               const plan_place *file)
{
	const plan_place parameters = plan_member(root, "parameters");
	if (parameters.json)
		return plan_expect(&parameters, "none: the header of the rows names the parameters");
	const char *text = NULL;
	size_t length = 0;
	const batten_status status = plan_take_file(plan, source, file, "rows", &text, &length);
	return status == BATTEN_OK ? plan_read_rows(plan, file, text, length) : status;
}

static batten_status read_method(sweep_plan *plan, const plan_source *source,
                                 const plan_place *root, const plan_place *place)
{
	const plan_place count = plan_member(place, "count");
	const plan_place scramble = plan_member(place, "scramble");
	const plan_place file = plan_member(place, "file");
	sweep_sampling *sampling = &plan->sampling;
	const bool counted = sampling->method != SAMPLING_GRID && sampling->method != SAMPLING_ROWS;
	if (!counted && count.json)
		return plan_expect(&count, "none: the %s says how many designs there are",
		                   sampling->method == SAMPLING_GRID ? "grid" : "file");
	if (sampling->method != SAMPLING_ROWS && file.json)
		return plan_expect(&file, "none: only rows come from a file");
	if (sampling->method != SAMPLING_SOBOL && scramble.json)
		return plan_expect(&scramble, "none: only sobol is scrambled");
	sampling->scramble = true;
	batten_status status = BATTEN_OK;
	if (scramble.json)
		status = plan_flag(&scramble, &sampling->scramble);
	if (status == BATTEN_OK && sampling->method == SAMPLING_ROWS)
		return read_rows(plan, source, root, &file);
	if (status == BATTEN_OK)
		status = read_parameters(plan, root);
	if (status == BATTEN_OK)
		status = counted ? read_count(plan, &count) : read_grid(plan, root);
	return status;
}

batten_status plan_read_sampling(sweep_plan *plan, const plan_source *source,
                                 const plan_place *root)
{
	static const char *const keys[] = { "method", "count", "seed", "scramble", "file", NULL };
	static const char *const words[] = {
		"grid", "latin-hypercube", "sobol", "random", "rows", NULL
	};
	const plan_place place = plan_member(root, "sampling");
	const plan_place method = plan_member(&place, "method");
	const plan_place seed = plan_member(&place, "seed");
	size_t word = 0;
	batten_status status = plan_keys(&place, keys);
	if (status == BATTEN_OK)
		status = plan_word(&method, words, &word);
	if (status == BATTEN_OK && seed.json)
		status = plan_whole(&seed, 0, INT64_MAX, &plan->sampling.seed);
	plan->sampling.method = (sampling_method)word;
	if (status == BATTEN_OK)
		status = read_method(plan, source, root, &place);
	return status == BATTEN_OK ? sampling_prepare(plan->context, &plan->sampling) : status;
}
