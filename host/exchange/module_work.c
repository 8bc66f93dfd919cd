/* The child process that OpenCASCADE works in, and the pipe its results come through. */
#include "exchange/module.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* What passes the pipe: a head, then as many bytes as it says. */
typedef enum part_kind {
	PART_SURFACE, /* a surface_head, then its name and numbers */
	PART_LEFT_OUT,
	PART_BYTES,
	PART_END, /* status and message; without it the child has died */
} part_kind;

typedef struct part_head {
	part_kind kind;
	batten_status status;
	unsigned long count;
	size_t size;
} part_head;

typedef struct surface_head {
	size_t order_u, order_v, count_u, count_v, name;
	bool rational;
} surface_head;

typedef struct left_out {
	char kind[128], why[128];
} left_out;

/* More is not taken from a child, whose memory a damaged file may have spoilt. */
enum { PART_LARGEST = 1 << 30, SECONDS_MOST = 600 };

static size_t numbers_of(const surface_head *head)
{
	return head->count_u + head->order_u + head->count_v + head->order_v +
	       (head->rational ? 4 : 3) * head->count_u * head->count_v;
}

/* ------------------------------------------------------------------------------------------------
 * The child
 * --------------------------------------------------------------------------------------------- */

static bool put(int pipe, const void *bytes, size_t size)
{
	const char *from = bytes;
	while (size > 0) {
		const ssize_t written = write(pipe, from, size);
		if (written < 0 && errno == EINTR)
			continue;
		if (written <= 0)
			return false;
		from += written;
		size -= (size_t)written;
	}
	return true;
}

static bool put_head(int pipe, part_kind kind, batten_status status, unsigned long count,
                     size_t size)
{
	part_head head;
	memset(&head, 0, sizeof head); /* what lies between its members goes through the pipe, too */
	head.kind = kind;
	head.status = status;
	head.count = count;
	head.size = size;
	return put(pipe, &head, sizeof head);
}

static bool put_surface(void *user, const batten_surface_net *net)
{
	const int pipe = *(const int *)user;
	const size_t poles = net->count_u * net->count_v;
	surface_head head;
	memset(&head, 0, sizeof head);
	head.order_u = net->order_u;
	head.order_v = net->order_v;
	head.count_u = net->count_u;
	head.count_v = net->count_v;
	head.name = strlen(net->name) + 1;
	head.rational = net->weights != NULL;
	return put_head(pipe, PART_SURFACE, BATTEN_OK, 1,
	                sizeof head + numbers_of(&head) * sizeof(double) + head.name) &&
	       put(pipe, &head, sizeof head) &&
	       put(pipe, net->knots_u, (net->count_u + net->order_u) * sizeof(double)) &&
	       put(pipe, net->knots_v, (net->count_v + net->order_v) * sizeof(double)) &&
	       put(pipe, net->poles_m, 3 * poles * sizeof(double)) &&
	       (!net->weights || put(pipe, net->weights, poles * sizeof(double))) &&
	       put(pipe, net->name, head.name);
}

static bool put_left_out(void *user, unsigned long count, const char *kind, const char *why)
{
	left_out part;
	memset(&part, 0, sizeof part);
	(void)snprintf(part.kind, sizeof part.kind, "%s", kind);
	(void)snprintf(part.why, sizeof part.why, "%s", why);
	return put_head(*(const int *)user, PART_LEFT_OUT, BATTEN_OK, count, sizeof part) &&
	       put(*(const int *)user, &part, sizeof part);
}

static bool put_bytes(void *user, const char *bytes, size_t count)
{
	return put_head(*(const int *)user, PART_BYTES, BATTEN_OK, 1, count) &&
	       put(*(const int *)user, bytes, count);
}

/* No core file, no endless loop, no word of the library, no handlers of whoever uses us. */
static void settle_down(void)
{
	static const int fatal[] = { SIGSEGV, SIGBUS,  SIGFPE,  SIGILL, SIGABRT,
		                         SIGINT,  SIGTERM, SIGPIPE, SIGXCPU };
	const struct rlimit none = { 0, 0 };
	const struct rlimit time = { SECONDS_MOST, SECONDS_MOST };
	const int nowhere = open("/dev/null", O_RDWR);
	sigset_t all;
	if (nowhere >= 0) {
		(void)dup2(nowhere, STDOUT_FILENO);
		(void)dup2(nowhere, STDERR_FILENO);
	}
	(void)setrlimit(RLIMIT_CORE, &none);
	(void)setrlimit(RLIMIT_CPU, &time);
	for (size_t i = 0; i < sizeof fatal / sizeof fatal[0]; i++)
		(void)signal(fatal[i], SIG_DFL);
	(void)sigfillset(&all);
	(void)sigprocmask(SIG_UNBLOCK, &all, NULL);
}

static void work(int pipe, const module_task *task)
{
	char message[EXCHANGE_MESSAGE_SIZE] = "";
	const exchange_sink sink = { &pipe, put_surface, put_left_out, put_bytes };
	batten_status status = BATTEN_MISSING;
	const exchange_module *module = exchange_module_open();
	if (module && task->nets)
		status = module->write(task->format, task->count, task->nets, &sink, message);
	else if (module)
		status = module->read(task->format, task->path, &sink, message);
	message[sizeof message - 1] = '\0';
	if (put_head(pipe, PART_END, status, 1, sizeof message))
		(void)put(pipe, message, sizeof message);
}

