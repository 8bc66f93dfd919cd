/* The rows of a pass, one after the other, as rows of its values and constants alone. */
#ifndef BATTEN_FAIRING_PASS_COMPOSE_H
#define BATTEN_FAIRING_PASS_COMPOSE_H

#include "fairing/pass_writer.h"

/* Replaces what is written so far by rows, or tiles of them, that give the numbers at targets[0..count)
 * from the first `base` places of the state; targets become their new places. Nothing changes where there
 * are tiles already, or where it would take more products than the rows did. A factor that is the sum of
 * two opposite ones is 0 to the last bit, and is left out. */
void pass_compose(pass_writer *writer, size_t base, size_t count, size_t *targets);

#endif
