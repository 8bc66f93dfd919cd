/* surface.json: a hull as a B-spline surface (data/schema/surface.schema.json). Reading; everything
 * in the file is untrusted. */
#include "geometry/surface.h"
#include "hull/hull.h"
#include "io/json_reader.h"

#include <string.h>

static const char *const members[] = { "batten_surface", "name",    "unit",    "frame",
	                                   "order_u",        "order_v", "count_u", "count_v",
	                                   "knots_u",        "knots_v", "poles",   "weights" };

static batten_status read_name(const struct json_reader *reader, const char **out)
{
	const json_t *value = json_object_get(reader->object, "name");
	const char *text = json_string_value(value);
	if (!text)
		return batten_fail(reader->context, BATTEN_INPUT, "%s: name: found %s, expected a text",
		                   reader->file, json_reader_kind(value));
	const size_t length = strlen(text);
	if (length > HULL_TEXT_MOST || hull_text_length(text, length) != length)
		return batten_fail(
			reader->context, BATTEN_INPUT,
			"%s: name: found %s, expected one line of at most %d bytes", reader->file,
			length > HULL_TEXT_MOST ? "a longer text" : "a control character", HULL_TEXT_MOST);
	*out = text;
	return BATTEN_OK;
}

/* The rows of poles (each an array of x, y, z) or of weights. */
static batten_status read_rows(const struct json_reader *reader, const char *name, size_t rows,
                               size_t columns, size_t dimension, double *out)
{
	const json_t *array = json_object_get(reader->object, name);
	char where[64];
	if (!json_is_array(array) || json_array_size(array) != rows)
		return batten_fail(
			reader->context, BATTEN_INPUT,
			"%s: %s: found %s of %zu entries, expected an array of count_v = %zu rows",
			reader->file, name, json_reader_kind(array), json_array_size(array), rows);
	batten_status status = BATTEN_OK;
	for (size_t j = 0; status == BATTEN_OK && j < rows; j++) {
		const json_t *row = json_array_get(array, j);
		(void)snprintf(where, sizeof where, "%s[%zu]", name, j);
		if (dimension == 1) {
			status = json_reader_numbers(reader, row, where, columns, out + j * columns);
			continue;
		}
		if (!json_is_array(row) || json_array_size(row) != columns)
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: %s: found %s of %zu entries, expected count_u = %zu poles",
			                   reader->file, where, json_reader_kind(row), json_array_size(row),
			                   columns);
		for (size_t i = 0; status == BATTEN_OK && i < columns; i++) {
			(void)snprintf(where, sizeof where, "%s[%zu][%zu]", name, j, i);
			status = json_reader_numbers(reader, json_array_get(row, i), where, dimension,
			                             out + dimension * (j * columns + i));
		}
	}
	return status;
}

static batten_status read_head(const struct json_reader *reader, batten_surface_net *net)
{
	size_t version = 0;
	batten_status status = json_reader_members(reader, "a surface", members,
	                                           sizeof members / sizeof members[0]);
	if (status == BATTEN_OK)
		status = json_reader_count(reader, "batten_surface", 1, 1, &version);
	if (status == BATTEN_OK)
		status = read_name(reader, &net->name);
	if (status == BATTEN_OK)
		status = json_reader_word(reader, "unit", "m");
	if (status == BATTEN_OK)
		status = json_reader_word(reader, "frame", "ap-fwd");
	if (status == BATTEN_OK)
		status = json_reader_count(reader, "order_u", BSPLINE_ORDER_LEAST, BSPLINE_ORDER_MOST,
		                           &net->order_u);
	if (status == BATTEN_OK)
		status = json_reader_count(reader, "order_v", BSPLINE_ORDER_LEAST, BSPLINE_ORDER_MOST,
		                           &net->order_v);
	if (status == BATTEN_OK)
		status = json_reader_count(reader, "count_u", net->order_u, BSPLINE_POLES_MOST,
		                           &net->count_u);
	if (status == BATTEN_OK)
		status = json_reader_count(reader, "count_v", net->order_v, BSPLINE_POLES_MOST,
		                           &net->count_v);
	return status;
}

static batten_status read_net(const struct json_reader *reader, batten_surface_net *net,
                              double *numbers, batten_surface **out)
{
	const size_t knots_u = net->count_u + net->order_u;
	const size_t knots_v = net->count_v + net->order_v;
	double *poles = numbers + knots_u + knots_v;
	double *weights = poles + 3 * net->count_u * net->count_v;
	const bool rational = json_object_get(reader->object, "weights") != NULL;
	batten_status status = json_reader_numbers(reader, json_object_get(reader->object, "knots_u"),
	                                           "knots_u", knots_u, numbers);
	if (status == BATTEN_OK)
		status = json_reader_numbers(reader, json_object_get(reader->object, "knots_v"), "knots_v",
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

static batten_status read_surface(const struct json_reader *reader, batten_surface **out)
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

batten_status batten_surface_parse(batten_context *context, const char *name, const char *text,
                                   size_t length, batten_surface **out)
{
	struct json_reader reader;
	batten_status status = json_reader_open(context, name, text, length, &reader);
	if (status != BATTEN_OK)
		return status;
	status = read_surface(&reader, out);
	json_decref(reader.object);
	return status;
}

batten_status batten_surface_read(batten_context *context, const char *path, batten_surface **out)
{
	char *text = NULL;
	size_t length = 0;
	batten_status status = json_reader_load(context, path, &text, &length);
	if (status != BATTEN_OK)
		return status;
	status = batten_surface_parse(context, path, text, length, out);
	batten_release(context, text);
	return status;
}
