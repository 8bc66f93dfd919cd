#include "picture/mesh.h"

#include <math.h>
#include <string.h>

/* A place on the lower and one on the upper of two neighbouring lines, to be joined by a curve. */
typedef struct sample {
	double lower, upper;
	double bend; /* 1: as curved as the lines beyond ask for; 0, at the two ends: straight */
} sample;

/* The strip between two neighbouring lines: it runs over the places both cover and, where the
 * hull's edge is raked there, on to the two ends of the lines. */
typedef struct sample_list {
	size_t capacity, count;
	sample *samples;
} sample_list;

/* An unbroken run of points of a line. */
typedef struct run {
	size_t first, last;
} run;

typedef struct mesh_builder {
	const surface_lines *lines;
	picture_mesh *mesh;
	size_t vertex_capacity, index_capacity;
	size_t cuts; /* pieces of each interval, in both directions */
	/* Of a table finer than any screen only every so manieth line and point is taken. */
	size_t line_stride, point_stride;
	size_t below, above; /* numbers of the two lines at work */
	sample_list strip;
} mesh_builder;

/* Makes room for count more elements of size bytes in an array of used elements. */
static bool make_room(batten_context *context, void **array, size_t used, size_t *capacity,
                      size_t count, size_t size)
{
	if (*capacity - used >= count)
		return true;
	size_t larger = 2 * (used + count);
	void *fresh = batten_allocate(context, larger, size);
	if (!fresh)
		return false;
	if (used)
		memcpy(fresh, *array, used * size);
	batten_release(context, *array);
	*array = fresh;
	*capacity = larger;
	return true;
}

static bool add_sample(mesh_builder *builder, sample next)
{
	sample_list *strip = &builder->strip;
	void *array = strip->samples;
	bool good = make_room(builder->mesh->context, &array, strip->count, &strip->capacity, 1,
	                      sizeof *strip->samples);
	strip->samples = array;
	if (good)
		strip->samples[strip->count++] = next;
	return good;
}

/* Samples between two, the first left out. */
static bool add_samples(mesh_builder *builder, sample from, sample to, size_t pieces)
{
	for (size_t i = 1; i <= pieces; i++) {
		double t = (double)i / (double)pieces;
		sample next = i == pieces ? to
		                          : (sample){ from.lower + t * (to.lower - from.lower),
			                                  from.upper + t * (to.upper - from.upper),
			                                  from.bend + t * (to.bend - from.bend) };
		if (!add_sample(builder, next))
			return false;
	}
	return true;
}

static bool next_run(const surface_line *line, size_t from, run *out)
{
	if (from >= line->count)
		return false;
	out->first = from;
	out->last = from;
	while (!line->open_after[out->last])
		out->last++;
	return true;
}

static size_t points_within(const surface_line *line, double from, double to)
{
	size_t count = 0;
	for (size_t i = 0; i < line->count; i++)
		if (line->along_m[i] > from && line->along_m[i] < to)
			count++;
	return count;
}

/* Whether the surface goes on from the last place both lines cover to their two ends. It does where
 * the edge is raked: both lines end on the centreplane (stem, stern, keel), or one ends no more
 * than a station beyond the other, or the ends were given for their own sake (long layouts). It
 * does not where one line simply stops, as at the break of a forecastle. */
static bool edge_is_raked(const mesh_builder *builder, const surface_line *lower, size_t lower_end,
                          const surface_line *upper, size_t upper_end)
{
	const batten_hull *hull = builder->lines->hull;
	double a = lower->along_m[lower_end];
	double b = upper->along_m[upper_end];
	if (a == b)
		return false;
	double small = 1e-3 * batten_hull_half_beam_m(hull);
	if (lower->y_m[lower_end] <= small && upper->y_m[upper_end] <= small)
		return true;
	const surface_line *longer = (a < b) == (upper_end == 0) ? lower : upper;
	return hull->layout != HULL_LAYOUT_GRID || points_within(longer, fmin(a, b), fmax(a, b)) == 0;
}

