/* Surfaces between a source and a sink: the results of the batch, in order, in memory that does not
 * grow with their number; whatever fails, nothing is kept. */
#include "support/failing_heap.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 3, VALUES = 2 * SIDE * SIDE };

/* Source and sink of one stream. */
typedef struct course {
	batten_context *context;
	size_t count;                      /* surfaces of the source */
	size_t source_fails, sink_fails;   /* at these; SIZE_MAX nowhere */
	size_t odd;                        /* the surface that has another order */
	size_t asked, given;               /* calls */
	batten_surface_energies *energies; /* [count] or NULL */
	double *values;                    /* [count][VALUES] or NULL */
	double sum;
} course;

static course course_of(batten_context *context, size_t count)
{
	return (course){ .context = context,
		             .count = count,
		             .source_fails = SIZE_MAX,
		             .sink_fails = SIZE_MAX,
		             .odd = SIZE_MAX };
}

static batten_status make(const course *c, size_t s, batten_surface **out)
{
	const double high = 1.0 + 1e-3 * (double)(s % 7919);
	const double poles[] = { 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 1, 1, high, 1, 2, 0, 1 };
	const batten_surface_net net = {
		.order_u = s == c->odd ? 2 : 3, .order_v = 2, .count_u = 3, .count_v = 2, .poles_m = poles
	};
	return batten_surface_create(c->context, &net, out);
}

static batten_status source(void *user, size_t index, batten_surface **out)
{
	course *c = user;
	assert_int_equal(index, c->asked);
	c->asked++;
	if (index == c->source_fails)
		return BATTEN_IO;
	return index < c->count ? make(c, index, out) : BATTEN_OK;
}

static batten_status energy_sink(void *user, size_t index, const batten_surface_energies *energies)
{
	course *c = user;
	assert_int_equal(index, c->given);
	c->given++;
	c->sum += energies->area_m2;
	if (c->energies)
		c->energies[index] = *energies;
	return index == c->sink_fails ? BATTEN_INCOMPLETE : BATTEN_OK;
}

static batten_status grid_sink(void *user, size_t index, const double *values,
                               const uint8_t *singular)
{
	course *c = user;
	assert_int_equal(index, c->given);
	c->given++;
	for (size_t n = 0; n < SIDE * SIDE; n++)
		assert_int_equal(singular[n], 0);
	if (c->values)
		memcpy(c->values + index * VALUES, values, VALUES * sizeof *values);
	return index == c->sink_fails ? BATTEN_INCOMPLETE : BATTEN_OK;
}

static const double at[SIDE] = { 0, 0.4, 1 };
static const batten_surface_samples samples = { SIDE, SIDE, at, at };

static batten_surface_batch_options options_on(int device)
{
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = device;
	options.gauss_points = 1;
	return options;
}

static batten_status run_energies(course *c, int device, size_t *count, batten_run *run)
{
	const batten_surface_batch_options options = options_on(device);
	c->asked = c->given = 0;
	return batten_surface_energy_stream(c->context, source, energy_sink, c, &options, count, run);
}

static batten_status run_grid(course *c, size_t *count)
{
	const batten_surface_batch_options options = options_on(BATTEN_DEVICE_REFERENCE);
	c->asked = c->given = 0;
	return batten_surface_grid_stream(c->context, source, grid_sink, c, &samples, &options, count,
	                                  NULL);
}

/* Over several batches, on a device and in plain C. */
static void test_streams_equal_batches(void **state)
{
	(void)state;
	enum { COUNT = 1100 };
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	course c = course_of(context, COUNT);
	const batten_surface_batch_options options = options_on(BATTEN_DEVICE_REFERENCE);
	batten_surface **surfaces = calloc(COUNT, sizeof(batten_surface *));
	batten_surface_energies *known = calloc(COUNT, sizeof *known);
	double *values = calloc(COUNT, VALUES * sizeof *values);
	c.energies = calloc(COUNT, sizeof *c.energies);
	c.values = calloc(COUNT, VALUES * sizeof *c.values);
	assert_true(surfaces && known && values && c.energies && c.values);
	for (size_t s = 0; s < COUNT; s++)
		assert_int_equal(make(&c, s, &surfaces[s]), BATTEN_OK);
	const batten_surface *const *all = (const batten_surface *const *)surfaces;
	assert_int_equal(batten_surface_energy_batch(context, COUNT, all, &options, known, NULL),
	                 BATTEN_OK);
	assert_int_equal(
		batten_surface_grid_batch(context, COUNT, all, &samples, &options, values, NULL, NULL),
		BATTEN_OK);
	for (int device = BATTEN_DEVICE_REFERENCE; device <= 0; device++) {
		if (device == BATTEN_DEVICE_AUTO)
			continue;
		size_t count = 0;
		batten_run run;
		memset(c.energies, 0xff, COUNT * sizeof *c.energies);
		assert_int_equal(run_energies(&c, device, &count, &run), BATTEN_OK);
		assert_int_equal(count, COUNT);
		assert_true(run.strict && run.device[0]);
		assert_memory_equal(c.energies, known, COUNT * sizeof *known);
	}
	size_t count = 0;
	assert_int_equal(run_grid(&c, &count), BATTEN_OK);
	assert_int_equal(count, COUNT);
	assert_memory_equal(c.values, values, COUNT * VALUES * sizeof *values);
	for (size_t s = 0; s < COUNT; s++)
		batten_surface_destroy(surfaces[s]);
	free(surfaces);
	free(known);
	free(values);
	free(c.energies);
	free(c.values);
	batten_context_destroy(context);
}

