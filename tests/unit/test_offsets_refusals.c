/* The offsets file: what is taken, what is refused and with which message. */
#include "offsets_fixture.h"

#define HEADER "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n"
#define GRID HEADER "# layout: grid\n"
#define LONG HEADER "# layout: long\n"

static void spreadsheet_habits(void **state)
{
	static const char text[] =
		"\xEF\xBB\xBF# a comment: first\r\n"
		"#lbp :2,,,\r\n# draft: 1\r\n# layout: grid,\r\n# frame:ap-fwd\r\n# unit: m\r\n"
		"\r\n# name: with , comma ,,\r\n# batten-offsets: 1\r\n"
		"z\\x , 0 , 1 ,,\r\n,,,,\r\n 0 , 1e0 ,\t.5 ,,\r\n# between\r\n\r\n1., +2,,,\r\n"
		"profile,keel,0,0,0,,,,\r\n";
	batten_hull *hull = parse(*state, text, sizeof text - 1);
	assert_string_equal(hull->name, "with , comma");
	assert_int_equal(hull->station_count, 2);
	assert_memory_equal(hull->y_m, ((double[]){ 1, 0.5, 2, 0 }), 4 * sizeof(double));
	assert_int_equal(hull->nodes[3], BATTEN_NODE_OUTSIDE);
	assert_int_equal(hull->profile_count, 1);
	batten_hull_destroy(hull);
	/* The last line needs no end. */
	static const char open[] = GRID "z\\x,0,1\n0,0,0\n1,1,1\n2,1,?";
	hull = parse(*state, open, sizeof open - 1);
	assert_int_equal(hull->nodes[5], BATTEN_NODE_UNKNOWN);
	batten_hull_destroy(hull);
}

struct refusal {
	const char *text;
	const char *place; /* line and column */
	const char *says;
};

static void refuse(const struct fixture *fixture, const char *text, size_t length,
                   const char *place, const char *says)
{
	batten_hull *hull = (batten_hull *)fixture->folder;
	batten_status status = batten_hull_parse(fixture->context, "in.csv", text, length, &hull);
	const char *error = batten_context_error(fixture->context);
	char prefix[64];
	(void)snprintf(prefix, sizeof prefix, "in.csv:%s: ", place);
	if (status != BATTEN_INPUT || strncmp(error, prefix, strlen(prefix)) != 0 ||
	    !strstr(error, says) || !strstr(error, "expected") || strchr(error, '\n'))
		fail_msg("status %d '%s', expected '%s...%s'", (int)status, error, prefix, says);
	assert_null(hull);
}

static void refuse_all(const struct fixture *fixture, const struct refusal *refusals, size_t count)
{
	for (size_t i = 0; i < count; i++)
		refuse(fixture, refusals[i].text, strlen(refusals[i].text), refusals[i].place,
		       refusals[i].says);
}

