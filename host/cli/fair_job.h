/* batten fair, in parts: the options as asked for, the fairing with its measures, the report and the
 * files. */
#ifndef BATTEN_CLI_FAIR_JOB_H
#define BATTEN_CLI_FAIR_JOB_H

#include "cli.h"

enum { FAIR_WARNING_LIMIT = 16, FAIR_WARNING_SIZE = 400 };

/* Options as text, still to be understood. */
typedef struct fair_request {
	cli_common common;
	const char *hull_path, *out, *method, *search, *variables, *fairness;
	const char *max_distance, *lock, *lower_path, *upper_path;
	double w1, w2; /* NaN: not given */
	bool no_smooth;
	unsigned iterations, seed; /* iterations UINT_MAX: not given */
	int device;
	batten_precision precision;
	int argc;
	char **argv;
} fair_request;

/* A hull in one of its three states. */
typedef struct fair_state {
	const batten_hull *hull; /* borrowed from the fairing */
	batten_measures measures;
	batten_closeness to_input, to_smoothed;
} fair_state;

/* One fairing with everything the report says. */
typedef struct fair_job {
	batten_context *context;
	const fair_request *request;
	batten_hull *hull, *lower, *upper;
	batten_fair_options options; /* as understood */
	batten_fairing *fairing;
	fair_state before, smoothed, after;
	batten_line *lines_before, *lines_after;
	size_t line_count;
	char vulkan_driver[128]; /* "" when no picture was drawn */
	size_t warning_count;
	char warnings[FAIR_WARNING_LIMIT][FAIR_WARNING_SIZE];
} fair_job;

/* Understands the request for a hull that has been read; locks has room for capacity entries. */
batten_status fair_options_read(const fair_request *request, const batten_hull *hull,
                                batten_fair_options *options, batten_lock *locks, size_t capacity);

void fair_warn(fair_job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* report.json; takes nothing. Errors: MEMORY, IO. */
batten_status fair_report_write(const fair_job *job, FILE *stream);

/* The short table: each measure before, smoothed, after, change. */
void fair_table_print(const fair_job *job, FILE *stream);

/* Draws and writes everything into the folder; each file appears whole or not at all, and none
 * before all are ready. */
batten_status fair_files_write(fair_job *job, const char *folder);

#endif
