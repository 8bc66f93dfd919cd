#include "core/installed.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool find_at(const char *folder, const char *within, const char *name,
                    char path[INSTALLED_PATH_SIZE])
{
	const int length = snprintf(path, INSTALLED_PATH_SIZE, "%s/%s%s", folder, within, name);
	return length > 0 && length < INSTALLED_PATH_SIZE && access(path, R_OK) == 0;
}

/* The folder of a file, as an absolute path; false where it has none. */
static bool folder_of(const char *file, char folder[INSTALLED_PATH_SIZE])
{
	char *path = realpath(file, NULL);
	char *slash = path ? strrchr(path, '/') : NULL;
	const size_t length = slash ? (size_t)(slash - path) : 0;
	const bool good = slash && length < INSTALLED_PATH_SIZE;
	if (good) {
		memcpy(folder, path, length);
		folder[length] = '\0';
	}
	free(path);
	return good;
}

/* Beside a file of the build, or where the installation of that file has it. */
static bool find_beside(const char *file, const char *name, char path[INSTALLED_PATH_SIZE])
{
	static const char *const places[] = { "", "batten/", BATTEN_MODULE_FROM_PROGRAM "/" };
	char folder[INSTALLED_PATH_SIZE];
	bool found = false;
	if (!folder_of(file, folder))
		return false;
	for (size_t i = 0; !found && i < sizeof places / sizeof places[0]; i++)
		found = find_at(folder, places[i], name, path);
	return found;
}

bool installed_find(const char *name, char path[INSTALLED_PATH_SIZE])
{
	static const char here = 0;
	const char *given = getenv("BATTEN_MODULE_PATH");
	if (given && *given)
		return find_at(given, "", name, path);
	Dl_info place;
	if (dladdr(&here, &place) != 0 && place.dli_fname && find_beside(place.dli_fname, name, path))
		return true;
	return find_beside("/proc/self/exe", name, path);
}
