#include "exchange/module.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 4096 };

#define MODULE_NAME "batten_opencascade.so"

static const exchange_module *open_at(const char *folder, const char *within)
{
	char path[PATH_SIZE];
	const int length = snprintf(path, sizeof path, "%s/%s" MODULE_NAME, folder, within);
	if (length < 0 || (size_t)length >= sizeof path || access(path, R_OK) != 0)
		return NULL;
	void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
	if (!module)
		return NULL;
	const exchange_module *(*get)(void) = NULL;
	void *symbol = dlsym(module, "exchange_module_get");
	/* ISO C knows no way from an object pointer to a function pointer; POSIX promises that the bytes
	 * are the same. */
	memcpy(&get, &symbol, sizeof get);
	const exchange_module *found = get ? get() : NULL;
	return found && found->version == EXCHANGE_VERSION ? found : NULL;
}

/* The folder of a file, as an absolute path; false where it has none. */
static bool folder_of(const char *file, char folder[PATH_SIZE])
{
	char *path = realpath(file, NULL);
	char *slash = path ? strrchr(path, '/') : NULL;
	const size_t length = slash ? (size_t)(slash - path) : 0;
	const bool good = slash && length < PATH_SIZE;
	if (good) {
		memcpy(folder, path, length);
		folder[length] = '\0';
	}
	free(path);
	return good;
}

/* Beside a file of the build, or where the installation of that file has it. */
static const exchange_module *open_beside(const char *file)
{
	static const char *const places[] = { "", "batten/", BATTEN_MODULE_FROM_PROGRAM "/" };
	char folder[PATH_SIZE];
	const exchange_module *found = NULL;
	if (!folder_of(file, folder))
		return NULL;
	for (size_t i = 0; !found && i < sizeof places / sizeof places[0]; i++)
		found = open_at(folder, places[i]);
	return found;
}

const exchange_module *exchange_module_open(void)
{
	static const char here = 0;
	const char *given = getenv("BATTEN_MODULE_PATH");
	if (given && *given)
		return open_at(given, "");
	Dl_info place;
	const exchange_module *found = NULL;
	if (dladdr(&here, &place) != 0 && place.dli_fname)
		found = open_beside(place.dli_fname);
	return found ? found : open_beside("/proc/self/exe");
}
