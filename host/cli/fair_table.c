/* The table that batten fair prints on the terminal. */
#include "fair_job.h"

#include <math.h>
#include <string.h>

static void print_value(FILE *stream, double value)
{
	if (isnan(value))
		(void)fprintf(stream, " %12s", "-");
	else
		(void)fprintf(stream, " %12.6g", value);
}

/* Percent of the smoothed hull's value; counts, percentages and what is as good as zero there by their
 * difference. */
static void print_change(FILE *stream, const char *name, double smoothed, double after)
{
	const bool absolute = strstr(name, "_pct_") || strcmp(name, "inflections") == 0 ||
	                      fabs(smoothed) < 1e-9;
	double percent = 100.0 * (after - smoothed) / fabs(smoothed);
	if (fabs(percent) < 0.005)
		percent = 0.0; /* not "-0.00" */
	if (isnan(smoothed) || isnan(after))
		(void)fprintf(stream, " %11s", "-");
	else if (absolute)
		(void)fprintf(stream, " %+11.4g", fabs(after - smoothed) < 1e-9 ? 0.0 : after - smoothed);
	else
		(void)fprintf(stream, " %+9.2f %%", percent);
}

static void print_row(FILE *stream, const char *name, double before, double smoothed, double after)
{
	(void)fprintf(stream, "%-22s", name);
	print_value(stream, before);
	print_value(stream, smoothed);
	print_value(stream, after);
	print_change(stream, name, smoothed, after);
	(void)fputc('\n', stream);
}

/* The measures a reader of the terminal looks for; the report has them all. */
static bool is_short(const char *name)
{
	static const char *const names[] = {
		"volume_m3",
		"wetted_surface_m2",
		"cb",
		"cp",
		"cm",
		"cwp",
		"kb_m",
		"bmt_m",
		"lcb_pct_lbp_fwd",
		"fn_per_m2",
		"fn_sections_per_m2",
		"energy_bending",
		"energy_mean",
		"noise_m",
		"inflections",
		"lcf_pct_lbp_fwd",
	};
	for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
		if (strcmp(name, names[i]) == 0)
			return true;
	return false;
}

static void print_replacements(const fair_job *job, FILE *stream)
{
	const size_t count = batten_fairing_replacement_count(job->fairing);
	const batten_replacement *list = batten_fairing_replacements(job->fairing);
	const size_t shown = count < 10 ? count : 10;
	for (size_t r = 0; r < shown; r++)
		(void)fprintf(stream, "replaced: x = %.6g m, z = %.6g m: half-breadth %.6g m by %.6g m\n",
		              list[r].x_m, list[r].z_m, list[r].old_m, list[r].new_m);
	if (shown < count)
		(void)fprintf(stream, "replaced: %zu more, listed in report.json\n", count - shown);
}

/* The surface: how far off the offsets, how fair. Nothing is smoothed in it. */
static void print_net(const fair_job *job, FILE *stream)
{
	const batten_surface_net shape = batten_surface_describe(
		batten_fairing_faired_surface(job->fairing));
	const batten_fairing_net net = batten_fairing_describe_net(job->fairing);
	(void)fprintf(
		stream,
		"\nsurface: %zu x %zu poles of order %zu x %zu, %zu of them held; off the smoothed "
		"offsets\nby %.4g m rms (%.3g %% of the half-beam), %.4g m at most (%.3g %%), as "
		"fitted\n\n",
		shape.count_u, shape.count_v, shape.order_u, shape.order_v, net.locked_count,
		net.deviation.rms_m, net.deviation.rms_pct, net.deviation.max_m, net.deviation.max_pct);
	(void)fprintf(stream, "%-22s %12s %12s %12s %11s\n", "of the surface", "", "fitted", "after",
	              "by fairing");
	const struct {
		const char *name;
		double before, after;
	} rows[] = { { "energy_bending", net.before.bending, net.after.bending },
		         { "energy_mean", net.before.mean, net.after.mean },
		         { "energy_gauss", net.before.gauss, net.after.gauss } };
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
		print_row(stream, rows[i].name, NAN, rows[i].before, rows[i].after);
}

/* What the end of the search is worth. */
static void print_certificate(const batten_certificate *certificate, FILE *stream)
{
	if (!certificate)
		return;
	if (certificate->message[0] != '\0')
		(void)fprintf(stream, "no estimate of the gap to a minimum: %s\n", certificate->message);
	else
		(void)fprintf(stream,
		              "gap to the minimum nearby: %.2g of the objective, by its derivatives\n",
		              certificate->gap_estimate);
}

void fair_table_print(const fair_job *job, FILE *stream)
{
	const batten_fairing_facts facts = batten_fairing_describe(job->fairing);
	const batten_search_result *result = batten_fairing_result(job->fairing);
	const double *before = (const double *)&job->before.measures;
	const double *smoothed = (const double *)&job->smoothed.measures;
	const double *after = (const double *)&job->after.measures;
	(void)fprintf(stream, "%s: %zu stations, %zu waterlines; metres, frame ap-fwd\n",
	              batten_hull_name(job->hull), batten_hull_station_count(job->hull),
	              batten_hull_waterline_count(job->hull));
	print_replacements(job, stream);
	(void)fprintf(stream, "\n%-22s %12s %12s %12s %11s\n", "", "before", "smoothed", "after",
	              "by fairing");
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++)
		if (is_short(batten_measure_name(i)))
			print_row(stream, batten_measure_name(i), before[i], smoothed[i], after[i]);
	(void)fprintf(stream, "%-22s %12s %12.6g %12.6g\n", "cn_pct (to input)", "",
	              job->smoothed.to_input.cn_pct, job->after.to_input.cn_pct);
	(void)fprintf(stream, "%-22s %12s %12s %12.6g\n", "cn_search_pct", "", "",
	              job->after.to_smoothed.cn_pct);
	const bool net = job->options.variables == BATTEN_VARIABLES_NET;
	if (fair_is_pass(&job->options))
		fair_passes_print(job->fairing, stream);
	if (job->options.method != BATTEN_METHOD_SEARCH)
		return;
	if (net)
		print_net(job, stream);
	(void)fprintf(
		stream,
		"\nsearch: %s after %u iterations, %llu probes; objective %.6g to %.6g; w2/w1 = %.4g%s;\n"
		"%zu of %zu %s at a bound (distance limit %.4g m); %.3f s on %s\n",
		batten_search_end_text(result->end), result->iterations, (unsigned long long)result->probes,
		result->objective_start, result->objective_end, facts.w2 / facts.w1,
		facts.weights_by_noise ? " (by the noise of the offsets)" : "", facts.at_limit_count,
		facts.variable_count, net ? "poles" : "offsets", facts.max_distance_m,
		batten_fairing_run(job->fairing)->seconds, batten_fairing_run(job->fairing)->device);
	print_certificate(batten_fairing_certificate(job->fairing), stream);
}
