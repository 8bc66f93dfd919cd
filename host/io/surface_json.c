/* surface.json: a hull as a B-spline surface (data/schema/surface.schema.json). Reading; everything
 * in the file is untrusted. */
#include "core/file.h"
#include "geometry/surface.h"
#include "hull/hull.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* Longest file that is read, and what one byte of it may take in memory while it is. */
enum { LONGEST = 64 * 1024 * 1024, BYTES_OF_A_BYTE = 40 };

static const char *const members[] = { "batten_surface", "name",    "unit",    "frame",
	                                   "order_u",        "order_v", "count_u", "count_v",
	                                   "knots_u",        "knots_v", "poles",   "weights" };

struct reader {
	batten_context *context;
	const char *file;
	json_t *object;
};

static const char *kind_of(const json_t *value)
{
	static const char *const words[] = { "an object", "an array", "a text", "an integer",
		                                 "a number",  "true",     "false",  "null" };
	return value ? words[json_typeof(value)] : "nothing";
}

/* jansson's own message, in one line whatever bytes of the file it quotes. */
static batten_status fail_syntax(batten_context *context, const char *file,
                                 const json_error_t *error)
{
	char text[sizeof error->text];
	(void)snprintf(text, sizeof text, "%s", error->text);
	for (char *c = text; *c; c++)
		if ((unsigned char)*c < 0x20 || *c == 0x7f)
			*c = '?';
	return batten_fail(context, BATTEN_INPUT, "%s:%d:%d: %s", file,
	                   error->line > 0 ? error->line : 1, error->column > 0 ? error->column : 1,
	                   text);
}

static batten_status check_members(const struct reader *reader)
{
	const char *key;
	json_t *value;
	if (!json_is_object(reader->object))
		return batten_fail(reader->context, BATTEN_INPUT, "%s: found %s, expected a surface",
		                   reader->file, kind_of(reader->object));
	json_object_foreach(reader->object, key, value)
	{
		size_t i = 0;
		while (i < sizeof members / sizeof members[0] && strcmp(key, members[i]) != 0)
			i++;
		const size_t plain = hull_text_length(key, strlen(key));
		if (i == sizeof members / sizeof members[0])
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: found the member '%.*s', expected those of a surface",
			                   reader->file, plain < 60 ? (int)plain : 60, key);
	}
	return BATTEN_OK;
}

/* A member that must be this text. */
static batten_status read_word(const struct reader *reader, const char *name, const char *word)
{
	const json_t *value = json_object_get(reader->object, name);
	const char *text = json_string_value(value);
	if (text && strcmp(text, word) == 0)
		return BATTEN_OK;
	return batten_fail(reader->context, BATTEN_INPUT, "%s: %s: found %s, expected \"%s\"",
	                   reader->file, name, text ? "another text" : kind_of(value), word);
}

static batten_status read_name(const struct reader *reader, const char **out)
{
	const json_t *value = json_object_get(reader->object, "name");
	const char *text = json_string_value(value);
	if (!text)
		return batten_fail(reader->context, BATTEN_INPUT, "%s: name: found %s, expected a text",
		                   reader->file, kind_of(value));
	const size_t length = strlen(text);
	if (length > HULL_TEXT_MOST || hull_text_length(text, length) != length)
		return batten_fail(
			reader->context, BATTEN_INPUT,
			"%s: name: found %s, expected one line of at most %d bytes", reader->file,
			length > HULL_TEXT_MOST ? "a longer text" : "a control character", HULL_TEXT_MOST);
	*out = text;
	return BATTEN_OK;
}

static batten_status read_count(const struct reader *reader, const char *name, size_t least,
                                size_t most, size_t *out)
{
	const json_t *value = json_object_get(reader->object, name);
	const json_int_t number = json_integer_value(value);
	if (!json_is_integer(value))
		return batten_fail(reader->context, BATTEN_INPUT, "%s: %s: found %s, expected %zu to %zu",
		                   reader->file, name, kind_of(value), least, most);
	if (number < (json_int_t)least || number > (json_int_t)most)
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: %s: found %" JSON_INTEGER_FORMAT ", expected %zu to %zu",
		                   reader->file, name, number, least, most);
	*out = (size_t)number;
	return BATTEN_OK;
}

/* An array of so many numbers; where names it. */
static batten_status read_numbers(const struct reader *reader, const json_t *array,
                                  const char *where, size_t count, double *out)
{
	if (!json_is_array(array))
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: %s: found %s, expected an array of %zu numbers", reader->file,
		                   where, kind_of(array), count);
	if (json_array_size(array) != count)
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: %s: found %zu entries, expected %zu numbers", reader->file, where,
		                   json_array_size(array), count);
	for (size_t i = 0; i < count; i++) {
		const json_t *value = json_array_get(array, i);
		if (!json_is_number(value))
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: %s[%zu]: found %s, expected a number", reader->file, where, i,
			                   kind_of(value));
		out[i] = json_number_value(value);
	}
	return BATTEN_OK;
}

/* The rows of poles (each an array of x, y, z) or of weights. */
static batten_status read_rows(const struct reader *reader, const char *name, size_t rows,
                               size_t columns, size_t dimension, double *out)
{
	const json_t *array = json_object_get(reader->object, name);
	char where[64];
	if (!json_is_array(array) || json_array_size(array) != rows)
		return batten_fail(
			reader->context, BATTEN_INPUT,
			"%s: %s: found %s of %zu entries, expected an array of count_v = %zu rows",
			reader->file, name, kind_of(array), json_array_size(array), rows);
	batten_status status = BATTEN_OK;
	for (size_t j = 0; status == BATTEN_OK && j < rows; j++) {
		const json_t *row = json_array_get(array, j);
		(void)snprintf(where, sizeof where, "%s[%zu]", name, j);
		if (dimension == 1) {
			status = read_numbers(reader, row, where, columns, out + j * columns);
			continue;
		}
		if (!json_is_array(row) || json_array_size(row) != columns)
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: %s: found %s of %zu entries, expected count_u = %zu poles",
			                   reader->file, where, kind_of(row), json_array_size(row), columns);
		for (size_t i = 0; status == BATTEN_OK && i < columns; i++) {
			(void)snprintf(where, sizeof where, "%s[%zu][%zu]", name, j, i);
			status = read_numbers(reader, json_array_get(row, i), where, dimension,
			                      out + dimension * (j * columns + i));
		}
	}
	return status;
}

