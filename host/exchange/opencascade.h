/* What the C++ files of the OpenCASCADE module share. */
#ifndef BATTEN_EXCHANGE_OPENCASCADE_H
#define BATTEN_EXCHANGE_OPENCASCADE_H

#include "exchange/exchange.h"

#include <TCollection_HAsciiString.hxx>
#include <XSControl_Reader.hxx>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace opencascade_module
{

/* What a file says that cannot be used: one line. */
struct refusal {
	std::string text;
};

/* The sink wants no more. */
struct enough {
};

using kinds = std::map<std::pair<std::string, std::string>, unsigned long>;

/* A surface on its way: as batten_surface_net, but with its own arrays. */
struct net_arrays {
	std::string name;
	size_t order_u = 0, order_v = 0, count_u = 0, count_v = 0;
	std::vector<double> knots_u, knots_v, poles, weights;
	bool rational = false;
};

/* Give what was found to the sink. */
void hand_over(const exchange_sink &sink, const net_arrays &arrays);
void hand_over(const exchange_sink &sink, const kinds &left_out);
void hand_over(const exchange_sink &sink, const std::ostringstream &file);

std::string text_of(const Handle(TCollection_HAsciiString) & text);
Handle(TCollection_HAsciiString) text(const std::string &from);

/* Whether the shape that OpenCASCADE makes of an entity is one face that is the whole of its
 * surface. */
bool makes_whole_face(XSControl_Reader &reader, const Handle(Standard_Transient) & entity);

constexpr char frame_text[] =
	"metres; frame ap-fwd: origin at the aft perpendicular on the baseline, "
	"x forward, y to port, z up";
constexpr char not_bspline[] = "no B-spline surface";

/* 17 significant digits: every number reads back as it was. The writers have room for 23 characters,
 * which is why exponents of three digits may not come up: see plain(). */
constexpr char number_format[] = "%.16E";

/* Metres below 1e-99 are none. */
inline double plain(double value)
{
	return std::abs(value) < 1e-99 ? std::copysign(0.0, value) : value;
}

void read_iges(const char *path, const exchange_sink &sink);
void write_iges(size_t count, const batten_surface_net *nets, const exchange_sink &sink);
void read_step(const char *path, const exchange_sink &sink);
void write_step(size_t count, const batten_surface_net *nets, const exchange_sink &sink);

} // namespace opencascade_module

#endif
