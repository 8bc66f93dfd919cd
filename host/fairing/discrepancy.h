/* The discrepancy principle: fairing may change a hull by about its noise and not by more. */
#ifndef BATTEN_FAIRING_DISCREPANCY_H
#define BATTEN_FAIRING_DISCREPANCY_H

#include <stddef.h>

/* The part of the noise that the root mean square change may reach. */
#define DISCREPANCY_NOISE_PART 0.75

/* Weights tried, run as one batch. */
enum { DISCREPANCY_RATIOS = 32 };

/* w2/w1 = 1, 10^(1/4), 10^(1/2) ... and, as the last, one so stiff that nothing moves. */
double discrepancy_ratio(size_t i);

/* Number of the least ratio whose change stays within DISCREPANCY_NOISE_PART of the noise; the
 * last where none does. changes_m: root mean square change of the search with each ratio. */
size_t discrepancy_choose(size_t count, const double *changes_m, double noise_m);

#endif
