/* batten fair: one hull in, the faired hull, its report and its pictures out. */
#include "fair_job.h"

#include "json_out.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const cli_command command = {
	.name = "fair",
	.usage = "HULL.csv [--out DIR] [OPTION ...]",
	.summary = "fairs a hull: by pattern search, forward or inverse fairing, or all of them",
	.example =
		"  batten fair data/hulls/npl_parent.csv --out demo\n"
		"  batten fair hull.csv --w1 1 --w2 1e4 --max-distance 5mm --lock waterline:0.24\n"
		"  batten fair data/hulls/npl_parent.csv --fairness mean --longitudinal 4\n"
		"  batten fair data/hulls/npl_parent.csv --front 1:1e6:25 --out front\n"
		"  batten fair data/hulls/bsra_trawler.csv --variables net --net 12x7 --fix-tangent stem\n"
		"  batten fair data/hulls/bsra_trawler.csv --variables net --front 1:1e6:13 --out front\n"
		"  batten fair data/hulls/wigley_noisy.csv --method forward-approximation --order 3 --max-cn 3\n"
		"  batten fair data/hulls/wigley_noisy.csv --method inverse --order 4 --order-sections 3\n"
		"  batten fair data/hulls/npl_parent.csv --keep volume_m3=0.01%,lcb_pct_lbp_fwd=0.01\n"
		"  batten fair data/hulls/npl_parent.csv --precision f32 --polish 1e-10\n"
		"  batten fair data/hulls/npl_parent.csv --method all --out compared\n",
	.notes =
		"Writes DIR/faired.csv, DIR/report.json, DIR/before.png, DIR/after.png and DIR/lines.svg; DIR is\n"
		"NAME-faired by default. Minimises w1 * fairness + w2 * closeness / h^4 (h: half-beam) over\n"
		"the positive offsets; profile points stay. Without weights the change is held to 0.75 of the\n"
		"noise of the offsets. f32 comes within 3e-4 of the objective that f64 reaches.\n"
		"Where there is no gap_estimate the search ended near no minimum; --polish goes on from there.\n"
		"--variables net fits a B-spline surface and searches y of its poles; x, z and knots stay. Rows run\n"
		"along the hull from the keel (0), columns along the girth from the stern (0). Poles stay within\n"
		"--max-distance of the fit, and so does the surface; station:, waterline: and point: lock all poles\n"
		"that have a part in the surface there. Poles of edges in the centreplane stay. faired.csv has the\n"
		"half-breadths of the faired surface, DIR/surface.json the surface in metres, frame ap-fwd; profile\n"
		"zeros, locked offsets and what lies off the surface keep their numbers (the report counts these).\n"
		"--front writes one row a weight, from LOW to HIGH, equal factors apart; over a net also the surface of\n"
		"each, DIR/surface-0001.json and so on, and closeness is that to the fitted surface.\n"
		"--method smooth replaces gross errors and stops. The forward methods and inverse (thesis 5, 6)\n"
		"take the file as it is (--smooth replaces gross errors first), work line by line and print a row an\n"
		"iteration; ends of lines stay, stem, stern and keel points beyond the table come from its profile\n"
		"rows. forward-approximation: the points of a line are the polygon of its B-spline; forward-fit:\n"
		"waterlines by least squares; inverse: the second derivatives along waterlines and sections as\n"
		"B-spline surfaces, then the offsets that come closest to them. Order 2 changes nothing.\n"
		"--method all takes every method in turn from the smoothed hull, each into a folder of DIR, and puts\n"
		"them side by side: DIR/compare.svg, DIR/compare.json and the table printed.\n",
};

void fair_warn(fair_job *job, const char *format, ...)
{
	if (job->warning_count == FAIR_WARNING_LIMIT)
		return;
	char *line = job->warnings[job->warning_count++];
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(line, FAIR_WARNING_SIZE, format, arguments);
	va_end(arguments);
	if (!job->request->common.quiet)
		(void)fprintf(stderr, "warning: %s\n", line);
}

