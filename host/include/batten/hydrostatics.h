/* batten.h, one part of it: hydrostatics of offsets, surfaces and meshes; many hulls of one table. */
#ifndef BATTEN_HYDROSTATICS_H
#define BATTEN_HYDROSTATICS_H

#include "base.h"
#include "hull.h"
#include "search.h"
#include "surface.h"
#include "vary.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Hydrostatics over drafts, from offsets, surfaces and triangle meshes
 * --------------------------------------------------------------------------------------------- */

/* Upright, zero trim, moulded, both sides, at one draft. NaN where a quantity does not exist: no
 * waterplane, no volume, no height of the centre of gravity. Definitions: Letcher 9-11. */
#define BATTEN_HYDROSTATICS_LIST(X)                                                                \
	BATTEN_FORM_LIST(X)                                                                            \
	X(transom_area_m2, "immersed area of full end sections, left out of the wetted surface")       \
	X(gmt_m, "transverse metacentric height, + stable")                                            \
	X(gml_m, "longitudinal metacentric height, + stable")                                          \
	X(mt1cm_t_m_per_cm, "moment to change trim by one centimetre over LBP")                        \
	X(volume_mismatch_pct, "largest difference of the x- and z-forms of the volume from the y-form")

typedef struct batten_hydrostatics {
#define BATTEN_HYDROSTATICS_FIELD(name, text) double name;
	BATTEN_HYDROSTATICS_LIST(BATTEN_HYDROSTATICS_FIELD)
#undef BATTEN_HYDROSTATICS_FIELD
} batten_hydrostatics;

enum { BATTEN_HYDROSTATICS_COUNT = (int)(sizeof(batten_hydrostatics) / sizeof(double)) };

/* Name and meaning of quantity number i, in the order of the struct; NULL beyond. */
BATTEN_API const char *batten_hydrostatics_name(size_t i);
BATTEN_API const char *batten_hydrostatics_text(size_t i);

typedef struct batten_hydrostatics_options {
	size_t struct_size;
	batten_quadrature quadrature; /* of offsets; surfaces are integrated by Gauss points, meshes
	                                 triangle by triangle */
	double density_t_per_m3;      /* 1.025 */
	double kg_m;                  /* centre of gravity above the baseline; NaN: not known */
	double lbp_m;          /* of surfaces and meshes; 0 takes x of their foremost point, which
	                                 must lie before the aft perpendicular, x = 0 */
	unsigned gauss_points; /* of surfaces, a knot span and direction, 1..16; 0 takes twice the
	                                 larger degree, 12 at least: exact for polynomial patches that
	                                 the waterline does not cut */
} batten_hydrostatics_options;
BATTEN_API void batten_hydrostatics_options_default(batten_hydrostatics_options *options);

/* At count drafts (m above the baseline, in any order); out is the caller's, [count]. options may be
 * NULL. Errors: USAGE (a draft that is not finite or not within the table, an option out of its range),
 * INPUT (a rule whose conditions do not hold), MEMORY. */
BATTEN_API batten_status batten_hull_hydrostatics(batten_context *context, const batten_hull *hull,
                                                  const batten_hydrostatics_options *options,
                                                  size_t count, const double *drafts_m,
                                                  batten_hydrostatics *out);

/* The draft at which a hull displaces that many tonnes, by Newton's method with the waterplane as
 * the derivative, kept between bounds (Letcher 9.5). Errors: USAGE (also a displacement the hull does
 * not reach; the message names the range), INPUT, MEMORY. */
BATTEN_API batten_status batten_hull_draft_at(batten_context *context, const batten_hull *hull,
                                              const batten_hydrostatics_options *options,
                                              double displacement_t, double *draft_m);

/* Bonjean's curves: the area of every section of the table up to each of count heights, both sides;
 * areas_m2 is the caller's, [count][stations]. Errors: as batten_hull_hydrostatics(). */
BATTEN_API batten_status batten_hull_section_areas(batten_context *context, const batten_hull *hull,
                                                   const batten_hydrostatics_options *options,
                                                   size_t count, const double *heights_m,
                                                   double *areas_m2);

/* The curve of section areas at one draft, with its ends beyond the stations. x_m and area_m2 are the
 * caller's, stations + 2 each; *count gets the number of points. Errors: as
 * batten_hull_hydrostatics(). */
BATTEN_API batten_status batten_hull_area_curve(batten_context *context, const batten_hull *hull,
                                                const batten_hydrostatics_options *options,
                                                double draft_m, double *x_m, double *area_m2,
                                                size_t *count);

