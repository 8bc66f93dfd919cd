/* Compiled programs kept on disk: found again, and built again when anything is wrong with them. */
#include "support/cases.h"
#include "unit/device_fixture.h"

#include <fcntl.h>
#include <sys/stat.h>

/* Programs of PoCL are not stored, so for tests of the cache PoCL goes by another name. */
static void disguise(batten_context *context)
{
	assert_true(device_count(context, NULL) >= 1);
	(void)strcpy(context->devices->entries[0].facts.platform, "test");
}

/* In a context of its own, as the next process would. */
static bool runs_anew(const char *cache, const char *text, bool *from_cache)
{
	batten_context *context = make_context(cache, 0);
	device_session *session = NULL;
	if (context)
		disguise(context);
	bool good = context && device_session_open(context, 0, &session) == BATTEN_OK &&
	            runs(session, text, 3.25, from_cache);
	device_session_close(session);
	good = good && device_live_objects(context) == 0;
	batten_context_destroy(context);
	return good;
}

static char *program_file(const char *folder)
{
	DIR *stream = opendir(folder);
	assert_non_null(stream);
	char *path = NULL;
	for (struct dirent *entry = readdir(stream); entry; entry = readdir(stream))
		if (strstr(entry->d_name, ".program")) {
			assert_null(path);
			path = text_of("%s/%s", folder, entry->d_name);
		}
	assert_int_equal(closedir(stream), 0);
	assert_non_null(path);
	return path;
}

static void change_byte(const char *path, off_t offset)
{
	int descriptor = open(path, O_RDWR);
	unsigned char byte = 0;
	assert_true(descriptor >= 0);
	assert_int_equal(pread(descriptor, &byte, 1, offset), 1);
	byte ^= 0x10;
	assert_int_equal(pwrite(descriptor, &byte, 1, offset), 1);
	assert_int_equal(close(descriptor), 0);
}

/* Damaged, so rebuilt with the right result; then whole again. */
static void assert_rebuilt(const char *cache)
{
	bool from_cache = true;
	assert_true(runs_anew(cache, source, &from_cache));
	assert_false(from_cache);
	assert_true(runs_anew(cache, source, &from_cache));
	assert_true(from_cache);
	assert_int_equal(count_entries(cache), 1); /* no temporary left */
}

static void test_cache_hit_and_miss(void **state)
{
	place *here = *state;
	char *cache = text_of("%s/hit/deep", here->folder);
	bool from_cache = true;
	assert_true(runs_anew(cache, source, &from_cache));
	assert_false(from_cache);
	assert_true(runs_anew(cache, source, &from_cache));
	assert_true(from_cache);
	batten_context *context = make_context(cache, 0);
	device_session *session = NULL;
	device_program *program = NULL;
	disguise(context);
	assert_int_equal(device_session_open(context, 0, &session), BATTEN_OK);
	assert_int_equal(
		device_program_build(session, "add", source, "-DOTHER=1", &program, &from_cache, NULL),
		BATTEN_OK);
	assert_false(from_cache);
	device_program_destroy(program);
	program = NULL;
	char *changed = text_of("%s\n", source);
	assert_int_equal(
		device_program_build(session, "add", changed, NULL, &program, &from_cache, NULL),
		BATTEN_OK);
	assert_false(from_cache);
	assert_int_equal(count_entries(cache), 3);
	device_program_destroy(program);
	device_session_close(session);
	batten_context_destroy(context);
	free(changed);
	free(cache);
}

static void test_cache_files(void **state)
{
	place *here = *state;
	char *folder = text_of("%s/files", here->folder);
	batten_context *context = make_context(folder, 0);
	batten_device facts = { .name = "device", .driver = "1" };
	unsigned char bytes[3000];
	unsigned char *binary = NULL;
	size_t length = 0;
	for (size_t i = 0; i < sizeof bytes; i++)
		bytes[i] = (unsigned char)(i * 7);
	device_cache cache = { 0 };
	device_cache_key key = device_cache_key_of(&facts, "source", "options");
	device_cache_store(&cache, &key, bytes, sizeof bytes); /* no folder: nothing happens */
	assert_false(device_cache_load(context, &cache, &key, &binary, &length));
	device_cache_open(context, &cache);
	assert_string_equal(cache.folder, folder);
	assert_false(device_cache_load(context, &cache, &key, &binary, &length));
	device_cache_store(&cache, &key, bytes, 0);
	assert_int_equal(count_entries(folder), 0);
	device_cache_store(&cache, &key, bytes, sizeof bytes);
	assert_true(device_cache_load(context, &cache, &key, &binary, &length));
	assert_int_equal(length, sizeof bytes);
	assert_memory_equal(binary, bytes, sizeof bytes);
	batten_release(context, binary);
	/* Everything that goes in makes another key; no text slides into its neighbour. */
	device_cache_key keys[8] = { key };
	keys[1] = device_cache_key_of(&facts, "sourceo", "ptions");
	keys[2] = device_cache_key_of(&facts, "options", "source");
	batten_device other = { .name = "device", .driver = "2" };
	keys[3] = device_cache_key_of(&other, "source", "options");
	other = (batten_device){ .name = "device1", .driver = "" };
	keys[4] = device_cache_key_of(&other, "source", "options");
	other = (batten_device){ .name = "device", .driver = "1", .platform = "p" };
	keys[5] = device_cache_key_of(&other, "source", "options");
	other = (batten_device){ .name = "device", .driver = "1", .version = "p" };
	keys[6] = device_cache_key_of(&other, "source", "options");
	keys[7] = device_cache_key_of(&facts, "", "");
	for (size_t i = 0; i < 8; i++)
		for (size_t j = 0; j < i; j++)
			assert_memory_not_equal(&keys[i], &keys[j], sizeof key);
	assert_false(device_cache_load(context, &cache, &keys[1], &binary, &length));
	device_cache_close(context, &cache);
	batten_context_destroy(context);
	free(folder);
}

