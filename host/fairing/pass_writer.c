#include "fairing/pass_writer.h"

#include "hull/hull.h"

#include <string.h>

/* Room for one more number in an array; doubles it where it is full. */
static bool grow(pass_writer *w, void **array, size_t count, size_t *room, size_t size)
{
	if (w->status != BATTEN_OK)
		return false;
	if (*array && count + 1 < *room)
		return true;
	if (count >= INT32_MAX / 2) {
		w->status = batten_fail(w->context, BATTEN_INPUT,
		                        "a fairing pass of more than %d terms: the table is too large",
		                        INT32_MAX / 2);
		return false;
	}
	const size_t next = *room > 0 ? 2 * *room : 64;
	void *larger = batten_allocate(w->context, next, size);
	if (!larger) {
		w->status = BATTEN_MEMORY;
		return false;
	}
	if (*array)
		memcpy(larger, *array, (count < *room ? count + 1 : count) * size);
	batten_release(w->context, *array);
	*array = larger;
	*room = next;
	return true;
}

/* Arrays that grow side by side share their room: it is taken over by the last of them. */
static bool grow_pair(pass_writer *w, void **first, size_t first_size, void **second,
                      size_t second_size, size_t count, size_t *room)
{
	size_t same = *room;
	if (!grow(w, first, count, &same, first_size))
		return false;
	return grow(w, second, count, room, second_size);
}

void pass_writer_begin(pass_writer *writer, batten_context *context, size_t values,
                       size_t constants)
{
	*writer = (pass_writer){ .context = context };
	pass_program_numbers *n = &writer->numbers;
	n->constants = batten_allocate(context, constants + 1, sizeof *n->constants);
	/* A program without rows or lines is one too. */
	bool good = n->constants != NULL;
	good = good && grow(writer, (void **)&n->operations, 0, &writer->operation_room,
	                    PASS_OPERATION_SIZE * sizeof *n->operations);
	good = good && grow_pair(writer, (void **)&n->row_first, sizeof *n->row_first,
	                         (void **)&n->row_target, sizeof *n->row_target, 0, &writer->row_room);
	good = good &&
	       grow_pair(writer, (void **)&n->term_index, sizeof *n->term_index,
	                 (void **)&n->term_factor, sizeof *n->term_factor, 0, &writer->term_room);
	good = good &&
	       grow(writer, (void **)&n->line_first, 0, &writer->line_room, sizeof *n->line_first);
	size_t room = writer->point_room;
	good = good && grow(writer, (void **)&n->point_along, 0, &room, sizeof *n->point_along);
	good = good && grow_pair(writer, (void **)&n->point_from, sizeof *n->point_from,
	                         (void **)&n->point_to, sizeof *n->point_to, 0, &writer->point_room);
	if (!good)
		writer->status = BATTEN_MEMORY;
	n->shape[PASS_SHAPE_VALUES] = (int32_t)values;
	n->shape[PASS_SHAPE_LARGEST] = (int32_t)HULL_LARGEST_M;
	n->shape[PASS_SHAPE_CONSTANTS] = (int32_t)constants;
	n->shape[PASS_SHAPE_STATE] = (int32_t)(values + constants);
}

void pass_numbers_release(batten_context *context, pass_program_numbers *numbers)
{
	void *memory[] = { numbers->operations, numbers->row_first,   numbers->row_target,
		               numbers->term_index, numbers->line_first,  numbers->point_from,
		               numbers->point_to,   numbers->term_factor, numbers->point_along,
		               numbers->constants };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(context, memory[i]);
	*numbers = (pass_program_numbers){ 0 };
}

size_t pass_room(pass_writer *writer, size_t count)
{
	const size_t first = (size_t)writer->numbers.shape[PASS_SHAPE_STATE];
	if (writer->status == BATTEN_OK && count > INT32_MAX / 2 - first)
		writer->status = batten_fail(writer->context, BATTEN_INPUT,
		                             "a fairing pass needs room for more than %d numbers: the "
		                             "table is too large",
		                             INT32_MAX / 2);
	if (writer->status == BATTEN_OK)
		writer->numbers.shape[PASS_SHAPE_STATE] = (int32_t)(first + count);
	return first;
}

void pass_writer_clear(pass_writer *writer, size_t base)
{
	pass_program_numbers *n = &writer->numbers;
	n->row_count = n->term_count = 0;
	writer->operation_count = writer->product_count = 0;
	n->shape[PASS_SHAPE_STATE] = (int32_t)base;
}

