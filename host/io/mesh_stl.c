/* STL, as text or binary. Its triangles have corners of their own: equal places are made one vertex. */
#include "io/mesh_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER_SIZE = 84, RECORD_SIZE = 50 };

/* A corner and which it was. */
struct corner {
	double at[3];
	uint32_t number;
};

static int compare_corners(const void *a, const void *b)
{
	const struct corner *p = a, *q = b;
	for (size_t c = 0; c < 3; c++)
		if (p->at[c] != q->at[c])
			return p->at[c] < q->at[c] ? -1 : 1;
	return p->number < q->number ? -1 : p->number > q->number;
}

static bool same_place(const struct corner *a, const struct corner *b)
{
	return a->at[0] == b->at[0] && a->at[1] == b->at[1] && a->at[2] == b->at[2];
}

/* The vertices so far are three a triangle. */
static batten_status join_corners(struct mesh_parts *parts)
{
	const size_t count = parts->vertex_count;
	struct corner *corners = batten_allocate(parts->context, count ? count : 1, sizeof *corners);
	uint32_t *vertex = batten_allocate(parts->context, count ? count : 1, sizeof *vertex);
	batten_status status = corners && vertex ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		memcpy(corners[i].at, parts->vertices + 3 * i, sizeof corners[i].at);
		corners[i].number = (uint32_t)i;
	}
	if (status == BATTEN_OK && count > 0)
		qsort(corners, count, sizeof *corners, compare_corners);
	parts->vertex_count = 0;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		if (i == 0 || !same_place(&corners[i - 1], &corners[i]))
			status = mesh_add_vertex(parts, corners[i].at);
		vertex[corners[i].number] = (uint32_t)(parts->vertex_count - 1);
	}
	for (size_t i = 0; i + 2 < count && status == BATTEN_OK; i += 3)
		status = mesh_add_triangle(parts, vertex[i], vertex[i + 1], vertex[i + 2]);
	batten_release(parts->context, corners);
	batten_release(parts->context, vertex);
	return status;
}

static uint32_t number_at(const char *bytes)
{
	const unsigned char *b = (const unsigned char *)bytes;
	return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static batten_status read_binary(struct mesh_parts *parts, const char *text, size_t count)
{
	for (size_t t = 0; t < count; t++)
		for (size_t k = 0; k < 3; k++) {
			double at[3];
			for (size_t c = 0; c < 3; c++) {
				const uint32_t bits = number_at(text + HEADER_SIZE + t * RECORD_SIZE + 12 + 12 * k +
				                                4 * c);
				float number;
				memcpy(&number, &bits, sizeof number);
				if (!isfinite(number))
					return batten_fail(
						parts->context, BATTEN_INPUT,
						"%s: triangle %zu: found a coordinate that is no finite number",
						parts->name, t);
				at[c] = (double)number + 0.0; /* no -0 */
			}
			const batten_status status = mesh_add_vertex(parts, at);
			if (status != BATTEN_OK)
				return status;
		}
	return join_corners(parts);
}

static batten_status read_lines(struct mesh_parts *parts, const char *text, size_t length)
{
	struct mesh_line line = { .parts = parts, .text = text, .end = text + length };
	batten_status status = BATTEN_OK;
	size_t facet = 0; /* vertices before the last facet began */
	while (status == BATTEN_OK && mesh_next_line(&line)) {
		size_t size = 0;
		double at[3];
		const char *word = mesh_next_word(&line, &size);
		if (mesh_word_is(word, size, "vertex")) {
			status = mesh_read_point(&line, at);
			if (status == BATTEN_OK)
				status = mesh_add_vertex(parts, at);
		} else if (mesh_word_is(word, size, "facet") || mesh_word_is(word, size, "endsolid")) {
			if (parts->vertex_count != facet && parts->vertex_count != facet + 3)
				status = mesh_fail(&line, word, size, "three vertices of the facet before");
			facet = parts->vertex_count;
		}
	}
	if (status == BATTEN_OK && parts->vertex_count != facet)
		status = mesh_fail(&line, "", 0, "endsolid");
	return status == BATTEN_OK ? join_corners(parts) : status;
}

/* A binary file tells its length; its first word may be "solid" too. */
batten_status mesh_read_stl(struct mesh_parts *parts, const char *text, size_t length)
{
	if (length >= HEADER_SIZE) {
		const size_t count = number_at(text + HEADER_SIZE - 4);
		if ((length - HEADER_SIZE) % RECORD_SIZE == 0 &&
		    (length - HEADER_SIZE) / RECORD_SIZE == count)
			return read_binary(parts, text, count);
	}
	if (length >= 5 && mesh_word_is(text, 5, "solid"))
		return read_lines(parts, text, length);
	return batten_fail(
		parts->context, BATTEN_INPUT,
		"%s: found %zu bytes, expected 84 and 50 for each triangle, or a text that begins "
		"with 'solid'",
		parts->name, length);
}
