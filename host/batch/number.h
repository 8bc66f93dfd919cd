/* Numbers as kernels have them: of the precision of a batch, in memory whose type is not known before. */
#ifndef BATTEN_BATCH_NUMBER_H
#define BATTEN_BATCH_NUMBER_H

#include "core/context.h"

static inline void number_put(batten_precision precision, void *numbers, size_t at, double value)
{
	if (precision == BATTEN_F64)
		((double *)numbers)[at] = value;
	else
		((float *)numbers)[at] = (float)value;
}

static inline double number_get(batten_precision precision, const void *numbers, size_t at)
{
	if (precision == BATTEN_F64)
		return ((const double *)numbers)[at];
	return (double)((const float *)numbers)[at];
}

#endif
