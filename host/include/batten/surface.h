/* batten.h, one part of it: B-spline surfaces: edited, fitted, evaluated on grids, many at a time. */
#ifndef BATTEN_SURFACE_H
#define BATTEN_SURFACE_H

#include "base.h"
#include "device.h"
#include "hull.h"
#include "search.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Surfaces: a hull as one tensor-product B-spline surface
 * --------------------------------------------------------------------------------------------- */

/* Poles, knots and weights of the half hull y >= 0 (thesis 3.2.3.2, Letcher 4.9-4.10). u runs along
 * the hull with x, v along the girth from keel to deck; the other way round the surface is the
 * same, but its normal, by_v x by_u, points inward. */
typedef struct batten_surface batten_surface;

/* What a surface is made of. Orders (degree + 1) 2..8; at least as many poles as the order and at
 * most 4096 in each direction. Knots do not decrease; count + order of them; u runs over
 * [knots_u[order_u - 1], knots_u[count_u]], v likewise. Inside it a knot that occurs order - 1
 * times is a knuckle; more is refused. */
typedef struct batten_surface_net {
	const char *name; /* NULL: "" */
	size_t order_u, order_v, count_u, count_v;
	const double *knots_u, *knots_v; /* NULL: uniform over 0..1, its ends repeated order times */
	const double *poles_m;           /* [count_v][count_u][3]: x, y, z */
	const double *weights;           /* [count_v][count_u], > 0; NULL: all 1 */
} batten_surface_net;

/* Copies the arrays. Errors: USAGE (one line says what is wrong with the net), MEMORY. */
BATTEN_API batten_status batten_surface_create(batten_context *context,
                                               const batten_surface_net *net, batten_surface **out);
BATTEN_API batten_status batten_surface_clone(batten_context *context,
                                              const batten_surface *surface, batten_surface **out);
BATTEN_API void batten_surface_destroy(batten_surface *surface);

/* Borrowed views, valid while the surface lives and is not changed. */
BATTEN_API batten_surface_net batten_surface_describe(const batten_surface *surface);

/* A direction of the net. */
typedef enum batten_direction {
	BATTEN_DIRECTION_U,
	BATTEN_DIRECTION_V,
} batten_direction;

/* The range of the parameter along a direction. */
BATTEN_API void batten_surface_range(const batten_surface *surface, batten_direction direction,
                                     double *first, double *last);

/* A point of a surface. derivative[i][j] is the derivative i times by u and j times by v, for
 * i + j <= 3 (the others are 0): x, y, z; derivative[0][0] is the point. */
typedef struct batten_surface_point {
	double derivative[4][4][3];
} batten_surface_point;

/* Beyond its range a surface goes on with its first or last polynomials. Errors: USAGE (u or v is
 * not finite). */
BATTEN_API batten_status batten_surface_evaluate(const batten_surface *surface, double u, double v,
                                                 batten_surface_point *out);

/* Changes in place. A surface is left untouched when one fails; errors are recorded in the context
 * it was created in. */

/* Replaces the poles, as batten_surface_net has them. Errors: USAGE (not finite, beyond 1e9 m). */
BATTEN_API batten_status batten_surface_set_poles(batten_surface *surface, const double *poles_m);

/* Inserts the knot t times times; every point stays where it is. Errors: USAGE (t is not inside the
 * range, or would occur more than order - 1 times), MEMORY. */
BATTEN_API batten_status batten_surface_insert_knot(batten_surface *surface,
                                                    batten_direction direction, double t,
                                                    size_t times);

/* Raises the order by times; every point stays where it is. Errors: USAGE (beyond order 8 or 4096
 * poles), MEMORY. */
BATTEN_API batten_status batten_surface_elevate(batten_surface *surface, batten_direction direction,
                                                size_t times);

/* Runs one direction the other way over the same range; the normal turns round. */
BATTEN_API void batten_surface_reverse(batten_surface *surface, batten_direction direction);

/* p -> matrix p + shift for every point p; matrix by rows. Errors: USAGE (a pole would not be
 * finite, or beyond 1e9 m). */
BATTEN_API batten_status batten_surface_map(batten_surface *surface, const double matrix[9],
                                            const double shift_m[3]);

/* The matrix, by rows, that turns by an angle about an axis of any length, counterclockwise to who looks
 * against it (Letcher 2.3): about x it turns y to z. Errors: USAGE (not finite, an axis of 0). */
