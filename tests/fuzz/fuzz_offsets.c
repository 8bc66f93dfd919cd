/* The reader of offsets files against arbitrary bytes. What it accepts must be a sound hull that is
 * written and read back unchanged; what it refuses must come with a message that names the place. */
#define FUZZ_PROGRAM "fuzz_offsets"
#include "fuzz.h"

#include <math.h>

static void check_ascending(const double *values, size_t count, const char *what)
{
	require(count >= 2 && count <= 4096, "count of lines", what);
	for (size_t i = 0; i < count; i++)
		require(isfinite(values[i]) && (i == 0 || values[i] > values[i - 1]), "order", what);
}

static void check_hull(const batten_hull *hull)
{
	size_t stations = batten_hull_station_count(hull);
	size_t waterlines = batten_hull_waterline_count(hull);
	check_ascending(batten_hull_x_m(hull), stations, "x");
	check_ascending(batten_hull_z_m(hull), waterlines, "z");
	for (size_t i = 0; i < stations * waterlines; i++) {
		double y = batten_hull_y_m(hull)[i];
		require(y >= 0 && isfinite(y), "half-breadth", "not 0 or more");
		require(batten_hull_nodes(hull)[i] <= BATTEN_NODE_UNKNOWN, "node", "of no known kind");
	}
	require(batten_hull_name(hull)[0] != '\0', "name", "empty");
	require(batten_hull_lbp_m(hull) > 0 && batten_hull_draft_m(hull) > 0, "length", "not above 0");
}

static void check_equal(const batten_hull *a, const batten_hull *b)
{
	size_t stations = batten_hull_station_count(a);
	size_t waterlines = batten_hull_waterline_count(a);
	size_t nodes = stations * waterlines;
	require(batten_hull_station_count(b) == stations &&
	            batten_hull_waterline_count(b) == waterlines,
	        "read back", "another size");
	require(memcmp(batten_hull_x_m(a), batten_hull_x_m(b), stations * sizeof(double)) == 0,
	        "read back", "another x");
	require(memcmp(batten_hull_z_m(a), batten_hull_z_m(b), waterlines * sizeof(double)) == 0,
	        "read back", "another z");
	require(memcmp(batten_hull_y_m(a), batten_hull_y_m(b), nodes * sizeof(double)) == 0,
	        "read back", "another y");
	require(memcmp(batten_hull_nodes(a), batten_hull_nodes(b), nodes) == 0, "read back",
	        "other nodes");
	require(strcmp(batten_hull_name(a), batten_hull_name(b)) == 0 &&
	            strcmp(batten_hull_source(a), batten_hull_source(b)) == 0 &&
	            batten_hull_lbp_m(a) == batten_hull_lbp_m(b) &&
	            batten_hull_draft_m(a) == batten_hull_draft_m(b),
	        "read back", "another header");
}

static void check_round_trip(batten_context *context, const batten_hull *hull)
{
	char path[FUZZ_PATH];
	temporary_path(path);
	batten_hull *again = NULL;
	require(batten_hull_write(context, hull, path) == BATTEN_OK, "write",
	        batten_context_error(context));
	require(batten_hull_read(context, path, &again) == BATTEN_OK, "read back",
	        batten_context_error(context));
	check_equal(hull, again);
	batten_hull_destroy(again);
	(void)unlink(path);
}

static void fuzz_one(batten_context *context, const uint8_t *data, size_t size)
{
	batten_hull *hull = NULL;
	batten_status status = batten_hull_parse(context, input_name, (const char *)data, size, &hull);
	if (status == BATTEN_OK) {
		check_hull(hull);
		check_round_trip(context, hull);
	} else {
		require(hull == NULL, "output of a refusal", "not NULL");
		check_message(status, batten_context_error(context));
	}
	batten_hull_destroy(hull);
}