static batten_status measure_state(fair_job *job, const batten_hull *hull, fair_state *state)
{
	state->hull = hull;
	batten_status status = batten_hull_measure(job->context, hull, NULL, &state->measures);
	if (status == BATTEN_OK)
		status = batten_hull_closeness(job->context, hull, batten_fairing_input(job->fairing),
		                               &state->to_input);
	if (status == BATTEN_OK)
		status = batten_hull_closeness(job->context, hull, batten_fairing_smoothed(job->fairing),
		                               &state->to_smoothed);
	return status;
}

static batten_status measure_lines(fair_job *job)
{
	const batten_hull *input = job->before.hull;
	size_t count = 0;
	batten_status status = batten_hull_lines(job->context, input, NULL, NULL, 0, &count);
	if (status != BATTEN_OK)
		return status;
	job->lines_before = calloc(count ? count : 1, sizeof *job->lines_before);
	job->lines_after = calloc(count ? count : 1, sizeof *job->lines_after);
	if (!job->lines_before || !job->lines_after)
		return BATTEN_MEMORY;
	job->line_count = count;
	status = batten_hull_lines(job->context, input, NULL, job->lines_before, count, &count);
	if (status == BATTEN_OK)
		status = batten_hull_lines(job->context, job->after.hull, input, job->lines_after, count,
		                           &count);
	if (status == BATTEN_OK && count < job->line_count)
		job->line_count = count;
	return status;
}

static void warn_of_net(fair_job *job)
{
	const batten_fairing_net net = batten_fairing_describe_net(job->fairing);
	const double limit = batten_fairing_describe(job->fairing).max_distance_m;
	if (net.kept_count > 0)
		fair_warn(job, "%zu offsets are locked or lie off the surface and kept their numbers",
		          net.kept_count);
	if (job->after.to_smoothed.cn_max_m > limit)
		fair_warn(job,
		          "an offset lies %.3g m from the smoothed hull, beyond the distance limit of %.3g "
		          "m: that holds against the fitted surface, itself up to %.3g m off the offsets",
		          job->after.to_smoothed.cn_max_m, limit, net.deviation.max_m);
}

static void warn_of_passes(fair_job *job)
{
	const batten_fairing_pass pass = batten_fairing_describe_pass(job->fairing);
	if (pass.facts.passed_count > 0)
		fair_warn(job,
		          "%zu lines or pieces of lines have too few points for the method and were passed "
		          "over, %zu were faired",
		          pass.facts.passed_count, pass.facts.line_count);
	if (batten_fairing_row_count(job->fairing) == 1)
		fair_warn(job, "the first iteration would have passed --max-cn: nothing is changed");
	if (pass.warning[0])
		fair_warn(job, "--restore: %s", pass.warning);
}

/* What a naval architect wants to be told before using the result. */
static void warn_of_changes(fair_job *job)
{
	const batten_measures *before = &job->before.measures;
	const batten_measures *after = &job->after.measures;
	const double volume = 100.0 * (after->volume_m3 - before->volume_m3) / before->volume_m3;
	const double lcb = after->lcb_pct_lbp_fwd - before->lcb_pct_lbp_fwd;
	if (fabs(volume) > 0.2)
		fair_warn(job, "the volume changed by %+.2f %%", volume);
	if (fabs(lcb) > 0.1)
		fair_warn(job, "the centre of buoyancy moved by %+.2f %% of LBP", lcb);
	if (job->after.to_input.cn_max_m > 0.002)
		fair_warn(job, "an offset changed by %.1f mm (more than 2 mm at the file's scale)",
		          1000.0 * job->after.to_input.cn_max_m);
	if (job->options.variables == BATTEN_VARIABLES_NET)
		warn_of_net(job);
	if (fair_is_pass(&job->options))
		warn_of_passes(job);
	if (batten_fairing_result(job->fairing)->end == BATTEN_SEARCH_LIMIT)
		fair_warn(job, "the search met its iteration limit and is not converged");
	if (batten_fairing_run(job->fairing)->warning[0])
		fair_warn(job, "%s", batten_fairing_run(job->fairing)->warning);
}

