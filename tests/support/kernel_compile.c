#include "support/kernel_compile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

void kernels_unoptimised(bool on)
{
	static const char name[] = "POCL_EXTRA_BUILD_FLAGS";
	assert_int_equal(on ? setenv(name, "-cl-opt-disable", 1) : unsetenv(name), 0);
}
