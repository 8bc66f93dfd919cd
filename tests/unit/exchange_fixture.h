/* What the tests of IGES and STEP share: a folder, files written by hand, what is refused. */
#ifndef BATTEN_TESTS_EXCHANGE_FIXTURE_H
#define BATTEN_TESTS_EXCHANGE_FIXTURE_H

#include "surface_fixture.h"

#include <stdio.h>
#include <unistd.h>

typedef struct fixture {
	batten_context *context;
	char folder[64], path[128];
} fixture;

static inline int make_fixture(void **state)
{
	fixture *f = calloc(1, sizeof *f);
	assert_non_null(f);
	f->context = open_context();
	(void)snprintf(f->folder, sizeof f->folder, "/tmp/batten-exchange-XXXXXX");
	assert_non_null(mkdtemp(f->folder));
	*state = f;
	return 0;
}

static inline int end_fixture(void **state)
{
	fixture *f = *state;
	assert_int_equal(rmdir(f->folder), 0); /* nothing else was left there */
	batten_context_destroy(f->context);
	free(f);
	return 0;
}

static inline const char *path_of(fixture *f, const char *name)
{
	(void)snprintf(f->path, sizeof f->path, "%s/%s", f->folder, name);
	return f->path;
}

static inline batten_surfaces *read_file(fixture *f, const char *path)
{
	batten_surfaces *list = NULL;
	if (batten_surfaces_read(f->context, path, &list) != BATTEN_OK)
		fail_msg("%s", batten_context_error(f->context));
	return list;
}

/* One line that has this in it. */
static inline void assert_says(const fixture *f, const char *part)
{
	const char *line = batten_context_error(f->context);
	if (!strstr(line, part) || strchr(line, '\n'))
		fail_msg("'%s' says nothing of '%s', or in several lines", line, part);
}

static inline void put_text(const char *path, const char *text, size_t length)
{
	FILE *stream = fopen(path, "wb");
	assert_non_null(stream);
	assert_int_equal(fwrite(text, 1, length, stream), length);
	assert_int_equal(fclose(stream), 0);
}

/* A file of entities that are one line of parameters each, or several parted by line ends. matrices:
 * the entry that moves each entity, 0 without one; NULL moves none. */
static inline void put_iges(const char *path, int flag, const char *unit, size_t count,
                            const int *types, const int *matrices, const char *const *parameters)
{
	FILE *stream = fopen(path, "wb");
	assert_non_null(stream);
	size_t lines = 0;
	char line[128];
	(void)fprintf(stream, "%-72sS%07d\n", "made by hand", 1);
	(void)snprintf(line, sizeof line,
	               "1H,,1H;,4Htest,4Htest,4Htest,1H1,32,38,6,308,15,,1.0,%d,%zuH%s,", flag,
	               strlen(unit), unit);
	(void)fprintf(stream, "%-72sG%07d\n", line, 1);
	(void)fprintf(stream, "%-72sG%07d\n", "1,0.01,15H20260101.000000,1E-6,1000.,1H ,1H ,11,0;", 2);
	for (size_t e = 0; e < count; e++) {
		size_t rows = 1;
		for (const char *c = parameters[e]; *c; c++)
			rows += *c == '\n';
		(void)fprintf(stream, "%8d%8zu%8d%8d%8d%8d%8d%8d%8sD%07zu\n", types[e], lines + 1, 0, 0, 0,
		              0, matrices ? matrices[e] : 0, 0, "00000000", 2 * e + 1);
		(void)fprintf(stream, "%8d%8d%8d%8zu%8d%8s%8s%8s%8dD%07zu\n", types[e], 0, 0, rows, 0, "",
		              "", "by hand", 0, 2 * e + 2);
		lines += rows;
	}
	size_t number = 0;
	for (size_t e = 0; e < count; e++) {
		for (const char *c = parameters[e]; c;) {
			const int length = (int)strcspn(c, "\n");
			(void)fprintf(stream, "%-64.*s%8zuP%07zu\n", length, c, 2 * e + 1, ++number);
			c = c[length] ? c + length + 1 : NULL;
		}
	}
	(void)fprintf(stream, "S%07dG%07dD%07zuP%07zu%40sT%07d\n", 1, 2, 2 * count, number, "", 1);
	assert_int_equal(fclose(stream), 0);
}

#define PATCH_KNOTS "0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,\n"
#define PATCH_POLES "0.,0.,0.,1234.5,0.,0.,0.,2.5D1,1.,1234.5,25.,1.,\n"
#define PATCH "128,1,1,1,1,0,0,1,0,0,\n" PATCH_KNOTS PATCH_POLES "0.,1.,0.,1.;"

static inline void put_patch(const char *path, int flag, const char *unit, const char *parameters)
{
	const int type = 128;
	put_iges(path, flag, unit, 1, &type, NULL, &parameters);
}

static inline void assert_refused(fixture *f, const char *path, batten_status status,
                                  const char *part)
{
	batten_surfaces *list = NULL;
	const batten_status found = batten_surfaces_read(f->context, path, &list);
	if (found != status)
		fail_msg("%s: status %d, expected %d: %s", path, (int)found, (int)status,
		         batten_context_error(f->context));
	assert_null(list);
	assert_says(f, part);
}

#endif
