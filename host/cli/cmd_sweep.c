/* batten sweep: a plan of many designs, run into a database. */
#include "cli.h"

#include "json_out.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const cli_command command = {
	.name = "sweep",
	.usage = "PLAN.json --out RESULTS.db [OPTION ...]",
	.summary = "varies, fairs and measures many designs of a plan into a database",
	.example = "  batten sweep data/examples/npl-front.json --out front.db\n"
			   "  batten sweep plan.json --out part2.db --shard 2/8 --resume\n",
	.notes =
		"RESULTS.db is an SQLite database; host/sweep/README.md describes its tables. A sweep that\n"
		"was cut short goes on by --resume, and ends with the same rows. SIGTERM, SIGUSR1 and SIGINT\n"
		"store what was computed, print the command that goes on, and end with exit code 75.\n",
};

/* What ends a sweep in good order. The signals are blocked and asked for between blocks: OpenCL drivers
 * put handlers of their own in the place of ours (LLVM in PoCL takes SIGUSR1). */
static sigset_t ending_signals(void)
{
	sigset_t signals;
	(void)sigemptyset(&signals);
	(void)sigaddset(&signals, SIGTERM);
	(void)sigaddset(&signals, SIGUSR1);
	(void)sigaddset(&signals, SIGINT);
	return signals;
}

struct request {
	cli_common common;
	batten_sweep_options options;
	const char *plan, *out, *shard, *log, *journal;
	unsigned block;
	FILE *log_stream;
	bool on_terminal, line_open, stopped;
};

/* ---- progress ---- */

static double rate_of(const batten_sweep_progress *progress)
{
	const double done = (double)(progress->stored - progress->stored_before);
	return progress->seconds > 0 ? done / progress->seconds : 0.0;
}

static void print_line(struct request *request, const batten_sweep_progress *progress)
{
	const double rate = rate_of(progress);
	const uint64_t total = progress->end - progress->first;
	const double left = rate > 0 ? (double)(total - progress->stored) / rate : 0.0;
	(void)fprintf(
		stderr,
		"\r%llu of %llu designs, %.1f/s, %.0f:%02d:%02d left, %llu failed, %llu rejected, "
		"%llu not converged\033[K",
		(unsigned long long)progress->stored, (unsigned long long)total, rate,
		(double)(long)(left / 3600), (int)(left / 60) % 60, (int)left % 60,
		(unsigned long long)progress->failed, (unsigned long long)progress->rejected,
		(unsigned long long)progress->not_converged);
	request->line_open = true;
}

static json_t *progress_json(const batten_sweep_progress *progress)
{
	return json_pack(
		"{s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:f, s:f, s:f, s:f, s:f, s:s}", "first",
		(json_int_t)progress->first, "end", (json_int_t)progress->end, "stored",
		(json_int_t)progress->stored, "stored_before", (json_int_t)progress->stored_before, "begun",
		(json_int_t)progress->begun, "not_converged", (json_int_t)progress->not_converged,
		"rejected", (json_int_t)progress->rejected, "failed", (json_int_t)progress->failed,
		"seconds", progress->seconds, "vary_s", progress->vary_s, "fair_s", progress->fair_s,
		"measure_s", progress->measure_s, "store_s", progress->store_s, "device", progress->device);
}

/* One line a call; a log that cannot be written does not end the sweep. */
static void write_log(struct request *request, const batten_sweep_progress *progress)
{
	json_t *object = progress_json(progress);
	char time_text[32] = "";
	const time_t now = time(NULL);
	struct tm parts;
	if (gmtime_r(&now, &parts))
		(void)strftime(time_text, sizeof time_text, "%Y-%m-%dT%H:%M:%SZ", &parts);
	if (object && json_object_set_new(object, "time", json_string(time_text)) == 0 &&
	    json_dumpf(object, request->log_stream, JSON_COMPACT | JSON_REAL_PRECISION(6)) == 0)
		(void)fputc('\n', request->log_stream);
	(void)fflush(request->log_stream);
	json_decref(object);
}

static void tell(const batten_sweep_progress *progress, void *user)
{
	struct request *request = user;
	if (request->on_terminal && progress->stored > progress->stored_before)
		print_line(request, progress);
	if (request->log_stream)
		write_log(request, progress);
}

/* ---- options ---- */

static batten_status read_shard(struct request *request)
{
	const char *text = request->shard;
	if (!text)
		return BATTEN_OK;
	char *slash = NULL;
	char *end = NULL;
	/* At most 16 digits cannot overflow. */
	const bool plain = strspn(text, "0123456789/") == strlen(text) && strlen(text) <= 16;
	const unsigned long long index = strtoull(text, &slash, 10);
	const unsigned long long count = *slash == '/' ? strtoull(slash + 1, &end, 10) : 0;
	if (!plain || !end || *end != '\0' || index < 1 || index > count)
		return cli_usage("sweep", "--shard: found '%s', expected I/N, as 2/8", text);
	request->options.shard = index;
	request->options.shard_count = count;
	return BATTEN_OK;
}

static batten_status read_journal(struct request *request)
{
	static const char *const words[] = { "auto", "wal", "rollback" };
	if (!request->journal)
		return BATTEN_OK;
	for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
		if (strcmp(request->journal, words[i]) == 0) {
			request->options.journal = (batten_sweep_journal)i;
			return BATTEN_OK;
		}
	return cli_usage("sweep", "--journal: found '%s', expected auto, wal or rollback",
	                 request->journal);
}

