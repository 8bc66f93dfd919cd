/* Curvature maps: what is in the files, and what happens without a driver, a path or memory. */
#include "picture/curvature_chart.h"
#include "picture/paper.h"

#include "support/cases.h"
#include "unit/picture_fixture.h"

/* ------------------------------------------------------------------------------------------------
 * Curvature maps
 * --------------------------------------------------------------------------------------------- */

/* Every shipped hull is in all three views of a picture of the size asked for. */
static void hulls_are_in_the_picture(void **state)
{
	fixture *f = *state;
	const char *names[] = { "npl_parent", "bsra_trawler", "highspeed_craft", "wigley",
		                    "wigley_noisy" };
	for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
		batten_hull *hull = read_shipped(f, names[k]);
		batten_picture_options options = options_of(800, 450, 0);
		picture p = draw(f, hull, &options);
		assert_int_equal(p.width, 800);
		assert_int_equal(p.height, 450);
		curvature_chart chart = { 0 };
		curvature_chart_lay_out(&chart, 800, 450);
		assert_true(covered(&p, &chart.views[CHART_PROFILE]) > 0.3);
		assert_true(covered(&p, &chart.views[CHART_BOW]) > 0.1);
		assert_true(covered(&p, &chart.views[CHART_STERN]) > 0.1);
		assert_true(covered(&p, &chart.colour_bar) > 0.9);
		free(p.rgb);
		batten_hull_destroy(hull);
	}
}

/* The pixel of the side view where the wall is upright, off all lines of the table. */
static const uint8_t *middle_pixel(const picture *p)
{
	curvature_chart chart = { 0 };
	curvature_chart_lay_out(&chart, p->width, p->height);
	picture_mesh box = { .low = { 0, 0, 0 }, .high = { 8, 1, 0.9 } };
	profile_scale scale = picture_profile_fit(&box, &chart.views[CHART_PROFILE]);
	unsigned x = (unsigned)(scale.x_left + 4.5 * scale.pixels_per_m);
	unsigned y = (unsigned)(scale.z_top - 0.45 * scale.pixels_per_m * scale.exaggeration);
	return p->rgb + 3 * ((size_t)y * p->width + x);
}

/* Walls of one shape but for their curvature are lit alike, so that the ratio of their colours is
 * that of the colour map at H / scale: convex and concave, half and quarter of one scale. */
static void colours_follow_the_scale(void **state)
{
	fixture *f = *state;
	const double bend = 0.02; /* H = 0.01 */
	const struct {
		double bend, scale, value;
	} cases[] = {
		{ bend, 0.02, 0.5 },   { bend, 0.04, 0.25 },       { bend, 0.01, 1.0 },
		{ bend, 0.001, 1.0 },  { -bend, 0.02, -0.5 },      { 2 * bend, 0.04, 0.5 },
		{ -bend, 0.01, -1.0 }, { 0.5 * bend, 0.02, 0.25 },
	};
	batten_picture_options options = options_of(1600, 900, 0.02);
	batten_hull *flat = make_wall(f, 0);
	picture neutral = draw(f, flat, &options);
	picture_colour_map map;
	picture_colour_map_fill(&map);
	double zero[3];
	picture_colour_map_look_up(&map, 0, zero);
	for (size_t k = 0; k < CASES(sizeof cases / sizeof cases[0], 2); k++) {
		batten_hull *hull = make_wall(f, cases[k].bend);
		options.scale_per_m = cases[k].scale;
		picture p = draw(f, hull, &options);
		double expected[3];
		picture_colour_map_look_up(&map, cases[k].value, expected);
		for (int channel = 0; channel < 3; channel++) {
			double shade = middle_pixel(&neutral)[channel] / 255.0 / zero[channel];
			double found = middle_pixel(&p)[channel] / 255.0 / shade;
			if (!(fabs(found - expected[channel]) < 0.02))
				fail_msg("case %zu, channel %d: %g, expected %g", k, channel, found,
				         expected[channel]);
		}
		free(p.rgb);
		batten_hull_destroy(hull);
	}
	free(neutral.rgb);
	batten_hull_destroy(flat);
}