/* Asking PoCL for a binary takes up to a minute (host/device/program.c), so nobody does. */
static void test_pocl_programs_are_not_stored(void **state)
{
	place *here = *state;
	char *cache = text_of("%s/pocl-programs", here->folder);
	batten_context *context = make_context(cache, 0);
	device_session *session = NULL;
	batten_device facts;
	assert_int_equal(batten_device_describe(context, 0, &facts), BATTEN_OK);
	bool is_pocl = strcmp(facts.platform, "Portable Computing Language") == 0;
	assert_int_equal(device_session_open(context, 0, &session), BATTEN_OK);
	assert_true(runs(session, source, 1.0, NULL));
	assert_int_equal(count_entries(cache), is_pocl ? 0 : 1);
	device_session_close(session);
	batten_context_destroy(context);
	free(cache);
}

static void test_cache_damage(void **state)
{
	place *here = *state;
	char *cache = text_of("%s/damage", here->folder);
	assert_true(runs_anew(cache, source, NULL));
	char *path = program_file(cache);
	struct stat facts;
	assert_int_equal(stat(path, &facts), 0);
	const off_t lengths[] = { 0, 1, 16, 55, 56, 57, facts.st_size / 2, facts.st_size - 1 };
	for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i += CASES(1, 3)) {
		assert_int_equal(truncate(path, lengths[i]), 0);
		assert_rebuilt(cache);
	}
	const off_t places[] = { 0, 16, 32, 39, 40, 56, facts.st_size / 2, facts.st_size - 1 };
	for (size_t i = 0; i < sizeof places / sizeof places[0]; i += CASES(1, 3)) {
		change_byte(path, places[i]);
		assert_rebuilt(cache);
	}
	assert_int_equal(truncate(path, facts.st_size + 1), 0);
	assert_rebuilt(cache);
	free(path);
	free(cache);
}

static void test_cache_foreign(void **state)
{
	place *here = *state;
	char *cache = text_of("%s/foreign", here->folder);
	char *second = text_of("%s/second", here->folder);
	char *other = text_of("%s#define UNUSED\n", source);
	char *elsewhere = text_of("%s/elsewhere", here->folder);
	assert_true(runs_anew(cache, source, NULL));
	assert_true(runs_anew(second, other, NULL));
	char *path = program_file(cache);
	char *foreign = program_file(second);
	assert_int_equal(rename(foreign, path), 0); /* another program's file */
	assert_rebuilt(cache);
	assert_int_equal(rename(path, elsewhere), 0); /* a link, even to the right file */
	assert_int_equal(symlink(elsewhere, path), 0);
	assert_rebuilt(cache);
	assert_int_equal(unlink(path), 0); /* nobody writes to it: reading must not wait */
	assert_int_equal(mkfifo(path, 0600), 0);
	assert_rebuilt(cache);
	assert_int_equal(chmod(path, 0666), 0); /* anyone may have written it */
	assert_rebuilt(cache);
	if (geteuid() == 0) {
		assert_int_equal(chown(path, 12345, (gid_t)-1), 0);
		assert_rebuilt(cache);
	}
	assert_int_equal(unlink(path), 0); /* cannot be replaced: still no error */
	assert_int_equal(mkdir(path, 0700), 0);
	bool from_cache = true;
	assert_true(runs_anew(cache, source, &from_cache));
	assert_false(from_cache);
	assert_int_equal(count_entries(cache), 1);
	free(foreign);
	free(path);
	free(elsewhere);
	free(other);
	free(second);
	free(cache);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_cache_files),
		cmocka_unit_test(test_cache_hit_and_miss),
		cmocka_unit_test(test_cache_damage),
		cmocka_unit_test(test_cache_foreign),
		cmocka_unit_test(test_pocl_programs_are_not_stored),
	};
	return cmocka_run_group_tests(tests, make_place, remove_place);
}
