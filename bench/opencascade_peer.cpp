#include "opencascade_peer.h"

#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Vec.hxx>

#include <cmath>
#include <exception>
#include <vector>

namespace
{

struct knot_row {
	std::vector<double> values;
	std::vector<int> times;
};

knot_row row_of(const double *knots, size_t count)
{
	knot_row row;
	for (size_t i = 0; i < count; i++) {
		if (i == 0 || knots[i] > row.values.back()) {
			row.values.push_back(knots[i]);
			row.times.push_back(0);
		}
		row.times.back()++;
	}
	return row;
}

Handle(Geom_BSplineSurface) surface_of(const batten_surface_net &net)
{
	TColgp_Array2OfPnt poles(1, static_cast<int>(net.count_u), 1, static_cast<int>(net.count_v));
	for (int j = 1; j <= poles.RowLength(); j++) {
		for (int i = 1; i <= poles.ColLength(); i++) {
			const size_t n = static_cast<size_t>(j - 1) * net.count_u + static_cast<size_t>(i - 1);
			const double *at = net.poles_m + 3 * n;
			poles.SetValue(i, j, gp_Pnt(at[0], at[1], at[2]));
		}
	}
	const knot_row u = row_of(net.knots_u, net.count_u + net.order_u);
	const knot_row v = row_of(net.knots_v, net.count_v + net.order_v);
	const TColStd_Array1OfReal knots_u(u.values[0], 1, static_cast<int>(u.values.size()));
	const TColStd_Array1OfReal knots_v(v.values[0], 1, static_cast<int>(v.values.size()));
	const TColStd_Array1OfInteger times_u(u.times[0], 1, static_cast<int>(u.times.size()));
	const TColStd_Array1OfInteger times_v(v.times[0], 1, static_cast<int>(v.times.size()));
	return new Geom_BSplineSurface(poles, knots_u, knots_v, times_u, times_v,
	                               static_cast<int>(net.order_u) - 1,
	                               static_cast<int>(net.order_v) - 1);
}

/* Letcher 4.2-4.3; the normal is by_v x by_u. */
void curvatures(const gp_Vec &u, const gp_Vec &v, const gp_Vec &uu, const gp_Vec &vv,
                const gp_Vec &uv, double &gauss, double &mean)
{
	const gp_Vec normal = v.Crossed(u);
	const double E = u.Dot(u), F = u.Dot(v), G = v.Dot(v);
	const double e = normal.Dot(uu), f = normal.Dot(uv), g = normal.Dot(vv);
	const double r = 1 / std::sqrt(E * G - F * F), r2 = r * r;
	gauss = (e * g - f * f) * r2 * r2;
	mean = 0.5 * (e * G - 2 * f * F + g * E) * r2 * r;
}

} // namespace

bool opencascade_peer_grid(const batten_surface_net *net, const batten_surface_samples *samples,
                           double *values)
{
	try {
		const GeomAdaptor_Surface surface(surface_of(*net));
		const size_t points = samples->u_count * samples->v_count;
		for (size_t k = 0; k < samples->v_count; k++) {
			for (size_t i = 0; i < samples->u_count; i++) {
				gp_Pnt at;
				gp_Vec u, v, uu, vv, uv;
				surface.D2(samples->u[i], samples->v[k], at, u, v, uu, vv, uv);
				const size_t n = k * samples->u_count + i;
				curvatures(u, v, uu, vv, uv, values[n], values[points + n]);
			}
		}
		return true;
	} catch (const Standard_Failure &) {
		return false;
	} catch (const std::exception &) {
		return false;
	}
}
