/* A plan as a whole: the JSON text, the files it names, its parts in their order. */
#include "sweep/plan_parts.h"

#include "core/file.h"
#include "fairing/gross_errors.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

/* Rows given one by one may be many. */
static const size_t longest_plan = (size_t)16 << 20;
static const size_t longest_file = (size_t)512 << 20;

/* ---- files ---- */

/* The name of a file as the plan's own folder has it. */
static char *beside(batten_context *context, const char *plan_path, const char *name)
{
	const char *slash = name[0] == '/' ? NULL : strrchr(plan_path, '/');
	const size_t folder = slash ? (size_t)(slash - plan_path) + 1 : 0;
	const size_t length = strlen(name);
	char *path = batten_allocate(context, folder + length + 1, 1);
	if (!path)
		return NULL;
	memcpy(path, plan_path, folder);
	memcpy(path + folder, name, length);
	return path;
}

static batten_status read_beside(batten_context *context, void *user, const char *role,
                                 const char *name, char **text, size_t *length)
{
	(void)role;
	char *path = beside(context, user, name);
	if (!path)
		return BATTEN_MEMORY;
	const batten_status status = batten_file_read(context, path, longest_file, text, length);
	batten_release(context, path);
	return status;
}

batten_status plan_take_file(sweep_plan *plan, const plan_source *source, const plan_place *place,
                             const char *role, const char **text, size_t *length)
{
	const char *name = NULL;
	batten_status status = plan_text(place, &name);
	if (status != BATTEN_OK)
		return status;
	plan_file file = { .role = batten_copy_text(plan->context, role) };
	if (!file.role)
		return BATTEN_MEMORY;
	status = source->read(plan->context, source->user, role, name, &file.text, &file.length);
	if (status != BATTEN_OK) {
		batten_release(plan->context, file.role);
		return status;
	}
	plan->files[plan->file_count++] = file;
	*text = file.text;
	*length = file.length;
	return BATTEN_OK;
}

static batten_status read_parent(sweep_plan *plan, const plan_source *source,
                                 const plan_place *root)
{
	static const char *const keys[] = { "hull", "smooth", NULL };
	const plan_place place = plan_member(root, "parent");
	const plan_place hull = plan_member(&place, "hull");
	const plan_place smooth = plan_member(&place, "smooth");
	const char *text = NULL;
	size_t length = 0;
	bool smooths = false;
	batten_status status = plan_keys(&place, keys);
	if (status == BATTEN_OK)
		status = plan_take_file(plan, source, &hull, "parent", &text, &length);
	if (status == BATTEN_OK && smooth.json)
		status = plan_flag(&smooth, &smooths);
	if (status == BATTEN_OK)
		status = batten_hull_parse(plan->context, json_string_value(hull.json), text, length,
		                           &plan->parent);
	if (status != BATTEN_OK || !smooths)
		return status;
	batten_replacement *replacements = NULL;
	size_t count = 0;
	status = gross_errors_replace(plan->parent, NULL, &replacements, &count);
	batten_release(plan->context, replacements);
	return status;
}

/* ---- settings ---- */

size_t plan_parameter_number(const sweep_plan *plan, const char *name, size_t length)
{
	for (size_t p = 0; p < plan->sampling.parameter_count; p++) {
		const char *known = plan->sampling.parameters[p].name;
		if (strlen(known) == length && memcmp(known, name, length) == 0)
			return p;
	}
	return SIZE_MAX;
}

bool plan_is_name(const char *text)
{
	static const char known[] = "0123456789_ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
	const size_t length = strlen(text);
	return length >= 1 && length <= SAMPLING_NAME_MOST && strspn(text, known) == length &&
	       !(text[0] >= '0' && text[0] <= '9');
}

