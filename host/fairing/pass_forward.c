/* Forward fairing (thesis 5.2, 5.3) as a program: a first direction is worked into room, the second
 * one from there back into the values. */
#include "fairing/pass_forward.h"

#include "fairing/pass_stretches.h"

/* Where each value is after the first direction. */
typedef struct stage {
	pass_writer *writer;
	size_t values, room;
	uint8_t *moved;   /* it is in the room */
	uint8_t *written; /* the second direction puts it back */
} stage;

static bool stage_create(pass_writer *writer, size_t values, size_t room, stage *s)
{
	*s = (stage){ .writer = writer, .values = values, .room = room };
	s->moved = batten_allocate(writer->context, values, sizeof *s->moved);
	s->written = batten_allocate(writer->context, values, sizeof *s->written);
	if (!s->moved || !s->written)
		writer->status = BATTEN_MEMORY;
	return writer->status == BATTEN_OK;
}

static void stage_release(stage *s)
{
	batten_release(s->writer->context, s->moved);
	batten_release(s->writer->context, s->written);
}

/* Whether a point of a piece is one that moves. */
static bool is_inner(const pass_piece *piece, size_t p)
{
	return p > 0 && p + 1 < piece->count;
}

/* Marks the inner points of all pieces that are long enough; counts pieces. */
static void mark(const pass_lines *lines, size_t least, uint8_t *marks, pass_task *task)
{
	for (size_t n = 0; n < lines->piece_count; n++) {
		const pass_piece *piece = &lines->pieces[n];
		const bool enough = piece->count >= least;
		task->faired_count += enough;
		task->passed_count += !enough;
		for (size_t p = 0; enough && p < piece->count; p++)
			if (is_inner(piece, p))
				marks[lines->place[piece->first + p]] = 1;
	}
}

static void copy(pass_writer *writer, size_t from, size_t to)
{
	pass_term(writer, from, 1.0);
	pass_row(writer, to);
}

/* Rows of one direction; the inner points alone. */
static void write_rows(stage *s, const pass_lines *lines, const pass_representation *r,
                       bool to_room)
{
	pass_writer *w = s->writer;
	for (size_t n = 0; n < lines->piece_count && w->status == BATTEN_OK; n++) {
		const pass_piece *piece = &lines->pieces[n];
		const double *along = lines->along_m + piece->first;
		if (piece->count < pass_least_points(r))
			continue;
		pass_stencil *stencils = batten_allocate(w->context, piece->count, sizeof *stencils);
		if (!stencils) {
			w->status = BATTEN_MEMORY;
			return;
		}
		pass_stencils_polygon(r->order, piece->count, along, stencils);
		for (size_t p = 1; p + 1 < piece->count; p++) {
			const size_t value = lines->place[piece->first + p];
			for (size_t j = 0; j < r->order; j++) {
				const size_t from = lines->place[piece->first + stencils[p].first + j];
				const bool moved = !to_room && from < s->values && s->moved[from];
				pass_term(w, moved ? s->room + from : from, stencils[p].weight[j]);
			}
			pass_row(w, to_room ? s->room + value : value);
		}
		batten_release(w->context, stencils);
	}
}

/* The first direction into the room, and beside it what the second one reads and writes. */
static void write_first(stage *s, const pass_lines *lines, const pass_representation *r,
                        const uint8_t *first)
{
	pass_operation(s->writer, PASS_ROWS);
	write_rows(s, lines, r, true);
	for (size_t v = 0; v < s->values; v++) {
		if (!first[v] && s->written[v])
			copy(s->writer, v, s->room + v);
		s->moved[v] = first[v] || s->written[v];
	}
}

static void write_back(stage *s)
{
	for (size_t v = 0; v < s->values; v++)
		if (s->moved[v] && !s->written[v])
			copy(s->writer, s->room + v, v);
}

static void write_fits(stage *s, const pass_lines *lines, const pass_representation *r)
{
	pass_operation(s->writer, PASS_FIT);
	for (size_t n = 0; n < lines->piece_count; n++) {
		const pass_piece *piece = &lines->pieces[n];
		if (piece->count < pass_least_points(r))
			continue;
		for (size_t p = 0; p < piece->count; p++) {
			const size_t value = lines->place[piece->first + p];
			const bool moved = value < s->values && s->moved[value];
			pass_point(s->writer, moved ? s->room + value : value, value,
			           lines->along_m[piece->first + p]);
		}
		pass_line(s->writer);
	}
}

/* first[v]: the first direction changes value v. */
static uint8_t *mark_first(pass_writer *writer, const pass_lines *lines,
                           const pass_representation *r, pass_task *task)
{
	uint8_t *marks = batten_allocate(writer->context, task->values, sizeof *marks);
	if (marks)
		mark(lines, pass_least_points(r), marks, task);
	else
		writer->status = BATTEN_MEMORY;
	return marks;
}

void pass_write_approximation(pass_writer *writer, pass_task *task)
{
	stage s;
	uint8_t *first = NULL;
	if (stage_create(writer, task->values, pass_stretches_room(writer, task->values), &s)) {
		first = mark_first(writer, task->waterlines, &task->along, task);
		mark(task->sections, pass_least_points(&task->across), s.written, task);
	}
	if (first) {
		write_first(&s, task->waterlines, &task->along, first);
		pass_operation(writer, PASS_ROWS);
		write_rows(&s, task->sections, &task->across, false);
		write_back(&s);
		pass_stretches_make(writer, task->values, s.room);
	}
	batten_release(writer->context, first);
	stage_release(&s);
}

void pass_write_fit(pass_writer *writer, pass_task *task)
{
	stage s;
	uint8_t *first = NULL;
	writer->numbers.shape[PASS_SHAPE_FIT_ORDER] = (int32_t)task->along.order;
	writer->numbers.shape[PASS_SHAPE_VERTICES] = (int32_t)task->along.vertices;
	if (stage_create(writer, task->values, pass_room(writer, task->values), &s)) {
		first = mark_first(writer, task->sections, &task->across, task);
		mark(task->waterlines, pass_least_points(&task->along), s.written, task);
	}
	if (first) {
		write_first(&s, task->sections, &task->across, first);
		write_fits(&s, task->waterlines, &task->along);
		pass_operation(writer, PASS_ROWS);
		write_back(&s);
		if (task->floored)
			pass_floor(writer, 0, task->values);
	}
	batten_release(writer->context, first);
	stage_release(&s);
}
