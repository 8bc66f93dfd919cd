/* The reader of offsets files against arbitrary bytes. What it accepts must be a sound hull that is
 * written and read back unchanged; what it refuses must come with a message that names the place.
 *
 *   clang -fsanitize=fuzzer,address,undefined ...            libFuzzer
 *   fuzz_offsets FILE ...   (with BATTEN_FUZZ_STANDALONE)  the files, and changed copies of them */
#include "batten.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const char *input_name = "input.csv";

static void require(bool condition, const char *what, const char *detail)
{
	if (condition)
		return;
	(void)fprintf(stderr, "fuzz_offsets: %s: %s\n", what, detail);
	abort();
}

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
	require(status == BATTEN_INPUT || status == BATTEN_MEMORY, "status of a refusal", message);
	require(strchr(message, '\n') == NULL, "message of one line", message);
	if (status == BATTEN_MEMORY)
		return;
	size_t name = strlen(input_name);
	const char *rest = message + name;
	require(strncmp(message, input_name, name) == 0 && skip_number(&rest) && skip_number(&rest) &&
	            strncmp(rest, ": found ", 8) == 0 && strstr(rest, ", expected "),
	        "message with file, line, column, what was found and what was expected", message);
}

static void check_ascending(const double *values, size_t count, const char *what)
{
	require(count >= 2 && count <= 4096, "count of lines", what);
	for (size_t i = 0; i < count; i++)
		require(isfinite(values[i]) && (i == 0 || values[i] > values[i - 1]), "order", what);
}

static void check_hull(const batten_hull *hull)
{
	size_t stations = batten_hull_station_count(hull);
	size_t waterlines = batten_hull_waterline_count(hull);
	check_ascending(batten_hull_x_m(hull), stations, "x");
	check_ascending(batten_hull_z_m(hull), waterlines, "z");
	for (size_t i = 0; i < stations * waterlines; i++) {
		double y = batten_hull_y_m(hull)[i];
		require(y >= 0 && isfinite(y), "half-breadth", "not 0 or more");
		require(batten_hull_nodes(hull)[i] <= BATTEN_NODE_UNKNOWN, "node", "of no known kind");
	}
	require(batten_hull_name(hull)[0] != '\0', "name", "empty");
	require(batten_hull_lbp_m(hull) > 0 && batten_hull_draft_m(hull) > 0, "length", "not above 0");
}

static void check_equal(const batten_hull *a, const batten_hull *b)
{
	size_t stations = batten_hull_station_count(a);
	size_t waterlines = batten_hull_waterline_count(a);
	size_t nodes = stations * waterlines;
	require(batten_hull_station_count(b) == stations &&
	            batten_hull_waterline_count(b) == waterlines,
	        "read back", "another size");
	require(memcmp(batten_hull_x_m(a), batten_hull_x_m(b), stations * sizeof(double)) == 0,
	        "read back", "another x");
	require(memcmp(batten_hull_z_m(a), batten_hull_z_m(b), waterlines * sizeof(double)) == 0,
	        "read back", "another z");
	require(memcmp(batten_hull_y_m(a), batten_hull_y_m(b), nodes * sizeof(double)) == 0,
	        "read back", "another y");
	require(memcmp(batten_hull_nodes(a), batten_hull_nodes(b), nodes) == 0, "read back",
	        "other nodes");
	require(strcmp(batten_hull_name(a), batten_hull_name(b)) == 0 &&
	            strcmp(batten_hull_source(a), batten_hull_source(b)) == 0 &&
	            batten_hull_lbp_m(a) == batten_hull_lbp_m(b) &&
	            batten_hull_draft_m(a) == batten_hull_draft_m(b),
	        "read back", "another header");
}

static void check_round_trip(batten_context *context, const batten_hull *hull)
{
	const char *folder = getenv("TMPDIR");
	char path[256];
	(void)snprintf(path, sizeof path, "%s/fuzz_offsets.%ld.csv", folder ? folder : "/tmp",
	               (long)getpid());
	batten_hull *again = NULL;
	require(batten_hull_write(context, hull, path) == BATTEN_OK, "write",
	        batten_context_error(context));
	require(batten_hull_read(context, path, &again) == BATTEN_OK, "read back",
	        batten_context_error(context));
	check_equal(hull, again);
	batten_hull_destroy(again);
	(void)unlink(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	batten_context_options options;
	batten_context_options_default(&options);
	options.max_memory = (size_t)256 << 20;
	batten_context *context = NULL;
	require(batten_context_create(&options, &context) == BATTEN_OK, "context", "not made");
	batten_hull *hull = NULL;
	batten_status status = batten_hull_parse(context, input_name, (const char *)data, size, &hull);
	if (status == BATTEN_OK) {
		check_hull(hull);
		check_round_trip(context, hull);
	} else {
		require(hull == NULL, "output of a refusal", "not NULL");
		check_message(status, batten_context_error(context));
	}
	batten_hull_destroy(hull);
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
