/* What the readers of JSON files share. */
#include "io/json_reader.h"
#include "core/file.h"
#include "hull/hull.h"

#include <string.h>

/* Longest file that is read, and what one byte of it may take in memory while it is. */
enum { LONGEST = 64 * 1024 * 1024, BYTES_OF_A_BYTE = 40 };

const char *json_reader_kind(const json_t *value)
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

batten_status json_reader_members(const struct json_reader *reader, const char *what,
                                  const char *const *members, size_t count)
{
	const char *key;
	json_t *value;
	if (!json_is_object(reader->object))
		return batten_fail(reader->context, BATTEN_INPUT, "%s: found %s, expected %s", reader->file,
		                   json_reader_kind(reader->object), what);
	json_object_foreach(reader->object, key, value)
	{
		size_t i = 0;
		while (i < count && strcmp(key, members[i]) != 0)
			i++;
		const size_t plain = hull_text_length(key, strlen(key));
		if (i == count)
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: found the member '%.*s', expected those of %s", reader->file,
			                   plain < 60 ? (int)plain : 60, key, what);
	}
	return BATTEN_OK;
}

batten_status json_reader_word(const struct json_reader *reader, const char *name, const char *word)
{
	const json_t *value = json_object_get(reader->object, name);
	const char *text = json_string_value(value);
	if (text && strcmp(text, word) == 0)
		return BATTEN_OK;
	return batten_fail(reader->context, BATTEN_INPUT, "%s: %s: found %s, expected \"%s\"",
	                   reader->file, name, text ? "another text" : json_reader_kind(value), word);
}

batten_status json_reader_count(const struct json_reader *reader, const char *name, size_t least,
                                size_t most, size_t *out)
{
	const json_t *value = json_object_get(reader->object, name);
	const json_int_t number = json_integer_value(value);
	if (!json_is_integer(value))
		return batten_fail(reader->context, BATTEN_INPUT, "%s: %s: found %s, expected %zu to %zu",
		                   reader->file, name, json_reader_kind(value), least, most);
	if (number < (json_int_t)least || number > (json_int_t)most)
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: %s: found %" JSON_INTEGER_FORMAT ", expected %zu to %zu",
		                   reader->file, name, number, least, most);
	*out = (size_t)number;
	return BATTEN_OK;
}

batten_status json_reader_numbers(const struct json_reader *reader, const json_t *array,
                                  const char *where, size_t count, double *out)
{
	if (!json_is_array(array))
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: %s: found %s, expected an array of %zu numbers", reader->file,
		                   where, json_reader_kind(array), count);
	if (json_array_size(array) != count)
		return batten_fail(reader->context, BATTEN_INPUT,
		                   "%s: %s: found %zu entries, expected %zu numbers", reader->file, where,
		                   json_array_size(array), count);
	for (size_t i = 0; i < count; i++) {
		const json_t *value = json_array_get(array, i);
		if (!json_is_number(value))
			return batten_fail(reader->context, BATTEN_INPUT,
			                   "%s: %s[%zu]: found %s, expected a number", reader->file, where, i,
			                   json_reader_kind(value));
		out[i] = json_number_value(value);
	}
	return BATTEN_OK;
}

/* Longest text that can be read within the memory of the context. */
static size_t longest_text(const batten_context *context)
{
	const size_t most = context->options.max_memory / BYTES_OF_A_BYTE;
	return most > 0 && most < LONGEST ? most : LONGEST;
}

batten_status json_reader_open(batten_context *context, const char *name, const char *text,
                               size_t length, struct json_reader *out)
{
	json_error_t error;
	if (length > longest_text(context))
		return batten_fail(context, BATTEN_INPUT, "%s: longer than %zu bytes", name,
		                   longest_text(context));
	*out = (struct json_reader){
		.context = context,
		.file = name,
		.object = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error),
	};
	if (out->object)
		return BATTEN_OK;
	return json_error_code(&error) == json_error_out_of_memory ? batten_fail_memory(context)
	                                                           : fail_syntax(context, name, &error);
}

batten_status json_reader_load(batten_context *context, const char *path, char **text,
                               size_t *length)
{
	return batten_file_read(context, path, longest_text(context), text, length);
}
