/* A lattice of displacements as JSON (data/schema/lattice.schema.json); only poles that move are
 * listed. */
#include "geometry/bspline.h"
#include "io/json_reader.h"

#include <math.h>

static const char *const members[] = { "batten_lattice", "unit",   "frame", "from", "to",
	                                   "counts",         "orders", "moves" };

/* Numbers of one move: the pole along x, y, z, counted from 0, and how far it goes. */
enum { MOVE_NUMBERS = 6, POLES_MOST = 64 };

static batten_status read_three(const struct json_reader *reader, const char *name, double out[3])
{
	return json_reader_numbers(reader, json_object_get(reader->object, name), name, 3, out);
}

static batten_status read_whole(const struct json_reader *reader, const char *name, size_t out[3])
{
	double numbers[3];
	const batten_status status = read_three(reader, name, numbers);
	for (size_t c = 0; c < 3 && status == BATTEN_OK; c++) {
		if (!(numbers[c] >= 2 && numbers[c] <= POLES_MOST) || floor(numbers[c]) < numbers[c])
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: %s[%zu]: found %g, expected a whole number from 2 to %d",
			                   reader->file, name, c, numbers[c], POLES_MOST);
		out[c] = (size_t)numbers[c];
	}
	return status;
}

static batten_status read_move(const struct json_reader *reader, const json_t *row, size_t number,
                               const size_t count[3], double *shift_m, unsigned char *seen)
{
	char where[64];
	double move[MOVE_NUMBERS];
	(void)snprintf(where, sizeof where, "moves[%zu]", number);
	const batten_status status = json_reader_numbers(reader, row, where, MOVE_NUMBERS, move);
	if (status != BATTEN_OK)
		return status;
	for (size_t c = 0; c < 3; c++)
		if (!(move[c] >= 0 && move[c] < (double)count[c]) || floor(move[c]) < move[c])
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: %s[%zu]: found %g, expected the number of a pole, 0 to %zu",
			                   reader->file, where, c, move[c], count[c] - 1);
	const size_t pole = ((size_t)move[2] * count[1] + (size_t)move[1]) * count[0] + (size_t)move[0];
	if (seen[pole])
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: %s: pole %g,%g,%g occurs before, each is expected once",
		                   reader->file, where, move[0], move[1], move[2]);
	seen[pole] = 1;
	for (size_t c = 0; c < 3; c++)
		shift_m[3 * pole + c] = move[3 + c];
	return BATTEN_OK;
}

static batten_status read_moves(const struct json_reader *reader, batten_lattice_net *net,
                                double *shift_m, unsigned char *seen, batten_lattice **out)
{
	const json_t *moves = json_object_get(reader->object, "moves");
	if (!json_is_array(moves))
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: moves: found %s, expected an array of moves", reader->file,
		                   json_reader_kind(moves));
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < json_array_size(moves) && status == BATTEN_OK; i++)
		status = read_move(reader, json_array_get(moves, i), i, net->count, shift_m, seen);
	if (status != BATTEN_OK)
		return status;
	net->shift_m = shift_m;
	status = batten_lattice_create(reader->context, net, out);
	if (status == BATTEN_USAGE) /* what is wrong with it came out of the file */
		status = batten_fail(reader->context, BATTEN_INPUT, "%s: %s", reader->file,
		                     batten_context_error(reader->context));
	return status;
}

static batten_status read_lattice(const struct json_reader *reader, batten_lattice **out)
{
	size_t version = 0;
	batten_lattice_net net = { .shift_m = NULL };
	batten_status status = json_reader_members(reader, "a lattice", members,
	                                           sizeof members / sizeof members[0]);
	if (status == BATTEN_OK)
		status = json_reader_count(reader, "batten_lattice", 1, 1, &version);
	if (status == BATTEN_OK)
		status = json_reader_word(reader, "unit", "m");
	if (status == BATTEN_OK)
		status = json_reader_word(reader, "frame", "ap-fwd");
	if (status == BATTEN_OK)
		status = read_three(reader, "from", net.from_m);
	if (status == BATTEN_OK)
		status = read_three(reader, "to", net.to_m);
	if (status == BATTEN_OK)
		status = read_whole(reader, "counts", net.count);
	if (status == BATTEN_OK)
		status = read_whole(reader, "orders", net.order);
	if (status != BATTEN_OK)
		return status;
	const size_t poles = net.count[0] * net.count[1] * net.count[2];
	double *shift = batten_allocate(reader->context, poles, 3 * sizeof *shift);
	unsigned char *seen = batten_allocate(reader->context, poles, 1);
	status = shift && seen ? read_moves(reader, &net, shift, seen, out) : BATTEN_MEMORY;
	batten_release(reader->context, seen);
	batten_release(reader->context, shift);
	return status;
}

batten_status batten_lattice_read(batten_context *context, const char *path, batten_lattice **out)
{
	char *text = NULL;
	size_t length = 0;
	struct json_reader reader;
	*out = NULL;
	batten_status status = json_reader_load(context, path, &text, &length);
	if (status == BATTEN_OK)
		status = json_reader_open(context, path, text, length, &reader);
	if (status == BATTEN_OK) {
		status = read_lattice(&reader, out);
		json_decref(reader.object);
	}
	batten_release(context, text);
	return status;
}
