/* A mesh as it is read: vertices and triangles that grow, and errors that name the place. */
#ifndef BATTEN_IO_MESH_PARTS_H
#define BATTEN_IO_MESH_PARTS_H

#include "core/context.h"

#include <stdint.h>

struct mesh_parts {
	batten_context *context;
	const char *name; /* of the file, for messages */
	double *vertices;
	size_t vertex_count, vertex_room;
	uint32_t *triangles;
	size_t triangle_count, triangle_room;
};

/* Errors: MEMORY, INPUT (more than 2^32 of them). */
batten_status mesh_add_vertex(struct mesh_parts *parts, const double at[3]);
batten_status mesh_add_triangle(struct mesh_parts *parts, uint32_t a, uint32_t b, uint32_t c);

/* A line of text, word by word. */
struct mesh_line {
	const struct mesh_parts *parts;
	const char *text, *end; /* what is left of the file */
	size_t number;          /* of the line, from 1; 0 before the first */
	const char *rest, *line_end;
};

bool mesh_next_line(struct mesh_line *line);
/* The next word between blanks, not NUL-terminated; length 0 behind the last. */
const char *mesh_next_word(struct mesh_line *line, size_t *length);
/* In small letters or capitals. */
bool mesh_word_is(const char *word, size_t length, const char *text);
/* INPUT: "file:line: found 'word', expected ...". */
batten_status mesh_fail(const struct mesh_line *line, const char *word, size_t length,
                        const char *expected);
/* Three finite numbers. Errors: INPUT. */
batten_status mesh_read_point(struct mesh_line *line, double at[3]);

/* The two formats. Errors: INPUT (the line, what was found and expected), MEMORY. */
batten_status mesh_read_obj(struct mesh_parts *parts, const char *text, size_t length);
batten_status mesh_read_stl(struct mesh_parts *parts, const char *text, size_t length);

#endif