/* Memory that counts its bytes; several threads ask for it. */
typedef struct counting_heap {
	atomic_size_t live, peak;
} counting_heap;

typedef union counted {
	size_t size;
	max_align_t align;
} counted;

static void *count_allocate(size_t size, void *user)
{
	counting_heap *heap = user;
	counted *memory = malloc(sizeof *memory + size);
	if (!memory)
		return NULL;
	memory->size = size;
	const size_t live = atomic_fetch_add(&heap->live, size) + size;
	size_t peak = atomic_load(&heap->peak);
	while (live > peak && !atomic_compare_exchange_weak(&heap->peak, &peak, live)) {
	}
	return memory + 1;
}

static void count_release(void *given, void *user)
{
	counting_heap *heap = user;
	counted *memory = given ? (counted *)given - 1 : NULL;
	(void)atomic_fetch_sub(&heap->live, memory ? memory->size : 0);
	free(memory);
}

static size_t peak_of(size_t count)
{
	counting_heap heap = { 0, 0 };
	batten_context_options options;
	batten_context_options_default(&options);
	options.allocate = count_allocate;
	options.release = count_release;
	options.allocate_user = &heap;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(&options, &context), BATTEN_OK);
	course c = course_of(context, count);
	size_t given = 0;
	assert_int_equal(run_energies(&c, BATTEN_DEVICE_REFERENCE, &given, NULL), BATTEN_OK);
	assert_int_equal(given, count);
	assert_true(c.sum > 2.0 * (double)count);
	batten_context_destroy(context);
	assert_int_equal(heap.live, 0);
	return heap.peak;
}

static void test_memory_is_bounded(void **state)
{
	(void)state;
	/* One byte a surface would be more; how many threads are at work at once varies. */
	assert_true(peak_of(100000) < peak_of(2000) + 65536);
}

static void test_failures_end_the_stream(void **state)
{
	(void)state;
	static const size_t places[] = { 0, 1, 511, 512, 513, 700 };
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	const size_t before = heap.live;
	for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
		for (int grid = 0; grid < 2; grid++) {
			const size_t whole = places[i] / 512 * 512; /* of batches before */
			size_t count = 77;
			course c = course_of(context, 701);
			c.source_fails = places[i];
			assert_int_equal(grid ? run_grid(&c, &count)
			                      : run_energies(&c, BATTEN_DEVICE_REFERENCE, &count, NULL),
			                 BATTEN_IO);
			assert_int_equal(c.asked, places[i] + 1);
			assert_int_equal(count, whole);
			c = course_of(context, 701);
			c.sink_fails = places[i];
			assert_int_equal(grid ? run_grid(&c, &count)
			                      : run_energies(&c, BATTEN_DEVICE_REFERENCE, &count, NULL),
			                 BATTEN_INCOMPLETE);
			assert_int_equal(c.given, places[i] + 1);
			assert_int_equal(count, places[i] + 1);
			assert_int_equal(heap.live, before);
		}
	course c = course_of(context, 701);
	size_t count = 77;
	c.odd = 600;
	assert_int_equal(run_grid(&c, &count), BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(context), "surface 600 of a stream"));
	assert_int_equal(count, 512);
	c = course_of(context, 0);
	assert_int_equal(run_grid(&c, &count), BATTEN_OK);
	assert_int_equal(count, 0);
	failing_heap_close(&heap, context);
}

static batten_status one_stream(batten_context *context, void *user)
{
	(void)user;
	course c = course_of(context, 3);
	return run_grid(&c, NULL);
}

static void test_memory_fails(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	assert_true(failing_heap_each(&heap, context, one_stream, NULL) > 10);
	failing_heap_close(&heap, context);
}

static void test_refused_options(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	course c = course_of(context, 3);
	batten_surface_batch_options options = options_on(BATTEN_DEVICE_REFERENCE);
	batten_surface_samples none = samples;
	none.u_count = 0;
	assert_int_equal(
		batten_surface_grid_stream(context, source, grid_sink, &c, &none, &options, NULL, NULL),
		BATTEN_USAGE);
	options.struct_size = 1;
	assert_int_equal(
		batten_surface_energy_stream(context, source, energy_sink, &c, &options, NULL, NULL),
		BATTEN_USAGE);
	assert_int_equal(c.asked, 0);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_streams_equal_batches),   cmocka_unit_test(test_memory_is_bounded),
		cmocka_unit_test(test_failures_end_the_stream), cmocka_unit_test(test_memory_fails),
		cmocka_unit_test(test_refused_options),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
