/* The plain C path of kernels/net_block.cl in f32. */
#include "reference/net_block.h"

#include <stddef.h>

#define BATTEN_DOUBLE 0
#define NET_BLOCK_FUNCTION reference_net_block_f32
#include "reference/net_block_body.h"
