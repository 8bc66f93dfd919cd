/* Every environment in which OpenCL is absent or would end the process. Each case runs in a child
 * (this executable with the name of the case as argument), since drivers read their environment once
 * per process. */
#include "unit/device_fixture.h"

#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>

static bool has_none(batten_context *context, const char *expected)
{
	const char *reason = NULL;
	batten_device facts;
	device_session *session = NULL;
	if (batten_device_count(context, &reason) != 0 || !reason || !strstr(reason, expected)) {
		(void)fprintf(stderr, "expected \"%s\", found \"%s\"\n", expected, reason ? reason : "");
		return false;
	}
	return batten_device_describe(context, 0, &facts) == BATTEN_DEVICE &&
	       device_session_open(context, 0, &session) == BATTEN_DEVICE && !session &&
	       strstr(batten_context_error(context), expected);
}

static bool runs_on_all(batten_context *context, size_t expected)
{
	const char *reason = NULL;
	if (batten_device_count(context, &reason) != expected) {
		(void)fprintf(stderr, "expected %zu devices: %s\n", expected, reason);
		return false;
	}
	for (size_t i = 0; i < expected; i++) {
		device_session *session = NULL;
		bool good = device_session_open(context, i, &session) == BATTEN_OK &&
		            runs(session, source, 2.0, NULL);
		device_session_close(session);
		if (!good)
			return false;
	}
	return true;
}

static bool has_prefix(const char *text, const char *prefix)
{
	return text && strncmp(text, prefix, strlen(prefix)) == 0;
}

static int child(const char *name, const char *expected, const char *cache)
{
	batten_context *context = make_context(cache[0] ? cache : NULL, 1);
	bool good = false;
	batten_device facts;
	if (!context)
		return 1;
	if (strcmp(name, "none") == 0)
		good = has_none(context, expected);
	else if (strcmp(name, "two") == 0)
		good = runs_on_all(context, 2);
	else if (strcmp(name, "one") == 0)
		good = runs_on_all(context, 1);
	else if (strcmp(name, "private") == 0) /* what OpenCL compiles goes where it was told to */
		good = runs_on_all(context, 1) && has_prefix(getenv("POCL_CACHE_DIR"), expected);
	else if (strcmp(name, "units") == 0)
		good = batten_device_describe(context, 0, &facts) == BATTEN_OK && facts.compute_units == 1;
	batten_context_destroy(context);
	return good ? 0 : 1;
}

/* Runs child() with the settings "NAME=value" ("NAME" alone removes it) over this environment, which tells it
 * the rest. */
