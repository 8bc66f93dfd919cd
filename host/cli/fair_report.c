/* report.json of batten fair. */
#include "fair_job.h"

#include "fair_passes.h"
#include "json_out.h"

#include <string.h>

static json_t *number(double value)
{
	return cli_json_number(value);
}

static json_t *count(size_t value)
{
	return json_integer((json_int_t)value);
}

static void set(json_t *object, const char *name, json_t *value)
{
	(void)json_object_set_new(object, name, value);
}

/* A path, or null; not every path is UTF-8. */
static json_t *path_json(const char *path)
{
	json_t *text = path ? json_string(path) : json_null();
	return text ? text : json_string("(not UTF-8)");
}

static json_t *command_line(const fair_request *request)
{
	json_t *words = json_array();
	(void)json_array_append_new(words, json_string("batten"));
	for (int i = 0; i < request->argc; i++)
		(void)json_array_append_new(words, path_json(request->argv[i]));
	return words;
}

static json_t *hull_json(const batten_hull *hull)
{
	json_t *object = json_object();
	set(object, "name", json_string(batten_hull_name(hull)));
	set(object, "source", json_string(batten_hull_source(hull)));
	set(object, "frame_of_file", json_string(batten_hull_frame(hull)));
	set(object, "unit_of_file", json_string(batten_hull_unit(hull)));
	set(object, "frame", json_string("ap-fwd"));
	set(object, "unit", json_string("m"));
	set(object, "layout", json_string(batten_hull_layout(hull)));
	set(object, "stations", count(batten_hull_station_count(hull)));
	set(object, "waterlines", count(batten_hull_waterline_count(hull)));
	set(object, "grid",
	    json_string(
			"energies: differences over 3 x 3 offsets, nodes whose neighbours are all on the "
			"hull; hydrostatics: not-a-knot spline in z, natural spline in x"));
	return object;
}

static json_t *state_json(const fair_state *state, bool smoothed, bool faired)
{
	json_t *object = json_object();
	cli_json_measures(object, &state->measures);
	if (smoothed || faired) {
		set(object, "cn_pct", number(state->to_input.cn_pct));
		set(object, "cn_max_m", number(state->to_input.cn_max_m));
		set(object, "cn_rms_m", number(state->to_input.cn_rms_m));
	}
	if (faired) {
		set(object, "cn_search_pct", number(state->to_smoothed.cn_pct));
		set(object, "cn_search_max_m", number(state->to_smoothed.cn_max_m));
		set(object, "cn_search_rms_m", number(state->to_smoothed.cn_rms_m));
		set(object, "closeness_m4", number(state->to_smoothed.closeness_m4));
	}
	return object;
}

static json_t *replaced_json(const batten_fairing *fairing)
{
	json_t *list = json_array();
	const batten_replacement *replacements = batten_fairing_replacements(fairing);
	for (size_t r = 0; r < batten_fairing_replacement_count(fairing); r++) {
		json_t *object = json_object();
		set(object, "station", count(replacements[r].station));
		set(object, "waterline", count(replacements[r].waterline));
		set(object, "x_m", number(replacements[r].x_m));
		set(object, "z_m", number(replacements[r].z_m));
		set(object, "old_m", number(replacements[r].old_m));
		set(object, "new_m", number(replacements[r].new_m));
		(void)json_array_append_new(list, object);
	}
	return list;
}

static json_t *lines_json(const fair_job *job)
{
	static const char *const kinds[] = { "station", "waterline", "buttock", "diagonal" };
	static const char *const coordinates[] = { "x_m", "z_m", "y_m", "z_at_centreplane_m" };
	json_t *list = json_array();
	for (size_t l = 0; l < job->line_count; l++) {
		const batten_line *before = &job->lines_before[l];
		const batten_line *after = &job->lines_after[l];
		json_t *object = json_object();
		set(object, "kind", json_string(kinds[before->kind]));
		set(object, coordinates[before->kind], number(before->coordinate_m));
		set(object, "points", count(before->point_count));
		set(object, "fn_before_per_m2", number(before->fn_per_m2));
		set(object, "fn_after_per_m2", number(after->fn_per_m2));
		set(object, "inflections_before", count(before->inflections));
		set(object, "inflections_after", count(after->inflections));
		set(object, "change_max_mm", number(1000.0 * after->change_max_m));
		(void)json_array_append_new(list, object);
	}
	return list;
}