/* Completes the operation at work; an empty one is taken back. */
static void close_operation(pass_writer *w)
{
	if (w->status != BATTEN_OK || w->operation_count == 0)
		return;
	int32_t *last = w->numbers.operations + (w->operation_count - 1) * PASS_OPERATION_SIZE;
	if (last[PASS_KIND] < PASS_FLOOR)
		last[PASS_COUNT] = (int32_t)w->numbers.row_count - last[PASS_FIRST];
	else if (last[PASS_KIND] == PASS_FIT)
		last[PASS_COUNT] = (int32_t)w->numbers.line_count - last[PASS_FIRST];
	if (last[PASS_COUNT] == 0)
		w->operation_count--;
}

void pass_operation(pass_writer *w, int kind)
{
	close_operation(w);
	if (!grow(w, (void **)&w->numbers.operations, w->operation_count, &w->operation_room,
	          PASS_OPERATION_SIZE * sizeof *w->numbers.operations))
		return;
	int32_t *next = w->numbers.operations + w->operation_count++ * PASS_OPERATION_SIZE;
	next[PASS_KIND] = kind;
	next[PASS_FIRST] = (int32_t)(kind == PASS_FIT ? w->numbers.line_count : w->numbers.row_count);
	next[PASS_COUNT] = 0;
}

void pass_writer_renew_rows(pass_writer *w)
{
	pass_program_numbers *n = &w->numbers;
	close_operation(w);
	n->row_first = n->row_target = n->term_index = NULL;
	n->term_factor = NULL;
	n->row_count = n->term_count = 0;
	w->operation_count = 0;
}

void pass_floor(pass_writer *w, size_t first, size_t count)
{
	pass_operation(w, PASS_FLOOR);
	if (w->status != BATTEN_OK)
		return;
	int32_t *last = w->numbers.operations + (w->operation_count - 1) * PASS_OPERATION_SIZE;
	last[PASS_FIRST] = (int32_t)first;
	last[PASS_COUNT] = (int32_t)count;
}

void pass_term(pass_writer *w, size_t index, double factor)
{
	w->product_count++;
	pass_put_term(w, index, factor);
}

void pass_put_term(pass_writer *w, size_t index, double factor)
{
	pass_program_numbers *n = &w->numbers;
	if (!grow_pair(w, (void **)&n->term_index, sizeof *n->term_index, (void **)&n->term_factor,
	               sizeof *n->term_factor, n->term_count, &w->term_room))
		return;
	n->term_index[n->term_count] = (int32_t)index;
	n->term_factor[n->term_count++] = factor;
}

void pass_row(pass_writer *w, size_t target)
{
	pass_program_numbers *n = &w->numbers;
	if (!grow_pair(w, (void **)&n->row_first, sizeof *n->row_first, (void **)&n->row_target,
	               sizeof *n->row_target, n->row_count, &w->row_room))
		return;
	n->row_target[n->row_count++] = (int32_t)target;
	n->row_first[n->row_count] = (int32_t)n->term_count;
}

void pass_point(pass_writer *w, size_t from, size_t to, double along)
{
	pass_program_numbers *n = &w->numbers;
	size_t room = w->point_room;
	if (!grow(w, (void **)&n->point_along, n->point_count, &room, sizeof *n->point_along) ||
	    !grow_pair(w, (void **)&n->point_from, sizeof *n->point_from, (void **)&n->point_to,
	               sizeof *n->point_to, n->point_count, &w->point_room))
		return;
	n->point_from[n->point_count] = (int32_t)from;
	n->point_to[n->point_count] = (int32_t)to;
	n->point_along[n->point_count++] = along;
}

void pass_line(pass_writer *w)
{
	pass_program_numbers *n = &w->numbers;
	if (!grow(w, (void **)&n->line_first, n->line_count, &w->line_room, sizeof *n->line_first))
		return;
	const int32_t points = (int32_t)n->point_count - n->line_first[n->line_count];
	if (points > n->shape[PASS_SHAPE_FIT_POINTS])
		n->shape[PASS_SHAPE_FIT_POINTS] = points;
	n->line_first[++n->line_count] = (int32_t)n->point_count;
}

batten_status pass_writer_end(pass_writer *w)
{
	close_operation(w);
	w->numbers.shape[PASS_SHAPE_OPERATIONS] = (int32_t)w->operation_count;
	return w->status;
}
