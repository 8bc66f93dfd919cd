/* Text that a hull carries: names, sources, labels. */
#include "hull/hull.h"

#include <string.h>

/* Length of the UTF-8 character at text, 0 when it is none (overlong, surrogate, cut off). */
static size_t character_length(const unsigned char *text, size_t length)
{
	unsigned char lead = text[0];
	size_t size = lead < 0x80                   ? 1
	              : lead >= 0xC2 && lead < 0xE0 ? 2
	              : lead >= 0xE0 && lead < 0xF0 ? 3
	              : lead >= 0xF0 && lead < 0xF5 ? 4
	                                            : 0;
	if (size == 0 || size > length)
		return 0;
	for (size_t i = 1; i < size; i++)
		if ((text[i] & 0xC0) != 0x80)
			return 0;
	bool overlong = (lead == 0xE0 && text[1] < 0xA0) || (lead == 0xF0 && text[1] < 0x90);
	bool surrogate = lead == 0xED && text[1] >= 0xA0;
	bool beyond = lead == 0xF4 && text[1] >= 0x90;
	/* C1 control characters U+0080 to U+009F */
	bool control = lead == 0xC2 && text[1] < 0xA0;
	return overlong || surrogate || beyond || control ? 0 : size;
}

size_t hull_text_length(const char *text, size_t length)
{
	size_t i = 0;
	while (i < length) {
		unsigned char byte = (unsigned char)text[i];
		if ((byte < 0x20 && byte != '\t') || byte == 0x7F)
			break;
		size_t size = character_length((const unsigned char *)text + i, length - i);
		if (size == 0)
			break;
		i += size;
	}
	return i;
}

static bool is_blank(char letter)
{
	return letter == ' ' || letter == '\t';
}

batten_status hull_clean_text(batten_context *context, const char *text, size_t length, char **out)
{
	*out = NULL;
	if (length > HULL_TEXT_MOST)
		return batten_fail(context, BATTEN_USAGE, "a name has %zu bytes, expected %d at most",
		                   length, HULL_TEXT_MOST);
	size_t good = hull_text_length(text, length);
	if (good < length)
		return batten_fail(
			context, BATTEN_USAGE,
			"byte %zu of a name is 0x%02x, expected UTF-8 without control characters", good + 1,
			(unsigned)(unsigned char)text[good]);
	while (length > 0 && is_blank(text[0])) {
		text++;
		length--;
	}
	while (length > 0 && (is_blank(text[length - 1]) || text[length - 1] == ','))
		length--;
	char *copy = batten_allocate(context, length + 1, 1);
	if (!copy)
		return BATTEN_MEMORY;
	memcpy(copy, text, length);
	*out = copy;
	return BATTEN_OK;
}
