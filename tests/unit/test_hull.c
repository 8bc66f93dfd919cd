/* Hulls from arrays, their lines, gaps, ends, profile points, knuckles and filled '?' nodes. */
#include "hull/hull.h"
#include "support/failing_heap.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STATIONS = 5, WATERLINES = 3, NODES = STATIONS * WATERLINES };
static const double stations[STATIONS] = { 0, 1, 2, 4, 5 };
static const double waterlines[WATERLINES] = { 0, 0.5, 1 };
static const double offsets[NODES] = {
	0, 0, 0, 0, 0, 0, 0.25, 0.5, 0.25, 0, 0.125, 0.5, 0.75, 0.5, 0.125,
};

static int make_context(void **state)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	*state = context;
	return 0;
}

static int end_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

static batten_hull_table table(void)
{
	return (batten_hull_table){ .name = "a hull",
		                        .lbp_m = 5,
		                        .draft_m = 1,
		                        .station_count = STATIONS,
		                        .waterline_count = WATERLINES,
		                        .x_m = stations,
		                        .z_m = waterlines,
		                        .y_m = offsets };
}

static batten_hull *make(batten_context *context, const batten_hull_table *from)
{
	batten_hull *hull = NULL;
	if (batten_hull_create(context, from, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static batten_hull *parse(batten_context *context, const char *rows)
{
	char text[2048];
	(void)snprintf(text, sizeof text,
	               "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ap-fwd\n# lbp: 5\n"
	               "# draft: 1\n%s",
	               rows);
	batten_hull *hull = NULL;
	if (batten_hull_parse(context, "hull", text, strlen(text), &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static void views(void **state)
{
	const batten_hull_table from = table();
	batten_hull *hull = make(*state, &from);
	assert_string_equal(batten_hull_name(hull), "a hull");
	assert_string_equal(batten_hull_source(hull), "");
	assert_string_equal(batten_hull_unit(hull), "m");
	assert_string_equal(batten_hull_frame(hull), "ap-fwd");
	assert_string_equal(batten_hull_layout(hull), "grid");
	assert_true(batten_hull_lbp_m(hull) == 5 && batten_hull_draft_m(hull) == 1);
	assert_int_equal(batten_hull_station_count(hull), STATIONS);
	assert_int_equal(batten_hull_waterline_count(hull), WATERLINES);
	assert_memory_equal(batten_hull_x_m(hull), stations, sizeof stations);
	assert_memory_equal(batten_hull_z_m(hull), waterlines, sizeof waterlines);
	assert_memory_equal(batten_hull_y_m(hull), offsets, sizeof offsets);
	for (size_t i = 0; i < NODES; i++)
		assert_int_equal(batten_hull_nodes(hull)[i], BATTEN_NODE_GIVEN);
	assert_true(batten_hull_half_beam_m(hull) == 0.75);
	batten_hull_destroy(hull);
	batten_hull_destroy(NULL);
}

static void refuse(batten_context *context, const batten_hull_table *from, const char *reason)
{
	batten_hull *hull = (batten_hull *)&stations;
	assert_int_equal(batten_hull_create(context, from, &hull), BATTEN_USAGE);
	assert_null(hull);
	if (!strstr(batten_context_error(context), reason))
		fail_msg("'%s' does not say '%s'", batten_context_error(context), reason);
}

static void wrong_arrays(void **state)
{
	batten_hull_table from = table();
	from.station_count = 1;
	refuse(*state, &from, "1 stations");
	from = table();
	from.waterline_count = 4097;
	refuse(*state, &from, "4097 waterlines");
	from = table();
	from.x_m = (double[STATIONS]){ 0, 1, 1, 4, 5 };
	refuse(*state, &from, "stations: number 3");
	from.x_m = (double[STATIONS]){ 0, 1, 2, 4, INFINITY };
	refuse(*state, &from, "stations: number 5");
	from = table();
	from.z_m = (double[WATERLINES]){ 0, NAN, 1 };
	refuse(*state, &from, "waterlines: number 2");
	from = table();
	from.lbp_m = 0;
	refuse(*state, &from, "lbp");
	from = table();
	from.draft_m = NAN;
	refuse(*state, &from, "draft");
	from = table();
	from.name = "two\nlines";
	refuse(*state, &from, "0x0a");
	from = table();
	double y[NODES];
	memcpy(y, offsets, sizeof y);
	from.y_m = y;
	y[7] = -1e-300;
	refuse(*state, &from, "node 7");
	y[7] = NAN;
	refuse(*state, &from, "node 7");
	/* A value that is not given is not read. */
	uint8_t nodes[NODES];
	memset(nodes, BATTEN_NODE_GIVEN, sizeof nodes);
	nodes[7] = BATTEN_NODE_OUTSIDE;
	from.nodes = nodes;
	batten_hull *hull = make(*state, &from);
	assert_true(batten_hull_y_m(hull)[7] == 0);
	batten_hull_destroy(hull);
	nodes[7] = 3;
	refuse(*state, &from, "of no known kind");
	memset(nodes, BATTEN_NODE_UNKNOWN, sizeof nodes);
	refuse(*state, &from, "found '?'");
}

static void new_half_breadths(void **state)
{
	batten_hull_table from = table();
	uint8_t nodes[NODES];
	memset(nodes, BATTEN_NODE_GIVEN, sizeof nodes);
	nodes[0] = BATTEN_NODE_OUTSIDE;
	nodes[6] = BATTEN_NODE_UNKNOWN;
	from.nodes = nodes;
	batten_hull *hull = make(*state, &from);
	double y[NODES];
	for (size_t i = 0; i < NODES; i++)
		y[i] = (double)i;
	y[0] = NAN;
	assert_int_equal(batten_hull_set_y(*state, hull, y), BATTEN_OK);
	assert_true(batten_hull_y_m(hull)[0] == 0);
	assert_true(batten_hull_y_m(hull)[6] == 6);
	assert_true(batten_hull_half_beam_m(hull) == 14);
	y[3] = -1;
	y[4] = 99;
	assert_int_equal(batten_hull_set_y(*state, hull, y), BATTEN_USAGE);
	assert_true(batten_hull_y_m(hull)[4] == 4);
	batten_hull_destroy(hull);
}

static void assert_same_hull(const batten_hull *a, const batten_hull *b)
{
	size_t nodes = hull_node_count(a);
	assert_string_equal(a->name, b->name);
	assert_string_equal(a->source, b->source);
	assert_true(a->unit == b->unit && a->frame == b->frame && a->layout == b->layout);
	assert_true(a->lbp_m == b->lbp_m && a->draft_m == b->draft_m);
	assert_true(isnan(a->depth_m) ? isnan(b->depth_m) : a->depth_m == b->depth_m);
	assert_int_equal(a->station_count, b->station_count);
	assert_int_equal(a->waterline_count, b->waterline_count);
	assert_memory_equal(a->x_m, b->x_m, a->station_count * sizeof *a->x_m);
	assert_memory_equal(a->z_m, b->z_m, a->waterline_count * sizeof *a->z_m);
	assert_memory_equal(a->y_m, b->y_m, nodes * sizeof *a->y_m);
	assert_memory_equal(a->nodes, b->nodes, nodes);
	assert_int_equal(a->end_count, b->end_count);
	assert_int_equal(a->profile_count, b->profile_count);
	assert_int_equal(a->knuckle_count, b->knuckle_count);
	for (size_t i = 0; i < a->end_count; i++)
		assert_true(a->ends[i].along_m == b->ends[i].along_m && a->ends[i].y_m == b->ends[i].y_m &&
		            a->ends[i].line == b->ends[i].line &&
		            a->ends[i].on_waterline == b->ends[i].on_waterline);
	for (size_t i = 0; i < a->knuckle_count; i++)
		assert_true(a->knuckles[i].x_m == b->knuckles[i].x_m &&
		            a->knuckles[i].z_m == b->knuckles[i].z_m);
	for (size_t i = 0; i < a->profile_count; i++)
		assert_true(
			a->profile[i].x_m == b->profile[i].x_m && a->profile[i].y_m == b->profile[i].y_m &&
			a->profile[i].z_m == b->profile[i].z_m && a->profile[i].kind == b->profile[i].kind);
}

static const char raked[] =
	"# depth: 2\n# layout: long\nwaterline,z,x,y\n"
	"keel,0,0.5,0\nkeel,0,1,0.25\nkeel,0,2,0.5\nkeel,0,3,0.25\nkeel,0,3.75,0\n"
	"load,1,0.25,0\nload,1,1,0.75\nload,1,3,1\nload,1,4.5,1.5\n"
	"deck,2,1,1\ndeck,2,2,1.25\ndeck,2,3,1.25\n"
	"profile,stem,4.25,0,2\nprofile,keel,3,0,-0.5\n"
	"knuckle,waterline,1,1\nknuckle,station,2,0\nknuckle,waterline,3,1\n";

static void clones(void **state)
{
	batten_hull *hull = parse(*state, raked);
	batten_hull *copy = NULL;
	assert_int_equal(batten_hull_clone(*state, hull, &copy), BATTEN_OK);
	assert_same_hull(hull, copy);
	for (size_t i = 0; i < 3; i++)
		assert_string_equal(hull->labels[i], copy->labels[i]);
	batten_hull_destroy(hull);
	assert_string_equal(copy->labels[2], "deck");
	batten_hull_destroy(copy);
}

static void check_line(const batten_hull *hull, bool waterline, size_t line, size_t count,
                       const double *along, const double *value, const size_t *place)
{
	hull_line points;
	assert_int_equal(hull_line_collect(hull, waterline, line, true, &points), BATTEN_OK);
	assert_int_equal(points.count, count);
	for (size_t i = 0; i < count; i++) {
		assert_true(points.along_m[i] == along[i] && points.value_m[i] == value[i]);
		assert_int_equal(points.place[i], place[i]);
		assert_int_equal(points.gap[i], 0);
	}
	hull_line_release(hull, &points);
	assert_null(points.along_m);
}

static void long_layout_becomes_grid_and_ends(void **state)
{
	batten_hull *hull = parse(*state, raked);
	assert_int_equal(hull->station_count, 3);
	assert_int_equal(hull->waterline_count, 3);
	assert_memory_equal(hull->x_m, ((double[]){ 1, 2, 3 }), 3 * sizeof(double));
	assert_int_equal(hull->end_count, 4);
	assert_int_equal(hull->nodes[4], BATTEN_NODE_OUTSIDE);
	/* Line ends count for the half-beam. */
	assert_true(batten_hull_half_beam_m(hull) == 1.5);
	check_line(hull, true, 0, 5, (double[]){ 0.5, 1, 2, 3, 3.75 },
	           (double[]){ 0, 0.25, 0.5, 0.25, 0 }, (size_t[]){ SIZE_MAX, 0, 1, 2, SIZE_MAX });
	/* No gap where a listed line has no point at a station. */
	check_line(hull, true, 1, 4, (double[]){ 0.25, 1, 3, 4.5 }, (double[]){ 0, 0.75, 1, 1.5 },
	           (size_t[]){ SIZE_MAX, 0, 2, SIZE_MAX });
	/* The stem ends the deck, the keel the last section. */
	check_line(hull, true, 2, 4, (double[]){ 1, 2, 3, 4.25 }, (double[]){ 1, 1.25, 1.25, 0 },
	           (size_t[]){ 0, 1, 2, SIZE_MAX });
	check_line(hull, false, 2, 4, (double[]){ -0.5, 0, 1, 2 }, (double[]){ 0, 0.25, 1, 1.25 },
	           (size_t[]){ SIZE_MAX, 0, 1, 2 });
	/* A section of a table listed by waterlines does end at an empty node. */
	hull_line points;
	assert_int_equal(hull_line_collect(hull, false, 1, true, &points), BATTEN_OK);
	assert_int_equal(points.count, 2);
	assert_int_equal(points.gap[1], 1);
	hull_line_release(hull, &points);
	batten_hull_destroy(hull);
}

static void gaps(void **state)
{
	batten_hull *hull = parse(*state, "# layout: grid\nz\\x,0,1,2,3,4,5\n"
	                                  "0,1,,2,?,3,\n1,1,1,1,1,1,1\n2,,,1,,,1\n"
	                                  "profile,keel,1,0,0\nprofile,stem,1,0,2\n"
	                                  "profile,stern,0.5,0,2\nprofile,deck,2,9,1\n");
	hull_line points;
	assert_int_equal(hull_line_collect(hull, true, 0, false, &points), BATTEN_OK);
	/* The keel point stands where the cell is empty: no gap there. '?' is no gap either. */
	assert_int_equal(points.count, 4);
	assert_true(points.along_m[1] == 1 && points.place[1] == SIZE_MAX);
	for (size_t i = 0; i < 4; i++)
		assert_int_equal(points.gap[i], 0);
	hull_line_release(hull, &points);
	assert_int_equal(hull_line_collect(hull, true, 2, false, &points), BATTEN_OK);
	/* 0.5, 1, 2, then the empty cells at 3 and 4 */
	assert_int_equal(points.count, 4);
	assert_int_equal(points.gap[0], 0);
	assert_int_equal(points.gap[1], 0);
	assert_int_equal(points.gap[2], 0);
	assert_int_equal(points.gap[3], 1);
	hull_line_release(hull, &points);
	/* A profile point on a given node changes nothing. */
	assert_int_equal(hull_line_collect(hull, true, 1, false, &points), BATTEN_OK);
	assert_int_equal(points.count, 6);
	assert_true(points.value_m[2] == 1);
	hull_line_release(hull, &points);
	batten_hull_destroy(hull);
}

static void knuckles(void **state)
{
	batten_hull *hull = parse(*state, raked);
	assert_true(hull_knuckle_between(hull, true, 1, 0, 2));
	assert_true(hull_knuckle_between(hull, true, 1, 1, 2));
	assert_true(hull_knuckle_between(hull, true, 1, 0, 1));
	assert_false(hull_knuckle_between(hull, true, 1, 1.25, 2.75));
	assert_true(hull_knuckle_between(hull, true, 1, 2.75, 3.25));
	assert_false(hull_knuckle_between(hull, true, 1, 3.25, 4));
	assert_false(hull_knuckle_between(hull, true, 0, 0, 4));
	assert_false(hull_knuckle_between(hull, true, 2, 0, 4));
	assert_true(hull_knuckle_between(hull, false, 1, 0, 1));
	assert_false(hull_knuckle_between(hull, false, 1, 1, 2));
	assert_false(hull_knuckle_between(hull, false, 0, 0, 2));
	batten_hull_destroy(hull);
}

static void places(void **state)
{
	const batten_hull_table from = table();
	batten_hull *hull = make(*state, &from);
	assert_int_equal(hull_station_at(hull, 2), 2);
	assert_int_equal(hull_station_at(hull, 4 + 4e-9), 3);
	assert_int_equal(hull_station_at(hull, 4 - 4e-9), 3);
	assert_int_equal(hull_station_at(hull, 4 + 6e-9), SIZE_MAX);
	assert_int_equal(hull_station_at(hull, -1), SIZE_MAX);
	assert_int_equal(hull_station_at(hull, 5 + 1e-9), 4);
	assert_int_equal(hull_station_at(hull, NAN), SIZE_MAX);
	assert_int_equal(hull_waterline_at(hull, 0.5), 1);
	assert_int_equal(hull_waterline_at(hull, 0.5 + 2e-9), SIZE_MAX);
	batten_hull_destroy(hull);
}

static void unknown_nodes_are_filled(void **state)
{
	/* The natural spline through (0,0), (1,1), (2,0): at 0.5, and straight on to 3, below 0. */
	batten_hull *hull = parse(*state, "# layout: grid\nz\\x,0,0.5,1,2,3\n"
	                                  "0,0,?,1,0,?\n3,0,2,1,1,1\n");
	assert_true(fabs(hull->y_m[1] - 0.6875) < 1e-15);
	assert_true(hull->y_m[4] == 0);
	assert_int_equal(hull->nodes[1], BATTEN_NODE_UNKNOWN);
	batten_hull_destroy(hull);
	hull = parse(*state, "# layout: grid\nz\\x,0,1,2\n0,0,1,0\n1,?,3,\n3,6,1,1\n");
	/* One point on the waterline: along the section, straight from (z 0, y 0) to (z 3, y 6). */
	assert_true(fabs(hull->y_m[3] - 2) < 1e-15);
	/* The largest half-breadth of the table, not of what was filled. */
	assert_true(batten_hull_half_beam_m(hull) == 6);
	batten_hull_destroy(hull);
	/* Every '?' of the trawler, between 4 and 5 and 5 and 6, lies within 0.3 % of the breadth. */
	assert_int_equal(batten_hull_read(*state, BATTEN_DATA_DIR "/hulls/bsra_trawler.csv", &hull),
	                 BATTEN_OK);
	size_t count = 0;
	for (size_t i = 0; i < hull_node_count(hull); i++) {
		if (hull->nodes[i] != BATTEN_NODE_UNKNOWN)
			continue;
		count++;
		double low = fmin(hull->y_m[i - 1], hull->y_m[i + 1]);
		assert_true(hull->y_m[i] >= low);
		assert_true(hull->y_m[i] <= 3.06);
	}
	assert_int_equal(count, 18);
	assert_true(hull->y_m[6] == 0);
	batten_hull_destroy(hull);
}

static void text_lengths(void **state)
{
	(void)state;
	assert_int_equal(hull_text_length("a\tb", 3), 3);
	assert_int_equal(hull_text_length("a\nb", 3), 1);
	assert_int_equal(hull_text_length("\x7F", 1), 0);
	assert_int_equal(hull_text_length("\xC3\xA9\xE2\x82\xAC\xF0\x9F\x9A\xA2", 9), 9);
	assert_int_equal(hull_text_length("\xC3", 1), 0);
	assert_int_equal(hull_text_length("\xE2\x82", 2), 0);
	assert_int_equal(hull_text_length("\xC0\x80", 2), 0);
	assert_int_equal(hull_text_length("\xE0\x80\x80", 3), 0);
	assert_int_equal(hull_text_length("\xED\xA0\x80", 3), 0);
	assert_int_equal(hull_text_length("\xF4\x90\x80\x80", 4), 0);
	assert_int_equal(hull_text_length("\xC2\x85", 2), 0);
	assert_int_equal(hull_text_length("\xFF", 1), 0);
}

/* ------------------------------------------------------------------------------------------------
 * Failing allocations
 * --------------------------------------------------------------------------------------------- */

static batten_status create_clone_and_fill(batten_context *context, void *user)
{
	(void)user;
	uint8_t nodes[NODES];
	memset(nodes, BATTEN_NODE_GIVEN, sizeof nodes);
	nodes[7] = nodes[8] = BATTEN_NODE_UNKNOWN;
	batten_hull_table from = table();
	from.nodes = nodes;
	batten_hull *hull = NULL;
	batten_hull *copy = NULL;
	batten_status status = batten_hull_create(context, &from, &hull);
	if (status == BATTEN_OK)
		status = batten_hull_clone(context, hull, &copy);
	batten_hull_destroy(hull);
	batten_hull_destroy(copy);
	return status;
}

static void failing_allocations(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	assert_true(failing_heap_each(&heap, context, create_clone_and_fill, NULL) > 30);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(views, make_context, end_context),
		cmocka_unit_test_setup_teardown(wrong_arrays, make_context, end_context),
		cmocka_unit_test_setup_teardown(new_half_breadths, make_context, end_context),
		cmocka_unit_test_setup_teardown(clones, make_context, end_context),
		cmocka_unit_test_setup_teardown(long_layout_becomes_grid_and_ends, make_context,
		                                end_context),
		cmocka_unit_test_setup_teardown(gaps, make_context, end_context),
		cmocka_unit_test_setup_teardown(knuckles, make_context, end_context),
		cmocka_unit_test_setup_teardown(places, make_context, end_context),
		cmocka_unit_test_setup_teardown(unknown_nodes_are_filled, make_context, end_context),
		cmocka_unit_test(text_lengths),
		cmocka_unit_test(failing_allocations),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