static int spawn_child(const char *name, const char *expected, const char *cache,
                       const char *const *settings, size_t setting_count)
{
	assert_int_equal(setenv("CHILD", name, 1), 0);
	assert_int_equal(setenv("CHILD_EXPECTED", expected, 1), 0);
	assert_int_equal(setenv("CHILD_CACHE", cache, 1), 0);
	size_t count = 0;
	while (environ[count])
		count++;
	char **variables = calloc(count + setting_count + 1, sizeof *variables);
	assert_non_null(variables);
	size_t used = 0;
	for (size_t i = 0; i < count; i++) {
		bool replaced = false;
		for (size_t j = 0; j < setting_count; j++) {
			size_t length = strcspn(settings[j], "=");
			replaced = replaced ||
			           (strncmp(environ[i], settings[j], length) == 0 && environ[i][length] == '=');
		}
		if (!replaced)
			variables[used++] = environ[i];
	}
	for (size_t j = 0; j < setting_count; j++)
		if (strchr(settings[j], '='))
			variables[used++] = strdup(settings[j]);
	/* A program of all tests is told which one. */
	char program[] = "test_device", test[] = "device_environment";
	char *arguments[] = { program, test, NULL };
	pid_t process = 0;
	int status = -1;
	assert_int_equal(posix_spawn(&process, "/proc/self/exe", NULL, NULL, arguments, variables), 0);
	assert_int_equal(waitpid(process, &status, 0), process);
	for (size_t j = 0; j < setting_count; j++)
		if (strchr(settings[j], '='))
			free(variables[--used]);
	free(variables);
	return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

static void make_file(const char *path, const char *text)
{
	FILE *stream = fopen(path, "w");
	assert_non_null(stream);
	assert_true(fputs(text, stream) >= 0);
	assert_int_equal(fclose(stream), 0);
}

static void test_without_library(void **state)
{
	place *here = *state;
	const char *missing[] = { "BATTEN_OPENCL_LIBRARY=/nonexistent/libOpenCL.so.1" };
	assert_int_equal(spawn_child("none", "/nonexistent/libOpenCL.so.1", here->cache, missing, 1),
	                 0);
	const char *other[] = { "BATTEN_OPENCL_LIBRARY=libm.so.6" };
	assert_int_equal(spawn_child("none", "clGetPlatformIDs", here->cache, other, 1), 0);
	char *path = text_of("%s/text", here->folder);
	make_file(path, "no library\n");
	char *setting = text_of("BATTEN_OPENCL_LIBRARY=%s", path);
	const char *text[] = { setting };
	assert_int_equal(spawn_child("none", path, here->cache, text, 1), 0);
	free(setting);
	free(path);
}

static void test_without_driver(void **state)
{
	place *here = *state;
	const char *none[] = { "OCL_ICD_VENDORS=/nonexistent" };
	assert_int_equal(spawn_child("none", "clGetPlatformIDs: CL_PLATFORM_NOT_FOUND_KHR (-1001)",
	                             here->cache, none, 1),
	                 0);
	const char *empty[] = { "POCL_DEVICES=nonesuch" };
	assert_int_equal(
		spawn_child("none", "clGetDeviceIDs: CL_DEVICE_NOT_FOUND (-1)", here->cache, empty, 1), 0);
	const char *unlinked[] = { "PATH=/nonexistent" };
	assert_int_equal(spawn_child("none", "the linker ld", here->cache, unlinked, 1), 0);
	const char *unset[] = { "PATH" };
	assert_int_equal(spawn_child("none", "the linker ld", here->cache, unset, 1), 0);
}

/* A folder below a plain file cannot be made by anyone, root included. */
static void test_without_writable_home(void **state)
{
	place *here = *state;
	char *file = text_of("%s/file", here->folder);
	char *spare = text_of("%s/spare", here->folder);
	char *home = text_of("HOME=%s/home", file);
	char *pocl = text_of("POCL_CACHE_DIR=%s/pocl", file);
	char *temporary = text_of("TMPDIR=%s", spare);
	make_file(file, "");
	assert_int_equal(mkdir(spare, 0700), 0);
	const char *settings[] = { home, pocl, temporary, "XDG_CACHE_HOME" };
	assert_int_equal(spawn_child("private", spare, "", settings, 4), 0);
	assert_int_equal(count_entries(spare), 0);
	const char *homeless[] = { "HOME", "POCL_CACHE_DIR", temporary, "XDG_CACHE_HOME=relative" };
	assert_int_equal(spawn_child("private", spare, "", homeless, 4), 0);
	assert_int_equal(count_entries(spare), 0);
	/* A cache folder given by the caller that is none either. */
	assert_int_equal(spawn_child("private", spare, file, settings, 4), 0);
	assert_int_equal(count_entries(spare), 0);
	free(temporary);
	free(pocl);
	free(home);
	free(spare);
	free(file);
}

static void test_pocl_folder_of_user(void **state)
{
	place *here = *state;
	char *user = text_of("%s/user", here->folder);
	char *home = text_of("HOME=%s", user);
	char *expected = text_of("%s/.cache/pocl/", user);
	const char *settings[] = { home, "POCL_CACHE_DIR", "XDG_CACHE_HOME" };
	assert_int_equal(spawn_child("private", expected, "", settings, 3), 0);
	char *programs = text_of("%s/.cache/batten", user);
	assert_int_equal(count_entries(programs), 0); /* PoCL keeps its programs itself */
	/* PoCL aborts on a long path. */
	char deep[1000];
	memset(deep, 'd', sizeof deep);
	for (size_t i = 99; i < sizeof deep; i += 100)
		deep[i] = '/';
	deep[sizeof deep - 1] = '\0';
	char *lengthy = text_of("POCL_CACHE_DIR=%s/%s", here->folder, deep);
	const char *second[] = { home, lengthy, "XDG_CACHE_HOME" };
	assert_int_equal(spawn_child("private", expected, "", second, 3), 0);
	/* What the user set and works stays. */
	char *own = text_of("%s/own", here->folder);
	char *chosen = text_of("POCL_CACHE_DIR=%s", own);
	const char *third[] = { home, chosen, "XDG_CACHE_HOME" };
	assert_int_equal(spawn_child("private", own, "", third, 3), 0);
	free(chosen);
	free(own);
	free(lengthy);
	free(programs);
	free(expected);
	free(home);
	free(user);
}

static void test_devices_and_threads(void **state)
{
	place *here = *state;
	const char *two[] = { "POCL_DEVICES=pthread pthread" };
	assert_int_equal(spawn_child("two", "", here->cache, two, 1), 0);
	const char *unset[] = { "POCL_MAX_PTHREAD_COUNT" };
	assert_int_equal(spawn_child("units", "", here->cache, unset, 1), 0);
	const char *given[] = { "POCL_MAX_PTHREAD_COUNT=2" };
	assert_int_equal(spawn_child("units", "", here->cache, given, 1), 1);
	assert_int_equal(spawn_child("one", "", here->cache, given, 1), 0);
}

int main(void)
{
	if (getenv("CHILD"))
		return child(getenv("CHILD"), getenv("CHILD_EXPECTED"), getenv("CHILD_CACHE"));
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_without_library),       cmocka_unit_test(test_without_driver),
		cmocka_unit_test(test_without_writable_home), cmocka_unit_test(test_pocl_folder_of_user),
		cmocka_unit_test(test_devices_and_threads),
	};
	return cmocka_run_group_tests(tests, make_place, remove_place);
}
