/* Meshes of triangles: checked when they are made, and their public hydrostatics. */
#include "hull/hull.h"
#include "hydrostatics/mesh.h"
#include "hydrostatics/quantities.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct batten_mesh {
	batten_context *context;
	double *vertices;
	uint32_t *triangles;
	mesh_edge *edges; /* the open ones first */
	mesh_arrays arrays;
	size_t edge_count;
	double area_m2, half_beam_m;
};

/* ------------------------------------------------------------------------------------------------
 * Checks
 * --------------------------------------------------------------------------------------------- */

static batten_status check_vertices(batten_mesh *mesh)
{
	mesh_arrays *arrays = &mesh->arrays;
	arrays->lowest_m = arrays->aftmost_m = INFINITY;
	arrays->highest_m = arrays->foremost_m = -INFINITY;
	for (size_t i = 0; i < arrays->vertex_count; i++) {
		const double *p = mesh->vertices + 3 * i;
		for (size_t c = 0; c < 3; c++)
			if (!(fabs(p[c]) <= HULL_LARGEST_M))
				return batten_fail(mesh->context, BATTEN_INPUT,
				                   "vertex %zu: %c is %g, expected a number within %g m", i,
				                   "xyz"[c], p[c], HULL_LARGEST_M);
		if (arrays->half && p[1] < 0)
			return batten_fail(mesh->context, BATTEN_INPUT,
			                   "vertex %zu: y is %g, expected 0 or more in a half hull", i, p[1]);
		arrays->aftmost_m = fmin(arrays->aftmost_m, p[0]);
		arrays->foremost_m = fmax(arrays->foremost_m, p[0]);
		arrays->lowest_m = fmin(arrays->lowest_m, p[2]);
		arrays->highest_m = fmax(arrays->highest_m, p[2]);
		mesh->half_beam_m = fmax(mesh->half_beam_m, fabs(p[1]));
	}
	return BATTEN_OK;
}

static batten_status check_triangles(const batten_mesh *mesh)
{
	for (size_t t = 0; t < mesh->arrays.triangle_count; t++) {
		const uint32_t *v = mesh->triangles + 3 * t;
		for (size_t k = 0; k < 3; k++)
			if (v[k] >= mesh->arrays.vertex_count)
				return batten_fail(mesh->context, BATTEN_INPUT,
				                   "triangle %zu: vertex %lu, expected less than %zu", t,
				                   (unsigned long)v[k], mesh->arrays.vertex_count);
		if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
			return batten_fail(mesh->context, BATTEN_INPUT,
			                   "triangle %zu: a vertex twice, expected three of them", t);
	}
	return BATTEN_OK;
}

static int compare_edges(const void *a, const void *b)
{
	const mesh_edge *p = a, *q = b;
	uint32_t p_low = p->from < p->to ? p->from : p->to, p_high = p->from < p->to ? p->to : p->from;
	uint32_t q_low = q->from < q->to ? q->from : q->to, q_high = q->from < q->to ? q->to : q->from;
	if (p_low != q_low)
		return p_low < q_low ? -1 : 1;
	if (p_high != q_high)
		return p_high < q_high ? -1 : 1;
	return p->triangle < q->triangle ? -1 : p->triangle > q->triangle;
}

static bool same_edge(const mesh_edge *a, const mesh_edge *b)
{
	return (a->from == b->from && a->to == b->to) || (a->from == b->to && a->to == b->from);
}

static bool in_centreplane(const batten_mesh *mesh, const mesh_edge *edge)
{
	return mesh->arrays.half && mesh->vertices[3 * (size_t)edge->from + 1] <= 0 &&
	       mesh->vertices[3 * (size_t)edge->to + 1] <= 0;
}

/* Every edge belongs to one triangle or to two, through which it runs either way; those of one are
 * moved to the front. */
static batten_status check_edges(batten_mesh *mesh)
{
	size_t count = 3 * mesh->arrays.triangle_count, open = 0;
	for (size_t i = 0; i < count; i++) {
		size_t t = i / 3, k = i % 3;
		mesh->edges[i] = (mesh_edge){ mesh->triangles[i], mesh->triangles[3 * t + (k + 1) % 3],
			                          (uint32_t)t };
	}
	qsort(mesh->edges, count, sizeof *mesh->edges, compare_edges);
	for (size_t i = 0; i < count; mesh->edge_count++) {
		const mesh_edge first = mesh->edges[i];
		size_t times = 1;
		while (i + times < count && same_edge(&first, &mesh->edges[i + times]))
			times++;
		if (times > 2)
			return batten_fail(mesh->context, BATTEN_INPUT,
			                   "triangle %lu: its edge %lu-%lu belongs to %zu triangles, expected "
			                   "two at most",
			                   (unsigned long)first.triangle, (unsigned long)first.from,
			                   (unsigned long)first.to, times);
		if (times == 2 && mesh->edges[i + 1].from == first.from)
			return batten_fail(mesh->context, BATTEN_INPUT,
			                   "triangle %lu: runs the other way round than triangle %lu beside it",
			                   (unsigned long)mesh->edges[i + 1].triangle,
			                   (unsigned long)first.triangle);
		if (times == 1 && !in_centreplane(mesh, &first))
			mesh->edges[open++] = first;
		i += times;
	}
	mesh->arrays.open = mesh->edges;
	mesh->arrays.open_count = open;
	return BATTEN_OK;
}

