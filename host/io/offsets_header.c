/* The header of an offsets file: lines "# key: value" before the table. */
#include "io/offsets_frame.h"
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

/* The value of each key as it stands in the file, line 0 where there is none yet. The unit may
 * follow the lengths, so nothing is converted before the last key. */
struct entry {
	struct offsets_cell cell;
	size_t line;
};

static bool is_blank(char letter)
{
	return letter == ' ' || letter == '\t';
}

/* Takes "# key: value" apart. False for any other comment. Blanks and commas at the end, as
 * spreadsheets leave them, are no part of the value. */
static bool split_key(const struct offsets_scan *scan, enum key *key, struct offsets_cell *value)
{
	const char *row = scan->row;
	size_t end = scan->row_length;
	size_t first = 1;
	while (first < end && is_blank(row[first]))
		first++;
	const char *colon = first < end ? memchr(row + first, ':', end - first) : NULL;
	if (!colon)
		return false;
	size_t length = (size_t)(colon - (row + first));
	while (length > 0 && is_blank(row[first + length - 1]))
		length--;
	const struct offsets_cell name = { row + first, length, first + 1 };
	int found = 0;
	while (found < KEY_COUNT && !offsets_cell_is(&name, key_names[found]))
		found++;
	if (found == KEY_COUNT)
		return false;
	first = (size_t)(colon - row) + 1;
	while (first < end && is_blank(row[first]))
		first++;
	while (end > first && (is_blank(row[end - 1]) || row[end - 1] == ','))
		end--;
	*key = (enum key)found;
	*value = (struct offsets_cell){ row + first, end - first, first + 1 };
	return true;
}

/* Reads all comment lines up to the table; the scan then stands on the table's first row. */
static batten_status collect_entries(struct offsets_scan *scan, struct entry entries[KEY_COUNT])
{
	while (offsets_next_line(scan)) {
		if (!offsets_is_comment(scan)) {
			if (offsets_is_blank(scan))
				continue;
			return BATTEN_OK;
		}
		enum key key = KEY_VERSION;
		struct offsets_cell value;
		if (!split_key(scan, &key, &value))
			continue;
		if (entries[key].line > 0)
			return offsets_fail_at(scan, scan->line, 1,
			                       "found the key '%s' again, expected it once (line %zu has it)",
			                       key_names[key], entries[key].line);
		entries[key] = (struct entry){ value, scan->line };
	}
	/* No table: an empty row stands for it. */
	scan->line++;
	scan->row = scan->text + scan->length;
	scan->row_length = 0;
	scan->place = 0;
	return BATTEN_OK;
}

batten_status offsets_refuse_late_keys(const struct offsets_scan *table)
{
	struct offsets_scan scan = *table;
	while (offsets_next_line(&scan)) {
		enum key key = KEY_VERSION;
		struct offsets_cell value;
		if (offsets_is_comment(&scan) && split_key(&scan, &key, &value))
			return offsets_fail_at(&scan, scan.line, 1,
			                       "found the key '%s' after the table began, expected it before",
			                       key_names[key]);
	}
	return BATTEN_OK;
}

static batten_status check_required(const struct offsets_scan *scan,
                                    const struct entry entries[KEY_COUNT])
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
static struct offsets_scan scan_at(const struct offsets_scan *scan, const struct entry *entry)
{
	struct offsets_scan place = *scan;
	place.line = entry->line;
	return place;
}

static batten_status take_words(const struct offsets_scan *scan, const struct entry *entries,
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

static batten_status take_length(const struct offsets_scan *scan, const struct entry *entry,
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

static batten_status take_texts(const struct offsets_scan *scan, const struct entry *entries,
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
	struct entry entries[KEY_COUNT] = { 0 };
	struct offsets_header header = { .depth_m = NAN };
	batten_status status = collect_entries(scan, entries);
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
