/* STEP: b_spline_surface_with_knots of ISO 10303-42, as AP214 has it. */
#include "exchange/opencascade.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Graph.hxx>
#include <Interface_HArray1OfHAsciiString.hxx>
#include <STEPConstruct_Part.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <StepAP214.hxx>
#include <StepAP214_Protocol.hxx>
#include <StepBasic_ApplicationContext.hxx>
#include <StepBasic_ApplicationProtocolDefinition.hxx>
#include <StepBasic_ConversionBasedUnitAndLengthUnit.hxx>
#include <StepBasic_HArray1OfNamedUnit.hxx>
#include <StepBasic_MeasureWithUnit.hxx>
#include <StepBasic_ProductRelatedProductCategory.hxx>
#include <StepBasic_SiUnitAndLengthUnit.hxx>
#include <StepBasic_SiUnitAndPlaneAngleUnit.hxx>
#include <StepBasic_SiUnitAndSolidAngleUnit.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepGeom_HArray2OfCartesianPoint.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_ItemDefinedTransformation.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <StepRepr_RepresentationRelationshipWithTransformation.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_GeometricallyBoundedSurfaceShapeRepresentation.hxx>
#include <StepShape_HArray1OfGeometricSetSelect.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>

#include <algorithm>

namespace opencascade_module
{
namespace
{

using spline_with_weights = StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface;

double power_of(StepBasic_SiPrefix prefix)
{
	static const int powers[] = { 18, 15, 12, 9, 6, 3, 2, 1, -1, -2, -3, -6, -9, -12, -15, -18 };
	return powers[prefix];
}

/* Metres a unit, as numerator and denominator; false where the unit is none of length. */
bool length_of(const Handle(StepBasic_NamedUnit) & unit, double &times, double &by, int depth = 0)
{
	const Handle(StepBasic_SiUnitAndLengthUnit)
		si = Handle(StepBasic_SiUnitAndLengthUnit)::DownCast(unit);
	if (!si.IsNull()) {
		const double power = si->HasPrefix() ? power_of(si->Prefix()) : 0;
		times = power > 0 ? std::pow(10.0, power) : 1;
		by = power < 0 ? std::pow(10.0, -power) : 1;
		return si->Name() == StepBasic_sunMetre;
	}
	const Handle(StepBasic_ConversionBasedUnitAndLengthUnit)
		other = Handle(StepBasic_ConversionBasedUnitAndLengthUnit)::DownCast(unit);
	if (other.IsNull() || other->ConversionFactor().IsNull() || depth > 4)
		return false;
	const Handle(StepBasic_MeasureWithUnit) factor = other->ConversionFactor();
	if (!length_of(factor->UnitComponent().NamedUnit(), times, by, depth + 1))
		return false;
	times *= factor->ValueComponent();
	return std::isfinite(times) && times > 0;
}

Handle(StepRepr_GlobalUnitAssignedContext)
	units_of(const Handle(StepRepr_RepresentationContext) & context)
{
	const Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx) all = Handle(
		StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(context);
	if (!all.IsNull())
		return all->GlobalUnitAssignedContext();
	const Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext) some = Handle(
		StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(context);
	return some.IsNull() ? Handle(StepRepr_GlobalUnitAssignedContext)()
	                     : some->GlobalUnitAssignedContext();
}

/* The unit of the representation that an entity ends up in. */
void unit_of(const Interface_Graph &graph, const Handle(Standard_Transient) & entity, double &times,
             double &by)
{
	std::vector<Handle(Standard_Transient)> open{ entity };
	std::vector<bool> seen(static_cast<size_t>(graph.Size()) + 1, false);
	while (!open.empty()) {
		const Handle(Standard_Transient) here = open.back();
		open.pop_back();
		const Handle(StepRepr_Representation)
			found = Handle(StepRepr_Representation)::DownCast(here);
		const Handle(StepRepr_GlobalUnitAssignedContext)
			units = found.IsNull() ? Handle(StepRepr_GlobalUnitAssignedContext)()
		                           : units_of(found->ContextOfItems());
		for (int i = 1; !units.IsNull() && !units->Units().IsNull() && i <= units->NbUnits(); i++)
			if (length_of(units->UnitsValue(i), times, by))
				return;
		for (Interface_EntityIterator user = graph.Sharings(here); user.More(); user.Next()) {
			const size_t number = static_cast<size_t>(graph.EntityNumber(user.Value()));
			if (!seen.at(number))
				open.push_back(user.Value());
			seen.at(number) = true;
		}
	}
	throw refusal{ "has a surface without a unit of length" };
}

std::string step_kind(const Handle(Standard_Transient) & entity)
{
	std::string name = entity->DynamicType()->Name();
	name.erase(0, name.find('_') + 1);
	return name;
}

void take_knots(const Handle(TColStd_HArray1OfReal) & knots,
                const Handle(TColStd_HArray1OfInteger) & times, std::vector<double> &out)
{
	if (knots.IsNull() || times.IsNull() || knots->Length() != times->Length())
		throw refusal{ "has a B-spline surface whose knots and multiplicities differ in number" };
	for (int i = 0; i < knots->Length(); i++) {
		const int count = times->Value(times->Lower() + i);
		if (count < 1 || count > 32)
			throw refusal{ "has a B-spline surface with a knot that occurs " +
				           std::to_string(count) + " times" };
		out.insert(out.end(), static_cast<size_t>(count), knots->Value(knots->Lower() + i));
	}
}

/* An order that no surface has where the number of knots does not fit: refused by name later. */
size_t order_of(int degree, size_t poles, size_t knots)
{
	if (degree < 1 || degree > 100 || knots != poles + static_cast<size_t>(degree) + 1)
		throw refusal{ "has a B-spline surface of degree " + std::to_string(degree) + " with " +
			           std::to_string(poles) + " poles and " + std::to_string(knots) + " knots" };
	return static_cast<size_t>(degree) + 1;
}

void take_net(const StepGeom_BSplineSurface &s, double times, double by, net_arrays &out)
{
	const Handle(StepGeom_HArray2OfCartesianPoint) poles = s.ControlPointsList();
	if (poles.IsNull())
		throw refusal{ "has a B-spline surface without poles" };
	out.count_u = static_cast<size_t>(poles->ColLength());
	out.count_v = static_cast<size_t>(poles->RowLength());
	out.order_u = order_of(s.UDegree(), out.count_u, out.knots_u.size());
	out.order_v = order_of(s.VDegree(), out.count_v, out.knots_v.size());
	for (int j = poles->LowerCol(); j <= poles->UpperCol(); j++) {
		for (int i = poles->LowerRow(); i <= poles->UpperRow(); i++) {
			const Handle(StepGeom_CartesianPoint) pole = poles->Value(i, j);
			if (pole.IsNull() || pole->Coordinates().IsNull() || pole->NbCoordinates() != 3)
				throw refusal{ "has a B-spline surface with a pole that is no point of space" };
			for (int c = 1; c <= 3; c++)
				out.poles.push_back(pole->CoordinatesValue(c) * times / by);
		}
	}
}

void take_weights(const Handle(TColStd_HArray2OfReal) & weights, net_arrays &out)
{
	if (weights.IsNull() || static_cast<size_t>(weights->ColLength()) != out.count_u ||
	    static_cast<size_t>(weights->RowLength()) != out.count_v)
		throw refusal{ "has a B-spline surface without a weight for each pole" };
	for (int j = weights->LowerCol(); j <= weights->UpperCol(); j++)
		for (int i = weights->LowerRow(); i <= weights->UpperRow(); i++)
			out.weights.push_back(weights->Value(i, j));
	out.rational = true;
}

const char *step_fate(STEPControl_Reader &reader, const Interface_Graph &graph,
                      const Handle(StepGeom_Surface) & surface, std::string &name)
{
	for (Interface_EntityIterator user = graph.Sharings(surface); user.More(); user.Next()) {
		if (user.Value()->IsKind(STANDARD_TYPE(StepGeom_Surface)))
			return "part of another entity";
		const Handle(StepShape_FaceSurface)
			face = Handle(StepShape_FaceSurface)::DownCast(user.Value());
		if (face.IsNull())
			continue;
		if (!makes_whole_face(reader, face))
			return "trimmed";
		if (name.empty())
			name = text_of(face->Name());
	}
	return nullptr;
}

/* True where the entity is a B-spline surface with its knots, which are taken. */
bool take_knots(const Handle(Standard_Transient) & entity, net_arrays &out)
{
	const Handle(StepGeom_BSplineSurfaceWithKnots)
		plain = Handle(StepGeom_BSplineSurfaceWithKnots)::DownCast(entity);
	const Handle(spline_with_weights) rational = Handle(spline_with_weights)::DownCast(entity);
	if (!rational.IsNull()) {
		take_knots(rational->UKnots(), rational->UMultiplicities(), out.knots_u);
		take_knots(rational->VKnots(), rational->VMultiplicities(), out.knots_v);
	} else if (!plain.IsNull()) {
		take_knots(plain->UKnots(), plain->UMultiplicities(), out.knots_u);
		take_knots(plain->VKnots(), plain->VMultiplicities(), out.knots_v);
	}
	return !rational.IsNull() || !plain.IsNull();
}

void read_step_surface(STEPControl_Reader &reader, const Interface_Graph &graph,
                       const Handle(Standard_Transient) & entity, const exchange_sink &sink,
                       kinds &left_out)
{
	const Handle(StepGeom_BSplineSurface)
		surface = Handle(StepGeom_BSplineSurface)::DownCast(entity);
	const Handle(spline_with_weights) rational = Handle(spline_with_weights)::DownCast(entity);
	net_arrays arrays;
	if (!take_knots(entity, arrays)) {
		left_out[{ step_kind(entity), "no B-spline surface with knots" }]++;
		return;
	}
	arrays.name = text_of(surface->Name());
	const char *fate = step_fate(reader, graph, surface, arrays.name);
	if (fate) {
		left_out[{ step_kind(entity), fate }]++;
		return;
	}
	double times, by;
	unit_of(graph, entity, times, by);
	take_net(*surface, times, by, arrays);
	if (!rational.IsNull())
		take_weights(rational->WeightsData(), arrays);
	hand_over(sink, arrays);
}

/* Axes and origin of a placement; without them, the file's own. */
bool placement_of(const Handle(StepRepr_RepresentationItem) & item, double out[9])
{
	const Handle(StepGeom_Axis2Placement3d)
		place = Handle(StepGeom_Axis2Placement3d)::DownCast(item);
	if (place.IsNull() || place->Location().IsNull() || place->Location()->NbCoordinates() != 3)
		return false;
	const double standard[] = { 0, 0, 1, 1, 0, 0 };
	std::copy(standard, standard + 6, out + 3);
	for (int c = 0; c < 3; c++) {
		out[c] = place->Location()->CoordinatesValue(c + 1);
		if (place->HasAxis() && place->Axis()->NbDirectionRatios() == 3)
			out[3 + c] = place->Axis()->DirectionRatiosValue(c + 1);
		if (place->HasRefDirection() && place->RefDirection()->NbDirectionRatios() == 3)
			out[6 + c] = place->RefDirection()->DirectionRatiosValue(c + 1);
	}
	return true;
}

bool is_same_place(const Handle(StepRepr_RepresentationItem) & first,
                   const Handle(StepRepr_RepresentationItem) & second)
{
	double a[9], b[9];
	return placement_of(first, a) && placement_of(second, b) && std::equal(a, a + 9, b);
}

/* An entity that puts others elsewhere: an instance, a part of an assembly. */
bool is_moved(const Handle(Standard_Transient) & entity)
{
	const Handle(StepRepr_MappedItem) item = Handle(StepRepr_MappedItem)::DownCast(entity);
	if (!item.IsNull())
		return item->MappingSource().IsNull() ||
		       !is_same_place(item->MappingSource()->MappingOrigin(), item->MappingTarget());
	const Handle(StepRepr_RepresentationRelationshipWithTransformation)
		part = Handle(StepRepr_RepresentationRelationshipWithTransformation)::DownCast(entity);
	if (part.IsNull())
		return false;
	const Handle(StepRepr_ItemDefinedTransformation)
		way = part->TransformationOperator().ItemDefinedTransformation();
	return way.IsNull() || !is_same_place(way->TransformItem1(), way->TransformItem2());
}

/* Whether damage to an entity would be damage to a surface or its scale. */
bool matters(const Handle(Standard_Transient) & entity)
{
	return entity->IsKind(STANDARD_TYPE(StepGeom_BSplineSurface)) ||
	       entity->IsKind(STANDARD_TYPE(StepGeom_CartesianPoint)) ||
	       entity->IsKind(STANDARD_TYPE(StepBasic_NamedUnit)) ||
	       entity->IsKind(STANDARD_TYPE(StepBasic_MeasureWithUnit));
}

} // namespace

void read_step(const char *path, const exchange_sink &sink)
{
	STEPControl_Controller::Init();
	STEPControl_Reader reader;
	if (reader.ReadFile(path) != IFSelect_RetDone)
		throw refusal{ "is no STEP file that can be read" };
	const Handle(StepData_StepModel) model = reader.StepModel();
	if (model.IsNull() || model->NbEntities() == 0)
		throw refusal{ "is a STEP file without entities" };
	const Interface_Graph graph(model);
	kinds left_out;
	for (int n = 1; n <= model->NbEntities(); n++) {
		const Handle(Standard_Transient) entity = model->Entity(n);
		if (is_moved(entity))
			throw refusal{ "is an assembly of parts that are moved: save it as one part" };
		if (model->IsErrorEntity(n) && matters(entity))
			throw refusal{ step_kind(entity) + " #" + std::to_string(model->IdentLabel(entity)) +
				           " is damaged" };
	}
	for (int n = 1; n <= model->NbEntities(); n++) {
		const Handle(Standard_Transient) entity = model->Entity(n);
		const Handle(StepShape_GeometricSet) set = Handle(StepShape_GeometricSet)::DownCast(entity);
		if (entity->IsKind(STANDARD_TYPE(StepGeom_BSplineSurface)))
			read_step_surface(reader, graph, entity, sink, left_out);
		else if (entity->IsKind(STANDARD_TYPE(StepGeom_Surface)))
			left_out[{ step_kind(entity), not_bspline }]++;
		for (int i = 1; !set.IsNull() && !set->Elements().IsNull() && i <= set->NbElements(); i++) {
			const StepShape_GeometricSetSelect item = set->ElementsValue(i);
			if (!item.Value().IsNull() && item.Surface().IsNull())
				left_out[{ step_kind(item.Value()), not_bspline }]++;
		}
	}
	hand_over(sink, left_out);
}

namespace
{

void group_knots(const double *knots, size_t count, Handle(TColStd_HArray1OfReal) & values,
                 Handle(TColStd_HArray1OfInteger) & times)
{
	std::vector<double> different;
	std::vector<int> counts;
	for (size_t i = 0; i < count; i++) {
		if (i == 0 || plain(knots[i]) > different.back()) {
			different.push_back(plain(knots[i]));
			counts.push_back(0);
		}
		counts.back()++;
	}
	const int last = static_cast<int>(different.size());
	values = new TColStd_HArray1OfReal(1, last);
	times = new TColStd_HArray1OfInteger(1, last);
	for (int i = 1; i <= last; i++) {
		values->SetValue(i, different[static_cast<size_t>(i) - 1]);
		times->SetValue(i, counts[static_cast<size_t>(i) - 1]);
	}
}

Handle(StepGeom_BSplineSurface) step_surface(const batten_surface_net &net)
{
	const int rows = static_cast<int>(net.count_u), columns = static_cast<int>(net.count_v);
	const int degree_u = static_cast<int>(net.order_u) - 1;
	const int degree_v = static_cast<int>(net.order_v) - 1;
	Handle(StepGeom_HArray2OfCartesianPoint)
		poles = new StepGeom_HArray2OfCartesianPoint(1, rows, 1, columns);
	Handle(TColStd_HArray2OfReal) weights = new TColStd_HArray2OfReal(1, rows, 1, columns, 1.0);
	for (int j = 1; j <= columns; j++) {
		for (int i = 1; i <= rows; i++) {
			const size_t n = static_cast<size_t>(j - 1) * net.count_u + static_cast<size_t>(i - 1);
			Handle(StepGeom_CartesianPoint) pole = new StepGeom_CartesianPoint;
			const double *at = net.poles_m + 3 * n;
			pole->Init3D(text(""), plain(at[0]), plain(at[1]), plain(at[2]));
			poles->SetValue(i, j, pole);
			if (net.weights)
				weights->SetValue(i, j, net.weights[n]);
		}
	}
	Handle(TColStd_HArray1OfReal) knots_u, knots_v;
	Handle(TColStd_HArray1OfInteger) times_u, times_v;
	group_knots(net.knots_u, net.count_u + net.order_u, knots_u, times_u);
	group_knots(net.knots_v, net.count_v + net.order_v, knots_v, times_v);
	if (net.weights) {
		Handle(spline_with_weights) surface = new spline_with_weights;
		surface->Init(text(net.name), degree_u, degree_v, poles, StepGeom_bssfUnspecified,
		              StepData_LFalse, StepData_LFalse, StepData_LFalse, times_u, times_v, knots_u,
		              knots_v, StepGeom_ktUnspecified, weights);
		return surface;
	}
	Handle(StepGeom_BSplineSurfaceWithKnots) surface = new StepGeom_BSplineSurfaceWithKnots;
	surface->Init(text(net.name), degree_u, degree_v, poles, StepGeom_bssfUnspecified,
	              StepData_LFalse, StepData_LFalse, StepData_LFalse, times_u, times_v, knots_u,
	              knots_v, StepGeom_ktUnspecified);
	return surface;
}

/* Space in metres and radians. */
Handle(StepRepr_RepresentationContext) metric_space()
{
	Handle(StepBasic_SiUnitAndLengthUnit) metre = new StepBasic_SiUnitAndLengthUnit;
	Handle(StepBasic_SiUnitAndPlaneAngleUnit) radian = new StepBasic_SiUnitAndPlaneAngleUnit;
	Handle(StepBasic_SiUnitAndSolidAngleUnit) steradian = new StepBasic_SiUnitAndSolidAngleUnit;
	metre->Init(Standard_False, StepBasic_spMilli, StepBasic_sunMetre);
	radian->Init(Standard_False, StepBasic_spMilli, StepBasic_sunRadian);
	steradian->Init(Standard_False, StepBasic_spMilli, StepBasic_sunSteradian);
	Handle(StepBasic_HArray1OfNamedUnit) units = new StepBasic_HArray1OfNamedUnit(1, 3);
	units->SetValue(1, metre);
	units->SetValue(2, radian);
	units->SetValue(3, steradian);
	Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)
		space = new StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext;
	space->Init(text("ap-fwd"), text("3D"), 3, units);
	return space;
}

/* The surfaces as they are, without trimming: a geometric set, one product. */
void add_product(const Handle(StepData_StepModel) & model, size_t count,
                 const batten_surface_net *nets, const Handle(StepBasic_ApplicationContext) & use)
{
	Handle(StepShape_HArray1OfGeometricSetSelect)
		members = new StepShape_HArray1OfGeometricSetSelect(1, static_cast<int>(count));
	for (size_t s = 0; s < count; s++) {
		StepShape_GeometricSetSelect member;
		member.SetValue(step_surface(nets[s]));
		members->SetValue(static_cast<int>(s) + 1, member);
	}
	Handle(StepShape_GeometricSet) set = new StepShape_GeometricSet;
	set->Init(text(nets[0].name), members);
	Handle(StepRepr_HArray1OfRepresentationItem)
		items = new StepRepr_HArray1OfRepresentationItem(1, 1);
	items->SetValue(1, set);
	Handle(StepShape_GeometricallyBoundedSurfaceShapeRepresentation)
		shape = new StepShape_GeometricallyBoundedSurfaceShapeRepresentation;
	shape->Init(text(nets[0].name), items, metric_space());
	STEPConstruct_Part part;
	part.MakeSDR(shape, text(nets[0].name), use);
	part.SetPdescription(text(frame_text));
	model->AddWithRefs(part.SDRValue());
	model->AddWithRefs(part.PRPC());
}

} // namespace

