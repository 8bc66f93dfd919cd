/* The plain C path of kernels/fairing_pass.cl in f64. */
#include "reference/fairing_pass.h"

#define BATTEN_DOUBLE 1
#define FAIRING_PASS_FUNCTION reference_fairing_pass_f64
#include "reference/fairing_pass_body.h"