BATTEN_API batten_status batten_rotation(batten_context *context, const double axis[3],
                                         double angle_rad, double out[9]);

/* The image in the centreplane y = 0: starboard from port. u then runs the other way, so that the
 * normal keeps its side. */
BATTEN_API void batten_surface_mirror(batten_surface *surface);

/* ------------------------------------------------------------------------------------------------
 * A surface through the offsets of a hull
 * --------------------------------------------------------------------------------------------- */

/* Edges of the surface that leave the centreplane square to it, so that the mirrored half goes on
 * with the same curvature (Letcher 3.12, 4.13). */
#define BATTEN_ROUNDED_KEEL 1u
#define BATTEN_ROUNDED_STERN 2u
#define BATTEN_ROUNDED_STEM 4u

typedef struct batten_fit_options {
	size_t struct_size;
	size_t order_u, order_v;   /* degree + 1, 2..8: 4, 4 */
	size_t count_u, count_v;   /* poles along the hull and from keel to deck; no default */
	bool hold_centreplane;     /* edges whose points all have y = 0 keep y = 0 throughout; true */
	unsigned rounded;          /* BATTEN_ROUNDED_...; such an edge must lie in the centreplane; 0 */
	unsigned correction_limit; /* rounds of better parameters for the points; 20 */
	double stiffness; /* how much straightness of the net counts against the points: 1e-12..1; 1e-6.
	                     More keeps poles that few points determine from running away */
} batten_fit_options;
BATTEN_API void batten_fit_options_default(batten_fit_options *options);

/* How far a surface is from the offsets it was fitted to: distances of the points from the surface,
 * nearest point each. */
typedef struct batten_fit_deviation {
	size_t point_count; /* offsets given, profile points and line ends included */
	double rms_m, max_m;
	double rms_pct, max_pct; /* of the half-beam */
	double x_m, y_m, z_m;    /* the point that is farthest off */
	unsigned corrections;    /* rounds made */
} batten_fit_deviation;

/* Fits a surface to the points of a hull by least squares; a net of as many poles as points, on a
 * full table, goes through them. The edges of the surface follow keel, stem, stern and the highest
 * points of the sections; where a section does not reach the keel, its keel point is put on the
 * line through the profile points beside it. Knuckles of the sections join to lines along the hull,
 * those of the waterlines to lines up the girth; each becomes a knot repeated order - 1 times, where
 * the surface keeps its crease (Letcher 4.4). deviation may be NULL. Errors: USAGE (orders, counts, a
 * rounded edge that is not in the centreplane), INPUT (fewer points than poles, too few along one
 * direction or where a pole is; knuckles that do not join to lines, or more lines than the poles can
 * hold), MEMORY. */
BATTEN_API batten_status batten_hull_fit(batten_context *context, const batten_hull *hull,
                                         const batten_fit_options *options, batten_surface **out,
                                         batten_fit_deviation *deviation);

/* surface.json (data/schema/surface.schema.json): metres, frame ap-fwd, every number as it reads
 * back. Errors: IO, INPUT (one line: what is wrong and where), MEMORY. */
BATTEN_API batten_status batten_surface_read(batten_context *context, const char *path,
                                             batten_surface **out);
/* Same, from memory; name stands for the file in messages. */
BATTEN_API batten_status batten_surface_parse(batten_context *context, const char *name,
                                              const char *text, size_t length,
                                              batten_surface **out);
/* Errors: IO, MEMORY. */
BATTEN_API batten_status batten_surface_write(batten_context *context,
                                              const batten_surface *surface, const char *path);

/* The surfaces of a file, and what was left out of it. */
typedef struct batten_surfaces batten_surfaces;

/* Reads surfaces by the ending of path: .json (one surface), .igs or .iges (IGES, entity 128), .stp or
 * .step (STEP, B-spline surfaces with knots). IGES and STEP are read by OpenCASCADE, an optional
 * package, in a child process that ends with the call. Any unit becomes metres; axes are taken as
 * they are. Poles, knots and weights are the numbers of the file times its unit. A face is taken where
 * it is the whole of its surface; trimmed ones, other entities, periodic surfaces and those beyond the
 * limits of batten_surface_net are left out, each kind with a warning, in the log too. Errors: USAGE
 * (another ending), MISSING (batten was built without OpenCASCADE), IO, INPUT (damaged, an assembly,
 * or no surface to be had), MEMORY. */
