/* batten bench: the benchmarks of bench/. */
#include "cli.h"

#include "bench.h"
#include "json_out.h"

#include <string.h>

static const cli_command command = {
	.name = "bench",
	.usage = "[NAME ...] [OPTION ...]",
	.summary = "times the engine against a named reference, in one run",
	.example = "  batten bench search.multilevel --json\n",
	.notes =
		"Values and reference values are medians of interleaved pairs, in CPU time on CPUs and wall\n"
		"time on other devices; ratio: how many times faster than the reference, [95 % interval];\n"
		"share of what one core's multiply-adds or its memory give, whichever is larger, measured\n"
		"beside each pair.\n"
		"The results are compared before anything is timed.\n",
};

typedef struct output {
	bool as_json;
	json_t *list;
} output;

static void emit(const bench_row *row, void *user)
{
	output *out = user;
	const char *precision = row->precision == BATTEN_F64 ? "f64" : "f32";
	if (!out->as_json) {
		(void)printf("%-18s %-24s %s  %10.4g %s, %s %10.4g: ratio %.3g [%.3g, %.3g]", row->name,
		             row->case_name, precision, row->value, row->unit, row->reference,
		             row->reference_value, row->ratio, row->ratio_low, row->ratio_high);
		if (row->bound)
			(void)printf(", %.3g %% of %s (%.3g/s)", row->percent_of_peak, row->bound, row->peak);
		(void)printf("  %s\n", row->device);
		(void)fflush(stdout);
		return;
	}
	json_t *object = json_pack(
		"{s:s, s:s, s:s, s:s, s:f, s:s, s:s, s:f, s:f, s:f, s:f, s:o, s:s?, s:o}", "name",
		row->name, "case", row->case_name, "precision", precision, "device", row->device, "value",
		row->value, "unit", row->unit, "reference", row->reference, "reference_value",
		row->reference_value, "ratio", row->ratio, "ratio_low", row->ratio_low, "ratio_high",
		row->ratio_high, "percent_of_peak",
		row->percent_of_peak > 0.0 ? json_real(row->percent_of_peak) : json_null(), "bound",
		row->bound, "peak_per_s", row->peak > 0.0 ? json_real(row->peak) : json_null());
	(void)json_array_append_new(out->list, object);
}

static bool is_wanted(const char *name, const char *const *names, size_t count)
{
	for (size_t n = 0; n < count; n++)
		if (strcmp(name, names[n]) == 0)
			return true;
	return count == 0;
}

static batten_status check_names(const char *const *names, size_t count)
{
	for (size_t n = 0; n < count; n++) {
		bool known = false;
		for (const bench_entry *entry = bench_entries; entry->name; entry++)
			known = known || strcmp(entry->name, names[n]) == 0;
		if (!known)
			return cli_usage("bench",
			                 "found '%s', the name of a benchmark was expected, such as %s",
			                 names[n], bench_entries[0].name);
	}
	return BATTEN_OK;
}

static batten_status run_all(bench_settings *settings, const char *const *names, size_t count)
{
	for (const bench_entry *entry = bench_entries; entry->name; entry++) {
		if (!is_wanted(entry->name, names, count))
			continue;
		const batten_status status = entry->run(settings);
		if (status == BATTEN_INTERNAL)
			(void)fprintf(stderr, "batten bench: %s: the two sides do not agree\n", entry->name);
		else if (status != BATTEN_OK)
			(void)cli_failure("bench", settings->context, status);
		if (status != BATTEN_OK)
			return status;
	}
	return BATTEN_OK;
}

batten_status cli_bench(int argc, char **argv)
{
	enum { NAME_LIMIT = 32 };
	cli_common common = { 0 };
	bench_settings settings = { .device = BATTEN_DEVICE_AUTO, .emit = emit };
	const cli_option options[] = {
		{ "device", CLI_DEVICE, &settings.device, "D", "auto (default) or an index" },
		{ "full", CLI_FLAG, &settings.full, NULL, "all cases of bench/README.md" },
		{ 0 },
	};
	const char *names[NAME_LIMIT];
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&command, argc, argv, options, &common, names, NAME_LIMIT,
	                                 &count, &done);
	if (status == BATTEN_OK && !done)
		status = check_names(names, count);
	if (status == BATTEN_OK && !done)
		status = cli_context_create("bench", &common, &settings.context);
	if (status != BATTEN_OK || done)
		return status;
	output out = { .as_json = common.json, .list = json_array() };
	settings.user = &out;
	status = run_all(&settings, names, count);
	if (status == BATTEN_OK && common.json)
		status = cli_json_print("bench", out.list);
	else
		json_decref(out.list);
	batten_context_destroy(settings.context);
	return status;
}
