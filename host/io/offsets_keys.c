#include "io/offsets_keys.h"

#include <string.h>

static bool is_blank(char letter)
{
	return letter == ' ' || letter == '\t';
}

/* Takes "# key: value" apart. False for any other comment. Blanks and commas at the end, as
 * spreadsheets leave them, are no part of the value. */
static bool split_key(const struct offsets_scan *scan, const char *const *names, size_t count,
                      size_t *key, struct offsets_cell *value)
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
	size_t found = 0;
	while (found < count && !offsets_cell_is(&name, names[found]))
		found++;
	if (found == count)
		return false;
	first = (size_t)(colon - row) + 1;
	while (first < end && is_blank(row[first]))
		first++;
	while (end > first && (is_blank(row[end - 1]) || row[end - 1] == ','))
		end--;
	*key = found;
	*value = (struct offsets_cell){ row + first, end - first, first + 1 };
	return true;
}

batten_status offsets_keys_collect(struct offsets_scan *scan, const char *const *names,
                                   size_t count, struct offsets_key *keys)
{
	while (offsets_next_line(scan)) {
		if (!offsets_is_comment(scan)) {
			if (offsets_is_blank(scan))
				continue;
			return BATTEN_OK;
		}
		size_t key = 0;
		struct offsets_cell value;
		if (!split_key(scan, names, count, &key, &value))
			continue;
		if (keys[key].line > 0)
			return offsets_fail_at(scan, scan->line, 1,
			                       "found the key '%s' again, expected it once (line %zu has it)",
			                       names[key], keys[key].line);
		keys[key] = (struct offsets_key){ value, scan->line };
	}
	/* No table: an empty row stands for it. */
	scan->line++;
	scan->row = scan->text + scan->length;
	scan->row_length = 0;
	scan->place = 0;
	return BATTEN_OK;
}

batten_status offsets_keys_refuse_late(const struct offsets_scan *table, const char *const *names,
                                       size_t count)
{
	struct offsets_scan scan = *table;
	while (offsets_next_line(&scan)) {
		size_t key = 0;
		struct offsets_cell value;
		if (offsets_is_comment(&scan) && split_key(&scan, names, count, &key, &value))
			return offsets_fail_at(&scan, scan.line, 1,
			                       "found the key '%s' after the table began, expected it before",
			                       names[key]);
	}
	return BATTEN_OK;
}
