#include "json_out.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

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

batten_status cli_json_save(const char *command, json_t *object, const char *path)
{
	char making[PATH_MAX];
	if (snprintf(making, sizeof making, "%s.part", path) >= (int)sizeof making) {
		json_decref(object);
		(void)fprintf(stderr, "batten %s: %.64s...: the path is too long\n", command, path);
		return BATTEN_IO;
	}
	FILE *stream = fopen(making, "wb");
	batten_status status = BATTEN_IO;
	if (stream)
		status = cli_json_write(object, stream);
	else
		json_decref(object);
	if (stream && fclose(stream) != 0)
		status = BATTEN_IO;
	if (status == BATTEN_OK && rename(making, path) != 0)
		status = BATTEN_IO;
	if (status == BATTEN_OK)
		return status;
	(void)fprintf(stderr, "batten %s: %s: %s\n", command, path,
	              status == BATTEN_IO ? strerror(errno) : batten_status_text(status));
	if (stream)
		(void)unlink(making);
	return status;
}
