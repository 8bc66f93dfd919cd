#include "core/number.h"

#include <ctype.h>
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Checks the spelling [+-] digits [. digits] [e [+-] digits]; strtod alone would take "0x1p3",
 * "infinity" and whatever the locale's decimal point is. */
static bool is_decimal(const char *text, size_t length)
{
	size_t i = 0;
	size_t digits = 0;
	if (i < length && (text[i] == '+' || text[i] == '-'))
		i++;
	for (; i < length && isdigit((unsigned char)text[i]); i++)
		digits++;
	if (i < length && text[i] == '.')
		for (i++; i < length && isdigit((unsigned char)text[i]); i++)
			digits++;
	if (digits == 0)
		return false;
	if (i < length && (text[i] == 'e' || text[i] == 'E')) {
		i++;
		if (i < length && (text[i] == '+' || text[i] == '-'))
			i++;
		size_t first = i;
		while (i < length && isdigit((unsigned char)text[i]))
			i++;
		if (i == first)
			return false;
	}
	return i == length;
}

bool batten_number_read(const char *text, size_t length, double *out)
{
	while (length > 0 && (text[0] == ' ' || text[0] == '\t')) {
		text++;
		length--;
	}
	while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t'))
		length--;
	char copy[512];
	if (length == 0 || length >= sizeof copy || !is_decimal(text, length))
		return false;
	memcpy(copy, text, length);
	copy[length] = '\0';
	/* The decimal point of the calling program's locale, so that strtod reads ours. */
	char *point = memchr(copy, '.', length);
	const char *local = localeconv()->decimal_point;
	const size_t size = strlen(local);
	if (point && strcmp(local, ".") != 0) {
		if (length + size >= sizeof copy)
			return false;
		memmove(point + size, point + 1, strlen(point + 1) + 1);
		memcpy(point, local, size);
	}
	double value = strtod(copy, NULL);
	if (!isfinite(value))
		return false;
	*out = value;
	return true;
}

/* ------------------------------------------------------------------------------------------------
 * Numbers as text
 * --------------------------------------------------------------------------------------------- */

__extension__ typedef unsigned __int128 wide;

/* A double above 0 as part * 2^-shift, its decimal exponent, and the digits tried of it. */
struct decimal {
	uint64_t part;
	int shift, exponent;
	uint64_t digits;
	int count; /* of digits */
};

/* The nearest decimal of that many digits, and whether it reads back. All in whole numbers: with p
 * digits behind the point the value is part * 5^p / 2^(shift - p), where neighbouring doubles lie 5^p
 * apart. */
static bool try_digits(struct decimal *d, int count)
{
	const int p = count - 1 - d->exponent, right = d->shift - p;
	uint64_t five = 1;
	for (int i = 0; i < p; i++)
		five *= 5;
	const wide exact = (wide)d->part * five, half = (wide)1 << (right - 1);
	const wide rest = exact & (2 * half - 1);
	d->digits = (uint64_t)(exact >> right);
	d->count = count;
	d->digits += rest > half || (rest == half && d->digits % 2 == 1);
	const wide found = (wide)d->digits << right;
	if (found >= exact)
		return 2 * (found - exact) < five;
	/* below a power of two doubles lie closer */
	const bool closer = d->part == (uint64_t)1 << 52;
	return (closer ? 4 : 2) * (exact - found) < five;
}

/* Writes the digits with their point, without zeros at the end. */
static char *put_digits(struct decimal *d, char *at)
{
	char digits[20];
	for (; d->count > 1 && d->digits % 10 == 0; d->count--)
		d->digits /= 10;
	for (int i = d->count; i-- > 0; d->digits /= 10)
		digits[i] = (char)('0' + d->digits % 10);
	int next = 0;
	if (d->exponent < 0)
		*at++ = '0';
	for (int place = d->exponent; place >= 0; place--)
		*at++ = next < d->count ? digits[next++] : '0';
	if (next < d->count)
		*at++ = '.';
	for (int place = -1; place > d->exponent; place--)
		*at++ = '0';
	while (next < d->count)
		*at++ = digits[next++];
	return at;
}

/* The same text as by trial below, for 1e-4 <= size < 1e15: most numbers, a tenth of the time. */
static void write_fixed(char *buffer, double value)
{
	static const double powers[] = { 1e-3, 1e-2, 1e-1, 1,   1e1,  1e2,  1e3,  1e4,  1e5,
		                             1e6,  1e7,  1e8,  1e9, 1e10, 1e11, 1e12, 1e13, 1e14 };
	struct decimal d = { .exponent = -4 };
	int exponent = 0;
	d.part = (uint64_t)ldexp(frexp(fabs(value), &exponent), 53);
	d.shift = 53 - exponent;
	for (size_t i = 0; i < sizeof powers / sizeof powers[0] && fabs(value) >= powers[i]; i++)
		d.exponent++;
	if (value < 0)
		*buffer++ = '-';
	if (!try_digits(&d, 15) && !try_digits(&d, 16))
		(void)try_digits(&d, 17);
	*put_digits(&d, buffer) = '\0';
}

static void write_by_trial(char *buffer, double value)
{
	for (int digits = 15; digits <= 17; digits++) {
		(void)snprintf(buffer, BATTEN_NUMBER_SIZE, "%.*g", digits, value);
		if (strtod(buffer, NULL) == value)
			break;
	}
	const char *local = localeconv()->decimal_point;
	char *point = strstr(buffer, local);
	if (point) {
		*point = '.';
		memmove(point + 1, point + strlen(local), strlen(point + strlen(local)) + 1);
	}
}

char *batten_number_write(char buffer[BATTEN_NUMBER_SIZE], double value)
{
	const double size = fabs(value);
	if (!isfinite(value))
		(void)snprintf(buffer, BATTEN_NUMBER_SIZE, "%s",
		               isnan(value) ? "nan"
		               : value < 0  ? "-inf"
		                            : "inf");
	else if (size >= 1e-4 && size < 1e15)
		write_fixed(buffer, value);
	else
		write_by_trial(buffer, value);
	return buffer;
}

int batten_number_compare(const void *a, const void *b)
{
	const double left = *(const double *)a;
	const double right = *(const double *)b;
	return (left > right) - (left < right);
}

bool batten_size_multiply(size_t a, size_t b, size_t *product)
{
	return !__builtin_mul_overflow(a, b, product);
}
