/* The grid of batten surface: everything that is known of a surface, a row a point. */
#include "surface_grid.h"

#include <math.h>
#include <stdlib.h>

enum { COLUMNS = 2 + BATTEN_SURFACE_VALUE_COUNT + 1 };

static const char *const columns[COLUMNS] = {
	"u",
	"v",
	[2 + BATTEN_SURFACE_VALUE_x] = "x_m",
	[2 + BATTEN_SURFACE_VALUE_y] = "y_m",
	[2 + BATTEN_SURFACE_VALUE_z] = "z_m",
	[2 + BATTEN_SURFACE_VALUE_x_u] = "x_u_m",
	[2 + BATTEN_SURFACE_VALUE_y_u] = "y_u_m",
	[2 + BATTEN_SURFACE_VALUE_z_u] = "z_u_m",
	[2 + BATTEN_SURFACE_VALUE_x_v] = "x_v_m",
	[2 + BATTEN_SURFACE_VALUE_y_v] = "y_v_m",
	[2 + BATTEN_SURFACE_VALUE_z_v] = "z_v_m",
	[2 + BATTEN_SURFACE_VALUE_x_uu] = "x_uu_m",
	[2 + BATTEN_SURFACE_VALUE_y_uu] = "y_uu_m",
	[2 + BATTEN_SURFACE_VALUE_z_uu] = "z_uu_m",
	[2 + BATTEN_SURFACE_VALUE_x_uv] = "x_uv_m",
	[2 + BATTEN_SURFACE_VALUE_y_uv] = "y_uv_m",
	[2 + BATTEN_SURFACE_VALUE_z_uv] = "z_uv_m",
	[2 + BATTEN_SURFACE_VALUE_x_vv] = "x_vv_m",
	[2 + BATTEN_SURFACE_VALUE_y_vv] = "y_vv_m",
	[2 + BATTEN_SURFACE_VALUE_z_vv] = "z_vv_m",
	[2 + BATTEN_SURFACE_VALUE_first_uu] = "first_uu_m2",
	[2 + BATTEN_SURFACE_VALUE_first_uv] = "first_uv_m2",
	[2 + BATTEN_SURFACE_VALUE_first_vv] = "first_vv_m2",
	[2 + BATTEN_SURFACE_VALUE_area] = "area_m2",
	[2 + BATTEN_SURFACE_VALUE_normal_x] = "normal_x",
	[2 + BATTEN_SURFACE_VALUE_normal_y] = "normal_y",
	[2 + BATTEN_SURFACE_VALUE_normal_z] = "normal_z",
	[2 + BATTEN_SURFACE_VALUE_second_uu] = "second_uu_m",
	[2 + BATTEN_SURFACE_VALUE_second_uv] = "second_uv_m",
	[2 + BATTEN_SURFACE_VALUE_second_vv] = "second_vv_m",
	[2 + BATTEN_SURFACE_VALUE_gauss] = "gauss_per_m2",
	[2 + BATTEN_SURFACE_VALUE_mean] = "mean_per_m",
	[2 + BATTEN_SURFACE_VALUE_k1] = "k1_per_m",
	[2 + BATTEN_SURFACE_VALUE_k2] = "k2_per_m",
	[2 + BATTEN_SURFACE_VALUE_bending] = "bending_per_m2",
	[2 + BATTEN_SURFACE_VALUE_direction1_x] = "direction1_x",
	[2 + BATTEN_SURFACE_VALUE_direction1_y] = "direction1_y",
	[2 + BATTEN_SURFACE_VALUE_direction1_z] = "direction1_z",
	[2 + BATTEN_SURFACE_VALUE_direction2_x] = "direction2_x",
	[2 + BATTEN_SURFACE_VALUE_direction2_y] = "direction2_y",
	[2 + BATTEN_SURFACE_VALUE_direction2_z] = "direction2_z",
	[2 + BATTEN_SURFACE_VALUE_along_x] = "along_x_per_m",
	[2 + BATTEN_SURFACE_VALUE_across_x] = "across_x_per_m",
	[2 + BATTEN_SURFACE_VALUE_isophote] = "isophote",
	[2 + BATTEN_SURFACE_VALUE_COUNT] = "singular",
};

/* A grid at work: count parameters a direction, values [value][v][u] and rows made of them. */
typedef struct grid {
	size_t u_count, v_count;
	double *u, *v, *values, *rows;
	uint8_t *singular;
} grid;

void surface_grid_spread(const batten_surface *surface, batten_direction direction, size_t count,
                         double *at)
{
	double first = 0.0;
	double last = 0.0;
	batten_surface_range(surface, direction, &first, &last);
	for (size_t n = 0; n < count; n++)
		at[n] = n + 1 == count ? last
		                       : first + (last - first) * ((double)n / ((double)count - 1.0));
}

/* Without a normal what needs it is not known: empty cells. */
static void fill_rows(const grid *g)
{
	const size_t points = g->u_count * g->v_count;
	for (size_t p = 0; p < points; p++) {
		double *row = g->rows + p * COLUMNS;
		row[0] = g->u[p % g->u_count];
		row[1] = g->v[p / g->u_count];
		for (size_t c = 0; c < BATTEN_SURFACE_VALUE_COUNT; c++)
			row[2 + c] = g->singular[p] && c >= BATTEN_SURFACE_VALUE_area
			                 ? NAN
			                 : g->values[c * points + p];
		row[COLUMNS - 1] = g->singular[p];
	}
}

static batten_status write_grid(batten_context *context, const batten_surface *surface,
                                const char *path, const grid *g)
{
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE; /* one surface: no kernel is worth its compilation */
	options.output = BATTEN_SURFACE_EVERYTHING;
	surface_grid_spread(surface, BATTEN_DIRECTION_U, g->u_count, g->u);
	surface_grid_spread(surface, BATTEN_DIRECTION_V, g->v_count, g->v);
	const batten_surface_samples samples = { g->u_count, g->v_count, g->u, g->v };
	const batten_status status = batten_surface_grid_batch(context, 1, &surface, &samples, &options,
	                                                       g->values, g->singular, NULL);
	if (status != BATTEN_OK)
		return status;
	fill_rows(g);
	const batten_table table = { .name = batten_surface_describe(surface).name,
		                         .column_count = COLUMNS,
		                         .row_count = g->u_count * g->v_count,
		                         .columns = columns,
		                         .values = g->rows };
	return batten_table_write(context, &table, path);
}

batten_status surface_grid_write(batten_context *context, const batten_surface *surface,
                                 size_t u_count, size_t v_count, const char *path)
{
	const size_t points = u_count * v_count;
	grid g = { .u_count = u_count, .v_count = v_count };
	g.u = calloc(u_count, sizeof *g.u);
	g.v = calloc(v_count, sizeof *g.v);
	g.values = calloc(points, BATTEN_SURFACE_VALUE_COUNT * sizeof *g.values);
	g.rows = calloc(points, COLUMNS * sizeof *g.rows);
	g.singular = calloc(points, sizeof *g.singular);
	const batten_status status = g.u && g.v && g.values && g.rows && g.singular
	                                 ? write_grid(context, surface, path, &g)
	                                 : BATTEN_MEMORY;
	free(g.u);
	free(g.v);
	free(g.values);
	free(g.rows);
	free(g.singular);
	return status;
}
