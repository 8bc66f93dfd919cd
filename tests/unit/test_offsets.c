/* The offsets file: what is read, and that writing loses nothing in any unit, frame or layout. */
#include "offsets_fixture.h"

#include <math.h>

static void assert_same(const batten_hull *a, const batten_hull *b)
{
	size_t nodes = hull_node_count(a);
	assert_int_equal(a->station_count, b->station_count);
	assert_int_equal(a->waterline_count, b->waterline_count);
	assert_string_equal(a->name, b->name);
	assert_string_equal(a->source, b->source);
	assert_true(a->unit == b->unit && a->frame == b->frame && a->layout == b->layout);
	assert_true(a->lbp_m == b->lbp_m && a->draft_m == b->draft_m);
	assert_true(isnan(a->depth_m) ? isnan(b->depth_m) : a->depth_m == b->depth_m);
	assert_memory_equal(a->x_m, b->x_m, a->station_count * sizeof *a->x_m);
	assert_memory_equal(a->z_m, b->z_m, a->waterline_count * sizeof *a->z_m);
	assert_memory_equal(a->y_m, b->y_m, nodes * sizeof *a->y_m);
	assert_memory_equal(a->nodes, b->nodes, nodes);
	assert_int_equal(a->end_count, b->end_count);
	for (size_t i = 0; i < a->end_count; i++)
		assert_true(a->ends[i].line == b->ends[i].line &&
		            a->ends[i].on_waterline == b->ends[i].on_waterline &&
		            a->ends[i].along_m == b->ends[i].along_m && a->ends[i].y_m == b->ends[i].y_m);
	assert_int_equal(a->profile_count, b->profile_count);
	for (size_t i = 0; i < a->profile_count; i++)
		assert_true(
			a->profile[i].kind == b->profile[i].kind && a->profile[i].x_m == b->profile[i].x_m &&
			a->profile[i].y_m == b->profile[i].y_m && a->profile[i].z_m == b->profile[i].z_m);
	assert_int_equal(a->knuckle_count, b->knuckle_count);
	for (size_t i = 0; i < a->knuckle_count; i++)
		assert_true(a->knuckles[i].on_waterline == b->knuckles[i].on_waterline &&
		            a->knuckles[i].x_m == b->knuckles[i].x_m &&
		            a->knuckles[i].z_m == b->knuckles[i].z_m);
}

/* Writes, reads, compares, writes again, compares the texts. Returns the text, to be freed. */
static char *round_trip(const struct fixture *fixture, const batten_hull *hull)
{
	char first[256];
	char second[256];
	size_t first_length = 0;
	size_t second_length = 0;
	write_hull(fixture, hull, path_in(fixture, "first.csv", first));
	batten_hull *again = read_hull(fixture, first);
	assert_same(hull, again);
	write_hull(fixture, again, path_in(fixture, "second.csv", second));
	batten_hull_destroy(again);
	char *text = read_text(first, &first_length);
	char *other = read_text(second, &second_length);
	assert_int_equal(first_length, second_length);
	assert_memory_equal(text, other, first_length);
	free(other);
	return text;
}

/* ------------------------------------------------------------------------------------------------
 * The shipped hulls
 * --------------------------------------------------------------------------------------------- */

/* Sum of squared second derivatives over all waterlines; '?' points left out. */
static double fairness_number(const batten_hull *hull)
{
	double sum = 0;
	for (size_t w = 0; w < hull->waterline_count; w++) {
		hull_line line;
		assert_int_equal(hull_line_collect(hull, true, w, false, &line), BATTEN_OK);
		const double *x = line.along_m;
		const double *y = line.value_m;
		for (size_t i = 1; i + 1 < line.count; i++) {
			double before = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
			double after = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
			double second = (after - before) / ((x[i + 1] - x[i - 1]) / 2);
			sum += second * second;
		}
		hull_line_release(hull, &line);
	}
	return sum;
}

static double node_y(const batten_hull *hull, double x_m, double z_m)
{
	size_t node = hull_waterline_at(hull, z_m) * hull->station_count + hull_station_at(hull, x_m);
	assert_true(node < hull_node_count(hull));
	return hull->nodes[node] == BATTEN_NODE_OUTSIDE ? NAN : hull->y_m[node];
}

