/* A plan of a sweep (data/schema/plan.schema.json), read and checked: nothing is run or created before
 * all of it is known to be sound. */
#ifndef BATTEN_SWEEP_PLAN_H
#define BATTEN_SWEEP_PLAN_H

#include "sweep/expression.h"
#include "sweep/measures.h"
#include "sweep/sampling.h"

enum {
	PLAN_STEPS_MOST = 8,
	PLAN_BINDINGS_MOST = 64,
	PLAN_LIST_MOST = 16, /* hulls of an average, points of a stretch */
	PLAN_DRAFTS_MOST = 100,
	PLAN_LOCKS_MOST = 64,
	PLAN_CONSTRAINTS_MOST = 64,
	PLAN_OBJECTIVES_MOST = 8,
	PLAN_HASH_SIZE = 33,
};

/* Where the files of a plan come from: from disk, or from the database that keeps them. role is
 * "parent", "rows" or "with:NAME", name what the plan calls the file. The text is the caller's. */
typedef struct plan_source {
	batten_status (*read)(batten_context *context, void *user, const char *role, const char *name,
	                      char **text, size_t *length);
	void *user;
} plan_source;

/* A file the plan was read with. */
typedef struct plan_file {
	char *role, *text;
	size_t length;
} plan_file;

/* A number of the settings that a parameter gives. */
typedef struct plan_binding {
	size_t offset; /* of the double in its structure */
	size_t parameter;
} plan_binding;

typedef struct plan_bindings {
	size_t count;
	plan_binding list[PLAN_BINDINGS_MOST];
} plan_bindings;

/* Settings of one variation, those that a parameter gives still open. */
typedef struct plan_variation {
	batten_vary_options options;
	double weights[PLAN_LIST_MOST], from[PLAN_LIST_MOST], to[PLAN_LIST_MOST];
} plan_variation;

typedef struct plan_step {
	plan_variation fixed;
	plan_bindings swept;
	size_t other_count;
	batten_hull *others[PLAN_LIST_MOST];
} plan_step;

/* Numbers of batten_fair_options that a parameter may give; whole ones are rounded down. */
typedef struct plan_fairing_numbers {
	double w2_over_w1;     /* NaN: by the noise, or none */
	double max_distance_m; /* < 0: max_distance_part */
	double max_distance_part;
	double first_step, last_step, iteration_limit, longitudinal, transverse; /* of the search */
	double order, order_sections, iterations, max_cn_pct, least_gain_pct; /* of the other methods */
} plan_fairing_numbers;

typedef struct plan_fairing {
	plan_fairing_numbers fixed;
	plan_bindings swept;
	bool weight_by_noise; /* by the discrepancy principle */
	size_t lock_count;
	batten_lock locks[PLAN_LOCKS_MOST];
	batten_fair_options options; /* what no parameter gives */
} plan_fairing;

/* A design is rejected where its number is NaN or not within the band. */
typedef struct plan_constraint {
	char name[SAMPLING_NAME_MOST + 1];
	sweep_expression expression;
	double least, most;
} plan_constraint;

typedef struct plan_objective {
	size_t measure;
	bool greatest;
} plan_objective;

typedef enum plan_keep { PLAN_KEEP_NONE, PLAN_KEEP_BEST, PLAN_KEEP_ALL } plan_keep;

typedef struct sweep_plan {
	batten_context *context;
	char *name, *text;         /* the plan's JSON, in one line */
	char hash[PLAN_HASH_SIZE]; /* of the plan and its files */
	size_t file_count;
	plan_file files[2 + PLAN_STEPS_MOST * PLAN_LIST_MOST];
	batten_hull *parent; /* smoothed where the plan says so */
	sweep_sampling sampling;
	size_t step_count;
	plan_step steps[PLAN_STEPS_MOST];
	bool fairs;
	plan_fairing fairing;
	batten_hydrostatics_options hydrostatics;
	size_t draft_count;
	double drafts_m[PLAN_DRAFTS_MOST];
	size_t constraint_count, objective_count;
	plan_constraint *constraints;
	plan_objective objectives[PLAN_OBJECTIVES_MOST];
	plan_keep keep;
	uint64_t keep_count; /* of the best */
	plan_objective keep_by;
} sweep_plan;

/* Reads a plan from a file, its files beside it. Errors: IO, INPUT (FILE: JSON path: what was found,
 * what was expected), MEMORY. */
batten_status sweep_plan_read(batten_context *context, const char *path, sweep_plan **out);
/* Same, from memory. */
batten_status sweep_plan_parse(batten_context *context, const char *file, const char *text,
                               size_t length, const plan_source *source, sweep_plan **out);
void sweep_plan_destroy(sweep_plan *plan);

/* How a design is faired; borrows from the plan. */
batten_fair_options plan_fairing_options(const plan_fairing *fairing,
                                         const plan_fairing_numbers *numbers);

/* Structure with the parameters' values put into its open numbers. */
void plan_bind(const plan_bindings *bindings, const double *parameters, void *structure);

#endif
