/* The offsets file: what is read, what is refused and with which message, and that writing loses
 * nothing in any unit, frame or layout. */
#include "hull/hull.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

struct fixture {
	batten_context *context;
	char folder[64];
};

static int begin(void **state)
{
	struct fixture *fixture = calloc(1, sizeof *fixture);
	assert_non_null(fixture);
	(void)snprintf(fixture->folder, sizeof fixture->folder, "/tmp/batten-offsets.XXXXXX");
	assert_non_null(mkdtemp(fixture->folder));
	assert_int_equal(batten_context_create(NULL, &fixture->context), BATTEN_OK);
	*state = fixture;
	return 0;
}

/* Removes the folder with the files in it. */
static int end(void **state)
{
	struct fixture *fixture = *state;
	DIR *folder = opendir(fixture->folder);
	assert_non_null(folder);
	for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
		if (entry->d_name[0] != '.')
			(void)unlinkat(dirfd(folder), entry->d_name, 0);
	(void)closedir(folder);
	(void)rmdir(fixture->folder);
	batten_context_destroy(fixture->context);
	free(fixture);
	return 0;
}

static char *path_in(const struct fixture *fixture, const char *name, char path[256])
{
	(void)snprintf(path, 256, "%s/%s", fixture->folder, name);
	return path;
}

static size_t count_files(const struct fixture *fixture)
{
	size_t count = 0;
	DIR *folder = opendir(fixture->folder);
	assert_non_null(folder);
	for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
		count += entry->d_name[0] != '.';
	(void)closedir(folder);
	return count;
}

/* The whole file, to be freed. */
static char *read_text(const char *path, size_t *length)
{
	FILE *stream = fopen(path, "rb");
	assert_non_null(stream);
	char *text = calloc(1, 1 << 20);
	assert_non_null(text);
	*length = fread(text, 1, (1 << 20) - 1, stream);
	(void)fclose(stream);
	return text;
}