/* The same of a half hull as a B-spline surface, by the divergence theorem (Letcher 9.4): Gauss points
 * in every knot span, cut at the waterline. Either sense of the normal will do. Ends that do not reach
 * the centreplane are transoms; a keel that does not, and a deck below the draft, leave the hull open:
 * its volume counts, but the three forms of it (by x, y and z) differ, volume_mismatch_pct says by how
 * much. Errors: USAGE (as above; a draft not within the surface; no volume below it), MEMORY. */
BATTEN_API batten_status batten_surface_hydrostatics(batten_context *context,
                                                     const batten_surface *surface,
                                                     const batten_hydrostatics_options *options,
                                                     size_t count, const double *drafts_m,
                                                     batten_hydrostatics *out);
BATTEN_API batten_status batten_surface_draft_at(batten_context *context,
                                                 const batten_surface *surface,
                                                 const batten_hydrostatics_options *options,
                                                 double displacement_t, double *draft_m);

/* Areas of the sections at section_count places x_m; areas_m2 [height_count][section_count]. */
BATTEN_API batten_status batten_surface_section_areas(batten_context *context,
                                                      const batten_surface *surface,
                                                      const batten_hydrostatics_options *options,
                                                      size_t section_count, const double *x_m,
                                                      size_t height_count, const double *heights_m,
                                                      double *areas_m2);

/* Every measure of a surface: its hydrostatics at a draft, and the energies over the whole of it
 * (batten_surface_energy_batch() on the plain C path). What belongs to tables is NaN. */
BATTEN_API batten_status batten_surface_measure(batten_context *context,
                                                const batten_surface *surface,
                                                const batten_hydrostatics_options *options,
                                                double draft_m, batten_measures *out);

/* A hull as triangles, counter-clockwise seen from the water. */
typedef struct batten_mesh batten_mesh;
typedef struct batten_mesh_table {
	size_t vertex_count, triangle_count; /* 3 at least, 1 at least */
	const double *vertices_m;            /* [vertices][3]: x, y, z; finite, within 1e6 m */
	const uint32_t *triangles;           /* [triangles][3]: numbers of vertices */
	bool half;                           /* the half hull y >= 0: its image in y = 0 is added */
} batten_mesh_table;

/* Copies and checks. Errors: INPUT (one line that names the triangle: a vertex that is not there or
 * occurs twice in it, an edge of more than two triangles, one that runs against its neighbour, all
 * of them inside out), USAGE (nothing given), MEMORY. */
BATTEN_API batten_status batten_mesh_create(batten_context *context, const batten_mesh_table *table,
                                            batten_mesh **out);
BATTEN_API void batten_mesh_destroy(batten_mesh *mesh);

/* Reads triangles from a file that ends in .stl (binary or text; equal places are one vertex) or .obj (v and
 * f lines; polygons are cut into fans): metres, frame ap-fwd, a half hull where no vertex lies to starboard.
 * parse takes text [length] with the name that tells its format. Errors: IO, INPUT (the file, and its line
 * or the triangle, counted from 0, as batten_mesh_create()), USAGE (another ending), MEMORY. */
BATTEN_API batten_status batten_mesh_read(batten_context *context, const char *path,
                                          batten_mesh **out);
BATTEN_API batten_status batten_mesh_parse(batten_context *context, const char *name,
                                           const char *text, size_t length, batten_mesh **out);

typedef struct batten_mesh_facts {
	size_t vertex_count, triangle_count, edge_count;
	size_t open_edge_count; /* of one triangle only; not counted: those of a half hull in y = 0 */
	size_t first_open_triangle;          /* with such an edge; triangle_count without one */
	double area_m2, lowest_m, highest_m; /* area of all triangles, both sides of a half hull */
	double aftmost_m, foremost_m;
} batten_mesh_facts;
BATTEN_API batten_mesh_facts batten_mesh_describe(const batten_mesh *mesh);

/* As for surfaces. The waterplane needs no triangles, nor does a vertical transom; holes below the
 * draft show in volume_mismatch_pct. */
BATTEN_API batten_status batten_mesh_hydrostatics(batten_context *context, const batten_mesh *mesh,
                                                  const batten_hydrostatics_options *options,
                                                  size_t count, const double *drafts_m,
                                                  batten_hydrostatics *out);
/* Its hydrostatics as measures; the others are NaN. */
BATTEN_API batten_status batten_mesh_measure(batten_context *context, const batten_mesh *mesh,
                                             const batten_hydrostatics_options *options,
                                             double draft_m, batten_measures *out);
BATTEN_API batten_status batten_mesh_draft_at(batten_context *context, const batten_mesh *mesh,
                                              const batten_hydrostatics_options *options,
                                              double displacement_t, double *draft_m);
