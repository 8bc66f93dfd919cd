/* JSON files of the project: one object of known members. Everything in them is untrusted; each
 * refusal names the file and the member. */
#ifndef BATTEN_IO_JSON_READER_H
#define BATTEN_IO_JSON_READER_H

#include "core/context.h"

#include <jansson.h>

struct json_reader {
	batten_context *context;
	const char *file;
	json_t *object;
};

/* Parses a text; the caller ends with json_decref(out->object). Errors: INPUT (too long, not JSON),
 * MEMORY. */
batten_status json_reader_open(batten_context *context, const char *name, const char *text,
                               size_t length, struct json_reader *out);

/* A file as text, released by the caller. Errors: as batten_file_read(). */
batten_status json_reader_load(batten_context *context, const char *path, char **text,
                               size_t *length);

/* "an object", ...; "nothing" for NULL. */
const char *json_reader_kind(const json_t *value);

/* INPUT unless the object is one and has no other members; what: "a surface". */
batten_status json_reader_members(const struct json_reader *reader, const char *what,
                                  const char *const *members, size_t count);

/* A member that must be this text. */
batten_status json_reader_word(const struct json_reader *reader, const char *name,
                               const char *word);

/* A whole number between least and most. */
batten_status json_reader_count(const struct json_reader *reader, const char *name, size_t least,
                                size_t most, size_t *out);

/* An array of so many numbers; where names it. */
batten_status json_reader_numbers(const struct json_reader *reader, const json_t *array,
                                  const char *where, size_t count, double *out);

#endif