static batten_status measure_job(fair_job *job)
{
	batten_status status = measure_state(job, batten_fairing_input(job->fairing), &job->before);
	if (status == BATTEN_OK)
		status = measure_state(job, batten_fairing_smoothed(job->fairing), &job->smoothed);
	if (status == BATTEN_OK)
		status = measure_state(job, batten_fairing_faired(job->fairing), &job->after);
	if (status == BATTEN_OK)
		status = measure_lines(job);
	if (status == BATTEN_OK)
		warn_of_changes(job);
	return status;
}

static batten_status read_hulls(fair_job *job)
{
	const fair_request *request = job->request;
	batten_status status = batten_hull_read(job->context, request->hull_path, &job->hull);
	if (status == BATTEN_OK && request->lower_path)
		status = batten_hull_read(job->context, request->lower_path, &job->lower);
	if (status == BATTEN_OK && request->upper_path)
		status = batten_hull_read(job->context, request->upper_path, &job->upper);
	return status == BATTEN_OK ? status : cli_failure("fair", job->context, status);
}

/* NAME-faired, NAME being the file's without folder and ending. */
static batten_status choose_folder(const fair_request *request, char folder[PATH_MAX])
{
	int length = 0;
	if (request->out) {
		length = snprintf(folder, PATH_MAX, "%s", request->out);
	} else {
		const char *slash = strrchr(request->hull_path, '/');
		const char *name = slash ? slash + 1 : request->hull_path;
		const char *dot = strrchr(name, '.');
		const int size = (int)(dot && dot != name ? (size_t)(dot - name) : strlen(name));
		length = snprintf(folder, PATH_MAX, "%.*s-faired", size, name);
	}
	if (length <= 0 || length >= PATH_MAX)
		return cli_usage("fair", "--out: found '%s', expected the path of a folder",
		                 request->out ? request->out : "");
	return BATTEN_OK;
}

static batten_status tell(fair_job *job, const char *folder)
{
	if (job->request->common.json) {
		const batten_status status = fair_report_write(job, stdout);
		if (status != BATTEN_OK)
			(void)fprintf(stderr, "batten fair: standard output: %s\n", batten_status_text(status));
		return status;
	}
	if (job->request->common.quiet)
		return BATTEN_OK;
	fair_table_print(job, stdout);
	(void)printf("\nwritten to %s: faired.csv, report.json, lines.svg%s%s\n", folder,
	             job->options.variables == BATTEN_VARIABLES_NET ? ", surface.json" : "",
	             job->vulkan_driver[0] ? ", before.png, after.png" : "");
	return BATTEN_OK;
}

batten_status fair_job_run(fair_job *job, const char *folder)
{
	batten_fair_options *options = &job->options;
	batten_status status = read_hulls(job);
	if (status == BATTEN_OK)
		status = fair_options_read(job->request, job->hull, options, &job->locks);
	if (status != BATTEN_OK)
		return status;
	options->lower = job->lower;
	options->upper = job->upper;
	/* A large table takes a while. */
	if (isatty(STDERR_FILENO) && !job->request->common.quiet)
		(void)fprintf(stderr, "fairing %s: %zu stations, %zu waterlines ...\n",
		              batten_hull_name(job->hull), batten_hull_station_count(job->hull),
		              batten_hull_waterline_count(job->hull));
	if (job->request->front)
		return fair_front(job, folder);
	const clock_t begun = clock();
	const batten_status faired = batten_hull_fair(job->context, job->hull, options, &job->fairing);
	job->cpu_seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
	if (faired != BATTEN_OK && faired != BATTEN_INCOMPLETE)
		return cli_failure("fair", job->context, faired);
	status = measure_job(job);
	if (status != BATTEN_OK)
		return cli_failure("fair", job->context, status);
	status = fair_files_write(job, folder);
	return status == BATTEN_OK ? faired : status;
}

