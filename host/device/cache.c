#include "device/cache.h"

#include "device/folder.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

/* A file: the mark, its key, the length of the binary (8 bytes, lowest first), XXH128 of the binary,
 * the binary. */
static const char mark[] = "batten program 1";
enum {
	MARK_SIZE = sizeof mark - 1,
	KEY_AT = MARK_SIZE,
	LENGTH_AT = KEY_AT + 16,
	SUM_AT = LENGTH_AT + 8,
	HEADER_SIZE = SUM_AT + 16,
	BINARY_SIZE_MOST = 256 << 20,
};

static void digest(unsigned char out[16], const void *bytes, size_t length)
{
	XXH128_canonical_t canonical;
	XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes, length));
	memcpy(out, canonical.digest, sizeof canonical.digest);
}

device_cache_key device_cache_key_of(const batten_device *device, const char *source,
                                     const char *options)
{
	const char *parts[] = { batten_version(), source,         options,        device->name,
		                    device->platform, device->driver, device->version };
	enum { PARTS = sizeof parts / sizeof parts[0] };
	unsigned char digests[PARTS][16];
	for (size_t i = 0; i < PARTS; i++)
		digest(digests[i], parts[i], strlen(parts[i]));
	device_cache_key key;
	digest(key.bytes, digests, sizeof digests);
	return key;
}

void device_cache_open(batten_context *context, device_cache *out)
{
	char path[DEVICE_FOLDER_SIZE];
	bool is_private = false;
	const char *given = context->options.cache_directory;
	bool found = false;
	if (given) {
		int length = snprintf(path, sizeof path, "%s", given);
		found = length >= 0 && (size_t)length < sizeof path;
	} else {
		found = device_folder_of_user("batten", path, sizeof path);
	}
	found = found && device_folder_usable(path, 0, false);
	if (!found)
		found = is_private = device_folder_make_private("batten-cache", 0, false, path,
		                                                sizeof path);
	char *copy = found ? batten_copy_text(context, path) : NULL;
	if (is_private && !copy)
		device_folder_remove(path);
	*out = (device_cache){ .folder = copy, .is_private = copy && is_private };
}

void device_cache_close(batten_context *context, device_cache *cache)
{
	if (cache->is_private)
		device_folder_remove(cache->folder);
	batten_release(context, cache->folder);
	*cache = (device_cache){ 0 };
}

static bool path_of(const device_cache *cache, const device_cache_key *key, const char *ending,
                    char *path, size_t size)
{
	if (!cache->folder)
		return false;
	char name[2 * sizeof key->bytes + 1];
	for (size_t i = 0; i < sizeof key->bytes; i++)
		(void)snprintf(name + 2 * i, 3, "%02x", key->bytes[i]);
	int length = snprintf(path, size, "%s/%s.program%s", cache->folder, name, ending);
	return length >= 0 && (size_t)length < size;
}

static void fill_header(unsigned char header[HEADER_SIZE], const device_cache_key *key,
                        const unsigned char *binary, size_t length)
{
	memcpy(header, mark, MARK_SIZE);
	memcpy(header + KEY_AT, key->bytes, sizeof key->bytes);
	for (size_t i = 0; i < 8; i++)
		header[LENGTH_AT + i] = (unsigned char)((uint64_t)length >> (8 * i));
	digest(header + SUM_AT, binary, length);
}

/* Opens what a user may trust to run as code: a plain file of his own (or of root) that nobody else
 * can have written. O_NONBLOCK: a pipe put there does not hang the program. */
static int open_trusted(const char *path, size_t *size)
{
	int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
	if (descriptor < 0)
		return -1;
	struct stat facts;
	if (fstat(descriptor, &facts) == 0 && S_ISREG(facts.st_mode) &&
	    (facts.st_uid == geteuid() || facts.st_uid == 0) && (facts.st_mode & 022) == 0 &&
	    facts.st_size > HEADER_SIZE && facts.st_size <= HEADER_SIZE + BINARY_SIZE_MOST) {
		*size = (size_t)facts.st_size;
		return descriptor;
	}
	(void)close(descriptor);
	return -1;
}

static bool read_all(int descriptor, unsigned char *to, size_t size)
{
	while (size > 0) {
		ssize_t got = read(descriptor, to, size);
		if (got <= 0)
			return false;
		to += got;
		size -= (size_t)got;
	}
	return true;
}

static bool write_all(int descriptor, const unsigned char *from, size_t size)
{
	while (size > 0) {
		ssize_t put = write(descriptor, from, size);
		if (put <= 0)
			return false;
		from += put;
		size -= (size_t)put;
	}
	return true;
}

bool device_cache_load(batten_context *context, const device_cache *cache,
                       const device_cache_key *key, unsigned char **binary, size_t *length)
{
	char path[DEVICE_FOLDER_SIZE];
	size_t size = 0;
	if (!path_of(cache, key, "", path, sizeof path))
		return false;
	int descriptor = open_trusted(path, &size);
	if (descriptor < 0)
		return false;
	size_t rest = size - HEADER_SIZE;
	unsigned char found[HEADER_SIZE];
	unsigned char expected[HEADER_SIZE];
	unsigned char *bytes = batten_allocate(context, rest, 1);
	bool good = bytes && read_all(descriptor, found, sizeof found) &&
	            read_all(descriptor, bytes, rest);
	(void)close(descriptor);
	if (good) {
		fill_header(expected, key, bytes, rest);
		good = memcmp(found, expected, sizeof found) == 0;
	}
	if (!good) {
		batten_release(context, bytes);
		return false;
	}
	*binary = bytes;
	*length = rest;
	return true;
}

void device_cache_store(const device_cache *cache, const device_cache_key *key,
                        const unsigned char *binary, size_t length)
{
	char path[DEVICE_FOLDER_SIZE];
	char temporary[DEVICE_FOLDER_SIZE];
	if (length == 0 || length > BINARY_SIZE_MOST || !path_of(cache, key, "", path, sizeof path) ||
	    !path_of(cache, key, ".XXXXXX", temporary, sizeof temporary))
		return;
	int descriptor = mkstemp(temporary);
	if (descriptor < 0)
		return;
	unsigned char header[HEADER_SIZE];
	fill_header(header, key, binary, length);
	bool good = write_all(descriptor, header, sizeof header) &&
	            write_all(descriptor, binary, length);
	/* No fsync: a file a power cut leaves incomplete fails its checksum and is built again. */
	good = close(descriptor) == 0 && good;
	if (!good || rename(temporary, path) != 0)
		(void)unlink(temporary);
}
