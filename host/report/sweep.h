/* What a database says about its sweep as a whole: the table meta and the columns of the designs. */
#ifndef BATTEN_REPORT_SWEEP_H
#define BATTEN_REPORT_SWEEP_H

#include "report/database.h"

#include <jansson.h>

enum {
	REPORT_STATUS_MOST = 32,  /* different words in designs.status */
	REPORT_COLUMN_MOST = 600, /* of parameters and measures together: three a column fit a query */
};

typedef struct report_column {
	char *name;
	bool is_parameter, is_constant;
	double value; /* of a constant column; NaN where no design has one */
} report_column;

typedef struct report_status {
	char *name;
	size_t count;
} report_status;

typedef struct report_sweep {
	const report_database *database;
	json_t *meta; /* every key of the table as text or whole number */
	size_t station_count, waterline_count;
	double *x_m, *z_m;         /* the parent's table */
	json_t *objectives, *keep; /* as the keys of meta say; NULL where there are none */
	size_t design_count, front_count;
	long long first_id, last_id;
	size_t column_count;
	report_column *columns; /* parameters first */
	size_t status_count;
	report_status statuses[REPORT_STATUS_MOST];
} report_sweep;

/* Errors: INPUT (what is missing or not as expected), IO, MEMORY. */
batten_status report_sweep_read(const report_database *database, report_sweep *out);
void report_sweep_release(report_sweep *sweep);

/* The text of a key of meta, NULL where it is none. */
const char *report_meta_text(const report_sweep *sweep, const char *key);

/* The column of the measures with this name; NULL: none. */
const report_column *report_measure(const report_sweep *sweep, const char *name);

#endif