/* The middle of the open edges: what closes them adds nothing to a volume taken from there, or
 * little. */
static void find_middle(const batten_mesh *mesh, double middle[3])
{
	for (size_t i = 0; i < mesh->arrays.open_count; i++) {
		const double *p = mesh->vertices + 3 * (size_t)mesh->edges[i].from;
		const double *q = mesh->vertices + 3 * (size_t)mesh->edges[i].to;
		for (size_t c = 0; c < 3; c++)
			middle[c] += 0.5 * (p[c] + q[c]) / (double)mesh->arrays.open_count;
	}
	if (mesh->arrays.half)
		middle[1] = 0;
}

/* The sign of the volume is that of the triangles. */
static batten_status check_side(batten_mesh *mesh)
{
	double middle[3] = { 0 }, volume = 0;
	find_middle(mesh, middle);
	for (size_t t = 0; t < mesh->arrays.triangle_count; t++) {
		const uint32_t *v = mesh->triangles + 3 * t;
		double side[3][3];
		for (size_t k = 0; k < 3; k++)
			for (size_t c = 0; c < 3; c++)
				side[k][c] = mesh->vertices[3 * (size_t)v[k] + c] - middle[c];
		const double *p = side[0], *q = side[1], *r = side[2];
		volume += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
		           p[2] * (q[0] * r[1] - q[1] * r[0])) /
		          6;
	}
	if (volume < 0)
		return batten_fail(
			mesh->context, BATTEN_INPUT,
			"triangle 0 and all others are inside out: the volume is %g m3, expected "
			"them counter-clockwise seen from the water",
			volume);
	hydrostatics whole;
	mesh_integrate(&mesh->arrays, mesh->arrays.highest_m, &whole);
	mesh->area_m2 = whole.wetted_surface_m2;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static batten_status fill_mesh(batten_mesh *mesh, const batten_mesh_table *table)
{
	batten_context *context = mesh->context;
	mesh->vertices = batten_allocate(context, table->vertex_count, 3 * sizeof(double));
	mesh->triangles = batten_allocate(context, table->triangle_count, 3 * sizeof(uint32_t));
	mesh->edges = batten_allocate(context, table->triangle_count, 3 * sizeof(mesh_edge));
	if (!mesh->vertices || !mesh->triangles || !mesh->edges)
		return BATTEN_MEMORY;
	memcpy(mesh->vertices, table->vertices_m, table->vertex_count * 3 * sizeof(double));
	memcpy(mesh->triangles, table->triangles, table->triangle_count * 3 * sizeof(uint32_t));
	mesh->arrays = (mesh_arrays){ .vertices = mesh->vertices,
		                          .triangles = mesh->triangles,
		                          .vertex_count = table->vertex_count,
		                          .triangle_count = table->triangle_count,
		                          .half = table->half };
	batten_status status = check_vertices(mesh);
	if (status == BATTEN_OK)
		status = check_triangles(mesh);
	if (status == BATTEN_OK)
		status = check_edges(mesh);
	return status == BATTEN_OK ? check_side(mesh) : status;
}

batten_status batten_mesh_create(batten_context *context, const batten_mesh_table *table,
                                 batten_mesh **out)
{
	*out = NULL;
	if (!table->vertices_m || !table->triangles || table->vertex_count < 3 ||
	    table->triangle_count < 1 || table->triangle_count > UINT32_MAX / 3)
		return batten_fail(context, BATTEN_USAGE,
		                   "a mesh of %zu vertices and %zu triangles: three and one are expected, "
		                   "at least",
		                   table->vertex_count, table->triangle_count);
	batten_mesh *mesh = batten_allocate(context, 1, sizeof *mesh);
	if (!mesh)
		return BATTEN_MEMORY;
	mesh->context = context;
	batten_status status = fill_mesh(mesh, table);
	if (status == BATTEN_OK)
		*out = mesh;
	else
		batten_mesh_destroy(mesh);
	return status;
}

void batten_mesh_destroy(batten_mesh *mesh)
{
	if (!mesh)
		return;
	batten_context *context = mesh->context;
	batten_release(context, mesh->vertices);
	batten_release(context, mesh->triangles);
	batten_release(context, mesh->edges);
	batten_release(context, mesh);
}

batten_mesh_facts batten_mesh_describe(const batten_mesh *mesh)
{
	const mesh_arrays *arrays = &mesh->arrays;
	size_t first = arrays->triangle_count;
	for (size_t i = 0; i < arrays->open_count; i++)
		if (arrays->open[i].triangle < first)
			first = arrays->open[i].triangle;
	return (batten_mesh_facts){ .vertex_count = arrays->vertex_count,
		                        .triangle_count = arrays->triangle_count,
		                        .edge_count = mesh->edge_count,
		                        .open_edge_count = arrays->open_count,
		                        .first_open_triangle = first,
		                        .area_m2 = mesh->area_m2,
		                        .lowest_m = arrays->lowest_m,
		                        .highest_m = arrays->highest_m,
		                        .aftmost_m = arrays->aftmost_m,
		                        .foremost_m = arrays->foremost_m };
}

