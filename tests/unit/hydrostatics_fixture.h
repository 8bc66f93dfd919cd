/* What the tests of hydrostatics over drafts share: forms as surfaces and as meshes. */
#ifndef BATTEN_TESTS_HYDROSTATICS_FIXTURE_H
#define BATTEN_TESTS_HYDROSTATICS_FIXTURE_H

#include "unit/measures_fixture.h"

static const double pi = 3.14159265358979323846;

static inline void assert_near(double value, double expected, double tolerance)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%.17g where %.17g is expected", value, expected);
}

static inline batten_hydrostatics_options with_lbp(double lbp_m)
{
	batten_hydrostatics_options options;
	batten_hydrostatics_options_default(&options);
	options.lbp_m = lbp_m;
	return options;
}

/* ------------------------------------------------------------------------------------------------
 * Surfaces
 * --------------------------------------------------------------------------------------------- */

static inline batten_surface *make_surface(batten_context *context, const batten_surface_net *net)
{
	batten_surface *surface = NULL;
	if (batten_surface_create(context, net, &surface) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return surface;
}

/* Wigley's hull L x B, depth D, as one biquadratic patch (Letcher 4.1). */
static inline batten_surface *wigley_surface(batten_context *context, double length, double beam,
                                             double depth)
{
	static const double a[3] = { 0, 2, 0 }, c[3] = { 0, 1, 1 };
	double poles[27];
	for (size_t j = 0; j < 3; j++)
		for (size_t i = 0; i < 3; i++) {
			double *p = poles + 3 * (3 * j + i);
			p[0] = 0.5 * length * (double)i;
			p[1] = 0.5 * beam * a[i] * c[j];
			p[2] = 0.5 * depth * (double)j;
		}
	return make_surface(context,
	                    &(batten_surface_net){ "wigley", 3, 3, 3, 3, NULL, NULL, poles, NULL });
}

/* A prism of length L: the section as a polyline from the keel up. */
static inline batten_surface *prism_surface(batten_context *context, double length, size_t count,
                                            const double section[][2])
{
	double poles[3 * 2 * 4];
	assert_true(count <= 4);
	for (size_t j = 0; j < count; j++)
		for (size_t i = 0; i < 2; i++) {
			double *p = poles + 3 * (2 * j + i);
			p[0] = length * (double)i;
			p[1] = section[j][0];
			p[2] = section[j][1];
		}
	return make_surface(context,
	                    &(batten_surface_net){ "prism", 2, 2, 2, count, NULL, NULL, poles, NULL });
}

/* The lower half of an ellipsoid, L x B x T, keel at z = 0: quarters of circles as rational
 * parabolas (Letcher 3.8). Its ends are poles of the sphere. */
static inline batten_surface *ellipsoid_surface(batten_context *context, double length, double beam,
                                                double depth)
{
	static const double along[5][2] = { { -1, 0 }, { -1, 1 }, { 0, 1 }, { 1, 1 }, { 1, 0 } };
	static const double round[3][2] = { { 0, 1 }, { 1, 1 }, { 1, 0 } };
	static const double knots_u[8] = { 0, 0, 0, 1, 1, 2, 2, 2 };
	const double corner = sqrt(0.5);
	double poles[45], weights[15];
	for (size_t j = 0; j < 3; j++)
		for (size_t i = 0; i < 5; i++) {
			double *p = poles + 3 * (5 * j + i);
			p[0] = 0.5 * length * (1 + along[i][0]);
			p[1] = 0.5 * beam * along[i][1] * round[j][0];
			p[2] = depth * (1 - along[i][1] * round[j][1]);
			weights[5 * j + i] = (i % 2 ? corner : 1) * (j % 2 ? corner : 1);
		}
	return make_surface(
		context, &(batten_surface_net){ "ellipsoid", 3, 3, 5, 3, knots_u, NULL, poles, weights });
}

/* The lower half of a cylinder. */
static inline batten_surface *cylinder_surface(batten_context *context, double length,
                                               double radius)
{
	static const double round[3][2] = { { 0, 1 }, { 1, 1 }, { 1, 0 } };
	double poles[18], weights[6];
	for (size_t j = 0; j < 3; j++)
		for (size_t i = 0; i < 2; i++) {
			double *p = poles + 3 * (2 * j + i);
			p[0] = length * (double)i;
			p[1] = radius * round[j][0];
			p[2] = radius * (1 - round[j][1]);
			weights[2 * j + i] = j % 2 ? sqrt(0.5) : 1;
		}
	return make_surface(
		context, &(batten_surface_net){ "cylinder", 2, 3, 2, 3, NULL, NULL, poles, weights });
}

static inline batten_hydrostatics surface_at(batten_context *context, const batten_surface *surface,
                                             const batten_hydrostatics_options *options,
                                             double draft_m)
{
	batten_hydrostatics found;
	if (batten_surface_hydrostatics(context, surface, options, 1, &draft_m, &found) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return found;
}

/* ------------------------------------------------------------------------------------------------
 * Meshes
 * --------------------------------------------------------------------------------------------- */

/* A point of the half hull over 0..1 along and 0..1 up. */
typedef void mesh_form(double along, double up, double at[3]);

/* n x m cells of half a hull, the diagonal from (i, j) to (i + 1, j + 1), or with alternate ones. */
static inline batten_mesh *make_mesh(batten_context *context, mesh_form *place, size_t n, size_t m,
                                     bool alternate)
{
	static double vertices[3 * 81 * 81];
	static uint32_t triangles[3 * 2 * 80 * 80];
	assert_true(n <= 80 && m <= 80);
	for (size_t j = 0; j <= m; j++)
		for (size_t i = 0; i <= n; i++)
			place((double)i / (double)n, (double)j / (double)m, vertices + 3 * (j * (n + 1) + i));
	uint32_t *t = triangles;
	for (size_t j = 0; j < m; j++)
		for (size_t i = 0; i < n; i++, t += 6) {
			uint32_t a = (uint32_t)(j * (n + 1) + i), b = a + 1, d = a + (uint32_t)n + 1, c = d + 1;
			/* outward seen from port: x runs to the left, so up and then forward */
			const uint32_t one[6] = { a, c, b, a, d, c }, other[6] = { a, d, b, b, d, c };
			memcpy(t, alternate && (i + j) % 2 ? other : one, sizeof one);
		}
	batten_mesh_table table = { (n + 1) * (m + 1), 2 * n * m, vertices, triangles, true };
	batten_mesh *mesh = NULL;
	if (batten_mesh_create(context, &table, &mesh) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return mesh;
}

static inline batten_hydrostatics mesh_at(batten_context *context, const batten_mesh *mesh,
                                          const batten_hydrostatics_options *options,
                                          double draft_m)
{
	batten_hydrostatics found;
	if (batten_mesh_hydrostatics(context, mesh, options, 1, &draft_m, &found) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return found;
}

/* Errors on three tables, each twice as fine as the one before, fall by 2^order. */
static inline void assert_order(const double errors[3], double order, double slack)
{
	for (size_t k = 0; k < 2; k++) {
		double found = log2(fabs(errors[k] / errors[k + 1]));
		if (!(fabs(found - order) <= slack))
			fail_msg("order %g (errors %g, %g) where %g is expected", found, errors[k],
			         errors[k + 1], order);
	}
}

#endif
