#include "core/number.h"

#include <ctype.h>
#include <locale.h>
#include <math.h>
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

char *batten_number_write(char buffer[BATTEN_NUMBER_SIZE], double value)
{
	if (!isfinite(value)) {
		(void)snprintf(buffer, BATTEN_NUMBER_SIZE, "%s",
		               isnan(value) ? "nan"
		               : value < 0  ? "-inf"
		                            : "inf");
		return buffer;
	}
	/* Where 15 digits read back, so do the nearest 16, which are no farther off: most numbers need two
	 * trials, not three. */
	char shorter[BATTEN_NUMBER_SIZE];
	(void)snprintf(buffer, BATTEN_NUMBER_SIZE, "%.16g", value);
	if (strtod(buffer, NULL) == value) {
		(void)snprintf(shorter, sizeof shorter, "%.15g", value);
		if (strtod(shorter, NULL) == value)
			memcpy(buffer, shorter, sizeof shorter);
	} else {
		(void)snprintf(buffer, BATTEN_NUMBER_SIZE, "%.17g", value);
	}
	const char *local = localeconv()->decimal_point;
	char *point = strstr(buffer, local);
	if (point) {
		*point = '.';
		memmove(point + 1, point + strlen(local), strlen(point + strlen(local)) + 1);
	}
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
