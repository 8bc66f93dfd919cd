#include "exchange/module.h"

#include "core/installed.h"

#include <dlfcn.h>
#include <string.h>

const exchange_module *exchange_module_open(void)
{
	char path[INSTALLED_PATH_SIZE];
	if (!installed_find("batten_opencascade.so", path))
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
