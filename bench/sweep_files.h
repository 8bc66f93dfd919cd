/* What a benchmark of sweeps needs on disk, in a folder of its own: the parent, a Wigley hull of L 16,
 * B 1.6, D 1 m, and the plan. */
#ifndef BATTEN_BENCH_SWEEP_FILES_H
#define BATTEN_BENCH_SWEEP_FILES_H

#include "bench.h"

enum { SWEEP_FOLDER_MOST = 256, SWEEP_PATH_MOST = SWEEP_FOLDER_MOST + 32 };

typedef struct sweep_files {
	char folder[SWEEP_FOLDER_MOST], hull[SWEEP_PATH_MOST], plan[SWEEP_PATH_MOST];
} sweep_files;

/* Makes the folder and the parent in it, noise_m wide. Remove them all the same when it fails. */
batten_status sweep_files_create(batten_context *context, int stations, int waterlines,
                                 double noise_m, sweep_files *files);

/* Writes the plan, printf's way; its parent is "hull.csv". */
__attribute__((format(printf, 2, 3))) batten_status sweep_files_write_plan(const sweep_files *files,
                                                                           const char *format, ...);

/* What else lies in the folder is the caller's to remove first. */
void sweep_files_remove(const sweep_files *files);

#endif
