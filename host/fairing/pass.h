/* Beside batten.h: values back into a hull. */
#ifndef BATTEN_FAIRING_PASS_H
#define BATTEN_FAIRING_PASS_H

#include "hull/hull.h"

/* The opposite of batten_pass_values(): given nodes and line ends; '?' cells stay. */
void pass_put_values(const double *y_m, batten_hull *hull);

#endif
