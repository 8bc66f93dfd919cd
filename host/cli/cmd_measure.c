/* batten measure: every measure of a hull, its hydrostatics over drafts. */
#include "json_out.h"
#include "measure_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const cli_command command = {
	.name = "measure",
	.usage = "HULL.csv|SURFACE.json ...|MESH.stl|MESH.obj [OPTION ...]",
	.summary = "fairness numbers, energies, form coefficients and hydrostatics of a hull",
	.example = "  batten measure data/hulls/wigley.csv --json\n"
			   "  batten measure data/hulls/bsra_trawler.csv --curves-of-form 10 --out form.svg\n"
			   "  batten measure data/hulls/npl_parent.csv --displacement 0.12 --kg 0.2\n",
	.notes =
		"Units and signs stand in the names; frame: origin at the aft perpendicular on the baseline,\n"
		"x forward, z up. L of the coefficients is lbp_m, B is beam_wl_m. '-' (null in JSON): not\n"
		"defined for this hull. Curves and tables go to FILE, as CSV, JSON or SVG by its ending, else\n"
		"to standard output; their N heights are equal steps up to --draft, else to the highest\n"
		"waterline. A surface (batten surface --out) is integrated by Gauss points and needs --draft\n"
		"or --displacement; the stations of its tables are equally spaced. So does a mesh of triangles,\n"
		"in metres and this frame, counter-clockwise seen from the water, a half hull where nothing lies\n"
		"to starboard; it may be open along the deck and at flat ends. Several surfaces of one topology\n"
		"are measured in one go, a row each for every draft; those that a draft is beyond say so, and\n"
		"the exit code is 1.\n",
};

static const char *const quadratures[] = { "spline", "simpson", "trapezoid" };

/* What all numbers are of (Letcher 1.2.1, 10); the report says so, that two hulls compare. */
static const char state_text[] = "moulded, bare hull, upright";
static const char transom_text[] = "left out of wetted_surface_m2";

enum { WARNINGS_MOST = 16, HEIGHTS_MOST = 4096, FILES_MOST = 4096 };

/* Measures, then what only hydrostatics has, where it exists. */
struct found {
	batten_measures measures;
	batten_hydrostatics hydrostatics;
	batten_warning warnings[WARNINGS_MOST];
	size_t warning_count;
};

/* The quantities of hydrostatics that are no measures stand at the end of their list. */
enum { SHARED_COUNT = (int)(offsetof(batten_hydrostatics, transom_area_m2) / sizeof(double)) };

static void print_line(const char *name, double value, const char *text)
{
	(void)printf("%-22s ", name);
	if (isnan(value))
		(void)printf("%16s", "-");
	else
		(void)printf("%16.8g", value);
	(void)printf("  %s\n", text);
}

static void print_text(const measure_job *job, const struct found *found)
{
	const double *values = (const double *)&found->measures;
	const double *more = (const double *)&found->hydrostatics;
	if (job->hull)
		(void)printf("%s: %zu stations, %zu waterlines; metres, frame ap-fwd; quadrature: %s\n",
		             job->name, batten_hull_station_count(job->hull),
		             batten_hull_waterline_count(job->hull), measure_rule(job));
	else
		(void)printf("%s: %s; metres, frame ap-fwd; quadrature: %s\n", job->name,
		             job->mesh ? "triangles" : "B-spline surface", measure_rule(job));
	(void)printf("%s; transom %s\n\n", state_text, transom_text);
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++)
		print_line(batten_measure_name(i), values[i], batten_measure_text(i));
	for (size_t i = SHARED_COUNT; i < BATTEN_HYDROSTATICS_COUNT; i++)
		if (!isnan(more[i]))
			print_line(batten_hydrostatics_name(i), more[i], batten_hydrostatics_text(i));
}

static batten_status print_json(const measure_job *job, const struct found *found)
{
	const double *more = (const double *)&found->hydrostatics;
	json_t *warnings = json_array();
	json_t *object = json_pack("{s:s, s:s, s:s, s:s, s:s}", "name", job->name, "frame", "ap-fwd",
	                           "quadrature", measure_rule(job), "state", state_text, "transom",
	                           transom_text);
	if (object)
		cli_json_measures(object, &found->measures);
	for (size_t i = SHARED_COUNT; object && i < BATTEN_HYDROSTATICS_COUNT; i++)
		(void)json_object_set_new(object, batten_hydrostatics_name(i), cli_json_number(more[i]));
	for (size_t i = 0; warnings && i < found->warning_count; i++)
		(void)json_array_append_new(warnings, json_string(found->warnings[i].text));
	(void)json_object_set_new(object, "warnings", warnings);
	return cli_json_print("measure", object);
}

