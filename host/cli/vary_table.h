/* Many variants of a parent as one table. */
#ifndef BATTEN_CLI_VARY_TABLE_H
#define BATTEN_CLI_VARY_TABLE_H

#include "vary_options.h"

/* Makes the variants of --rows, writes the table and what else is asked for, tells what came out. Returns
 * INCOMPLETE when rows failed. Errors, printed: USAGE, IO, INPUT, DEVICE, KERNEL, MEMORY. */
batten_status vary_table_make(batten_context *context, const vary_request *request,
                              const batten_hull *parent);

#endif
