#include "report/hull_block.h"

#include "geometry/grid_curvature.h"
#include "hull/hull.h"
#include "report/hulls.h"
#include "report/out.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LARGEST = 32767, NOTHING = -32768, DRAFTS_MOST = 100 };

static const char *const quantities[] = {
	"volume_m3",
	"displacement_t",
	"wetted_surface_m2",
	"waterplane_area_m2",
	"lcb_pct_lbp_fwd",
	"lcf_pct_lbp_fwd",
	"kb_m",
	"kmt_m",
	"cb",
	"cp",
};

const char *report_hydrostatics_name(size_t i)
{
	return i < sizeof quantities / sizeof quantities[0] ? quantities[i] : NULL;
}

/* ---- arrays ---- */

/* Left out where they are those of the sweep. */
static void put_coordinates(FILE *stream, const char *name, const double *values, size_t count,
                            const double *of_sweep, size_t count_of_sweep)
{
	if (count == count_of_sweep && memcmp(values, of_sweep, count * sizeof *values) == 0)
		return;
	report_base64 out = { .stream = stream };
	(void)fprintf(stream, ",\"%s\":\"", name);
	for (size_t i = 0; i < count; i++)
		report_base64_f64(&out, values[i]);
	report_base64_end(&out);
	(void)fputc('"', stream);
}

static void put_curve(FILE *stream, const char *name, const double *values, size_t count)
{
	report_base64 out = { .stream = stream };
	(void)fprintf(stream, ",\"%s\":\"", name);
	for (size_t i = 0; i < count; i++)
		report_base64_f32(&out, (float)values[i]);
	report_base64_end(&out);
	(void)fputc('"', stream);
}

static void put_half_breadths(FILE *stream, const batten_hull *hull)
{
	report_base64 out = { .stream = stream };
	(void)fputs(",\"y_m\":\"", stream);
	for (size_t i = 0; i < hull_node_count(hull); i++)
		report_base64_f32(&out, hull->nodes[i] == BATTEN_NODE_OUTSIDE ? NAN : (float)hull->y_m[i]);
	report_base64_end(&out);
	(void)fputc('"', stream);
}

/* values where there is one (not NaN), in 32767ths of the largest. */
static void put_in_parts(FILE *stream, const char *name, const double *values, size_t count)
{
	double limit = 0.0;
	for (size_t i = 0; i < count; i++)
		if (isfinite(values[i]) && fabs(values[i]) > limit)
			limit = fabs(values[i]);
	report_base64 out = { .stream = stream };
	(void)fprintf(stream, ",\"%s_limit\":", name);
	report_put_number(stream, limit);
	(void)fprintf(stream, ",\"%s\":\"", name);
	for (size_t i = 0; i < count; i++)
		report_base64_i16(&out, !isfinite(values[i]) ? NOTHING
		                        : limit > 0.0        ? (int16_t)lround(values[i] / limit * LARGEST)
		                                             : 0);
	report_base64_end(&out);
	(void)fputc('"', stream);
}

static batten_status put_curvature(batten_context *context, FILE *stream, const batten_hull *hull)
{
	grid_curvature *grid = NULL;
	const batten_status status = grid_curvature_create(context, hull, &grid);
	if (status != BATTEN_OK)
		return status;
	/* Convex positive, as in the pictures. */
	for (size_t i = 0; i < hull_node_count(hull); i++)
		grid->mean_per_m[i] = grid->origin[i] == GRID_CURVATURE_NONE ? NAN : -grid->mean_per_m[i];
	put_in_parts(stream, "curvature_per_m", grid->mean_per_m, hull_node_count(hull));
	grid_curvature_destroy(context, grid);
	return BATTEN_OK;
}

static batten_status put_before(batten_context *context, FILE *stream, const batten_hull *hull,
                                const double *before_y_m)
{
	const size_t count = hull_node_count(hull);
	double *change = batten_allocate(context, count, sizeof *change);
	if (!change)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < count; i++)
		change[i] = hull->nodes[i] == BATTEN_NODE_OUTSIDE ? NAN : before_y_m[i] - hull->y_m[i];
	put_in_parts(stream, "before_m", change, count);
	batten_release(context, change);
	return BATTEN_OK;
}

/* ---- curves and hydrostatics ---- */

