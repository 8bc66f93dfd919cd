/* batten report: the result of a sweep as one page. */
#include "cli.h"

#include "json_out.h"

#include <string.h>

static const cli_command command = {
	.name = "report",
	.usage = "RESULTS.db --out FILE.html [OPTION ...]",
	.summary = "writes one page that shows the result of a sweep in a browser, without a network",
	.example = "  batten report results.db --out report.html\n",
	.notes =
		"The page has parallel coordinates with brushing, a scatter of any two columns, the Pareto\n"
		"front, a table, and for every hull whose geometry is in it the form in 3-D with its\n"
		"curvature, its lines plan and its curves. The geometry of the plan's best hulls goes in\n"
		"(1000 unless the plan or --hulls says otherwise), the numbers of all designs; of more\n"
		"than 200000 the front, these hulls and every n-th of the rest.\n",
};

struct request {
	cli_common common;
	const char *database, *out;
	unsigned hulls;
};

static batten_status say(const struct request *request, const batten_report_facts *facts)
{
	if (request->common.json)
		return cli_json_print(
			"report",
			json_pack("{s:s, s:s, s:I, s:I, s:I, s:I, s:I}", "database", request->database, "out",
		              request->out, "designs", (json_int_t)facts->design_count, "shown",
		              (json_int_t)facts->shown_count, "front", (json_int_t)facts->front_count,
		              "hulls", (json_int_t)facts->hull_count, "bytes", (json_int_t)facts->bytes));
	if (request->common.quiet)
		return BATTEN_OK;
	if (facts->shown_count < facts->design_count)
		(void)fprintf(stderr, "batten report: warning: %zu of %zu designs are shown\n",
		              facts->shown_count, facts->design_count);
	(void)fprintf(
		stderr,
		"batten report: %zu designs, %zu on the front, %zu hulls to look at: %s (%.1f MB)\n",
		facts->design_count, facts->front_count, facts->hull_count, request->out,
		(double)facts->bytes / 1e6);
	return BATTEN_OK;
}

static batten_status report(const struct request *request)
{
	batten_context *context = NULL;
	batten_status status = cli_context_create("report", &request->common, &context);
	if (status != BATTEN_OK)
		return status;
	batten_report_options options;
	batten_report_facts facts;
	batten_report_options_default(&options);
	options.hull_count = request->hulls;
	status = batten_report_write(context, request->database, &options, request->out, &facts);
	if (status == BATTEN_OK)
		status = say(request, &facts);
	else
		status = cli_failure("report", context, status);
	batten_context_destroy(context);
	return status;
}

batten_status cli_report(int argc, char **argv)
{
	struct request request = { 0 };
	const cli_option options[] = {
		{ "out", CLI_TEXT, &request.out, "FILE.html", "where the page goes" },
		{ "hulls", CLI_COUNT, &request.hulls, "N",
		  "hulls whose geometry goes into the page; 0: what the plan keeps, at most 1000" },
		{ 0 },
	};
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&command, argc, argv, options, &request.common,
	                                 &request.database, 1, &count, &done);
	if (status != BATTEN_OK || done)
		return status;
	if (count != 1)
		return cli_usage("report", "one database was expected, as batten sweep writes it");
	if (!request.out)
		return cli_usage("report", "--out FILE.html was expected");
	if (strcmp(request.out, request.database) == 0)
		return cli_usage("report", "--out %s would replace the database", request.out);
	return report(&request);
}