static batten_hull *check_shipped(const struct fixture *fixture, const char *name, size_t stations,
                                  size_t waterlines, size_t ends, double half_beam, double fn,
                                  double tolerance)
{
	char path[512];
	(void)snprintf(path, sizeof path, BATTEN_DATA_DIR "/hulls/%s.csv", name);
	batten_hull *hull = read_hull(fixture, path);
	assert_int_equal(hull->station_count, stations);
	assert_int_equal(hull->waterline_count, waterlines);
	assert_int_equal(hull->end_count, ends);
	assert_true(hull->unit == HULL_UNIT_M && hull->frame == HULL_FRAME_AP_FWD);
	assert_true(batten_hull_half_beam_m(hull) == half_beam);
	assert_true(strlen(hull->source) > 0);
	double found = fairness_number(hull);
	if (!(fabs(found - fn) <= tolerance))
		fail_msg("%s: fairness number %.9g, expected %.9g", name, found, fn);
	free(round_trip(fixture, hull));
	return hull;
}

static void shipped_hulls(void **state)
{
	const struct fixture *fixture = *state;
	batten_hull *hull = check_shipped(fixture, "npl_parent", 15, 21, 0, 0.2188, 7.16, 0.005);
	assert_true(hull->lbp_m == 2.54 && hull->draft_m == 0.24);
	assert_true(node_y(hull, 2.032, 0.15) == 0.1192); /* the misprint */
	assert_true(node_y(hull, 0.127, 0.06) == 0);
	assert_true(isnan(node_y(hull, 0, 0.06)));
	batten_hull_destroy(hull);
	hull = check_shipped(fixture, "bsra_trawler", 15, 10, 0, 3.05, 0.15112, 5e-6);
	assert_true(hull->lbp_m == 30.48 && hull->draft_m == 2.515);
	assert_true(node_y(hull, 13.716, 2.515) == 3.05 && node_y(hull, 16.764, 2.515) == 3.05);
	batten_hull_destroy(hull);
	hull = check_shipped(fixture, "highspeed_craft", 12, 19, 38, 3.8183, 1.0840, 5e-5);
	assert_true(hull->layout == HULL_LAYOUT_LONG_WATERLINES);
	assert_true(hull->lbp_m == 42 && hull->draft_m == 2.3);
	batten_hull_destroy(hull);
	/* 731.04 with y in centimetres */
	hull = check_shipped(fixture, "wigley", 13, 20, 0, 0.8, 731.04e-4, 5e-7);
	batten_hull_destroy(hull);
}

static void wigley_is_exact(void **state)
{
	const struct fixture *fixture = *state;
	batten_hull *exact = read_hull(fixture, BATTEN_DATA_DIR "/hulls/wigley.csv");
	batten_hull *noisy = read_hull(fixture, BATTEN_DATA_DIR "/hulls/wigley_noisy.csv");
	assert_int_equal(noisy->station_count, 21);
	assert_int_equal(noisy->waterline_count, 20);
	for (size_t i = 0; i < hull_node_count(exact); i++) {
		double x = exact->x_m[i % 13] / 8 - 1;
		double z = 1 - exact->z_m[i / 13];
		assert_true(fabs(exact->y_m[i] - 0.8 * (1 - x * x) * (1 - z * z)) < 1e-15);
		assert_int_equal(exact->nodes[i], BATTEN_NODE_GIVEN);
	}
	double squares = 0;
	double sum = 0;
	size_t count = 0;
	for (size_t i = 0; i < hull_node_count(noisy); i++) {
		double x = noisy->x_m[i % 21] / 8 - 1;
		double z = 1 - noisy->z_m[i / 21];
		double form = 0.8 * (1 - x * x) * (1 - z * z);
		double noise = noisy->y_m[i] - form;
		assert_true(form > 0 ? fabs(noise) <= 0.01 : noisy->y_m[i] == 0);
		if (form > 0) {
			squares += noise * noise;
			sum += noise;
			count++;
		}
	}
	/* Uniform in +-0.01: variance 0.01^2 / 3, mean 0. */
	assert_int_equal(count, 19 * 19);
	assert_true(fabs(sqrt(squares / (double)count) - 0.01 / sqrt(3)) < 3e-4);
	assert_true(fabs(sum / (double)count) < 1e-3);
	batten_hull_destroy(exact);
	batten_hull_destroy(noisy);
}

