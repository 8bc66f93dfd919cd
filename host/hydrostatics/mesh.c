#include "hydrostatics/mesh.h"

#include <math.h>
#include <string.h>

typedef struct mesh_point {
	double at[3]; /* z from the waterline */
} mesh_point;

static mesh_point point_between(const mesh_point *below, const mesh_point *above)
{
	double part = below->at[2] / (below->at[2] - above->at[2]);
	mesh_point point = { { 0 } };
	for (size_t c = 0; c < 2; c++)
		point.at[c] = below->at[c] + part * (above->at[c] - below->at[c]);
	return point;
}

/* The part of a polygon below the waterline (Sutherland and Hodgman); room for one more point. */
static size_t clip(const mesh_point *in, size_t count, mesh_point *out)
{
	size_t kept = 0;
	for (size_t i = 0; i < count; i++) {
		const mesh_point *a = &in[i], *b = &in[(i + 1) % count];
		bool a_wet = a->at[2] <= 0, b_wet = b->at[2] <= 0;
		if (a_wet)
			out[kept++] = *a;
		if (a_wet != b_wet)
			out[kept++] = a_wet ? point_between(a, b) : point_between(b, a);
	}
	return kept;
}

static mesh_point vertex_at(const mesh_arrays *mesh, uint32_t vertex, double draft_m)
{
	const double *p = mesh->vertices + 3 * (size_t)vertex;
	return (mesh_point){ { p[0], p[1], p[2] - draft_m } };
}

struct mesh_sums {
	double draft_m;
	double volume_x, volume_y, volume_z;
	double moment_x, moment_z; /* moment_z about the waterline */
	double plane, plane_x, plane_xx, plane_yy, wetted, ends;
	double aft_m, fore_m, half_breadth_m; /* of the waterline */
};

/* The prism between a triangle and the waterplane, from the sums over the corners (Letcher 9.4, with
 * the sign that makes a volume below the waterline positive). */
static void add_triangle(struct mesh_sums *s, const double *a, const double *b, const double *c)
{
	double ab[3], ac[3], sum[3], squares[3], x_z = 0;
	for (size_t k = 0; k < 3; k++) {
		ab[k] = b[k] - a[k];
		ac[k] = c[k] - a[k];
		sum[k] = a[k] + b[k] + c[k];
		squares[k] = a[k] * a[k] + b[k] * b[k] + c[k] * c[k];
	}
	x_z = a[0] * a[2] + b[0] * b[2] + c[0] * c[2];
	double n_x = 0.5 * (ab[1] * ac[2] - ab[2] * ac[1]);
	double n_y = 0.5 * (ab[2] * ac[0] - ab[0] * ac[2]);
	double n_z = 0.5 * (ab[0] * ac[1] - ab[1] * ac[0]);
	double down = -n_z;
	s->volume_x += n_x * sum[0] / 3;
	s->volume_y += n_y * sum[1] / 3;
	s->volume_z -= down * sum[2] / 3;
	s->moment_x -= down * (sum[0] * sum[2] + x_z) / 12;
	s->moment_z -= down * (sum[2] * sum[2] + squares[2]) / 24;
	s->plane += down;
	s->plane_x += down * sum[0] / 3;
	s->plane_xx += down * (sum[0] * sum[0] + squares[0]) / 12;
	s->plane_yy += down * (sum[1] * sum[1] + squares[1]) / 12;
	s->wetted += sqrt(n_x * n_x + n_y * n_y + n_z * n_z);
}

static void add_polygon(struct mesh_sums *s, const mesh_point *polygon, size_t count, double near)
{
	for (size_t i = 1; i + 1 < count; i++)
		add_triangle(s, polygon[0].at, polygon[i].at, polygon[i + 1].at);
	for (size_t i = 0; i < count; i++) {
		const double *p = polygon[i].at;
		if (fabs(p[2]) > near)
			continue;
		s->aft_m = fmin(s->aft_m, p[0]);
		s->fore_m = fmax(s->fore_m, p[0]);
		s->half_breadth_m = fmax(s->half_breadth_m, fabs(p[1]));
	}
}

/* Integral of y dz along the part of a straight line below the waterline. */
static double below_waterline(mesh_point from, mesh_point to)
{
	if (from.at[2] > 0 && to.at[2] > 0)
		return 0;
	if (from.at[2] > 0)
		from = point_between(&to, &from);
	else if (to.at[2] > 0)
		to = point_between(&from, &to);
	return 0.5 * (from.at[1] + to.at[1]) * (to.at[2] - from.at[2]);
}

