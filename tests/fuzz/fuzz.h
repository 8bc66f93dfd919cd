/* What every fuzz_*.c shares: the context, the check of a refusal, and a standalone program that
 * runs files and changed copies of them. The includer names itself first, then writes fuzz_one():
 *
 *   #define FUZZ_PROGRAM "fuzz_points"
 *   #include "fuzz.h"
 *
 * FUZZ_OWN_MESSAGES says that its inputs are no tables, whose messages name line and column.
 *
 *   clang -fsanitize=fuzzer,address,undefined ...            libFuzzer
 *   fuzz_points FILE ...   (with BATTEN_FUZZ_STANDALONE)  the files, and changed copies of them */
#ifndef BATTEN_TESTS_FUZZ_FUZZ_H
#define BATTEN_TESTS_FUZZ_FUZZ_H

#include "batten.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FUZZ_PATH = 256 };

/* The includer's: one input, in a context of its own; aborts by require() at what is wrong. */
static void fuzz_one(batten_context *context, const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool condition, const char *what, const char *detail)
{
	if (condition)
		return;
	(void)fprintf(stderr, FUZZ_PROGRAM ": %s: %s\n", what, detail);
	abort();
}

static void check_line(batten_status status, const char *message)
{
	require(status == BATTEN_INPUT || status == BATTEN_MEMORY, "status of a refusal", message);
	require(strchr(message, '\n') == NULL, "message of one line", message);
}

#ifndef FUZZ_OWN_MESSAGES

/* The name under which the bytes are parsed, and which messages must begin with. */
static const char input_name[] = "input.csv";

/* Whether text goes on with ":NUMBER"; moves it past that. */
static bool skip_number(const char **text)
{
	if ((*text)[0] != ':' || (*text)[1] < '1' || (*text)[1] > '9')
		return false;
	*text += 1 + strspn(*text + 1, "0123456789");
	return true;
}

static void check_message(batten_status status, const char *message)
{
	check_line(status, message);
	if (status == BATTEN_MEMORY)
		return;
	size_t name = strlen(input_name);
	const char *rest = message + name;
	require(strncmp(message, input_name, name) == 0 && skip_number(&rest) && skip_number(&rest) &&
	            strncmp(rest, ": found ", 8) == 0 && strstr(rest, ", expected "),
	        "message with file, line, column, what was found and what was expected", message);
}

/* A file of this process alone, so that several may run at once. */
static void temporary_path(char path[FUZZ_PATH])
{
	const char *folder = getenv("TMPDIR");
	(void)snprintf(path, FUZZ_PATH, "%s/" FUZZ_PROGRAM ".%ld.csv", folder ? folder : "/tmp",
	               (long)getpid());
}

#endif

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	batten_context_options options;
	batten_context_options_default(&options);
	options.max_memory = (size_t)256 << 20;
	batten_context *context = NULL;
	require(batten_context_create(&options, &context) == BATTEN_OK, "context", "not made");
	fuzz_one(context, data, size);
	batten_context_destroy(context);
	return 0;
}

#ifdef BATTEN_FUZZ_STANDALONE

enum { CHANGED_COPIES = 6000, LARGEST_FILE = 1 << 16 };

/* SplitMix64: the same changes on every machine. */
static uint64_t next_random(uint64_t *state)
{
	uint64_t z = *state += 0x9E3779B97F4A7C15u;
	z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
	z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
	return z ^ (z >> 31);
}

/* One change: a byte replaced, a piece taken out, or a piece doubled. */
static size_t change(uint8_t *text, size_t size, uint64_t *state)
{
	static const char letters[] = "0123456789.,,,-+eE?#:;\n\n\r\t \"zxm\xEF\xBB\xBF";
	size_t at = size > 0 ? (size_t)(next_random(state) % size) : 0;
	size_t length = (size_t)(next_random(state) % 24);
	length = length < size - at ? length : size - at;
	switch (next_random(state) % 4) {
	case 0:
		memmove(text + at, text + at + length, size - at - length);
		return size - length;
	case 1:
		if (size + length > LARGEST_FILE)
			return size;
		memmove(text + at + length, text + at, size - at);
		return size + length;
	case 2:
		if (size > 0)
			text[at] = (uint8_t)next_random(state);
		return size;
	default:
		if (size > 0)
			text[at] = (uint8_t)letters[next_random(state) % (sizeof letters - 1)];
		return size;
	}
}

static void run_file(const char *path)
{
	static uint8_t original[LARGEST_FILE], changed[LARGEST_FILE];
	FILE *stream = fopen(path, "rb");
	require(stream != NULL, "cannot be read", path);
	size_t size = fread(original, 1, sizeof original, stream);
	require(!ferror(stream) && size > 0 && size < sizeof original, "not a small file", path);
	(void)fclose(stream);
	(void)LLVMFuzzerTestOneInput(original, size);
	uint64_t state = 2025;
	for (int copy = 0; copy < CHANGED_COPIES; copy++) {
		memcpy(changed, original, size);
		size_t length = size;
		for (uint64_t i = next_random(&state) % 4 + 1; i > 0; i--)
			length = change(changed, length, &state);
		/* Its own block of exactly this size, so that a sanitizer sees a byte read beyond. */
		uint8_t *exact = malloc(length > 0 ? length : 1);
		require(exact != NULL, "memory", path);
		memcpy(exact, changed, length);
		(void)LLVMFuzzerTestOneInput(exact, length);
		free(exact);
	}
}

int main(int argc, char **argv)
{
	require(argc > 1, "expected", "files to begin with");
	for (int i = 1; i < argc; i++)
		run_file(argv[i]);
	return 0;
}

#endif

#endif
