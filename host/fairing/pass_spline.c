#include "fairing/pass_spline.h"

#include "fairing/pass_system.h"

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
/* The formulas need the dialect. */
#include "shared/line_spline.h"

/* Stencil at t, in span number span. */
static pass_stencil stencil_at(size_t order, size_t count, size_t span, double t)
{
	pass_stencil stencil = { .first = span };
	spline_basis((int)order, (double)(count - order + 1), (double)span, t, stencil.weight);
	return stencil;
}

void pass_stencils_polygon(size_t order, size_t count, const double *along, pass_stencil *stencils)
{
	const double last = (double)(count - order + 1);
	size_t span = 0;
	for (size_t i = 0; i < count; i++) {
		/* x(t) ascends with its vertices: spans are met one after the other. */
		while (span + order < count &&
		       spline_value((int)order, last, (double)(span + 1), (double)(span + 1),
		                    along + span + 1) <= along[i])
			span++;
		const double t = spline_parameter((int)order, last, (double)span, along + span, along[i]);
		stencils[i] = stencil_at(order, count, span, t);
	}
}

size_t pass_least_points(const pass_representation *r)
{
	const size_t least = r->order > r->vertices ? r->order : r->vertices;
	return least > 3 ? least : 3;
}

static void smooth_polygon(pass_writer *writer, size_t order, size_t count, const double *along,
                           const size_t *in, const size_t *out, pass_stencil *stencils)
{
	pass_stencils_polygon(order, count, along, stencils);
	for (size_t i = 0; i < count; i++) {
		const bool end = i == 0 || i + 1 == count;
		for (size_t j = 0; j < (end ? 0 : order); j++)
			pass_term(writer, in[stencils[i].first + j], stencils[i].weight[j]);
		if (end)
			pass_term(writer, in[i], 1.0);
		pass_row(writer, out[i]);
	}
}

/* N^T N of the points' stencils. */
static batten_status normal_equations(pass_writer *writer, const pass_representation *r,
                                      size_t count, const pass_stencil *stencils, pass_system *out)
{
	size_t *first = batten_allocate(writer->context, r->vertices, sizeof *first);
	if (!first)
		return BATTEN_MEMORY;
	for (size_t v = 0; v < r->vertices; v++)
		first[v] = v + 1 > r->order ? v + 1 - r->order : 0;
	const batten_status status = pass_system_create(writer->context, r->vertices, first, out);
	batten_release(writer->context, first);
	if (status != BATTEN_OK)
		return status;
	for (size_t i = 0; i < count; i++)
		for (size_t a = 0; a < r->order; a++)
			for (size_t b = 0; b <= a; b++)
				pass_system_add(out, stencils[i].first + a, stencils[i].first + b,
				                stencils[i].weight[a] * stencils[i].weight[b]);
	return BATTEN_OK;
}

/* Vertices by least squares, the first and the last the end points; then the curve at the points. x
 * is linear in such a parameter, so x(t) = x_i where the parameter is that of the point. */
static void write_fit(pass_writer *writer, const pass_representation *r, size_t count,
                      const size_t *in, const size_t *out, const pass_stencil *stencils,
                      const pass_system *system, size_t *vertices)
{
	const size_t room = pass_room(writer, r->vertices);
	for (size_t v = 0; v < r->vertices; v++)
		vertices[v] = room + v;
	pass_operation(writer, PASS_ROWS);
	for (size_t v = 0; v < r->vertices; v++) {
		size_t terms = 0;
		for (size_t i = 0; i < count; i++)
			if (v >= stencils[i].first && v < stencils[i].first + r->order) {
				pass_term(writer, in[i], stencils[i].weight[v - stencils[i].first]);
				terms++;
			}
		if (terms > 0)
			pass_row(writer, vertices[v]);
	}
	pass_system_write(system, writer, vertices);
	vertices[0] = in[0];
	vertices[r->vertices - 1] = in[count - 1];
	pass_operation(writer, PASS_ROWS);
	for (size_t i = 0; i < count; i++) {
		for (size_t j = 0; j < r->order; j++)
			pass_term(writer, vertices[stencils[i].first + j], stencils[i].weight[j]);
		pass_row(writer, out[i]);
	}
}

static bool smooth_fit(pass_writer *writer, const pass_representation *r, size_t count,
                       const double *along, const size_t *in, const size_t *out,
                       pass_stencil *stencils)
{
	const double last = (double)(r->vertices - r->order + 1);
	for (size_t i = 0; i < count; i++) {
		const double t = last * (along[i] - along[0]) / (along[count - 1] - along[0]);
		size_t span = (size_t)t;
		if (span > r->vertices - r->order)
			span = r->vertices - r->order;
		stencils[i] = stencil_at(r->order, r->vertices, span, t);
	}
	pass_system system = { 0 };
	size_t *vertices = batten_allocate(writer->context, r->vertices, sizeof *vertices);
	writer->status = vertices ? normal_equations(writer, r, count, stencils, &system)
	                          : BATTEN_MEMORY;
	const bool done = writer->status == BATTEN_OK && pass_system_factor(&system);
	if (done)
		write_fit(writer, r, count, in, out, stencils, &system, vertices);
	pass_system_release(&system);
	batten_release(writer->context, vertices);
	return done;
}

void pass_smooth(pass_writer *writer, const pass_representation *r, size_t count,
                 const double *along, const size_t *in, const size_t *out, bool *done)
{
	*done = false;
	if (writer->status != BATTEN_OK || count < pass_least_points(r))
		return;
	pass_stencil *stencils = batten_allocate(writer->context, count, sizeof *stencils);
	if (!stencils) {
		writer->status = BATTEN_MEMORY;
		return;
	}
	if (r->vertices > 0) {
		*done = smooth_fit(writer, r, count, along, in, out, stencils);
	} else {
		smooth_polygon(writer, r->order, count, along, in, out, stencils);
		*done = true;
	}
	batten_release(writer->context, stencils);
}
