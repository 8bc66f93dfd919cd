#include "picture/paper.h"

#include "core/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void paper_write(cairo_t *cairo, const paper_text *style, const char *text)
{
	cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
	                       style->bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
	cairo_set_font_size(cairo, style->size);
	cairo_text_extents_t extents;
	cairo_text_extents(cairo, text, &extents);
	if (style->width > 0.0 && extents.x_advance > style->width) {
		cairo_set_font_size(cairo, style->size * style->width / extents.x_advance);
		cairo_text_extents(cairo, text, &extents);
	}
	double shift = style->anchor == PAPER_LEFT     ? 0.0
	               : style->anchor == PAPER_CENTRE ? 0.5 * extents.x_advance
	                                               : extents.x_advance;
	cairo_set_source_rgb(cairo, style->ink.red, style->ink.green, style->ink.blue);
	cairo_move_to(cairo, style->x - shift, style->y);
	cairo_show_text(cairo, text);
	cairo_new_path(cairo);
}

/* Length of the UTF-8 character at text, 0 when there is none (RFC 3629: shortest form, no
 * surrogates, up to U+10FFFF). */
static size_t character_length(const unsigned char *text)
{
	unsigned first = text[0];
	size_t length = first < 0x80   ? 1
	                : first < 0xC2 ? 0
	                : first < 0xE0 ? 2
	                : first < 0xF0 ? 3
	                : first < 0xF5 ? 4
	                               : 0;
	for (size_t i = 1; i < length; i++)
		if ((text[i] & 0xC0) != 0x80)
			return 0;
	if ((first == 0xE0 && text[1] < 0xA0) || (first == 0xED && text[1] > 0x9F) ||
	    (first == 0xF0 && text[1] < 0x90) || (first == 0xF4 && text[1] > 0x8F))
		return 0;
	return length;
}

void paper_clean_text(const char *text, char *out, size_t size)
{
	const unsigned char *from = (const unsigned char *)text;
	size_t used = 0;
	while (*from) {
		size_t length = character_length(from);
		bool good = length > 1 || (length == 1 && *from >= 0x20 && *from != 0x7F);
		size_t needed = good ? length : 1;
		if (used + needed >= size)
			break;
		if (good)
			memcpy(out + used, from, length);
		else
			out[used] = '?';
		used += needed;
		from += length ? length : 1;
	}
	out[used] = '\0';
}

paper_ticks paper_choose_ticks(double low, double high, int count)
{
	double least = (high - low) / (count > 1 ? count - 1 : 1);
	int power = (int)floor(log10(least));
	double unit = pow(10.0, power);
	double factor = least <= unit * 1.000001 ? 1.0
	                : least <= 2.0 * unit    ? 2.0
	                : least <= 5.0 * unit    ? 5.0
	                                         : 10.0;
	paper_ticks ticks = { .step = factor * unit };
	if (factor >= 10.0)
		power++;
	ticks.decimals = power < 0 ? -power : 0;
	/* Ends that are multiples but for rounding count as such. */
	ticks.first = (long)ceil(low / ticks.step - 1e-6);
	ticks.last = (long)floor(high / ticks.step + 1e-6);
	return ticks;
}

void paper_tick_text(const paper_ticks *ticks, long tick, bool with_plus, char *out, size_t size)
{
	/* Only decimal places from the ticks' own step: rounding them on paper loses nothing. */
	double power = pow(10.0, ticks->decimals);
	double rounded = round(fabs(ticks->step * (double)tick) * power) / power;
	char number[BATTEN_NUMBER_SIZE];
	(void)batten_number_write(number, rounded);
	(void)snprintf(out, size, "%s%s",
	               tick < 0                ? "\u2212"
	               : with_plus && tick > 0 ? "+"
	                                       : "",
	               number);
}

batten_status paper_check(batten_context *context, cairo_t *cairo)
{
	cairo_status_t status = cairo_status(cairo);
	if (status == CAIRO_STATUS_SUCCESS)
		return BATTEN_OK;
	if (status == CAIRO_STATUS_NO_MEMORY)
		return batten_fail_memory(context);
	return batten_fail(context, BATTEN_INTERNAL, "cairo: %s", cairo_status_to_string(status));
}
