/* Values evenly spread by their logarithm. */
#ifndef BATTEN_SWEEP_LOG_SCALE_H
#define BATTEN_SWEEP_LOG_SCALE_H

/* from (to / from)^part, 0 <= part <= 1, from and to > 0. By + - * / alone: the C library's exp and log
 * differ in their last bits from machine to machine, and a design must not. Within 1e-14 of itself. */
double log_scale_between(double from, double to, double part);

#endif
