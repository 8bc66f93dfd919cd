/* Wavefront OBJ: v and f lines, the others are passed over; polygons are cut into fans. */
#include "core/number.h"
#include "io/mesh_parts.h"

#include <math.h>
#include <string.h>

/* "7", "7/1", "7/1/3", "-1": the vertex alone, from 1 or, below 0, from the last one backwards. */
static batten_status read_corner(struct mesh_line *line, const char *word, size_t length,
                                 uint32_t *out)
{
	const size_t count = line->parts->vertex_count;
	const char *slash = memchr(word, '/', length);
	double number = 0;
	if (!batten_number_read(word, slash ? (size_t)(slash - word) : length, &number) ||
	    number != floor(number) || !(fabs(number) >= 1 && fabs(number) <= (double)count))
		return mesh_fail(line, word, length, "the number of a vertex above");
	*out = (uint32_t)(number > 0 ? number - 1 : (double)count + number);
	return BATTEN_OK;
}

static batten_status read_face(struct mesh_line *line, struct mesh_parts *parts)
{
	uint32_t first = 0, before = 0, here = 0;
	size_t corners = 0, length = 0;
	batten_status status = BATTEN_OK;
	for (const char *word = mesh_next_word(line, &length); length > 0 && status == BATTEN_OK;
	     word = mesh_next_word(line, &length)) {
		status = read_corner(line, word, length, &here);
		if (status == BATTEN_OK && ++corners > 2)
			status = mesh_add_triangle(parts, first, before, here);
		first = corners == 1 ? here : first;
		before = here;
	}
	if (status == BATTEN_OK && corners < 3)
		return mesh_fail(line, "", 0, "three vertices of a face");
	return status;
}

batten_status mesh_read_obj(struct mesh_parts *parts, const char *text, size_t length)
{
	struct mesh_line line = { .parts = parts, .text = text, .end = text + length };
	batten_status status = BATTEN_OK;
	while (status == BATTEN_OK && mesh_next_line(&line)) {
		size_t size = 0;
		double at[3];
		const char *word = mesh_next_word(&line, &size);
		if (mesh_word_is(word, size, "v")) {
			status = mesh_read_point(&line, at);
			if (status == BATTEN_OK)
				status = mesh_add_vertex(parts, at);
		} else if (mesh_word_is(word, size, "f")) {
			status = read_face(&line, parts);
		}
	}
	return status;
}
