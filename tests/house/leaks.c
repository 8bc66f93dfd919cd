/* Linked into the programs of an AddressSanitizer build: says at their end whether leaks count. They
 * do, unless an OpenCL or Vulkan driver was loaded; PoCL, LLVM and Mesa keep memory until the process
 * ends. */
#include <link.h>
#include <stdint.h>
#include <string.h>

/* The sanitizer, which may be a shared library, looks for it. */
__attribute__((visibility("default"))) int __lsan_is_turned_off(void);
__attribute__((visibility("default"))) const char *__lsan_default_suppressions(void);

static int is_driver(struct dl_phdr_info *module, size_t size, void *user)
{
	static const char *const names[] = { "libpocl", "libLLVM", "libvulkan", "libVkLayer" };
	(void)size;
	(void)user;
	for (size_t i = 0; i < sizeof names / sizeof *names; i++)
		if (strstr(module->dlpi_name, names[i]))
			return 1;
	return 0;
}

int __lsan_is_turned_off(void)
{
	return dl_iterate_phdr(is_driver, NULL);
}

/* fontconfig, which draws the captions, keeps its configuration until the process ends. */
const char *__lsan_default_suppressions(void)
{
	return "leak:libfontconfig\n";
}

/* The sanitizer looks for pointers in all globals, its own among them, which it leaves out but for a few: to page in
 * and read 10 MB of zeros takes a third of a start and end of the program. The linker puts them first, then those of
 * the first file, this one; its --wrap hands over the function, by clang's name for it. */
#define GLOBALS(kind) kind##__ZN6__lsan23GetAllocatorGlobalRangeEPmS0_
void GLOBALS(__real)(uintptr_t *begin, uintptr_t *end);
__attribute__((visibility("default"))) void GLOBALS(__wrap)(uintptr_t *begin, uintptr_t *end);
extern char __bss_start[];
static char first_of_program;

void GLOBALS(__wrap)(uintptr_t *begin, uintptr_t *end)
{
	const uintptr_t first = (uintptr_t)__bss_start, last = (uintptr_t)&first_of_program;
	GLOBALS(__real)(begin, end);
	if (first < *begin && *end <= last) {
		*begin = first;
		*end = last;
	}
}
