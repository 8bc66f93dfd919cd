#include "io/offsets_scan.h"

#include "core/number.h"
#include "hull/hull.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { QUOTED_MOST = 40, MESSAGE_SIZE = 512 };

/* ------------------------------------------------------------------------------------------------
 * Errors
 * --------------------------------------------------------------------------------------------- */

batten_status offsets_fail_at(const struct offsets_scan *scan, size_t line, size_t column,
                              const char *message, ...)
{
	char text[MESSAGE_SIZE];
	va_list arguments;
	va_start(arguments, message);
	(void)vsnprintf(text, sizeof text, message, arguments);
	va_end(arguments);
	return batten_fail(scan->context, BATTEN_INPUT, "%s:%zu:%zu: %s", scan->name, line, column,
	                   text);
}

batten_status offsets_fail(const struct offsets_scan *scan, const struct offsets_cell *cell,
                           const char *expected, ...)
{
	char text[MESSAGE_SIZE];
	va_list arguments;
	va_start(arguments, expected);
	(void)vsnprintf(text, sizeof text, expected, arguments);
	va_end(arguments);
	if (cell->length == 0)
		return offsets_fail_at(scan, scan->line, cell->column, "found an empty cell, expected %s",
		                       text);
	bool cut = cell->length > QUOTED_MOST;
	size_t shown = cut ? QUOTED_MOST : cell->length;
	/* Not within a character. */
	while (cut && shown > 0 && ((unsigned char)cell->text[shown] & 0xC0) == 0x80)
		shown--;
	return offsets_fail_at(scan, scan->line, cell->column, "found '%.*s%s', expected %s",
	                       (int)shown, cell->text, cut ? "..." : "", text);
}

/* ------------------------------------------------------------------------------------------------
 * Lines
 * --------------------------------------------------------------------------------------------- */

/* A byte that stops the text: a line end is passed over, anything else is refused. */
static batten_status check_text(const struct offsets_scan *scan)
{
	size_t line = 1;
	size_t line_start = 0;
	size_t i = 0;
	while (i < scan->length) {
		i += hull_text_length(scan->text + i, scan->length - i);
		if (i == scan->length)
			break;
		if (scan->text[i] == '\r' && i + 1 < scan->length && scan->text[i + 1] == '\n')
			i++;
		if (scan->text[i] != '\n')
			return offsets_fail_at(scan, line, i - line_start + 1,
			                       "found the byte 0x%02x, expected a text file in UTF-8",
			                       (unsigned)(unsigned char)scan->text[i]);
		i++;
		line++;
		line_start = i;
	}
	return BATTEN_OK;
}

batten_status offsets_scan_begin(batten_context *context, const char *name, const char *text,
                                 size_t length, const char *expected, struct offsets_scan *out)
{
	struct offsets_scan scan = { .context = context, .name = name, .text = text, .length = length };
	if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) {
		scan.text += 3;
		scan.length -= 3;
	}
	if (scan.length == 0)
		return offsets_fail_at(&scan, 1, 1, "found an empty file, expected %s", expected);
	*out = scan;
	return check_text(&scan);
}

bool offsets_next_line(struct offsets_scan *scan)
{
	if (scan->next >= scan->length)
		return false;
	scan->row = scan->text + scan->next;
	size_t rest = scan->length - scan->next;
	const char *end = memchr(scan->row, '\n', rest);
	scan->row_length = end ? (size_t)(end - scan->row) : rest;
	scan->next += scan->row_length + 1;
	if (scan->row_length > 0 && scan->row[scan->row_length - 1] == '\r')
		scan->row_length--;
	scan->line++;
	scan->place = 0;
	return true;
}

bool offsets_next_row(struct offsets_scan *scan)
{
	while (offsets_next_line(scan))
		if (!offsets_is_comment(scan) && !offsets_is_blank(scan))
			return true;
	return false;
}

bool offsets_is_comment(const struct offsets_scan *scan)
{
	return scan->row_length > 0 && scan->row[0] == '#';
}

bool offsets_is_blank(const struct offsets_scan *scan)
{
	for (size_t i = 0; i < scan->row_length; i++)
		if (scan->row[i] != ' ' && scan->row[i] != '\t' && scan->row[i] != ',')
			return false;
	return true;
}

/* ------------------------------------------------------------------------------------------------
 * Cells
 * --------------------------------------------------------------------------------------------- */

static bool is_blank(char letter)
{
	return letter == ' ' || letter == '\t';
}

bool offsets_next_cell(struct offsets_scan *scan, struct offsets_cell *cell)
{
	if (scan->place > scan->row_length)
		return false;
	size_t first = scan->place;
	size_t rest = scan->row_length - first;
	const char *comma = rest > 0 ? memchr(scan->row + first, ',', rest) : NULL;
	size_t end = comma ? (size_t)(comma - scan->row) : scan->row_length;
	scan->place = end + 1;
	while (first < end && is_blank(scan->row[first]))
		first++;
	while (end > first && is_blank(scan->row[end - 1]))
		end--;
	*cell = (struct offsets_cell){ scan->row + first, end - first, first + 1 };
	return true;
}

size_t offsets_count_cells(const struct offsets_scan *scan)
{
	size_t count = 1;
	for (size_t i = 0; i < scan->row_length; i++)
		count += scan->row[i] == ',';
	return count;
}

bool offsets_cell_is(const struct offsets_cell *cell, const char *text)
{
	return cell->length == strlen(text) && memcmp(cell->text, text, cell->length) == 0;
}

batten_status offsets_read_number(const struct offsets_scan *scan, const struct offsets_cell *cell,
                                  const char *expected, double *out)
{
	if (!batten_number_read(cell->text, cell->length, out))
		return offsets_fail(scan, cell, "%s, written with a decimal point", expected);
	return BATTEN_OK;
}
