/* Inverse fairing (thesis 6) as a program. The second derivatives along both directions are two fields
 * over the hull, each represented by a tensor-product B-spline; what that changes in them, e, asks for
 * a change of the offsets, delta, whose second derivatives are e. At a point with steps a and b to its
 * neighbours the equation is multiplied by a b: it is then one of lengths, and both directions count
 * alike. Ends of lines stay. A single line has as many equations as unknowns: they are met exactly.
 *
 * Fields that do not change ask for nothing: e is 0, and so is delta, to the last bit. */
#include "fairing/pass_compose.h"
#include "fairing/pass_forward.h"
#include "fairing/pass_system.h"

#define NONE SIZE_MAX

enum { WATERLINES, SECTIONS, DIRECTIONS };

/* The second derivatives along the lines of one direction, by number of the point. */
typedef struct field {
	const pass_lines *lines;
	pass_representation own, other; /* along these lines and across them */
	size_t given;                   /* place of point 0's in the state */
	size_t *at;                     /* where the smoothed one is; NONE at ends */
	size_t *point;                  /* [values]: inner point there, or NONE */
} field;

typedef struct inverse {
	pass_writer *writer;
	pass_task *task;
	field fields[DIRECTIONS];
	size_t unknown_count;
	size_t *unknown; /* [values]: its number, or NONE */
	size_t *right;   /* [unknowns]: right side, then the change */
	size_t *value;   /* [unknowns] */
	size_t *in, *out;
	double *along;
} inverse;

static void *room_for(inverse *v, size_t count)
{
	void *memory = batten_allocate(v->writer->context, count, sizeof(size_t));
	if (!memory)
		v->writer->status = BATTEN_MEMORY;
	return memory;
}

static void begin_field(inverse *v, int direction, const pass_lines *lines)
{
	const pass_task *task = v->task;
	field *f = &v->fields[direction];
	f->lines = lines;
	f->own = direction == WATERLINES ? task->along : task->across;
	f->other = direction == WATERLINES ? task->across : task->along;
	f->given = pass_room(v->writer, lines->point_count);
	f->at = room_for(v, lines->point_count);
	f->point = room_for(v, task->values);
	for (size_t n = 0; f->point && n < task->values; n++)
		f->point[n] = NONE;
	for (size_t p = 0; f->at && p < lines->point_count; p++)
		f->at[p] = NONE;
}

static void begin(inverse *v, pass_writer *writer, pass_task *task)
{
	*v = (inverse){ .writer = writer, .task = task };
	begin_field(v, WATERLINES, task->waterlines);
	begin_field(v, SECTIONS, task->sections);
	const size_t points = task->waterlines->point_count + task->sections->point_count;
	v->unknown = room_for(v, task->values);
	v->right = room_for(v, task->values);
	v->value = room_for(v, task->values);
	v->in = room_for(v, points);
	v->out = room_for(v, points);
	v->along = batten_allocate(writer->context, points, sizeof *v->along);
	if (!v->along)
		writer->status = BATTEN_MEMORY;
}

static void end(inverse *v)
{
	void *memory[] = { v->fields[0].at, v->fields[0].point,
		               v->fields[1].at, v->fields[1].point,
		               v->unknown,      v->right,
		               v->value,        v->in,
		               v->out,          v->along };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(v->writer->context, memory[i]);
}

/* The second difference at an inner point: factors of the points before, at and after it. */
static void difference(const double *along, double factors[3])
{
	const double before = along[0] - along[-1];
	const double after = along[1] - along[0];
	factors[0] = 2.0 / (before * (before + after));
	factors[2] = 2.0 / (after * (before + after));
	factors[1] = -(factors[0] + factors[2]);
}

static void write_differences(inverse *v, field *f)
{
	const pass_lines *lines = f->lines;
	for (size_t n = 0; n < lines->piece_count; n++) {
		const pass_piece *piece = &lines->pieces[n];
		for (size_t p = piece->first + 1; p + 1 < piece->first + piece->count; p++) {
			double factors[3];
			difference(lines->along_m + p, factors);
			for (size_t j = 0; j < 3; j++)
				pass_term(v->writer, lines->place[p - 1 + j], factors[j]);
			pass_row(v->writer, f->given + p);
			f->at[p] = f->given + p;
			if (lines->place[p] < v->task->values)
				f->point[lines->place[p]] = p;
		}
	}
}

/* Smooths the field at count points, whose numbers lie in v->in and whose places along the line in
 * v->along. */
static bool smooth(inverse *v, const field *f, const pass_representation *r, size_t count)
{
	bool done = false;
	if (count < pass_least_points(r))
		return false;
	const size_t room = pass_room(v->writer, count);
	size_t *places = room_for(v, count);
	for (size_t i = 0; places && i < count; i++) {
		places[i] = f->at[v->in[i]];
		v->out[i] = room + i;
	}
	if (places)
		pass_smooth(v->writer, r, count, v->along, places, v->out, &done);
	for (size_t i = 0; done && i < count; i++)
		f->at[v->in[i]] = v->out[i];
	batten_release(v->writer->context, places);
	return done;
}