/* The next point beyond here, from point i on, in strides; the last one ends the run. */
static size_t point_beyond(const surface_line *line, size_t i, size_t last, double here,
                           size_t stride)
{
	if (line->along_m[i] > here)
		return i;
	while (i < last && line->along_m[i] <= here)
		i++;
	return last - i < stride ? last : i + stride - 1;
}

/* The places of the strip between run a of the lower line and run b of the upper one. */
static bool plan_strip(mesh_builder *builder, const surface_line *lower, run a,
                       const surface_line *upper, run b)
{
	builder->strip.count = 0;
	double from = fmax(lower->along_m[a.first], upper->along_m[b.first]);
	double to = fmin(lower->along_m[a.last], upper->along_m[b.last]);
	if (!(from <= to))
		return true;
	bool good = true;
	size_t cuts = builder->cuts;
	if (edge_is_raked(builder, lower, a.first, upper, b.first)) {
		sample start = { lower->along_m[a.first], upper->along_m[b.first], 0.0 };
		size_t inner = points_within(lower, start.lower, from) +
		               points_within(upper, start.upper, from);
		good = add_sample(builder, start) &&
		       add_samples(builder, start, (sample){ from, from, 1.0 }, cuts * (inner + 1));
	} else {
		good = add_sample(builder, (sample){ from, from, 1.0 });
	}
	/* Over the points of both lines in order. */
	double here = from;
	size_t i = a.first;
	size_t j = b.first;
	while (good && here < to) {
		i = point_beyond(lower, i, a.last, here, builder->point_stride);
		j = point_beyond(upper, j, b.last, here, builder->point_stride);
		double next = fmin(fmin(lower->along_m[i], upper->along_m[j]), to);
		good = add_samples(builder, (sample){ here, here, 1.0 }, (sample){ next, next, 1.0 }, cuts);
		here = next;
	}
	if (good && edge_is_raked(builder, lower, a.last, upper, b.last)) {
		sample end = { lower->along_m[a.last], upper->along_m[b.last], 0.0 };
		size_t inner = points_within(lower, to, end.lower) + points_within(upper, to, end.upper);
		good = add_samples(builder, (sample){ to, to, 1.0 }, end, cuts * (inner + 1));
	}
	return good;
}

/* Number of a place among ascending coordinates, linear between and beyond them. */
static double number_at(const double *coordinate, size_t count, double at)
{
	size_t low = 0;
	size_t high = count - 1;
	while (high - low > 1) {
		size_t middle = low + (high - low) / 2;
		if (coordinate[middle] <= at)
			low = middle;
		else
			high = middle;
	}
	return (double)low + (at - coordinate[low]) / (coordinate[high] - coordinate[low]);
}

static void set_vertex(const surface_lines *lines, double along, double across, double y,
                       const double slopes[2], picture_vertex *vertex)
{
	const batten_hull *hull = lines->hull;
	double x = lines->waterlines ? along : across;
	double z = lines->waterlines ? across : along;
	double y_x = slopes[lines->waterlines ? 0 : 1];
	double y_z = slopes[lines->waterlines ? 1 : 0];
	double length = sqrt(1.0 + y_x * y_x + y_z * y_z);
	vertex->position[0] = (float)x;
	vertex->position[1] = (float)(y > 0.0 ? y : 0.0);
	vertex->position[2] = (float)z;
	vertex->normal[0] = (float)(-y_x / length);
	vertex->normal[1] = (float)(1.0 / length);
	vertex->normal[2] = (float)(-y_z / length);
	vertex->grid[0] = (float)number_at(hull->x_m, hull->station_count, x);
	vertex->grid[1] = (float)number_at(hull->z_m, hull->waterline_count, z);
}

