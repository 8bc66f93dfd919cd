/* Rows of batten vary: a file with a column for each number that differs, a row for each variant. */
#ifndef BATTEN_CLI_VARY_ROWS_H
#define BATTEN_CLI_VARY_ROWS_H

#include "vary_options.h"

enum { VARY_COLUMNS_MOST = 64 };

/* What a column changes in a row's options. */
typedef enum vary_column_kind {
	VARY_COLUMN_NUMBER,  /* a number of the options, at .place bytes */
	VARY_COLUMN_WEIGHT,  /* the weight of hull .place of --with */
	VARY_COLUMN_MOVE,    /* where point .place of a stretch goes */
	VARY_COLUMN_LATTICE, /* the file of a lattice */
} vary_column_kind;

typedef struct vary_column {
	const char *name;
	vary_column_kind kind;
	size_t place;
	double from; /* of MOVE: the point, part of LBP */
} vary_column;

typedef struct vary_rows {
	char *text; /* the file; cells are parts of it */
	size_t count, column_count;
	vary_column columns[VARY_COLUMNS_MOST];
	bool named;         /* the first column of the file is the name of each row */
	const char **names; /* [count] where named */
	const char **cells; /* [count][columns]; "": as on the command line */
} vary_rows;

/* What the options of one row borrow. */
typedef struct vary_row_room {
	double weights[VARY_LIST_MOST], from[VARY_LIST_MOST], to[VARY_LIST_MOST];
	batten_lattice *lattice;
} vary_row_room;

/* Reads the file of --rows. Errors: IO, INPUT (file, line, column), MEMORY, printed. */
batten_status vary_rows_read(const vary_request *request, vary_rows *out);
void vary_rows_release(vary_rows *rows);

/* The number in a cell; NaN where it is empty or no number. */
double vary_rows_number(const vary_rows *rows, size_t row, size_t column);

/* The options of a row: those of the request with the row's cells in their places. The room's lattice
 * is the caller's to destroy. Errors: of a lattice's file, in the context. */
batten_status vary_rows_bind(batten_context *context, const vary_request *request,
                             const vary_rows *rows, size_t row, vary_row_room *room,
                             batten_vary_options *out);

#endif
