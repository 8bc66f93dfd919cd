/* What charts are drawn with: text, ticks, colours, on any cairo surface. */
#ifndef BATTEN_PICTURE_PAPER_H
#define BATTEN_PICTURE_PAPER_H

#include "core/context.h"

#include <cairo.h>

typedef enum paper_anchor { PAPER_LEFT, PAPER_CENTRE, PAPER_RIGHT } paper_anchor;

typedef struct paper_ink {
	double red, green, blue;
} paper_ink;

typedef struct paper_text {
	double x, y;  /* anchor on the baseline */
	double size;  /* of the font, in units of the surface */
	double width; /* the font shrinks until the text is no wider; 0: any width */
	bool bold;
	paper_anchor anchor;
	paper_ink ink;
} paper_text;

void paper_write(cairo_t *cairo, const paper_text *style, const char *text);

/* Copies text that came with a file: control characters and bytes that are no UTF-8 become '?',
 * what does not fit is cut at a character. */
void paper_clean_text(const char *text, char *out, size_t size);

/* Ticks at multiples of 1, 2 or 5 times a power of ten, at most count of them in low..high. */
typedef struct paper_ticks {
	double step;
	long first, last; /* ticks at step times first .. last */
	int decimals;     /* that tell them apart */
} paper_ticks;
paper_ticks paper_choose_ticks(double low, double high, int count);
/* A tick's number with its decimals and a true minus sign. */
void paper_tick_text(const paper_ticks *ticks, long tick, bool with_plus, char *out, size_t size);

/* The status of what was drawn. Errors: MEMORY, INTERNAL. */
batten_status paper_check(batten_context *context, cairo_t *cairo);

#endif
