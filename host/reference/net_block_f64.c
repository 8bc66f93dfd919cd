/* The plain C path of kernels/net_block.cl in f64. */
#include "reference/net_block.h"

#include <stddef.h>

#define BATTEN_DOUBLE 1
#define NET_BLOCK_FUNCTION reference_net_block_f64
#include "reference/net_block_body.h"
