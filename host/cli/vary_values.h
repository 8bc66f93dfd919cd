/* The values of batten vary that are lists and names. */
#ifndef BATTEN_CLI_VARY_VALUES_H
#define BATTEN_CLI_VARY_VALUES_H

#include "vary_options.h"

/* Each takes its texts from the request and fills what is read. Errors: USAGE (message printed). */
batten_status vary_read_lbd(vary_request *request);
batten_status vary_read_average(vary_request *request);
batten_status vary_read_targets(vary_request *request); /* and the middle body */
batten_status vary_read_move(vary_request *request);
batten_status vary_read_preset(vary_request *request);
batten_status vary_read_drafts(vary_request *request);
batten_status vary_read_solve(vary_request *request);

#endif
