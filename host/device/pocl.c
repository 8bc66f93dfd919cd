#include "device/pocl.h"

#include "device/folder.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* PoCL 3.1 ends the process, without any code returned, when its cache folder
 *   - cannot be made (SIGSEGV),
 *   - has a long path (assertion, from about 900 bytes on: it appends up to some 150 of its own),
 *   - lies on a disk mounted noexec (it loads compiled kernels from there: abort), or
 *   - is full ("LLVM ERROR: IO failure", exit 1).
 * All met by experiment. A compiled kernel takes about 0.2 MB. */
enum { FOLDER_LENGTH_MOST = 512, FOLDER_ROOM = 32 << 20 };

typedef struct private_folder {
	pid_t owner;
	char path[FOLDER_LENGTH_MOST + 1];
} private_folder;

static void remove_private(int status, void *memory)
{
	private_folder *folder = memory;
	(void)status;
	if (folder->owner == getpid()) /* else a fork of the process that is still using it */
		device_folder_remove(folder->path);
	free(folder);
}

/* PoCL reads POCL_CACHE_DIR once per process and keeps it, so a private folder lives as long as the
 * process, not as a context: it ends by on_exit(), whose argument spares a global. */
static bool use_private(void)
{
	private_folder *folder = malloc(sizeof *folder);
	if (!folder)
		return false;
	*folder = (private_folder){ .owner = getpid() };
	if (!device_folder_make_private("batten-pocl", FOLDER_ROOM, true, folder->path,
	                                sizeof folder->path)) {
		free(folder);
		return false;
	}
	if (setenv("POCL_CACHE_DIR", folder->path, 1) != 0 || on_exit(remove_private, folder) != 0) {
		(void)unsetenv("POCL_CACHE_DIR");
		device_folder_remove(folder->path);
		free(folder);
		return false;
	}
	/* The exit handler must outlive a dlclose() of the library it is in. */
	static const char here = 0;
	Dl_info place;
	if (dladdr(&here, &place) != 0 && place.dli_fname)
		(void)dlopen(place.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
	return true;
}

/* LLVM inside PoCL ends the process when a file of the cache cannot grow. */
static bool files_may_grow(void)
{
	struct rlimit limit;
	return getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
	       limit.rlim_cur >= FOLDER_ROOM;
}

static bool is_usable(const char *path)
{
	return strlen(path) <= FOLDER_LENGTH_MOST && device_folder_usable(path, FOLDER_ROOM, true);
}

static bool choose_folder(void)
{
	const char *given = getenv("POCL_CACHE_DIR");
	if (given && is_usable(given))
		return true;
	/* Where PoCL looks itself, so that what other programs compiled stays useful. */
	const char *switched = getenv("POCL_KERNEL_CACHE");
	bool off = switched && strcmp(switched, "0") == 0;
	char path[DEVICE_FOLDER_SIZE];
	if (device_folder_of_user(off ? "pocl/uncached" : "pocl/kcache", path, sizeof path) &&
	    is_usable(path))
		return setenv("POCL_CACHE_DIR", path, 1) == 0;
	return use_private();
}

bool device_pocl_prepare(unsigned threads)
{
	if (!files_may_grow() || !choose_folder())
		return false;
	char count[16];
	(void)snprintf(count, sizeof count, "%u", threads);
	/* Read once per process: the first context decides. Failure only means other threads. */
	(void)setenv("POCL_MAX_PTHREAD_COUNT", count, 0);
	return true;
}

bool device_pocl_is(const char *platform)
{
	return strcmp(platform, "Portable Computing Language") == 0;
}

bool device_pocl_sees_machine(void)
{
	/* In a bare chroot without /sys, hwloc finds no memory: "Not enough memory to run", abort. */
	return access("/sys/devices/system/cpu", R_OK) == 0;
}

bool device_pocl_has_linker(void)
{
	const char *path = getenv("PATH");
	char program[DEVICE_FOLDER_SIZE];
	while (path && *path) {
		size_t length = strcspn(path, ":");
		int used = snprintf(program, sizeof program, "%.*s/ld", (int)length, path);
		if (length > 0 && used > 0 && (size_t)used < sizeof program && access(program, X_OK) == 0)
			return true;
		path += length + (path[length] == ':');
	}
	return false;
}
