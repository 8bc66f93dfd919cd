/* JSON of a plan with a place for messages: every error names the file, the JSON path, what was found
 * and what was expected. */
#ifndef BATTEN_SWEEP_PLAN_JSON_H
#define BATTEN_SWEEP_PLAN_JSON_H

#include "core/context.h"

#include <jansson.h>

enum { PLAN_PATH_SIZE = 160 };

/* A value of the plan and where it stands; json is NULL for a member that is not there. Borrowed. */
typedef struct plan_place {
	batten_context *context;
	const char *file;
	const json_t *json;
	char path[PLAN_PATH_SIZE];
} plan_place;

plan_place plan_member(const plan_place *object, const char *name);
plan_place plan_item(const plan_place *array, size_t i);

/* INPUT: "FILE: PATH: found ..., expected ...". */
batten_status plan_expect(const plan_place *place, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

/* An object whose keys are all among the known ones, NULL-terminated. */
batten_status plan_keys(const plan_place *object, const char *const *known);

/* Read a value that must be there, within its range. */
batten_status plan_number(const plan_place *place, double least, double most, double *out);
batten_status plan_whole(const plan_place *place, uint64_t least, uint64_t most, uint64_t *out);
batten_status plan_flag(const plan_place *place, bool *out);
batten_status plan_text(const plan_place *place, const char **out); /* not empty */
/* One of the words, NULL-terminated. */
batten_status plan_word(const plan_place *place, const char *const *words, size_t *index);
/* An array of so many items. */
batten_status plan_array(const plan_place *place, size_t least, size_t most, size_t *count);

#endif
