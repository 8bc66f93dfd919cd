/* surface.curvature_grid and surface.energy: batches of noisy Wigley hulls as bicubic surfaces, 24 x 12
 * poles, on the device against the plain C path. The grid keeps K and H at 256 x 128 points and copies
 * them out; the integrals keep nothing. 210 operations a point: what the tensor product and the two
 * curvatures take at least. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ALONG = 24, UP = 12, POLES = ALONG * UP, GRID_U = 256, GRID_V = 128, OPERATIONS = 210 };
enum { GAUSS = 12, GAUSS_COUNT = (ALONG - 3) * (UP - 3) * GAUSS * GAUSS };

typedef struct workload {
	bool energy;
	size_t count, points; /* surfaces, points of each */
	size_t bytes;         /* of the values: doubles; of the grids in f32 floats */
	double u[GRID_U], v[GRID_V];
	batten_surface **surfaces;
	void *values, *known;
	batten_surface_energies *energies, *known_energies;
} workload;

static void workload_release(workload *w)
{
	for (size_t s = 0; w->surfaces && s < w->count; s++)
		batten_surface_destroy(w->surfaces[s]);
	free(w->surfaces);
	free(w->values);
	free(w->known);
	free(w->energies);
	free(w->known_energies);
}

batten_status bench_surface_hull(batten_context *context, uint32_t number, batten_surface **out)
{
	uint32_t state = 2654435761u * (number + 1);
	double poles[3 * POLES];
	for (int n = 0; n < POLES; n++) {
		const int i = n % ALONG;
		const int k = n / ALONG;
		const double a = i / (ALONG - 1.0);
		const double b = k / (UP - 1.0);
		state = state * 1664525u + 1013904223u;
		poles[3 * n] = 16.0 * a;
		poles[3 * n + 1] = 3.2 * a * (1.0 - a) * b * (2.0 - b) +
		                   0.002 * ((double)(state >> 8) / (1u << 24) - 0.5);
		poles[3 * n + 2] = b;
	}
	const batten_surface_net net = {
		.order_u = 4, .order_v = 4, .count_u = ALONG, .count_v = UP, .poles_m = poles
	};
	return batten_surface_create(context, &net, out);
}

static batten_status workload_create(const bench_settings *settings, bool energy,
                                     batten_precision precision, workload *w)
{
	*w = (workload){ .energy = energy,
		             .count = settings->full ? 256 : 64,
		             .points = energy ? GAUSS_COUNT : GRID_U * GRID_V };
	w->bytes = w->count * w->points * 2 *
	           (precision == BATTEN_F64 ? sizeof(double) : sizeof(float));
	w->surfaces = calloc(w->count, sizeof *w->surfaces);
	w->values = bench_allocate_large(energy ? 1 : w->bytes);
	w->known = bench_allocate_large(energy ? 1 : w->bytes);
	w->energies = calloc(w->count, sizeof *w->energies);
	w->known_energies = calloc(w->count, sizeof *w->known_energies);
	if (!w->surfaces || !w->values || !w->known || !w->energies || !w->known_energies)
		return BATTEN_MEMORY;
	for (int i = 0; i < GRID_U; i++)
		w->u[i] = i / (GRID_U - 1.0);
	for (int k = 0; k < GRID_V; k++)
		w->v[k] = k / (GRID_V - 1.0);
	batten_status status = BATTEN_OK;
	for (size_t s = 0; s < w->count && status == BATTEN_OK; s++)
		status = bench_surface_hull(settings->context, (uint32_t)s, &w->surfaces[s]);
	return status;
}

/* One run: the grids or the integrals of all surfaces. */
static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	const workload *w = user;
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	const batten_surface *const *surfaces = (const batten_surface *const *)w->surfaces;
	const batten_surface_samples samples = { GRID_U, GRID_V, w->u, w->v };
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = device;
	options.precision = precision;
	options.gauss_points = GAUSS;
	if (w->energy)
		return batten_surface_energy_batch(settings->context, w->count, surfaces, &options,
		                                   known ? w->known_energies : w->energies, run);
	if (precision == BATTEN_F32)
		return batten_surface_grid_batch_float(settings->context, w->count, surfaces, &samples,
		                                       &options, known ? w->known : w->values, NULL, run);
	return batten_surface_grid_batch(settings->context, w->count, surfaces, &samples, &options,
	                                 known ? w->known : w->values, NULL, run);
}

static bool same_results(const void *user)
{
	const workload *w = user;
	if (w->energy)
		return memcmp(w->energies, w->known_energies, w->count * sizeof *w->energies) == 0;
	return memcmp(w->values, w->known, w->bytes) == 0;
}

static batten_status run_case(const bench_settings *settings, bool energy,
                              batten_precision precision)
{
	workload w;
	bench_row row = { .precision = precision, .unit = "ns per point" };
	batten_status status = workload_create(settings, energy, precision, &w);
	const double points = (double)(w.count * w.points);
	const bench_contest contest = { .workload = &w,
		                            .run = run_batch,
		                            .same = same_results,
		                            .scale = 1e9 / points,
		                            .operations = OPERATIONS * points };
	(void)snprintf(row.name, sizeof row.name, "surface.%s", energy ? "energy" : "curvature_grid");
	(void)snprintf(row.case_name, sizeof row.case_name, "%dx%d bicubic batch %zu", ALONG, UP,
	               w.count);
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &contest, &row);
	workload_release(&w);
	return status;
}

batten_status bench_surface_curvature_grid(const bench_settings *settings)
{
	const batten_status status = run_case(settings, false, BATTEN_F64);
	return status == BATTEN_OK ? run_case(settings, false, BATTEN_F32) : status;
}

batten_status bench_surface_energy(const bench_settings *settings)
{
	const batten_status status = run_case(settings, true, BATTEN_F64);
	return status == BATTEN_OK ? run_case(settings, true, BATTEN_F32) : status;
}
