/* IGES: entity 128, by section 4.24 of the standard (version 5.3). */
#include "exchange/opencascade.h"

#include <IGESBasic_Name.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_TransfEntity.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Graph.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <TColgp_HArray2OfXYZ.hxx>
#include <gp_GTrsf.hxx>

namespace opencascade_module
{
namespace
{

/* Metres a unit, as numerator and denominator so that round units stay exact. */
void unit_of(const IGESData_GlobalSection &header, double &times, double &by)
{
	static const struct {
		double times, by;
		const char *name;
	} units[] = { { 0.0254, 1, "IN" }, { 1, 1e3, "MM" },       { 0, 0, "" },
		          { 0.3048, 1, "FT" }, { 1609.344, 1, "MI" },  { 1, 1, "M" },
		          { 1e3, 1, "KM" },    { 0.0254, 1e3, "MIL" }, { 1, 1e6, "UM" },
		          { 1, 1e2, "CM" },    { 0.0254, 1e6, "UIN" } };
	int flag = header.UnitFlag();
	const std::string name = text_of(header.UnitName());
	for (int i = 0; flag == 3 && i < 11; i++)
		if (i != 2 && (name == units[i].name || (name == "INCH" && i == 0)))
			flag = i + 1;
	if (flag < 1 || flag > 11 || flag == 3)
		throw refusal{ "the unit is flag " + std::to_string(flag) + ", name '" + name +
			           "', which is no unit of IGES" };
	if (std::abs(header.Scale() - 1) > 1e-12)
		throw refusal{ "the scale of the model space is " + std::to_string(header.Scale()) +
			           ", 1 was expected" };
	times = units[flag - 1].times;
	by = units[flag - 1].by;
}

const char *iges_kind(int type)
{
	static const struct {
		int type;
		const char *name;
	} names[] = { { 100, "circular arc" },
		          { 102, "composite curve" },
		          { 104, "conic arc" },
		          { 106, "copious data" },
		          { 108, "plane" },
		          { 110, "line" },
		          { 112, "parametric spline curve" },
		          { 114, "parametric spline surface" },
		          { 116, "point" },
		          { 118, "ruled surface" },
		          { 120, "surface of revolution" },
		          { 122, "tabulated cylinder" },
		          { 126, "B-spline curve" },
		          { 128, "B-spline surface" },
		          { 140, "offset surface" },
		          { 142, "curve on a surface" },
		          { 143, "bounded surface" },
		          { 144, "trimmed surface" },
		          { 186, "solid" },
		          { 190, "plane surface" },
		          { 192, "cylinder" },
		          { 194, "cone" },
		          { 196, "sphere" },
		          { 198, "torus" },
		          { 308, "subfigure" },
		          { 408, "subfigure" },
		          { 510, "face" },
		          { 514, "shell" } };
	for (const auto &entry : names)
		if (entry.type == type)
			return entry.name;
	return "entity";
}

std::string iges_kind_text(int type)
{
	return std::string(iges_kind(type)) + " (" + std::to_string(type) + ")";
}

std::string iges_name(const IGESData_IGESEntity &entity)
{
	if (entity.NbTypedProperties(STANDARD_TYPE(IGESBasic_Name)) > 0) {
		const Handle(IGESBasic_Name) name = Handle(IGESBasic_Name)::DownCast(
			entity.TypedProperty(STANDARD_TYPE(IGESBasic_Name)));
		if (!name.IsNull())
			return text_of(name->Value());
	}
	std::string label = entity.HasShortLabel() ? text_of(entity.ShortLabel()) : "";
	label.erase(0, label.find_first_not_of(' '));
	return label;
}

/* Whether the range the entity states is that of its knots. The standard orders it u0, u1, v0, v1;
 * OpenCASCADE 7.6 writes that, but reads the second number as VMin and the third as UMax. */
bool is_whole_range(const IGESGeom_BSplineSurface &s)
{
	const double u0 = s.KnotU(0), u1 = s.KnotU(s.UpperIndexU() - s.DegreeU() + 1);
	const double v0 = s.KnotV(0), v1 = s.KnotV(s.UpperIndexV() - s.DegreeV() + 1);
	const double near_u = 1e-9 * std::abs(u1 - u0), near_v = 1e-9 * std::abs(v1 - v0);
	const auto is_near = [&](double last_u, double first_v) {
		return std::abs(s.UMin() - u0) <= near_u && std::abs(last_u - u1) <= near_u &&
		       std::abs(first_v - v0) <= near_v && std::abs(s.VMax() - v1) <= near_v;
	};
	return is_near(s.VMin(), s.UMax()) || is_near(s.UMax(), s.VMin());
}

/* A point where the matrix of the entity puts it, the matrix of that matrix after it, and so on:
 * OpenCASCADE stops at the first. */
gp_XYZ moved(const IGESData_IGESEntity &entity, gp_XYZ point)
{
	enum { MATRICES_MOST = 64 };
	const IGESData_IGESEntity *at = &entity;
	for (int n = 0; at->HasTransf(); n++) {
		if (n == MATRICES_MOST)
			throw refusal{ "has matrices that move matrices without end" };
		const Handle(IGESData_TransfEntity) matrix = at->Transf();
		matrix->Value().Transforms(point);
		at = matrix.get();
	}
	return point;
}

void take_net(const IGESGeom_BSplineSurface &s, double times, double by, net_arrays &out)
{
	out.order_u = static_cast<size_t>(s.DegreeU()) + 1;
	out.order_v = static_cast<size_t>(s.DegreeV()) + 1;
	out.count_u = static_cast<size_t>(s.NbPolesU());
	out.count_v = static_cast<size_t>(s.NbPolesV());
	out.rational = !s.IsPolynomial(Standard_True);
	for (int i = -s.DegreeU(); i <= s.UpperIndexU() + 1; i++)
		out.knots_u.push_back(s.KnotU(i));
	for (int j = -s.DegreeV(); j <= s.UpperIndexV() + 1; j++)
		out.knots_v.push_back(s.KnotV(j));
	for (int j = 0; j <= s.UpperIndexV(); j++) {
		for (int i = 0; i <= s.UpperIndexU(); i++) {
			const gp_XYZ pole = moved(s, s.Pole(i, j).XYZ());
			for (int c = 1; c <= 3; c++)
				out.poles.push_back(pole.Coord(c) * times / by);
			out.weights.push_back(s.Weight(i, j));
		}
	}
}

/* What becomes of a B-spline surface: nullptr, or why it is left out. */
const char *iges_fate(IGESControl_Reader &reader, const Interface_Graph &graph,
                      const Handle(IGESGeom_BSplineSurface) & surface)
{
	if (surface->IsPeriodicU() || surface->IsPeriodicV())
		return "periodic";
	if (!is_whole_range(*surface))
		return "cut to a part of its range";
	for (Interface_EntityIterator user = graph.Sharings(surface); user.More(); user.Next()) {
		const Handle(IGESData_IGESEntity)
			entity = Handle(IGESData_IGESEntity)::DownCast(user.Value());
		const int type = entity.IsNull() ? 0 : entity->TypeNumber();
		if (!entity.IsNull() && entity->HasTransf())
			return "moved by an entity it is part of";
		if (type == 402 || type == 142) /* a group; a boundary, of a trimmed surface */
			continue;
		const Handle(IGESGeom_TrimmedSurface)
			trimmed = Handle(IGESGeom_TrimmedSurface)::DownCast(entity);
		if (!trimmed.IsNull() && !trimmed->HasOuterContour() && trimmed->NbInnerContours() == 0)
			continue;
		if (type != 144 && type != 143 && type != 510)
			return "part of another entity";
		if (!makes_whole_face(reader, entity))
			return "trimmed";
	}
	return nullptr;
}

} // namespace

void read_iges(const char *path, const exchange_sink &sink)
{
	IGESControl_Controller::Init();
	IGESControl_Reader reader;
	if (reader.ReadFile(path) != IFSelect_RetDone)
		throw refusal{ "is no IGES file that can be read" };
	const Handle(IGESData_IGESModel) model = reader.IGESModel();
	if (model.IsNull() || model->NbEntities() == 0)
		throw refusal{ "is an IGES file without entities" };
	double times, by;
	unit_of(model->GlobalSection(), times, by);
	const Interface_Graph graph(model);
	kinds left_out;
	for (int n = 1; n <= model->NbEntities(); n++) {
		const Handle(IGESData_IGESEntity) entity = model->Entity(n);
		const int type = entity->TypeNumber();
		const Handle(IGESGeom_BSplineSurface)
			surface = Handle(IGESGeom_BSplineSurface)::DownCast(entity);
		if (type == 128 && (surface.IsNull() || model->IsErrorEntity(n)))
			throw refusal{ "the B-spline surface at D" + std::to_string(2 * n - 1) +
				           " is damaged" };
		if (surface.IsNull()) {
			const bool attribute = type == 0 || type == 124 || type == 314 || type >= 400;
			if (graph.Sharings(entity).NbEntities() == 0 && type != 144 && type != 143 &&
			    (!attribute || type == 408 || (type >= 500 && type <= 514)))
				left_out[{ iges_kind_text(type), not_bspline }]++;
			continue;
		}
		const char *fate = iges_fate(reader, graph, surface);
		if (fate) {
			left_out[{ iges_kind_text(type), fate }]++;
			continue;
		}
		net_arrays arrays;
		take_net(*surface, times, by, arrays);
		arrays.name = iges_name(*surface);
		hand_over(sink, arrays);
	}
	hand_over(sink, left_out);
}

namespace
{

Handle(IGESGeom_BSplineSurface) iges_surface(const batten_surface_net &net)
{
	const int last_u = static_cast<int>(net.count_u) - 1,
			  last_v = static_cast<int>(net.count_v) - 1;
	const int degree_u = static_cast<int>(net.order_u) - 1;
	const int degree_v = static_cast<int>(net.order_v) - 1;
	Handle(TColStd_HArray1OfReal) knots_u = new TColStd_HArray1OfReal(-degree_u, last_u + 1);
	Handle(TColStd_HArray1OfReal) knots_v = new TColStd_HArray1OfReal(-degree_v, last_v + 1);
	Handle(TColStd_HArray2OfReal) weights = new TColStd_HArray2OfReal(0, last_u, 0, last_v, 1.0);
	Handle(TColgp_HArray2OfXYZ) poles = new TColgp_HArray2OfXYZ(0, last_u, 0, last_v);
	for (size_t i = 0; i < net.count_u + net.order_u; i++)
		knots_u->SetValue(static_cast<int>(i) - degree_u, plain(net.knots_u[i]));
	for (size_t j = 0; j < net.count_v + net.order_v; j++)
		knots_v->SetValue(static_cast<int>(j) - degree_v, plain(net.knots_v[j]));
	for (int j = 0; j <= last_v; j++) {
		for (int i = 0; i <= last_u; i++) {
			const size_t n = static_cast<size_t>(j) * net.count_u + static_cast<size_t>(i);
			const double *pole = net.poles_m + 3 * n;
			poles->SetValue(i, j, gp_XYZ(plain(pole[0]), plain(pole[1]), plain(pole[2])));
			if (net.weights)
				weights->SetValue(i, j, net.weights[n]);
		}
	}
	Handle(IGESGeom_BSplineSurface) surface = new IGESGeom_BSplineSurface;
	surface->Init(last_u, last_v, degree_u, degree_v, Standard_False, Standard_False,
	              net.weights == nullptr, Standard_False, Standard_False, knots_u, knots_v, weights,
	              poles, plain(net.knots_u[degree_u]), plain(net.knots_u[net.count_u]),
	              plain(net.knots_v[degree_v]), plain(net.knots_v[net.count_v]));
	return surface;
}

} // namespace

void write_iges(size_t count, const batten_surface_net *nets, const exchange_sink &sink)
{
	IGESControl_Controller::Init();
	IGESControl_Writer writer("M", 0);
	const Handle(IGESData_IGESModel) model = writer.Model();
	for (size_t s = 0; s < count; s++) {
		const Handle(IGESGeom_BSplineSurface) surface = iges_surface(nets[s]);
		const std::string name = nets[s].name;
		if (!name.empty()) {
			Handle(IGESBasic_Name) property = new IGESBasic_Name;
			property->Init(1, text(name));
			surface->AddProperty(property);
			writer.AddEntity(property);
			surface->SetLabel(text(name.substr(0, 8)));
		}
		writer.AddEntity(surface);
	}
	model->ClearStartSection();
	model->AddStartLine("B-spline surfaces of a half hull, written by batten");
	model->AddStartLine(frame_text);
	IGESData_GlobalSection header = model->GlobalSection();
	header.SetSystemId(text("batten"));
	header.SetUnitFlag(6);
	header.SetUnitName(text("M"));
	header.SetMaxDigitsDouble(17);
	model->SetGlobalSection(header);
	writer.ComputeModel();
	IGESData_IGESWriter file(model);
	file.FloatWriter().SetFormat(number_format);
	file.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
	std::ostringstream stream;
	if (!file.Print(stream))
		throw refusal{ "OpenCASCADE could not write the entities" };
	hand_over(sink, stream);
}

} // namespace opencascade_module
