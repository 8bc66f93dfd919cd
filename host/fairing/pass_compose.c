#include "fairing/pass_compose.h"

#include <stdlib.h>
#include <string.h>

/* Products that may be gained at most, and zeros of tiles: what is read and written less pays for them. */
#define PRODUCTS_PART 1.5
#define TILE_PART 2.0

enum { POOL_LEAST = 1024 };

/* A number of the state as a sum of places below base. */
typedef struct sum {
	size_t first, count; /* terms in the pool; count SIZE_MAX: not written */
} sum;

typedef struct composition {
	pass_writer *writer;
	size_t base;
	sum *sums;       /* [state] */
	double *factors; /* [base], of the sum at work */
	uint8_t *used;   /* [base] */
	size_t *places;  /* [base], those used */
	size_t used_count;
	int32_t *pool_place;
	double *pool_factor;
	size_t pool_count, pool_room;
} composition;

static void release(composition *c)
{
	batten_context *context = c->writer->context;
	batten_release(context, c->sums);
	batten_release(context, c->factors);
	batten_release(context, c->used);
	batten_release(context, c->places);
	batten_release(context, c->pool_place);
	batten_release(context, c->pool_factor);
}

static bool begin(composition *c, pass_writer *writer, size_t base)
{
	batten_context *context = writer->context;
	const size_t state = (size_t)writer->numbers.shape[PASS_SHAPE_STATE];
	*c = (composition){ .writer = writer, .base = base, .pool_room = POOL_LEAST };
	c->pool_place = batten_allocate(context, POOL_LEAST, sizeof *c->pool_place);
	c->pool_factor = batten_allocate(context, POOL_LEAST, sizeof *c->pool_factor);
	c->sums = batten_allocate(context, state + 1, sizeof *c->sums);
	c->factors = batten_allocate(context, base + 1, sizeof *c->factors);
	c->used = batten_allocate(context, base + 1, sizeof *c->used);
	c->places = batten_allocate(context, base + 1, sizeof *c->places);
	if (!c->sums || !c->factors || !c->used || !c->places || !c->pool_place || !c->pool_factor) {
		writer->status = BATTEN_MEMORY;
		return false;
	}
	for (size_t n = 0; n < state; n++)
		c->sums[n].count = SIZE_MAX;
	return true;
}

static void add(composition *c, size_t place, double factor)
{
	if (!c->used[place]) {
		c->used[place] = 1;
		c->factors[place] = 0.0;
		c->places[c->used_count++] = place;
	}
	c->factors[place] += factor;
}

static int compare_places(const void *a, const void *b)
{
	const size_t left = *(const size_t *)a;
	const size_t right = *(const size_t *)b;
	return (left > right) - (left < right);
}

static bool make_room(composition *c, size_t count)
{
	batten_context *context = c->writer->context;
	if (c->pool_count + count <= c->pool_room)
		return true;
	const size_t room = 2 * (c->pool_room + count);
	int32_t *place = batten_allocate(context, room, sizeof *place);
	double *factor = batten_allocate(context, room, sizeof *factor);
	if (!place || !factor) {
		batten_release(context, place);
		batten_release(context, factor);
		c->writer->status = BATTEN_MEMORY;
		return false;
	}
	memcpy(place, c->pool_place, c->pool_count * sizeof *place);
	memcpy(factor, c->pool_factor, c->pool_count * sizeof *factor);
	batten_release(context, c->pool_place);
	batten_release(context, c->pool_factor);
	c->pool_place = place;
	c->pool_factor = factor;
	c->pool_room = room;
	return true;
}

/* The sum at work becomes that of a place. */
static bool keep(composition *c, size_t target)
{
	sum *s = &c->sums[target];
	if (!make_room(c, c->used_count))
		return false;
	qsort(c->places, c->used_count, sizeof *c->places, compare_places);
	*s = (sum){ .first = c->pool_count };
	for (size_t n = 0; n < c->used_count; n++) {
		const size_t place = c->places[n];
		c->used[place] = 0;
		if (c->factors[place] == 0.0)
			continue;
		c->pool_place[c->pool_count] = (int32_t)place;
		c->pool_factor[c->pool_count++] = c->factors[place];
		s->count++;
	}
	c->used_count = 0;
	return true;
}

/* false: a row reads what no row wrote, or memory is out. */
static bool compose_row(composition *c, size_t row)
{
	const pass_program_numbers *n = &c->writer->numbers;
	for (int32_t t = n->row_first[row]; t < n->row_first[row + 1]; t++) {
		const size_t index = (size_t)n->term_index[t];
		const sum *s = &c->sums[index];
		if (index < c->base) {
			add(c, index, n->term_factor[t]);
			continue;
		}
		if (s->count == SIZE_MAX)
			return false;
		for (size_t i = s->first; i < s->first + s->count; i++)
			add(c, (size_t)c->pool_place[i], n->term_factor[t] * c->pool_factor[i]);
	}
	return keep(c, (size_t)n->row_target[row]);
}

