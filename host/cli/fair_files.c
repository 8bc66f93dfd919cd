/* The files of batten fair. They are made in a folder of their own inside the output folder and moved
 * into place when all are there. */
#include "fair_job.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FAIRED, SURFACE, LINES, BEFORE, AFTER, REPORT, FILE_COUNT };
static const char *const file_names[FILE_COUNT] = { "faired.csv", "surface.json", "lines.svg",
	                                                "before.png", "after.png",    "report.json" };

static batten_status complain(const char *path, const char *what)
{
	char line[PATH_MAX + 256];
	(void)snprintf(line, sizeof line, "%s: %s: %s", path, what, strerror(errno));
	cli_clean(line);
	(void)fprintf(stderr, "batten fair: %s\n", line);
	return BATTEN_IO;
}

static batten_status join(char *path, size_t size, const char *folder, const char *name)
{
	if (snprintf(path, size, "%s/%s", folder, name) >= (int)size) {
		errno = ENAMETOOLONG;
		return complain(folder, "cannot be used");
	}
	return BATTEN_OK;
}

batten_status fair_folder_make(const char *folder, bool *made)
{
	char path[PATH_MAX];
	if (snprintf(path, sizeof path, "%s", folder) >= (int)sizeof path) {
		errno = ENAMETOOLONG;
		return complain(folder, "cannot be made");
	}
	for (char *end = path + 1;; end++) {
		if (*end != '/' && *end != '\0')
			continue;
		const char kept = *end;
		*end = '\0';
		*made = mkdir(path, 0777) == 0;
		if (!*made && errno != EEXIST)
			return complain(path, "cannot be made");
		*end = kept;
		if (kept == '\0')
			break;
	}
	struct stat facts;
	if (stat(folder, &facts) != 0)
		return complain(folder, "cannot be used");
	if (!S_ISDIR(facts.st_mode)) {
		errno = ENOTDIR;
		return complain(folder, "cannot be used as a folder");
	}
	return BATTEN_OK;
}

/* One curvature map; without a Vulkan driver there is none, and that is no failure. */
static batten_status draw_map(fair_job *job, const batten_hull *hull, const char *when,
                              double scale, const char *path)
{
	char title[256];
	(void)snprintf(title, sizeof title, "%s: %s", batten_hull_name(hull), when);
	batten_picture_options options;
	batten_picture_options_default(&options);
	options.title = title;
	options.scale_per_m = scale;
	return batten_picture_curvature(job->context, hull, &options, path, job->vulkan_driver);
}

static batten_status draw_maps(fair_job *job, const char *before, const char *after)
{
	double scale = 0.0;
	batten_status status = batten_picture_scale(job->context, job->before.hull, &scale);
	if (status == BATTEN_OK)
		status = draw_map(job, job->before.hull, "before fairing", scale, before);
	if (status == BATTEN_OK)
		status = draw_map(job, job->after.hull, "after fairing", scale, after);
	/* No driver, or nothing that has a curvature. */
	if (status == BATTEN_DEVICE || status == BATTEN_INPUT) {
		job->vulkan_driver[0] = '\0';
		fair_warn(job, "before.png and after.png are not drawn: %s",
		          batten_context_error(job->context));
		return BATTEN_OK;
	}
	return status;
}

static batten_status write_report(const fair_job *job, const char *path)
{
	FILE *stream = fopen(path, "wb");
	if (!stream)
		return complain(path, "cannot be written");
	batten_status status = fair_report_write(job, stream);
	if (fflush(stream) != 0 || fsync(fileno(stream)) != 0)
		status = BATTEN_IO;
	if (fclose(stream) != 0)
		status = BATTEN_IO;
	if (status == BATTEN_IO)
		return complain(path, "cannot be written");
	return status;
}

static batten_status write_all(fair_job *job, char paths[FILE_COUNT][PATH_MAX])
{
	batten_status status = batten_hull_write(job->context, job->after.hull, paths[FAIRED]);
	const batten_surface *surface = batten_fairing_faired_surface(job->fairing);
	if (status == BATTEN_OK && surface)
		status = batten_surface_write(job->context, surface, paths[SURFACE]);
	if (status == BATTEN_OK)
		status = batten_picture_lines(job->context, job->before.hull, job->after.hull,
		                              paths[LINES]);
	if (status == BATTEN_OK)
		status = draw_maps(job, paths[BEFORE], paths[AFTER]);
	if (status != BATTEN_OK)
		return cli_failure("fair", job->context, status);
	return write_report(job, paths[REPORT]);
}

/* Whether every file can be put into its place; a folder of that name cannot be replaced. */
static batten_status check_targets(const char *folder)
{
	for (size_t f = 0; f < FILE_COUNT; f++) {
		char target[PATH_MAX];
		struct stat facts;
		const batten_status status = join(target, sizeof target, folder, file_names[f]);
		if (status != BATTEN_OK)
			return status;
		if (stat(target, &facts) == 0 && S_ISDIR(facts.st_mode)) {
			errno = EISDIR;
			return complain(target, "cannot be written");
		}
	}
	return BATTEN_OK;
}

/* Pictures that were not drawn, and a surface that is not searched, leave no older ones behind, which
 * would show another hull. */
static batten_status move_all(const char *folder, char paths[FILE_COUNT][PATH_MAX])
{
	for (size_t f = 0; f < FILE_COUNT; f++) {
		char target[PATH_MAX];
		const batten_status status = join(target, sizeof target, folder, file_names[f]);
		if (status != BATTEN_OK)
			return status;
		const bool made = access(paths[f], F_OK) == 0;
		if (made ? rename(paths[f], target) != 0 : unlink(target) != 0 && errno != ENOENT)
			return complain(target, made ? "cannot be written" : "cannot be removed");
	}
	return BATTEN_OK;
}

static batten_status make_and_move(fair_job *job, const char *folder)
{
	char making[PATH_MAX];
	char paths[FILE_COUNT][PATH_MAX];
	batten_status status = check_targets(folder);
	if (status == BATTEN_OK)
		status = join(making, sizeof making, folder, ".making-XXXXXX");
	if (status == BATTEN_OK && !mkdtemp(making))
		return complain(folder, "cannot be written to");
	for (size_t f = 0; f < FILE_COUNT && status == BATTEN_OK; f++)
		status = join(paths[f], sizeof paths[f], making, file_names[f]);
	if (status != BATTEN_OK)
		return status;
	status = write_all(job, paths);
	if (status == BATTEN_OK)
		status = move_all(folder, paths);
	for (size_t f = 0; f < FILE_COUNT; f++)
		(void)unlink(paths[f]);
	(void)rmdir(making);
	return status;
}

batten_status fair_files_write(fair_job *job, const char *folder)
{
	bool made = false;
	batten_status status = fair_folder_make(folder, &made);
	if (status != BATTEN_OK)
		return status;
	/* An interrupt in the second this takes would leave half of it behind, and save nothing. */
	const int signals[] = { SIGINT, SIGTERM, SIGHUP };
	struct sigaction before[sizeof signals / sizeof signals[0]];
	const struct sigaction ignore = { .sa_handler = SIG_IGN };
	for (size_t s = 0; s < sizeof signals / sizeof signals[0]; s++)
		(void)sigaction(signals[s], &ignore, &before[s]);
	status = make_and_move(job, folder);
	if (status != BATTEN_OK && made)
		(void)rmdir(folder);
	for (size_t s = 0; s < sizeof signals / sizeof signals[0]; s++)
		(void)sigaction(signals[s], &before[s], NULL);
	return status;
}
