/* batten devices, batten selftest: what this machine can compute on. */
#include "cli.h"

#include "json_out.h"

#include <string.h>

static const cli_command devices_command = {
	.name = "devices",
	.usage = "[OPTION ...]",
	.summary = "lists the OpenCL devices of this machine; the index is what --device takes",
	.example = "  batten devices\n",
	.notes = "The plain C path ('--device reference') is always there.\n",
};

static const cli_command selftest_command = {
	.name = "selftest",
	.usage = "[--device INDEX] [--kernel NAME] [OPTION ...]",
	.summary = "runs every kernel on a small known problem against the plain C path, bit for bit",
	.example = "  batten selftest\n"
			   "  batten selftest --kernel block_search\n",
	.notes =
		"equal: the same bits as the C path; different: other last bits, used only when asked for by\n"
		"its index; failed: not used; absent: the device has no such precision.\n",
};

static json_t *device_json(size_t index, const batten_device *device)
{
	return json_pack("{s:I, s:s, s:s, s:s, s:s, s:s, s:b, s:b, s:I, s:I, s:I, s:I, s:I}", "index",
	                 (json_int_t)index, "name", device->name, "platform", device->platform,
	                 "driver", device->driver, "version", device->version, "type",
	                 device->is_cpu ? "cpu" : "gpu", "f64", device->has_f64,
	                 "f32_correctly_rounded", device->has_correct_f32, "compute_units",
	                 (json_int_t)device->compute_units, "global_memory_bytes",
	                 (json_int_t)device->global_memory_bytes, "local_memory_bytes",
	                 (json_int_t)device->local_memory_bytes, "max_allocation_bytes",
	                 (json_int_t)device->max_allocation_bytes, "max_work_group",
	                 (json_int_t)device->max_work_group);
}

static void print_device(size_t index, const batten_device *device)
{
	if (index == 0)
		(void)printf("%-5s %-4s %-5s %6s %9s  %s\n", "index", "type", "f64", "units", "memory",
		             "name");
	(void)printf("%-5zu %-4s %-5s %6u %5.1f GiB  %s (%s)\n", index, device->is_cpu ? "cpu" : "gpu",
	             device->has_f64 ? "yes" : "no", device->compute_units,
	             (double)device->global_memory_bytes / 1073741824.0, device->name,
	             device->platform);
}

static batten_status list_devices(batten_context *context, const cli_common *common)
{
	const char *reason = NULL;
	const size_t count = batten_device_count(context, &reason);
	json_t *list = json_array();
	for (size_t i = 0; i < count; i++) {
		batten_device device;
		const batten_status status = batten_device_describe(context, i, &device);
		if (status != BATTEN_OK) {
			json_decref(list);
			return cli_failure("devices", context, status);
		}
		if (common->json)
			(void)json_array_append_new(list, device_json(i, &device));
		else
			print_device(i, &device);
	}
	if (count == 0 && !common->quiet)
		(void)fprintf(stderr, "warning: no OpenCL device: %s; the plain C path is used\n",
		              reason ? reason : "none found");
	if (!common->json) {
		json_decref(list);
		(void)printf("plain C path: --device reference\n");
		return BATTEN_OK;
	}
	json_t *all = json_object();
	(void)json_object_set_new(all, "devices", list);
	(void)json_object_set_new(all, "reason",
	                          count == 0 && reason ? json_string(reason) : json_null());
	return cli_json_print("devices", all);
}

batten_status cli_devices(int argc, char **argv)
{
	cli_common common = { 0 };
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&devices_command, argc, argv, NULL, &common, NULL, 0, &count,
	                                 &done);
	if (status != BATTEN_OK || done)
		return status;
	batten_context *context = NULL;
	status = cli_context_create("devices", &common, &context);
	if (status != BATTEN_OK)
		return status;
	status = list_devices(context, &common);
	batten_context_destroy(context);
	return status;
}

static const char *result_text(batten_selftest_result result)
{
	static const char *const texts[] = { "equal", "different", "failed", "absent" };
	return texts[result];
}

static void report_test(size_t index, const batten_selftest *test, bool as_json, json_t *list)
{
	const char *precision = test->precision == BATTEN_F64 ? "f64" : "f32";
	if (as_json)
		(void)json_array_append_new(
			list,
			json_pack("{s:I, s:s, s:s, s:s, s:I, s:I, s:f, s:f, s:s}", "device", (json_int_t)index,
		              "kernel", test->kernel, "precision", precision, "result",
		              result_text(test->result), "compared", (json_int_t)test->compared,
		              "different", (json_int_t)test->different, "build_s", test->build_s, "run_s",
		              test->run_s, "message", test->message));
	else if (test->message[0] != '\0')
		(void)printf("device %zu  %-20s %s  %-9s  %s\n", index, test->kernel, precision,
		             result_text(test->result), test->message);
	else
		(void)printf("device %zu  %-20s %s  %-9s  %zu of %zu numbers differ\n", index, test->kernel,
		             precision, result_text(test->result), test->different, test->compared);
}

