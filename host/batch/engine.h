/* A kernel made ready on one device in one shape, known to equal the C path or not. What a kernel is
 * given and gives back is the business of its own engine (search_engine, surface_engine), whose first
 * member is this one.
 *
 *   found = batch_engine_find(context, &recipe);              the context has it already, or
 *   status = batch_engine_start(engine, context, &recipe);    session, program, kernel
 *   status = batch_engine_judge(engine, self-test's status);  wrong answers shut the device out
 *   batch_engine_keep(engine);                                from now on the context's
 *
 * batch_engine_open() does all of this for engines that have nothing of their own. */
#ifndef BATTEN_BATCH_ENGINE_H
#define BATTEN_BATCH_ENGINE_H

#include "device/device.h"

/* What tells one build from another. */
typedef struct batch_engine_recipe {
	const char *kernel; /* name of the kernel, of its program and of its self-test */
	const char *source;
	size_t device;
	batten_precision precision;
	unsigned lanes, work_group;
	bool abreast;      /* a lane is its own work-items', one or several (dialect.h) */
	char options[160]; /* of the compiler, beyond precision and lanes */
} batch_engine_recipe;

/* Threads that keep a device at work which is no CPU: while one's launch runs, others pack and unpack. */
enum { HANDS_MOST = 8 };

typedef struct batch_engine {
	batten_context *context;
	batch_engine_recipe recipe;
	device_session *session;
	device_program *program;
	device_kernel *kernel;
	batten_selftest test;
	void *memory; /* of batch_engine_memory() */
	size_t memory_bytes;
	bool copies; /* memory is copied, though the device could work in the host's: as others do */
	struct batch_engine *next;
	struct batch_engine *hands[HANDS_MOST - 1]; /* more of it, each for a thread */
	size_t hand_count;
	size_t size; /* bytes of the whole, for engines that have something of their own */
} batch_engine;

/* Bytes of a number. */
size_t batch_engine_number_size(batten_precision precision);

/* The lanes and work-items that suit a device; those given where they are not 0. */
void batch_engine_shape_choose(const batten_device *device, batten_precision precision,
                               unsigned *lanes, unsigned *work_group);

/* The same of kernels that know searches abreast: on a device that is no CPU so many, each shared by `together`
 * work-items, or fewer where a group cannot have them all; elsewhere where work-items are a multiple of more lanes
 * than one. */
void batch_engine_shape_abreast(const batten_device *device, unsigned abreast, unsigned together,
                                batch_engine_recipe *recipe);
bool batch_engine_stands_abreast(unsigned lanes, unsigned work_group);

/* Of so many groups those whose state, group_bytes each, fits a GPU beside that of others at work. */
size_t batch_engine_groups_most(const batch_engine *e, size_t groups, size_t group_bytes);

/* Searches of a self-test: two full groups of lanes and one more, so that idle lanes are met too; where lanes are many,
 * BATCH_TEST_MOST, no more. */
enum { BATCH_TEST_MOST = 65 };
size_t batch_engine_test_count(unsigned lanes);

/* Work-items that share a search. */
size_t batch_engine_together(const batch_engine_recipe *recipe);

/* How searches are shared out: each queue gets `share` of them; a group has one queue, or abreast one a lane. */
typedef struct batch_engine_queues {
	size_t share, count, groups;
} batch_engine_queues;

/* count searches over at most so many groups. */
batch_engine_queues batch_engine_queues_of(const batch_engine_recipe *recipe, size_t count,
                                           size_t groups_most);

/* Turns of all lanes, those included that stood idle while others of their group worked; turns: of each queue. */
uint64_t batch_engine_lane_turns(const batch_engine_recipe *recipe,
                                 const batch_engine_queues *queues, const int32_t *turns);

/* The context's engine of that recipe, or NULL. */
batch_engine *batch_engine_find(const batten_context *context, const batch_engine_recipe *recipe);

/* Fills a zeroed engine. Errors: DEVICE, KERNEL, MEMORY; the test then tells what happened and
 * batch_engine_destroy() is due. */
batten_status batch_engine_start(batch_engine *e, batten_context *context,
                                 const batch_engine_recipe *recipe);

/* Completes the test after the self-test ran: an error or wrong answers are an error here.
 * Errors: KERNEL, MEMORY. */
batten_status batch_engine_judge(batch_engine *e, batten_status ran);

/* What the numbers compared say: equal, different within the tolerance (worst deviation, relative to
 * what), or failed. */
void batch_engine_compare(batten_selftest *test, double worst, double tolerance, const char *what);

void batch_engine_keep(batch_engine *e);

/* Runs a self-test of the kernel that is ready on the engine; plan is what its opener was given. */
typedef batten_status batch_engine_selftest(batch_engine *engine, const void *plan);

/* The context's engine of that recipe, made and tested where there is none yet. result may be NULL and
 * gets the self-test, of an engine that failed too. Errors: DEVICE, KERNEL, MEMORY. */
batten_status batch_engine_open(batten_context *context, const batch_engine_recipe *recipe,
                                batch_engine_selftest *selftest, const void *plan,
                                batch_engine **out, batten_selftest *result);

/* Memory of so many things of that size, which the engine keeps from launch to launch: pages that are
 * there already cost nothing. What is in it is not known. NULL: out of memory. */
void *batch_engine_memory(batch_engine *e, size_t count, size_t size);

/* A buffer of a launch: what it begins with, NULL for what the kernel writes first. */
typedef struct batch_engine_upload {
	device_buffer **buffer;
	size_t size; /* bytes; 0: no such buffer */
	const void *from;
} batch_engine_upload;

/* Makes the buffers of a launch, which are the caller's, those made before a failure too. Errors: as
 * device_buffer_create(). */
batten_status batch_engine_upload_all(const batch_engine *e, const batch_engine_upload *uploads,
                                      size_t count);

/* The compiler's option that says where a kernel's state lies: in global memory, or in local. */
const char *batch_engine_state_option(bool global);

/* Most bytes of one launch: most, or what the device or the context allots at a time. Of searches, which a GPU gets
 * more of: most is a CPU's. */
size_t batch_engine_launch_bytes(const batch_engine *e, size_t most);
size_t batch_engine_search_bytes(const batch_engine *e, size_t most);

/* The engine for one more thread, number 1 .. HANDS_MOST - 1: of the same program, with a queue of its own; it ends with
 * the one it is of. Errors: DEVICE, MEMORY. */
batten_status batch_engine_hand(batch_engine *e, size_t number, batch_engine **out);

void batch_engine_destroy(batch_engine *e); /* NULL is allowed; releases e itself */

/* Ends all engines of a context. */
void batch_engines_destroy(batten_context *context, batch_engine *first);

const batten_device *batch_engine_device(const batch_engine *e);
bool batch_engine_is_strict(const batch_engine *e);

/* Names the device in the error of a launch. */
batten_status batch_engine_fail(const batch_engine *e, batten_status status);

#endif
