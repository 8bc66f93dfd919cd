/* Reads triangles: STL, OBJ. */
#include "core/file.h"
#include "core/number.h"
#include "io/mesh_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const size_t largest_file = (size_t)1 << 30;

/* ------------------------------------------------------------------------------------------------
 * Arrays that grow
 * --------------------------------------------------------------------------------------------- */

/* Room for one more thing of that size; *list is moved where there was none. */
static batten_status make_room(struct mesh_parts *parts, void **list, size_t *room, size_t count,
                               size_t size)
{
	if (count < *room)
		return BATTEN_OK;
	if (count >= UINT32_MAX / 3)
		return batten_fail(parts->context, BATTEN_INPUT,
		                   "%s: found more than %zu vertices or triangles", parts->name, count);
	const size_t wider = *room ? 2 * *room : 1024;
	void *longer = batten_allocate(parts->context, wider, size);
	if (!longer)
		return BATTEN_MEMORY;
	if (count > 0)
		memcpy(longer, *list, count * size);
	batten_release(parts->context, *list);
	*list = longer;
	*room = wider;
	return BATTEN_OK;
}

batten_status mesh_add_vertex(struct mesh_parts *parts, const double at[3])
{
	void *list = parts->vertices;
	const batten_status status = make_room(parts, &list, &parts->vertex_room, parts->vertex_count,
	                                       3 * sizeof(double));
	parts->vertices = list;
	if (status == BATTEN_OK)
		memcpy(parts->vertices + 3 * parts->vertex_count++, at, 3 * sizeof(double));
	return status;
}

batten_status mesh_add_triangle(struct mesh_parts *parts, uint32_t a, uint32_t b, uint32_t c)
{
	void *list = parts->triangles;
	const batten_status status = make_room(parts, &list, &parts->triangle_room,
	                                       parts->triangle_count, 3 * sizeof(uint32_t));
	parts->triangles = list;
	if (status != BATTEN_OK)
		return status;
	uint32_t *to = parts->triangles + 3 * parts->triangle_count++;
	to[0] = a;
	to[1] = b;
	to[2] = c;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Lines and words
 * --------------------------------------------------------------------------------------------- */

bool mesh_next_line(struct mesh_line *line)
{
	if (line->text >= line->end)
		return false;
	const char *end = memchr(line->text, '\n', (size_t)(line->end - line->text));
	line->rest = line->text;
	line->line_end = end ? end : line->end;
	line->text = end ? end + 1 : line->end;
	line->number++;
	return true;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

const char *mesh_next_word(struct mesh_line *line, size_t *length)
{
	while (line->rest < line->line_end && is_blank(*line->rest))
		line->rest++;
	const char *word = line->rest;
	while (line->rest < line->line_end && !is_blank(*line->rest))
		line->rest++;
	*length = (size_t)(line->rest - word);
	return word;
}

static char small_letter(char c)
{
	return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

bool mesh_word_is(const char *word, size_t length, const char *text)
{
	if (length != strlen(text))
		return false;
	for (size_t i = 0; i < length; i++)
		if (small_letter(word[i]) != text[i])
			return false;
	return true;
}

batten_status mesh_fail(const struct mesh_line *line, const char *word, size_t length,
                        const char *expected)
{
	char found[41] = "";
	for (size_t i = 0; i < length && i + 1 < sizeof found; i++)
		found[i] = word[i] >= ' ' && word[i] <= '~' ? word[i] : '?';
	return batten_fail(line->parts->context, BATTEN_INPUT, "%s:%zu: found '%s', expected %s",
	                   line->parts->name, line->number, found, expected);
}

batten_status mesh_read_point(struct mesh_line *line, double at[3])
{
	for (size_t c = 0; c < 3; c++) {
		size_t length = 0;
		const char *word = mesh_next_word(line, &length);
		if (!batten_number_read(word, length, &at[c]) || !isfinite(at[c]))
			return mesh_fail(line, word, length, "a number: three coordinates");
		at[c] += 0.0; /* no -0: equal places are found by their bits */
	}
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Files
 * --------------------------------------------------------------------------------------------- */

static bool ends_in(const char *path, const char *ending)
{
	const size_t length = strlen(path), tail = strlen(ending);
	return length > tail && mesh_word_is(path + length - tail, tail, ending);
}

/* Half a hull is what has nothing to starboard. */
static batten_status create(struct mesh_parts *parts, batten_mesh **out)
{
	batten_mesh_table table = { parts->vertex_count, parts->triangle_count, parts->vertices,
		                        parts->triangles, true };
	if (parts->triangle_count == 0 || parts->vertex_count < 3)
		return batten_fail(parts->context, BATTEN_INPUT,
		                   "%s: found no triangle, expected one at least", parts->name);
	for (size_t i = 0; i < parts->vertex_count; i++)
		table.half = table.half && parts->vertices[3 * i + 1] >= 0;
	const batten_status status = batten_mesh_create(parts->context, &table, out);
	if (status == BATTEN_OK || status == BATTEN_MEMORY)
		return status;
	char message[256];
	(void)snprintf(message, sizeof message, "%s", batten_context_error(parts->context));
	return batten_fail(parts->context, status, "%s: %s", parts->name, message);
}

batten_status batten_mesh_parse(batten_context *context, const char *name, const char *text,
                                size_t length, batten_mesh **out)
{
	struct mesh_parts parts = { .context = context, .name = name };
	batten_status status = BATTEN_OK;
	*out = NULL;
	if (ends_in(name, ".obj"))
		status = mesh_read_obj(&parts, text, length);
	else if (ends_in(name, ".stl"))
		status = mesh_read_stl(&parts, text, length);
	else
		status = batten_fail(context, BATTEN_USAGE, "%s: expected a name that ends in .stl or .obj",
		                     name);
	if (status == BATTEN_OK)
		status = create(&parts, out);
	batten_release(context, parts.vertices);
	batten_release(context, parts.triangles);
	return status;
}

batten_status batten_mesh_read(batten_context *context, const char *path, batten_mesh **out)
{
	char *text = NULL;
	size_t length = 0;
	*out = NULL;
	batten_status status = batten_file_read(context, path, largest_file, &text, &length);
	if (status == BATTEN_OK)
		status = batten_mesh_parse(context, path, text, length, out);
	batten_release(context, text);
	return status;
}