/* The least and the greatest value that a parameter can have. */
static void range_of(const sweep_sampling *sampling, size_t p, double *least, double *most)
{
	const sampling_parameter *parameter = &sampling->parameters[p];
	const size_t stride = sampling->rows ? sampling->parameter_count : 1;
	const double *values = sampling->rows ? sampling->rows + p : parameter->levels;
	const uint64_t count = sampling->rows ? sampling->count : parameter->level_count;
	*least = values ? values[0] : parameter->from;
	*most = values ? values[0] : parameter->to;
	for (uint64_t i = 0; values && i < count; i++) {
		const double value = values[i * stride];
		*least = value < *least ? value : *least;
		*most = value > *most ? value : *most;
	}
}

batten_status plan_read_setting(const sweep_plan *plan, const plan_place *place,
                                const plan_setting *setting, void *structure,
                                plan_bindings *bindings)
{
	double *target = (double *)(void *)((char *)structure + setting->offset);
	if (!json_is_string(place->json))
		return plan_number(place, setting->least, setting->most, target);
	const char *name = json_string_value(place->json);
	const size_t parameter = plan_parameter_number(plan, name, strlen(name));
	if (parameter == SIZE_MAX)
		return plan_expect(place, "a number or the name of a parameter of $.parameters");
	double least = 0.0;
	double most = 0.0;
	range_of(&plan->sampling, parameter, &least, &most);
	if (!(least >= setting->least && most <= setting->most))
		return plan_expect(place, "a parameter within %g to %g, it goes from %g to %g",
		                   setting->least, setting->most, least, most);
	if (bindings->count == PLAN_BINDINGS_MOST)
		return plan_expect(place, "at most %d settings by parameters", PLAN_BINDINGS_MOST);
	bindings->list[bindings->count++] = (plan_binding){ setting->offset, parameter };
	return BATTEN_OK;
}

void plan_bind(const plan_bindings *bindings, const double *parameters, void *structure)
{
	for (size_t b = 0; b < bindings->count; b++) {
		const plan_binding *binding = &bindings->list[b];
		memcpy((char *)structure + binding->offset, &parameters[binding->parameter],
		       sizeof(double));
	}
}

static void mark_used(const plan_bindings *bindings, bool *used)
{
	for (size_t b = 0; b < bindings->count; b++)
		used[bindings->list[b].parameter] = true;
}

/* A parameter that nothing takes is a mistake. */
static batten_status check_parameters_used(const sweep_plan *plan, const plan_place *root)
{
	bool used[SAMPLING_PARAMETERS_MOST] = { false };
	for (size_t s = 0; s < plan->step_count; s++)
		mark_used(&plan->steps[s].swept, used);
	mark_used(&plan->fairing.swept, used);
	const plan_place parameters = plan_member(root, "parameters");
	for (size_t p = 0; p < plan->sampling.parameter_count; p++) {
		const plan_place place = plan_member(&parameters, plan->sampling.parameters[p].name);
		if (!used[p])
			return plan_expect(&place, "a setting of $.vary or $.fair that takes this parameter");
	}
	return BATTEN_OK;
}

/* ---- the whole ---- */

static batten_status read_name(sweep_plan *plan, const plan_place *root)
{
	const plan_place version = plan_member(root, "batten_plan");
	const plan_place place = plan_member(root, "name");
	const char *name = NULL;
	uint64_t number = 0;
	batten_status status = plan_whole(&version, 1, 1, &number);
	if (status == BATTEN_OK)
		status = plan_text(&place, &name);
	if (status == BATTEN_OK && hull_text_length(name, strlen(name)) != strlen(name))
		return plan_expect(&place, "a text without control characters");
	if (status == BATTEN_OK) {
		plan->name = batten_copy_text(plan->context, name);
		status = plan->name ? BATTEN_OK : BATTEN_MEMORY;
	}
	return status;
}

