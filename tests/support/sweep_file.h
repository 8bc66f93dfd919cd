/* A sweep's database as host/sweep/README.md describes it, made without host/sweep: what the report
 * reads, small or large. */
#ifndef BATTEN_TESTS_SWEEP_FILE_H
#define BATTEN_TESTS_SWEEP_FILE_H

#include "batten.h"

/* count designs of an offsets file, each a little wider or finer than it; every 97th could not be
 * varied. The geometry of the first kept ones is in it, and hydrostatics at two drafts of those. */
typedef struct sweep_file {
	const char *path, *hull;
	size_t count, kept;
	const char *name; /* of the plan */
} sweep_file;

void sweep_file_make(batten_context *context, const sweep_file *file);

/* Runs SQL on a database; it must succeed. */
void sweep_file_change(const char *path, const char *sql);

#endif