static void smooth_own(inverse *v, const field *f)
{
	const pass_lines *lines = f->lines;
	pass_operation(v->writer, PASS_ROWS);
	for (size_t n = 0; n < lines->piece_count && v->writer->status == BATTEN_OK; n++) {
		const pass_piece *piece = &lines->pieces[n];
		const size_t count = piece->count - 2;
		for (size_t i = 0; piece->count > 2 && i < count; i++) {
			v->in[i] = piece->first + 1 + i;
			v->along[i] = lines->along_m[piece->first + 1 + i];
		}
		const bool done = piece->count > 2 && smooth(v, f, &f->own, count);
		v->task->faired_count += done;
		v->task->passed_count += !done;
	}
}

/* The other factor of the tensor product: along the lines of the other direction, wherever points of
 * the field follow each other. */
static void smooth_other(inverse *v, const field *f, const pass_lines *others)
{
	pass_operation(v->writer, PASS_ROWS);
	for (size_t n = 0; n < others->piece_count && v->writer->status == BATTEN_OK; n++) {
		const pass_piece *piece = &others->pieces[n];
		size_t count = 0;
		for (size_t p = piece->first; p < piece->first + piece->count; p++) {
			const size_t place = others->place[p];
			const size_t point = place < v->task->values ? f->point[place] : NONE;
			if (point != NONE) {
				v->in[count] = point;
				v->along[count++] = others->along_m[p];
			}
			if (point == NONE || p + 1 == piece->first + piece->count) {
				(void)smooth(v, f, &f->other, count);
				count = 0;
			}
		}
	}
}

/* Numbers the values that may move, line after line of the direction that has more of them, so that
 * equations reach back as little as they can. */
static void number_unknowns(inverse *v)
{
	const pass_task *task = v->task;
	const bool by_waterlines = task->waterlines->piece_count >= task->sections->piece_count;
	const pass_lines *order[] = { by_waterlines ? task->waterlines : task->sections,
		                          by_waterlines ? task->sections : task->waterlines };
	for (size_t n = 0; n < task->values; n++)
		v->unknown[n] = 0;
	for (size_t d = 0; d < DIRECTIONS; d++)
		for (size_t n = 0; n < order[d]->piece_count; n++) {
			const pass_piece *piece = &order[d]->pieces[n];
			const size_t ends[] = { order[d]->place[piece->first],
				                    order[d]->place[piece->first + piece->count - 1] };
			for (size_t e = 0; e < 2; e++)
				if (ends[e] < task->values)
					v->unknown[ends[e]] = NONE;
		}
	for (size_t d = 0; d < DIRECTIONS; d++)
		for (size_t p = 0; p < order[d]->point_count; p++) {
			const size_t value = order[d]->place[p];
			const bool inner = value < task->values && v->unknown[value] == 0 &&
			                   (v->fields[0].point[value] != NONE ||
			                    v->fields[1].point[value] != NONE);
			if (inner) {
				v->value[v->unknown_count++] = value;
				v->unknown[value] = v->unknown_count; /* one more, so that 0 stays free */
			}
		}
	for (size_t n = 0; n < task->values; n++)
		v->unknown[n] = v->unknown[n] == NONE || v->unknown[n] == 0 ? NONE : v->unknown[n] - 1;
}

/* The equation of an inner point: unknowns or NONE, their factors, and the factor of its e. */
typedef struct equation {
	size_t unknowns[3];
	double factors[3], scale;
} equation;

static equation equation_at(const inverse *v, const field *f, size_t p)
{
	const double *along = f->lines->along_m + p;
	equation e = { .scale = (along[0] - along[-1]) * (along[1] - along[0]) };
	difference(along, e.factors);
	for (size_t j = 0; j < 3; j++) {
		const size_t place = f->lines->place[p - 1 + j];
		e.unknowns[j] = place < v->task->values ? v->unknown[place] : NONE;
		e.factors[j] *= e.scale;
	}
	return e;
}

/* What is done with every equation. */
typedef void use_equation(inverse *v, const field *f, size_t p, const equation *e, void *with);

static void each_equation(inverse *v, use_equation *use, void *with)
{
	for (size_t d = 0; d < DIRECTIONS; d++) {
		const pass_lines *lines = v->fields[d].lines;
		for (size_t n = 0; n < lines->piece_count; n++)
			for (size_t p = lines->pieces[n].first + 1;
			     p + 1 < lines->pieces[n].first + lines->pieces[n].count; p++) {
				const equation e = equation_at(v, &v->fields[d], p);
				use(v, &v->fields[d], p, &e, with);
			}
	}
}

static void reach_back(inverse *v, const field *f, size_t p, const equation *e, void *with)
{
	(void)v;
	(void)f;
	(void)p;
	size_t *first = with;
	for (size_t a = 0; a < 3; a++)
		for (size_t b = 0; b < 3; b++)
			if (e->unknowns[a] != NONE && e->unknowns[b] < first[e->unknowns[a]])
				first[e->unknowns[a]] = e->unknowns[b];
}