/* The misprint of the NPL table, 9 % of the half-breadth, saturates the scale: red between blues. */
static void the_misprint_is_seen(void **state)
{
	fixture *f = *state;
	batten_hull *hull = read_shipped(f, "npl_parent");
	double scale = 0;
	assert_int_equal(batten_picture_scale(f->context, hull, &scale), BATTEN_OK);
	assert_true(scale > 5 && scale < 30);
	batten_picture_options options = options_of(1600, 900, scale);
	picture p = draw(f, hull, &options);
	curvature_chart chart = { 0 };
	curvature_chart_lay_out(&chart, 1600, 900);
	picture_mesh box = { .low = { 0, 0, 0 }, .high = { 2.54, 0.22, 0.24 } };
	profile_scale to = picture_profile_fit(&box, &chart.views[CHART_PROFILE]);
	int redness[3];
	const double heights[3] = { 0.138, 0.149, 0.1645 };
	for (int k = 0; k < 3; k++) {
		unsigned x = (unsigned)(to.x_left + 2.02 * to.pixels_per_m);
		unsigned y = (unsigned)(to.z_top - heights[k] * to.pixels_per_m * to.exaggeration);
		const uint8_t *pixel = p.rgb + 3 * ((size_t)y * p.width + x);
		redness[k] = pixel[0] - pixel[2];
	}
	assert_true(redness[0] < -40);
	assert_true(redness[1] > 100);
	assert_true(redness[2] < -100);
	free(p.rgb);
	batten_hull_destroy(hull);
}

static void scale_suits_the_hull(void **state)
{
	fixture *f = *state;
	/* H = 0.01 at every node but for the slope: the scale is the next round number. */
	batten_hull *wall = make_wall(f, 0.0199);
	double scale = 0;
	assert_int_equal(batten_picture_scale(f->context, wall, &scale), BATTEN_OK);
	assert_true(fabs(scale - 0.01) < 1e-12);
	batten_hull_destroy(wall);
	/* A flat hull takes that of a circle through its beam. */
	wall = make_wall(f, 0);
	assert_int_equal(batten_picture_scale(f->context, wall, &scale), BATTEN_OK);
	assert_true(scale >= 1 && scale < 1.6);
	batten_hull_destroy(wall);
}

/* Two pictures of one hull are equal byte for byte, also with another one between. */
static void pictures_are_deterministic(void **state)
{
	fixture *f = *state;
	char first[160], second[160], driver[128] = "";
	path_in(f, "first.png", first);
	path_in(f, "second.png", second);
	batten_hull *hull = read_shipped(f, "npl_parent");
	batten_picture_options options = options_of(800, 450, 0);
	assert_int_equal(batten_picture_curvature(f->context, hull, &options, first, driver),
	                 BATTEN_OK);
	assert_true(strlen(driver) > 0);
	batten_hull *wall = make_wall(f, 0.1);
	picture other = draw(f, wall, NULL);
	assert_int_equal(other.width, 1600);
	assert_int_equal(other.height, 900);
	free(other.rgb);
	batten_hull_destroy(wall);
	assert_int_equal(batten_picture_curvature(f->context, hull, &options, second, NULL), BATTEN_OK);
	assert_same_file(first, second);
	batten_hull_destroy(hull);
}

static bool has_note(png_structp png, png_infop info, const char *key, const char *value)
{
	png_textp notes = NULL;
	int count = png_get_text(png, info, &notes, NULL);
	for (int i = 0; i < count; i++)
		if (strcmp(notes[i].key, key) == 0 && strstr(notes[i].text, value))
			return true;
	return false;
}

