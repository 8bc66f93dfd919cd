/* Whole files in and out. A file is replaced at once or not at all. */
#ifndef BATTEN_CORE_FILE_H
#define BATTEN_CORE_FILE_H

#include "core/context.h"

#include <stdio.h>

/* Reads a file of at most limit bytes; *text is NUL-terminated beyond its length and released by the
 * caller. Errors: IO (no such file, unreadable, a folder), INPUT (longer than limit), MEMORY. */
batten_status batten_file_read(batten_context *context, const char *path, size_t limit, char **text,
                               size_t *length);

/* Writing: open a temporary neighbour of path, print to it, then commit (flush, fsync, rename) or
 * abandon (remove). */
typedef struct batten_file {
	FILE *stream;
	char *path, *temporary;
} batten_file;
batten_status batten_file_open(batten_context *context, const char *path, batten_file *out);
batten_status batten_file_commit(batten_context *context, batten_file *file);
void batten_file_abandon(batten_context *context, batten_file *file);

#endif
