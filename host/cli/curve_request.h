/* batten curve: what is asked for, and how the answer is printed. */
#ifndef BATTEN_CLI_CURVE_REQUEST_H
#define BATTEN_CLI_CURVE_REQUEST_H

#include "cli.h"

enum { CURVES_MOST = 16, LABEL_SIZE = 64, DRAWN_MOST = 8 };

/* One representation as the command line spells it. */
typedef struct curve_choice {
	char label[LABEL_SIZE];
	batten_curve_options options;
} curve_choice;

typedef struct curve_request {
	const char *path, *as, *parameter, *out;
	const char *method, *faired;               /* NULL: not given */
	unsigned fair_order, iterations, vertices; /* UINT_MAX: not given */
	double w1, w2;                             /* NaN: not given */
	unsigned order, points;
	cli_common common;
	batten_curve_parameter by;
	size_t count;
	curve_choice choices[CURVES_MOST];
} curve_request;

/* A curve made, measured and compared with the points. */
typedef struct curve_answer {
	batten_curve *curve;
	batten_curve_measures measures;
	batten_curve_datum *data; /* one a point */
} curve_answer;

/* What --method did. */
typedef struct curve_fairing {
	bool done;
	batten_line_facts facts;
} curve_fairing;

/* Replaces the points by the faired ones where --method asks for it, and writes them to --faired.
 * INCOMPLETE as batten_line_fair(); what went wrong is printed. */
batten_status curve_fair(const curve_request *request, batten_context *context,
                         batten_points **points, curve_fairing *out);
void curve_fair_print(const curve_request *request, const curve_fairing *fairing);

/* Reads --as, --parameter and --order into the choices. Returns OK or USAGE (message printed). */
batten_status curve_read_request(curve_request *request);

void curve_print_table(const curve_request *request, const batten_points *points,
                       const curve_answer *answers);
batten_status curve_print_json(const curve_request *request, const batten_points *points,
                               const curve_answer *answers, const curve_fairing *fairing);
/* The same into the file of --out; what went wrong is printed. */
batten_status curve_save_json(const curve_request *request, const batten_points *points,
                              const curve_answer *answers, const curve_fairing *fairing);

#endif
