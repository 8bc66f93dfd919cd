/* Rows of a sweep given one by one: CSV, a header of the parameters' names, a row a design. */
#include "sweep/plan_parts.h"

#include "core/number.h"

#include <math.h>
#include <string.h>

/* The text and the line that is read. */
struct rows {
	batten_context *context;
	const char *file; /* as the plan names it */
	const char *text, *end;
	size_t line;
};

/* The next line that is neither empty nor a comment; false at the end. */
static bool next_line(struct rows *rows, const char **line, size_t *length)
{
	while (rows->text < rows->end) {
		const char *start = rows->text;
		const char *stop = memchr(start, '\n', (size_t)(rows->end - start));
		rows->text = stop ? stop + 1 : rows->end;
		rows->line++;
		*length = (size_t)((stop ? stop : rows->end) - start);
		if (*length > 0 && start[*length - 1] == '\r')
			--*length;
		*line = start;
		if (*length > 0 && start[0] != '#')
			return true;
	}
	return false;
}

/* The next cell of a line, without blanks around it; false behind the last. */
static bool next_cell(const char **at, const char *end, const char **cell, size_t *length)
{
	if (*at > end)
		return false;
	const char *start = *at;
	const char *comma = memchr(start, ',', (size_t)(end - start));
	const char *stop = comma ? comma : end;
	*at = comma ? comma + 1 : end + 1;
	while (start < stop && (*start == ' ' || *start == '\t'))
		start++;
	while (stop > start && (stop[-1] == ' ' || stop[-1] == '\t'))
		stop--;
	*cell = start;
	*length = (size_t)(stop - start);
	return true;
}

static batten_status fail(const struct rows *rows, size_t column, const char *cell, size_t length,
                          const char *expected)
{
	return batten_fail(rows->context, BATTEN_INPUT, "%s:%zu:%zu: found '%.*s', expected %s",
	                   rows->file, rows->line, column, length < 60 ? (int)length : 60, cell,
	                   expected);
}

static batten_status take_name(const struct rows *rows, sweep_sampling *sampling, const char *cell,
                               size_t length)
{
	const size_t column = sampling->parameter_count + 1;
	char name[SAMPLING_NAME_MOST + 1] = "";
	if (length <= SAMPLING_NAME_MOST)
		memcpy(name, cell, length);
	if (!plan_is_name(name) || strcmp(name, "id") == 0 ||
	    sweep_measure_number(name, strlen(name)) != SIZE_MAX)
		return fail(rows, column, cell, length, "a name for a parameter, which no measure has");
	for (size_t p = 0; p < sampling->parameter_count; p++)
		if (strcmp(sampling->parameters[p].name, name) == 0)
			return fail(rows, column, cell, length, "another name than before it");
	if (sampling->parameter_count == SAMPLING_PARAMETERS_MOST)
		return fail(rows, column, cell, length, "no more parameters");
	memcpy(sampling->parameters[sampling->parameter_count++].name, name, sizeof name);
	return BATTEN_OK;
}

static batten_status read_header(struct rows *rows, sweep_sampling *sampling)
{
	const char *line = "";
	const char *cell = "";
	size_t length = 0;
	if (!next_line(rows, &line, &length))
		return fail(rows, 1, "", 0, "a header of names");
	sampling->parameters = batten_allocate(rows->context, SAMPLING_PARAMETERS_MOST,
	                                       sizeof *sampling->parameters);
	batten_status status = sampling->parameters ? BATTEN_OK : BATTEN_MEMORY;
	const char *end = line + length;
	while (status == BATTEN_OK && next_cell(&line, end, &cell, &length))
		status = take_name(rows, sampling, cell, length);
	return status;
}

static batten_status read_row(const struct rows *rows, const char *line, size_t length,
                              size_t count, double *values)
{
	const char *end = line + length;
	const char *cell = "";
	for (size_t p = 0; p < count; p++) {
		if (!next_cell(&line, end, &cell, &length))
			return fail(rows, p + 1, "", 0, "as many numbers as there are names");
		if (!batten_number_read(cell, length, &values[p]) || !(fabs(values[p]) <= 1e100))
			return fail(rows, p + 1, cell, length, "a number");
	}
	if (next_cell(&line, end, &cell, &length))
		return fail(rows, count + 1, cell, length, "as many numbers as there are names");
	return BATTEN_OK;
}

/* Lines that are left, an upper bound on the rows. */
static size_t count_lines(const struct rows *rows)
{
	size_t lines = 1;
	for (const char *c = rows->text; c < rows->end; c++)
		lines += *c == '\n';
	return lines;
}

batten_status plan_read_rows(sweep_plan *plan, const plan_place *place, const char *text,
                             size_t length)
{
	sweep_sampling *sampling = &plan->sampling;
	struct rows rows = { .context = plan->context,
		                 .file = json_string_value(place->json),
		                 .text = text,
		                 .end = text + length };
	batten_status status = read_header(&rows, sampling);
	if (status != BATTEN_OK)
		return status;
	const size_t count = sampling->parameter_count;
	sampling->rows = batten_allocate(plan->context, count_lines(&rows), count * sizeof(double));
	if (!sampling->rows)
		return BATTEN_MEMORY;
	const char *line = NULL;
	while (status == BATTEN_OK && next_line(&rows, &line, &length)) {
		status = read_row(&rows, line, length, count, sampling->rows + sampling->count * count);
		sampling->count++;
	}
	if (status == BATTEN_OK && sampling->count == 0)
		return fail(&rows, 1, "", 0, "a row of numbers below the header");
	return status;
}
