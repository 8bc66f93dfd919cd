/* B-spline surfaces in the files of other programs: IGES and STEP.
 *
 * The formats are OpenCASCADE's work. It is C++ and large, so it lives in a module of its own
 * (opencascade.cpp) that exchange.c opens at run time, as the drivers are; this header is what the two
 * agree on, and no exception passes it. The surfaces are taken from the entities of a file and not from
 * the shapes OpenCASCADE makes of them: those lose digits, split at knuckles and clamp knots. */
#ifndef BATTEN_EXCHANGE_EXCHANGE_H
#define BATTEN_EXCHANGE_EXCHANGE_H

#include "batten.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A module of another version is refused. */
enum { EXCHANGE_VERSION = 1, EXCHANGE_MESSAGE_SIZE = 512 };

typedef enum exchange_format {
	EXCHANGE_IGES,
	EXCHANGE_STEP,
} exchange_format;

/* Where results go; what is handed over is borrowed for the call. Returning false ends the work. */
typedef struct exchange_sink {
	void *user;
	/* A surface: metres. Its net is as the file has it, to be checked. */
	bool (*surface)(void *user, const batten_surface_net *net);
	/* So many entities of a kind were left out, and why. */
	bool (*left_out)(void *user, unsigned long count, const char *kind, const char *why);
	/* The next bytes of a file that is written. */
	bool (*bytes)(void *user, const char *bytes, size_t count);
} exchange_sink;

/* Calls wait for each other: OpenCASCADE keeps its settings in global variables. Both return OK
 * (also when the sink ended the work), INPUT, MEMORY or INTERNAL, and then one line in message. */
typedef struct exchange_module {
	int version;
	batten_status (*read)(exchange_format format, const char *path, const exchange_sink *sink,
	                      char message[EXCHANGE_MESSAGE_SIZE]);
	batten_status (*write)(exchange_format format, size_t count, const batten_surface_net *nets,
	                       const exchange_sink *sink, char message[EXCHANGE_MESSAGE_SIZE]);
} exchange_module;

/* The one symbol of the module. */
BATTEN_API const exchange_module *exchange_module_get(void);

#ifdef __cplusplus
}
#endif

#endif