/* Everything at one draft; what a hull of its own gives is measured at the draft of its file. */
static batten_status take_found(const measure_job *job, batten_context *context,
                                struct found *found)
{
	batten_status status = BATTEN_OK;
	if (job->hull) {
		batten_measure_options options;
		batten_measure_options_default(&options);
		options.draft_m = job->draft_count ? job->drafts_m[0] : 0;
		options.quadrature = job->options.quadrature;
		options.density_t_per_m3 = job->options.density_t_per_m3;
		status = batten_hull_measure(context, job->hull, &options, &found->measures);
	} else if (job->mesh) {
		status = batten_mesh_measure(context, job->mesh, &job->options, job->drafts_m[0],
		                             &found->measures);
	} else {
		status = batten_surface_measure(context, job->surface, &job->options, job->drafts_m[0],
		                                &found->measures);
	}
	if (status != BATTEN_OK)
		return cli_failure("measure", context, status);
	status = measure_hydrostatics(job, context, 1, &found->measures.draft_m, &found->hydrostatics);
	if (status == BATTEN_OK)
		found->warning_count = batten_hydrostatics_warnings(&found->hydrostatics, found->warnings,
		                                                    WARNINGS_MOST);
	return status;
}

static batten_status measure_one(const measure_job *job, batten_context *context)
{
	struct found found = { .warning_count = 0 };
	const batten_status status = take_found(job, context, &found);
	if (status != BATTEN_OK)
		return status;
	for (size_t i = 0; !job->common.quiet && i < found.warning_count; i++)
		(void)fprintf(stderr, "warning: %s\n", found.warnings[i].text);
	if (job->common.json)
		return print_json(job, &found);
	print_text(job, &found);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Options
 * --------------------------------------------------------------------------------------------- */

static batten_status read_quadrature(measure_job *job)
{
	for (size_t q = 0; q < sizeof quadratures / sizeof quadratures[0]; q++)
		if (strcmp(job->quadrature, quadratures[q]) == 0) {
			job->options.quadrature = (batten_quadrature)q;
			return BATTEN_OK;
		}
	return cli_usage("measure", "--quadrature: found '%s', expected spline, simpson or trapezoid",
	                 job->quadrature);
}

/* Drafts above 0, with commas between them. */
static batten_status read_drafts(measure_job *job)
{
	for (const char *word = job->drafts_text; word; job->draft_count++) {
		char *end = NULL;
		const double draft = strtod(word, &end);
		if (end == word || (*end != '\0' && *end != ',') || !isfinite(draft))
			return cli_usage("measure", "--draft: found '%s', expected a number", word);
		if (draft <= 0.0)
			return cli_usage("measure", "--draft: found %g, expected a draft above 0", draft);
		if (job->draft_count == MEASURE_DRAFTS_MOST)
			return cli_usage("measure", "--draft: found more than %d drafts", MEASURE_DRAFTS_MOST);
		job->drafts_m[job->draft_count] = draft;
		word = *end == ',' ? end + 1 : NULL;
	}
	return BATTEN_OK;
}

static bool wants_table(const measure_job *job)
{
	return job->curves_of_form || job->bonjean || job->section_areas || job->draft_count > 1 ||
	       job->path_count > 1;
}

static bool good_ending(const char *path)
{
	static const char *const endings[] = { ".csv", ".json", ".svg" };
	const char *dot = strrchr(path, '.');
	for (size_t i = 0; dot && dot > path && i < 3; i++)
		if (strcmp(dot, endings[i]) == 0)
			return true;
	return false;
}

/* Of several files only the table over drafts is made. */
static batten_status check_many(const measure_job *job)
{
	for (size_t i = job->path_count; i-- > 0;)
		if (!measure_ends_in(job->paths[i], ".json"))
			return cli_usage("measure",
			                 "found %zu files, '%s' among them: several are to be surfaces, "
			                 ".json",
			                 job->path_count, job->paths[i]);
	if (job->draft_count == 0 || job->curves_of_form || job->bonjean || job->section_areas)
		return cli_usage("measure",
		                 "of several surfaces --draft T[,T...] was expected, and no curves");
	if (job->out && measure_ends_in(job->out, ".svg"))
		return cli_usage("measure", "--out: of several surfaces a .csv or .json was expected");
	return BATTEN_OK;
}

static batten_status check_request(const measure_job *job)
{
	const int tables = (job->curves_of_form > 0) + (job->bonjean > 0) + job->section_areas;
	const bool charted = job->curves_of_form > 1 || job->bonjean > 1 || job->section_areas ||
	                     (tables == 0 && job->draft_count > 1);
	if (job->curves_of_form > HEIGHTS_MOST || job->bonjean > HEIGHTS_MOST)
		return cli_usage("measure", "--curves-of-form and --bonjean: 1 to %d heights are expected",
		                 HEIGHTS_MOST);
	if (tables > 1)
		return cli_usage("measure", "--curves-of-form, --bonjean and --section-areas: one of them "
		                            "was expected");
	if (!isnan(job->displacement_t) && job->draft_count > 0)
		return cli_usage("measure", "--displacement and --draft: one of them was expected");
	if ((job->curves_of_form || job->bonjean) && job->draft_count > 1)
		return cli_usage("measure", "--draft: found %zu drafts, expected the highest one",
		                 job->draft_count);
	if (job->out && !wants_table(job))
		return cli_usage("measure", "--out goes with --curves-of-form, --bonjean, --section-areas "
		                            "or several drafts");
	if (job->out && !good_ending(job->out))
		return cli_usage("measure",
		                 "--out: found '%s', expected a name that ends in .csv, .json "
		                 "or .svg",
		                 job->out);
	if (job->out && strcmp(strrchr(job->out, '.'), ".svg") == 0 && !charted)
		return cli_usage("measure", "--out: a chart needs two heights at least");
	return BATTEN_OK;
}

static batten_status read_command(measure_job *job, int argc, char **argv, bool *done)
{
	const cli_option options[] = {
		{ "draft", CLI_TEXT, &job->drafts_text, "T[,T...]",
		  "drafts in metres (default: the file's)" },
		{ "displacement", CLI_NUMBER, &job->displacement_t, "W",
		  "the draft at which the hull displaces W tonnes" },
		{ "curves-of-form", CLI_COUNT, &job->curves_of_form, "N", "all hydrostatics at N drafts" },
		{ "bonjean", CLI_COUNT, &job->bonjean, "N", "section areas up to each of N heights" },
		{ "section-areas", CLI_FLAG, &job->section_areas, NULL,
		  "section area curve at each draft" },
		{ "out", CLI_TEXT, &job->out, "FILE", "where a table goes: .csv, .json or .svg" },
		{ "kg", CLI_NUMBER, &job->options.kg_m, "Z",
		  "centre of gravity above the baseline in metres" },
		{ "lbp", CLI_NUMBER, &job->options.lbp_m, "L",
		  "of a surface or mesh, in metres (default: x of its foremost point)" },
		{ "quadrature", CLI_TEXT, &job->quadrature, "RULE",
		  "of offsets: spline (default), simpson or trapezoid" },
		{ "density", CLI_NUMBER, &job->options.density_t_per_m3, "RHO",
		  "of the water in t/m3 (1.025)" },
		{ "device", CLI_DEVICE, &job->device, "D",
		  "of several surfaces: auto (default), reference or an index" },
		{ 0 },
	};
	static const char *paths[FILES_MOST];
	batten_status status = cli_parse(&command, argc, argv, options, &job->common, paths, FILES_MOST,
	                                 &job->path_count, done);
	if (status != BATTEN_OK || *done)
		return status;
	if (job->path_count < 1)
		return cli_usage("measure", "an offsets file was expected, a surface or a mesh");
	if (job->path_count == 1 && job->device != BATTEN_DEVICE_AUTO)
		return cli_usage("measure",
		                 "--device: found one file, expected several surfaces: one alone "
		                 "is measured without a device");
	job->path = paths[0];
	job->paths = paths;
	status = read_drafts(job);
	if (status == BATTEN_OK)
		status = read_quadrature(job);
	if (status == BATTEN_OK)
		status = check_request(job);
	return status == BATTEN_OK && job->path_count > 1 ? check_many(job) : status;
}

batten_status cli_measure(int argc, char **argv)
{
	measure_job job = { .quadrature = "spline",
		                .displacement_t = NAN,
		                .device = BATTEN_DEVICE_AUTO };
	batten_hydrostatics_options_default(&job.options);
	bool done = false;
	batten_status status = read_command(&job, argc, argv, &done);
	batten_context *context = NULL;
	if (status != BATTEN_OK || done)
		return status;
	status = cli_context_create("measure", &job.common, &context);
	if (status != BATTEN_OK)
		return status;
	const bool many = job.path_count > 1;
	status = many ? measure_many(&job, context) : measure_open(&job, context);
	if (status == BATTEN_OK && !many)
		status = wants_table(&job) ? measure_table(&job, context) : measure_one(&job, context);
	measure_close(&job);
	batten_context_destroy(context);
	return status;
}
