/* What the tests of variation share: contexts, hulls, variants, the printed tables of the trawler. */
#ifndef BATTEN_TESTS_VARY_FIXTURE_H
#define BATTEN_TESTS_VARY_FIXTURE_H

#include "batten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline int make_context(void **state)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	*state = context;
	return 0;
}

static inline int end_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

static inline batten_hull *read_hull(batten_context *context, const char *name)
{
	char path[4096];
	batten_hull *hull = NULL;
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	if (batten_hull_read(context, path, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static inline batten_vary_options method(batten_vary_method which)
{
	batten_vary_options options;
	batten_vary_options_default(&options);
	options.method = which;
	return options;
}

static inline batten_hull *vary(batten_context *context, const batten_hull *parent,
                                const batten_vary_options *options, batten_vary_outcome *outcome)
{
	batten_hull *variant = NULL;
	if (batten_hull_vary(context, parent, options, &variant, outcome) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	assert_non_null(variant);
	return variant;
}

static inline batten_measures measures_of(batten_context *context, const batten_hull *hull)
{
	batten_measures measures;
	if (batten_hull_measure(context, hull, NULL, &measures) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return measures;
}

static inline double parameter(const batten_vary_outcome *outcome, const char *name)
{
	for (size_t i = 0; i < outcome->parameter_count; i++)
		if (strcmp(outcome->parameters[i].name, name) == 0)
			return outcome->parameters[i].value;
	fail_msg("no parameter %s", name);
	return NAN;
}

static inline void assert_near(double value, double expected, double tolerance, const char *what)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%s: found %.17g, expected %.17g within %g", what, value, expected, tolerance);
}

/* A lattice about the whole of a hull whose poles, at their Greville places, move by an affine map:
 * x += by[0] x, y += by[1] y, z += by[2] z. */
static inline batten_lattice *affine_lattice(batten_context *context, const batten_hull *hull,
                                             const double by[3])
{
	enum { X = 5, Y = 3, Z = 4 };
	static double shift[Z][Y][X][3];
	static const double at_x[X] = { 0, 1.0 / 6, 0.5, 5.0 / 6, 1 }, at_y[Y] = { 0, 0.5, 1 };
	static const double at_z[Z] = { 0, 1.0 / 3, 2.0 / 3, 1 };
	const size_t stations = batten_hull_station_count(hull);
	const size_t waterlines = batten_hull_waterline_count(hull);
	batten_lattice_net net = {
		.from_m = { batten_hull_x_m(hull)[0] - 1, 0, batten_hull_z_m(hull)[0] - 0.5 },
		.to_m = { batten_hull_x_m(hull)[stations - 1] + 2, 1.5 * batten_hull_half_beam_m(hull),
		          batten_hull_z_m(hull)[waterlines - 1] + 1 },
		.count = { X, Y, Z },
		.order = { 4, 2, 4 },
		.shift_m = &shift[0][0][0][0],
	};
	for (size_t k = 0; k < Z; k++)
		for (size_t j = 0; j < Y; j++)
			for (size_t i = 0; i < X; i++) {
				const double part[3] = { at_x[i], at_y[j], at_z[k] };
				for (size_t c = 0; c < 3; c++)
					shift[k][j][i][c] = by[c] *
					                    (net.from_m[c] + part[c] * (net.to_m[c] - net.from_m[c]));
			}
	batten_lattice *lattice = NULL;
	assert_int_equal(batten_lattice_create(context, &net, &lattice), BATTEN_OK);
	return lattice;
}

/* Half-breadth at a place of the table, 0 outside. */
static inline double offset_at(const batten_hull *hull, double x_m, double z_m)
{
	const size_t stations = batten_hull_station_count(hull);
	for (size_t w = 0; w < batten_hull_waterline_count(hull); w++)
		for (size_t s = 0; s < stations; s++)
			if (fabs(batten_hull_x_m(hull)[s] - x_m) < 1e-6 &&
			    fabs(batten_hull_z_m(hull)[w] - z_m) < 1e-6)
				return batten_hull_nodes(hull)[w * stations + s] == BATTEN_NODE_OUTSIDE
				           ? 0
				           : batten_hull_y_m(hull)[w * stations + s];
	fail_msg("no station at %g or no waterline at %g", x_m, z_m);
	return NAN;
}

/* ------------------------------------------------------------------------------------------------
 * Printed tables of the trawler
 * --------------------------------------------------------------------------------------------- */

struct printed {
	size_t count;
	double x_m[256], z_m[256], y_m[256];
};

/* A column of a table of tests/data/tables; damaged rows and empty cells are left out. */
static inline void read_column(const char *table, const char *column, struct printed *out)
{
	char path[4096], line[512];
	(void)snprintf(path, sizeof path, "%s/../tests/data/tables/%s.csv", BATTEN_DATA_DIR, table);
	FILE *file = fopen(path, "r");
	assert_non_null(file);
	size_t number = 0;
	out->count = 0;
	while (fgets(line, sizeof line, file)) {
		char *cells[8] = { line };
		size_t cell_count = 1;
		line[strcspn(line, "\n")] = '\0';
		if (line[0] == '#')
			continue;
		for (char *c = line; *c && cell_count < 8; c++)
			if (*c == ',') {
				*c = '\0';
				cells[cell_count++] = c + 1;
			}
		if (number == 0) {
			while (number < cell_count && strcmp(cells[number], column) != 0)
				number++;
			assert_true(number >= 2 && number < cell_count);
			continue;
		}
		const bool damaged = cell_count > 5 && cells[5][0] != '\0';
		if (damaged || cells[number][0] == '\0')
			continue;
		assert_true(out->count < 256);
		out->x_m[out->count] = 3.048 * strtod(cells[0], NULL);
		out->z_m[out->count] = strtod(cells[1], NULL);
		out->y_m[out->count] = strtod(cells[number], NULL);
		out->count++;
	}
	(void)fclose(file);
}

struct difference {
	double max_m, rms_m;
};

static inline struct difference differ(const batten_hull *hull, const char *table,
                                       const char *column)
{
	static struct printed printed;
	struct difference found = { 0 };
	read_column(table, column, &printed);
	assert_true(printed.count >= 120);
	for (size_t i = 0; i < printed.count; i++) {
		const double off = offset_at(hull, printed.x_m[i], printed.z_m[i]) - printed.y_m[i];
		found.max_m = fmax(found.max_m, fabs(off));
		found.rms_m += off * off;
	}
	found.rms_m = sqrt(found.rms_m / (double)printed.count);
	return found;
}

#endif
