#include "json_out.h"

#include <math.h>

json_t *cli_json_number(double value)
{
	return isfinite(value) ? json_real(value) : json_null();
}

void cli_json_measures(json_t *object, const batten_measures *measures)
{
	/* The struct is an array of doubles in the order of the names (batten.h). */
	const double *values = (const double *)measures;
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++)
		(void)json_object_set_new(object, batten_measure_name(i), cli_json_number(values[i]));
}

batten_status cli_json_write(json_t *object, FILE *stream)
{
	if (!object)
		return BATTEN_MEMORY;
	const int failed = json_dumpf(object, stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
	json_decref(object);
	return failed || fputc('\n', stream) == EOF ? BATTEN_IO : BATTEN_OK;
}

batten_status cli_json_print(const char *command, json_t *object)
{
	const batten_status status = cli_json_write(object, stdout);
	if (status != BATTEN_OK)
		(void)fprintf(stderr, "batten %s: standard output: %s\n", command,
		              batten_status_text(status));
	return status;
}
