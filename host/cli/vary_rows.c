#include "vary_rows.h"

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* The longest file that is read. */
#define FILE_MOST ((size_t)1 << 26)

/* Numbers of the options by the names they have on the command line, and what methods take them. */
static const struct {
	const char *name;
	size_t place;
	unsigned takers;
} numbers[] = {
#define NUMBER(name, member, takers)                                                               \
	{                                                                                              \
		name, offsetof(batten_vary_options, member), takers                                        \
	}
	NUMBER("dcp", dcp_pct, VARY_HALVES),
	NUMBER("dcb", dcp_pct, VARY_TAKES(MOOR)),
	NUMBER("dlcb", dlcb_pct, VARY_MOVED),
	NUMBER("dcwp", dcwp_pct, VARY_TAKES(MOOR)),
	NUMBER("dlcf", dlcf_pct, VARY_TAKES(MOOR)),
	NUMBER("dp-fore", dp_fore_pct, VARY_TAKES(LACKENBY)),
	NUMBER("dp-aft", dp_aft_pct, VARY_TAKES(LACKENBY)),
	NUMBER("x", scale_x, VARY_TAKES(AFFINE)),
	NUMBER("y", scale_y, VARY_TAKES(AFFINE)),
	NUMBER("z", scale_z, VARY_TAKES(AFFINE)),
	NUMBER("volume_m3", volume_m3, VARY_TAKES(THREE_BODY)),
	NUMBER("lcb_pct_lbp_fwd", lcb_pct_lbp_fwd, VARY_TAKES(THREE_BODY)),
	NUMBER("cp", cp, VARY_TAKES(THREE_BODY)),
	NUMBER("amount", amount, VARY_TAKES(NONLINEAR)),
#undef NUMBER
};

/* ------------------------------------------------------------------------------------------------
 * The file
 * --------------------------------------------------------------------------------------------- */

/* Where the file is being read. */
struct reader {
	const vary_request *request;
	const char *path;
	char *next; /* the rest of the text */
	size_t line;
};

static batten_status fail(const struct reader *reader, size_t column, const char *found,
                          const char *expected)
{
	char line[512];
	(void)snprintf(line, sizeof line, "%s:%zu:%zu: found '%.60s', expected %s", reader->path,
	               reader->line, column, found, expected);
	cli_clean(line);
	(void)fprintf(stderr, "batten vary: %s\n", line);
	return BATTEN_INPUT;
}

static batten_status fail_memory(void)
{
	(void)fprintf(stderr, "batten vary: %s\n", batten_status_text(BATTEN_MEMORY));
	return BATTEN_MEMORY;
}

static batten_status read_stream(FILE *stream, size_t most, char **out, size_t *length)
{
	size_t room = 0;
	char *text = NULL;
	*length = 0;
	do {
		room = room ? 2 * room : 65536;
		char *longer = realloc(text, room);
		if (!longer) {
			free(text);
			return fail_memory();
		}
		text = longer;
		*length += fread(text + *length, 1, room - 1 - *length, stream);
	} while (*length == room - 1 && *length <= most);
	text[*length] = '\0';
	*out = text;
	return BATTEN_OK;
}

static batten_status read_file(const vary_request *request, const char *path, char **out)
{
	size_t limit = request->common.max_memory, length = 0;
	limit = limit > 0 && limit < FILE_MOST ? limit : FILE_MOST;
	FILE *stream = fopen(path, "rb");
	batten_status status = stream ? read_stream(stream, limit, out, &length) : BATTEN_IO;
	if (stream && status == BATTEN_OK && ferror(stream))
		status = BATTEN_IO;
	if (status == BATTEN_IO)
		(void)fprintf(stderr, "batten vary: %s: %s\n", path, strerror(errno));
	if (stream)
		(void)fclose(stream);
	if (status == BATTEN_OK && (length > limit || strlen(*out) != length)) {
		(void)fprintf(stderr, "batten vary: %s: %s\n", path,
		              length > limit ? "the file is too long" : "found a zero byte");
		status = BATTEN_INPUT;
	}
	return status;
}

/* The next line that is neither empty nor a comment, cut off; NULL behind the last. */
static char *next_line(struct reader *reader)
{
	while (reader->next) {
		char *line = reader->next, *end = strchr(line, '\n');
		reader->next = end ? end + 1 : NULL;
		reader->line++;
		if (end)
			*end = '\0';
		const size_t length = strlen(line);
		if (length > 0 && line[length - 1] == '\r')
			line[length - 1] = '\0';
		if (line[0] != '\0' && line[0] != '#')
			return line;
	}
	return NULL;
}

