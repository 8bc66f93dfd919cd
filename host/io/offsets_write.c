/* Writes an offsets file in the layout, frame and unit that the hull was read in. */
#include "core/file.h"
#include "io/offsets_frame.h"
#include "io/offsets_parts.h"

#include <math.h>

/* What the small functions below share. stdio keeps its error until the file is committed. */
struct writer {
	FILE *stream;
	const batten_hull *hull;
};

static void put(const struct writer *writer, const char *text)
{
	(void)fputs(text, writer->stream);
}

static void put_length(const struct writer *writer, double length_m)
{
	char text[BATTEN_NUMBER_SIZE];
	put(writer, offsets_length_out(writer->hull, length_m, text));
}

static void put_x(const struct writer *writer, double x_m)
{
	char text[BATTEN_NUMBER_SIZE];
	put(writer, offsets_x_out(writer->hull, x_m, text));
}

static void put_z(const struct writer *writer, double z_m)
{
	char text[BATTEN_NUMBER_SIZE];
	put(writer, offsets_z_out(writer->hull, z_m, text));
}

static void put_header(const struct writer *writer)
{
	const batten_hull *hull = writer->hull;
	(void)fprintf(writer->stream,
	              "# batten-offsets: 1\n# name: %s\n# unit: %s\n# frame: %s\n# lbp: ", hull->name,
	              hull_unit_text(hull->unit), hull_frame_text(hull->frame));
	put_length(writer, hull->lbp_m);
	put(writer, "\n# draft: ");
	put_length(writer, hull->draft_m);
	if (!isnan(hull->depth_m)) {
		put(writer, "\n# depth: ");
		put_length(writer, hull->depth_m);
	}
	(void)fprintf(writer->stream, "\n# layout: %s\n", batten_hull_layout(hull));
	if (hull->source[0])
		(void)fprintf(writer->stream, "# source: %s\n", hull->source);
}

static void put_node(const struct writer *writer, size_t node)
{
	if (writer->hull->nodes[node] == BATTEN_NODE_UNKNOWN)
		put(writer, "?");
	else if (writer->hull->nodes[node] == BATTEN_NODE_GIVEN)
		put_length(writer, writer->hull->y_m[node]);
}

static void put_grid(const struct writer *writer)
{
	const batten_hull *hull = writer->hull;
	size_t stations = hull->station_count;
	bool mirrored = offsets_frame_is_mirrored(hull->frame);
	put(writer, "z\\x");
	for (size_t i = 0; i < stations; i++) {
		put(writer, ",");
		put_x(writer, hull->x_m[mirrored ? stations - 1 - i : i]);
	}
	put(writer, "\n");
	for (size_t w = 0; w < hull->waterline_count; w++) {
		put_z(writer, hull->z_m[w]);
		for (size_t i = 0; i < stations; i++) {
			put(writer, ",");
			put_node(writer, w * stations + (mirrored ? stations - 1 - i : i));
		}
		put(writer, "\n");
	}
}

/* ------------------------------------------------------------------------------------------------
 * Long layouts
 * --------------------------------------------------------------------------------------------- */

/* The beginning of a row: label, coordinate of the line, coordinate along it. */
static void put_place(const struct writer *writer, bool waterlines, size_t line, double along_m)
{
	const batten_hull *hull = writer->hull;
	put(writer, hull->labels[line]);
	put(writer, ",");
	if (waterlines)
		put_z(writer, hull->z_m[line]);
	else
		put_x(writer, hull->x_m[line]);
	put(writer, ",");
	if (waterlines)
		put_x(writer, along_m);
	else
		put_z(writer, along_m);
	put(writer, ",");
}

static void put_end(const struct writer *writer, const hull_line_end *end)
{
	put_place(writer, end->on_waterline, end->line, end->along_m);
	put_length(writer, end->y_m);
	put(writer, "\n");
}

/* One line, merged of its nodes and its ends [first, last), in the order of the file. */
static void put_line(const struct writer *writer, size_t line, size_t first, size_t last,
                     bool backward)
{
	const batten_hull *hull = writer->hull;
	bool waterlines = hull->layout == HULL_LAYOUT_LONG_WATERLINES;
	const double *along = waterlines ? hull->x_m : hull->z_m;
	size_t count = waterlines ? hull->station_count : hull->waterline_count;
	size_t ends = last - first;
	size_t done = 0;
	for (size_t i = 0; i <= count; i++) {
		size_t place = backward ? count - 1 - i : i;
		for (; done < ends; done++) {
			const hull_line_end *end = &hull->ends[backward ? last - 1 - done : first + done];
			bool before = i == count ||
			              (backward ? end->along_m > along[place] : end->along_m < along[place]);
			if (!before)
				break;
			put_end(writer, end);
		}
		if (i == count)
			break;
		size_t node = waterlines ? line * hull->station_count + place
		                         : place * hull->station_count + line;
		if (hull->nodes[node] == BATTEN_NODE_OUTSIDE)
			continue;
		put_place(writer, waterlines, line, along[place]);
		put_node(writer, node);
		put(writer, "\n");
	}
}

/* Number of ends of the lines before this one. */
static size_t ends_before(const batten_hull *hull, size_t line)
{
	size_t low = 0;
	size_t high = hull->end_count;
	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (hull->ends[middle].line < line)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

static void put_list(const struct writer *writer)
{
	const batten_hull *hull = writer->hull;
	bool waterlines = hull->layout == HULL_LAYOUT_LONG_WATERLINES;
	bool mirrored = offsets_frame_is_mirrored(hull->frame);
	size_t lines = waterlines ? hull->waterline_count : hull->station_count;
	put(writer, waterlines ? "waterline,z,x,y\n" : "station,x,z,y\n");
	for (size_t i = 0; i < lines; i++) {
		size_t line = mirrored && !waterlines ? lines - 1 - i : i;
		put_line(writer, line, ends_before(hull, line), ends_before(hull, line + 1),
		         mirrored && waterlines);
	}
}

/* ------------------------------------------------------------------------------------------------
 * After the table
 * --------------------------------------------------------------------------------------------- */

static void put_extras(const struct writer *writer)
{
	const batten_hull *hull = writer->hull;
	for (size_t i = 0; i < hull->profile_count; i++) {
		const hull_profile_point *point = &hull->profile[i];
		(void)fprintf(writer->stream, "profile,%s,", offsets_profile_text(point->kind));
		put_x(writer, point->x_m);
		put(writer, ",");
		put_length(writer, point->y_m);
		put(writer, ",");
		put_z(writer, point->z_m);
		put(writer, "\n");
	}
	for (size_t i = 0; i < hull->knuckle_count; i++) {
		const hull_knuckle *knuckle = &hull->knuckles[i];
		put(writer, knuckle->on_waterline ? "knuckle,waterline," : "knuckle,station,");
		put_x(writer, knuckle->x_m);
		put(writer, ",");
		put_z(writer, knuckle->z_m);
		put(writer, "\n");
	}
}

batten_status batten_hull_write(batten_context *context, const batten_hull *hull, const char *path)
{
	batten_file file;
	batten_status status = batten_file_open(context, path, &file);
	if (status != BATTEN_OK)
		return status;
	const struct writer writer = { file.stream, hull };
	put_header(&writer);
	if (hull->layout == HULL_LAYOUT_GRID)
		put_grid(&writer);
	else
		put_list(&writer);
	put_extras(&writer);
	return batten_file_commit(context, &file);
}
