#include "device/folder.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

static bool is_folder(const char *path)
{
	struct stat facts;
	return stat(path, &facts) == 0 && S_ISDIR(facts.st_mode);
}

/* Mode 0700 as the XDG base directory specification asks for. */
static bool make_folders(const char *path)
{
	char copy[DEVICE_FOLDER_SIZE];
	size_t length = strlen(path);
	if (length == 0 || length >= sizeof copy)
		return false;
	memcpy(copy, path, length + 1);
	for (char *end = copy + 1;; end++) {
		if (*end != '/' && *end != '\0')
			continue;
		char kept = *end;
		*end = '\0';
		if (mkdir(copy, 0700) != 0 && !is_folder(copy))
			return false;
		*end = kept;
		if (kept == '\0')
			return true;
	}
}

static bool has_room(const char *path, size_t room, bool code)
{
	struct statvfs facts;
	if (statvfs(path, &facts) != 0)
		return false;
	if (code && (facts.f_flag & ST_NOEXEC))
		return false;
	unsigned long unit = facts.f_frsize ? facts.f_frsize : 1;
	return room == 0 || facts.f_bavail >= room / unit + 1;
}

bool device_folder_usable(const char *path, size_t room, bool code)
{
	char trial[DEVICE_FOLDER_SIZE];
	int length = snprintf(trial, sizeof trial, "%s/batten.XXXXXX", path);
	if (length < 0 || (size_t)length >= sizeof trial)
		return false;
	if (!make_folders(path) || !has_room(path, room, code))
		return false;
	int descriptor = mkstemp(trial);
	if (descriptor < 0)
		return false;
	(void)close(descriptor);
	return unlink(trial) == 0;
}

bool device_folder_of_user(const char *name, char *path, size_t size)
{
	/* A relative path in XDG_CACHE_HOME is to be ignored, says the specification. */
	const char *cache = getenv("XDG_CACHE_HOME");
	const char *home = getenv("HOME");
	int length = -1;
	if (cache && cache[0] == '/')
		length = snprintf(path, size, "%s/%s", cache, name);
	else if (home && home[0] == '/')
		length = snprintf(path, size, "%s/.cache/%s", home, name);
	return length >= 0 && (size_t)length < size;
}

bool device_folder_make_private(const char *name, size_t room, bool code, char *path, size_t size)
{
	const char *above[] = { getenv("TMPDIR"), "/tmp", "/var/tmp" };
	for (size_t i = 0; i < sizeof above / sizeof above[0]; i++) {
		if (!above[i] || above[i][0] != '/')
			continue;
		int length = snprintf(path, size, "%s/%s.XXXXXX", above[i], name);
		if (length < 0 || (size_t)length >= size || !mkdtemp(path))
			continue;
		if (device_folder_usable(path, room, code))
			return true;
		(void)rmdir(path);
	}
	return false;
}

static int remove_entry(const char *path, const struct stat *facts, int kind, struct FTW *place)
{
	(void)facts;
	(void)kind;
	(void)place;
	(void)remove(path);
	return 0;
}

void device_folder_remove(const char *path)
{
	(void)nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
}
