#include "core/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

batten_status batten_file_read(batten_context *context, const char *path, size_t limit, char **text,
                               size_t *length)
{
	FILE *stream = fopen(path, "rb");
	if (!stream)
		return batten_fail(context, BATTEN_IO, "%s: cannot be read: %s", path, strerror(errno));
	struct stat facts;
	if (fstat(fileno(stream), &facts) == 0 && S_ISDIR(facts.st_mode)) {
		(void)fclose(stream);
		return batten_fail(context, BATTEN_IO, "%s: is a folder, a file was expected", path);
	}
	batten_status status = BATTEN_OK;
	size_t capacity = 65536;
	size_t used = 0;
	char *buffer = batten_allocate(context, capacity + 1, 1);
	if (!buffer)
		status = BATTEN_MEMORY;
	while (status == BATTEN_OK) {
		used += fread(buffer + used, 1, capacity - used, stream);
		if (used < capacity)
			break;
		if (used > limit) {
			status = batten_fail(context, BATTEN_INPUT, "%s: longer than %zu bytes", path, limit);
			break;
		}
		char *larger = batten_allocate(context, 2 * capacity + 1, 1);
		if (!larger) {
			status = BATTEN_MEMORY;
			break;
		}
		memcpy(larger, buffer, used);
		batten_release(context, buffer);
		buffer = larger;
		capacity *= 2;
	}
	if (status == BATTEN_OK && ferror(stream))
		status = batten_fail(context, BATTEN_IO, "%s: cannot be read: %s", path, strerror(errno));
	if (status == BATTEN_OK && used > limit)
		status = batten_fail(context, BATTEN_INPUT, "%s: longer than %zu bytes", path, limit);
	(void)fclose(stream);
	if (status != BATTEN_OK) {
		batten_release(context, buffer);
		return status;
	}
	buffer[used] = '\0';
	*text = buffer;
	*length = used;
	return BATTEN_OK;
}

batten_status batten_file_open(batten_context *context, const char *path, batten_file *out)
{
	batten_file file = { 0 };
	size_t size = strlen(path) + sizeof ".XXXXXX";
	file.path = batten_copy_text(context, path);
	file.temporary = batten_allocate(context, size, 1);
	if (!file.path || !file.temporary) {
		batten_file_abandon(context, &file);
		return BATTEN_MEMORY;
	}
	/* A rename would put a plain file in the place of a device or a pipe. */
	struct stat facts;
	if (stat(path, &facts) == 0 && !S_ISREG(facts.st_mode)) {
		batten_file_abandon(context, &file);
		return batten_fail(context, BATTEN_IO, "%s: is %s, a file was expected", path,
		                   S_ISDIR(facts.st_mode) ? "a folder" : "no plain file");
	}
	(void)snprintf(file.temporary, size, "%s.XXXXXX", path);
	int descriptor = mkstemp(file.temporary);
	if (descriptor < 0) {
		int cause = errno;
		batten_release(context, file.temporary);
		file.temporary = NULL;
		batten_file_abandon(context, &file);
		return batten_fail(context, BATTEN_IO, "%s: cannot be written: %s", path, strerror(cause));
	}
	mode_t mask = umask(0);
	(void)umask(mask);
	(void)fchmod(descriptor, 0666 & ~mask);
	file.stream = fdopen(descriptor, "wb");
	if (!file.stream) {
		(void)close(descriptor);
		batten_file_abandon(context, &file);
		return batten_fail(context, BATTEN_IO, "%s: cannot be written: %s", path, strerror(errno));
	}
	*out = file;
	return BATTEN_OK;
}

batten_status batten_file_commit(batten_context *context, batten_file *file)
{
	bool good = !ferror(file->stream);
	good = fflush(file->stream) == 0 && good;
	good = fsync(fileno(file->stream)) == 0 && good;
	good = fclose(file->stream) == 0 && good;
	file->stream = NULL;
	good = good && rename(file->temporary, file->path) == 0;
	if (!good) {
		batten_status status = batten_fail(context, BATTEN_IO, "%s: cannot be written: %s",
		                                   file->path, errno ? strerror(errno) : "write failed");
		batten_file_abandon(context, file);
		return status;
	}
	batten_release(context, file->temporary);
	batten_release(context, file->path);
	*file = (batten_file){ 0 };
	return BATTEN_OK;
}

void batten_file_abandon(batten_context *context, batten_file *file)
{
	if (file->stream)
		(void)fclose(file->stream);
	if (file->temporary)
		(void)unlink(file->temporary);
	batten_release(context, file->temporary);
	batten_release(context, file->path);
	*file = (batten_file){ 0 };
}
