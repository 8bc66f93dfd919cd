/* check_schema SCHEMA.json FILE.json: says where the file is not what the schema describes, and fails. It
 * knows the words of JSON Schema that the schemas of data/schema use, and refuses one with any other. */
#include <jansson.h>
#include <regex.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct place {
	const struct place *up;
	const char *name; /* NULL: number */
	size_t number;
} place;

typedef struct check {
	const json_t *root; /* of the schema */
	bool silent;        /* one of several that may fit */
} check;

static void print_place(const place *at)
{
	if (!at)
		return;
	print_place(at->up);
	if (at->name)
		(void)printf("/%s", at->name);
	else
		(void)printf("/%zu", at->number);
}

static bool refuse(const check *c, const place *at, const char *why, const char *what)
{
	if (!c->silent) {
		print_place(at);
		(void)printf(": %s %s\n", why, what);
	}
	return false;
}

static bool is_type(const char *type, const json_t *value)
{
	static const struct {
		const char *name;
		json_type types[2];
	} known[] = {
		{ "object", { JSON_OBJECT, JSON_OBJECT } },    { "array", { JSON_ARRAY, JSON_ARRAY } },
		{ "string", { JSON_STRING, JSON_STRING } },    { "number", { JSON_INTEGER, JSON_REAL } },
		{ "integer", { JSON_INTEGER, JSON_INTEGER } }, { "boolean", { JSON_TRUE, JSON_FALSE } },
		{ "null", { JSON_NULL, JSON_NULL } },
	};
	for (size_t t = 0; t < sizeof known / sizeof known[0]; t++)
		if (strcmp(known[t].name, type) == 0)
			return json_typeof(value) == known[t].types[0] ||
			       json_typeof(value) == known[t].types[1];
	(void)printf("unknown type %s\n", type);
	exit(2);
}

static bool check_type(const json_t *types, const json_t *value)
{
	if (json_is_string(types))
		return is_type(json_string_value(types), value);
	for (size_t t = 0; t < json_array_size(types); t++)
		if (is_type(json_string_value(json_array_get(types, t)), value))
			return true;
	return false;
}

static bool is_listed(const json_t *list, const json_t *value)
{
	for (size_t i = 0; i < json_array_size(list); i++)
		if (json_equal(json_array_get(list, i), value))
			return true;
	return false;
}

/* "#/$defs/name" within the schema. */
static const json_t *referred(const check *c, const char *reference)
{
	const json_t *found = c->root;
	char name[256];
	for (const char *from = strchr(reference, '/'); from && found; from = strchr(from, '/')) {
		from++;
		(void)snprintf(name, sizeof name, "%.*s", (int)strcspn(from, "/"), from);
		found = json_object_get(found, name);
	}
	if (reference[0] != '#' || !found) {
		(void)printf("unknown reference %s\n", reference);
		exit(2);
	}
	return found;
}

static bool matches(const char *pattern, const char *text)
{
	regex_t compiled;
	if (regcomp(&compiled, pattern, REG_EXTENDED | REG_NOSUB) != 0) {
		(void)printf("unknown pattern %s\n", pattern);
		exit(2);
	}
	const bool found = regexec(&compiled, text, 0, NULL, 0) == 0;
	regfree(&compiled);
	return found;
}

static bool fits(const check *c, const json_t *schema, const json_t *value, const place *at);

static size_t count_fits(const check *c, const json_t *schemas, const json_t *value,
                         const place *at)
{
	const check one = { c->root, true };
	size_t count = 0;
	for (size_t s = 0; s < json_array_size(schemas); s++)
		count += fits(&one, json_array_get(schemas, s), value, at);
	return count;
}

static bool check_number(const check *c, const char *word, const json_t *limit, const json_t *value,
                         const place *at)
{
	const double number = json_number_value(value);
	const double bound = json_number_value(limit);
	const bool good = strcmp(word, "minimum") == 0   ? number >= bound
	                  : strcmp(word, "maximum") == 0 ? number <= bound
	                                                 : number > bound;
	return !json_is_number(value) || good || refuse(c, at, "a number beyond its", word);
}

/* Items of an array, members of an object, characters of a text. */
static bool check_size(const check *c, const char *word, const json_t *limit, const json_t *value,
                       const place *at)
{
	const bool items = strstr(word, "Items") != NULL;
	const bool members = strstr(word, "Properties") != NULL;
	if (items ? !json_is_array(value) : members ? !json_is_object(value) : !json_is_string(value))
		return true;
	const size_t size = items     ? json_array_size(value)
	                    : members ? json_object_size(value)
	                              : json_string_length(value);
	const size_t bound = (size_t)json_integer_value(limit);
	const bool good = strncmp(word, "min", 3) == 0 ? size >= bound : size <= bound;
	return good || refuse(c, at, "a size beyond its", word);
}