static batten_status parse(int argc, char **argv, struct request *request, bool *done)
{
	batten_sweep_options *chosen = &request->options;
	const cli_option options[] = {
		{ "out", CLI_TEXT, &request->out, "RESULTS.db", "the database" },
		{ "resume", CLI_FLAG, &chosen->resume, NULL, "go on with a database that is there" },
		{ "shard", CLI_TEXT, &request->shard, "I/N", "part I of N of the designs, from 1" },
		{ "yes", CLI_FLAG, &chosen->large, NULL, "more than ten million designs are meant" },
		{ "log", CLI_TEXT, &request->log, "FILE",
		  "a line of JSON is added to it for each part begun or stored" },
		{ "block", CLI_COUNT, &request->block, "N",
		  "designs under way at a time: what a kill repeats at most" },
		{ "journal", CLI_TEXT, &request->journal, "KIND",
		  "of SQLite: auto, wal, rollback (auto: rollback on network file systems)" },
		{ "device", CLI_DEVICE, &chosen->device, "DEVICE", "auto, reference or an index" },
		{ 0 },
	};
	size_t count = 0;
	batten_status status = cli_parse(&command, argc, argv, options, &request->common,
	                                 &request->plan, 1, &count, done);
	if (status != BATTEN_OK || *done)
		return status;
	if (count != 1)
		return cli_usage("sweep", "a plan was expected");
	if (!request->out)
		return cli_usage("sweep", "--out RESULTS.db was expected");
	chosen->block = request->block;
	status = read_shard(request);
	return status == BATTEN_OK ? read_journal(request) : status;
}

/* ---- the run ---- */

/* Once there was a signal, it stays so. */
static bool is_stopped(void *user)
{
	struct request *request = user;
	const sigset_t signals = ending_signals();
	const struct timespec none = { 0 };
	request->stopped = request->stopped || sigtimedwait(&signals, NULL, &none) > 0;
	return request->stopped;
}

/* Before any thread is made: all of them inherit it. */
static void block_signals(void)
{
	const sigset_t signals = ending_signals();
	(void)pthread_sigmask(SIG_BLOCK, &signals, NULL);
}

/* A text as one word of a shell. */
static void print_word(const char *text)
{
	static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
								"_-./,:@%+=";
	if (*text && strspn(text, plain) == strlen(text)) {
		(void)fprintf(stderr, " %s", text);
		return;
	}
	(void)fputs(" '", stderr);
	for (; *text; text++)
		(void)fputs(*text == '\'' ? "'\\''" : (char[]){ *text, '\0' }, stderr);
	(void)fputc('\'', stderr);
}

/* The command that goes on, as it was given. */
static void print_resume(int argc, char **argv, bool resumed)
{
	(void)fputs("to go on: batten", stderr);
	for (int i = 0; i < argc; i++)
		print_word(argv[i]);
	(void)fputs(resumed ? "\n" : " --resume\n", stderr);
}

static void print_summary(const struct request *request, const batten_sweep_progress *progress)
{
	const uint64_t good = progress->stored - progress->failed - progress->rejected;
	(void)printf("%s: %llu designs: %llu good, of them %llu not converged; %llu rejected, %llu "
	             "failed\n",
	             request->out, (unsigned long long)progress->stored, (unsigned long long)good,
	             (unsigned long long)progress->not_converged,
	             (unsigned long long)progress->rejected, (unsigned long long)progress->failed);
	(void)printf("%.1f designs/s in %.1f s; %s\n", rate_of(progress), progress->seconds,
	             progress->device[0] ? progress->device : "nothing was searched");
}

static batten_status run(struct request *request, batten_context *context, int argc, char **argv)
{
	batten_sweep_progress progress = { 0 };
	request->options.stop = is_stopped;
	request->options.progress = tell;
	request->options.user = request;
	const batten_status status = batten_sweep_run(context, request->plan, request->out,
	                                              &request->options, &progress);
	if (request->line_open)
		(void)fputc('\n', stderr);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE) {
		if (request->common.json)
			return cli_json_print("sweep", progress_json(&progress)) == BATTEN_OK ? status
			                                                                      : BATTEN_IO;
		print_summary(request, &progress);
	}
	if (status != BATTEN_OK)
		(void)cli_failure("sweep", context, status);
	if (status == BATTEN_INTERRUPTED)
		print_resume(argc, argv, request->options.resume);
	return status;
}

static batten_status open_log(struct request *request)
{
	if (!request->log)
		return BATTEN_OK;
	request->log_stream = fopen(request->log, "a");
	if (request->log_stream)
		return BATTEN_OK;
	(void)fprintf(stderr, "batten sweep: %s: cannot be written: %s\n", request->log,
	              strerror(errno));
	return BATTEN_IO;
}

batten_status cli_sweep(int argc, char **argv)
{
	struct request request = { .on_terminal = isatty(STDERR_FILENO) };
	batten_sweep_options_default(&request.options);
	bool done = false;
	batten_context *context = NULL;
	batten_status status = parse(argc, argv, &request, &done);
	if (status != BATTEN_OK || done)
		return status;
	request.on_terminal = request.on_terminal && !request.common.quiet;
	status = open_log(&request);
	if (status == BATTEN_OK)
		status = cli_context_create("sweep", &request.common, &context);
	if (status == BATTEN_OK) {
		block_signals();
		status = run(&request, context, argc, argv);
	}
	if (request.log_stream)
		(void)fclose(request.log_stream);
	batten_context_destroy(context);
	return status;
}