static json_t *device_json(int device)
{
	if (device == BATTEN_DEVICE_AUTO)
		return json_string("auto");
	return device == BATTEN_DEVICE_REFERENCE ? json_string("reference") : json_integer(device);
}

/* Null where nothing was to be kept. */
static json_t *kept_json(const batten_fairing *fairing)
{
	size_t kept_count = 0;
	unsigned rounds = 0;
	const batten_kept *kept = batten_fairing_kept(fairing, &kept_count, &rounds);
	if (kept_count == 0)
		return json_null();
	json_t *list = json_array();
	for (size_t i = 0; i < kept_count; i++) {
		json_t *object = json_object();
		set(object, "measure", json_string(batten_hydrostatics_name(kept[i].quantity)));
		set(object, "wanted", number(kept[i].wanted));
		set(object, "tolerance", number(kept[i].tolerance));
		set(object, "value", number(kept[i].value));
		set(object, "multiplier", number(kept[i].multiplier));
		(void)json_array_append_new(list, object);
	}
	json_t *object = json_object();
	set(object, "rounds", count(rounds));
	set(object, "measures", list);
	return object;
}

/* What is of the search alone. */
static void set_search(json_t *object, const fair_job *job)
{
	const batten_fairing_facts facts = batten_fairing_describe(job->fairing);
	const fair_request *request = job->request;
	const bool net = job->options.variables == BATTEN_VARIABLES_NET;
	set(object, "search",
	    json_string(batten_search_algorithm_text(batten_fairing_result(job->fairing)->algorithm)));
	set(object, "variables", json_string(net ? "net" : "offsets"));
	set(object, "interior_penalty", json_boolean(job->options.search.interior_penalty));
	set(object, "fairness", json_string(batten_fairness_text(job->options.fairness)));
	set(object, "longitudinal_weight", number(job->options.search.longitudinal_weight));
	set(object, "transverse_weight", number(job->options.search.transverse_weight));
	set(object, "w1", number(facts.w1));
	set(object, "w2", number(facts.w2));
	set(object, "weights", json_string(facts.weights_by_noise ? "discrepancy principle" : "given"));
	set(object, "max_distance_m", number(facts.max_distance_m));
	set(object, "upper_half_beams", number(1.2));
	set(object, "lock", path_json(request->lock));
	set(object, "kept", kept_json(job->fairing));
	set(object, "lower", path_json(request->lower_path));
	set(object, "upper", path_json(request->upper_path));
	set(object, "fix_tangent", path_json(request->tangents));
	set(object, "round", path_json(request->rounded));
	set(object, "iteration_limit", count(job->options.search.iteration_limit));
	set(object, "variable_count", count(facts.variable_count));
	set(object, "at_limit_count", count(facts.at_limit_count));
	set(object, "rms_change_m", number(facts.rms_change_m));
}

/* What is of forward and inverse methods alone. */
static void set_pass(json_t *object, const fair_job *job)
{
	const batten_fair_options *o = &job->options;
	const char *restore = fair_restore_text(o->restore);
	const batten_pass_facts facts = batten_fairing_describe_pass(job->fairing).facts;
	set(object, "order", count(facts.order));
	set(object, "order_sections", count(facts.order_sections));
	set(object, "vertices", facts.vertices ? count(facts.vertices) : json_null());
	set(object, "iterations", count(o->iterations));
	set(object, "max_cn_pct", o->max_cn_pct > 0.0 ? number(o->max_cn_pct) : json_null());
	set(object, "least_gain_pct", number(o->least_gain_pct));
	set(object, "restore", restore ? json_string(restore) : json_null());
}

static json_t *method_json(const fair_job *job)
{
	const batten_fairing_facts facts = batten_fairing_describe(job->fairing);
	json_t *object = json_object();
	set(object, "method", json_string(batten_fair_method_text((size_t)job->options.method)));
	set(object, "smooth", json_boolean(job->options.smooth));
	set(object, "noise_m", number(facts.noise_m));
	set(object, "seed", count(job->request->seed));
	set(object, "device_asked_for", device_json(job->request->device));
	set(object, "filled_count", count(facts.filled_count));
	if (job->options.method == BATTEN_METHOD_SEARCH)
		set_search(object, job);
	else if (fair_is_pass(&job->options))
		set_pass(object, job);
	return object;
}

