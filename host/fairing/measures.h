/* The measures of a hull whose hydrostatics are known. */
#ifndef BATTEN_FAIRING_MEASURES_H
#define BATTEN_FAIRING_MEASURES_H

#include "fairing/measure_room.h"

/* form: at the draft of the measures. Errors: MEMORY. */
batten_status measures_complete(measure_room *room, const batten_hull *hull,
                                const batten_hydrostatics *form, batten_measures *out);

#endif