BATTEN_API batten_status batten_mesh_section_areas(batten_context *context, const batten_mesh *mesh,
                                                   const batten_hydrostatics_options *options,
                                                   size_t section_count, const double *x_m,
                                                   size_t height_count, const double *heights_m,
                                                   double *areas_m2);

/* Integrals over a plane area: a section, a waterplane, what lies under a curve; x and y in metres. */
typedef struct batten_polygon_integrals {
	double area_m2;
	double moment_x_m3, moment_y_m3;  /* of x dA, of y dA: over the area, the centre */
	double i_xx_m4, i_xy_m4, i_yy_m4; /* of y^2 dA, of x y dA, of x^2 dA, about the axes */
} batten_polygon_integrals;

/* Of the area within loops of straight lines, exact (Letcher 9.4): loop k has counts[k] >= 3 points, x and y
 * each, one loop after the other in points_m; the last point is joined to the first. Counter-clockwise
 * loops count positive, holes run the other way. An ordinate may stand twice at one place, with the values
 * on both sides of a step (9.2.1). Errors: USAGE (fewer points, a number beyond 1e6 m). */
BATTEN_API batten_status batten_polygon_integrate(batten_context *context, size_t loop_count,
                                                  const size_t *counts, const double *points_m,
                                                  batten_polygon_integrals *out);

/* Something about a hull worth a second look: a quantity outside the range of usual ships (Letcher
 * 10-11), or a surface or mesh that is not closed. Never an error. */
typedef struct batten_warning {
	char name[32]; /* of the quantity */
	char text[160];
} batten_warning;

/* A volume_mismatch_pct above this is warned of. */
#define BATTEN_MISMATCH_LARGEST_PCT 0.01

/* warnings is the caller's, capacity entries long; returns the number there are. */
BATTEN_API size_t batten_hydrostatics_warnings(const batten_hydrostatics *hydrostatics,
                                               batten_warning *warnings, size_t capacity);

/* Numbers in named columns, as files take them, after columns of text where there are any. */
typedef struct batten_table {
	const char *name, *quadrature; /* of the hull and of the rule, NULL where there is none */
	size_t column_count, row_count;
	const char *const *columns; /* names with units */
	const double *values;       /* [rows][columns]; NaN is an empty cell, null in JSON */
	size_t text_count;
	const char *const *text_columns;
	const char *const *texts; /* [rows][text columns], UTF-8; NULL likewise */
} batten_table;

/* Writes the table as CSV or JSON, as path ends in .csv or .json; the file is replaced at once or not
 * at all. Errors: USAGE (another ending), IO, MEMORY. */
BATTEN_API batten_status batten_table_write(batten_context *context, const batten_table *table,
                                            const char *path);

/* The same piece by piece, in bounded memory: open writes names and rows of the first piece, add those
 * of others with the same columns; commit replaces the file, abandon leaves everything as it was. Both
 * end the handle; abandon takes NULL. */
typedef struct batten_table_file batten_table_file;
BATTEN_API batten_status batten_table_open(batten_context *context, const batten_table *table,
                                           const char *path, batten_table_file **file);
BATTEN_API batten_status batten_table_add(batten_table_file *file, const batten_table *table);
BATTEN_API batten_status batten_table_commit(batten_table_file *file);
BATTEN_API void batten_table_abandon(batten_table_file *file);

/* ------------------------------------------------------------------------------------------------
 * Many hulls of one table
 * --------------------------------------------------------------------------------------------- */

/* Where a batch of hulls runs. In f64. */
typedef struct batten_batch_options {
	size_t struct_size;
	int device;          /* an index of batten_device_count(), or AUTO, REFERENCE */
	unsigned lanes;      /* hulls a work-item runs side by side: 1, 2, 4, 8, 16; 0 chooses */
	unsigned work_group; /* work-items a hull is shared by; 0 chooses */
} batten_batch_options;
BATTEN_API void batten_batch_options_default(batten_batch_options *options);

/* batten_hull_hydrostatics() of count hulls that differ in half-breadths only: table gives stations,
 * waterlines, lbp and points off the grid. y_m [count][waterlines][stations], nodes likewise or NULL:
 * those of the table; a '?' counts with the half-breadth given. out is the caller's,
 * [count][draft_count]. The result of a hull does not depend on the others nor (when strict) on what ran
 * it, and is that of batten_hull_hydrostatics() within rounding. Hulls whose lines have gaps, tables with
 * knuckles or points inside the grid, and other rules than the spline are taken one by one, on the host.
 * options, batch and run may be NULL. Errors: as batten_hull_hydrostatics(), USAGE (a half-breadth
 * below 0 or not finite), DEVICE, KERNEL; out is then not to be used. */
