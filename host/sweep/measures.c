#include "sweep/measures.h"

#include <string.h>

const char *sweep_measure_name(size_t i)
{
	static const char *const fairing[] = {
#define SWEEP_FAIRING_NAME(name) #name,
		SWEEP_FAIRING_LIST(SWEEP_FAIRING_NAME)
#undef SWEEP_FAIRING_NAME
	};
	if (i < BATTEN_MEASURE_COUNT)
		return batten_measure_name(i);
	return i < SWEEP_MEASURE_COUNT ? fairing[i - BATTEN_MEASURE_COUNT] : NULL;
}

size_t sweep_measure_number(const char *name, size_t length)
{
	for (size_t i = 0; i < SWEEP_MEASURE_COUNT; i++) {
		const char *known = sweep_measure_name(i);
		if (strlen(known) == length && memcmp(known, name, length) == 0)
			return i;
	}
	return SIZE_MAX;
}