static void wrong_headers(void **state)
{
	static const struct refusal refusals[] = {
		{ "", "1:1", "empty file" },
		{ "\xEF\xBB\xBF", "1:1", "empty file" },
		{ "z\\x,0,1\n", "1:1", "no key 'batten-offsets'" },
		{ "# only a comment\n", "2:1", "no key 'batten-offsets'" },
		{ "# batten-offsets: 1\n# unit: m\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'name'" },
		{ "# batten-offsets: 1\n# name: n\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'unit'" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# lbp: 2\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'frame'" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# draft: 1\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'lbp'" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2\n# layout: grid\n"
		  "z\\x,0,1\n",
		  "7:1", "no key 'draft'" },
		{ HEADER "z\\x,0,1\n", "7:1", "no key 'layout'" },
		{ GRID, "8:1", "z\\x" },
		{ HEADER "# unit: mm\n", "7:1", "found the key 'unit' again" },
		{ "# batten-offsets: 2\n" GRID, "2:1", "'batten-offsets' again" },
		{ "# batten-offsets: 2\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "1:19", "found '2', expected the version 1" },
		{ "# batten-offsets: 1\n# name: n\n# unit: cm\n# frame: ghs\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "3:9", "found 'cm', expected a unit: m, mm or ft" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: stern\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "4:10", "found 'stern', expected a frame" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2,54\n# draft: 1\n"
		  "# layout: grid\n",
		  "5:8", "found '2,54', expected a length above 0, written with a decimal point" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2\n# draft: 0\n"
		  "# layout: grid\n",
		  "6:10", "found '0', expected a length above 0" },
		{ "# batten-offsets: 1\n# name: n\n# unit: m\n# frame: ghs\n# lbp: 2e9\n# draft: 1\n"
		  "# layout: grid\n",
		  "5:8", "found '2e9'" },
		{ HEADER "# layout: table\n", "7:11", "found 'table', expected a layout: grid or long" },
		{ GRID "# depth: -1\n", "8:10", "found '-1'" },
		{ GRID "# depth:\n", "8:9", "found an empty cell" },
		{ "# batten-offsets: 1\n# name: ,,\n# unit: m\n# frame: ghs\n# lbp: 2\n# draft: 1\n"
		  "# layout: grid\n",
		  "2:9", "found no name" },
		{ GRID "z\\x,0,1\n# unit: mm\n0,0,0\n1,1,1\n", "9:1", "after the table began" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
}

static void wrong_grids(void **state)
{
	static const struct refusal refusals[] = {
		{ GRID "z,0,1\n", "8:1", "found 'z', expected 'z\\x'" },
		{ GRID "z\\x;0;1\n", "8:1", "found 'z\\x;0;1'" },
		{ GRID "\"z\\x\",0,1\n", "8:1", "found '\"z\\x\"'" },
		{ GRID "z\\x,0\n0,1\n1,1\n", "8:1", "found 1 station," },
		{ GRID "z\\x\n", "8:1", "found 0 stations" },
		{ GRID "z\\x,0,1\n0,0,0\n", "9:1", "found 1 waterline " },
		{ GRID "z\\x,0,1\n", "8:1", "found 0 waterlines" },
		{ GRID "z\\x,0,1,1\n", "8:9", "found '1', expected each x once" },
		{ GRID "z\\x,0,2,1.5\n", "8:9", "found '1.5', expected x in ascending order, beyond 2" },
		{ GRID "z\\x,0,1,1.0000000000001\n", "8:9", "expected x at least 1e-09 m beyond 1" },
		{ GRID "z\\x,0,1e7\n", "8:7", "found '1e7', expected x within 1e+06 m" },
		{ GRID "z\\x,0,,1\n", "8:8", "found '1', expected the end of the row" },
		{ GRID "z\\x,0,one\n", "8:7", "found 'one', expected a number for x" },
		{ GRID "z\\x,0,1\n0,0,0\n0,1,1\n", "10:1", "found '0', expected each z once" },
		{ GRID "z\\x,0,1\n1,0,0\n 0,1,1\n", "10:2", "found '0', expected z in ascending order" },
		{ GRID "z\\x,0,1\n,0,0\n", "9:1", "found an empty cell, expected a number for z" },
		{ GRID "z\\x,0,1\n?,0,0\n", "9:1", "found '?', expected a number for z" },
		{ GRID "z\\x,0,1\n0,0\n", "9:4", "found 2 cells, expected 3" },
		{ GRID "z\\x,0,1\n0,0,0\n1,0,5,1\n", "10:7", "found 4 cells, expected 3" },
		{ GRID "z\\x,0,1\n0,0,0,\n", "9:7", "found 4 cells, expected 3" },
		{ GRID "z\\x,0,1,\n0,0,0,1\n", "9:7", "found '1', expected the end of the row" },
		{ GRID "z\\x,0,1\n0,0,-0.5\n", "9:5",
		  "found '-0.5', expected a half-breadth of 0 or more" },
		{ GRID "z\\x,0,1\n0,nan,1\n", "9:3", "found 'nan', expected a half-breadth" },
		{ GRID "z\\x,0,1\n0,0,inf\n", "9:5", "found 'inf', expected a half-breadth" },
		{ GRID "z\\x,0,1\n0,0,1e999\n", "9:5", "found '1e999', expected a half-breadth" },
		{ GRID "z\\x,0,1\n0,0,0x10\n", "9:5", "found '0x10'" },
		{ GRID "z\\x,0,1\n0,0,1 2\n", "9:5", "found '1 2'" },
		{ GRID "z\\x,0,1\n0,0,1;5\n", "9:5", "found '1;5'" },
		{ GRID "z\\x,0,1\n0,0,??\n", "9:5", "found '?\?'" },
		{ GRID "z\\x,0,1\n0,0,12345678901234567890123456789012345678\xC3\xBCxyz\n", "9:5",
		  "found '12345678901234567890123456789012345678\xC3\xBC...', expected" },
		{ GRID "z\\x,0,1\n0,0,1234567890123456789012345678901234567\xE2\x82\xACxyz\n", "9:5",
		  "found '1234567890123456789012345678901234567\xE2\x82\xAC...', expected" },
		{ GRID "z\\x,0,1\n0,0,123456789012345678901234567890123456789\xC3\xBCxyz\n", "9:5",
		  "found '123456789012345678901234567890123456789...', expected" },
		{ GRID "z\\x,0,1,2\n0,0,?,1\n1,,?,1\n2,,?,\n", "10:4",
		  "found '?', expected two given half-breadths" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
}

static void wrong_lists_and_extras(void **state)
{
#define LIST LONG "waterline,z,x,y\n1,0,0,0\n1,0,1,1\n1,0,2,1\n"
#define TABLE GRID "z\\x,0,1\n0,0,1\n1,1,1\n"
	static const struct refusal refusals[] = {
		{ LONG "buttock,y,x,z\n", "8:1", "found 'buttock', expected the row 'waterline,z,x,y'" },
		{ LONG "waterline,x,z,y\n", "8:11", "found 'x', expected 'z'" },
		{ LONG "station,x,z\n", "8:12", "found the end of the row, expected 'y'" },
		{ LONG "station,x,z,y,d\n", "8:15", "found 'd', expected the end of the row" },
		{ LIST, "11:1", "found 1 line " },
		{ LIST "1,0,2,1\n", "12:5", "found '2', expected each x once" },
		{ LIST "1,0,1.5,1\n", "12:5", "found '1.5', expected x in ascending order" },
		{ LIST "2,0,3,1\n", "12:1", "found '2', expected the label of the row before" },
		{ LIST "1,1,0,1\n", "12:1", "found '1', expected another label" },
		{ LIST "2,-1,0,1\n", "12:3", "found '-1', expected z in ascending order" },
		{ LIST "2,1,0,\n", "12:7", "found an empty cell, expected a half-breadth" },
		{ LIST "2,1,0,-1\n", "12:7", "found '-1'" },
		{ LIST "2,1,0\n", "12:6", "found 3 cells, expected 4" },
		{ LIST "2,1,0,0,5\n", "12:9", "found 5 cells, expected 4" },
		{ LIST " #2,1,0,0\n", "12:2", "found '#2', expected a label" },
		{ LIST "2,1,0,0\n2,1,0.5,?\n2,1,1,0\n", "13:9", "found '?' where no other line" },
		{ LIST "2,1,0,0\n2,1,0.5,1\n", "13:1", "found 1 values of x that two lines or more share" },
		{ LONG "waterline,z,x,y\n1,0,0,0\n1,0,1,?\n2,1,0,0\n2,1,1,?\n", "10:7",
		  "found '?', expected two given half-breadths" },
		{ LONG "station,x,z,y\n1,0,0,0\n1,0,1,0\n2,1,0,0\n2,1,1,0\n3,2,1.0000000000001,0\n"
		       "4,3,1.0000000000001,0\n",
		  "13:1", "on another line" },
		{ TABLE "2,1\n", "11:4", "found 2 cells" },
		{ TABLE "profile,bow,0,0,0\n", "11:9", "found 'bow', expected stem, stern, keel or deck" },
		{ TABLE "profile,stem,0,0\n", "11:17", "found the end of the row" },
		{ TABLE "profile,stem,0,-1,0\n", "11:16", "found '-1'" },
		{ TABLE "profile,stem,0,?,0\n", "11:16", "found '?'" },
		{ TABLE "profile,stem,a,0,0\n", "11:14", "found 'a', expected a number for x" },
		{ TABLE "profile,stem,0,0,0,0\n", "11:20", "found '0', expected the end of the row" },
		{ TABLE "knuckle,buttock,0,0\n", "11:9", "found 'buttock', expected station or waterline" },
		{ TABLE "knuckle,station,0.5,0\n", "11:17",
		  "found '0.5', expected a station of the table" },
		{ TABLE "knuckle,waterline,0.5,3\n", "11:23", "found '3', expected a waterline of the" },
		{ TABLE "knuckle,station,0,0,1\n", "11:21", "found '1', expected the end of the row" },
		{ TABLE "knuckle,station,0,0\n2,1,1\n", "12:1", "found '2', expected profile or knuckle" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
#undef LIST
#undef TABLE
}

static void no_text(void **state)
{
	static const struct refusal refusals[] = {
		{ GRID "z\\x,0,1\n0,0,\x01\n", "9:5", "found the byte 0x01, expected a text file" },
		{ GRID "z\\x,0,1\n0,0,\xFF\n", "9:5", "found the byte 0xff" },
		{ GRID "z\\x,0,1\r0,0,0\r", "8:8", "found the byte 0x0d" },
		{ "\xFF\xFE#", "1:1", "found the byte 0xff" },
		{ "\x7F"
		  "ELF",
		  "1:1", "found the byte 0x7f" },
	};
	refuse_all(*state, refusals, sizeof refusals / sizeof *refusals);
	static const char zero[] = "# batten-offsets: 1\n# na\0me: n\n";
	refuse(*state, zero, sizeof zero - 1, "2:5", "found the byte 0x00");
}

/* ------------------------------------------------------------------------------------------------
 * Size
 * --------------------------------------------------------------------------------------------- */

/* Text that grows, for rows too long for a literal. */
struct heap_text {
	char *text;
	size_t length, capacity;
};

static void append(struct heap_text *to, const char *text)
{
	size_t length = strlen(text);
	if (to->length + length + 1 > to->capacity) {
		to->capacity = 2 * (to->capacity + length + 1);
		to->text = realloc(to->text, to->capacity);
		assert_non_null(to->text);
	}
	memcpy(to->text + to->length, text, length + 1);
	to->length += length;
}

static void append_numbers(struct heap_text *to, size_t count, const char *format)
{
	char number[64];
	for (size_t i = 0; i < count; i++) {
		(void)snprintf(number, sizeof number, format, i);
		append(to, number);
	}
}

static void limits(void **state)
{
	const struct fixture *fixture = *state;
	struct heap_text text = { 0 };
	append(&text, GRID "z\\x");
	append_numbers(&text, 4096, ",%zu");
	size_t most = text.length;
	append(&text, ",4096\n");
	refuse(fixture, text.text, text.length, "8:19375",
	       "found '4096', expected at most 4096 station");
	text.length = most;
	append_numbers(&text, 1000000, ",9");
	append(&text, "\n");
	refuse(fixture, text.text, text.length, "8:19375", "expected at most 4096 stations");
	/* The widest table there may be, and a row of it that is too long. */
	text.length = most;
	append(&text, "\n0");
	append_numbers(&text, 4096, ",0");
	append(&text, "\n1");
	append_numbers(&text, 4096, ",1");
	size_t whole = text.length;
	batten_hull *hull = parse(fixture, text.text, text.length);
	assert_int_equal(hull->station_count, 4096);
	batten_hull_destroy(hull);
	append_numbers(&text, 1000000, ",1");
	refuse(fixture, text.text, text.length, "10:8195", "found 1004097 cells, expected 4097");
	assert_true(whole > 0);
	text.length = 0;
	append(&text, GRID "z\\x,0,1\n");
	append_numbers(&text, 4096, "%zu,0,1\n");
	hull = parse(fixture, text.text, text.length);
	assert_int_equal(hull->waterline_count, 4096);
	batten_hull_destroy(hull);
	append(&text, "4096,0,1\n");
	refuse(fixture, text.text, text.length, "4105:1", "expected at most 4096 waterlines");
	text.length = 0;
	append(&text, LONG "station,x,z,y\n");
	append_numbers(&text, 4097, ",%zu,0,0\n");
	refuse(fixture, text.text, text.length, "4105:2", "expected at most 4096 stations");
	text.length = 0;
	append(&text, LONG "station,x,z,y\n");
	append_numbers(&text, 4097, ",0,%zu,0\n");
	refuse(fixture, text.text, text.length, "4105:4", "expected at most 4096 points on a line");
	text.length = 0;
	append(&text, GRID "z\\x,0,1\n0,0,0\n1,0,1\n");
	append_numbers(&text, 4097, "profile,deck,%zu,1,1\n");
	refuse(fixture, text.text, text.length, "4107:1", "expected at most 4096 such rows");
	text.length = 0;
	append(&text, "# batten-offsets: 1\n# name: ");
	append_numbers(&text, 4001, "n");
	append(&text, "\n# unit: m\n# frame: ap-fwd\n# lbp: 2\n# draft: 1\n# layout: grid\n");
	refuse(fixture, text.text, text.length, "2:9", "found a text of 4001 bytes");
	free(text.text);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(spreadsheet_habits, begin, end),
		cmocka_unit_test_setup_teardown(wrong_headers, begin, end),
		cmocka_unit_test_setup_teardown(wrong_grids, begin, end),
		cmocka_unit_test_setup_teardown(wrong_lists_and_extras, begin, end),
		cmocka_unit_test_setup_teardown(no_text, begin, end),
		cmocka_unit_test_setup_teardown(limits, begin, end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