static batten_status read_head(const struct reader *reader, batten_surface_net *net)
{
	size_t version = 0;
	batten_status status = check_members(reader);
	if (status == BATTEN_OK)
		status = read_count(reader, "batten_surface", 1, 1, &version);
	if (status == BATTEN_OK)
		status = read_name(reader, &net->name);
	if (status == BATTEN_OK)
		status = read_word(reader, "unit", "m");
	if (status == BATTEN_OK)
		status = read_word(reader, "frame", "ap-fwd");
	if (status == BATTEN_OK)
		status = read_count(reader, "order_u", BSPLINE_ORDER_LEAST, BSPLINE_ORDER_MOST,
		                    &net->order_u);
	if (status == BATTEN_OK)
		status = read_count(reader, "order_v", BSPLINE_ORDER_LEAST, BSPLINE_ORDER_MOST,
		                    &net->order_v);
	if (status == BATTEN_OK)
		status = read_count(reader, "count_u", net->order_u, BSPLINE_POLES_MOST, &net->count_u);
	if (status == BATTEN_OK)
		status = read_count(reader, "count_v", net->order_v, BSPLINE_POLES_MOST, &net->count_v);
	return status;
}

static batten_status read_net(const struct reader *reader, batten_surface_net *net, double *numbers,
                              batten_surface **out)
{
	const size_t knots_u = net->count_u + net->order_u;
	const size_t knots_v = net->count_v + net->order_v;
	double *poles = numbers + knots_u + knots_v;
	double *weights = poles + 3 * net->count_u * net->count_v;
	const bool rational = json_object_get(reader->object, "weights") != NULL;
	batten_status status = read_numbers(reader, json_object_get(reader->object, "knots_u"),
	                                    "knots_u", knots_u, numbers);
	if (status == BATTEN_OK)
		status = read_numbers(reader, json_object_get(reader->object, "knots_v"), "knots_v",
		                      knots_v, numbers + knots_u);
	if (status == BATTEN_OK)
		status = read_rows(reader, "poles", net->count_v, net->count_u, 3, poles);
	if (status == BATTEN_OK && rational)
		status = read_rows(reader, "weights", net->count_v, net->count_u, 1, weights);
	if (status != BATTEN_OK)
		return status;
	net->knots_u = numbers;
	net->knots_v = numbers + knots_u;
	net->poles_m = poles;
	net->weights = rational ? weights : NULL;
	status = batten_surface_create(reader->context, net, out);
	if (status == BATTEN_USAGE) /* what is wrong with it came out of the file */
		status = batten_fail(reader->context, BATTEN_INPUT, "%s: %s", reader->file,
		                     batten_context_error(reader->context));
	return status;
}

static batten_status read_surface(const struct reader *reader, batten_surface **out)
{
	batten_surface_net net = { 0 };
	batten_status status = read_head(reader, &net);
	if (status != BATTEN_OK)
		return status;
	/* No more than the file holds, whatever its counts claim. */
	const json_t *rows = json_object_get(reader->object, "poles");
	if (json_array_size(rows) != net.count_v ||
	    json_array_size(json_array_get(rows, 0)) != net.count_u)
		return batten_fail(
			reader->context, BATTEN_INPUT,
			"%s: poles: found %zu rows, the first of %zu poles; expected count_v = %zu "
			"rows of count_u = %zu",
			reader->file, json_array_size(rows), json_array_size(json_array_get(rows, 0)),
			net.count_v, net.count_u);
	double *numbers = batten_allocate(reader->context,
	                                  4 * net.count_u * net.count_v + net.count_u + net.order_u +
	                                      net.count_v + net.order_v,
	                                  sizeof *numbers);
	if (!numbers)
		return BATTEN_MEMORY;
	status = read_net(reader, &net, numbers, out);
	batten_release(reader->context, numbers);
	return status;
}

/* Longest text that can be read within the memory of the context. */
static size_t longest_text(const batten_context *context)
{
	const size_t most = context->options.max_memory / BYTES_OF_A_BYTE;
	return most > 0 && most < LONGEST ? most : LONGEST;
}

batten_status batten_surface_parse(batten_context *context, const char *name, const char *text,
                                   size_t length, batten_surface **out)
{
	json_error_t error;
	if (length > longest_text(context))
		return batten_fail(context, BATTEN_INPUT, "%s: longer than %zu bytes", name,
		                   longest_text(context));
	struct reader reader = {
		.context = context,
		.file = name,
		.object = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error),
	};
	if (!reader.object)
		return json_error_code(&error) == json_error_out_of_memory
		           ? batten_fail_memory(context)
		           : fail_syntax(context, name, &error);
	const batten_status status = read_surface(&reader, out);
	json_decref(reader.object);
	return status;
}

batten_status batten_surface_read(batten_context *context, const char *path, batten_surface **out)
{
	char *text = NULL;
	size_t length = 0;
	batten_status status = batten_file_read(context, path, longest_text(context), &text, &length);
	if (status != BATTEN_OK)
		return status;
	status = batten_surface_parse(context, path, text, length, out);
	batten_release(context, text);
	return status;
}
