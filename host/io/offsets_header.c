/* The header of an offsets file: lines "# key: value" before the table. */
#include "io/offsets_frame.h"
#include "io/offsets_keys.h"
#include "io/offsets_parts.h"

#include <math.h>
#include <string.h>

enum key {
	KEY_VERSION,
	KEY_NAME,
	KEY_UNIT,
	KEY_FRAME,
	KEY_LBP,
	KEY_DRAFT,
	KEY_LAYOUT,
	KEY_DEPTH,
	KEY_SOURCE,
	KEY_COUNT,
};

static const char *const key_names[KEY_COUNT] = {
	"batten-offsets", "name", "unit", "frame", "lbp", "draft", "layout", "depth", "source",
};

/* What a key asks for; NULL where it may be left out. */
static const char *const key_wanted[KEY_COUNT] = {
	"1", "NAME", "m", "ap-fwd", "LENGTH", "LENGTH", "grid", NULL, NULL,
};

batten_status offsets_refuse_late_keys(const struct offsets_scan *table)
{
	return offsets_keys_refuse_late(table, key_names, KEY_COUNT);
}

static batten_status check_required(const struct offsets_scan *scan,
                                    const struct offsets_key entries[KEY_COUNT])
{
	for (int key = 0; key < KEY_COUNT; key++)
		if (key_wanted[key] && entries[key].line == 0)
			return offsets_fail_at(
				scan, scan->line, 1,
				"found no key '%s' up to here, expected a line '# %s: %s' before "
				"the table",
				key_names[key], key_names[key], key_wanted[key]);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Values
 * --------------------------------------------------------------------------------------------- */

/* The scan as it stood on the line of an entry, for messages. */
static struct offsets_scan scan_at(const struct offsets_scan *scan, const struct offsets_key *entry)
{
	struct offsets_scan place = *scan;
	place.line = entry->line;
	return place;
}

static batten_status take_words(const struct offsets_scan *scan, const struct offsets_key *entries,
                                struct offsets_header *out)
{
	struct offsets_scan place = scan_at(scan, &entries[KEY_VERSION]);
	const struct offsets_cell *cell = &entries[KEY_VERSION].cell;
	if (!offsets_cell_is(cell, "1"))
		return offsets_fail(&place, cell, "the version 1 of the format");
	place = scan_at(scan, &entries[KEY_UNIT]);
	cell = &entries[KEY_UNIT].cell;
	if (!offsets_unit_named(cell->text, cell->length, &out->unit))
		return offsets_fail(&place, cell, "a unit: m, mm or ft");
	place = scan_at(scan, &entries[KEY_FRAME]);
	cell = &entries[KEY_FRAME].cell;
	if (!offsets_frame_named(cell->text, cell->length, &out->frame))
		return offsets_fail(&place, cell, "a frame: ap-fwd, mid-fwd, fp-aft, ghs or waterline");
	place = scan_at(scan, &entries[KEY_LAYOUT]);
	cell = &entries[KEY_LAYOUT].cell;
	if (offsets_cell_is(cell, "grid"))
		out->layout = HULL_LAYOUT_GRID;
	else if (offsets_cell_is(cell, "long"))
		out->layout = HULL_LAYOUT_LONG_WATERLINES;
	else
		return offsets_fail(&place, cell, "a layout: grid or long");
	return BATTEN_OK;
}

static batten_status take_length(const struct offsets_scan *scan, const struct offsets_key *entry,
                                 const struct offsets_header *header, double *out_m)
{
	const struct offsets_scan place = scan_at(scan, entry);
	const batten_hull frame = offsets_header_hull(header);
	double value = 0;
	batten_status status = offsets_read_number(&place, &entry->cell, "a length above 0", &value);
	if (status != BATTEN_OK)
		return status;
	double length_m = offsets_length_in(&frame, value);
	if (!(length_m >= HULL_SMALLEST_STEP_M && length_m <= HULL_LARGEST_M))
		return offsets_fail(&place, &entry->cell, "a length above 0 and up to %g m",
		                    HULL_LARGEST_M);
	*out_m = length_m;
	return BATTEN_OK;
}

static batten_status take_texts(const struct offsets_scan *scan, const struct offsets_key *entries,
                                struct offsets_header *out)
{
	struct offsets_scan place = scan_at(scan, &entries[KEY_NAME]);
	const struct offsets_cell *name = &entries[KEY_NAME].cell;
	if (name->length == 0)
		return offsets_fail_at(&place, place.line, name->column,
		                       "found no name, expected the name of the hull");
	batten_status status = offsets_read_text(&place, name, &out->name);
	if (status != BATTEN_OK)
		return status;
	if (entries[KEY_SOURCE].line == 0)
		return hull_clean_text(scan->context, "", 0, &out->source);
	place = scan_at(scan, &entries[KEY_SOURCE]);
	return offsets_read_text(&place, &entries[KEY_SOURCE].cell, &out->source);
}

batten_hull offsets_header_hull(const struct offsets_header *header)
{
	return (batten_hull){ .unit = header->unit,
		                  .frame = header->frame,
		                  .layout = header->layout,
		                  .lbp_m = header->lbp_m,
		                  .draft_m = header->draft_m };
}

batten_status offsets_read_header(struct offsets_scan *scan, struct offsets_header *out)
{
	struct offsets_key entries[KEY_COUNT] = { 0 };
	struct offsets_header header = { .depth_m = NAN };
	batten_status status = offsets_keys_collect(scan, key_names, KEY_COUNT, entries);
	if (status == BATTEN_OK)
		status = check_required(scan, entries);
	if (status == BATTEN_OK)
		status = take_words(scan, entries, &header);
	if (status == BATTEN_OK)
		status = take_length(scan, &entries[KEY_LBP], &header, &header.lbp_m);
	if (status == BATTEN_OK)
		status = take_length(scan, &entries[KEY_DRAFT], &header, &header.draft_m);
	if (status == BATTEN_OK && entries[KEY_DEPTH].line > 0)
		status = take_length(scan, &entries[KEY_DEPTH], &header, &header.depth_m);
	if (status == BATTEN_OK)
		status = take_texts(scan, entries, &header);
	if (status != BATTEN_OK) {
		offsets_header_release(scan->context, &header);
		return status;
	}
	*out = header;
	return BATTEN_OK;
}

void offsets_header_release(batten_context *context, struct offsets_header *header)
{
	batten_release(context, header->name);
	batten_release(context, header->source);
	header->name = header->source = NULL;
}