static bool check_items(const check *c, const json_t *schema, const json_t *value, const place *at)
{
	bool good = true;
	for (size_t i = 0; json_is_array(value) && i < json_array_size(value); i++) {
		const place here = { at, NULL, i };
		good = fits(c, schema, json_array_get(value, i), &here) && good;
	}
	return good;
}

static bool check_members(const check *c, const json_t *schema, const json_t *value,
                          const place *at)
{
	const json_t *properties = json_object_get(schema, "properties");
	const json_t *others = json_object_get(schema, "additionalProperties");
	const json_t *required = json_object_get(schema, "required");
	bool good = true;
	if (!json_is_object(value))
		return true;
	const char *name = NULL;
	json_t *member = NULL;
	json_object_foreach((json_t *)value, name, member)
	{
		const place here = { at, name, 0 };
		const json_t *own = json_object_get(properties, name);
		if (own)
			good = fits(c, own, member, &here) && good;
		else if (json_is_false(others))
			good = refuse(c, &here, "not in", "the schema");
		else if (json_is_object(others))
			good = fits(c, others, member, &here) && good;
	}
	for (size_t i = 0; i < json_array_size(required); i++) {
		name = json_string_value(json_array_get(required, i));
		if (!json_object_get(value, name))
			good = refuse(c, at, "without", name);
	}
	return good;
}

/* One word of a schema but those of members. */
static bool check_word(const check *c, const char *word, const json_t *with, const json_t *value,
                       const place *at)
{
	static const char *const told[] = { "$schema",     "$id",      "title",
		                                "description", "$defs",    "default",
		                                "properties",  "required", "additionalProperties" };
	for (size_t i = 0; i < sizeof told / sizeof told[0]; i++)
		if (strcmp(word, told[i]) == 0)
			return true;
	if (strcmp(word, "type") == 0)
		return check_type(with, value) || refuse(c, at, "not of its", word);
	if (strcmp(word, "enum") == 0)
		return is_listed(with, value) || refuse(c, at, "none of its", word);
	if (strcmp(word, "const") == 0)
		return json_equal(with, value) || refuse(c, at, "not its", word);
	if (strcmp(word, "$ref") == 0)
		return fits(c, referred(c, json_string_value(with)), value, at);
	if (strcmp(word, "anyOf") == 0)
		return count_fits(c, with, value, at) > 0 || refuse(c, at, "none of", word);
	if (strcmp(word, "oneOf") == 0)
		return count_fits(c, with, value, at) == 1 || refuse(c, at, "not one of", word);
	if (strcmp(word, "not") == 0) {
		const check one = { c->root, true };
		return !fits(&one, with, value, at) || refuse(c, at, "what is", word);
	}
	if (strcmp(word, "items") == 0)
		return check_items(c, with, value, at);
	if (strcmp(word, "pattern") == 0)
		return !json_is_string(value) ||
		       matches(json_string_value(with), json_string_value(value)) ||
		       refuse(c, at, "not like its", word);
	if (strcmp(word, "minimum") == 0 || strcmp(word, "maximum") == 0 ||
	    strcmp(word, "exclusiveMinimum") == 0)
		return check_number(c, word, with, value, at);
	if (strcmp(word, "minProperties") == 0 || strcmp(word, "minItems") == 0 ||
	    strcmp(word, "maxItems") == 0 || strcmp(word, "minLength") == 0 ||
	    strcmp(word, "maxLength") == 0)
		return check_size(c, word, with, value, at);
	(void)printf("unknown word %s\n", word);
	exit(2);
}

static bool fits(const check *c, const json_t *schema, const json_t *value, const place *at)
{
	bool good = true;
	const char *word = NULL;
	json_t *with = NULL;
	json_object_foreach((json_t *)schema, word, with)
		good = check_word(c, word, with, value, at) && good;
	return check_members(c, schema, value, at) && good;
}

static json_t *load(const char *path)
{
	json_error_t error;
	json_t *value = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
	if (!value) {
		(void)printf("%s:%d: %s\n", path, error.line, error.text);
		exit(2);
	}
	return value;
}

int main(int argc, char **argv)
{
	if (argc != 3)
		return 2;
	json_t *schema = load(argv[1]);
	json_t *value = load(argv[2]);
	const check whole = { schema, false };
	const bool good = fits(&whole, schema, value, NULL);
	json_decref(value);
	json_decref(schema);
	return good ? 0 : 1;
}
