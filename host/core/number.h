/* Numbers in and out of text, independent of the locale. */
#ifndef BATTEN_CORE_NUMBER_H
#define BATTEN_CORE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

enum { BATTEN_NUMBER_SIZE = 32 };

/* Reads a whole decimal number (blanks around it allowed) from text[0..length). False for anything
 * else: hexadecimal, inf, nan, a decimal comma, trailing characters, out of range. */
bool batten_number_read(const char *text, size_t length, double *out);

/* Writes the shortest decimal that reads back exactly; "nan" and "inf" spelled so. Returns buffer. */
char *batten_number_write(char buffer[BATTEN_NUMBER_SIZE], double value);

/* Order of two doubles for qsort: ascending. */
int batten_number_compare(const void *a, const void *b);

/* a * b in *product; false when it overflows. */
bool batten_size_multiply(size_t a, size_t b, size_t *product);

#endif