BATTEN_API batten_status batten_hull_hydrostatics_batch(
	batten_context *context, const batten_hull *table, const batten_hydrostatics_options *options,
	const batten_batch_options *batch, size_t count, const double *y_m, const uint8_t *nodes,
	size_t draft_count, const double *drafts_m, batten_hydrostatics *out, batten_run *run);

/* What became of one surface of a batch. */
typedef struct batten_afloat_result {
	batten_status status; /* OK: there are numbers */
	char reason[120];     /* one line when there are none */
} batten_afloat_result;

/* batten_surface_hydrostatics() of count surfaces of one topology (equal orders, counts and knots, all
 * rational or none). out is the caller's, [count][draft_count]; results [count]. A surface that cannot be
 * measured, as a draft is beyond it, has its reason and NaN for numbers, and the others go on; without
 * results the first such surface ends the batch. The numbers of a surface do not depend on the others nor
 * (when strict) on what ran it, and are those of batten_surface_hydrostatics() within rounding; the largest
 * section and half-breadths within what a search for a largest value leaves. options, batch, results and
 * run may be NULL. Errors: as batten_surface_hydrostatics(), USAGE (surfaces unlike the first, more than
 * 64 drafts), DEVICE, KERNEL, MEMORY; out is then not to be used. */
BATTEN_API batten_status batten_surface_hydrostatics_batch(
	batten_context *context, size_t count, const batten_surface *const *surfaces,
	const batten_hydrostatics_options *options, const batten_batch_options *batch,
	size_t draft_count, const double *drafts_m, batten_hydrostatics *out,
	batten_afloat_result *results, batten_run *run);

/* What differs from row to row, as in batten_vary_options. */
typedef struct batten_vary_row {
	double dcp_pct, dlcb_pct, dp_fore_pct, dp_aft_pct;
} batten_vary_row;

/* What became of a row. */
typedef struct batten_vary_result {
	batten_status status;       /* OK: there is a variant */
	char reason[120];           /* one line when there is none */
	unsigned passes;            /* how many times the variant was made */
	double cp, lcb_pct_lbp_fwd; /* of the variant, at the parent's draft */
} batten_vary_result;

/* batten_hull_vary() of many rows and the hydrostatics of every variant, in one go: count variants of
 * one parent. Either rows [count] of swing, one-minus-prismatic, lackenby or moor; options give the
 * method and what all rows have in common (its dcp, dlcb, dp_fore, dp_aft are not read). Or row_options
 * [count], each all that is asked of its row, of any methods; options is then not read. results [count].
 * The rest is the caller's, each may be NULL: y_m and nodes, both [count][waterlines][stations] on the
 * parent's table, of the four methods above only; out [count][draft_count], drafts_m NULL (draft_count
 * 1) taking each variant's own draft; outcomes [count], as of batten_hull_vary(), the formulas'
 * parameters and what can be reached of rows worked one by one only; hulls [count], to be destroyed. Of
 * a row that failed numbers are NaN, nodes OUTSIDE and the hull NULL; it stops no other.
 * Agrees with batten_hull_vary() and batten_hull_hydrostatics() within 1e-9 of each value; bit for bit
 * alike whatever the lanes, the batch, the order, the threads and (when strict) the device. Methods that
 * move no sections bodily, thesis, other rules than the spline, layouts with points off the grid, row
 * options that differ in more than these four numbers, and rows whose lines get gaps are worked one by
 * one on the host, shared out to its threads, by the functions named above: the same bits.
 * hydrostatics, batch and run may be NULL. Returns INCOMPLETE when a row failed. Errors: USAGE, INPUT (a
 * parent the method cannot take), DEVICE, KERNEL, MEMORY. */
typedef struct batten_variants {
	size_t count;
	const batten_vary_row *rows;
	size_t draft_count;
	const double *drafts_m;
	batten_vary_result *results;
	double *y_m;
	uint8_t *nodes;
	batten_hydrostatics *out;
	const batten_vary_options *row_options;
	batten_vary_outcome *outcomes;
	batten_hull **hulls;
} batten_variants;
BATTEN_API batten_status batten_hull_vary_measure(batten_context *context,
                                                  const batten_hull *parent,
                                                  const batten_vary_options *options,
                                                  const batten_hydrostatics_options *hydrostatics,
                                                  const batten_batch_options *batch,
                                                  const batten_variants *variants, batten_run *run);

#ifdef __cplusplus
}
#endif

#endif