/* The curve of section areas up to the hull's draft; none where its draft is not within its table. */
static batten_status put_area_curve(batten_context *context, FILE *stream, const batten_hull *hull)
{
	const size_t most = hull->station_count + 2;
	double *x = batten_allocate(context, most, 2 * sizeof *x);
	size_t count = 0;
	if (!x)
		return BATTEN_MEMORY;
	const batten_status status = batten_hull_area_curve(
		context, hull, NULL, batten_hull_draft_m(hull), x, x + most, &count);
	if (status == BATTEN_OK) {
		put_curve(stream, "area_x_m", x, count);
		put_curve(stream, "area_m2", x + most, count);
	}
	batten_release(context, x);
	return status == BATTEN_MEMORY ? status : BATTEN_OK;
}

static batten_status put_draft(const report_database *database, sqlite3_stmt *row, FILE *stream)
{
	batten_status status = BATTEN_OK;
	double value = 0.0;
	(void)fputc('[', stream);
	for (size_t i = 0; status == BATTEN_OK && report_hydrostatics_name(i); i++) {
		int at = 0;
		const int count = sqlite3_column_count(row);
		while (at < count && strcmp(sqlite3_column_name(row, at), report_hydrostatics_name(i)) != 0)
			at++;
		value = NAN;
		if (at < count)
			status = report_number(database, row, at, "hydrostatics", &value);
		(void)fputs(i > 0 ? "," : "", stream);
		report_put_number(stream, value);
	}
	(void)fputc(']', stream);
	return status;
}

/* "drafts_m": [...], "hydrostatics": [[...], ...], by ascending draft. */
static batten_status put_hydrostatics(const report_database *database, const char *name,
                                      FILE *stream)
{
	sqlite3_stmt *statement = NULL;
	bool more = false;
	size_t count = 0;
	double drafts[DRAFTS_MOST];
	batten_status status = report_query(
		database, &statement, "SELECT draft_m, * FROM hydrostatics WHERE id = %s ORDER BY draft_m",
		name);
	if (status == BATTEN_OK)
		status = report_next(database, statement, &more);
	(void)fputs(",\"hydrostatics\":[", stream);
	while (status == BATTEN_OK && more && count < DRAFTS_MOST) {
		status = report_number(database, statement, 0, "hydrostatics: draft_m", &drafts[count]);
		(void)fputs(count++ > 0 ? "," : "", stream);
		if (status == BATTEN_OK)
			status = put_draft(database, statement, stream);
		if (status == BATTEN_OK)
			status = report_next(database, statement, &more);
	}
	sqlite3_finalize(statement);
	(void)fputs("],\"drafts_m\":[", stream);
	for (size_t i = 0; i < count; i++) {
		(void)fputs(i > 0 ? "," : "", stream);
		report_put_number(stream, drafts[i]);
	}
	(void)fputc(']', stream);
	return status;
}

batten_status hull_block_write(const report_sweep *sweep, const batten_hull *hull,
                               const double *before_y_m, const char *name, FILE *stream,
                               double *scale_per_m)
{
	batten_context *context = sweep->database->context;
	const bool is_design = strcmp(name, "parent") != 0;
	(void)fprintf(stream,
	              "<script type=\"application/json\" id=\"batten-hull-%s\">{\"draft_m\":", name);
	report_put_number(stream, batten_hull_draft_m(hull));
	(void)fputs(",\"lbp_m\":", stream);
	report_put_number(stream, batten_hull_lbp_m(hull));
	put_coordinates(stream, "x_m", hull->x_m, hull->station_count, sweep->x_m,
	                sweep->station_count);
	put_coordinates(stream, "z_m", hull->z_m, hull->waterline_count, sweep->z_m,
	                sweep->waterline_count);
	put_half_breadths(stream, hull);
	batten_status status = put_curvature(context, stream, hull);
	if (status == BATTEN_OK)
		status = batten_picture_scale(context, hull, scale_per_m);
	if (status == BATTEN_OK && before_y_m)
		status = put_before(context, stream, hull, before_y_m);
	if (status == BATTEN_OK)
		status = put_area_curve(context, stream, hull);
	if (status == BATTEN_OK && is_design)
		status = put_hydrostatics(sweep->database, name, stream);
	(void)fputs("}</script>\n", stream);
	return status;
}
