#include "fairing/pass_system.h"

#include <math.h>
#include <string.h>

#define PIVOT_PART 1e-14

batten_status pass_system_create(batten_context *context, size_t count, const size_t *first,
                                 pass_system *out)
{
	pass_system s = { .context = context, .count = count };
	s.first = batten_allocate(context, count, sizeof *s.first);
	s.start = batten_allocate(context, count + 1, sizeof *s.start);
	if (!s.first || !s.start) {
		pass_system_release(&s);
		return BATTEN_MEMORY;
	}
	for (size_t i = 0; i < count; i++) {
		s.first[i] = first[i];
		s.start[i + 1] = s.start[i] + (i - first[i] + 1);
	}
	s.values = batten_allocate(context, s.start[count], sizeof *s.values);
	if (!s.values) {
		pass_system_release(&s);
		return BATTEN_MEMORY;
	}
	*out = s;
	return BATTEN_OK;
}

void pass_system_release(pass_system *system)
{
	if (system->context) {
		batten_release(system->context, system->first);
		batten_release(system->context, system->start);
		batten_release(system->context, system->values);
	}
	*system = (pass_system){ 0 };
}

static double *place(const pass_system *s, size_t i, size_t j)
{
	return &s->values[s->start[i] + j - s->first[i]];
}

/* Number in row i and column j, j <= i; 0 where the row does not reach. */
static double entry(const pass_system *s, size_t i, size_t j)
{
	return j >= s->first[i] ? *place(s, i, j) : 0.0;
}

void pass_system_add(pass_system *system, size_t i, size_t j, double value)
{
	*place(system, i > j ? i : j, i > j ? j : i) += value;
}

bool pass_system_factor(pass_system *system)
{
	for (size_t i = 0; i < system->count; i++)
		for (size_t j = system->first[i]; j <= i; j++) {
			const size_t begin = system->first[j] > system->first[i] ? system->first[j]
			                                                         : system->first[i];
			const double given = *place(system, i, j);
			double sum = given;
			for (size_t q = begin; q < j; q++)
				sum -= *place(system, i, q) * *place(system, j, q);
			if (j < i)
				*place(system, i, j) = sum / *place(system, j, j);
			else if (sum > PIVOT_PART * given)
				*place(system, i, i) = sqrt(sum);
			else
				return false;
		}
	return true;
}

/* For each column the last row that reaches back to it. */
static size_t *last_rows(const pass_system *s)
{
	size_t *last = batten_allocate(s->context, s->count, sizeof *last);
	for (size_t i = 0; last && i < s->count; i++)
		for (size_t j = s->first[i]; j <= i; j++)
			last[j] = i;
	return last;
}

/* A tile: PASS_TILE unknowns from `begin` on, fewer at the end. */
typedef struct tile {
	size_t begin, size;
	double inverse[PASS_TILE][PASS_TILE]; /* of its part of the factor's diagonal */
} tile;

static tile tile_at(const pass_system *s, size_t begin)
{
	tile t = { .begin = begin,
		       .size = s->count - begin < PASS_TILE ? s->count - begin : PASS_TILE };
	for (size_t i = 0; i < t.size; i++)
		for (size_t j = 0; j <= i; j++) {
			double sum = i == j ? 1.0 : 0.0;
			for (size_t q = j; q < i; q++)
				sum -= entry(s, begin + i, begin + q) * t.inverse[q][j];
			t.inverse[i][j] = sum / entry(s, begin + i, begin + i);
		}
	return t;
}

/* What unknown j, solved before, takes from each of the tile's; nothing is written for none. column:
 * of the factor, or of its transpose. */
static void write_known(pass_writer *writer, const tile *t, size_t index,
                        const double column[PASS_TILE], bool transposed)
{
	double factors[PASS_TILE] = { 0.0 };
	bool any = false;
	for (size_t i = 0; i < t->size; i++) {
		for (size_t q = 0; q < t->size; q++)
			factors[i] -= (transposed ? t->inverse[q][i] : t->inverse[i][q]) * column[q];
		any = any || factors[i] != 0.0;
		writer->product_count += column[i] != 0.0;
	}
	for (size_t i = 0; any && i < PASS_TILE; i++)
		pass_put_term(writer, index, factors[i]);
}

/* The tile's own right sides come first: what was solved last is waited for last. */
static void write_own(pass_writer *writer, const tile *t, const size_t *right, bool transposed)
{
	for (size_t q = 0; q < t->size; q++)
		for (size_t i = 0; i < PASS_TILE; i++)
			pass_put_term(writer, right[t->begin + q],
			              transposed ? t->inverse[q][i] : t->inverse[i][q]);
	writer->product_count += t->size * (t->size + 1) / 2;
}

static void end_tile(pass_writer *writer, const tile *t, const size_t *right, size_t spare)
{
	for (size_t i = 0; i < PASS_TILE; i++)
		pass_row(writer, i < t->size ? right[t->begin + i] : spare);
}

static void write_forward(const pass_system *s, pass_writer *writer, const tile *t,
                          const size_t *right, size_t spare)
{
	size_t first = t->begin;
	for (size_t i = 0; i < t->size; i++)
		if (s->first[t->begin + i] < first)
			first = s->first[t->begin + i];
	write_own(writer, t, right, false);
	for (size_t j = first; j < t->begin; j++) {
		double column[PASS_TILE];
		for (size_t i = 0; i < t->size; i++)
			column[i] = entry(s, t->begin + i, j);
		write_known(writer, t, right[j], column, false);
	}
	end_tile(writer, t, right, spare);
}

static void write_backward(const pass_system *s, pass_writer *writer, const tile *t,
                           const size_t *right, const size_t *last_row, size_t spare)
{
	size_t last = t->begin;
	for (size_t i = 0; i < t->size; i++)
		if (last_row[t->begin + i] > last)
			last = last_row[t->begin + i];
	write_own(writer, t, right, true);
	for (size_t j = last; j >= t->begin + t->size; j--) {
		double column[PASS_TILE];
		for (size_t i = 0; i < t->size; i++)
			column[i] = entry(s, j, t->begin + i);
		write_known(writer, t, right[j], column, true);
	}
	end_tile(writer, t, right, spare);
}

void pass_system_write(const pass_system *system, pass_writer *writer, const size_t *right)
{
	size_t *last = last_rows(system);
	if (!last) {
		writer->status = BATTEN_MEMORY;
		return;
	}
	/* The last tile has rows to spare; what they give goes to a place of its own. */
	const size_t spare = pass_room(writer, 1);
	const size_t tiles = (system->count + PASS_TILE - 1) / PASS_TILE;
	pass_operation(writer, PASS_TILES_IN_ORDER);
	for (size_t n = 0; n < tiles; n++) {
		const tile t = tile_at(system, n * PASS_TILE);
		write_forward(system, writer, &t, right, spare);
	}
	for (size_t n = tiles; n-- > 0;) {
		const tile t = tile_at(system, n * PASS_TILE);
		write_backward(system, writer, &t, right, last, spare);
	}
	batten_release(system->context, last);
}
