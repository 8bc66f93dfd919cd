/* Pictures out as PNG. */
#ifndef BATTEN_PICTURE_PNG_FILE_H
#define BATTEN_PICTURE_PNG_FILE_H

#include "core/context.h"

/* A line of text that travels in the file; UTF-8. */
typedef struct png_note {
	const char *keyword, *text;
} png_note;

typedef struct png_picture {
	uint32_t width, height;
	size_t stride;       /* bytes a row */
	const uint8_t *xrgb; /* one 32-bit word a pixel, 0xXXRRGGBB in the machine's order (cairo) */
	const png_note *notes;
	size_t note_count;
} png_picture;

/* Replaces path at once or not at all. Errors: IO, MEMORY. */
batten_status png_file_write(batten_context *context, const png_picture *picture, const char *path);

#endif
