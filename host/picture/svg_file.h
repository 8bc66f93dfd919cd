/* Drawings out as SVG. */
#ifndef BATTEN_PICTURE_SVG_FILE_H
#define BATTEN_PICTURE_SVG_FILE_H

#include "core/context.h"

#include <cairo.h>

/* A drawing in the making: cairo writes into memory. */
typedef struct svg_file {
	batten_context *context;
	char *text;
	size_t length, capacity;
	bool failed; /* out of memory while cairo wrote */
	cairo_surface_t *surface;
	cairo_t *cairo;
} svg_file;

/* Errors: MEMORY, INTERNAL. On failure nothing needs to be ended. */
batten_status svg_file_begin(batten_context *context, double width, double height, svg_file *out);
/* Writes the drawing to path, at once or not at all, and releases it. The bytes depend on nothing
 * but what was drawn. Errors: IO, MEMORY, INTERNAL. */
batten_status svg_file_end(svg_file *svg, const char *path);
/* Releases an unfinished drawing. */
void svg_file_abandon(svg_file *svg);

#endif