/* Name, scale, unit and frame travel in the file. */
static void the_file_tells_what_it_shows(void **state)
{
	fixture *f = *state;
	char path[160];
	path_in(f, "notes.png", path);
	batten_hull *hull = make_wall(f, 0.1);
	batten_picture_options options = options_of(320, 180, 0.25);
	options.title = "caf\u00e9";
	assert_int_equal(batten_picture_curvature(f->context, hull, &options, path, NULL), BATTEN_OK);
	FILE *stream = fopen(path, "rb");
	assert_non_null(stream);
	png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
	png_infop info = png_create_info_struct(png);
	assert_non_null(info);
	assert_int_equal(setjmp(png_jmpbuf(png)), 0);
	png_init_io(png, stream);
	png_read_info(png, info);
	assert_true(has_note(png, info, "Hull", "wall"));
	assert_true(has_note(png, info, "Title", "caf\u00e9"));
	assert_true(has_note(png, info, "Scale", "-0.25..0.25"));
	assert_true(has_note(png, info, "Unit", "1/m"));
	assert_true(has_note(png, info, "Frame", "ap-fwd, m"));
	assert_true(has_note(png, info, "Quantity", "mean curvature"));
	png_destroy_read_struct(&png, &info, NULL);
	(void)fclose(stream);
	batten_hull_destroy(hull);
}

/* Any size and any title give a picture. */
static void odd_pictures_are_drawn(void **state)
{
	fixture *f = *state;
	const unsigned sizes[][2] = { { 64, 64 }, { 64, 1500 }, { 1501, 64 }, { 333, 777 } };
	char title[600];
	memset(title, 'W', sizeof title - 1);
	title[sizeof title - 1] = '\0';
	title[3] = (char)0xFF;
	title[4] = '\n';
	batten_hull *hull = make_wall(f, 0.1);
	for (size_t k = 0; k < 4; k++) {
		batten_picture_options options = options_of(sizes[k][0], sizes[k][1], 0);
		options.title = title;
		picture p = draw(f, hull, &options);
		assert_int_equal(p.width, sizes[k][0]);
		assert_int_equal(p.height, sizes[k][1]);
		picture_rectangle all = { 0, 0, p.width, p.height };
		assert_true(covered(&p, &all) > 0.01);
		free(p.rgb);
	}
	batten_hull_destroy(hull);
}

static void wrong_options_are_refused(void **state)
{
	fixture *f = *state;
	char path[160];
	path_in(f, "none.png", path);
	batten_hull *hull = make_wall(f, 0.1);
	batten_picture_options wrong[] = {
		options_of(63, 900, 0),    options_of(1600, 8193, 0), options_of(0, 0, 0),
		options_of(800, 450, NAN), options_of(800, 450, -1),  options_of(800, 450, INFINITY),
		options_of(800, 450, 0),
	};
	wrong[6].struct_size = 1;
	for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++)
		assert_int_equal(batten_picture_curvature(f->context, hull, &wrong[k], path, NULL),
		                 BATTEN_USAGE);
	assert_int_equal(empty_folder(f), 0);
	batten_hull_destroy(hull);
}

/* Lines that share no place span no surface. */
static void nothing_to_draw_is_said(void **state)
{
	fixture *f = *state;
	const double x[4] = { 0, 1, 2, 3 }, z[2] = { 0, 1 }, y[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };
	const uint8_t nodes[8] = { 1, 1, 0, 0, 0, 0, 1, 1 };
	batten_hull_table table = { "two lines", 3, 1, 4, 2, x, z, y, nodes };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(f->context, &table, &hull), BATTEN_OK);
	char path[160];
	path_in(f, "none.png", path);
	assert_int_equal(batten_picture_curvature(f->context, hull, NULL, path, NULL), BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(f->context), "two lines"));
	assert_int_equal(empty_folder(f), 0);
	batten_hull_destroy(hull);
}

/* ------------------------------------------------------------------------------------------------
 * Colours and text
 * --------------------------------------------------------------------------------------------- */