void fair_job_destroy(fair_job *job)
{
	if (!job)
		return;
	batten_fairing_destroy(job->fairing);
	batten_hull_destroy(job->hull);
	batten_hull_destroy(job->lower);
	batten_hull_destroy(job->upper);
	free(job->lines_before);
	free(job->lines_after);
	batten_context_destroy(job->context);
	free(job);
}

/* By one method. */
static batten_status fair_one(const fair_request *request, const char *folder)
{
	fair_job *job = calloc(1, sizeof *job);
	if (!job) {
		(void)fprintf(stderr, "batten fair: %s\n", batten_status_text(BATTEN_MEMORY));
		return BATTEN_MEMORY;
	}
	job->request = request;
	batten_status status = cli_context_create("fair", &request->common, &job->context);
	if (status == BATTEN_OK)
		status = fair_job_run(job, folder);
	/* A front has been told already. */
	if (job->fairing && (status == BATTEN_OK || status == BATTEN_INCOMPLETE)) {
		const batten_status told = tell(job, folder);
		status = told == BATTEN_OK ? status : told;
	}
	fair_job_destroy(job);
	return status;
}

static batten_status parse(int argc, char **argv, fair_request *request, bool *done)
{
	const cli_option options[] = {
		{ "out", CLI_TEXT, &request->out, "DIR", "folder for the results (NAME-faired)" },
		{ "method", CLI_TEXT, &request->method, "NAME",
		  "search (default), smooth, forward-approximation, forward-fit, inverse, or all" },
		{ "search", CLI_TEXT, &request->search, "NAME",
		  "auto (default), multilevel, block, textbook (the thesis's, of offsets, to compare with)" },
		{ "variables", CLI_TEXT, &request->variables, "NAME",
		  "offsets (default) of the table, or net: poles of a surface" },
		{ "fairness", CLI_TEXT, &request->fairness, "NAME",
		  "bending (default), mean, gauss, or mvc: variation of curvature" },
		{ "longitudinal", CLI_NUMBER, &request->longitudinal, "X",
		  "weight of squared curvature along the waterlines (1)" },
		{ "transverse", CLI_NUMBER, &request->transverse, "X",
		  "weight of squared curvature square to them in the surface (1)" },
		{ "net", CLI_TEXT, &request->net, "MxN",
		  "poles along the hull and from keel to deck (chosen from the table and its noise)" },
		{ "order", CLI_TEXT, &request->order, "KxL",
		  "orders of the net, degree + 1, 2 to 8 (4x4); with other methods K along waterlines (3)" },
		{ "fix-tangent", CLI_TEXT, &request->tangents, "EDGES",
		  "keel,stern,stem,deck: their poles move with those beside them, so tangents stay" },
		{ "round", CLI_TEXT, &request->rounded, "EDGES",
		  "keel,stern,stem: the surface leaves the centreplane square to it there" },
		{ "w1", CLI_NUMBER, &request->w1, "X", "weight of fairness, dimensionless" },
		{ "w2", CLI_NUMBER, &request->w2, "Y", "weight of closeness, dimensionless" },
		{ "front", CLI_TEXT, &request->front, "LOW:HIGH:COUNT",
		  "fair nothing: sweep w2/w1 and write fairness over closeness as front.csv, .json, .svg; of a "
		  "net also the surfaces" },
		{ "max-distance", CLI_TEXT, &request->max_distance, "D",
		  "keep every offset this close to the smoothed hull (1% of the half-beam; or 0.5mm)" },
		{ "lock", CLI_TEXT, &request->lock, "LIST",
		  "station:X,waterline:Z,point:X@Z: do not move these (unit and frame of the file); "
		  "of a net also row:K,column:K,pole:COLUMN@ROW,edge:NAME" },
		{ "keep", CLI_TEXT, &request->keep, "LIST",
		  "volume_m3=0.1%,lcb_pct_lbp_fwd=0.05: keep these measures of the smoothed hull, at its draft, "
		  "so close (searches in f64), of --front at every point; of a net, those of its fitted surface" },
		{ "interior-penalty", CLI_FLAG, &request->interior_penalty, NULL,
		  "keep bounds by r sum 1/g, r falling (thesis 7.1), not by moves that end at them: --search "
		  "multilevel, three to six times the work" },
		{ "polish", CLI_NUMBER, &request->polish, "GAP",
		  "finish in f64, by Newton steps, where gap_estimate is above this, e.g. 1e-9, or there is none; "
		  "with --precision f32 the search only screens" },
		{ "lower", CLI_TEXT, &request->lower_path, "FILE", "lower offsets on the same table" },
		{ "upper", CLI_TEXT, &request->upper_path, "FILE", "upper offsets on the same table" },
		{ "no-smooth", CLI_FLAG, &request->no_smooth, NULL, "leave gross errors as they are" },
		{ "iterations", CLI_COUNT, &request->iterations, "N",
		  "iteration limit (400; textbook 20000); iterations of forward (5) and inverse (1) methods" },
		{ "order-sections", CLI_COUNT, &request->order_sections, "K",
		  "order along the sections, of forward and inverse methods (as --order)" },
		{ "vertices", CLI_COUNT, &request->vertices, "N",
		  "forward-fit: vertices of a waterline (8); inverse: of a line of a field (its points)" },
		{ "max-cn", CLI_NUMBER, &request->max_cn, "PERCENT",
		  "forward and inverse: stop before an offset moved by more of the half-beam" },
		{ "least-gain", CLI_NUMBER, &request->least_gain, "PERCENT",
		  "forward and inverse: stop when an iteration lowers fn by less" },
		{ "restore", CLI_TEXT, &request->restore, "WHAT",
		  "forward and inverse: bring back beam, volume or cp,lcb" },
		{ "smooth", CLI_FLAG, &request->smooth_first, NULL,
		  "forward and inverse: replace gross errors first, as the search does" },
		{ "device", CLI_DEVICE, &request->device, "D",
		  "auto (default), reference (plain C), or an index of 'batten devices'" },
		{ "precision", CLI_PRECISION, &request->precision, "P", "f64 (default) or f32" },
		{ "seed", CLI_COUNT, &request->seed, "N", "kept in the report; this method draws no lots" },
		{ 0 },
	};
	size_t count = 0;
	const batten_status status = cli_parse(&command, argc, argv, options, &request->common,
	                                       &request->hull_path, 1, &count, done);
	if (status == BATTEN_OK && !*done && count != 1)
		return cli_usage("fair", "an offsets file was expected");
	return status;
}

batten_status cli_fair(int argc, char **argv)
{
	fair_request request = { .method = "search",
		                     .search = "auto",
		                     .variables = "offsets",
		                     .fairness = "bending",
		                     .w1 = NAN,
		                     .w2 = NAN,
		                     .longitudinal = NAN,
		                     .transverse = NAN,
		                     .iterations = UINT_MAX,
		                     .order_sections = UINT_MAX,
		                     .vertices = UINT_MAX,
		                     .max_cn = NAN,
		                     .least_gain = NAN,
		                     .polish = NAN,
		                     .device = BATTEN_DEVICE_AUTO,
		                     .precision = BATTEN_F64,
		                     .argc = argc,
		                     .argv = argv };
	bool done = false;
	batten_status status = parse(argc, argv, &request, &done);
	if (status != BATTEN_OK || done)
		return status;
	char folder[PATH_MAX];
	status = choose_folder(&request, folder);
	if (status != BATTEN_OK)
		return status;
	return strcmp(request.method, "all") == 0 ? fair_all(&request, folder)
	                                          : fair_one(&request, folder);
}
