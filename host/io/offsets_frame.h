/* Between the unit and frame of a file and metres in ap-fwd, which is what a hull is inside. */
#ifndef BATTEN_IO_OFFSETS_FRAME_H
#define BATTEN_IO_OFFSETS_FRAME_H

#include "core/number.h"
#include "hull/hull.h"

bool offsets_unit_named(const char *text, size_t length, hull_unit *out);
bool offsets_frame_named(const char *text, size_t length, hull_frame *out);

/* x runs aft in the file: its order is the reverse of the order inside. */
bool offsets_frame_is_mirrored(hull_frame frame);

/* From the file; unit, frame, lbp_m and draft_m of the hull must be known. */
double offsets_length_in(const batten_hull *hull, double value);
double offsets_x_in(const batten_hull *hull, double value);
double offsets_z_in(const batten_hull *hull, double value);

/* To the file: the shortest decimal that comes back as exactly these metres, where there is one. */
char *offsets_length_out(const batten_hull *hull, double length_m, char buffer[BATTEN_NUMBER_SIZE]);
char *offsets_x_out(const batten_hull *hull, double x_m, char buffer[BATTEN_NUMBER_SIZE]);
char *offsets_z_out(const batten_hull *hull, double z_m, char buffer[BATTEN_NUMBER_SIZE]);

#endif