/* Relative luminance (IEC 61966-2-1). */
static double luminance(const float rgba[4])
{
	const double weights[3] = { 0.2126, 0.7152, 0.0722 };
	double sum = 0;
	for (int k = 0; k < 3; k++) {
		double c = (double)rgba[k];
		sum += weights[k] * (c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4));
	}
	return sum;
}

/* Darker and darker to both sides of a neutral middle, alike on both sides; blue left, red right. */
static void colours_are_even(void **state)
{
	(void)state;
	picture_colour_map map;
	picture_colour_map_fill(&map);
	const int middle = PICTURE_COLOUR_COUNT / 2;
	for (int channel = 0; channel < 2; channel++)
		assert_true(fabs((double)(map.rgba[middle][channel] - map.rgba[middle][2])) < 0.005);
	for (int k = 1; k <= middle; k++) {
		double left = luminance(map.rgba[middle - k]);
		double right = luminance(map.rgba[middle + k]);
		assert_true(left < luminance(map.rgba[middle - k + 1]));
		assert_true(right < luminance(map.rgba[middle + k - 1]));
		assert_true(fabs(left - right) < 0.01);
		assert_true(map.rgba[middle - k][2] > map.rgba[middle - k][0]);
		assert_true(map.rgba[middle + k][0] > map.rgba[middle + k][2]);
	}
	double low[3], beyond[3];
	picture_colour_map_look_up(&map, -1, low);
	picture_colour_map_look_up(&map, -7, beyond);
	assert_memory_equal(low, beyond, sizeof low);
}

static void text_is_cleaned(void **state)
{
	(void)state;
	char out[16];
	paper_clean_text("a\tb\xFF"
	                 "c\xC3\xA9",
	                 out, sizeof out);
	assert_string_equal(out, "a?b?c\xC3\xA9");
	paper_clean_text("\xC0\x80\xED\xA0\x80\xF5", out, sizeof out); /* overlong, surrogate, beyond */
	assert_string_equal(out, "??????");
	paper_clean_text("\xE2\x82", out, sizeof out); /* cut short */
	assert_string_equal(out, "??");
	paper_clean_text("\xC3\xA9\xC3\xA9", out, 4); /* never half a character */
	assert_string_equal(out, "\xC3\xA9");
}

static void ticks_are_round(void **state)
{
	(void)state;
	paper_ticks ticks = paper_choose_ticks(-10, 10, 9);
	assert_true(ticks.step == 5 && ticks.first == -2 && ticks.last == 2 && ticks.decimals == 0);
	ticks = paper_choose_ticks(0, 0.24, 5);
	assert_true(fabs(ticks.step - 0.1) < 1e-15 && ticks.last == 2 && ticks.decimals == 1);
	char text[32];
	paper_tick_text(&ticks, 2, true, text, sizeof text);
	assert_string_equal(text, "+0.2");
	paper_tick_text(&ticks, -3, true, text, sizeof text);
	assert_string_equal(text, "\u22120.3");
	paper_tick_text(&ticks, 0, true, text, sizeof text);
	assert_string_equal(text, "0");
}

/* ------------------------------------------------------------------------------------------------
 * Failures
 * --------------------------------------------------------------------------------------------- */

static void bad_paths_leave_nothing(void **state)
{
	fixture *f = *state;
	batten_hull *hull = make_wall(f, 0.1);
	batten_picture_options options = options_of(64, 64, 0);
	char path[160];
	path_in(f, "absent/picture", path);
	assert_int_equal(batten_picture_curvature(f->context, hull, &options, path, NULL), BATTEN_IO);
	assert_non_null(strstr(batten_context_error(f->context), path));
	assert_int_equal(batten_picture_curvature(f->context, hull, &options, f->folder, NULL),
	                 BATTEN_IO);
	assert_int_equal(empty_folder(f), 0);
	batten_hull_destroy(hull);
}

