/* Lines plans: well-formed, the same each time, with what moved; and without a path or memory. */
#include "unit/picture_fixture.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char **environ;

/* Exit code of a program that is found on the path, silent. */
static int run(char *const arguments[])
{
	posix_spawn_file_actions_t actions;
	assert_int_equal(posix_spawn_file_actions_init(&actions), 0);
	(void)posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
	(void)posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
	pid_t child = 0;
	int started = posix_spawnp(&child, arguments[0], &actions, NULL, arguments, environ);
	(void)posix_spawn_file_actions_destroy(&actions);
	assert_int_equal(started, 0);
	int result = 0;
	assert_int_equal(waitpid(child, &result, 0), child);
	return WIFEXITED(result) ? WEXITSTATUS(result) : 255;
}

/* A clone with one given offset changed. */
static batten_hull *moved(fixture *f, const batten_hull *hull, double x, double z, double y)
{
	batten_hull *clone = NULL;
	assert_int_equal(batten_hull_clone(f->context, hull, &clone), BATTEN_OK);
	size_t station = hull_station_at(hull, x);
	size_t waterline = hull_waterline_at(hull, z);
	assert_true(station != SIZE_MAX && waterline != SIZE_MAX);
	clone->y_m[waterline * hull->station_count + station] = y;
	return clone;
}

/* Well-formed, drawable, the same bytes each time, for every shipped hull. */
static void lines_are_good_svg(void **state)
{
	fixture *f = *state;
	const char *names[] = { "npl_parent", "bsra_trawler", "highspeed_craft", "wigley",
		                    "wigley_noisy" };
	char first[160], second[160], drawn[160];
	path_in(f, "first.svg", first);
	path_in(f, "second.svg", second);
	path_in(f, "drawn.png", drawn);
	char check[] = "xmllint", quiet[] = "--noout", offline[] = "--nonet";
	char *const lint[] = { check, quiet, offline, first, NULL };
	char render[] = "rsvg-convert", width[] = "-w", number[] = "400", to[] = "-o";
	char *const convert[] = { render, width, number, first, to, drawn, NULL };
	for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
		batten_hull *hull = read_shipped(f, names[k]);
		for (int with_before = 0; with_before < 2; with_before++) {
			const batten_hull *before = with_before ? hull : NULL;
			assert_int_equal(batten_picture_lines(f->context, before, hull, first), BATTEN_OK);
			assert_int_equal(batten_picture_lines(f->context, before, hull, second), BATTEN_OK);
			assert_same_file(first, second);
			assert_int_equal(run(lint), 0);
		}
		assert_int_equal(run(convert), 0);
		picture p = decode(drawn);
		picture_rectangle all = { 0, 0, p.width, p.height };
		assert_true(covered(&p, &all) > 0.03);
		free(p.rgb);
		batten_hull_destroy(hull);
	}
}

static size_t count_of(const char *path, const char *what)
{
	size_t length = 0;
	char *text = read_file(path, &length);
	size_t count = 0;
	for (const char *at = text; (at = strstr(at, what)) != NULL; at++)
		count++;
	free(text);
	return count;
}

/* The ring around a point that moved, in body plan, half-breadth plan and legend: the only red. */
static void replaced_points_are_ringed(void **state)
{
	fixture *f = *state;
	const char red[] = "rgb(80%,10%,10%)";
	char path[160];
	path_in(f, "lines.svg", path);
	batten_hull *hull = read_shipped(f, "npl_parent");
	batten_hull *little = moved(f, hull, 2.032, 0.15, 0.118);
	batten_hull *much = moved(f, hull, 2.032, 0.15, 0.109);
	assert_int_equal(batten_picture_lines(f->context, hull, little, path), BATTEN_OK);
	assert_int_equal(count_of(path, red), 0);
	assert_int_equal(batten_picture_lines(f->context, hull, much, path), BATTEN_OK);
	assert_int_equal(count_of(path, red), 3);
	/* Another table: nothing to compare with, yet drawn. */
	batten_hull *wall = make_wall(f, 0.1);
	assert_int_equal(batten_picture_lines(f->context, wall, much, path), BATTEN_OK);
	assert_int_equal(count_of(path, red), 0);
	batten_hull_destroy(wall);
	batten_hull_destroy(hull);
	batten_hull_destroy(little);
	batten_hull_destroy(much);
}

/* A hull without a surface still has lines. */
static void two_lines_are_drawn(void **state)
{
	fixture *f = *state;
	const double x[4] = { 0, 1, 2, 3 }, z[2] = { 0, 1 }, y[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };
	const uint8_t nodes[8] = { 1, 1, 0, 0, 0, 0, 1, 1 };
	batten_hull_table table = { "two lines", 3, 1, 4, 2, x, z, y, nodes };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(f->context, &table, &hull), BATTEN_OK);
	char path[160];
	path_in(f, "lines.svg", path);
	assert_int_equal(batten_picture_lines(f->context, NULL, hull, path), BATTEN_OK);
	assert_int_equal(empty_folder(f), 1);
	batten_hull_destroy(hull);
}

static void bad_paths_leave_nothing(void **state)
{
	fixture *f = *state;
	batten_hull *hull = make_wall(f, 0.1);
	char path[160];
	path_in(f, "absent/picture", path);
	assert_int_equal(batten_picture_lines(f->context, NULL, hull, path), BATTEN_IO);
	assert_non_null(strstr(batten_context_error(f->context), path));
	assert_int_equal(batten_picture_lines(f->context, NULL, hull, f->folder), BATTEN_IO);
	assert_int_equal(empty_folder(f), 0);
	batten_hull_destroy(hull);
}

static batten_status call_lines(fixture *f, const batten_hull *hull, const char *path)
{
	return batten_picture_lines(f->context, hull, hull, path);
}

static void every_allocation_may_fail(void **state)
{
	fixture *f = *state;
	batten_hull *hull = make_wall(f, 0.1);
	char path[160];
	path_in(f, "picture", path);
	fail_every_allocation(f, hull, path, call_lines, 20);
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		PICTURE_TEST(lines_are_good_svg),        PICTURE_TEST(replaced_points_are_ringed),
		PICTURE_TEST(two_lines_are_drawn),       PICTURE_TEST(bad_paths_leave_nothing),
		PICTURE_TEST(every_allocation_may_fail),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
