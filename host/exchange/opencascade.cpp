/* IGES and STEP through OpenCASCADE: the module that exchange.h describes; what both formats need. */
#include "exchange/opencascade.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <cstdio>
#include <new>

namespace opencascade_module
{

void hand_over(const exchange_sink &sink, const net_arrays &arrays)
{
	batten_surface_net net = {};
	net.name = arrays.name.c_str();
	net.order_u = arrays.order_u;
	net.order_v = arrays.order_v;
	net.count_u = arrays.count_u;
	net.count_v = arrays.count_v;
	net.knots_u = arrays.knots_u.data();
	net.knots_v = arrays.knots_v.data();
	net.poles_m = arrays.poles.data();
	net.weights = arrays.rational ? arrays.weights.data() : nullptr;
	if (!sink.surface(sink.user, &net))
		throw enough();
}

void hand_over(const exchange_sink &sink, const kinds &left_out)
{
	for (const auto &[kind, count] : left_out)
		if (!sink.left_out(sink.user, count, kind.first.c_str(), kind.second.c_str()))
			throw enough();
}

std::string text_of(const Handle(TCollection_HAsciiString) & text)
{
	return text.IsNull() ? std::string() : std::string(text->ToCString());
}

void hand_over(const exchange_sink &sink, const std::ostringstream &file)
{
	const std::string bytes = file.str();
	if (!sink.bytes(sink.user, bytes.data(), bytes.size()))
		throw enough();
}

Handle(TCollection_HAsciiString) text(const std::string &from)
{
	return new TCollection_HAsciiString(from.c_str());
}

/* ------------------------------------------------------------------------------------------------
 * Whether a face is the whole of its surface
 * --------------------------------------------------------------------------------------------- */

namespace
{

/* How far along the edge of its rectangle of parameters a curve goes; < 0 where it leaves it. */
double length_on_edge(const Geom2d_Curve &curve, double first, double last, const double box[4])
{
	const int steps = 16;
	const double near_u = 1e-6 * (box[1] - box[0]);
	const double near_v = 1e-6 * (box[3] - box[2]);
	double length = 0;
	gp_Pnt2d before;
	for (int i = 0; i <= steps; i++) {
		const gp_Pnt2d at = curve.Value(first + (last - first) * i / steps);
		const double u = std::min(std::abs(at.X() - box[0]), std::abs(at.X() - box[1]));
		const double v = std::min(std::abs(at.Y() - box[2]), std::abs(at.Y() - box[3]));
		if (!(u <= near_u || v <= near_v))
			return -1;
		if (i > 0)
			length += std::abs(at.X() - before.X()) / (box[1] - box[0]) +
			          std::abs(at.Y() - before.Y()) / (box[3] - box[2]);
		before = at;
	}
	return length;
}

/* One loop, which runs once round the edge of the rectangle of parameters. */
bool is_whole(const TopoDS_Face &face)
{
	double box[4];
	int loops = 0;
	double length = 0;
	const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
	if (surface.IsNull())
		return false;
	surface->Bounds(box[0], box[1], box[2], box[3]);
	for (TopExp_Explorer loop(face, TopAbs_WIRE); loop.More(); loop.Next())
		loops++;
	for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next()) {
		double first, last;
		const Handle(Geom2d_Curve)
			curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Current()), face, first, last);
		const double part = curve.IsNull() ? -1 : length_on_edge(*curve, first, last, box);
		if (part < 0)
			return false;
		length += part;
	}
	return loops == 1 && std::abs(length - 4) < 1e-5;
}

} // namespace

bool makes_whole_face(XSControl_Reader &reader, const Handle(Standard_Transient) & entity)
{
	reader.ClearShapes();
	if (!reader.TransferEntity(entity) || reader.NbShapes() != 1)
		return false;
	TopExp_Explorer face(reader.Shape(1), TopAbs_FACE);
	if (!face.More() || !is_whole(TopoDS::Face(face.Current())))
		return false;
	face.Next();
	return !face.More();
}

} // namespace opencascade_module

/* ------------------------------------------------------------------------------------------------
 * The C side
 * --------------------------------------------------------------------------------------------- */

using namespace opencascade_module;

namespace
{

/* Whatever work throws becomes a status and a line. */
template <typename function>
batten_status guarded(char message[EXCHANGE_MESSAGE_SIZE], const function &work)
{
	message[0] = '\0';
	try {
		work();
		return BATTEN_OK;
	} catch (const enough &) {
		return BATTEN_OK;
	} catch (const refusal &problem) {
		(void)std::snprintf(message, EXCHANGE_MESSAGE_SIZE, "%s", problem.text.c_str());
		return BATTEN_INPUT;
	} catch (const Standard_Failure &failure) {
		const char *text = failure.GetMessageString();
		(void)std::snprintf(message, EXCHANGE_MESSAGE_SIZE, "OpenCASCADE gave up: %s %s",
		                    failure.DynamicType()->Name(), text ? text : "");
		return BATTEN_INPUT;
	} catch (const std::bad_alloc &) {
		return BATTEN_MEMORY;
	} catch (const std::exception &problem) {
		(void)std::snprintf(message, EXCHANGE_MESSAGE_SIZE, "%s", problem.what());
		return BATTEN_INTERNAL;
	} catch (...) {
		(void)std::snprintf(message, EXCHANGE_MESSAGE_SIZE, "an unknown exception");
		return BATTEN_INTERNAL;
	}
}

} // namespace

static batten_status module_read(exchange_format format, const char *path,
                                 const exchange_sink *sink, char message[EXCHANGE_MESSAGE_SIZE])
{
	return guarded(message, [&] {
		/* It is the file that says how much is needed. */
		try {
			format == EXCHANGE_IGES ? read_iges(path, *sink) : read_step(path, *sink);
		} catch (const std::bad_alloc &) {
			throw refusal{ "asks for more memory than there is: damaged?" };
		}
	});
}

static batten_status module_write(exchange_format format, size_t count,
                                  const batten_surface_net *nets, const exchange_sink *sink,
                                  char message[EXCHANGE_MESSAGE_SIZE])
{
	return guarded(message, [&] {
		format == EXCHANGE_IGES ? write_iges(count, nets, *sink) : write_step(count, nets, *sink);
	});
}

const exchange_module *exchange_module_get(void)
{
	static const exchange_module module = { EXCHANGE_VERSION, module_read, module_write };
	return &module;
}
