/* batten measure: every measure of a hull. */
#include "cli.h"

#include "json_out.h"

#include <math.h>
#include <string.h>

static const cli_command command = {
	.name = "measure",
	.usage = "HULL.csv [OPTION ...]",
	.summary = "fairness numbers, energies, form coefficients and hydrostatics of a hull",
	.example = "  batten measure data/hulls/wigley.csv --json\n",
	.notes =
		"Units and signs stand in the names; frame: origin at the aft perpendicular on the baseline,\n"
		"x forward, z up. L of the coefficients is lbp_m, B is beam_wl_m. '-' (null in JSON): not\n"
		"defined for this hull.\n",
};

static const char *const quadratures[] = { "spline", "simpson", "trapezoid" };

static void print_table(const batten_hull *hull, const batten_measures *measures,
                        const char *quadrature)
{
	const double *values = (const double *)measures;
	(void)printf("%s: %zu stations, %zu waterlines; metres, frame ap-fwd; quadrature: %s\n\n",
	             batten_hull_name(hull), batten_hull_station_count(hull),
	             batten_hull_waterline_count(hull), quadrature);
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++) {
		(void)printf("%-22s ", batten_measure_name(i));
		if (values[i] == values[i])
			(void)printf("%16.8g", values[i]);
		else
			(void)printf("%16s", "-");
		(void)printf("  %s\n", batten_measure_text(i));
	}
}

static batten_status print_json(const batten_hull *hull, const batten_measures *measures,
                                const char *quadrature)
{
	json_t *object = json_pack("{s:s, s:s, s:s}", "name", batten_hull_name(hull), "frame", "ap-fwd",
	                           "quadrature", quadrature);
	if (object)
		cli_json_measures(object, measures);
	return cli_json_print("measure", object);
}

static batten_status measure(batten_context *context, const char *path,
                             const batten_measure_options *options, bool as_json)
{
	batten_hull *hull = NULL;
	batten_measures measures;
	batten_status status = batten_hull_read(context, path, &hull);
	if (status == BATTEN_OK)
		status = batten_hull_measure(context, hull, options, &measures);
	if (status != BATTEN_OK)
		status = cli_failure("measure", context, status);
	else if (as_json)
		status = print_json(hull, &measures, quadratures[options->quadrature]);
	else
		print_table(hull, &measures, quadratures[options->quadrature]);
	batten_hull_destroy(hull);
	return status;
}

static batten_status read_quadrature(const char *text, batten_quadrature *out)
{
	for (size_t q = 0; q < sizeof quadratures / sizeof quadratures[0]; q++)
		if (strcmp(text, quadratures[q]) == 0) {
			*out = (batten_quadrature)q;
			return BATTEN_OK;
		}
	return cli_usage("measure", "--quadrature: found '%s', expected spline, simpson or trapezoid",
	                 text);
}

batten_status cli_measure(int argc, char **argv)
{
	cli_common common = { 0 };
	batten_measure_options chosen;
	batten_measure_options_default(&chosen);
	const char *quadrature = "spline";
	double draft = NAN;
	const cli_option options[] = {
		{ "draft", CLI_NUMBER, &draft, "T", "draft in metres (default: the file's)" },
		{ "quadrature", CLI_TEXT, &quadrature, "RULE", "spline (default), simpson or trapezoid" },
		{ "density", CLI_NUMBER, &chosen.density_t_per_m3, "RHO", "of the water in t/m3 (1.025)" },
		{ 0 },
	};
	const char *path = NULL;
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&command, argc, argv, options, &common, &path, 1, &count,
	                                 &done);
	if (status != BATTEN_OK || done)
		return status;
	if (count != 1)
		return cli_usage("measure", "an offsets file was expected");
	if (draft <= 0.0)
		return cli_usage("measure", "--draft: found %g, expected a draft above 0", draft);
	chosen.draft_m = isnan(draft) ? 0.0 : draft;
	status = read_quadrature(quadrature, &chosen.quadrature);
	batten_context *context = NULL;
	if (status == BATTEN_OK)
		status = cli_context_create("measure", &common, &context);
	if (status != BATTEN_OK)
		return status;
	status = measure(context, path, &chosen, common.json);
	batten_context_destroy(context);
	return status;
}
