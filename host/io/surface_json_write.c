/* surface.json, written: every number as the shortest decimal that reads back. */
#include "core/file.h"
#include "core/number.h"
#include "geometry/surface.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>

/* stdio keeps its error until the file is committed. */
static void put_number(FILE *stream, double value)
{
	char text[BATTEN_NUMBER_SIZE];
	/* JSON reads -0 as an integer, which has no sign there. */
	(void)fputs(value == 0.0 && signbit(value) ? "-0.0" : batten_number_write(text, value), stream);
}

static void put_numbers(FILE *stream, size_t count, const double *values)
{
	(void)fputc('[', stream);
	for (size_t i = 0; i < count; i++) {
		(void)fputs(i > 0 ? ", " : "", stream);
		put_number(stream, values[i]);
	}
	(void)fputc(']', stream);
}

static void put_poles(FILE *stream, const struct batten_surface *surface)
{
	(void)fputs(",\n  \"poles\": [", stream);
	for (size_t j = 0; j < surface->count_v; j++) {
		(void)fputs(j > 0 ? ",\n    [" : "\n    [", stream);
		for (size_t i = 0; i < surface->count_u; i++) {
			(void)fputs(i > 0 ? ",\n      " : "\n      ", stream);
			put_numbers(stream, 3, surface->poles + 3 * (j * surface->count_u + i));
		}
		(void)fputs("\n    ]", stream);
	}
	(void)fputs("\n  ]", stream);
}

static void put_weights(FILE *stream, const struct batten_surface *surface)
{
	(void)fputs(",\n  \"weights\": [", stream);
	for (size_t j = 0; j < surface->count_v; j++) {
		(void)fputs(j > 0 ? ",\n    " : "\n    ", stream);
		put_numbers(stream, surface->count_u, surface->weights + j * surface->count_u);
	}
	(void)fputs("\n  ]", stream);
}

static void put_surface(FILE *stream, const struct batten_surface *surface, const char *name)
{
	(void)fprintf(stream,
	              "{\n  \"batten_surface\": 1,\n  \"name\": %s,\n  \"unit\": \"m\",\n"
	              "  \"frame\": \"ap-fwd\",\n  \"order_u\": %zu,\n  \"order_v\": %zu,\n"
	              "  \"count_u\": %zu,\n  \"count_v\": %zu,\n  \"knots_u\": ",
	              name, surface->order_u, surface->order_v, surface->count_u, surface->count_v);
	put_numbers(stream, surface->count_u + surface->order_u, surface->knots_u);
	(void)fputs(",\n  \"knots_v\": ", stream);
	put_numbers(stream, surface->count_v + surface->order_v, surface->knots_v);
	put_poles(stream, surface);
	if (surface->weights)
		put_weights(stream, surface);
	(void)fputs("\n}\n", stream);
}

batten_status batten_surface_write(batten_context *context, const batten_surface *surface,
                                   const char *path)
{
	json_t *text = json_string(surface->name);
	char *name = text ? json_dumps(text, JSON_ENCODE_ANY) : NULL;
	json_decref(text);
	if (!name)
		return batten_fail(context, BATTEN_USAGE, "%s: the surface's name is not UTF-8 text", path);
	batten_file file;
	batten_status status = batten_file_open(context, path, &file);
	if (status == BATTEN_OK) {
		put_surface(file.stream, surface, name);
		status = batten_file_commit(context, &file);
	}
	free(name);
	return status;
}