/* The cuts + 1 vertices that join the two lines at sample i of the strip. */
static void spin_rung(const mesh_builder *builder, size_t i, picture_vertex *rung)
{
	const surface_lines *lines = builder->lines;
	size_t below = builder->below;
	size_t above = builder->above;
	double from = builder->strip.samples[i].lower;
	double to = builder->strip.samples[i].upper;
	line_sample a = surface_line_at(&lines->lines[below], from);
	line_sample b = surface_line_at(&lines->lines[above], to);
	double step = lines->across_m[above] - lines->across_m[below];
	double slope_a, slope_b, value_slope_a, value_slope_b;
	surface_slope_across(lines, below, from, &slope_a, &value_slope_a);
	surface_slope_across(lines, above, to, &slope_b, &value_slope_b);
	double bend = builder->strip.samples[i].bend;
	double straight = b.y_m - a.y_m;
	double ends[2] = { straight + bend * (step * slope_a - straight),
		               straight + bend * (step * slope_b - straight) };
	picture_keep_positive(a.y_m, b.y_m, &ends[0], &ends[1]);
	for (size_t m = 0; m <= builder->cuts; m++) {
		double t = (double)m / (double)builder->cuts;
		double y = picture_hermite(a.y_m, b.y_m, ends[0], ends[1], t);
		double slopes[2] = {
			(1.0 - t) * a.slope + t * b.slope,
			picture_hermite_slope(a.y_m, b.y_m, ends[0], ends[1], t) / step,
		};
		double across = m == builder->cuts ? lines->across_m[above]
		                                   : lines->across_m[below] + t * step;
		set_vertex(lines, from + t * (to - from), across, y, slopes, &rung[m]);
		rung[m].value = (float)picture_hermite(a.value, b.value, step * value_slope_a,
		                                       step * value_slope_b, t);
		rung[m].known = (float)((1.0 - t) * a.known + t * b.known);
	}
}

/* Triangles between two neighbouring rungs of cuts + 1 vertices. */
static void spin_triangles(const mesh_builder *builder, size_t first, size_t second,
                           uint32_t *indices)
{
	bool swap = !builder->lines->waterlines;
	for (size_t m = 0; m < builder->cuts; m++) {
		uint32_t corner[4] = {
			(uint32_t)(first + m),
			(uint32_t)(second + m),
			(uint32_t)(second + m + 1),
			(uint32_t)(first + m + 1),
		};
		uint32_t *out = indices + 6 * m;
		out[0] = corner[0];
		out[1] = corner[swap ? 2 : 1];
		out[2] = corner[swap ? 1 : 2];
		out[3] = corner[0];
		out[4] = corner[swap ? 3 : 2];
		out[5] = corner[swap ? 2 : 3];
	}
}

static bool spin_strip(mesh_builder *builder)
{
	picture_mesh *mesh = builder->mesh;
	batten_context *context = mesh->context;
	size_t rung = builder->cuts + 1;
	size_t samples = builder->strip.count;
	if (samples < 2)
		return true;
	size_t indices = 6 * builder->cuts * (samples - 1);
	if (mesh->vertex_count + samples * rung > UINT32_MAX ||
	    mesh->index_count + indices > UINT32_MAX) {
		(void)batten_fail(context, BATTEN_MEMORY, "the table is too large for a picture");
		return false;
	}
	void *array = mesh->vertices;
	bool good = make_room(context, &array, mesh->vertex_count, &builder->vertex_capacity,
	                      samples * rung, sizeof *mesh->vertices);
	mesh->vertices = array;
	array = mesh->indices;
	good = good && make_room(context, &array, mesh->index_count, &builder->index_capacity, indices,
	                         sizeof *mesh->indices);
	mesh->indices = array;
	if (!good)
		return false;
	for (size_t i = 0; i < samples; i++) {
		spin_rung(builder, i, mesh->vertices + mesh->vertex_count);
		mesh->vertex_count += rung;
		if (i == 0)
			continue;
		spin_triangles(builder, mesh->vertex_count - 2 * rung, mesh->vertex_count - rung,
		               mesh->indices + mesh->index_count);
		mesh->index_count += 6 * builder->cuts;
	}
	return true;
}