/* ------------------------------------------------------------------------------------------------
 * Units, frames, layouts
 * --------------------------------------------------------------------------------------------- */

/* One hull in three layouts; x forward of the AP, z above the baseline, in tenths of the unit. */
static const double tenths_x[] = { 0, 3, 41, 77, 100 };
static const double tenths_z[] = { 0, 7, 21 };

struct sheet {
	char text[4096];
	size_t length;
};

static void add(struct sheet *sheet, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(struct sheet *sheet, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	int written = vsnprintf(sheet->text + sheet->length, sizeof sheet->text - sheet->length, format,
	                        arguments);
	va_end(arguments);
	assert_true(written >= 0 && (size_t)written < sizeof sheet->text - sheet->length);
	sheet->length += (size_t)written;
}

static double sheet_x(hull_frame frame, size_t station)
{
	double tenths = tenths_x[station];
	switch (frame) {
	case HULL_FRAME_AP_FWD:
		break;
	case HULL_FRAME_MID_FWD:
	case HULL_FRAME_WATERLINE:
		return (tenths - 50) / 10;
	case HULL_FRAME_FP_AFT:
		return (100 - tenths) / 10;
	case HULL_FRAME_GHS:
		return (50 - tenths) / 10;
	}
	return tenths / 10;
}

static double sheet_z(hull_frame frame, size_t waterline)
{
	return (tenths_z[waterline] - (frame == HULL_FRAME_WATERLINE ? 15 : 0)) / 10;
}

static double sheet_y(size_t station, size_t waterline)
{
	return (double)(station * waterline * 3 + waterline) / 8;
}

static void add_header(struct sheet *sheet, hull_unit unit, hull_frame frame, bool grid)
{
	add(sheet,
	    "# batten-offsets: 1\n# name: h\xC3\xBCll, 1\n# unit: %s\n# frame: %s\n# lbp: 10\n"
	    "# draft: 1.5\n# depth: 2.5\n# layout: %s\n# source: a test\n",
	    hull_unit_text(unit), hull_frame_text(frame), grid ? "grid" : "long");
}

static void add_extras(struct sheet *sheet, hull_frame frame)
{
	add(sheet, "profile,stem,%g,0.1,%g\nprofile,deck,%g,2,%g\n", sheet_x(frame, 4),
	    sheet_z(frame, 1), sheet_x(frame, 2), sheet_z(frame, 2));
	add(sheet, "knuckle,station,%g,%g\nknuckle,waterline,%g,%g\n", sheet_x(frame, 3),
	    sheet_z(frame, 1), sheet_x(frame, 1), sheet_z(frame, 2));
}

static bool mirrored(hull_frame frame)
{
	return frame == HULL_FRAME_FP_AFT || frame == HULL_FRAME_GHS;
}

static void make_grid(struct sheet *sheet, hull_unit unit, hull_frame frame)
{
	add_header(sheet, unit, frame, true);
	add(sheet, "z\\x");
	for (size_t i = 0; i < 5; i++)
		add(sheet, ",%g", sheet_x(frame, mirrored(frame) ? 4 - i : i));
	add(sheet, "\n");
	for (size_t w = 0; w < 3; w++) {
		add(sheet, "%g", sheet_z(frame, w));
		for (size_t i = 0; i < 5; i++) {
			size_t s = mirrored(frame) ? 4 - i : i;
			if (w == 1 && s == 2)
				add(sheet, ",?");
			else if (w == 0 && s == 4)
				add(sheet, ",");
			else
				add(sheet, ",%g", sheet_y(s, w));
		}
		add(sheet, "\n");
	}
	add_extras(sheet, frame);
}

/* Node (1, 1) of the long layouts stands off the grid, as no other line has its coordinate. */
static void make_long(struct sheet *sheet, hull_unit unit, hull_frame frame, bool by_waterlines)
{
	add_header(sheet, unit, frame, false);
	add(sheet, by_waterlines ? "waterline,z,x,y\n" : "station,x,z,y\n");
	for (size_t i = 0; i < (by_waterlines ? 3 : 5); i++) {
		for (size_t k = 0; k < (by_waterlines ? 5 : 3); k++) {
			size_t s = by_waterlines ? k : i;
			size_t w = by_waterlines ? i : k;
			s = mirrored(frame) ? 4 - s : s;
			double x = sheet_x(frame, s) + (by_waterlines && s == 1 && w == 1 ? 0.125 : 0);
			double z = sheet_z(frame, w) + (!by_waterlines && s == 1 && w == 1 ? 0.125 : 0);
			add(sheet, "line %zu,%g,%g,", i, by_waterlines ? z : x, by_waterlines ? x : z);
			if (w == 1 && s == 2)
				add(sheet, "?\n");
			else
				add(sheet, "%g\n", sheet_y(s, w));
		}
	}
	add_extras(sheet, frame);
}

static double metres_of(hull_unit unit)
{
	return unit == HULL_UNIT_M ? 1 : unit == HULL_UNIT_MM ? 1e-3 : 0.3048;
}

static void check_values(const batten_hull *hull, hull_unit unit, bool grid)
{
	double scale = metres_of(unit);
	double tolerance = 1e-14 * scale;
	assert_true(hull->lbp_m == (unit == HULL_UNIT_MM ? 0.01 : 10 * scale));
	assert_true(fabs(hull->depth_m - 2.5 * scale) <= tolerance);
	assert_string_equal(hull->name, "h\xC3\xBCll, 1");
	assert_int_equal(hull->station_count, 5);
	assert_int_equal(hull->waterline_count, 3);
	for (size_t s = 0; s < 5; s++)
		assert_true(fabs(hull->x_m[s] - tenths_x[s] / 10 * scale) <= tolerance);
	for (size_t w = 0; w < 3; w++)
		assert_true(fabs(hull->z_m[w] - tenths_z[w] / 10 * scale) <= tolerance);
	for (size_t i = 0; i < 15; i++) {
		size_t s = i % 5;
		size_t w = i / 5;
		if (hull->nodes[i] == BATTEN_NODE_GIVEN)
			assert_true(fabs(hull->y_m[i] - sheet_y(s, w) * scale) <= tolerance);
		assert_true((hull->nodes[i] == BATTEN_NODE_UNKNOWN) == (s == 2 && w == 1));
		bool outside = grid ? s == 4 && w == 0 : s == 1 && w == 1;
		assert_true((hull->nodes[i] == BATTEN_NODE_OUTSIDE) == outside);
	}
	assert_int_equal(hull->end_count, grid ? 0 : 1);
	assert_true(fabs(hull->profile[0].x_m - 10 * scale) <= tolerance);
	assert_true(fabs(hull->profile[0].z_m - 0.7 * scale) <= tolerance);
	assert_int_equal(hull->knuckle_count, 2);
	assert_true(hull->knuckles[0].x_m == hull->x_m[3] && !hull->knuckles[0].on_waterline);
	assert_true(hull->knuckles[1].z_m == hull->z_m[2] && hull->knuckles[1].on_waterline);
}

/* What was read in the form that is written comes out as the same text. */
static void check_sheet(const struct fixture *fixture, const struct sheet *sheet, hull_unit unit,
                        bool grid)
{
	batten_hull *hull = parse(fixture, sheet->text, sheet->length);
	check_values(hull, unit, grid);
	char *text = round_trip(fixture, hull);
	assert_string_equal(text, sheet->text);
	free(text);
	batten_hull_destroy(hull);
}

static void every_unit_frame_and_layout(void **state)
{
	for (int unit = HULL_UNIT_M; unit <= HULL_UNIT_FT; unit++) {
		for (int frame = HULL_FRAME_AP_FWD; frame <= HULL_FRAME_WATERLINE; frame++) {
			struct sheet sheet = { .length = 0 };
			make_grid(&sheet, (hull_unit)unit, (hull_frame)frame);
			check_sheet(*state, &sheet, (hull_unit)unit, true);
			sheet.length = 0;
			make_long(&sheet, (hull_unit)unit, (hull_frame)frame, true);
			check_sheet(*state, &sheet, (hull_unit)unit, false);
			sheet.length = 0;
			make_long(&sheet, (hull_unit)unit, (hull_frame)frame, false);
			check_sheet(*state, &sheet, (hull_unit)unit, false);
		}
	}
}

/* SplitMix64 */
static double random_number(uint64_t *state)
{
	uint64_t z = *state += 0x9E3779B97F4A7C15u;
	z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
	z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
	return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static void make_random_sheet(struct sheet *sheet, hull_unit unit, hull_frame frame, uint64_t *seed)
{
	double lbp = 1 + 100 * random_number(seed);
	double x = (random_number(seed) - 0.5) * lbp;
	double z = random_number(seed) - 0.5;
	add(sheet,
	    "# batten-offsets: 1\n# name: r\n# unit: %s\n# frame: %s\n# lbp: %.17g\n# draft: %.17g\n"
	    "# layout: grid\nz\\x",
	    hull_unit_text(unit), hull_frame_text(frame), lbp, 0.1 + random_number(seed));
	for (size_t i = 0; i < 8; i++) {
		add(sheet, ",%.17g", x);
		x += 0.001 + random_number(seed);
	}
	for (size_t w = 0; w < 8; w++) {
		add(sheet, "\n%.17g", z);
		z += 0.001 + random_number(seed);
		for (size_t i = 0; i < 8; i++)
			add(sheet, ",%.17g", random_number(seed) * (i % 2 == 0 ? 1 : 1000));
	}
	add(sheet, "\n");
}

/* Half-breadths as fairing makes them: metres that no number of the file may give exactly. What is
 * written is then the nearest, and stays the same from there on. */
static void check_new_values(const struct fixture *fixture, batten_hull *hull, uint64_t *seed)
{
	double y[64];
	char path[256];
	for (size_t i = 0; i < 64; i++)
		y[i] = random_number(seed) * 10;
	assert_int_equal(batten_hull_set_y(fixture->context, hull, y), BATTEN_OK);
	write_hull(fixture, hull, path_in(fixture, "new.csv", path));
	batten_hull *again = read_hull(fixture, path);
	for (size_t i = 0; i < 64; i++)
		assert_true(fabs(again->y_m[i] - y[i]) <= (hull->unit == HULL_UNIT_M ? 0 : 4e-16 * y[i]));
	size_t length = 0;
	char *written = read_text(path, &length);
	char *text = round_trip(fixture, again);
	assert_string_equal(text, written);
	free(text);
	free(written);
	batten_hull_destroy(again);
}

static void numbers_at_full_precision(void **state)
{
	uint64_t seed = 5;
	for (int unit = HULL_UNIT_M; unit <= HULL_UNIT_FT; unit++) {
		for (int frame = HULL_FRAME_AP_FWD; frame <= HULL_FRAME_WATERLINE; frame++) {
			for (int repeat = 0; repeat < 8; repeat++) {
				struct sheet sheet = { .length = 0 };
				make_random_sheet(&sheet, (hull_unit)unit, (hull_frame)frame, &seed);
				batten_hull *hull = parse(*state, sheet.text, sheet.length);
				free(round_trip(*state, hull));
				check_new_values(*state, hull, &seed);
				batten_hull_destroy(hull);
			}
		}
	}
}

static void hulls_from_arrays_are_written(void **state)
{
	const struct fixture *fixture = *state;
	const batten_hull_table table = { .name = " from arrays, ",
		                              .lbp_m = 0.1 + 0.2,
		                              .draft_m = 1.0 / 3,
		                              .station_count = 2,
		                              .waterline_count = 2,
		                              .x_m = (double[]){ -0.0, 2.0 / 3 },
		                              .z_m = (double[]){ -1e-7, 1e5 },
		                              .y_m = (double[]){ -0.0, 5e-324, 1e6, 0.1 } };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(fixture->context, &table, &hull), BATTEN_OK);
	char *text = round_trip(fixture, hull);
	assert_non_null(strstr(text, "# name: from arrays\n"));
	assert_non_null(strstr(text, "\nz\\x,0,0.6666666666666666\n"));
	assert_non_null(strstr(text, "\n-1e-07,0,4.94065645841247e-324\n"));
	free(text);
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(shipped_hulls, begin, end),
		cmocka_unit_test_setup_teardown(wigley_is_exact, begin, end),
		cmocka_unit_test_setup_teardown(every_unit_frame_and_layout, begin, end),
		cmocka_unit_test_setup_teardown(numbers_at_full_precision, begin, end),
		cmocka_unit_test_setup_teardown(hulls_from_arrays_are_written, begin, end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
