/* Linked into the programs of an AddressSanitizer build: says at their end whether leaks count. They
 * do, unless an OpenCL or Vulkan driver was loaded; PoCL, LLVM and Mesa keep memory until the process
 * ends. */
#include <link.h>
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
