/* The plain C path of kernels/block_search.cl in f32. */
#include "reference/block_search.h"

#include <stddef.h>

#define BATTEN_DOUBLE 0
#define BLOCK_SEARCH_FUNCTION reference_block_search_f32
#include "reference/block_search_body.h"
