/* Writes the program of a fairing pass (kernels/shared/pass_layout.h), operation by operation. A
 * failure is kept: what follows it is not written, and pass_writer.status says why. */
#ifndef BATTEN_FAIRING_PASS_WRITER_H
#define BATTEN_FAIRING_PASS_WRITER_H

#include "batch/pass_plan.h"

typedef struct pass_writer {
	batten_context *context;
	batten_status status;
	pass_program_numbers numbers;
	size_t product_count; /* those that are needed: zeros that fill up tiles are none */
	size_t operation_count, operation_room, row_room, term_room, line_room, point_room;
} pass_writer;

/* A state of values and constants (which the caller fills in numbers.constants). */
void pass_writer_begin(pass_writer *writer, batten_context *context, size_t values,
                       size_t constants);
/* Memory of the program; numbers that outlive the writer are released by this too. */
void pass_numbers_release(batten_context *context, pass_program_numbers *numbers);

/* Place of the first of count more reals of the state. */
size_t pass_room(pass_writer *writer, size_t count);

/* An operation of rows or of lines; they follow. One that gets none is taken back. */
void pass_operation(pass_writer *writer, int kind);
void pass_floor(pass_writer *writer, size_t first, size_t count);

/* A row: its terms, then where their sum goes. */
void pass_term(pass_writer *writer, size_t index, double factor);
/* One that is counted by the caller: of a tile, where zeros are filled in. */
void pass_put_term(pass_writer *writer, size_t index, double factor);
void pass_row(pass_writer *writer, size_t target);

/* A line: its points, then its end. */
void pass_point(pass_writer *writer, size_t from, size_t to, double along);
void pass_line(pass_writer *writer);

/* Takes back all rows, and room beyond the first `base` places. */
void pass_writer_clear(pass_writer *writer, size_t base);

/* Ends the last operation and lets go of all of them and of their rows, which the caller takes over; what
 * is written from now on takes their place. */
void pass_writer_renew_rows(pass_writer *writer);

/* Ends the last operation; the program is whole. */
batten_status pass_writer_end(pass_writer *writer);

#endif
