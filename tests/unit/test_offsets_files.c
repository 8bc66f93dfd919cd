/* The offsets file: paths that cannot be used, a full disk, failing allocations. */
#include "offsets_fixture.h"
#include "support/failing_heap.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

static void fail_read(const struct fixture *fixture, const char *path, batten_status expected)
{
	batten_hull *hull = (batten_hull *)fixture->folder;
	assert_int_equal(batten_hull_read(fixture->context, path, &hull), expected);
	assert_null(hull);
	assert_non_null(strstr(batten_context_error(fixture->context), path));
}

static void fail_write(const struct fixture *fixture, const batten_hull *hull, const char *path)
{
	assert_int_equal(batten_hull_write(fixture->context, hull, path), BATTEN_IO);
	assert_non_null(strstr(batten_context_error(fixture->context), path));
}

static void unusable_paths(void **state)
{
	const struct fixture *fixture = *state;
	char path[256];
	fail_read(fixture, path_in(fixture, "absent.csv", path), BATTEN_IO);
	fail_read(fixture, fixture->folder, BATTEN_IO);
	FILE *empty = fopen(path_in(fixture, "empty.csv", path), "wb");
	assert_non_null(empty);
	(void)fclose(empty);
	fail_read(fixture, path, BATTEN_INPUT);
	fail_read(fixture, path_in(fixture, "empty.csv/below.csv", path), BATTEN_IO);
	batten_hull *hull = read_hull(fixture, BATTEN_DATA_DIR "/hulls/wigley.csv");
	fail_write(fixture, hull, path_in(fixture, "absent/hull.csv", path));
	fail_write(fixture, hull, path_in(fixture, "empty.csv/below.csv", path));
	fail_write(fixture, hull, fixture->folder);
	assert_int_equal(count_files(fixture), 1);
	batten_hull_destroy(hull);
}

/* The disk is full after 4096 bytes: the old file stays, nothing else is left. */
static void full_disk(void **state)
{
	const struct fixture *fixture = *state;
	char path[256];
	batten_hull *wigley = read_hull(fixture, BATTEN_DATA_DIR "/hulls/wigley_noisy.csv");
	batten_hull *trawler = read_hull(fixture, BATTEN_DATA_DIR "/hulls/bsra_trawler.csv");
	write_hull(fixture, trawler, path_in(fixture, "hull.csv", path));
	size_t length = 0;
	char *before = read_text(path, &length);
	struct rlimit limit;
	assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
	const struct rlimit small = { 4096, limit.rlim_max };
	void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
	assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
	batten_status status = batten_hull_write(fixture->context, wigley, path);
	assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
	(void)signal(SIGXFSZ, handler);
	assert_int_equal(status, BATTEN_IO);
	assert_non_null(strstr(batten_context_error(fixture->context), path));
	char *after = read_text(path, &length);
	assert_string_equal(before, after);
	assert_int_equal(count_files(fixture), 1);
	free(before);
	free(after);
	batten_hull_destroy(wigley);
	batten_hull_destroy(trawler);
}

/* A hull by its sections, in feet, x forward of amidships counted aft: every kind of row there is. */
static const char sections[] =
	"# batten-offsets: 1\n# name: n\n# unit: ft\n# frame: ghs\n# lbp: 10\n# draft: 1.5\n"
	"# depth: 2.5\n# layout: long\n# source: a test\nstation,x,z,y\n"
	"a,-5,0,0\na,-5,0.7,1.5\na,-5,2.1,3\nb,0,0,0\nb,0,0.7,?\nb,0,2.1,2\n"
	"c,5,0,0\nc,5,0.825,0.5\nc,5,2.1,1\n"
	"profile,stem,-5,0.1,0.7\nprofile,deck,0,2,2.1\nknuckle,station,0,0.7\n";

struct copy {
	const char *from;
	char to[256];
};

static batten_status read_and_write(batten_context *context, void *user)
{
	const struct copy *copy = user;
	batten_hull *hull = NULL;
	batten_status status = batten_hull_read(context, copy->from, &hull);
	if (status == BATTEN_OK)
		status = batten_hull_write(context, hull, copy->to);
	else
		assert_null(hull);
	batten_hull_destroy(hull);
	return status;
}

static void fail_each(const struct fixture *fixture, const char *from)
{
	struct copy copy = { .from = from };
	path_in(fixture, "written.csv", copy.to);
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	assert_true(failing_heap_each(&heap, context, read_and_write, &copy) > 15);
	failing_heap_close(&heap, context);
}

static void failing_allocations(void **state)
{
	const struct fixture *fixture = *state;
	char path[256];
	fail_each(fixture, BATTEN_DATA_DIR "/hulls/npl_parent.csv");
	fail_each(fixture, BATTEN_DATA_DIR "/hulls/bsra_trawler.csv");
	fail_each(fixture, BATTEN_DATA_DIR "/hulls/highspeed_craft.csv");
	batten_hull *hull = parse(fixture, sections, sizeof sections - 1);
	write_hull(fixture, hull, path_in(fixture, "long.csv", path));
	batten_hull_destroy(hull);
	fail_each(fixture, path);
	/* Refusals leave nothing behind either: the memory limit is one of them. */
	batten_context_options options;
	batten_context_options_default(&options);
	options.max_memory = 4096;
	batten_context *small = NULL;
	assert_int_equal(batten_context_create(&options, &small), BATTEN_OK);
	assert_int_equal(batten_hull_read(small, path, &hull), BATTEN_MEMORY);
	assert_null(hull);
	batten_context_destroy(small);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(unusable_paths, begin, end),
		cmocka_unit_test_setup_teardown(full_disk, begin, end),
		cmocka_unit_test_setup_teardown(failing_allocations, begin, end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
