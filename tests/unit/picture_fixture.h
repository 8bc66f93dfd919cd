/* What the tests of pictures share: a context that counts its memory, a folder of its own, hulls, and
 * pictures read back. */
#ifndef BATTEN_TEST_PICTURE_FIXTURE_H
#define BATTEN_TEST_PICTURE_FIXTURE_H

#include "hull/hull.h"
#include "picture/view.h"

#include <dirent.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* An allocator that fails one request and counts what is not released. */
typedef struct counter {
	size_t made, fail_at, alive;
} counter;

typedef struct fixture {
	counter count;
	batten_context *context;
	char folder[64];
} fixture;

static inline void *count_allocate(size_t size, void *user)
{
	counter *count = user;
	if (count->made++ == count->fail_at)
		return NULL;
	count->alive++;
	return malloc(size);
}

static inline void count_release(void *memory, void *user)
{
	counter *count = user;
	count->alive--;
	free(memory);
}

static inline int set_up(void **state)
{
	fixture *f = calloc(1, sizeof *f);
	assert_non_null(f);
	f->count.fail_at = SIZE_MAX;
	batten_context_options options;
	batten_context_options_default(&options);
	options.allocate = count_allocate;
	options.release = count_release;
	options.allocate_user = &f->count;
	assert_int_equal(batten_context_create(&options, &f->context), BATTEN_OK);
	(void)snprintf(f->folder, sizeof f->folder, "/tmp/batten-picture-XXXXXX");
	assert_non_null(mkdtemp(f->folder));
	*state = f;
	return 0;
}

static inline void path_in(const fixture *f, const char *name, char path[160])
{
	(void)snprintf(path, 160, "%s/%s", f->folder, name);
}

/* Removes all files of the folder; returns how many there were. */
static inline size_t empty_folder(const fixture *f)
{
	DIR *folder = opendir(f->folder);
	assert_non_null(folder);
	size_t count = 0;
	for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
		if (entry->d_name[0] == '.')
			continue;
		char path[400];
		(void)snprintf(path, sizeof path, "%s/%s", f->folder, entry->d_name);
		assert_int_equal(unlink(path), 0);
		count++;
	}
	(void)closedir(folder);
	return count;
}

static inline int tear_down(void **state)
{
	fixture *f = *state;
	(void)empty_folder(f);
	assert_int_equal(rmdir(f->folder), 0);
	batten_context_destroy(f->context);
	assert_int_equal(f->count.alive, 0);
	free(f);
	return 0;
}

static inline batten_hull *read_shipped(fixture *f, const char *name)
{
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	batten_hull *hull = NULL;
	if (batten_hull_read(f->context, path, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(f->context));
	return hull;
}

enum { STATIONS = 9, WATERLINES = 10, NODES = STATIONS * WATERLINES };

/* A wall of half-breadth 1 over x 0..8, z 0..0.9, bent by bend: y_zz = -bend everywhere. */
static inline batten_hull *make_wall(fixture *f, double bend)
{
	double x[STATIONS], z[WATERLINES], y[NODES];
	for (size_t i = 0; i < STATIONS; i++)
		x[i] = (double)i;
	for (size_t j = 0; j < WATERLINES; j++)
		z[j] = 0.1 * (double)j;
	for (size_t node = 0; node < NODES; node++) {
		double off = z[node / STATIONS] - 0.45;
		y[node] = 1.0 - 0.5 * bend * off * off;
	}
	batten_hull_table table = { .name = "wall",
		                        .lbp_m = 8,
		                        .draft_m = 0.5,
		                        .station_count = STATIONS,
		                        .waterline_count = WATERLINES,
		                        .x_m = x,
		                        .z_m = z,
		                        .y_m = y };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(f->context, &table, &hull), BATTEN_OK);
	return hull;
}

static inline char *read_file(const char *path, size_t *length)
{
	FILE *stream = fopen(path, "rb");
	assert_non_null(stream);
	assert_int_equal(fseek(stream, 0, SEEK_END), 0);
	long size = ftell(stream);
	assert_true(size > 0);
	rewind(stream);
	char *bytes = malloc((size_t)size + 1);
	assert_non_null(bytes);
	assert_int_equal(fread(bytes, 1, (size_t)size, stream), (size_t)size);
	bytes[size] = '\0';
	*length = (size_t)size;
	(void)fclose(stream);
	return bytes;
}

static inline void assert_same_file(const char *a, const char *b)
{
	size_t length_a = 0;
	size_t length_b = 0;
	char *bytes_a = read_file(a, &length_a);
	char *bytes_b = read_file(b, &length_b);
	assert_int_equal(length_a, length_b);
	assert_memory_equal(bytes_a, bytes_b, length_a);
	free(bytes_a);
	free(bytes_b);
}

typedef struct picture {
	unsigned width, height;
	uint8_t *rgb;
} picture;

static inline picture decode(const char *path)
{
	png_image image = { .version = PNG_IMAGE_VERSION };
	if (!png_image_begin_read_from_file(&image, path))
		fail_msg("%s: %s", path, image.message);
	image.format = PNG_FORMAT_RGB;
	picture result = { image.width, image.height, malloc(PNG_IMAGE_SIZE(image)) };
	assert_non_null(result.rgb);
	if (!png_image_finish_read(&image, NULL, result.rgb, 0, NULL))
		fail_msg("%s: %s", path, image.message);
	return result;
}

static inline picture draw(fixture *f, const batten_hull *hull,
                           const batten_picture_options *options)
{
	char path[160];
	path_in(f, "drawn.png", path);
	if (batten_picture_curvature(f->context, hull, options, path, NULL) != BATTEN_OK)
		fail_msg("%s", batten_context_error(f->context));
	return decode(path);
}

static inline batten_picture_options options_of(unsigned width, unsigned height, double scale)
{
	batten_picture_options options;
	batten_picture_options_default(&options);
	options.width = width;
	options.height = height;
	options.scale_per_m = scale;
	return options;
}

/* Part of the pixels of a rectangle that are not white. */
static inline double covered(const picture *p, const picture_rectangle *r)
{
	size_t count = 0;
	size_t inked = 0;
	for (unsigned y = (unsigned)r->top; y < (unsigned)(r->top + r->height); y++)
		for (unsigned x = (unsigned)r->left; x < (unsigned)(r->left + r->width); x++) {
			const uint8_t *pixel = p->rgb + 3 * ((size_t)y * p->width + x);
			inked += pixel[0] < 250 || pixel[1] < 250 || pixel[2] < 250;
			count++;
		}
	return (double)inked / (double)count;
}

/* Makes allocation after allocation fail until a call succeeds; nothing leaks, no file is left. */
static inline void fail_every_allocation(fixture *f, const batten_hull *hull, const char *path,
                                         batten_status (*call)(fixture *, const batten_hull *,
                                                               const char *),
                                         size_t least)
{
	size_t before = f->count.alive;
	for (size_t k = 0;; k++) {
		f->count.made = 0;
		f->count.fail_at = k;
		batten_status status = call(f, hull, path);
		f->count.fail_at = SIZE_MAX;
		assert_int_equal(f->count.alive, before);
		if (status == BATTEN_OK) {
			assert_true(k >= least);
			assert_int_equal(empty_folder(f), 1);
			return;
		}
		assert_int_equal(status, BATTEN_MEMORY);
		assert_int_equal(empty_folder(f), 0);
	}
}

#define PICTURE_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

#endif
