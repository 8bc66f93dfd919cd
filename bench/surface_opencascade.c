/* surface.opencascade: the grid of surface.curvature_grid against Debian's OpenCASCADE, one thread of it.
 * Ours is the whole batch call on the device, results copied out; the rival evaluates point by point.
 * Both times are of one processor: the CPU time of the process. */
#include "bench.h"
#include "opencascade_peer.h"

#include <stdio.h>
#include <stdlib.h>

enum { GRID_U = 256, GRID_V = 128, POINTS = GRID_U * GRID_V, COUNT = 64, OF_PEER = 4 };

typedef bool (*peer_grid)(const batten_surface_net *net, const batten_surface_samples *samples,
                          double *values);

typedef struct contest {
	peer_grid peer;
	batten_surface *surfaces[COUNT];
	double u[GRID_U], v[GRID_V];
	void *values;  /* of COUNT surfaces: doubles, in f32 floats */
	double *known; /* of OF_PEER */
} contest;

static void contest_release(contest *c)
{
	for (size_t s = 0; s < COUNT; s++)
		batten_surface_destroy(c->surfaces[s]);
	free(c->values);
	free(c->known);
}

static batten_status contest_create(const bench_settings *settings, contest *c)
{
	c->values = bench_allocate_large((size_t)COUNT * POINTS * 2 * sizeof(double));
	c->known = bench_allocate_large((size_t)OF_PEER * POINTS * 2 * sizeof *c->known);
	if (!c->values || !c->known)
		return BATTEN_MEMORY;
	for (int i = 0; i < GRID_U; i++)
		c->u[i] = i / (GRID_U - 1.0);
	for (int k = 0; k < GRID_V; k++)
		c->v[k] = k / (GRID_V - 1.0);
	batten_status status = BATTEN_OK;
	for (size_t s = 0; s < COUNT && status == BATTEN_OK; s++)
		status = bench_surface_hull(settings->context, (uint32_t)s, &c->surfaces[s]);
	return status;
}

static batten_status time_ours(const bench_settings *settings, contest *c,
                               batten_precision precision, batten_run *run, double *seconds)
{
	const batten_surface_samples samples = { GRID_U, GRID_V, c->u, c->v };
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = settings->device;
	options.precision = precision;
	const double begun = bench_is_cpu(settings) ? bench_cpu_seconds() : bench_wall_seconds();
	const batten_surface *const *surfaces = (const batten_surface *const *)c->surfaces;
	const batten_status status = precision == BATTEN_F32
	                                 ? batten_surface_grid_batch_float(settings->context, COUNT,
	                                                                   surfaces, &samples, &options,
	                                                                   c->values, NULL, run)
	                                 : batten_surface_grid_batch(settings->context, COUNT, surfaces,
	                                                             &samples, &options, c->values,
	                                                             NULL, run);
	*seconds = (bench_is_cpu(settings) ? bench_cpu_seconds() : bench_wall_seconds()) - begun;
	*seconds /= (double)COUNT * POINTS;
	return status;
}

static batten_status time_peer(contest *c, double *seconds)
{
	const batten_surface_samples samples = { GRID_U, GRID_V, c->u, c->v };
	bool good = true;
	const double begun = bench_cpu_seconds();
	for (size_t s = 0; s < OF_PEER && good; s++) {
		const batten_surface_net net = batten_surface_describe(c->surfaces[s]);
		good = c->peer(&net, &samples, c->known + 2 * s * POINTS);
	}
	*seconds = (bench_cpu_seconds() - begun) / ((double)OF_PEER * POINTS);
	return good ? BATTEN_OK : BATTEN_INTERNAL;
}

/* K and H of the surfaces that the rival takes. */
static bool agrees(const contest *c, batten_precision precision)
{
	return bench_numbers_agree((bench_numbers){ c->values, precision },
	                           (bench_numbers){ c->known, BATTEN_F64 }, (size_t)OF_PEER * 2,
	                           POINTS);
}

static batten_status run_case(const bench_settings *settings, contest *c,
                              batten_precision precision)
{
	bench_pairs pairs;
	batten_run run = { .strict = true };
	bench_row row = { .precision = precision, .unit = "ns per point", .reference = "opencascade" };
	double seconds = 0.0;
	/* Warm-up, and the proof that both do the same. */
	batten_status status = time_ours(settings, c, precision, &run, &seconds);
	if (status == BATTEN_OK)
		status = time_peer(c, &seconds);
	if (status == BATTEN_OK && !agrees(c, precision))
		status = BATTEN_INTERNAL;
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		status = time_ours(settings, c, precision, NULL, &pairs.value[p]);
		if (status == BATTEN_OK)
			status = time_peer(c, &pairs.reference[p]);
	}
	if (status != BATTEN_OK)
		return status;
	(void)snprintf(row.name, sizeof row.name, "surface.curvature_grid");
	(void)snprintf(row.case_name, sizeof row.case_name, "24x12 bicubic batch %d", COUNT);
	(void)snprintf(row.device, sizeof row.device, "%s", run.device);
	bench_pairs_judge(&pairs, 1e9, &row);
	settings->emit(&row, settings->user);
	return BATTEN_OK;
}

batten_status bench_surface_opencascade(const bench_settings *settings)
{
	contest c = { .peer = (peer_grid)bench_open_peer("batten_opencascade_peer",
		                                             "opencascade_peer_grid") };
	if (!c.peer) /* nothing to compare with */
		return BATTEN_OK;
	batten_status status = contest_create(settings, &c);
	if (status == BATTEN_OK)
		status = run_case(settings, &c, BATTEN_F64);
	if (status == BATTEN_OK)
		status = run_case(settings, &c, BATTEN_F32);
	contest_release(&c);
	return status;
}
