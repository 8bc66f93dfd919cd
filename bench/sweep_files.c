#include "sweep_files.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static void fill(int stations, int waterlines, double noise_m, double *x, double *z, double *y)
{
	uint32_t state = 2654435761u;
	for (int i = 0; i < stations; i++)
		x[i] = 16.0 / (stations - 1.0) * i;
	for (int k = 0; k < waterlines; k++)
		z[k] = k / (waterlines - 1.0);
	for (int n = 0; n < stations * waterlines; n++) {
		const double u = (x[n % stations] - 8.0) / 8.0;
		const double v = 1.0 - z[n / stations];
		const double exact = 0.8 * (1.0 - u * u) * (1.0 - v * v);
		state = state * 1664525u + 1013904223u;
		const double noisy = exact + noise_m * ((double)(state >> 8) / (1u << 24) - 0.5);
		y[n] = exact > 0.0 && noisy > 0.0 ? noisy : 0.0;
	}
}

static batten_status write_hull(batten_context *context, int stations, int waterlines,
                                double noise_m, const char *path)
{
	const size_t nx = (size_t)stations, nz = (size_t)waterlines;
	double *x = calloc(nx + nz + nx * nz, sizeof *x);
	if (!x)
		return BATTEN_MEMORY;
	double *z = x + nx, *y = z + nz;
	fill(stations, waterlines, noise_m, x, z, y);
	const batten_hull_table table = { .name = "Wigley hull",
		                              .lbp_m = 16.0,
		                              .draft_m = 1.0,
		                              .station_count = nx,
		                              .waterline_count = nz,
		                              .x_m = x,
		                              .z_m = z,
		                              .y_m = y };
	batten_hull *hull = NULL;
	batten_status status = batten_hull_create(context, &table, &hull);
	if (status == BATTEN_OK)
		status = batten_hull_write(context, hull, path);
	batten_hull_destroy(hull);
	free(x);
	return status;
}

batten_status sweep_files_create(batten_context *context, int stations, int waterlines,
                                 double noise_m, sweep_files *files)
{
	const char *folder = getenv("TMPDIR");
	*files = (sweep_files){ 0 };
	(void)snprintf(files->folder, sizeof files->folder, "%.200s/batten-bench.XXXXXX",
	               folder ? folder : "/tmp");
	if (!mkdtemp(files->folder))
		return BATTEN_IO;
	(void)snprintf(files->hull, sizeof files->hull, "%s/hull.csv", files->folder);
	(void)snprintf(files->plan, sizeof files->plan, "%s/plan.json", files->folder);
	return write_hull(context, stations, waterlines, noise_m, files->hull);
}

batten_status sweep_files_write_plan(const sweep_files *files, const char *format, ...)
{
	FILE *stream = fopen(files->plan, "w");
	if (!stream)
		return BATTEN_IO;
	va_list arguments;
	va_start(arguments, format);
	(void)vfprintf(stream, format, arguments);
	va_end(arguments);
	return fclose(stream) == 0 ? BATTEN_OK : BATTEN_IO;
}

void sweep_files_remove(const sweep_files *files)
{
	(void)unlink(files->plan);
	(void)unlink(files->hull);
	(void)rmdir(files->folder);
}
