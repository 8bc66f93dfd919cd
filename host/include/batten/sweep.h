/* batten.h, one part of it: a plan of many designs, run into a database; its report. */
#ifndef BATTEN_SWEEP_H
#define BATTEN_SWEEP_H

#include "base.h"
#include "hull.h"
#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Sweeps: a plan of many designs, run into a database
 * --------------------------------------------------------------------------------------------- */

/* Where SQLite keeps what is not yet in the database file. */
typedef enum batten_sweep_journal {
	BATTEN_SWEEP_JOURNAL_AUTO,     /* WAL, but a rollback journal on network file systems */
	BATTEN_SWEEP_JOURNAL_WAL,      /* a write-ahead log beside it: fewer waits for the disk */
	BATTEN_SWEEP_JOURNAL_ROLLBACK, /* a file that is emptied after every block */
} batten_sweep_journal;

/* How far a sweep is. Counts are of the shard's designs that are stored, earlier runs included. */
typedef struct batten_sweep_progress {
	uint64_t first, end; /* the shard's designs have the numbers first to end - 1 */
	uint64_t stored, not_converged, rejected, failed;
	uint64_t stored_before; /* by earlier runs */
	uint64_t begun;         /* designs from first to begun - 1 are stored or under way */
	double seconds;         /* wall time of this run */
	double vary_s, fair_s, measure_s, store_s; /* in each stage; they go on beside each other */
	char device[128];                          /* what searched, "" before the first block */
} batten_sweep_progress;

typedef struct batten_sweep_options {
	size_t struct_size;
	int device; /* as in batten_search_options; AUTO */
	/* Part number `shard` of shard_count, from 1: 1 of 1. A design is the same in any part. */
	uint64_t shard, shard_count;
	bool resume; /* go on with a database that is there; without one, begin */
	bool large;  /* more than BATTEN_SWEEP_LARGE designs are meant */
	batten_sweep_journal journal;
	/* Designs under way at a time, 1..65536, computed and stored in parts: what a kill repeats at most.
	 * 0 chooses. */
	size_t block;
	bool stages_take_turns; /* nothing runs beside anything else: each stage is timed alone */
	/* Called from the thread of the call before a part is begun and when one is stored; either may be
	 * NULL. stop returning true ends the sweep when what is under way is stored. */
	void (*progress)(const batten_sweep_progress *progress, void *user);
	bool (*stop)(void *user);
	void *user;
} batten_sweep_options;
BATTEN_API void batten_sweep_options_default(batten_sweep_options *options);

#define BATTEN_SWEEP_LARGE 10000000u

/* Runs the plan of a JSON file (data/schema/plan.schema.json) into an SQLite database
 * (host/sweep/README.md): vary, fair, measure, store, beside each other. The plan is checked before
 * anything is made. Design i depends on the plan, its seed and i only: a database that was cut short at any moment
 * and resumed holds the same rows as one that was not, and so do the shards of a sweep together. At
 * most one block is computed again. out may be NULL.
 * Returns INCOMPLETE when a design failed or did not converge, INTERRUPTED when stop said so. Errors:
 * USAGE (options, a database that is there, more than BATTEN_SWEEP_LARGE designs without `large`), INPUT
 * (the plan, its files; resume: a database of another plan, shard, schema or version), IO, DEVICE,
 * KERNEL, MEMORY. */
BATTEN_API batten_status batten_sweep_run(batten_context *context, const char *plan_path,
                                          const char *database_path,
                                          const batten_sweep_options *options,
                                          batten_sweep_progress *out);

/* Puts the databases of all shards of one sweep, in any order, together into one that equals, row for
 * row, that of a sweep in one part; out_path is replaced at once or not at all. designs, how many it
 * has, may be NULL. Errors: USAGE (no database, out_path among them), INPUT (another plan, a shard that is
 * missing, given twice or not complete), IO, MEMORY. */
BATTEN_API batten_status batten_sweep_merge(batten_context *context, const char *out_path,
                                            size_t count, const char *const *paths,
                                            uint64_t *designs);

/* Design number id of a sweep as a hull: varied again from the plan that the database keeps, with the
 * offsets that are kept there, or faired again where they are not. Errors: USAGE (no such design), INPUT
 * (no database of a sweep; a design that failed), IO, MEMORY. */
BATTEN_API batten_status batten_sweep_design(batten_context *context, const char *database_path,
                                             uint64_t id, batten_hull **out);

/* A surface fitted to a hull, its net as large as the offsets and their noise ask for. deviation may
 * be NULL. Errors: as batten_hull_fit(). */
BATTEN_API batten_status batten_hull_fit_chosen(batten_context *context, const batten_hull *hull,
                                                batten_surface **out,
                                                batten_fit_deviation *deviation);

/* Writes both halves of a hull as triangles between samples of its surface, 1..64 steps a knot span, as
 * binary STL (metres, normals outward); the file is replaced at once or not at all. Errors: USAGE, IO,
 * MEMORY. */
BATTEN_API batten_status batten_surface_write_stl(batten_context *context,
                                                  const batten_surface *surface, size_t steps,
                                                  const char *path);

/* ------------------------------------------------------------------------------------------------
 * Report of a sweep
 * --------------------------------------------------------------------------------------------- */

enum { BATTEN_REPORT_HULLS_MOST = 100000 };

typedef struct batten_report_options {
	size_t struct_size;
	size_t
		hull_count;   /* hulls whose geometry goes into the report, the best kept ones of the sweep,
	                      0..BATTEN_REPORT_HULLS_MOST; 0 takes the plan's number, else 1000 */
	const char *page; /* the page the data are put into; NULL takes the one of this build */
} batten_report_options;
BATTEN_API void batten_report_options_default(batten_report_options *options);

typedef struct batten_report_facts {
	size_t design_count,
		shown_count;    /* above 200000 designs not all are shown: the front, the hulls
	                                     and every n-th of the rest */
	size_t front_count; /* designs that no other one is better than in every objective */
	size_t hull_count;  /* hulls that can be looked at */
	uint64_t bytes;     /* length of the file */
} batten_report_facts;

/* One HTML file that shows the result of a sweep, the database, in a browser and needs nothing else, no
 * network either. The file is replaced at once or not at all. options and facts may be NULL. Errors:
 * MISSING (batten was built without the page), IO (also a database that is being written), INPUT (no
 * database of a sweep, or one that is not as it should be), USAGE, MEMORY. */
BATTEN_API batten_status batten_report_write(batten_context *context, const char *database,
                                             const batten_report_options *options, const char *path,
                                             batten_report_facts *facts);

#ifdef __cplusplus
}
#endif

#endif
