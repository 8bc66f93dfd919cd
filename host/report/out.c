#include "report/out.h"

#include "core/number.h"

#include <math.h>
#include <string.h>

enum { REPLACEMENT = 0xFFFD };

/* The code point at text[0..length) and in *used the bytes it takes; REPLACEMENT and one byte where
 * they are no UTF-8 (RFC 3629: no surrogates, nothing longer than needed or above U+10FFFF). */
static uint32_t decode(const unsigned char *text, size_t length, size_t *used)
{
	static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 };
	const unsigned first = text[0];
	const size_t size = first < 0x80                    ? 1
	                    : first >= 0xC2 && first < 0xE0 ? 2
	                    : first >= 0xE0 && first < 0xF0 ? 3
	                    : first >= 0xF0 && first < 0xF5 ? 4
	                                                    : 0;
	*used = 1;
	if (size == 0 || size > length)
		return REPLACEMENT;
	if (size == 1)
		return first;
	uint32_t point = first & (0x7FU >> size);
	for (size_t i = 1; i < size; i++) {
		if ((text[i] & 0xC0U) != 0x80U)
			return REPLACEMENT;
		point = point << 6 | (text[i] & 0x3FU);
	}
	if (point < least[size] || point > 0x10FFFF || (point >= 0xD800 && point < 0xE000))
		return REPLACEMENT;
	*used = size;
	return point;
}

void report_put_text(FILE *stream, const char *text, size_t length)
{
	const unsigned char *bytes = (const unsigned char *)text;
	(void)fputc('"', stream);
	for (size_t i = 0, used = 0; i < length; i += used) {
		const uint32_t point = decode(bytes + i, length - i, &used);
		if (point > 0xFFFF)
			(void)fprintf(stream, "\\u%04x\\u%04x", (unsigned)(0xD7C0 + (point >> 10)),
			              (unsigned)(0xDC00 + (point & 0x3FF)));
		else if (point < 0x20 || point > 0x7E || strchr("\"\\<>&", (int)point))
			(void)fprintf(stream, "\\u%04x", (unsigned)point);
		else
			(void)fputc((int)point, stream);
	}
	(void)fputc('"', stream);
}

void report_put_number(FILE *stream, double value)
{
	char text[BATTEN_NUMBER_SIZE];
	(void)fputs(isfinite(value) ? batten_number_write(text, value) : "null", stream);
}

static void put_group(report_base64 *out, unsigned digits)
{
	static const char alphabet[] =
		"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	char group[4] = { '=', '=', '=', '=' };
	for (unsigned i = 0; i < digits; i++)
		group[i] = alphabet[out->bits >> (18 - 6 * i) & 63];
	(void)fwrite(group, 1, sizeof group, out->stream);
	out->bits = 0;
	out->count = 0;
}

void report_base64_u8(report_base64 *out, uint8_t value)
{
	out->bits |= (uint32_t)value << (16 - 8 * out->count);
	if (++out->count == 3)
		put_group(out, 4);
}

void report_base64_end(report_base64 *out)
{
	if (out->count > 0)
		put_group(out, out->count + 1);
}

static void put_bytes(report_base64 *out, uint64_t bits, unsigned count)
{
	for (unsigned i = 0; i < count; i++)
		report_base64_u8(out, (uint8_t)(bits >> (8 * i) & 0xFF));
}

void report_base64_i16(report_base64 *out, int16_t value)
{
	put_bytes(out, (uint16_t)value, 2);
}

void report_base64_f32(report_base64 *out, float value)
{
	uint32_t bits;
	memcpy(&bits, &value, sizeof bits);
	put_bytes(out, bits, 4);
}

void report_base64_f64(report_base64 *out, double value)
{
	uint64_t bits;
	memcpy(&bits, &value, sizeof bits);
	put_bytes(out, bits, 8);
}
