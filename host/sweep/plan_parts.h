/* The parts of a plan, each read by one function. */
#ifndef BATTEN_SWEEP_PLAN_PARTS_H
#define BATTEN_SWEEP_PLAN_PARTS_H

#include "sweep/plan.h"
#include "sweep/plan_json.h"

/* Takes a file of the plan in: text stays with the plan. */
batten_status plan_take_file(sweep_plan *plan, const plan_source *source, const plan_place *place,
                             const char *role, const char **text, size_t *length);

/* "parameters" and "sampling". */
batten_status plan_read_sampling(sweep_plan *plan, const plan_source *source,
                                 const plan_place *root);
/* Rows of a CSV file under a header of the parameters' names. */
batten_status plan_read_rows(sweep_plan *plan, const plan_place *place, const char *text,
                             size_t length);
/* "vary". */
batten_status plan_read_variation(sweep_plan *plan, const plan_source *source,
                                  const plan_place *root);
/* "fair". */
batten_status plan_read_fairing(sweep_plan *plan, const plan_place *root);
/* "measure", "reject", "objectives", "keep". */
batten_status plan_read_judgement(sweep_plan *plan, const plan_place *root);

/* A setting: a number within its range, or the name of a parameter, which is bound to offset and whose
 * whole range must lie within. */
typedef struct plan_setting {
	const char *name;
	size_t offset; /* in the structure */
	double least, most;
} plan_setting;
batten_status plan_read_setting(const sweep_plan *plan, const plan_place *place,
                                const plan_setting *setting, void *structure,
                                plan_bindings *bindings);

/* Number of a parameter, or SIZE_MAX. */
size_t plan_parameter_number(const sweep_plan *plan, const char *name, size_t length);

/* A letter or _, then letters, digits and _, within SAMPLING_NAME_MOST. */
bool plan_is_name(const char *text);

#endif
