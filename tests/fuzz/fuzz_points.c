/* The reader of line files against arbitrary bytes. What it accepts must be sound points with
 * a spline that can be measured; what it refuses must come with a message that names the place.
 *
 *   clang -fsanitize=fuzzer,address,undefined ...            libFuzzer
 *   fuzz_points FILE ...   (with BATTEN_FUZZ_STANDALONE)  the files, and changed copies of them */
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
	(void)fprintf(stderr, "fuzz_points: %s: %s\n", what, detail);
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

static void check_points(const batten_points *points)
{
	size_t dimension = batten_points_dimension(points);
	size_t count = batten_points_count(points);
	require(dimension == 2 || dimension == 3, "dimension", "neither 2 nor 3");
	require(count >= 2 && count <= 4096, "count of points", "beyond 2..4096");
	for (size_t i = 0; i < count * dimension; i++)
		require(fabs(batten_points_m(points)[i]) <= 1e6, "coordinate", "beyond 1e6 m");
}

/* What is written is read back: a spline's samples. */
static void check_round_trip(batten_context *context, const batten_points *points)
{
	const char *folder = getenv("TMPDIR");
	char path[256];
	(void)snprintf(path, sizeof path, "%s/fuzz_points.%ld.csv", folder ? folder : "/tmp",
	               (long)getpid());
	batten_curve *curve = NULL;
	batten_points *again = NULL;
	batten_status status = batten_curve_create(context, points, NULL, &curve);
	/* Chords may add up to nothing beside a very long one. */
	require(status == BATTEN_OK || status == BATTEN_USAGE, "spline", batten_context_error(context));
	if (status != BATTEN_OK)
		return;
	batten_curve_measures measures;
	require(batten_curve_measure(context, curve, &measures) == BATTEN_OK, "measure",
	        batten_context_error(context));
	require(measures.length_m > 0 && isfinite(measures.length_m), "length", "not above 0");
	require(batten_curve_write(context, curve, 3, path) == BATTEN_OK, "write",
	        batten_context_error(context));
	status = batten_points_read(context, path, &again);
	/* Samples of a loop may fall together, or swing beyond what a file may hold. */
	require(status == BATTEN_OK || status == BATTEN_INPUT, "read back",
	        batten_context_error(context));
	batten_points_destroy(again);
	batten_curve_destroy(curve);
	(void)unlink(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	batten_context_options options;
	batten_context_options_default(&options);
	options.max_memory = (size_t)256 << 20;
	batten_context *context = NULL;
	require(batten_context_create(&options, &context) == BATTEN_OK, "context", "not made");
	batten_points *points = NULL;
	batten_status status = batten_points_parse(context, input_name, (const char *)data, size,
	                                           &points);
	if (status == BATTEN_OK) {
		check_points(points);
		check_round_trip(context, points);
	} else {
		require(points == NULL, "output of a refusal", "not NULL");
		check_message(status, batten_context_error(context));
	}
	batten_points_destroy(points);
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