static void change_environment(const char *name, const char *value)
{
	if (value)
		assert_int_equal(setenv(name, value, 1), 0);
	else
		assert_int_equal(unsetenv(name), 0);
}

/* No driver: DEVICE, one line, no file; the scale and the lines plan need none. */
static void no_driver_is_said(void **state)
{
	fixture *f = *state;
	char path[160];
	path_in(f, "none.png", path);
	const char *names[] = { "VK_DRIVER_FILES", "VK_ICD_FILENAMES" };
	char *kept[2];
	for (int k = 0; k < 2; k++) {
		const char *value = getenv(names[k]);
		kept[k] = value ? strdup(value) : NULL;
		change_environment(names[k], "/nonexistent");
	}
	batten_hull *hull = make_wall(f, 0.1);
	char driver[128] = "untouched";
	batten_status status = batten_picture_curvature(f->context, hull, NULL, path, driver);
	double scale = 0;
	assert_int_equal(batten_picture_scale(f->context, hull, &scale), BATTEN_OK);
	for (int k = 0; k < 2; k++) {
		change_environment(names[k], kept[k]);
		free(kept[k]);
	}
	assert_int_equal(status, BATTEN_DEVICE);
	assert_string_equal(batten_context_error(f->context), "no Vulkan driver is installed");
	assert_string_equal(driver, "untouched");
	assert_int_equal(empty_folder(f), 0);
	batten_hull_destroy(hull);
}

/* The Khronos validation layer watches a whole picture and has nothing to say; were it missing, the
 * status would be MISSING. */
static void validation_is_silent(void **state)
{
	fixture *f = *state;
	batten_hull *hull = read_shipped(f, "npl_parent");
	char path[160];
	path_in(f, "validated.png", path);
	change_environment("BATTEN_VULKAN_VALIDATION", "1");
	change_environment("VK_LAYER_ENABLES",
	                   "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT");
	batten_status status = batten_picture_curvature(f->context, hull, NULL, path, NULL);
	change_environment("BATTEN_VULKAN_VALIDATION", NULL);
	change_environment("VK_LAYER_ENABLES", NULL);
	if (status != BATTEN_OK)
		fail_msg("%s", batten_context_error(f->context));
	batten_hull_destroy(hull);
}

static batten_status call_curvature(fixture *f, const batten_hull *hull, const char *path)
{
	batten_picture_options options = options_of(64, 64, 0);
	return batten_picture_curvature(f->context, hull, &options, path, NULL);
}

static void every_allocation_may_fail(void **state)
{
	fixture *f = *state;
	const double x[3] = { 0, 1, 2 }, z[3] = { 0, 1, 2 }, y[9] = { 1, 2, 1, 2, 3, 2, 2, 3, 2 };
	batten_hull_table table = { "small", 2, 1, 3, 3, x, z, y, NULL };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(f->context, &table, &hull), BATTEN_OK);
	char path[160];
	path_in(f, "picture", path);
	fail_every_allocation(f, hull, path, call_curvature, 20);
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		PICTURE_TEST(hulls_are_in_the_picture),
		PICTURE_TEST(colours_follow_the_scale),
		PICTURE_TEST(the_misprint_is_seen),
		PICTURE_TEST(scale_suits_the_hull),
		PICTURE_TEST(pictures_are_deterministic),
		PICTURE_TEST(the_file_tells_what_it_shows),
		PICTURE_TEST(odd_pictures_are_drawn),
		PICTURE_TEST(wrong_options_are_refused),
		PICTURE_TEST(nothing_to_draw_is_said),
		PICTURE_TEST(colours_are_even),
		PICTURE_TEST(text_is_cleaned),
		PICTURE_TEST(ticks_are_round),
		PICTURE_TEST(bad_paths_leave_nothing),
		PICTURE_TEST(no_driver_is_said),
		PICTURE_TEST(validation_is_silent),
		PICTURE_TEST(every_allocation_may_fail),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