static json_t *energies_json(const batten_surface_energies *energies)
{
	json_t *object = json_object();
	set(object, "energy_bending", number(energies->bending));
	set(object, "energy_mean", number(energies->mean));
	set(object, "energy_gauss", number(energies->gauss));
	set(object, "area_m2", number(energies->area_m2));
	set(object, "singular_points", count(energies->singular));
	set(object, "energy_mvc_per_m2", number(energies->variation_per_m2));
	set(object, "mvc_points_left_out", count(energies->variation_left_out));
	return object;
}

/* Null where the offsets were the variables. */
static json_t *surface_json(const fair_job *job)
{
	const batten_surface *surface = batten_fairing_faired_surface(job->fairing);
	if (!surface)
		return json_null();
	const batten_surface_net shape = batten_surface_describe(surface);
	const batten_fairing_net net = batten_fairing_describe_net(job->fairing);
	json_t *object = json_object();
	set(object, "frame", json_string("ap-fwd"));
	set(object, "unit", json_string("m"));
	set(object, "rule",
	    json_string(
			"energies: Gauss quadrature over every knot span, a point more than the order a "
			"direction"));
	set(object, "order_u", count(shape.order_u));
	set(object, "order_v", count(shape.order_v));
	set(object, "count_u", count(shape.count_u));
	set(object, "count_v", count(shape.count_v));
	set(object, "locked_poles", count(net.locked_count));
	set(object, "fit_points", count(net.deviation.point_count));
	set(object, "fit_deviation_rms_m", number(net.deviation.rms_m));
	set(object, "fit_deviation_max_m", number(net.deviation.max_m));
	set(object, "fit_deviation_rms_pct", number(net.deviation.rms_pct));
	set(object, "fit_deviation_max_pct", number(net.deviation.max_pct));
	set(object, "fit_deviation_max_x_m", number(net.deviation.x_m));
	set(object, "fit_deviation_max_y_m", number(net.deviation.y_m));
	set(object, "fit_deviation_max_z_m", number(net.deviation.z_m));
	set(object, "offsets_on_surface", count(net.on_count));
	set(object, "offsets_beyond_edge", count(net.beyond_count));
	set(object, "offsets_kept", count(net.kept_count));
	set(object, "before", energies_json(&net.before));
	set(object, "after", energies_json(&net.after));
	return object;
}

/* Null where nothing was searched. */
static json_t *search_json(const fair_job *job)
{
	if (job->options.method != BATTEN_METHOD_SEARCH)
		return json_null();
	const batten_search_result *result = batten_fairing_result(job->fairing);
	const batten_run *run = batten_fairing_run(job->fairing);
	const batten_certificate *certificate = batten_fairing_certificate(job->fairing);
	json_t *object = json_object();
	set(object, "status", json_string(batten_search_end_text(result->end)));
	set(object, "iterations", count(result->iterations));
	set(object, "probes", json_integer((json_int_t)result->probes));
	set(object, "objective_before", number(result->objective_start));
	set(object, "objective_after", number(result->objective_end));
	set(object, "last_step_m", number(result->last_step_m));
	set(object, "gap_estimate", certificate ? number(certificate->gap_estimate) : json_null());
	set(object, "polish_steps", certificate ? count(certificate->steps) : json_null());
	set(object, "gradient_per_m", certificate ? number(certificate->gradient_per_m) : json_null());
	set(object, "device", json_string(run->device));
	set(object, "strict", json_boolean(run->strict));
	set(object, "precision", json_string(job->request->precision == BATTEN_F64 ? "f64" : "f32"));
	set(object, "seconds", number(run->seconds));
	return object;
}

batten_status fair_report_write(const fair_job *job, FILE *stream)
{
	json_t *report = json_object();
	set(report, "batten", json_string(batten_version()));
	set(report, "command", command_line(job->request));
	set(report, "hull", hull_json(job->hull));
	set(report, "before", state_json(&job->before, false, false));
	set(report, "smoothed", state_json(&job->smoothed, true, false));
	set(report, "after", state_json(&job->after, false, true));
	set(report, "replaced", replaced_json(job->fairing));
	set(report, "lines", lines_json(job));
	set(report, "method", method_json(job));
	set(report, "surface", surface_json(job));
	set(report, "search", search_json(job));
	set(report, "passes", fair_passes_json(job));
	set(report, "pictures", job->vulkan_driver[0] ? json_string(job->vulkan_driver) : json_null());
	json_t *warnings = json_array();
	for (size_t w = 0; w < job->warning_count; w++)
		(void)json_array_append_new(warnings, json_string(job->warnings[w]));
	set(report, "warnings", warnings);
	return cli_json_write(report, stream);
}
