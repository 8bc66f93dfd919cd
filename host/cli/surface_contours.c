/* The lines of batten surface: where values of a surface have given levels, a row a point. */
#include "surface_contours.h"

#include "surface_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 8, NAME_MOST = 20 };

static const char *const columns[COLUMNS] = { "level", "line", "closed", "u",
	                                          "v",     "x_m",  "y_m",    "z_m" };
static const char *const text_columns[] = { "of" };

static const char *const names[] = {
#define NAME(name, text) #name,
	BATTEN_SURFACE_VALUE_LIST(NAME)
#undef NAME
};

/* One name and its level; the end of both, NULL where there are none. */
static const char *read_level(const char *text, contour_level *out)
{
	const size_t length = strcspn(text, "=");
	for (size_t n = 0; n < BATTEN_SURFACE_VALUE_COUNT; n++) {
		if (text[length] != '=' || strlen(names[n]) != length ||
		    strncmp(text, names[n], length) != 0)
			continue;
		char *end = NULL;
		*out = (contour_level){ (batten_surface_value)n, strtod(text + length + 1, &end) };
		return end != text + length + 1 && isfinite(out->level) ? end : NULL;
	}
	return NULL;
}

bool surface_contours_read(const char *text, contour_level *levels, size_t *count)
{
	for (*count = 0; *count < CONTOURS_MOST;) {
		text = read_level(text, &levels[*count]);
		if (!text)
			return false;
		++*count;
		if (*text == '\0')
			return true;
		if (*text++ != ',')
			return false;
	}
	return false;
}

/* The table as it grows. */
typedef struct growing {
	size_t count, room; /* rows */
	double *rows;
	const char **texts;
} growing;

static bool make_room(growing *g, size_t more)
{
	if (g->count + more <= g->room)
		return true;
	const size_t room = 2 * (g->count + more);
	double *rows = realloc(g->rows, room * COLUMNS * sizeof *rows);
	if (rows)
		g->rows = rows;
	const char **texts = realloc(g->texts, room * sizeof *texts);
	if (texts)
		g->texts = texts;
	if (rows && texts)
		g->room = room;
	return rows && texts;
}

static bool add_line(growing *g, const contour_level *at, size_t number, batten_contour line)
{
	if (!make_room(g, line.count))
		return false;
	for (size_t p = 0; p < line.count; p++, g->count++) {
		const double row[COLUMNS] = { at->level,
			                          (double)number,
			                          line.closed,
			                          line.u[p],
			                          line.v[p],
			                          line.points_m[3 * p],
			                          line.points_m[3 * p + 1],
			                          line.points_m[3 * p + 2] };
		memcpy(g->rows + g->count * COLUMNS, row, sizeof row);
		g->texts[g->count] = names[at->value];
	}
	return true;
}

static batten_status add_level(batten_context *context, const batten_surface *surface,
                               const batten_surface_samples *samples, const contour_level *at,
                               growing *g)
{
	batten_contours *contours = NULL;
	batten_status status = batten_surface_contour(context, surface, at->value, at->level, samples,
	                                              &contours);
	if (status != BATTEN_OK)
		return status;
	for (size_t n = 0; n < batten_contours_count(contours) && status == BATTEN_OK; n++)
		if (!add_line(g, at, n + 1, batten_contours_at(contours, n)))
			status = BATTEN_MEMORY;
	batten_contours_destroy(contours);
	return status;
}

batten_status surface_contours_write(batten_context *context, const batten_surface *surface,
                                     size_t u_count, size_t v_count, const contour_level *levels,
                                     size_t count, const char *path)
{
	growing g = { 0 };
	double *u = calloc(u_count, sizeof *u);
	double *v = calloc(v_count, sizeof *v);
	batten_status status = u && v ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		surface_grid_spread(surface, BATTEN_DIRECTION_U, u_count, u);
		surface_grid_spread(surface, BATTEN_DIRECTION_V, v_count, v);
		const batten_surface_samples samples = { u_count, v_count, u, v };
		for (size_t n = 0; n < count && status == BATTEN_OK; n++)
			status = add_level(context, surface, &samples, &levels[n], &g);
	}
	if (status == BATTEN_OK) {
		const batten_table table = { .name = batten_surface_describe(surface).name,
			                         .column_count = COLUMNS,
			                         .row_count = g.count,
			                         .columns = columns,
			                         .values = g.rows,
			                         .text_count = 1,
			                         .text_columns = text_columns,
			                         .texts = g.texts };
		status = batten_table_write(context, &table, path);
	}
	free(u);
	free(v);
	free(g.rows);
	free((void *)g.texts);
	return status;
}
