/* The reader of line files against arbitrary bytes. What it accepts must be sound points with
 * a spline that can be measured; what it refuses must come with a message that names the place. */
#define FUZZ_PROGRAM "fuzz_points"
#include "fuzz.h"

#include <math.h>

static void check_points(const batten_points *points)
{
	size_t dimension = batten_points_dimension(points);
	size_t count = batten_points_count(points);
	require(dimension == 2 || dimension == 3, "dimension", "neither 2 nor 3");
	require(count >= 2 && count <= 4096, "count of points", "beyond 2..4096");
	for (size_t i = 0; i < count * dimension; i++)
		require(fabs(batten_points_m(points)[i]) <= 1e6, "coordinate", "beyond 1e6 m");
}

/* What is written is read back: a spline's samples. */
static void check_round_trip(batten_context *context, const batten_points *points)
{
	char path[FUZZ_PATH];
	temporary_path(path);
	batten_curve *curve = NULL;
	batten_points *again = NULL;
	batten_status status = batten_curve_create(context, points, NULL, &curve);
	/* Chords may add up to nothing beside a very long one. */
	require(status == BATTEN_OK || status == BATTEN_USAGE, "spline", batten_context_error(context));
	if (status != BATTEN_OK)
		return;
	batten_curve_measures measures;
	require(batten_curve_measure(context, curve, &measures) == BATTEN_OK, "measure",
	        batten_context_error(context));
	require(measures.length_m > 0 && isfinite(measures.length_m), "length", "not above 0");
	require(batten_curve_write(context, curve, 3, path) == BATTEN_OK, "write",
	        batten_context_error(context));
	status = batten_points_read(context, path, &again);
	/* Samples of a loop may fall together, or swing beyond what a file may hold. */
	require(status == BATTEN_OK || status == BATTEN_INPUT, "read back",
	        batten_context_error(context));
	batten_points_destroy(again);
	batten_curve_destroy(curve);
	(void)unlink(path);
}

static void fuzz_one(batten_context *context, const uint8_t *data, size_t size)
{
	batten_points *points = NULL;
	batten_status status = batten_points_parse(context, input_name, (const char *)data, size,
	                                           &points);
	if (status == BATTEN_OK) {
		check_points(points);
		check_round_trip(context, points);
	} else {
		require(points == NULL, "output of a refusal", "not NULL");
		check_message(status, batten_context_error(context));
	}
	batten_points_destroy(points);
}
