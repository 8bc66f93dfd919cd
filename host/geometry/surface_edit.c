/* Changes of a surface in place. A direction is worked on by bspline_refine.h, whose rows are lines
 * of the net across that direction. */
#include "geometry/bspline_refine.h"
#include "geometry/surface.h"

#include <string.h>

struct shape {
	size_t *order, *count;
	double **knots;
};

static struct shape shape_of(struct batten_surface *surface, batten_direction direction)
{
	if (direction == BATTEN_DIRECTION_U)
		return (struct shape){ &surface->order_u, &surface->count_u, &surface->knots_u };
	return (struct shape){ &surface->order_v, &surface->count_v, &surface->knots_v };
}

/* to[j][i] = from[i][j], each size numbers. */
static void transpose(size_t rows, size_t columns, size_t size, const double *from, double *to)
{
	for (size_t i = 0; i < rows; i++)
		for (size_t j = 0; j < columns; j++)
			memcpy(to + (j * rows + i) * size, from + (i * columns + j) * size, size * sizeof *to);
}

/* The lines of the net across a direction as rows; knots is the surface's own. */
static batten_status lines_of(struct batten_surface *surface, batten_direction direction,
                              struct bspline_rows *out)
{
	struct shape shape = shape_of(surface, direction);
	size_t width = bspline_homogeneous_width(3, surface->weights);
	size_t poles = surface->count_u * surface->count_v;
	*out = (struct bspline_rows){ .order = *shape.order,
		                          .count = *shape.count,
		                          .width = poles / *shape.count * width,
		                          .knots = *shape.knots };
	double *net = batten_allocate(surface->context, poles, width * sizeof *net);
	if (!net)
		return BATTEN_MEMORY;
	bspline_to_homogeneous(poles, 3, surface->poles, surface->weights, net);
	if (direction == BATTEN_DIRECTION_V) {
		out->rows = net;
		return BATTEN_OK;
	}
	out->rows = batten_allocate(surface->context, poles, width * sizeof *out->rows);
	if (out->rows)
		transpose(surface->count_v, surface->count_u, width, net, out->rows);
	batten_release(surface->context, net);
	return out->rows ? BATTEN_OK : BATTEN_MEMORY;
}

/* A surface like another with lines in the place of its own along a direction. */
static batten_status surface_with(const struct batten_surface *surface, batten_direction direction,
                                  const struct bspline_rows *lines, struct batten_surface **out)
{
	batten_context *context = surface->context;
	bool along_u = direction == BATTEN_DIRECTION_U;
	batten_surface_net net = batten_surface_describe(surface);
	struct batten_surface *next;
	batten_status status = surface_allocate(
		context, net.name, along_u ? lines->order : net.order_u,
		along_u ? net.order_v : lines->order, along_u ? lines->count : net.count_u,
		along_u ? net.count_v : lines->count, net.weights, &next);
	if (status != BATTEN_OK)
		return status;
	size_t width = bspline_homogeneous_width(3, net.weights);
	size_t poles = next->count_u * next->count_v;
	double *turned = batten_allocate(context, poles, width * sizeof *turned);
	if (!turned) {
		batten_surface_destroy(next);
		return BATTEN_MEMORY;
	}
	if (along_u)
		transpose(next->count_u, next->count_v, width, lines->rows, turned);
	else
		memcpy(turned, lines->rows, poles * width * sizeof *turned);
	bspline_from_homogeneous(poles, 3, turned, next->poles, next->weights);
	batten_release(context, turned);
	memcpy(next->knots_u, along_u ? lines->knots : net.knots_u,
	       (next->count_u + next->order_u) * sizeof *next->knots_u);
	memcpy(next->knots_v, along_u ? net.knots_v : lines->knots,
	       (next->count_v + next->order_v) * sizeof *next->knots_v);
	status = surface_check(next);
	if (status == BATTEN_OK)
		*out = next;
	else
		batten_surface_destroy(next);
	return status;
}

/* Takes the lines over: they become those of the surface, or are released. */
static batten_status replace_lines(struct batten_surface *surface, batten_direction direction,
                                   struct bspline_rows *lines)
{
	struct batten_surface *next;
	batten_status status = surface_with(surface, direction, lines, &next);
	bspline_rows_release(surface->context, lines);
	if (status != BATTEN_OK)
		return status;
	struct batten_surface old = *surface;
	*surface = *next;
	*next = old;
	batten_surface_destroy(next);
	return BATTEN_OK;
}

batten_status batten_surface_insert_knot(batten_surface *surface, batten_direction direction,
                                         double t, size_t times)
{
	struct bspline_rows lines;
	struct bspline_rows finer;
	if (times == 0)
		return BATTEN_OK;
	batten_status status = lines_of(surface, direction, &lines);
	if (status != BATTEN_OK)
		return status;
	status = bspline_rows_insert(surface->context, &lines, t, times, &finer);
	batten_release(surface->context, lines.rows);
	return status == BATTEN_OK ? replace_lines(surface, direction, &finer) : status;
}

batten_status batten_surface_elevate(batten_surface *surface, batten_direction direction,
                                     size_t times)
{
	struct bspline_rows lines;
	struct bspline_rows finer;
	if (times == 0)
		return BATTEN_OK;
	batten_status status = lines_of(surface, direction, &lines);
	if (status != BATTEN_OK)
		return status;
	status = bspline_rows_elevate(surface->context, &lines, times, &finer);
	batten_release(surface->context, lines.rows);
	return status == BATTEN_OK ? replace_lines(surface, direction, &finer) : status;
}

void batten_surface_reverse(batten_surface *surface, batten_direction direction)
{
	struct shape shape = shape_of(surface, direction);
	size_t count_u = surface->count_u;
	bspline_knots_reverse(*shape.order, *shape.count, *shape.knots);
	if (direction == BATTEN_DIRECTION_V) {
		bspline_rows_reverse(surface->count_v, 3 * count_u, surface->poles);
		if (surface->weights)
			bspline_rows_reverse(surface->count_v, count_u, surface->weights);
		return;
	}
	for (size_t row = 0; row < surface->count_v; row++) {
		bspline_rows_reverse(count_u, 3, surface->poles + 3 * row * count_u);
		if (surface->weights)
			bspline_rows_reverse(count_u, 1, surface->weights + row * count_u);
	}
}

batten_status batten_surface_set_poles(batten_surface *surface, const double *poles_m)
{
	size_t poles = surface->count_u * surface->count_v;
	batten_status status = bspline_poles_check(surface->context, poles, 3, poles_m,
	                                           surface->weights);
	if (status == BATTEN_OK)
		memcpy(surface->poles, poles_m, 3 * poles * sizeof *surface->poles);
	return status;
}

batten_status batten_surface_map(batten_surface *surface, const double matrix[9],
                                 const double shift_m[3])
{
	return bspline_poles_map(surface->context, surface->count_u * surface->count_v, 3, matrix,
	                         shift_m, surface->poles);
}

void batten_surface_mirror(batten_surface *surface)
{
	for (size_t i = 0; i < surface->count_u * surface->count_v; i++)
		surface->poles[3 * i + 1] = 0 - surface->poles[3 * i + 1]; /* 0 stays +0 */
	batten_surface_reverse(surface, BATTEN_DIRECTION_U);
}
