/* The plan that a database was made by, with its files, as the database keeps them. */
#ifndef BATTEN_SWEEP_STORED_PLAN_H
#define BATTEN_SWEEP_STORED_PLAN_H

#include "sweep/database.h"
#include "sweep/plan.h"

/* Errors: INPUT (no database of a sweep), IO, MEMORY. */
batten_status stored_plan_read(const sweep_database *database, sweep_plan **out);

#endif
