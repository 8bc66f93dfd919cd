/* A surface through the offsets of a hull by least squares: the parts of batten_hull_fit().
 *
 * fit_ends     where the lines of the table end
 * fit_outline  where keel, stem, stern and deck run in it
 * fit_points   the points with their parameters, from the outline, and the knots
 * fit_knuckles parameters and knots where the hull has knuckle lines
 * fit_net      the linear system: which pole is which unknown, normal equations, solution
 * fit_nearest  the point of a surface that is nearest to a point of the hull */
#ifndef BATTEN_GEOMETRY_FIT_H
#define BATTEN_GEOMETRY_FIT_H

#include "geometry/surface.h"
#include "hull/hull.h"

/* ------------------------------------------------------------------------------------------------
 * Outline
 * --------------------------------------------------------------------------------------------- */

/* One line of the profile. */
struct fit_line {
	size_t count;
	double *at, *value; /* at ascends */
};

struct fit_outline {
	batten_context *context;
	struct fit_line low, high;   /* z against x: lowest point of the hull, highest given one */
	struct fit_line stern, stem; /* x against z: the ends above the corners */
	size_t closed_count;         /* keel points that the table does not give */
	double *closed_x, *closed_z;
};

/* Errors: INPUT (no two stations with points), MEMORY. */
batten_status fit_outline_create(const batten_hull *hull, struct fit_outline *out);
void fit_outline_destroy(struct fit_outline *outline);

/* Between its places linear, beyond them constant. */
double fit_line_value(const struct fit_line *line, double at);

/* ------------------------------------------------------------------------------------------------
 * Points
 * --------------------------------------------------------------------------------------------- */

/* How the height of a point in its section becomes v. */
enum fit_girth {
	FIT_GIRTH_HEIGHT, /* part of the section's height */
	FIT_GIRTH_CHORD,  /* part of the section's girth, by chords */
};

struct fit_point {
	double place[3];
	double u, v;
	bool on_u, on_v;           /* on an edge, which it does not leave */
	bool given;                /* else put there: counts in the fit, not in the deviation */
	size_t station, waterline; /* SIZE_MAX off the stations, off the waterlines */
};

struct fit_points {
	batten_context *context;
	size_t count, given_count;
	struct fit_point *point;
	struct fit_point *mark; /* places of the hull's knuckles, in their order; y is unknown */
	/* Parameters of the knuckle lines, ascending: [0] where u is constant, [1] where v is. */
	size_t crease_count[2];
	double *crease[2];
};

/* Points with u and v. Errors: INPUT (knuckles that do not join to lines), MEMORY. */
batten_status fit_points_create(const batten_hull *hull, const struct fit_outline *outline,
                                enum fit_girth girth, struct fit_points *out);
void fit_points_destroy(struct fit_points *points);

/* Knots of the surface, spread as the points are. Errors: INPUT (fewer points than poles),
 * MEMORY. */
batten_status fit_points_knots(const batten_hull *hull, const struct fit_points *points,
                               struct batten_surface *surface);

/* Numbers of the points of every station (waterline) i: order[start[i]] up to order[start[i + 1]];
 * both released by the caller, whatever is returned. Errors: MEMORY. */
batten_status fit_points_by_line(const struct fit_points *points, bool waterline, size_t lines,
                                 size_t **start, size_t **order);

/* Bends the parameters of the points so that every knuckle line has one parameter, which becomes a
 * crease. Errors: INPUT (knuckles that do not join to lines), MEMORY. */
batten_status fit_knuckles_straighten(const batten_hull *hull, struct fit_points *points);

/* Whether a crease lies between two parameters. */
bool fit_knuckles_crossed(const struct fit_points *points, bool along_v, double from, double to);

/* As bspline_knots_spread(), with the creases as knots repeated order - 1 times; line ("section")
 * stands for what the poles run along. Errors: INPUT (too few poles or points), MEMORY. */
batten_status fit_knuckles_knots(batten_context *context, const char *line,
                                 const struct fit_points *points, bool along_v, size_t order,
                                 size_t poles, size_t count, const double *parameters,
                                 double *knots);

/* v by chords instead of by height, for points as fit_points_create() fills them. */
batten_status fit_girth_by_chords(const batten_hull *hull, struct fit_points *points,
                                  const struct fit_outline *outline);

/* ------------------------------------------------------------------------------------------------
 * Net
 * --------------------------------------------------------------------------------------------- */

/* Which edges are held, and how. */
struct fit_edges {
	bool keel_flat, stern_flat, stem_flat; /* y = 0 */
	unsigned rounded;                      /* BATTEN_ROUNDED_... */
};

/* Poles of surface by least squares over the points at their parameters. Where the points leave a pole
 * free, fill lets the net go on straight, with stiffness as in batten_fit_options; without fill
 * *free_pole gets the number (count_u of a row) of such a pole and the net is void. *free_pole is
 * SIZE_MAX where there is a net. Errors: MEMORY. */
batten_status fit_net_solve(const struct fit_points *points, const struct fit_edges *edges,
                            double stiffness, struct batten_surface *surface, bool fill,
                            size_t *free_pole);

/* ------------------------------------------------------------------------------------------------
 * Distance
 * --------------------------------------------------------------------------------------------- */

/* Distance of place from the nearest point of surface near (*u, *v), both moved there; never
 * farther than where it began. A parameter that is held stays. */
double fit_nearest(const struct batten_surface *surface, const double place[3], bool hold_u,
                   bool hold_v, double *u, double *v);

#endif