void write_step(size_t count, const batten_surface_net *nets, const exchange_sink &sink)
{
	STEPControl_Controller::Init();
	const Handle(Interface_Protocol) protocol = StepAP214::Protocol();
	Handle(StepData_StepModel) model = new StepData_StepModel;
	model->SetProtocol(protocol);
	APIHeaderSection_MakeHeader header(0);
	header.SetName(text(nets[0].name));
	Handle(Interface_HArray1OfHAsciiString) lines = new Interface_HArray1OfHAsciiString(1, 2);
	lines->SetValue(1, text("B-spline surfaces of a half hull"));
	lines->SetValue(2, text(frame_text));
	header.SetDescription(lines);
	header.SetOriginatingSystem(text("batten"));
	Handle(Interface_HArray1OfHAsciiString) schema = new Interface_HArray1OfHAsciiString(1, 1);
	schema->SetValue(1, text("AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"));
	header.SetSchemaIdentifiers(schema);
	header.Apply(model);
	Handle(StepBasic_ApplicationContext) use = new StepBasic_ApplicationContext;
	use->Init(text("core data for automotive mechanical design processes"));
	Handle(StepBasic_ApplicationProtocolDefinition)
		definition = new StepBasic_ApplicationProtocolDefinition;
	definition->Init(text("international standard"), text("automotive_design"), 2000, use);
	model->AddWithRefs(definition);
	add_product(model, count, nets, use);
	StepData_StepWriter file(model);
	file.FloatWriter().SetFormat(number_format);
	file.SendModel(Handle(StepData_Protocol)::DownCast(protocol));
	std::ostringstream stream;
	if (!file.Print(stream))
		throw refusal{ "OpenCASCADE could not write the entities" };
	hand_over(sink, stream);
}

} // namespace opencascade_module