/* ------------------------------------------------------------------------------------------------
 * The parent
 * --------------------------------------------------------------------------------------------- */

static bool get(int pipe, void *bytes, size_t size)
{
	char *to = bytes;
	while (size > 0) {
		const ssize_t count = read(pipe, to, size);
		if (count < 0 && errno == EINTR)
			continue;
		if (count <= 0)
			return false;
		to += count;
		size -= (size_t)count;
	}
	return true;
}

static bool take_surface(const part_head *part, const char *bytes, const exchange_sink *sink)
{
	surface_head head;
	if (part->size < sizeof head)
		return false;
	memcpy(&head, bytes, sizeof head);
	if (head.order_u > 128 || head.order_v > 128 || head.count_u > 1 << 24 ||
	    head.count_v > 1 << 24 || head.name < 1 || head.name > part->size ||
	    part->size != sizeof head + numbers_of(&head) * sizeof(double) + head.name ||
	    bytes[part->size - 1] != '\0')
		return false;
	const double *knots_u = (const double *)(const void *)(bytes + sizeof head);
	const double *knots_v = knots_u + head.count_u + head.order_u;
	const double *poles = knots_v + head.count_v + head.order_v;
	const batten_surface_net net = {
		.name = bytes + part->size - head.name,
		.order_u = head.order_u,
		.order_v = head.order_v,
		.count_u = head.count_u,
		.count_v = head.count_v,
		.knots_u = knots_u,
		.knots_v = knots_v,
		.poles_m = poles,
		.weights = head.rational ? poles + 3 * head.count_u * head.count_v : NULL,
	};
	return sink->surface(sink->user, &net);
}

static bool take_part(const part_head *part, char *bytes, const exchange_sink *sink)
{
	if (part->kind == PART_SURFACE)
		return take_surface(part, bytes, sink);
	if (part->kind == PART_BYTES)
		return sink->bytes(sink->user, bytes, part->size);
	left_out *out = (left_out *)(void *)bytes;
	if (part->kind != PART_LEFT_OUT || part->size != sizeof *out)
		return false;
	out->kind[sizeof out->kind - 1] = '\0';
	out->why[sizeof out->why - 1] = '\0';
	return sink->left_out(sink->user, part->count, out->kind, out->why);
}

static batten_status fail_end(batten_context *context, const module_task *task,
                              batten_status status, const char *message)
{
	switch (status) {
	case BATTEN_OK:
		return BATTEN_OK;
	case BATTEN_MISSING:
		return batten_fail(context, BATTEN_MISSING,
		                   "%s: IGES and STEP need OpenCASCADE: install "
		                   "libocct-data-exchange-dev and build batten again",
		                   task->path);
	case BATTEN_MEMORY:
		return batten_fail_memory(context);
	case BATTEN_INPUT:
		return batten_fail(context, BATTEN_INPUT, "%s: %s", task->path, message);
	default:
		return batten_fail(context, BATTEN_INTERNAL, "%s: %s", task->path, message);
	}
}

/* Takes parts until the end or the first that is refused. */
static batten_status take_all(batten_context *context, const module_task *task, int pipe,
                              const exchange_sink *sink)
{
	for (;;) {
		part_head part;
		if (!get(pipe, &part, sizeof part) || part.size > PART_LARGEST)
			return fail_end(context, task, task->nets ? BATTEN_INTERNAL : BATTEN_INPUT,
			                "OpenCASCADE broke down over it");
		char *bytes = batten_allocate(context, part.size + 1, 1);
		if (!bytes)
			return BATTEN_MEMORY;
		batten_status status = BATTEN_OK;
		const bool whole = get(pipe, bytes, part.size);
		const bool end = whole && part.kind == PART_END;
		if (end)
			status = fail_end(context, task, part.status, bytes);
		else if (whole && !take_part(&part, bytes, sink))
			status = BATTEN_INTERRUPTED;
		batten_release(context, bytes);
		if (end || status != BATTEN_OK)
			return status;
	}
}

batten_status module_work(batten_context *context, const module_task *task,
                          const exchange_sink *sink)
{
	int ends[2];
	if (pipe2(ends, O_CLOEXEC) != 0)
		return batten_fail(context, BATTEN_IO, "%s: no pipe: %s", task->path, strerror(errno));
	const pid_t child = fork();
	if (child == 0) {
		settle_down();
		work(ends[1], task);
		_exit(0);
	}
	(void)close(ends[1]);
	batten_status status;
	if (child > 0)
		status = take_all(context, task, ends[0], sink);
	else
		status = batten_fail(context, BATTEN_IO, "%s: no process for OpenCASCADE: %s", task->path,
		                     strerror(errno));
	(void)close(ends[0]);
	/* A child that is still at work writes into the closed pipe at most once more; kill it anyway. */
	if (child > 0 && status != BATTEN_OK)
		(void)kill(child, SIGKILL);
	while (child > 0 && waitpid(child, NULL, 0) < 0 && errno == EINTR)
		continue;
	return status;
}
