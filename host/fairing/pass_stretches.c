#include "fairing/pass_stretches.h"

#include <string.h>

/* Factors there may be for each that is no zero, at most. A vector of them costs about what a term of a
 * row costs, which is worked for as many hulls, but rows have their hulls turned into lanes and back. */
#define FACTORS_PART 8.0

/* A term of a stretch: the place that its first target reads, counted from PASS_STRETCH before the state,
 * and the factor of each. */
typedef struct term {
	size_t place;
	double factor[PASS_STRETCH];
} term;

enum { STAGES = 2, TERMS_MOST = PASS_STRETCH * PASS_ORDER_MOST };

typedef struct work {
	pass_writer *writer;
	size_t values, room;
	pass_program_numbers rows; /* as they were */
	size_t second;             /* the first row of the second operation */
	size_t *row_of[STAGES];    /* [values]: row + 1 of each number; 0: none */
	term *terms;               /* of the stretch at work, places ascending */
	size_t term_count;
} work;

size_t pass_stretches_room(pass_writer *writer, size_t values)
{
	const size_t begun = (size_t)writer->numbers.shape[PASS_SHAPE_STATE];
	(void)pass_room(writer, 2 * PASS_STRETCH - begun % PASS_STRETCH);
	return pass_room(writer, values);
}

static void release(work *w)
{
	for (size_t s = 0; s < STAGES; s++)
		batten_release(w->writer->context, w->row_of[s]);
	batten_release(w->writer->context, w->terms);
}

static bool begin(work *w, pass_writer *writer, size_t values, size_t room)
{
	*w = (work){ .writer = writer, .values = values, .room = room, .rows = writer->numbers };
	w->second = (size_t)w->rows.operations[PASS_OPERATION_SIZE + PASS_FIRST];
	w->terms = batten_allocate(writer->context, TERMS_MOST, sizeof *w->terms);
	bool good = w->terms != NULL;
	for (size_t s = 0; s < STAGES; s++) {
		w->row_of[s] = batten_allocate(writer->context, values, sizeof *w->row_of[s]);
		good = good && w->row_of[s];
	}
	for (size_t r = 0; r < w->rows.row_count && good; r++) {
		const size_t target = (size_t)w->rows.row_target[r];
		if (r < w->second)
			w->row_of[0][target - room] = r + 1;
		else
			w->row_of[1][target] = r + 1;
	}
	if (!good)
		writer->status = BATTEN_MEMORY;
	return good;
}

static void add(work *w, size_t target, size_t index, double factor)
{
	const size_t place = index + PASS_STRETCH - target;
	size_t n = 0;
	while (n < w->term_count && w->terms[n].place < place)
		n++;
	if (n == w->term_count || w->terms[n].place != place) {
		memmove(w->terms + n + 1, w->terms + n, (w->term_count - n) * sizeof *w->terms);
		w->terms[n] = (term){ .place = place };
		w->term_count++;
	}
	w->terms[n].factor[target] += factor;
}

/* The terms of the stretch that begins at a value. */
static void collect(work *w, size_t stage, size_t first)
{
	w->term_count = 0;
	for (size_t i = 0; i < PASS_STRETCH; i++) {
		const size_t row = w->row_of[stage][first + i];
		if (row == 0) {
			add(w, i, (stage == 0 ? 0 : w->room) + first + i, 1.0);
			continue;
		}
		for (int32_t t = w->rows.row_first[row - 1]; t < w->rows.row_first[row]; t++)
			if (w->rows.term_factor[t] != 0.0)
				add(w, i, (size_t)w->rows.term_index[t], w->rows.term_factor[t]);
	}
}

/* Where the next stretch begins: the last one may begin where the one before has not ended, and then
 * writes the same numbers again. */
static size_t begin_of(const work *w, size_t at)
{
	return at + PASS_STRETCH > w->values ? w->values - PASS_STRETCH : at;
}

static bool pays(work *w)
{
	size_t factors = 0;
	for (size_t stage = 0; stage < STAGES; stage++)
		for (size_t at = 0; at < w->values; at += PASS_STRETCH) {
			collect(w, stage, begin_of(w, at));
			factors += w->term_count * PASS_STRETCH;
		}
	return (double)factors <= FACTORS_PART * (double)w->rows.term_count;
}

static void write_stage(work *w, size_t stage)
{
	pass_operation(w->writer, PASS_STRETCHES);
	for (size_t at = 0; at < w->values; at += PASS_STRETCH) {
		const size_t first = begin_of(w, at);
		collect(w, stage, first);
		for (size_t n = 0; n < w->term_count; n++)
			for (size_t i = 0; i < PASS_STRETCH; i++)
				pass_put_term(w->writer, w->terms[n].place, w->terms[n].factor[i]);
		pass_row(w->writer, (stage == 0 ? w->room : 0) + first);
	}
}

/* One index a term and not a factor: there are so few of them that they stay in the cache. */
static void gather_indices(pass_program_numbers *n)
{
	for (size_t row = 0; row <= n->row_count; row++)
		n->row_first[row] /= PASS_STRETCH;
	for (size_t t = 0; t < n->term_count / PASS_STRETCH; t++)
		n->term_index[t] = n->term_index[t * PASS_STRETCH];
}

void pass_stretches_make(pass_writer *writer, size_t values, size_t room)
{
	work w = { 0 };
	if (writer->status != BATTEN_OK || values < PASS_STRETCH || writer->operation_count != STAGES)
		return;
	if (begin(&w, writer, values, room) && pays(&w)) {
		pass_writer_renew_rows(writer);
		writer->numbers.shape[PASS_SHAPE_STRETCHES] = 1;
		for (size_t stage = 0; stage < STAGES; stage++)
			write_stage(&w, stage);
		gather_indices(&writer->numbers);
		batten_release(writer->context, w.rows.row_first);
		batten_release(writer->context, w.rows.row_target);
		batten_release(writer->context, w.rows.term_index);
		batten_release(writer->context, w.rows.term_factor);
	}
	release(&w);
}
