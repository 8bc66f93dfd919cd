#include "picture/png_file.h"

#include "core/file.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <string.h>

/* libpng reports by longjmp; what it would have said is kept here. */
typedef struct png_failure {
	jmp_buf place;
	char message[128];
} png_failure;

static void keep_error(png_structp png, png_const_charp message)
{
	png_failure *failure = png_get_error_ptr(png);
	size_t length = strnlen(message, sizeof failure->message - 1);
	memcpy(failure->message, message, length);
	failure->message[length] = '\0';
	longjmp(failure->place, 1);
}

static void ignore_warning(png_structp png, png_const_charp message)
{
	(void)png;
	(void)message;
}

static void write_notes(png_structp png, png_infop info, const png_picture *picture)
{
	for (size_t i = 0; i < picture->note_count; i++) {
		/* libpng copies both; its struct is not const. */
		char keyword[80];
		(void)snprintf(keyword, sizeof keyword, "%s", picture->notes[i].keyword);
		const char *note = picture->notes[i].text;
		bool plain = true;
		for (const char *c = note; *c; c++)
			plain = plain && (unsigned char)*c < 0x80;
		png_text text = {
			.compression = plain ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE,
			.key = keyword,
		};
		char copy[512];
		(void)snprintf(copy, sizeof copy, "%s", note);
		text.text = copy;
		text.text_length = strlen(copy);
		png_set_text(png, info, &text, 1);
	}
}

static void write_rows(png_structp png, const png_picture *picture, uint8_t *row)
{
	for (uint32_t y = 0; y < picture->height; y++) {
		const uint8_t *from = picture->xrgb + y * picture->stride;
		for (uint32_t x = 0; x < picture->width; x++) {
			uint32_t pixel;
			memcpy(&pixel, from + 4 * (size_t)x, sizeof pixel);
			row[3 * (size_t)x] = (uint8_t)(pixel >> 16);
			row[3 * (size_t)x + 1] = (uint8_t)(pixel >> 8);
			row[3 * (size_t)x + 2] = (uint8_t)pixel;
		}
		png_write_row(png, row);
	}
}

/* False when libpng failed. Nothing here is changed between setjmp and a longjmp. */
static bool write_all(png_structp png, png_infop info, png_failure *failure,
                      const png_picture *picture, FILE *stream, uint8_t *row)
{
	if (setjmp(failure->place) != 0)
		return false;
	png_init_io(png, stream);
	png_set_IHDR(png, info, picture->width, picture->height, 8, PNG_COLOR_TYPE_RGB,
	             PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
	png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
	write_notes(png, info, picture);
	png_write_info(png, info);
	write_rows(png, picture, row);
	png_write_end(png, info);
	return true;
}

static batten_status write_stream(batten_context *context, const png_picture *picture,
                                  const char *path, FILE *stream)
{
	png_failure failure = { .message = "" };
	uint8_t *row = batten_allocate(context, picture->width, 3);
	png_structp png = row ? png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, keep_error,
	                                                ignore_warning)
	                      : NULL;
	png_infop info = png ? png_create_info_struct(png) : NULL;
	batten_status status = BATTEN_OK;
	if (!row)
		status = BATTEN_MEMORY;
	else if (!info)
		status = batten_fail_memory(context);
	else if (!write_all(png, info, &failure, picture, stream, row))
		status = batten_fail(context, BATTEN_IO, "%s: cannot be written: %s", path,
		                     ferror(stream) && errno ? strerror(errno) : failure.message);
	png_destroy_write_struct(&png, &info);
	batten_release(context, row);
	return status;
}

batten_status png_file_write(batten_context *context, const png_picture *picture, const char *path)
{
	batten_file file = { 0 };
	batten_status status = batten_file_open(context, path, &file);
	if (status != BATTEN_OK)
		return status;
	status = write_stream(context, picture, path, file.stream);
	if (status != BATTEN_OK) {
		batten_file_abandon(context, &file);
		return status;
	}
	return batten_file_commit(context, &file);
}
