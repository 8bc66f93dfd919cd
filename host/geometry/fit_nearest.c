/* The nearest point of a surface: damped Newton steps in the parameters, which never go back. */
#include "geometry/fit.h"

#include <math.h>

enum { STEPS = 40 };

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double value, double first, double last)
{
	return value < first ? first : value > last ? last : value;
}

static double squared_distance(const struct batten_surface *surface, const double place[3],
                               double u, double v)
{
	surface_jet jet;
	surface_evaluate(surface, u, v, 0, jet);
	const double away[3] = { jet[0][0][0] - place[0], jet[0][0][1] - place[1],
		                     jet[0][0][2] - place[2] };
	return dot(away, away);
}

/* Half the gradient and half the second derivatives of the squared distance. */
struct quadratic {
	double u, v, uu, uv, vv;
};

static struct quadratic model_at(const struct batten_surface *surface, const double place[3],
                                 double u, double v)
{
	surface_jet jet;
	surface_evaluate(surface, u, v, 2, jet);
	const double away[3] = { jet[0][0][0] - place[0], jet[0][0][1] - place[1],
		                     jet[0][0][2] - place[2] };
	struct quadratic model = {
		.u = dot(away, jet[1][0]),
		.v = dot(away, jet[0][1]),
		.uu = dot(jet[1][0], jet[1][0]) + dot(away, jet[2][0]),
		.uv = dot(jet[1][0], jet[0][1]) + dot(away, jet[1][1]),
		.vv = dot(jet[0][1], jet[0][1]) + dot(away, jet[0][2]),
	};
	/* Far from the surface the curvature may turn the model over: Gauss and Newton's is safe. */
	if (!(model.uu > 0.0 && model.vv > 0.0 && model.uu * model.vv > model.uv * model.uv)) {
		model.uu = dot(jet[1][0], jet[1][0]);
		model.uv = dot(jet[1][0], jet[0][1]);
		model.vv = dot(jet[0][1], jet[0][1]);
	}
	return model;
}

/* Leaves out a direction that is held, or that leads out of the surface. */
static void restrict_model(struct quadratic *model, bool hold_u, bool hold_v)
{
	if (hold_u) {
		model->u = 0.0;
		model->uu = 1.0;
		model->uv = 0.0;
	}
	if (hold_v) {
		model->v = 0.0;
		model->vv = 1.0;
		model->uv = 0.0;
	}
}

double fit_nearest(const struct batten_surface *surface, const double place[3], bool hold_u,
                   bool hold_v, double *u, double *v)
{
	const double first_u = surface->knots_u[surface->order_u - 1];
	const double last_u = surface->knots_u[surface->count_u];
	const double first_v = surface->knots_v[surface->order_v - 1];
	const double last_v = surface->knots_v[surface->count_v];
	double distance = squared_distance(surface, place, *u, *v);
	double damping = 0.0;
	for (int step = 0; step < STEPS && damping < 1e6; step++) {
		struct quadratic model = model_at(surface, place, *u, *v);
		restrict_model(
			&model, hold_u || (*u <= first_u && model.u > 0.0) || (*u >= last_u && model.u < 0.0),
			hold_v || (*v <= first_v && model.v > 0.0) || (*v >= last_v && model.v < 0.0));
		const double uu = model.uu * (1.0 + damping);
		const double vv = model.vv * (1.0 + damping);
		const double determinant = uu * vv - model.uv * model.uv;
		if (!(determinant > 0.0))
			return sqrt(distance);
		const double new_u = clamp(*u - (model.u * vv - model.v * model.uv) / determinant, first_u,
		                           last_u);
		const double new_v = clamp(*v - (model.v * uu - model.u * model.uv) / determinant, first_v,
		                           last_v);
		const double moved = fabs(new_u - *u) / (last_u - first_u) +
		                     fabs(new_v - *v) / (last_v - first_v);
		const double found = squared_distance(surface, place, new_u, new_v);
		if (found < distance) {
			distance = found;
			*u = new_u;
			*v = new_v;
			damping *= 0.1;
		} else {
			damping = damping > 0.0 ? 10.0 * damping : 1e-3;
		}
		if (moved < 1e-12)
			break;
	}
	return sqrt(distance);
}
