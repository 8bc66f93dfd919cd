/* The numbers that a sweep keeps of a design: every measure of batten.h, then what fairing did. */
#ifndef BATTEN_SWEEP_MEASURES_H
#define BATTEN_SWEEP_MEASURES_H

#include "batten.h"

/* Of the faired hull against the varied one, and of the search; NaN when the plan does not fair. */
#define SWEEP_FAIRING_LIST(X)                                                                      \
	X(cn_pct)                                                                                      \
	X(cn_max_m)                                                                                    \
	X(cn_rms_m)                                                                                    \
	X(closeness_m4)                                                                                \
	X(search_iterations)                                                                           \
	X(objective_start)                                                                             \
	X(objective_end)                                                                               \
	X(w2_over_w1)

enum {
#define SWEEP_FAIRING_ENTRY(name) SWEEP_##name,
	SWEEP_FAIRING_LIST(SWEEP_FAIRING_ENTRY)
#undef SWEEP_FAIRING_ENTRY
		SWEEP_FAIRING_COUNT,
	SWEEP_MEASURE_COUNT = (int)BATTEN_MEASURE_COUNT + (int)SWEEP_FAIRING_COUNT
};

/* Name of number i; NULL beyond the last. */
const char *sweep_measure_name(size_t i);

/* Number of a name of so many bytes, or SIZE_MAX. */
size_t sweep_measure_number(const char *name, size_t length);

#endif