/* Cuts the next cell off a line, without the blanks around it; NULL behind the last. */
static char *next_cell(char **line)
{
	char *cell = *line;
	if (!cell)
		return NULL;
	char *end = strchr(cell, ',');
	*line = end ? end + 1 : NULL;
	if (!end)
		end = cell + strlen(cell);
	while (end > cell && (end[-1] == ' ' || end[-1] == '\t'))
		end--;
	*end = '\0';
	return cell + strspn(cell, " \t");
}

static bool read_number(const char *text, double *out)
{
	char *end = NULL;
	*out = strtod(text, &end);
	return end != text && *end == '\0' && isfinite(*out) && !strpbrk(text, "xX");
}

/* ------------------------------------------------------------------------------------------------
 * The header
 * --------------------------------------------------------------------------------------------- */

/* "weight", "weight1", ...; false for other names. */
static bool read_weight(const vary_request *request, const char *name, size_t *place)
{
	if (strncmp(name, "weight", 6) != 0)
		return false;
	*place = 0;
	if (name[6] == '\0')
		return request->other_count == 1;
	char *end = NULL;
	const unsigned long number = strtoul(name + 6, &end, 10);
	*place = number - 1;
	return name[6] >= '1' && name[6] <= '9' && *end == '\0' && number <= request->other_count;
}

static bool read_column(const vary_request *request, const vary_rows *rows, const char *name,
                        vary_column *out)
{
	*out = (vary_column){ .name = name };
	for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
		if (strcmp(name, numbers[i].name) == 0) {
			out->place = numbers[i].place;
			return (numbers[i].takers & (1u << request->options.method)) != 0;
		}
	switch (request->options.method) {
	case BATTEN_VARY_AVERAGE:
		out->kind = VARY_COLUMN_WEIGHT;
		return read_weight(request, name, &out->place);
	case BATTEN_VARY_STRETCH:
		out->kind = VARY_COLUMN_MOVE;
		out->place = rows->column_count;
		return read_number(name, &out->from);
	case BATTEN_VARY_FREE_FORM:
		out->kind = VARY_COLUMN_LATTICE;
		return strcmp(name, "lattice") == 0;
	default:
		return false;
	}
}

/* What a column is to be named. */
static void list_names(const vary_request *request, char *expected, size_t size)
{
	char names[256] = "";
	size_t used = 0;
	for (size_t i = 0; i < sizeof numbers / sizeof numbers[0] && used < sizeof names; i++)
		if (numbers[i].takers & (1u << request->options.method)) {
			const int length = snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
			                            numbers[i].name);
			used += length > 0 ? (size_t)length : 0;
		}
	if (request->options.method == BATTEN_VARY_AVERAGE)
		(void)snprintf(names, sizeof names,
		               request->other_count == 1 ? "weight" : "weight1 to weight%zu",
		               request->other_count);
	else if (request->options.method == BATTEN_VARY_STRETCH)
		(void)snprintf(names, sizeof names, "a place along the hull, 0 to 1");
	else if (request->options.method == BATTEN_VARY_FREE_FORM)
		(void)snprintf(names, sizeof names, "lattice");
	(void)snprintf(expected, size, "a name that %s takes: %s",
	               batten_vary_method_name((size_t)request->options.method), names);
}

static batten_status read_header(struct reader *reader, vary_rows *rows)
{
	char *line = next_line(reader);
	if (!line)
		return fail(reader, 1, "", "a first row of names");
	size_t number = 0;
	for (char *cell = next_cell(&line); cell; cell = next_cell(&line)) {
		number++;
		if (number == 1 && strcmp(cell, "id") == 0) {
			rows->named = true;
			continue;
		}
		if (rows->column_count == VARY_COLUMNS_MOST)
			return fail(reader, number, cell, "64 columns at most");
		vary_column *column = &rows->columns[rows->column_count];
		if (!read_column(reader->request, rows, cell, column)) {
			char expected[384];
			list_names(reader->request, expected, sizeof expected);
			return fail(reader, number, cell, expected);
		}
		for (size_t i = 0; i < rows->column_count; i++)
			if (rows->columns[i].name && strcmp(rows->columns[i].name, cell) == 0)
				return fail(reader, number, cell, "each name once");
		rows->column_count++;
	}
	return rows->column_count > 0 ? BATTEN_OK : fail(reader, number, "id", "a column of numbers");
}

