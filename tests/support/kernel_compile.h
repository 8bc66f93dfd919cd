/* How PoCL compiles kernels. */
#ifndef BATTEN_TESTS_KERNEL_COMPILE_H
#define BATTEN_TESTS_KERNEL_COMPILE_H

#include <stdbool.h>

/* From now on without optimising, or as it does by itself. For shapes that PoCL is not given by itself: its
 * optimiser takes up to half a minute over one whose groups have several work-items, the shape of a GPU, and
 * what it makes of that says nothing of a GPU's. */
void kernels_unoptimised(bool on);

#endif