static bool spin_between(mesh_builder *builder)
{
	const surface_line *lower = &builder->lines->lines[builder->below];
	const surface_line *upper = &builder->lines->lines[builder->above];
	run a, b;
	size_t i = 0;
	size_t j = 0;
	while (next_run(lower, i, &a) && next_run(upper, j, &b)) {
		if (!plan_strip(builder, lower, a, upper, b) || !spin_strip(builder))
			return false;
		if (lower->along_m[a.last] <= upper->along_m[b.last])
			i = a.last + 1;
		else
			j = b.last + 1;
	}
	return true;
}

static void take_box(picture_mesh *mesh)
{
	for (int axis = 0; axis < 3; axis++) {
		mesh->low[axis] = INFINITY;
		mesh->high[axis] = -INFINITY;
	}
	for (size_t i = 0; i < mesh->vertex_count; i++)
		for (int axis = 0; axis < 3; axis++) {
			double at = (double)mesh->vertices[i].position[axis];
			mesh->low[axis] = fmin(mesh->low[axis], at);
			mesh->high[axis] = fmax(mesh->high[axis], at);
		}
}

/* Enough pieces for smooth outlines on small tables, about half a million vertices on middling
 * ones, at most about a thousand lines and points of each on large ones. */
static void choose_fineness(mesh_builder *builder, const batten_hull *hull)
{
	double intervals = (double)hull->station_count * (double)hull->waterline_count;
	double cuts = fmin(fmax(sqrt(5e5 / intervals), 1.0), 10.0);
	builder->cuts = (size_t)cuts;
	bool waterlines = builder->lines->waterlines;
	size_t points = waterlines ? hull->station_count : hull->waterline_count;
	builder->line_stride = 1 + builder->lines->count / 1025;
	builder->point_stride = 1 + points / 1025;
}

static batten_status spin(mesh_builder *builder)
{
	picture_mesh *mesh = builder->mesh;
	size_t last = builder->lines->count - 1;
	for (builder->below = 0; builder->below < last; builder->below = builder->above) {
		size_t left = last - builder->below;
		builder->above = builder->below +
		                 (left < builder->line_stride ? left : builder->line_stride);
		if (!spin_between(builder))
			return BATTEN_MEMORY;
	}
	if (mesh->index_count == 0)
		return batten_fail(mesh->context, BATTEN_INPUT,
		                   "%s: nothing to draw: no two neighbouring lines have hull at one place",
		                   builder->lines->hull->name);
	take_box(mesh);
	return BATTEN_OK;
}

batten_status picture_mesh_create(batten_context *context, const batten_hull *hull,
                                  const picture_field *field, picture_mesh **out)
{
	surface_lines *lines = NULL;
	batten_status status = surface_lines_create(context, hull, field, &lines);
	if (status != BATTEN_OK)
		return status;
	mesh_builder builder = { .lines = lines };
	choose_fineness(&builder, hull);
	builder.mesh = batten_allocate(context, 1, sizeof *builder.mesh);
	if (builder.mesh) {
		builder.mesh->context = context;
		status = spin(&builder);
	} else {
		status = BATTEN_MEMORY;
	}
	batten_release(context, builder.strip.samples);
	surface_lines_destroy(lines);
	if (status != BATTEN_OK) {
		picture_mesh_destroy(builder.mesh);
		return status;
	}
	*out = builder.mesh;
	return BATTEN_OK;
}

void picture_mesh_destroy(picture_mesh *mesh)
{
	if (!mesh)
		return;
	batten_release(mesh->context, mesh->vertices);
	batten_release(mesh->context, mesh->indices);
	batten_release(mesh->context, mesh);
}
