/* What batten vary is asked for, as text and as options of the library. */
#ifndef BATTEN_CLI_VARY_OPTIONS_H
#define BATTEN_CLI_VARY_OPTIONS_H

#include "cli.h"

enum { VARY_LIST_MOST = 64, VARY_DRAFTS_MOST = 64 };

/* Methods as bits. */
#define VARY_TAKES(symbol) (1u << BATTEN_VARY_##symbol)
#define VARY_HALVES (VARY_TAKES(ONE_MINUS_PRISMATIC) | VARY_TAKES(LACKENBY))
#define VARY_MOVED (VARY_HALVES | VARY_TAKES(SWING) | VARY_TAKES(MOOR))

typedef struct vary_request {
	cli_common common;
	const char *hull_path, *method, *out;
	/* as given; numbers NaN, texts NULL where not */
	bool first_pass, thesis;
	double dcp, dcb, dlcb, dcwp, dlcf, dp_fore, dp_aft, lcb_used, lcf_used;
	const char *with, *weight, *lbd, *targets, *middle, *move, *preset, *lattice, *solve, *by;
	const char *rows, *drafts, *hulls;
	double amount;
	int device;
	/* as read */
	batten_vary_options options;
	size_t other_count;
	char *other_paths[VARY_LIST_MOST]; /* into paths */
	char paths[8192];
	double weights[VARY_LIST_MOST], from[VARY_LIST_MOST], to[VARY_LIST_MOST];
	double middle_file[2]; /* in the frame and unit of the file */
	size_t draft_count;    /* of rows; 0: each variant's own */
	double drafts_m[VARY_DRAFTS_MOST];
	/* of a solve: names in place of a method */
	size_t solve_count;
	batten_solve_target solve_targets[BATTEN_VARY_TARGETS_MOST];
	batten_solve_parameter solve_parameters[BATTEN_VARY_TARGETS_MOST];
	char names[2][2048]; /* of targets and parameters */
} vary_request;

/* Fills a request from the command line; *done where help was printed. Errors: USAGE (message
 * printed). */
batten_status vary_request_read(int argc, char **argv, vary_request *request, bool *done);

/* Puts the middle body, which is given in the hull's own frame and unit, into the options. */
void vary_request_place(vary_request *request, const batten_hull *hull);

#endif