/* ------------------------------------------------------------------------------------------------
 * Hydrostatics
 * --------------------------------------------------------------------------------------------- */

static batten_status float_at(const floating_body *body, double draft_m, hydrostatics *out)
{
	mesh_integrate(body->form, draft_m, out);
	return BATTEN_OK;
}

static batten_status section_of(const void *form, double x_m, double draft_m, double *area_m2)
{
	*area_m2 = mesh_section_area(form, x_m, draft_m);
	return BATTEN_OK;
}

/* The first triangle with an open edge below the draft that is neither a transom's nor in the
 * centreplane. */
static batten_status check_closed(const floating_body *body, double draft_m)
{
	const mesh_arrays *mesh = body->form;
	const double near_x = 1e-9 * (mesh->foremost_m - mesh->aftmost_m);
	const double near_z = 1e-9 * (mesh->highest_m - mesh->lowest_m);
	const mesh_edge *found = NULL;
	for (size_t i = 0; i < mesh->open_count; i++) {
		const mesh_edge *edge = &mesh->open[i];
		const double *p = mesh->vertices + 3 * (size_t)edge->from;
		const double *q = mesh->vertices + 3 * (size_t)edge->to;
		const bool aft = fmax(p[0], q[0]) <= mesh->aftmost_m + near_x;
		const bool fore = fmin(p[0], q[0]) >= mesh->foremost_m - near_x;
		if (!aft && !fore && fmin(p[2], q[2]) < draft_m - near_z &&
		    (!found || edge->triangle < found->triangle))
			found = edge;
	}
	if (!found)
		return BATTEN_OK;
	return batten_fail(body->context, BATTEN_INPUT,
	                   "triangle %lu: its edge %lu-%lu borders a hole below the draft of %g m",
	                   (unsigned long)found->triangle, (unsigned long)found->from,
	                   (unsigned long)found->to, draft_m);
}

static batten_status calculate(const floating_body *body, double draft_m, hydrostatics *out)
{
	const mesh_arrays *mesh = body->form;
	hydrostatics made;
	batten_status status = check_closed(body, draft_m);
	if (status != BATTEN_OK)
		return status;
	mesh_integrate(mesh, draft_m, &made);
	status = quantities_main_sections(body, section_of, draft_m, mesh->aftmost_m, mesh->foremost_m,
	                                  &made);
	if (status == BATTEN_OK)
		*out = made;
	return status;
}

static batten_status open_form(batten_context *context, const batten_mesh *mesh,
                               const batten_hydrostatics_options *options,
                               batten_hydrostatics_options *chosen, floating_body *body)
{
	batten_status status = quantities_options(context, options, chosen);
	if (status != BATTEN_OK)
		return status;
	const mesh_arrays *arrays = &mesh->arrays;
	*body = (floating_body){ .context = context,
		                     .form = arrays,
		                     .half_beam_m = mesh->half_beam_m,
		                     .lowest_m = arrays->lowest_m,
		                     .highest_m = arrays->highest_m,
		                     .calculate = calculate,
		                     .float_at = float_at };
	return quantities_length(context, "mesh", chosen, arrays->foremost_m, &body->lbp_m);
}

batten_status batten_mesh_hydrostatics(batten_context *context, const batten_mesh *mesh,
                                       const batten_hydrostatics_options *options, size_t count,
                                       const double *drafts_m, batten_hydrostatics *out)
{
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, mesh, options, &chosen, &body);
	if (status == BATTEN_OK)
		status = quantities_over_drafts(&body, &chosen, count, drafts_m, out);
	return status;
}

batten_status batten_mesh_measure(batten_context *context, const batten_mesh *mesh,
                                  const batten_hydrostatics_options *options, double draft_m,
                                  batten_measures *out)
{
	batten_hydrostatics found;
	const batten_status status = batten_mesh_hydrostatics(context, mesh, options, 1, &draft_m,
	                                                      &found);
	if (status == BATTEN_OK)
		*out = quantities_as_measures(&found);
	return status;
}

batten_status batten_mesh_draft_at(batten_context *context, const batten_mesh *mesh,
                                   const batten_hydrostatics_options *options,
                                   double displacement_t, double *draft_m)
{
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, mesh, options, &chosen, &body);
	if (status == BATTEN_OK)
		status = quantities_draft_at(&body, &chosen, displacement_t, draft_m);
	return status;
}

batten_status batten_mesh_section_areas(batten_context *context, const batten_mesh *mesh,
                                        const batten_hydrostatics_options *options,
                                        size_t section_count, const double *x_m,
                                        size_t height_count, const double *heights_m,
                                        double *areas_m2)
{
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, mesh, options, &chosen, &body);
	if (status == BATTEN_OK)
		status = quantities_sections(&body, section_of, section_count, x_m, height_count, heights_m,
		                             areas_m2);
	return status;
}
