/* The parts of an offsets file, each read by one function, in the order of the file. */
#ifndef BATTEN_IO_OFFSETS_PARTS_H
#define BATTEN_IO_OFFSETS_PARTS_H

#include "hull/hull.h"
#include "io/offsets_scan.h"

/* What the header lines say; the texts are the caller's to release. */
struct offsets_header {
	char *name, *source;
	hull_unit unit;
	hull_frame frame;
	hull_layout layout; /* of the two long layouts the one by waterlines, until the table is read */
	double lbp_m, draft_m, depth_m; /* depth NaN when not given */
};

/* A header as a hull without a table, for the conversions of offsets_frame.h. */
batten_hull offsets_header_hull(const struct offsets_header *header);

/* Reads the key lines and stops at the first row of the table. */
batten_status offsets_read_header(struct offsets_scan *scan, struct offsets_header *out);
/* INPUT when a key line follows the table's first row, on which the scan stands. */
batten_status offsets_refuse_late_keys(const struct offsets_scan *table);
void offsets_header_release(batten_context *context, struct offsets_header *header);

/* Read the table, its first row being the current line, up to the end or to the first row of
 * offsets_read_extras(), then the current line. The hull has no name yet. */
batten_status offsets_read_grid(struct offsets_scan *scan, const struct offsets_header *header,
                                batten_hull **out);
batten_status offsets_read_long(struct offsets_scan *scan, const struct offsets_header *header,
                                batten_hull **out);

/* A row that begins with "profile" or "knuckle". */
bool offsets_is_extra(const struct offsets_scan *scan);

const char *offsets_profile_text(hull_profile_kind kind);

/* Reads the profile and knuckle rows from the current line to the end. */
batten_status offsets_read_extras(struct offsets_scan *scan, batten_hull *hull);

/* A coordinate (x where along_x, else z) that must lie beyond the one before it; previous is NULL
 * for the first. value is as in the file, metres as inside. */
struct offsets_coordinate {
	double value, metres;
};
batten_status offsets_read_coordinate(const struct offsets_scan *scan,
                                      const struct offsets_cell *cell, const batten_hull *frame,
                                      bool along_x, const struct offsets_coordinate *previous,
                                      struct offsets_coordinate *out);
batten_status offsets_read_half_breadth(const struct offsets_scan *scan,
                                        const struct offsets_cell *cell, const batten_hull *frame,
                                        double *out_m);

/* INPUT when the row has not as many cells as the first one of the table. */
batten_status offsets_check_width(const struct offsets_scan *scan, size_t cell_count);

/* A name, source or label. */
batten_status offsets_read_text(const struct offsets_scan *scan, const struct offsets_cell *cell,
                                char **out);

/* INPUT when the rest of the row holds more than empty cells, as spreadsheets append them. */
batten_status offsets_expect_no_more(struct offsets_scan *scan);

/* batten_allocate() cannot grow what it gave: a larger array takes over the used entries. NULL when
 * memory is out; the old array then stays. */
void *offsets_grow(batten_context *context, void *array, size_t used, size_t capacity, size_t size);

/* INPUT that names the cell of a '?' of the hull, table standing on the table's first row. */
batten_status offsets_fail_unfillable(const struct offsets_scan *table, const batten_hull *hull,
                                      size_t node);

#endif
