/* Words for the net of a surface, as several subcommands take them. */
#include "cli.h"

#include <string.h>

_Static_assert(BATTEN_ROUNDED_KEEL == BATTEN_EDGE_KEEL &&
                   BATTEN_ROUNDED_STERN == BATTEN_EDGE_STERN &&
                   BATTEN_ROUNDED_STEM == BATTEN_EDGE_STEM,
               "an edge has one number");

bool cli_read_pair(const char *text, size_t *first, size_t *second)
{
	size_t values[2] = { 0, 0 };
	for (size_t i = 0; i < 2; i++) {
		size_t digits = 0;
		for (; *text >= '0' && *text <= '9' && digits < 4; text++, digits++)
			values[i] = 10 * values[i] + (size_t)(*text - '0');
		if (digits == 0 || (i == 0 && *text++ != 'x'))
			return false;
	}
	if (*text != '\0')
		return false;
	*first = values[0];
	*second = values[1];
	return true;
}

batten_status cli_read_edges(const char *command, const char *option, const char *text,
                             bool with_deck, unsigned *out)
{
	static const char *const names[] = { "keel", "stern", "stem", "deck" };
	static const unsigned bits[] = { BATTEN_EDGE_KEEL, BATTEN_EDGE_STERN, BATTEN_EDGE_STEM,
		                             BATTEN_EDGE_DECK };
	const size_t known = with_deck ? 4 : 3;
	for (const char *word = text;;) {
		const size_t length = strcspn(word, ",");
		size_t i = 0;
		while (i < known && (strlen(names[i]) != length || strncmp(names[i], word, length) != 0))
			i++;
		if (i == known)
			return cli_usage(command, "--%s: found '%s', expected keel, stern, stem%s", option,
			                 text, with_deck ? ", deck" : "");
		*out |= bits[i];
		if (word[length] == '\0')
			return BATTEN_OK;
		word += length + 1;
	}
}
