/* The iterations of a forward or inverse method in report.json. */
#ifndef BATTEN_CLI_FAIR_PASSES_H
#define BATTEN_CLI_FAIR_PASSES_H

#include "fair_job.h"

#include <jansson.h>

/* Null for the other methods. */
json_t *fair_passes_json(const fair_job *job);

#endif
