/* The text of an offsets file, line by line and cell by cell, and errors that name the place. */
#ifndef BATTEN_IO_OFFSETS_SCAN_H
#define BATTEN_IO_OFFSETS_SCAN_H

#include "core/context.h"

struct offsets_scan {
	batten_context *context;
	const char *name; /* of the file, for messages */
	const char *text;
	size_t length;
	size_t next;     /* place in text of the line after this one */
	size_t line;     /* number of this line, from 1; 0 before the first */
	const char *row; /* this line without its end */
	size_t row_length;
	size_t place; /* in row, of the next cell; row_length + 1 after the last */
};

struct offsets_cell {
	const char *text; /* without blanks around it */
	size_t length;
	size_t column; /* in bytes, from 1 */
};

/* Skips a byte order mark and refuses what is no text: INPUT. expected: what an empty file lacks. */
batten_status offsets_scan_begin(batten_context *context, const char *name, const char *text,
                                 size_t length, const char *expected, struct offsets_scan *out);

/* Goes to the next line, false at the end; the lines must have been checked by _begin. */
bool offsets_next_line(struct offsets_scan *scan);
/* Goes to the next line that holds a cell that is not empty and is no comment. */
bool offsets_next_row(struct offsets_scan *scan);
bool offsets_is_comment(const struct offsets_scan *scan);
bool offsets_is_blank(const struct offsets_scan *scan); /* blanks and commas at most */

/* The next cell of the line; false after the last. */
bool offsets_next_cell(struct offsets_scan *scan, struct offsets_cell *cell);
size_t offsets_count_cells(const struct offsets_scan *scan);
bool offsets_cell_is(const struct offsets_cell *cell, const char *text);

/* Reads a finite number, else INPUT with what was expected. */
batten_status offsets_read_number(const struct offsets_scan *scan, const struct offsets_cell *cell,
                                  const char *expected, double *out);

/* INPUT: "file:line:column: found 'cell', expected ...". */
batten_status offsets_fail(const struct offsets_scan *scan, const struct offsets_cell *cell,
                           const char *expected, ...) __attribute__((format(printf, 3, 4)));
/* INPUT: "file:line:column: " and the message. */
batten_status offsets_fail_at(const struct offsets_scan *scan, size_t line, size_t column,
                              const char *message, ...) __attribute__((format(printf, 4, 5)));

#endif
