/* A context and a folder for the tests of the offsets file. */
#ifndef BATTEN_TESTS_OFFSETS_FIXTURE_H
#define BATTEN_TESTS_OFFSETS_FIXTURE_H

#include "hull/hull.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include <cmocka.h>

struct fixture {
	batten_context *context;
	char folder[64];
};

static inline int begin(void **state)
{
	struct fixture *fixture = calloc(1, sizeof *fixture);
	assert_non_null(fixture);
	(void)snprintf(fixture->folder, sizeof fixture->folder, "/tmp/batten-offsets.XXXXXX");
	assert_non_null(mkdtemp(fixture->folder));
	assert_int_equal(batten_context_create(NULL, &fixture->context), BATTEN_OK);
	*state = fixture;
	return 0;
}

/* Removes the folder with the files in it. */
static inline int end(void **state)
{
	struct fixture *fixture = *state;
	DIR *folder = opendir(fixture->folder);
	assert_non_null(folder);
	for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
		if (entry->d_name[0] != '.')
			(void)unlinkat(dirfd(folder), entry->d_name, 0);
	(void)closedir(folder);
	(void)rmdir(fixture->folder);
	batten_context_destroy(fixture->context);
	free(fixture);
	return 0;
}

static inline char *path_in(const struct fixture *fixture, const char *name, char path[256])
{
	(void)snprintf(path, 256, "%s/%s", fixture->folder, name);
	return path;
}

static inline size_t count_files(const struct fixture *fixture)
{
	size_t count = 0;
	DIR *folder = opendir(fixture->folder);
	assert_non_null(folder);
	for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
		count += entry->d_name[0] != '.';
	(void)closedir(folder);
	return count;
}

/* The whole file, to be freed. */
static inline char *read_text(const char *path, size_t *length)
{
	FILE *stream = fopen(path, "rb");
	assert_non_null(stream);
	char *text = calloc(1, 1 << 20);
	assert_non_null(text);
	*length = fread(text, 1, (1 << 20) - 1, stream);
	(void)fclose(stream);
	return text;
}

static inline batten_hull *parse(const struct fixture *fixture, const char *text, size_t length)
{
	batten_hull *hull = NULL;
	if (batten_hull_parse(fixture->context, "in.csv", text, length, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(fixture->context));
	return hull;
}

static inline batten_hull *read_hull(const struct fixture *fixture, const char *path)
{
	batten_hull *hull = NULL;
	if (batten_hull_read(fixture->context, path, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(fixture->context));
	return hull;
}

static inline void write_hull(const struct fixture *fixture, const batten_hull *hull,
                              const char *path)
{
	if (batten_hull_write(fixture->context, hull, path) != BATTEN_OK)
		fail_msg("%s", batten_context_error(fixture->context));
}

#endif
