/* A pass of two operations of rows as one of stretches (kernels/shared/pass_layout.h). */
#ifndef BATTEN_FAIRING_PASS_STRETCHES_H
#define BATTEN_FAIRING_PASS_STRETCHES_H

#include "fairing/pass_writer.h"

/* Room for what the first operation leaves, with a gap before it, where a vector of any width begins;
 * the room's first place. */
size_t pass_stretches_room(pass_writer *writer, size_t values);

/* The first operation reads values and constants and writes the room, the second one reads the room and
 * constants and writes values; what either leaves out is copied. Nothing changes where stretches would be
 * mostly zeros, or there are fewer values than a stretch has. */
void pass_stretches_make(pass_writer *writer, size_t values, size_t room);

#endif