static batten_status test_kernel(batten_context *context, size_t index, const char *kernel,
                                 bool as_json, json_t *list)
{
	enum { TESTS_MOST = 2 };
	batten_selftest tests[TESTS_MOST];
	size_t count = 0;
	const batten_status status = batten_device_selftest(context, index, kernel, tests, TESTS_MOST,
	                                                    &count);
	if (status != BATTEN_OK)
		return cli_failure("selftest", context, status);
	batten_status worst = BATTEN_OK;
	for (size_t t = 0; t < count && t < TESTS_MOST; t++) {
		report_test(index, &tests[t], as_json, list);
		if (tests[t].result == BATTEN_SELFTEST_FAILED)
			worst = BATTEN_KERNEL;
	}
	return worst;
}

/* A kernel, or every one: told one by one, since some take seconds to compile. */
static batten_status test_device(batten_context *context, size_t index, const char *kernel,
                                 bool as_json, json_t *list)
{
	if (kernel)
		return test_kernel(context, index, kernel, as_json, list);
	batten_status worst = BATTEN_OK;
	for (size_t k = 0; batten_device_kernel_name(k); k++) {
		const batten_status status = test_kernel(context, index, batten_device_kernel_name(k),
		                                         as_json, list);
		if (status != BATTEN_OK && status != BATTEN_KERNEL)
			return status;
		worst = status != BATTEN_OK ? status : worst;
		(void)fflush(stdout);
	}
	return worst;
}

static batten_status test_devices(batten_context *context, int device, const char *kernel,
                                  const cli_common *common)
{
	const char *reason = NULL;
	const size_t count = batten_device_count(context, &reason);
	const size_t first = device >= 0 ? (size_t)device : 0;
	const size_t end = device >= 0 ? first + 1 : count;
	json_t *list = json_array();
	batten_status worst = BATTEN_OK;
	for (size_t i = first; i < end; i++) {
		const batten_status status = test_device(context, i, kernel, common->json, list);
		worst = status != BATTEN_OK ? status : worst;
	}
	if (first == end && !common->quiet)
		(void)fprintf(stderr, "warning: no OpenCL device: %s; the plain C path is used\n",
		              reason ? reason : "none found");
	if (!common->json) {
		json_decref(list);
		return worst;
	}
	json_t *all = json_object();
	(void)json_object_set_new(all, "tests", list);
	const batten_status printed = cli_json_print("selftest", all);
	return worst != BATTEN_OK ? worst : printed;
}

/* One line that names them all, where it is none. */
static batten_status check_kernel(const char *kernel)
{
	char names[512] = "";
	for (size_t k = 0; batten_device_kernel_name(k); k++) {
		const char *name = batten_device_kernel_name(k);
		const size_t length = strlen(names);
		if (strcmp(kernel, name) == 0)
			return BATTEN_OK;
		(void)snprintf(names + length, sizeof names - length, "%s%s", k > 0 ? ", " : "", name);
	}
	return cli_usage("selftest", "--kernel: '%s'; expected one of: %s", kernel, names);
}

batten_status cli_selftest(int argc, char **argv)
{
	cli_common common = { 0 };
	int device = BATTEN_DEVICE_AUTO;
	const char *kernel = NULL;
	const cli_option options[] = {
		{ "device", CLI_DEVICE, &device, "INDEX", "one device only (default: all)" },
		{ "kernel", CLI_TEXT, &kernel, "NAME", "one kernel only (default: all)" },
		{ 0 },
	};
	size_t count = 0;
	bool done = false;
	batten_status status = cli_parse(&selftest_command, argc, argv, options, &common, NULL, 0,
	                                 &count, &done);
	if (status != BATTEN_OK || done)
		return status;
	if (device == BATTEN_DEVICE_REFERENCE)
		return cli_usage("selftest", "--device reference is what the others are compared with");
	if (kernel && (status = check_kernel(kernel)) != BATTEN_OK)
		return status;
	batten_context *context = NULL;
	status = cli_context_create("selftest", &common, &context);
	if (status != BATTEN_OK)
		return status;
	status = test_devices(context, device, kernel, &common);
	batten_context_destroy(context);
	return status;
}
