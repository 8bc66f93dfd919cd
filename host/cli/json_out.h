/* JSON of the program: measures as objects, and printing with numbers that read back exactly. */
#ifndef BATTEN_CLI_JSON_OUT_H
#define BATTEN_CLI_JSON_OUT_H

#include "batten.h"

#include <jansson.h>
#include <stdio.h>

/* A finite number, or null. */
json_t *cli_json_number(double value);

/* Every measure by its name, added to object. */
void cli_json_measures(json_t *object, const batten_measures *measures);

/* Prints one object and a newline to a stream, or to standard output; takes the reference. A NULL
 * object (memory ran out while it was made) is MEMORY; a failed write is IO. */
batten_status cli_json_write(json_t *object, FILE *stream);
batten_status cli_json_print(const char *command, json_t *object);
/* The same into a file, at once or not at all; what went wrong is printed. */
batten_status cli_json_save(const char *command, json_t *object, const char *path);

#endif