static bool is_rows_alone(const pass_writer *writer)
{
	for (size_t o = 0; o < writer->operation_count; o++)
		if (writer->numbers.operations[o * PASS_OPERATION_SIZE + PASS_KIND] != PASS_ROWS)
			return false;
	return true;
}

/* The next place that any of the sums of a tile reads, and what each takes of it; NONE at the end.
 * at: how far each sum is read. */
static size_t next_place(const composition *c, const sum *sums, size_t size, size_t *at,
                         double *factors)
{
	size_t next = SIZE_MAX;
	for (size_t i = 0; i < size; i++)
		if (at[i] < sums[i].count && (size_t)c->pool_place[sums[i].first + at[i]] < next)
			next = (size_t)c->pool_place[sums[i].first + at[i]];
	for (size_t i = 0; i < PASS_TILE; i++) {
		const bool here = next != SIZE_MAX && i < size && at[i] < sums[i].count &&
		                  (size_t)c->pool_place[sums[i].first + at[i]] == next;
		factors[i] = here ? c->pool_factor[sums[i].first + at[i]] : 0.0;
		at[i] += here;
	}
	return next;
}

/* Writes a tile; or (writer NULL) counts its products, zeros included. */
static size_t write_tile(const composition *c, pass_writer *writer, const sum *sums, size_t size)
{
	size_t at[PASS_TILE] = { 0 };
	size_t products = 0;
	double factors[PASS_TILE];
	for (size_t place = next_place(c, sums, size, at, factors); place != SIZE_MAX;
	     place = next_place(c, sums, size, at, factors)) {
		products += PASS_TILE;
		for (size_t i = 0; writer && i < PASS_TILE; i++)
			pass_put_term(writer, place, factors[i]);
	}
	return products;
}

static size_t tile_size(size_t count, size_t begin)
{
	return count - begin < PASS_TILE ? count - begin : PASS_TILE;
}

static void write_tiles(const composition *c, const sum *sums, size_t count, const size_t *targets)
{
	const size_t spare = pass_room(c->writer, 1);
	pass_operation(c->writer, PASS_TILES);
	for (size_t begin = 0; begin < count; begin += PASS_TILE) {
		const size_t size = tile_size(count, begin);
		(void)write_tile(c, c->writer, sums + begin, size);
		for (size_t i = 0; i < PASS_TILE; i++)
			pass_row(c->writer, i < size ? targets[begin + i] : spare);
	}
}

static void write_rows(const composition *c, const sum *sums, size_t count, const size_t *targets)
{
	pass_operation(c->writer, PASS_ROWS);
	for (size_t n = 0; n < count; n++) {
		for (size_t i = sums[n].first; i < sums[n].first + sums[n].count; i++)
			pass_put_term(c->writer, (size_t)c->pool_place[i], c->pool_factor[i]);
		if (sums[n].count == 0)
			pass_put_term(c->writer, 0, 0.0);
		pass_row(c->writer, targets[n]);
	}
}

static void replace(composition *c, size_t products, const sum *sums, size_t count, size_t *targets)
{
	pass_writer *writer = c->writer;
	size_t tiled = 0;
	for (size_t begin = 0; begin < count; begin += PASS_TILE)
		tiled += write_tile(c, NULL, sums + begin, tile_size(count, begin));
	pass_writer_clear(writer, c->base);
	const size_t room = pass_room(writer, count);
	for (size_t n = 0; n < count; n++)
		targets[n] = room + n;
	if ((double)tiled <= TILE_PART * (double)products)
		write_tiles(c, sums, count, targets);
	else
		write_rows(c, sums, count, targets);
	writer->product_count = products;
}

void pass_compose(pass_writer *writer, size_t base, size_t count, size_t *targets)
{
	composition c;
	if (writer->status != BATTEN_OK || count == 0 || !is_rows_alone(writer))
		return;
	bool good = begin(&c, writer, base);
	for (size_t row = 0; row < writer->numbers.row_count && good; row++)
		good = compose_row(&c, row);
	sum *sums = good ? batten_allocate(writer->context, count, sizeof *sums) : NULL;
	size_t products = 0;
	for (size_t n = 0; n < count && sums; n++) {
		sums[n] = c.sums[targets[n]];
		products += sums[n].count;
	}
	if (good && !sums)
		writer->status = BATTEN_MEMORY;
	else if (good && (double)products <= PRODUCTS_PART * (double)writer->numbers.term_count)
		replace(&c, products, sums, count, targets);
	batten_release(writer->context, sums);
	release(&c);
}
