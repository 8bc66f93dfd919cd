/* The designs of a sweep, a row of numbers each, and the reasons of those that failed. */
#ifndef BATTEN_REPORT_ROWS_H
#define BATTEN_REPORT_ROWS_H

#include "report/hulls.h"
#include "report/sweep.h"

#include <stdio.h>

/* More designs than these no browser bears: the front, the hulls that are drawn and every n-th of the
 * rest are shown then. */
enum { REPORT_DESIGNS_MOST = 200000 };

/* Writes two blocks of the page: "batten-rows", base64 of f64 [designs][3 + columns that vary] with
 * id, number of the status, 1 on the front (0 not, -1 no part in it) before the columns, and
 * "batten-reasons", a JSON object from id to text. *written gets the number of designs. */
batten_status report_rows_write(const report_sweep *sweep, const report_choice *choice,
                                FILE *stream, size_t *written);

#endif
