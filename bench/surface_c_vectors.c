/* surface.c_vectors: the grid of surface.curvature_grid against the same kernel source in the hands of
 * the C compiler, vector lanes and all. Ours is the whole batch call; the rival's tables and nets are made
 * beforehand, so that the kernel alone is timed. */
#include "bench.h"
#include "c_vectors_peer.h"

#include <stdio.h>
#include <stdlib.h>

enum {
	GRID_U = 256,
	GRID_V = 128,
	POINTS = GRID_U * GRID_V,
	COUNT = 64,
	NUMBERS = COUNT * POINTS * 2
};

typedef struct contest {
	c_vectors_run_function *run;
	c_vectors_close_function *close;
	c_vectors *work;
	batten_surface *surfaces[COUNT];
	double u[GRID_U], v[GRID_V];
	void *values, *known; /* doubles, in f32 floats */
} contest;

static void contest_release(contest *c)
{
	if (c->work)
		c->close(c->work);
	for (size_t s = 0; s < COUNT; s++)
		batten_surface_destroy(c->surfaces[s]);
	free(c->values);
	free(c->known);
}

/* The work is NULL where there is nothing to compare with. */
static batten_status contest_create(const bench_settings *settings, batten_precision precision,
                                    contest *c)
{
	const bool f64 = precision == BATTEN_F64;
	const char *name = f64 ? "batten_c_vectors_f64_peer" : "batten_c_vectors_f32_peer";
	c_vectors_open_function *open = (c_vectors_open_function *)bench_open_peer(
		name, f64 ? "c_vectors_open_f64" : "c_vectors_open_f32");
	c->run = (c_vectors_run_function *)bench_open_peer(name, f64 ? "c_vectors_run_f64"
	                                                             : "c_vectors_run_f32");
	c->close = (c_vectors_close_function *)bench_open_peer(name, f64 ? "c_vectors_close_f64"
	                                                                 : "c_vectors_close_f32");
	if (!open || !c->run || !c->close)
		return BATTEN_OK;
	c->values = bench_allocate_large(NUMBERS * sizeof(double));
	c->known = bench_allocate_large(NUMBERS * sizeof(double));
	if (!c->values || !c->known)
		return BATTEN_MEMORY;
	for (int i = 0; i < GRID_U; i++)
		c->u[i] = i / (GRID_U - 1.0);
	for (int k = 0; k < GRID_V; k++)
		c->v[k] = k / (GRID_V - 1.0);
	batten_surface_net nets[COUNT];
	batten_status status = BATTEN_OK;
	for (size_t s = 0; s < COUNT && status == BATTEN_OK; s++) {
		status = bench_surface_hull(settings->context, (uint32_t)s, &c->surfaces[s]);
		if (status == BATTEN_OK)
			nets[s] = batten_surface_describe(c->surfaces[s]);
	}
	const batten_surface_samples samples = { GRID_U, GRID_V, c->u, c->v };
	if (status == BATTEN_OK)
		c->work = open(COUNT, nets, &samples);
	return status;
}

static batten_status time_ours(const bench_settings *settings, contest *c,
                               batten_precision precision, batten_run *run, double *seconds)
{
	const batten_surface *const *surfaces = (const batten_surface *const *)c->surfaces;
	const batten_surface_samples samples = { GRID_U, GRID_V, c->u, c->v };
	batten_surface_batch_options options;
	batten_surface_batch_options_default(&options);
	options.device = settings->device;
	options.precision = precision;
	const double begun = bench_seconds(settings);
	const batten_status status = precision == BATTEN_F32
	                                 ? batten_surface_grid_batch_float(settings->context, COUNT,
	                                                                   surfaces, &samples, &options,
	                                                                   c->values, NULL, run)
	                                 : batten_surface_grid_batch(settings->context, COUNT, surfaces,
	                                                             &samples, &options, c->values,
	                                                             NULL, run);
	*seconds = bench_seconds(settings) - begun;
	return status;
}

static double time_rival(contest *c)
{
	const double begun = bench_cpu_seconds();
	c->run(c->work, c->known);
	return bench_cpu_seconds() - begun;
}

/* The rival's tables are made another way: K and H need not be the same bits. */
static bool agrees(const contest *c, batten_precision precision)
{
	return bench_numbers_agree((bench_numbers){ c->values, precision },
	                           (bench_numbers){ c->known, precision }, (size_t)COUNT * 2, POINTS);
}

static batten_status run_case(const bench_settings *settings, contest *c,
                              batten_precision precision)
{
	bench_pairs pairs;
	batten_run run = { .strict = true };
	bench_row row = { .precision = precision, .unit = "ns per point", .reference = "c_vectors" };
	double seconds = 0.0;
	/* Warm-up, and the proof that both do the same. */
	batten_status status = time_ours(settings, c, precision, &run, &seconds);
	(void)time_rival(c);
	if (status == BATTEN_OK && !agrees(c, precision))
		status = BATTEN_INTERNAL;
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		status = time_ours(settings, c, precision, NULL, &pairs.value[p]);
		pairs.reference[p] = time_rival(c);
	}
	if (status != BATTEN_OK)
		return status;
	(void)snprintf(row.name, sizeof row.name, "surface.curvature_grid");
	(void)snprintf(row.case_name, sizeof row.case_name, "24x12 bicubic batch %d", COUNT);
	(void)snprintf(row.device, sizeof row.device, "%s", run.device);
	bench_pairs_judge(&pairs, 1e9 / ((double)COUNT * POINTS), &row);
	settings->emit(&row, settings->user);
	return BATTEN_OK;
}

batten_status bench_surface_c_vectors(const bench_settings *settings)
{
	static const batten_precision precisions[] = { BATTEN_F64, BATTEN_F32 };
	batten_status status = BATTEN_OK;
	for (int p = 0; p < 2 && status == BATTEN_OK; p++) {
		contest c = { 0 };
		status = contest_create(settings, precisions[p], &c);
		if (status == BATTEN_OK && c.work)
			status = run_case(settings, &c, precisions[p]);
		contest_release(&c);
	}
	return status;
}
