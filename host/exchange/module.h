/* The module that knows IGES and STEP: found and opened when it is needed, in a process of its own. */
#ifndef BATTEN_EXCHANGE_MODULE_H
#define BATTEN_EXCHANGE_MODULE_H

#include "core/context.h"
#include "exchange/exchange.h"

/* Opens the module of this build: in the folder BATTEN_MODULE_PATH where that is set; otherwise beside
 * the program or library and where it is installed. It stays open. NULL: none, or one of another
 * version. */
const exchange_module *exchange_module_open(void);

/* What is worked on by module_work(): read path, or write nets. */
typedef struct module_task {
	exchange_format format;
	const char *path; /* reading; in messages also writing */
	size_t count;     /* writing */
	const batten_surface_net *nets;
} module_task;

/* Reads or writes in a child process, whose results come to the sink here. OpenCASCADE keeps global
 * state, talks on standard output and does not stand every damaged file: a child that dies is an error
 * of one line, and nothing of it stays. Errors: MISSING, INPUT, IO, MEMORY, INTERNAL; the sink records
 * its own where it returns false, and that is INTERRUPTED. */
batten_status module_work(batten_context *context, const module_task *task,
                          const exchange_sink *sink);

#endif