/* The end planes that open edges lie in stand for the panel that is not there. Its edge runs the
 * other way round than the triangles' do. */
static void add_ends(const mesh_arrays *mesh, struct mesh_sums *s)
{
	const double near = 1e-9 * (mesh->foremost_m - mesh->aftmost_m);
	for (int fore = 0; fore < 2; fore++) {
		double x = fore ? mesh->foremost_m : mesh->aftmost_m, area = 0;
		for (size_t i = 0; i < mesh->open_count; i++) {
			mesh_point from = vertex_at(mesh, mesh->open[i].from, s->draft_m);
			mesh_point to = vertex_at(mesh, mesh->open[i].to, s->draft_m);
			if (fabs(from.at[0] - x) <= near && fabs(to.at[0] - x) <= near)
				area -= below_waterline(from, to);
		}
		s->volume_x += x * area;
		s->ends += fabs(area);
	}
}

void mesh_integrate(const mesh_arrays *mesh, double draft_m, hydrostatics *out)
{
	struct mesh_sums s = {
		.draft_m = draft_m, .aft_m = INFINITY, .fore_m = -INFINITY, .half_breadth_m = -INFINITY
	};
	const double near = 1e-9 * (mesh->highest_m - mesh->lowest_m);
	for (size_t t = 0; t < mesh->triangle_count; t++) {
		mesh_point corners[3], polygon[4];
		for (size_t k = 0; k < 3; k++)
			corners[k] = vertex_at(mesh, mesh->triangles[3 * t + k], draft_m);
		add_polygon(&s, polygon, clip(corners, 3, polygon), near);
	}
	add_ends(mesh, &s);
	double sides = mesh->half ? 2 : 1;
	bool afloat = s.fore_m >= s.aft_m;
	*out = (hydrostatics){
		.volume_m3 = sides * s.volume_z,
		.volume_moment_x_m4 = sides * s.moment_x,
		.volume_moment_z_m4 = sides * (s.moment_z + draft_m * s.volume_z),
		.wetted_surface_m2 = sides * s.wetted,
		.transom_area_m2 = sides * s.ends,
		.waterline_length_m = afloat ? s.fore_m - s.aft_m : NAN,
		.waterline_half_breadth_m = afloat ? s.half_breadth_m : NAN,
		.waterplane_area_m2 = sides * s.plane,
		.waterplane_moment_x_m3 = sides * s.plane_x,
		.transverse_second_moment_m4 = sides * s.plane_yy,
		.longitudinal_second_moment_m4 = sides * s.plane_xx,
	};
	double apart = fmax(fabs(s.volume_x - s.volume_z), fabs(s.volume_y - s.volume_z));
	out->volume_mismatch_pct = s.volume_z == 0 ? NAN : 100 * apart / fabs(s.volume_z);
}

/* Where a side of a triangle passes x, as a point of the section. */
static mesh_point point_at(const mesh_point *aft, const mesh_point *fore, double x_m)
{
	double part = (x_m - aft->at[0]) / (fore->at[0] - aft->at[0]);
	mesh_point point = { { x_m } };
	for (size_t c = 1; c < 3; c++)
		point.at[c] = aft->at[c] + part * (fore->at[c] - aft->at[c]);
	return point;
}

double mesh_section_area(const mesh_arrays *mesh, double x_m, double draft_m)
{
	double area = 0;
	for (size_t t = 0; t < mesh->triangle_count; t++) {
		mesh_point corners[3], out_of = { { 0 } }, into = { { 0 } };
		bool cut = false;
		for (size_t k = 0; k < 3; k++)
			corners[k] = vertex_at(mesh, mesh->triangles[3 * t + k], draft_m);
		for (size_t k = 0; k < 3; k++) {
			const mesh_point *a = &corners[k], *b = &corners[(k + 1) % 3];
			bool a_aft = a->at[0] < x_m, b_aft = b->at[0] < x_m;
			if (a_aft == b_aft)
				continue;
			cut = true;
			if (a_aft)
				out_of = point_at(a, b, x_m);
			else
				into = point_at(b, a, x_m);
		}
		/* the part aft of x is bounded by the line from out_of to into; the section seen from the
		 * water is to its other side */
		if (cut)
			area += below_waterline(into, out_of);
	}
	return (mesh->half ? 2 : 1) * area;
}
