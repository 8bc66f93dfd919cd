/* Integrals over a surface by the divergence theorem (Letcher 9.4): volume and moments from the
 * y-component of the normal, the waterplane from its z-component. */
#include "hydrostatics/patch.h"

#include <math.h>

/* Sums over the half hull, with the normal by_v x by_u as it comes. */
struct sums {
	const struct patch *patch;
	double draft_m, weight_u;
	double volume_x, volume_y, volume_z; /* three forms of one volume */
	double moment_x, moment_z;
	double plane, plane_x, plane_xx, plane_yy;
	double wetted;
	double end_sign, end_area;
};

static void visit_surface(void *closure, double u, double v, double weight)
{
	struct sums *s = closure;
	surface_jet d;
	surface_evaluate(s->patch->surface, u, v, 1, d);
	const double *p = d[0][0], *by_u = d[1][0], *by_v = d[0][1];
	double w = weight * s->weight_u;
	double n_x = w * (by_v[1] * by_u[2] - by_v[2] * by_u[1]);
	double n_y = w * (by_v[2] * by_u[0] - by_v[0] * by_u[2]);
	double n_z = w * (by_v[0] * by_u[1] - by_v[1] * by_u[0]);
	s->volume_x += p[0] * n_x;
	s->volume_y += p[1] * n_y;
	s->volume_z += (p[2] - s->draft_m) * n_z;
	s->moment_x += p[0] * p[1] * n_y;
	s->moment_z += p[2] * p[1] * n_y;
	s->plane -= n_z;
	s->plane_x -= p[0] * n_z;
	s->plane_xx -= p[0] * p[0] * n_z;
	s->plane_yy -= p[1] * p[1] * n_z;
	s->wetted += sqrt(n_x * n_x + n_y * n_y + n_z * n_z);
}

/* The flat end of a hull: straight lines across from the edge to the centreplane, whose normals
 * have no y-component. */
static void visit_end(void *closure, double u, double v, double weight)
{
	struct sums *s = closure;
	surface_jet d;
	surface_evaluate(s->patch->surface, u, v, 1, d);
	const double *p = d[0][0], *by_v = d[0][1];
	double w = s->end_sign * weight;
	double n_x = w * by_v[2] * p[1], n_z = -w * by_v[0] * p[1];
	s->volume_x += p[0] * n_x;
	s->volume_z += (p[2] - s->draft_m) * n_z;
	s->plane -= n_z;
	s->plane_x -= p[0] * n_z;
	s->plane_xx -= p[0] * p[0] * n_z;
	s->plane_yy -= p[1] * p[1] * n_z / 3;
	s->end_area += sqrt(n_x * n_x + n_z * n_z);
}

/* From 0..1 to a piece of u. The waterline leaves a break as a square root where it runs into the
 * keel, so that there the parameter begins with its square. */
static double map_piece(bool cut_first, bool cut_last, double s, double *slope)
{
	if (cut_first && cut_last) {
		*slope = 6 * s * (1 - s);
		return s * s * (3 - 2 * s);
	}
	if (cut_first) {
		*slope = 2 * s;
		return s * s;
	}
	if (cut_last) {
		*slope = 2 * (1 - s);
		return s * (2 - s);
	}
	*slope = 1;
	return s;
}

static void add_piece(struct sums *sums, double from, double to, bool cut_first, bool cut_last)
{
	const struct patch *patch = sums->patch;
	for (size_t k = 0; k < patch->points && to > from; k++) {
		double slope;
		double part = map_piece(cut_first, cut_last, patch->nodes[k], &slope);
		sums->weight_u = (to - from) * slope * patch->weights[k];
		patch_along_v(patch, from + (to - from) * part, sums->draft_m, visit_surface, sums);
	}
}

static void add_ends(struct sums *sums)
{
	const struct patch *patch = sums->patch;
	sums->end_sign = -1;
	patch_along_v(patch, patch->u[0], sums->draft_m, visit_end, sums);
	sums->end_sign = 1;
	patch_along_v(patch, patch->u[patch->u_count], sums->draft_m, visit_end, sums);
}

void patch_integrate(const struct patch *patch, double draft_m, hydrostatics *out)
{
	struct sums s = { .patch = patch, .draft_m = draft_m };
	for (size_t i = 0; i < patch->u_count; i++) {
		size_t count = patch_breaks(patch, i, draft_m);
		double from = patch->u[i];
		for (size_t k = 0; k <= count; k++) {
			double to = k < count ? patch->breaks[k] : patch->u[i + 1];
			add_piece(&s, from, to, k > 0, k < count);
			from = to;
		}
	}
	add_ends(&s);
	/* u and v may run either way: an outward normal makes the volume positive */
	double side = s.volume_y < 0 ? -2 : 2;
	out->volume_m3 = side * s.volume_y;
	out->volume_moment_x_m4 = side * s.moment_x;
	out->volume_moment_z_m4 = side * s.moment_z;
	out->waterplane_area_m2 = side * s.plane;
	out->waterplane_moment_x_m3 = side * s.plane_x;
	out->longitudinal_second_moment_m4 = side * s.plane_xx;
	out->transverse_second_moment_m4 = side * s.plane_yy;
	out->wetted_surface_m2 = 2 * s.wetted;
	out->transom_area_m2 = 2 * s.end_area;
	double apart = fmax(fabs(s.volume_x - s.volume_y), fabs(s.volume_z - s.volume_y));
	out->volume_mismatch_pct = s.volume_y == 0 ? NAN : 100 * apart / fabs(s.volume_y);
}
