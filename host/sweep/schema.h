/* What marks a file as the database of a sweep. */
#ifndef BATTEN_SWEEP_SCHEMA_H
#define BATTEN_SWEEP_SCHEMA_H

#define SWEEP_SCHEMA_APPLICATION 0x6274656e /* "bten" */
enum { SWEEP_SCHEMA_VERSION = 1 };

#endif