/* Whether there is a single line, whose equations are the system, but for their scale. */
static bool is_single(const inverse *v)
{
	return v->fields[SECTIONS].lines->piece_count == 0;
}

static void add_equation(inverse *v, const field *f, size_t p, const equation *e, void *with)
{
	pass_system *system = with;
	for (size_t a = 0; a < 3; a++)
		for (size_t b = 0; b <= a; b++) {
			if (e->unknowns[a] == NONE || e->unknowns[b] == NONE)
				continue;
			if (!is_single(v)) {
				pass_system_add(system, e->unknowns[a], e->unknowns[b],
				                e->factors[a] * e->factors[b]);
			} else if (a == 1) {
				/* Symmetric and positive when multiplied by minus half the span. */
				const double *along = f->lines->along_m + p;
				const double half = 0.5 * (along[1] - along[-1]);
				pass_system_add(system, e->unknowns[a], e->unknowns[b],
				                -e->factors[b] / e->scale * half);
			}
		}
}

/* What representing the fields changes in them, e, at all points where it changes anything. */
static void write_changes(inverse *v)
{
	pass_operation(v->writer, PASS_ROWS);
	for (size_t d = 0; d < DIRECTIONS; d++) {
		field *f = &v->fields[d];
		for (size_t p = 0; p < f->lines->point_count; p++) {
			if (f->at[p] == NONE || f->at[p] == f->given + p)
				continue;
			const size_t change = pass_room(v->writer, 1);
			pass_term(v->writer, f->at[p], 1.0);
			pass_term(v->writer, f->given + p, -1.0);
			pass_row(v->writer, change);
			f->at[p] = change;
		}
	}
}

/* The right side of an unknown: all equations that it is in, those that ask for nothing left out. */
static void write_right(inverse *v, size_t unknown)
{
	const size_t value = v->value[unknown];
	size_t terms = 0;
	for (size_t d = 0; d < DIRECTIONS; d++) {
		const field *f = &v->fields[d];
		const size_t p = f->point[value];
		for (size_t j = 0; p != NONE && j < 3; j++) {
			const size_t q = p + 1 - j; /* the unknown is its point j: before, at, after */
			if (f->at[q] == NONE || f->at[q] == f->given + q || (is_single(v) && j != 1))
				continue;
			const equation e = equation_at(v, f, q);
			const double *along = f->lines->along_m + q;
			const double factor = is_single(v) ? -0.5 * (along[1] - along[-1])
			                                   : e.factors[j] * e.scale;
			pass_term(v->writer, f->at[q], factor);
			terms++;
		}
	}
	if (terms == 0)
		pass_term(v->writer, value, 0.0);
	pass_row(v->writer, v->right[unknown]);
}

static void write_solution(inverse *v)
{
	pass_writer *writer = v->writer;
	pass_system system = { 0 };
	size_t *first = room_for(v, v->unknown_count);
	for (size_t u = 0; first && u < v->unknown_count; u++)
		first[u] = u;
	if (first) {
		each_equation(v, reach_back, first);
		writer->status = pass_system_create(writer->context, v->unknown_count, first, &system);
	}
	if (writer->status == BATTEN_OK) {
		each_equation(v, add_equation, &system);
		if (!pass_system_factor(&system))
			writer->status = batten_fail(
				writer->context, BATTEN_INPUT,
				"inverse fairing: the spacings of the table are too uneven "
				"to solve for its offsets");
	}
	if (writer->status == BATTEN_OK) {
		write_changes(v);
		pass_operation(writer, PASS_ROWS);
		for (size_t u = 0; u < v->unknown_count; u++)
			write_right(v, u);
		const size_t constants = (size_t)writer->numbers.shape[PASS_SHAPE_CONSTANTS];
		pass_compose(writer, v->task->values + constants, v->unknown_count, v->right);
		pass_system_write(&system, writer, v->right);
		pass_operation(writer, PASS_ADD);
		for (size_t u = 0; u < v->unknown_count; u++) {
			pass_term(writer, v->right[u], 1.0);
			pass_row(writer, v->value[u]);
		}
	}
	pass_system_release(&system);
	batten_release(writer->context, first);
}

void pass_write_inverse(pass_writer *writer, pass_task *task)
{
	inverse v;
	begin(&v, writer, task);
	if (writer->status == BATTEN_OK) {
		pass_operation(writer, PASS_ROWS);
		for (size_t d = 0; d < DIRECTIONS; d++)
			write_differences(&v, &v.fields[d]);
		for (size_t d = 0; d < DIRECTIONS; d++)
			smooth_own(&v, &v.fields[d]);
		smooth_other(&v, &v.fields[WATERLINES], task->sections);
		smooth_other(&v, &v.fields[SECTIONS], task->waterlines);
		number_unknowns(&v);
		const size_t room = pass_room(writer, v.unknown_count);
		for (size_t u = 0; u < v.unknown_count; u++)
			v.right[u] = room + u;
	}
	if (writer->status == BATTEN_OK && v.unknown_count > 0)
		write_solution(&v);
	if (task->floored)
		pass_floor(writer, 0, task->values);
	end(&v);
}