/* The plan in one line, and the hash of it and of its files. */
static batten_status keep_text(sweep_plan *plan, const plan_place *root)
{
	char *text = json_dumps(root->json, JSON_COMPACT | JSON_REAL_PRECISION(17));
	if (!text)
		return batten_fail_memory(plan->context);
	plan->text = batten_copy_text(plan->context, text);
	free(text);
	if (!plan->text)
		return BATTEN_MEMORY;
	XXH128_hash_t hash = XXH3_128bits(plan->text, strlen(plan->text));
	for (size_t f = 0; f < plan->file_count; f++)
		hash = XXH3_128bits_withSeed(plan->files[f].text, plan->files[f].length,
		                             hash.low64 ^ (hash.high64 << 1));
	(void)snprintf(plan->hash, sizeof plan->hash, "%016llx%016llx", (unsigned long long)hash.high64,
	               (unsigned long long)hash.low64);
	return BATTEN_OK;
}

static batten_status read_parts(sweep_plan *plan, const plan_source *source, const plan_place *root)
{
	static const char *const keys[] = { "batten_plan", "name",       "parent", "parameters",
		                                "sampling",    "vary",       "fair",   "measure",
		                                "reject",      "objectives", "keep",   NULL };
	batten_status status = plan_keys(root, keys);
	if (status == BATTEN_OK)
		status = read_name(plan, root);
	if (status == BATTEN_OK)
		status = plan_read_sampling(plan, source, root);
	if (status == BATTEN_OK)
		status = read_parent(plan, source, root);
	if (status == BATTEN_OK)
		status = plan_read_variation(plan, source, root);
	if (status == BATTEN_OK)
		status = plan_read_fairing(plan, root);
	if (status == BATTEN_OK)
		status = check_parameters_used(plan, root);
	if (status == BATTEN_OK)
		status = plan_read_judgement(plan, root);
	return status == BATTEN_OK ? keep_text(plan, root) : status;
}

batten_status sweep_plan_parse(batten_context *context, const char *file, const char *text,
                               size_t length, const plan_source *source, sweep_plan **out)
{
	json_error_t error;
	json_t *json = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error);
	if (!json)
		return batten_fail(
			context, BATTEN_INPUT, "%s:%d:%d: %s; the JSON of a sweep's plan was expected", file,
			error.line > 0 ? error.line : 1, error.column > 0 ? error.column : 1, error.text);
	sweep_plan *plan = batten_allocate(context, 1, sizeof *plan);
	if (!plan) {
		json_decref(json);
		return BATTEN_MEMORY;
	}
	plan->context = context;
	const plan_place root = { .context = context, .file = file, .json = json, .path = "$" };
	const batten_status status = read_parts(plan, source, &root);
	json_decref(json);
	if (status != BATTEN_OK) {
		sweep_plan_destroy(plan);
		return status;
	}
	*out = plan;
	return BATTEN_OK;
}

batten_status sweep_plan_read(batten_context *context, const char *path, sweep_plan **out)
{
	char *text = NULL;
	size_t length = 0;
	batten_status status = batten_file_read(context, path, longest_plan, &text, &length);
	if (status != BATTEN_OK)
		return status;
	const plan_source source = { read_beside, (void *)path };
	status = sweep_plan_parse(context, path, text, length, &source, out);
	batten_release(context, text);
	return status;
}

void sweep_plan_destroy(sweep_plan *plan)
{
	if (!plan)
		return;
	batten_context *context = plan->context;
	for (size_t s = 0; s < PLAN_STEPS_MOST; s++)
		for (size_t i = 0; i < PLAN_LIST_MOST; i++)
			batten_hull_destroy(plan->steps[s].others[i]);
	for (size_t f = 0; f < plan->file_count; f++) {
		batten_release(context, plan->files[f].role);
		batten_release(context, plan->files[f].text);
	}
	sampling_release(context, &plan->sampling);
	batten_hull_destroy(plan->parent);
	batten_release(context, plan->constraints);
	batten_release(context, plan->name);
	batten_release(context, plan->text);
	batten_release(context, plan);
}
