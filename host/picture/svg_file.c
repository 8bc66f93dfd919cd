#include "picture/svg_file.h"

#include "core/file.h"
#include "picture/paper.h"

#include <cairo-svg.h>
#include <string.h>

static cairo_status_t collect(void *closure, const unsigned char *data, unsigned length)
{
	svg_file *svg = closure;
	if (svg->failed)
		return CAIRO_STATUS_NO_MEMORY;
	if (svg->capacity - svg->length < length) {
		size_t capacity = 2 * (svg->length + length);
		char *larger = batten_allocate(svg->context, capacity, 1);
		if (!larger) {
			svg->failed = true;
			return CAIRO_STATUS_NO_MEMORY;
		}
		if (svg->length)
			memcpy(larger, svg->text, svg->length);
		batten_release(svg->context, svg->text);
		svg->text = larger;
		svg->capacity = capacity;
	}
	memcpy(svg->text + svg->length, data, length);
	svg->length += length;
	return CAIRO_STATUS_SUCCESS;
}

void svg_file_abandon(svg_file *svg)
{
	if (svg->cairo)
		cairo_destroy(svg->cairo);
	if (svg->surface)
		cairo_surface_destroy(svg->surface);
	batten_release(svg->context, svg->text);
	*svg = (svg_file){ .context = svg->context };
}

batten_status svg_file_begin(batten_context *context, double width, double height, svg_file *out)
{
	*out = (svg_file){ .context = context };
	out->surface = cairo_svg_surface_create_for_stream(collect, out, width, height);
	out->cairo = cairo_create(out->surface);
	batten_status status = paper_check(context, out->cairo);
	if (status != BATTEN_OK)
		svg_file_abandon(out);
	return status;
}

/* Cairo numbers its surfaces over the life of the process and writes that number; it is left out,
 * so that equal drawings are equal files. */
static void write_without_number(const svg_file *svg, FILE *stream)
{
	static const char mark[] = "id=\"surface";
	const char *end = svg->text + svg->length;
	const char *from = svg->text;
	const char *found = memmem(from, svg->length, mark, sizeof mark - 1);
	if (found) {
		const char *rest = found + sizeof mark - 1;
		(void)fwrite(from, 1, (size_t)(rest - from), stream);
		while (rest < end && *rest >= '0' && *rest <= '9')
			rest++;
		from = rest;
	}
	(void)fwrite(from, 1, (size_t)(end - from), stream);
}

batten_status svg_file_end(svg_file *svg, const char *path)
{
	batten_context *context = svg->context;
	batten_status status = paper_check(context, svg->cairo);
	cairo_destroy(svg->cairo);
	svg->cairo = NULL;
	cairo_surface_finish(svg->surface);
	if (status == BATTEN_OK &&
	    (svg->failed || cairo_surface_status(svg->surface) == CAIRO_STATUS_NO_MEMORY))
		status = batten_fail_memory(context);
	else if (status == BATTEN_OK && cairo_surface_status(svg->surface) != CAIRO_STATUS_SUCCESS)
		status = batten_fail(context, BATTEN_INTERNAL, "cairo: %s",
		                     cairo_status_to_string(cairo_surface_status(svg->surface)));
	batten_file file = { 0 };
	if (status == BATTEN_OK)
		status = batten_file_open(context, path, &file);
	if (status == BATTEN_OK) {
		write_without_number(svg, file.stream);
		status = batten_file_commit(context, &file);
	}
	svg_file_abandon(svg);
	return status;
}