BATTEN_API batten_status batten_surfaces_read(batten_context *context, const char *path,
                                              batten_surfaces **out);
BATTEN_API void batten_surfaces_destroy(batten_surfaces *surfaces);

/* Borrowed, in the order of the file; NULL beyond the count. */
BATTEN_API size_t batten_surfaces_count(const batten_surfaces *surfaces);
BATTEN_API const batten_surface *batten_surfaces_at(const batten_surfaces *surfaces, size_t i);

/* What was left out, a line each (1000 at most). */
BATTEN_API size_t batten_surfaces_warning_count(const batten_surfaces *surfaces);
BATTEN_API const char *batten_surfaces_warning(const batten_surfaces *surfaces, size_t i);

/* Writes count >= 1 surfaces in the format of the ending, as above: metres, frame ap-fwd, names, 17
 * digits, so that every number reads back as it was, but those below 1e-99, which are written as 0.
 * Errors: USAGE (another ending, several surfaces to .json, a weight below 1e-6 or knots spanning less
 * than 1e-80 to the others), MISSING, IO, MEMORY, INTERNAL. */
BATTEN_API batten_status batten_surfaces_write(batten_context *context, size_t count,
                                               const batten_surface *const *surfaces,
                                               const char *path);

/* ------------------------------------------------------------------------------------------------
 * Surfaces on a grid, many at a time
 * --------------------------------------------------------------------------------------------- */

/* What is known of a surface at one (u, v). The normal is by_v x by_u made a unit, outward for a
 * hull whose u runs forward and whose v runs up; a curvature is positive where the surface bends
 * towards it, so a convex hull's are negative (Letcher 4.2-4.3).
 *
 * Principal directions lie square to each other in the tangent plane; either sense of one is right.
 * They are 0 at umbilics: where half of k1 - k2 is not larger than 1e-10 (f32: 1e-5) times
 * sqrt((|by_uu| G)^2 + |by_uv|^2 E G + (|by_vv| E)^2) / area^2, the curvature that the second
 * derivatives could make. along_x and across_x are curvatures of the surface (of its normal sections),
 * not of the section line, and add up to 2 H; both are 0 where the x axis and the normal are the same
 * within 1e-10 (f32: 1e-5) radians, as on a flat transom: there is no direction then. Isophotes are
 * lines along which normal times light is constant (Letcher 4.5). */
#define BATTEN_SURFACE_VALUE_LIST(X)                                                               \
	X(x, "position")                                                                               \
	X(y, "position")                                                                               \
	X(z, "position")                                                                               \
	X(x_u, "first derivative along u")                                                             \
	X(y_u, "first derivative along u")                                                             \
	X(z_u, "first derivative along u")                                                             \
	X(x_v, "first derivative along v")                                                             \
	X(y_v, "first derivative along v")                                                             \
	X(z_v, "first derivative along v")                                                             \
	X(x_uu, "second derivative along u")                                                           \
	X(y_uu, "second derivative along u")                                                           \
	X(z_uu, "second derivative along u")                                                           \
	X(x_uv, "mixed derivative")                                                                    \
	X(y_uv, "mixed derivative")                                                                    \
	X(z_uv, "mixed derivative")                                                                    \
	X(x_vv, "second derivative along v")                                                           \
	X(y_vv, "second derivative along v")                                                           \
	X(z_vv, "second derivative along v")                                                           \
	X(first_uu, "first fundamental form, E")                                                       \
	X(first_uv, "first fundamental form, F")                                                       \
	X(first_vv, "first fundamental form, G")                                                       \
	X(area, "area element |by_v x by_u|")                                                          \
	X(normal_x, "unit normal")                                                                     \
	X(normal_y, "unit normal")                                                                     \
	X(normal_z, "unit normal")                                                                     \
	X(second_uu, "second fundamental form, e")                                                     \
	X(second_uv, "second fundamental form, f")                                                     \
	X(second_vv, "second fundamental form, g")                                                     \
	X(gauss, "Gaussian curvature, K")                                                              \
	X(mean, "mean curvature, H")                                                                   \
	X(k1, "greater principal curvature")                                                           \
	X(k2, "smaller principal curvature")                                                           \
	X(bending, "k1^2 + k2^2")                                                                      \
	X(direction1_x, "unit tangent in whose direction the surface bends by k1")                     \
	X(direction1_y, "unit tangent in whose direction the surface bends by k1")                     \
	X(direction1_z, "unit tangent in whose direction the surface bends by k1")                     \
	X(direction2_x, "unit tangent in whose direction the surface bends by k2")                     \
	X(direction2_y, "unit tangent in whose direction the surface bends by k2")                     \
	X(direction2_z, "unit tangent in whose direction the surface bends by k2")                     \
	X(along_x, "normal curvature along the x axis projected on the tangent plane")                 \
	X(across_x, "normal curvature square to it, along the section x = constant")                   \
	X(isophote, "normal times the direction of the light")

