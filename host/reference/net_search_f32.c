/* The plain C path of kernels/net_search.cl in f32. */
#include "reference/net_search.h"

#include <stddef.h>

#define BATTEN_DOUBLE 0
#define NET_SEARCH_FUNCTION reference_net_search_f32
#include "reference/net_search_body.h"