/* ------------------------------------------------------------------------------------------------
 * The rows
 * --------------------------------------------------------------------------------------------- */

static batten_status take_line(const struct reader *reader, vary_rows *rows, char *line)
{
	const char **cells = rows->cells + rows->count * rows->column_count;
	const size_t names = rows->named;
	size_t number = 0;
	double ignored = 0;
	for (char *cell = next_cell(&line); cell; cell = next_cell(&line)) {
		if (number == names + rows->column_count)
			return fail(reader, number + 1, cell, "no more cells than names");
		if (number < names) {
			rows->names[rows->count] = cell;
		} else {
			const vary_column *column = &rows->columns[number - names];
			if (column->kind != VARY_COLUMN_LATTICE && *cell && !read_number(cell, &ignored))
				return fail(reader, number + 1, cell, "a number");
			cells[number - names] = cell;
		}
		number++;
	}
	if (number < names + rows->column_count)
		return fail(reader, number + 1, "", "as many cells as names");
	rows->count++;
	return BATTEN_OK;
}

static batten_status read_lines(struct reader *reader, vary_rows *rows)
{
	/* a cell and what ends it take a byte at least, the file 64 MB at most */
	const size_t length = reader->next ? strlen(reader->next) : 0;
	const size_t most = length / rows->column_count + 1;
	const size_t limit = reader->request->common.max_memory;
	if (limit > 0 && most * (rows->column_count + 1) > limit / sizeof *rows->cells)
		return fail_memory();
	rows->names = calloc(most, sizeof *rows->names);
	rows->cells = calloc(most, rows->column_count * sizeof *rows->cells);
	if (!rows->names || !rows->cells)
		return fail_memory();
	batten_status status = BATTEN_OK;
	for (char *line = next_line(reader); line && status == BATTEN_OK; line = next_line(reader))
		status = take_line(reader, rows, line);
	if (status == BATTEN_OK && rows->count == 0)
		status = fail(reader, 1, "", "a row");
	return status;
}

batten_status vary_rows_read(const vary_request *request, vary_rows *out)
{
	vary_rows rows = { 0 };
	struct reader reader = { .request = request, .path = request->rows };
	batten_status status = read_file(request, request->rows, &rows.text);
	reader.next = rows.text;
	if (status == BATTEN_OK)
		status = read_header(&reader, &rows);
	if (status == BATTEN_OK)
		status = read_lines(&reader, &rows);
	if (status == BATTEN_OK)
		*out = rows;
	else
		vary_rows_release(&rows);
	return status;
}

void vary_rows_release(vary_rows *rows)
{
	free(rows->text);
	free(rows->names);
	free(rows->cells);
	*rows = (vary_rows){ 0 };
}

double vary_rows_number(const vary_rows *rows, size_t row, size_t column)
{
	double value = NAN;
	return read_number(rows->cells[row * rows->column_count + column], &value) ? value : NAN;
}

batten_status vary_rows_bind(batten_context *context, const vary_request *request,
                             const vary_rows *rows, size_t row, vary_row_room *room,
                             batten_vary_options *out)
{
	batten_status status = BATTEN_OK;
	*out = request->options;
	memcpy(room->weights, request->weights, sizeof room->weights);
	memcpy(room->from, request->from, sizeof room->from);
	memcpy(room->to, request->to, sizeof room->to);
	room->lattice = NULL;
	out->weights = room->weights;
	out->from_part = room->from;
	out->to_part = room->to;
	for (size_t i = 0; i < rows->column_count && status == BATTEN_OK; i++) {
		const vary_column *column = &rows->columns[i];
		const char *cell = rows->cells[row * rows->column_count + i];
		const double value = vary_rows_number(rows, row, i);
		if (column->kind == VARY_COLUMN_MOVE) {
			/* the columns are all points there are; an empty cell leaves its point in place */
			room->from[column->place] = column->from;
			room->to[column->place] = *cell ? value : column->from;
			out->point_count = rows->column_count;
		} else if (*cell == '\0') {
			continue;
		} else if (column->kind == VARY_COLUMN_LATTICE) {
			status = batten_lattice_read(context, cell, &room->lattice);
			out->lattice = room->lattice;
		} else if (column->kind == VARY_COLUMN_WEIGHT) {
			room->weights[column->place] = value;
		} else {
			*(double *)((char *)out + column->place) = value;
		}
	}
	return status;
}
