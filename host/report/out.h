/* What goes into the page: text that no browser takes for markup, and numbers as base64. Errors of
 * the stream stay in it until the file is committed. */
#ifndef BATTEN_REPORT_OUT_H
#define BATTEN_REPORT_OUT_H

#include "core/context.h"

#include <stdio.h>

/* A JSON string with its quotes, safe inside a script element: control characters, the markup's
 * '<', '>' and '&' and all that is not ASCII are escaped, bytes that are no UTF-8 become U+FFFD. */
void report_put_text(FILE *stream, const char *text, size_t length);

/* The shortest decimal that reads back exactly, null where it is not finite. */
void report_put_number(FILE *stream, double value);

/* Base64 of a run of numbers, little-endian whatever the machine is. Begin with { stream }. */
typedef struct report_base64 {
	FILE *stream;
	uint32_t bits; /* what waits for the next group of three bytes */
	unsigned count;
} report_base64;
void report_base64_u8(report_base64 *out, uint8_t value);
void report_base64_i16(report_base64 *out, int16_t value);
void report_base64_f32(report_base64 *out, float value);
void report_base64_f64(report_base64 *out, double value);
void report_base64_end(report_base64 *out);

#endif