typedef enum batten_surface_value {
#define BATTEN_SURFACE_VALUE_ENTRY(name, text) BATTEN_SURFACE_VALUE_##name,
	BATTEN_SURFACE_VALUE_LIST(BATTEN_SURFACE_VALUE_ENTRY)
#undef BATTEN_SURFACE_VALUE_ENTRY
		BATTEN_SURFACE_VALUE_COUNT,
} batten_surface_value;

/* Which of them a batch keeps. */
typedef enum batten_surface_output {
	BATTEN_SURFACE_POSITION,   /* x, y, z */
	BATTEN_SURFACE_CURVATURE,  /* gauss, mean */
	BATTEN_SURFACE_EVERYTHING, /* all, in the order of the list */
} batten_surface_output;

/* Values a point has: 3, 2 or BATTEN_SURFACE_VALUE_COUNT; 0 for no such output. */
BATTEN_API size_t batten_surface_output_count(batten_surface_output output);

/* The parameters at which every surface of a batch is sampled: 1..65536 each way, within the range
 * of the knots, in any order. */
typedef struct batten_surface_samples {
	size_t u_count, v_count;
	const double *u, *v;
} batten_surface_samples;

typedef struct batten_surface_batch_options {
	size_t struct_size;
	int device; /* an index of batten_device_count(), or AUTO, REFERENCE */
	batten_precision precision;
	batten_surface_output output; /* of batten_surface_grid_batch(); BATTEN_SURFACE_CURVATURE */
	/* Towards the light of isophotes: of any length, finite and not 0; (0, 1, 0), from port. */
	double light[3];
	unsigned gauss_points; /* of batten_surface_energy_batch(), a knot span and direction,
	                                 1..16; 0 takes the order of the direction + 1 */
	bool variation;        /* of batten_surface_energy_batch(): the variation of curvature too, at
	                                 two to three times the work; false */
	unsigned lanes;        /* surfaces a work-item works side by side: 1, 2, 4, 8, 16;
	                                 0 chooses */
	unsigned work_group;   /* work-items that share a line of samples; 0 chooses */
} batten_surface_batch_options;
BATTEN_API void batten_surface_batch_options_default(batten_surface_batch_options *options);

/* Evaluates count surfaces of one topology (equal orders, counts and knots, all rational or none)
 * at the samples. values is the caller's, [count][values of the output][v_count][u_count]; singular
 * [count][v_count][u_count] may be NULL. Where the normal does not exist (a pole of the sphere,
 * both derivatives parallel) singular is 1 and everything that needs the normal is 0; nothing is ever
 * NaN. options and run may be NULL. The result of a surface does not depend on the others, on their
 * order or number, nor (when run->strict) on what ran it. Errors: USAGE, DEVICE, KERNEL, MEMORY. */
BATTEN_API batten_status batten_surface_grid_batch(batten_context *context, size_t count,
                                                   const batten_surface *const *surfaces,
                                                   const batten_surface_samples *samples,
                                                   const batten_surface_batch_options *options,
                                                   double *values, uint8_t *singular,
                                                   batten_run *run);

/* The same with the values as the floats they are computed in, without what widening and writing twice
 * as much costs; each is what batten_surface_grid_batch() gives. options->precision is to be f32. */
BATTEN_API batten_status batten_surface_grid_batch_float(
	batten_context *context, size_t count, const batten_surface *const *surfaces,
	const batten_surface_samples *samples, const batten_surface_batch_options *options,
	float *values, uint8_t *singular, batten_run *run);