static batten_hull *parse(const struct fixture *fixture, const char *text, size_t length)
{
	batten_hull *hull = NULL;
	if (batten_hull_parse(fixture->context, "in.csv", text, length, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(fixture->context));
	return hull;
}

static batten_hull *read_hull(const struct fixture *fixture, const char *path)
{
	batten_hull *hull = NULL;
	if (batten_hull_read(fixture->context, path, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(fixture->context));
	return hull;
}

static void write_hull(const struct fixture *fixture, const batten_hull *hull, const char *path)
{
	if (batten_hull_write(fixture->context, hull, path) != BATTEN_OK)
		fail_msg("%s", batten_context_error(fixture->context));
}

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

/* ------------------------------------------------------------------------------------------------
 * What is taken, what is refused
 * --------------------------------------------------------------------------------------------- */

#define HEADER "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n"
#define GRID HEADER "# layout: grid\n"
#define LONG HEADER "# layout: long\n"

static void spreadsheet_habits(void **state)
{
	static const char text[] =
		"\xEF\xBB\xBF# a comment: first\r\n"
		"#lbp :2,,,\r\n# draft: 1\r\n# layout: grid,\r\n# frame:ap-fwd\r\n# unit: m\r\n"
		"\r\n# name: with , comma ,,\r\n# batten-offsets: 1\r\n"
		"z\\x , 0 , 1 ,,\r\n,,,,\r\n 0 , 1e0 ,\t.5 ,,\r\n# between\r\n\r\n1., +2,,,\r\n"
		"profile,keel,0,0,0,,,,\r\n";
	batten_hull *hull = parse(*state, text, sizeof text - 1);
	assert_string_equal(hull->name, "with , comma");
	assert_int_equal(hull->station_count, 2);
	assert_memory_equal(hull->y_m, ((double[]){ 1, 0.5, 2, 0 }), 4 * sizeof(double));
	assert_int_equal(hull->nodes[3], BATTEN_NODE_OUTSIDE);
	assert_int_equal(hull->profile_count, 1);
	batten_hull_destroy(hull);
	/* The last line needs no end. */
	static const char open[] = GRID "z\\x,0,1\n0,0,0\n1,1,1\n2,1,?";
	hull = parse(*state, open, sizeof open - 1);
	assert_int_equal(hull->nodes[5], BATTEN_NODE_UNKNOWN);
	batten_hull_destroy(hull);
}

struct refusal {
	const char *text;
	const char *place; /* line and column */
	const char *says;
};

static void refuse(const struct fixture *fixture, const char *text, size_t length,
                   const char *place, const char *says)
{
	batten_hull *hull = (batten_hull *)&tenths_x;
	batten_status status = batten_hull_parse(fixture->context, "in.csv", text, length, &hull);
	const char *error = batten_context_error(fixture->context);
	char prefix[64];
	(void)snprintf(prefix, sizeof prefix, "in.csv:%s: ", place);
	if (status != BATTEN_INPUT || strncmp(error, prefix, strlen(prefix)) != 0 ||
	    !strstr(error, says) || !strstr(error, "expected") || strchr(error, '\n'))
		fail_msg("status %d '%s', expected '%s...%s'", (int)status, error, prefix, says);
	assert_null(hull);
}

static void refuse_all(const struct fixture *fixture, const struct refusal *refusals, size_t count)
{
	for (size_t i = 0; i < count; i++)
		refuse(fixture, refusals[i].text, strlen(refusals[i].text), refusals[i].place,
		       refusals[i].says);
}

static void wrong_headers(void **state)
{
	static const struct refusal refusals[] = {
		{ "", "1:1", "empty file" },
		{ "\xEF\xBB\xBF", "1:1", "empty file" },
		{ "z\\x,0,1\n", "1:1", "no key 'batten-offsets'" },
		{ "# only a comment\n", "2:1", "no key 'batten-offsets'" },
		{ "# batten-offsets: 1\n# unit: m\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'name'" },
		{ "# batten-offsets: 1\n# name: n\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'unit'" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# lbp: 2\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'frame'" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'lbp'" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'draft'" },
		{ HEADER "z\\x,0,1\n", "7:1", "no key 'layout'" },
		{ GRID, "8:1", "z\\x" },
		{ HEADER "# unit: mm\n", "7:1", "found the key 'unit' again" },
		{ "# batten-offsets: 2\n" GRID, "2:1", "'batten-offsets' again" },
		{ "# batten-offsets: 2\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "1:19", "found '2', expected the version 1" },
		{ "# batten-offsets: 1\n# name: n\n# unit: cm\n# frame: ghs\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "3:9", "found 'cm', expected a unit: m, mm or ft" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: stern\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "4:10", "found 'stern', expected a frame" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2,54\n# draft: 1\n"
		  "# layout: grid\n",
		  "5:8", "found '2,54', expected a length above 0, written with a decimal point" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2\n# draft: 0\n"
		  "# layout: grid\n",
		  "6:10", "found '0', expected a length above 0" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2e9\n# draft: 1\n"
		  "# layout: grid\n",
		  "5:8", "found '2e9'" },
		{ HEADER "# layout: table\n", "7:11", "found 'table', expected a layout: grid or long" },
		{ GRID "# depth: -1\n", "8:10", "found '-1'" },
		{ GRID "# depth:\n", "8:9", "found an empty cell" },
		{ "# batten-offsets: 1\n# name: ,,\n# unit: m\n# frame: ghs\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "2:9", "found no name" },
		{ GRID "z\\x,0,1\n# unit: mm\n0,0,0\n1,1,1\n", "9:1", "after the table began" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
}

static void wrong_grids(void **state)
{
	static const struct refusal refusals[] = {
		{ GRID "z,0,1\n", "8:1", "found 'z', expected 'z\\x'" },
		{ GRID "z\\x;0;1\n", "8:1", "found 'z\\x;0;1'" },
		{ GRID "\"z\\x\",0,1\n", "8:1", "found '\"z\\x\"'" },
		{ GRID "z\\x,0\n0,1\n1,1\n", "8:1", "found 1 station," },
		{ GRID "z\\x\n", "8:1", "found 0 stations" },
		{ GRID "z\\x,0,1\n0,0,0\n", "9:1", "found 1 waterline " },
		{ GRID "z\\x,0,1\n", "8:1", "found 0 waterlines" },
		{ GRID "z\\x,0,1,1\n", "8:9", "found '1', expected each x once" },
		{ GRID "z\\x,0,2,1.5\n", "8:9", "found '1.5', expected x in ascending order, beyond 2" },
		{ GRID "z\\x,0,1,1.0000000000001\n", "8:9", "expected x at least 1e-09 m beyond 1" },
		{ GRID "z\\x,0,1e7\n", "8:7", "found '1e7', expected x within 1e+06 m" },
		{ GRID "z\\x,0,,1\n", "8:8", "found '1', expected the end of the row" },
		{ GRID "z\\x,0,one\n", "8:7", "found 'one', expected a number for x" },
		{ GRID "z\\x,0,1\n0,0,0\n0,1,1\n", "10:1", "found '0', expected each z once" },
		{ GRID "z\\x,0,1\n1,0,0\n 0,1,1\n", "10:2", "found '0', expected z in ascending order" },
		{ GRID "z\\x,0,1\n,0,0\n", "9:1", "found an empty cell, expected a number for z" },
		{ GRID "z\\x,0,1\n?,0,0\n", "9:1", "found '?', expected a number for z" },
		{ GRID "z\\x,0,1\n0,0\n", "9:4", "found 2 cells, expected 3" },
		{ GRID "z\\x,0,1\n0,0,0\n1,0,5,1\n", "10:7", "found 4 cells, expected 3" },
		{ GRID "z\\x,0,1\n0,0,0,\n", "9:7", "found 4 cells, expected 3" },
		{ GRID "z\\x,0,1,\n0,0,0,1\n", "9:7", "found '1', expected the end of the row" },
		{ GRID "z\\x,0,1\n0,0,-0.5\n", "9:5",
		  "found '-0.5', expected a half-breadth of 0 or more" },
		{ GRID "z\\x,0,1\n0,nan,1\n", "9:3", "found 'nan', expected a half-breadth" },
		{ GRID "z\\x,0,1\n0,0,inf\n", "9:5", "found 'inf', expected a half-breadth" },
		{ GRID "z\\x,0,1\n0,0,1e999\n", "9:5", "found '1e999', expected a half-breadth" },
		{ GRID "z\\x,0,1\n0,0,0x10\n", "9:5", "found '0x10'" },
		{ GRID "z\\x,0,1\n0,0,1 2\n", "9:5", "found '1 2'" },
		{ GRID "z\\x,0,1\n0,0,1;5\n", "9:5", "found '1;5'" },
		{ GRID "z\\x,0,1\n0,0,??\n", "9:5", "found '?\?'" },
		{ GRID "z\\x,0,1\n0,0,12345678901234567890123456789012345678\xC3\xBCxyz\n", "9:5",
		  "found '12345678901234567890123456789012345678\xC3\xBC...', expected" },
		{ GRID "z\\x,0,1\n0,0,1234567890123456789012345678901234567\xE2\x82\xACxyz\n", "9:5",
		  "found '1234567890123456789012345678901234567\xE2\x82\xAC...', expected" },
		{ GRID "z\\x,0,1\n0,0,123456789012345678901234567890123456789\xC3\xBCxyz\n", "9:5",
		  "found '123456789012345678901234567890123456789...', expected" },
		{ GRID "z\\x,0,1,2\n0,0,?,1\n1,,?,1\n2,,?,\n", "10:4",
		  "found '?', expected two given half-breadths" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
}

static void wrong_lists_and_extras(void **state)
{
#define LIST LONG "waterline,z,x,y\n1,0,0,0\n1,0,1,1\n1,0,2,1\n"
#define TABLE GRID "z\\x,0,1\n0,0,1\n1,1,1\n"
	static const struct refusal refusals[] = {
		{ LONG "buttock,y,x,z\n", "8:1", "found 'buttock', expected the row 'waterline,z,x,y'" },
		{ LONG "waterline,x,z,y\n", "8:11", "found 'x', expected 'z'" },
		{ LONG "station,x,z\n", "8:12", "found the end of the row, expected 'y'" },
		{ LONG "station,x,z,y,d\n", "8:15", "found 'd', expected the end of the row" },
		{ LIST, "11:1", "found 1 line " },
		{ LIST "1,0,2,1\n", "12:5", "found '2', expected each x once" },
		{ LIST "1,0,1.5,1\n", "12:5", "found '1.5', expected x in ascending order" },
		{ LIST "2,0,3,1\n", "12:1", "found '2', expected the label of the row before" },
		{ LIST "1,1,0,1\n", "12:1", "found '1', expected another label" },
		{ LIST "2,-1,0,1\n", "12:3", "found '-1', expected z in ascending order" },
		{ LIST "2,1,0,\n", "12:7", "found an empty cell, expected a half-breadth" },
		{ LIST "2,1,0,-1\n", "12:7", "found '-1'" },
		{ LIST "2,1,0\n", "12:6", "found 3 cells, expected 4" },
		{ LIST "2,1,0,0,5\n", "12:9", "found 5 cells, expected 4" },
		{ LIST " #2,1,0,0\n", "12:2", "found '#2', expected a label" },
		{ LIST "2,1,0,0\n2,1,0.5,?\n2,1,1,0\n", "13:9", "found '?' where no other line" },
		{ LIST "2,1,0,0\n2,1,0.5,1\n", "13:1", "found 1 values of x that two lines or more share" },
		{ LONG "waterline,z,x,y\n1,0,0,0\n1,0,1,?\n2,1,0,0\n2,1,1,?\n", "10:7",
		  "found '?', expected two given half-breadths" },
		{ LONG "station,x,z,y\n1,0,0,0\n1,0,1,0\n2,1,0,0\n2,1,1,0\n3,2,1.0000000000001,0\n"
		       "4,3,1.0000000000001,0\n",
		  "13:1", "on another line" },
		{ TABLE "2,1\n", "11:4", "found 2 cells" },
		{ TABLE "profile,bow,0,0,0\n", "11:9", "found 'bow', expected stem, stern, keel or deck" },
		{ TABLE "profile,stem,0,0\n", "11:17", "found the end of the row" },
		{ TABLE "profile,stem,0,-1,0\n", "11:16", "found '-1'" },
		{ TABLE "profile,stem,0,?,0\n", "11:16", "found '?'" },
		{ TABLE "profile,stem,a,0,0\n", "11:14", "found 'a', expected a number for x" },
		{ TABLE "profile,stem,0,0,0,0\n", "11:20", "found '0', expected the end of the row" },
		{ TABLE "knuckle,buttock,0,0\n", "11:9", "found 'buttock', expected station or waterline" },
		{ TABLE "knuckle,station,0.5,0\n", "11:17",
		  "found '0.5', expected a station of the table" },
		{ TABLE "knuckle,waterline,0.5,3\n", "11:23", "found '3', expected a waterline of the" },
		{ TABLE "knuckle,station,0,0,1\n", "11:21", "found '1', expected the end of the row" },
		{ TABLE "knuckle,station,0,0\n2,1,1\n", "12:1", "found '2', expected profile or knuckle" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
#undef LIST
#undef TABLE
}

static void no_text(void **state)
{
	static const struct refusal refusals[] = {
		{ GRID "z\\x,0,1\n0,0,\x01\n", "9:5", "found the byte 0x01, expected a text file" },
		{ GRID "z\\x,0,1\n0,0,\xFF\n", "9:5", "found the byte 0xff" },
		{ GRID "z\\x,0,1\r0,0,0\r", "8:8", "found the byte 0x0d" },
		{ "\xFF\xFE#", "1:1", "found the byte 0xff" },
		{ "\x7F"
		  "ELF",
		  "1:1", "found the byte 0x7f" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
	static const char zero[] = "# batten-offsets: 1\n# na\0me: n\n";
	refuse(*state, zero, sizeof zero - 1, "2:5", "found the byte 0x00");
}

/* ------------------------------------------------------------------------------------------------
 * Size
 * --------------------------------------------------------------------------------------------- */

/* Text that grows, for rows too long for a literal. */
struct heap_text {
	char *text;
	size_t length, capacity;
};

static void append(struct heap_text *to, const char *text)
{
	size_t length = strlen(text);
	if (to->length + length + 1 > to->capacity) {
		to->capacity = 2 * (to->capacity + length + 1);
		to->text = realloc(to->text, to->capacity);
		assert_non_null(to->text);
	}
	memcpy(to->text + to->length, text, length + 1);
	to->length += length;
}

static void append_numbers(struct heap_text *to, size_t count, const char *format)
{
	char number[64];
	for (size_t i = 0; i < count; i++) {
		(void)snprintf(number, sizeof number, format, i);
		append(to, number);
	}
}

static void limits(void **state)
{
	const struct fixture *fixture = *state;
	struct heap_text text = { 0 };
	append(&text, GRID "z\\x");
	append_numbers(&text, 4096, ",%zu");
	size_t most = text.length;
	append(&text, ",4096\n");
	refuse(fixture, text.text, text.length, "8:19375",
	       "found '4096', expected at most 4096 station");
	text.length = most;
	append_numbers(&text, 1000000, ",9");
	append(&text, "\n");
	refuse(fixture, text.text, text.length, "8:19375", "expected at most 4096 stations");
	/* The widest table there may be, and a row of it that is too long. */
	text.length = most;
	append(&text, "\n0");
	append_numbers(&text, 4096, ",0");
	append(&text, "\n1");
	append_numbers(&text, 4096, ",1");
	size_t whole = text.length;
	batten_hull *hull = parse(fixture, text.text, text.length);
	assert_int_equal(hull->station_count, 4096);
	batten_hull_destroy(hull);
	append_numbers(&text, 1000000, ",1");
	refuse(fixture, text.text, text.length, "10:8195", "found 1004097 cells, expected 4097");
	assert_true(whole > 0);
	text.length = 0;
	append(&text, GRID "z\\x,0,1\n");
	append_numbers(&text, 4096, "%zu,0,1\n");
	hull = parse(fixture, text.text, text.length);
	assert_int_equal(hull->waterline_count, 4096);
	batten_hull_destroy(hull);
	append(&text, "4096,0,1\n");
	refuse(fixture, text.text, text.length, "4105:1", "expected at most 4096 waterlines");
	text.length = 0;
	append(&text, LONG "station,x,z,y\n");
	append_numbers(&text, 4097, ",%zu,0,0\n");
	refuse(fixture, text.text, text.length, "4105:2", "expected at most 4096 stations");
	text.length = 0;
	append(&text, LONG "station,x,z,y\n");
	append_numbers(&text, 4097, ",0,%zu,0\n");
	refuse(fixture, text.text, text.length, "4105:4", "expected at most 4096 points on a line");
	text.length = 0;
	append(&text, GRID "z\\x,0,1\n0,0,0\n1,0,1\n");
	append_numbers(&text, 4097, "profile,deck,%zu,1,1\n");
	refuse(fixture, text.text, text.length, "4107:1", "expected at most 4096 such rows");
	text.length = 0;
	append(&text, "# batten-offsets: 1\n# name: ");
	append_numbers(&text, 4001, "n");
	append(&text, "\n# unit: m\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n# layout: grid\n");
	refuse(fixture, text.text, text.length, "2:9", "found a text of 4001 bytes");
	free(text.text);
}

/* ------------------------------------------------------------------------------------------------
 * Files
 * --------------------------------------------------------------------------------------------- */

static void fail_read(const struct fixture *fixture, const char *path, batten_status expected)
{
	batten_hull *hull = (batten_hull *)&tenths_x;
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

/* ------------------------------------------------------------------------------------------------
 * Failing allocations
 * --------------------------------------------------------------------------------------------- */

struct heap {
	size_t live, count, fail_at; /* number of the allocation that fails, from 1; 0 for none */
};

static void *allocate(size_t size, void *user)
{
	struct heap *heap = user;
	if (++heap->count == heap->fail_at)
		return NULL;
	heap->live++;
	return malloc(size);
}

static void release(void *memory, void *user)
{
	((struct heap *)user)->live--;
	free(memory);
}

static batten_status read_and_write(batten_context *context, const char *from, const char *to)
{
	batten_hull *hull = NULL;
	batten_status status = batten_hull_read(context, from, &hull);
	if (status == BATTEN_OK)
		status = batten_hull_write(context, hull, to);
	else
		assert_null(hull);
	batten_hull_destroy(hull);
	return status;
}

/* Lets every allocation of reading and writing the file fail once. */
static void fail_each(const struct fixture *fixture, const char *from)
{
	char to[256];
	struct heap heap = { 0 };
	batten_context_options options;
	batten_context_options_default(&options);
	options.allocate = allocate;
	options.release = release;
	options.allocate_user = &heap;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(&options, &context), BATTEN_OK);
	size_t before = heap.live;
	path_in(fixture, "written.csv", to);
	batten_status status = BATTEN_MEMORY;
	size_t failed = 0;
	for (; status != BATTEN_OK; failed++) {
		heap.count = 0;
		heap.fail_at = failed + 1;
		status = read_and_write(context, from, to);
		assert_true(status == BATTEN_OK || status == BATTEN_MEMORY);
		assert_int_equal(heap.live, before);
		if (status == BATTEN_MEMORY)
			assert_non_null(strstr(batten_context_error(context), "out of memory"));
	}
	assert_true(failed > 15);
	heap.fail_at = 0;
	batten_context_destroy(context);
	assert_int_equal(heap.live, 0);
}

static void failing_allocations(void **state)
{
	const struct fixture *fixture = *state;
	char path[256];
	fail_each(fixture, BATTEN_DATA_DIR "/hulls/npl_parent.csv");
	fail_each(fixture, BATTEN_DATA_DIR "/hulls/bsra_trawler.csv");
	fail_each(fixture, BATTEN_DATA_DIR "/hulls/highspeed_craft.csv");
	struct sheet sheet = { .length = 0 };
	make_long(&sheet, HULL_UNIT_FT, HULL_FRAME_GHS, false);
	batten_hull *hull = parse(fixture, sheet.text, sheet.length);
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
		cmocka_unit_test_setup_teardown(shipped_hulls, begin, end),
		cmocka_unit_test_setup_teardown(wigley_is_exact, begin, end),
		cmocka_unit_test_setup_teardown(every_unit_frame_and_layout, begin, end),
		cmocka_unit_test_setup_teardown(numbers_at_full_precision, begin, end),
		cmocka_unit_test_setup_teardown(hulls_from_arrays_are_written, begin, end),
		cmocka_unit_test_setup_teardown(spreadsheet_habits, begin, end),
		cmocka_unit_test_setup_teardown(wrong_headers, begin, end),
		cmocka_unit_test_setup_teardown(wrong_grids, begin, end),
		cmocka_unit_test_setup_teardown(wrong_lists_and_extras, begin, end),
		cmocka_unit_test_setup_teardown(no_text, begin, end),
		cmocka_unit_test_setup_teardown(limits, begin, end),
		cmocka_unit_test_setup_teardown(unusable_paths, begin, end),
		cmocka_unit_test_setup_teardown(full_disk, begin, end),
		cmocka_unit_test_setup_teardown(failing_allocations, begin, end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
