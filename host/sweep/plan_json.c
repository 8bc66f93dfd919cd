#include "sweep/plan_json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FOUND_SIZE = 80, LIST_SIZE = 400 };

/* The place's path with something added; what is too long for it is cut. */
static void extend(plan_place *place, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
static void extend(plan_place *place, const char *format, ...)
{
	const size_t used = strlen(place->path);
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(place->path + used, sizeof place->path - used, format, arguments);
	va_end(arguments);
}

plan_place plan_member(const plan_place *object, const char *name)
{
	plan_place place = *object;
	place.json = json_object_get(object->json, name);
	extend(&place, ".%s", name);
	return place;
}

plan_place plan_item(const plan_place *array, size_t i)
{
	plan_place place = *array;
	place.json = json_array_get(array->json, i);
	extend(&place, "[%zu]", i);
	return place;
}

/* A value as the message shows it; what is too long is cut. */
static void show(const json_t *json, char found[FOUND_SIZE])
{
	if (!json) {
		(void)snprintf(found, FOUND_SIZE, "nothing");
		return;
	}
	char *text = json_dumps(json, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(17));
	const char *shown = text ? text : "a value";
	(void)snprintf(found, FOUND_SIZE, "%.*s%s", FOUND_SIZE - 4, shown,
	               strlen(shown) > FOUND_SIZE - 4 ? "..." : "");
	free(text);
}

batten_status plan_expect(const plan_place *place, const char *format, ...)
{
	char found[FOUND_SIZE];
	char expected[LIST_SIZE];
	show(place->json, found);
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(expected, sizeof expected, format, arguments);
	va_end(arguments);
	return batten_fail(place->context, BATTEN_INPUT, "%s: %s: found %s, expected %s", place->file,
	                   place->path, found, expected);
}

static void add_word(char list[LIST_SIZE], const char *word, bool first, bool last)
{
	const size_t used = strlen(list);
	(void)snprintf(list + used, LIST_SIZE - used, "%s%s", first ? "" : last ? " or " : ", ", word);
}

static void join_words(const char *const *words, char list[LIST_SIZE])
{
	list[0] = '\0';
	for (size_t i = 0; words[i]; i++)
		add_word(list, words[i], i == 0, !words[i + 1]);
}

static bool is_among(const char *text, const char *const *words, size_t *index)
{
	for (size_t i = 0; words[i]; i++)
		if (strcmp(words[i], text) == 0) {
			*index = i;
			return true;
		}
	return false;
}

batten_status plan_keys(const plan_place *object, const char *const *known)
{
	if (!json_is_object(object->json))
		return plan_expect(object, "an object");
	const char *key = NULL;
	const json_t *value = NULL;
	size_t index = 0;
	/* Jansson's macros walk by a pointer that is not const. */
	json_object_foreach((json_t *)object->json, key, value)
	{
		if (is_among(key, known, &index))
			continue;
		char list[LIST_SIZE];
		join_words(known, list);
		const plan_place place = plan_member(object, key);
		return batten_fail(object->context, BATTEN_INPUT, "%s: %s: unknown key, expected %s",
		                   object->file, place.path, list[0] ? list : "none");
	}
	return BATTEN_OK;
}

batten_status plan_number(const plan_place *place, double least, double most, double *out)
{
	const double value = json_number_value(place->json);
	if (!json_is_number(place->json) || !(value >= least && value <= most)) {
		if (isinf(least) && isinf(most))
			return plan_expect(place, "a number");
		return plan_expect(place, "a number from %g to %g", least, most);
	}
	*out = value;
	return BATTEN_OK;
}

batten_status plan_whole(const plan_place *place, uint64_t least, uint64_t most, uint64_t *out)
{
	const json_int_t value = json_integer_value(place->json);
	if (!json_is_integer(place->json) || value < 0 || (uint64_t)value < least ||
	    (uint64_t)value > most)
		return plan_expect(place, "a whole number from %llu to %llu", (unsigned long long)least,
		                   (unsigned long long)most);
	*out = (uint64_t)value;
	return BATTEN_OK;
}

batten_status plan_flag(const plan_place *place, bool *out)
{
	if (!json_is_boolean(place->json))
		return plan_expect(place, "true or false");
	*out = json_is_true(place->json);
	return BATTEN_OK;
}

batten_status plan_text(const plan_place *place, const char **out)
{
	if (!json_is_string(place->json) || json_string_length(place->json) == 0)
		return plan_expect(place, "a text");
	*out = json_string_value(place->json);
	return BATTEN_OK;
}

batten_status plan_word(const plan_place *place, const char *const *words, size_t *index)
{
	const char *text = json_string_value(place->json);
	if (text && is_among(text, words, index))
		return BATTEN_OK;
	char list[LIST_SIZE];
	join_words(words, list);
	return plan_expect(place, "%s", list);
}

batten_status plan_array(const plan_place *place, size_t least, size_t most, size_t *count)
{
	const size_t size = json_array_size(place->json);
	if (!json_is_array(place->json) || size < least || size > most)
		return plan_expect(place, "a list of %zu to %zu", least, most);
	*count = size;
	return BATTEN_OK;
}