/* Lines on a surface along which one of its values has a level (Letcher 4.19): sections, waterlines and
 * buttocks are those of x, z and y, lines of highlights those of the isophote value. */
typedef struct batten_contours batten_contours;

/* One of them; the arrays are borrowed. */
typedef struct batten_contour {
	size_t count;           /* points; 2 or more but where a line has one */
	bool closed;            /* the last point is joined to the first, which is not repeated */
	const double *u, *v;    /* [count] */
	const double *points_m; /* [count][3] */
} batten_contour;

/* Finds them over a mesh of at least 2 x 2 parameters in ascending order. Points lie where lines cross
 * those of the mesh, on the surface and at the level to its rounding; what happens between two lines of the
 * mesh is not seen. A point at the level counts as above it, so that lines that only touch the level are
 * not found. Lines end at the edges of the mesh and in its cells with a corner that has no normal, where
 * the value needs one. Light is from port. Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_surface_contour(batten_context *context,
                                                const batten_surface *surface,
                                                batten_surface_value value, double level,
                                                const batten_surface_samples *samples,
                                                batten_contours **out);
BATTEN_API void batten_contours_destroy(batten_contours *contours);
BATTEN_API size_t batten_contours_count(const batten_contours *contours);
/* Empty beyond the count. */
BATTEN_API batten_contour batten_contours_at(const batten_contours *contours, size_t i);

/* Integrals over a whole surface (thesis 4.4, Letcher 4.5; Moreton and Sequin 1992); points where the
 * normal does not exist count nothing. Principal directions, and so the variation of curvature along
 * them, exist where |k1 - k2| is more than 1e-6 (f32: 1e-3) of sqrt(k1^2 + k2^2). */
typedef struct batten_surface_energies {
	double bending;  /* of (k1^2 + k2^2) dA */
	double mean;     /* of H^2 dA */
	double gauss;    /* of |K| dA */
	double area_m2;  /* of dA */
	size_t singular; /* points left out */
	/* With options->variation, else 0. */
	double variation_per_m2;   /* of ((dk1/de1)^2 + (dk2/de2)^2) dA */
	size_t variation_left_out; /* points that add nothing to it, singular ones among them */
} batten_surface_energies;

/* Gauss quadrature over every knot span of count surfaces of one topology; energies is the
 * caller's, [count]. As batten_surface_grid_batch() otherwise. */
BATTEN_API batten_status batten_surface_energy_batch(batten_context *context, size_t count,
                                                     const batten_surface *const *surfaces,
                                                     const batten_surface_batch_options *options,
                                                     batten_surface_energies *energies,
                                                     batten_run *run);

/* The same of any number of surfaces of one topology in bounded memory: as many at a time as suit the
 * devices, so that memory follows from the samples, not from how many surfaces there are.
 *
 * The source is asked for surface 0, 1, 2 ... and gives each to batten, which destroys it; NULL ends
 * the stream. The sinks get the results in the same order, values as the batch has them for one
 * surface, valid during the call. What they return other than OK ends the stream and is its status;
 * nothing is asked for or handed over afterwards, and what was taken is destroyed. Source and sink are
 * called by the thread that called, one at a time. */
typedef batten_status (*batten_surface_source)(void *user, size_t index, batten_surface **out);
typedef batten_status (*batten_surface_grid_sink)(void *user, size_t index, const double *values,
                                                  const uint8_t *singular);
typedef batten_status (*batten_surface_energy_sink)(void *user, size_t index,
                                                    const batten_surface_energies *energies);

/* count, run: may be NULL; count gets how many surfaces the sink was given, also on failure. run as of
 * the batches together: strict when all were, the first warning. A stream without any surface is OK.
 * Errors: as the batch, a surface unlike surface 0 among them; those of source and sink. */
BATTEN_API batten_status batten_surface_grid_stream(batten_context *context,
                                                    batten_surface_source source,
                                                    batten_surface_grid_sink sink, void *user,
                                                    const batten_surface_samples *samples,
                                                    const batten_surface_batch_options *options,
                                                    size_t *count, batten_run *run);
BATTEN_API batten_status batten_surface_energy_stream(batten_context *context,
                                                      batten_surface_source source,
                                                      batten_surface_energy_sink sink, void *user,
                                                      const batten_surface_batch_options *options,
                                                      size_t *count, batten_run *run);

#ifdef __cplusplus
}
#endif

#endif
