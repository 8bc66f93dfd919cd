/* Lines "# key: value" before a table. */
#ifndef BATTEN_IO_OFFSETS_KEYS_H
#define BATTEN_IO_OFFSETS_KEYS_H

#include "io/offsets_scan.h"

/* The value of each key as it stands in the file, line 0 where there is none. The unit may follow the
 * lengths, so nothing is converted before the last key. */
struct offsets_key {
	struct offsets_cell cell;
	size_t line;
};

/* Reads all comment lines up to the table, on whose first row the scan then stands (an empty row
 * where there is no table). Other comments are passed over. Errors: INPUT (a key twice). */
batten_status offsets_keys_collect(struct offsets_scan *scan, const char *const *names,
                                   size_t count, struct offsets_key *keys);

/* INPUT when a key line follows the table's first row, on which the scan stands. */
batten_status offsets_keys_refuse_late(const struct offsets_scan *table, const char *const *names,
                                       size_t count);

#endif
