/* batten fair, in parts: the options as asked for, the fairing with its measures, the report and the
 * files. */
#ifndef BATTEN_CLI_FAIR_JOB_H
#define BATTEN_CLI_FAIR_JOB_H

#include "cli.h"

enum { FAIR_WARNING_LIMIT = 16, FAIR_WARNING_SIZE = 400, FAIR_LOCK_LIMIT = 256 };

/* Options as text, still to be understood. */
typedef struct fair_request {
	cli_common common;
	const char *hull_path, *out, *method, *search, *variables, *fairness;
	const char *front; /* NULL: not given */
	const char *max_distance, *lock, *keep, *lower_path, *upper_path;
	const char *net, *order, *tangents, *rounded; /* NULL: not given */
	double w1, w2, longitudinal, transverse;      /* NaN: not given */
	double polish;                                /* NaN: not given */
	const char *restore;                          /* NULL: not given */
	unsigned order_sections, vertices;            /* UINT_MAX: not given */
	double max_cn, least_gain;                    /* NaN: not given */
	bool no_smooth, smooth_first, interior_penalty;
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

/* What the options borrow. */
typedef struct fair_locks {
	batten_lock places[FAIR_LOCK_LIMIT];
	batten_net_lock poles[FAIR_LOCK_LIMIT];
	batten_keep keep[BATTEN_KEEP_LIMIT];
} fair_locks;

/* One fairing with everything the report says. */
typedef struct fair_job {
	batten_context *context;
	const fair_request *request;
	batten_hull *hull, *lower, *upper;
	batten_fair_options options; /* as understood */
	fair_locks locks;
	batten_fairing *fairing;
	fair_state before, smoothed, after;
	batten_line *lines_before, *lines_after;
	size_t line_count;
	double cpu_seconds;      /* of batten_hull_fair() */
	char vulkan_driver[128]; /* "" when no picture was drawn */
	size_t warning_count;
	char warnings[FAIR_WARNING_LIMIT][FAIR_WARNING_SIZE];
} fair_job;

/* A folder and those above it; *made tells whether the last of them is new. Errors: IO. */
batten_status fair_folder_make(const char *folder, bool *made);

/* Sweeps the request's front in place of fairing and writes its files. INCOMPLETE: a search met its
 * limit. */
batten_status fair_front(fair_job *job, const char *folder);

/* Reads, fairs, measures and writes everything into the folder. A job is zeroed memory of the heap with
 * request and context; INCOMPLETE as batten_hull_fair(). What went wrong is printed. */
batten_status fair_job_run(fair_job *job, const char *folder);
void fair_job_destroy(fair_job *job); /* NULL is allowed */

/* Every method on one hull, side by side. */
batten_status fair_all(const fair_request *request, const char *folder);

/* Understands the request for a hull that has been read. */
batten_status fair_options_read(const fair_request *request, const batten_hull *hull,
                                batten_fair_options *options, fair_locks *locks);

/* The method, and what forward and inverse methods are asked for. */
batten_status fair_pass_options_read(const fair_request *request, batten_fair_options *options);

/* Whether the method is one of iterations of a pass, with a row each. */
bool fair_is_pass(const batten_fair_options *options);

/* "beam" ... as --restore has them; NULL for none. */
const char *fair_restore_text(batten_restore restore);

/* The part of it that is about the net: variables, fairness, size, orders, edges. */
batten_status fair_net_options_read(const fair_request *request, batten_fair_options *options);

/* A lock of poles, text[0..length): row:K, column:K, pole:I@J or edge:NAME. *found false where it
 * is none of these, and then nothing is printed. */
batten_status fair_net_lock_read(const char *text, size_t length, batten_fair_options *options,
                                 fair_locks *locks, bool *found);

void fair_warn(fair_job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* report.json; takes nothing. Errors: MEMORY, IO. */
batten_status fair_report_write(const fair_job *job, FILE *stream);

/* The short table: each measure before, smoothed, after, change. */
void fair_table_print(const fair_job *job, FILE *stream);

/* The iterations of a forward or inverse method: as a table, and as JSON (fair_passes.c). */
void fair_passes_print(const batten_fairing *fairing, FILE *stream);

/* Draws and writes everything into the folder; each file appears whole or not at all, and none
 * before all are ready. */
batten_status fair_files_write(fair_job *job, const char *folder);

#endif
