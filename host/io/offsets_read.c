/* Reads an offsets file (data/README.md describes the format). */
#include "core/file.h"
#include "io/offsets_frame.h"
#include "io/offsets_parts.h"

/* A table of 4096 by 4096 at full precision has about 320 MB. */
static const size_t largest_file = (size_t)512 << 20;

/* What the header says belongs to the hull from here on. */
static void take_header(batten_hull *hull, struct offsets_header *header)
{
	hull->name = header->name;
	hull->source = header->source;
	header->name = header->source = NULL;
	hull->unit = header->unit;
	hull->frame = header->frame;
	hull->lbp_m = header->lbp_m;
	hull->draft_m = header->draft_m;
	hull->depth_m = header->depth_m;
}

static batten_status fill(const struct offsets_scan *table, batten_hull *hull)
{
	size_t node = SIZE_MAX;
	size_t filled = 0;
	batten_status status = hull_find_unfillable(hull, &node);
	if (status == BATTEN_OK && node != SIZE_MAX)
		return offsets_fail_unfillable(table, hull, node);
	return status == BATTEN_OK ? hull_fill_unknown(hull, &filled) : status;
}

static batten_status read_hull(struct offsets_scan *scan, struct offsets_header *header,
                               batten_hull **out)
{
	const struct offsets_scan table = *scan;
	batten_hull *hull = NULL;
	batten_status status = offsets_refuse_late_keys(&table);
	if (status != BATTEN_OK)
		return status;
	status = header->layout == HULL_LAYOUT_GRID ? offsets_read_grid(scan, header, &hull)
	                                            : offsets_read_long(scan, header, &hull);
	if (status != BATTEN_OK)
		return status;
	take_header(hull, header);
	if (offsets_is_extra(scan))
		status = offsets_read_extras(scan, hull);
	if (status == BATTEN_OK)
		status = fill(&table, hull);
	if (status != BATTEN_OK) {
		batten_hull_destroy(hull);
		return status;
	}
	*out = hull;
	return BATTEN_OK;
}

batten_status batten_hull_parse(batten_context *context, const char *name, const char *text,
                                size_t length, batten_hull **out)
{
	*out = NULL;
	struct offsets_scan scan = { 0 };
	struct offsets_header header = { 0 };
	batten_status status = offsets_scan_begin(context, name, text, length,
	                                          "'# batten-offsets: 1' and a table", &scan);
	if (status == BATTEN_OK)
		status = offsets_read_header(&scan, &header);
	if (status == BATTEN_OK)
		status = read_hull(&scan, &header, out);
	offsets_header_release(context, &header);
	return status;
}

batten_status batten_hull_read(batten_context *context, const char *path, batten_hull **out)
{
	*out = NULL;
	char *text = NULL;
	size_t length = 0;
	batten_status status = batten_file_read(context, path, largest_file, &text, &length);
	if (status == BATTEN_OK)
		status = batten_hull_parse(context, path, text, length, out);
	batten_release(context, text);
	return status;
}
