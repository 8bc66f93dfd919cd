/* All tests of a sanitizer's build in one program, which is told by name which one runs: to link one for each
 * takes a minute of processor time. Their files are compiled with main() named after them; ALL_TESTS, from the
 * build, is TEST(NAME) for each. */
#include <stdio.h>
#include <string.h>

#define TEST(name) int main_of_##name(void);
ALL_TESTS
#undef TEST

int main(int argc, char **argv)
{
#define TEST(name) { #name, main_of_##name },
	static const struct {
		const char *name;
		int (*run)(void);
	} tests[] = { ALL_TESTS };
#undef TEST
	for (size_t i = 0; argc == 2 && i < sizeof tests / sizeof *tests; i++)
		if (strcmp(argv[1], tests[i].name) == 0)
			return tests[i].run();
	fprintf(stderr, "test_all: found %s, expected one of", argc > 1 ? argv[1] : "nothing");
	for (size_t i = 0; i < sizeof tests / sizeof *tests; i++)
		fprintf(stderr, " %s", tests[i].name);
	fputc('\n', stderr);
	return 2;
}
