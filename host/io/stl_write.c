/* A surface as triangles, in binary STL: both halves of the hull, normals outward. */
#include "core/file.h"
#include "geometry/surface.h"

#include <math.h>
#include <string.h>

enum { STEPS_MOST = 64, HEADER_SIZE = 80, RECORD_SIZE = 50 };

/* Points of a grid over the surface. */
struct samples {
	size_t count_u, count_v;
	double *u, *v, *points_m; /* points [count_v][count_u][3] */
};

/* Parameters of one direction: so many steps in each span between different knots. */
static batten_status sample_direction(batten_context *context, const double *knots, size_t order,
                                      size_t count, size_t steps, double **out, size_t *out_count)
{
	double *values = batten_allocate(context, (count - order + 1) * steps + 1, sizeof *values);
	if (!values)
		return BATTEN_MEMORY;
	size_t made = 0;
	for (size_t k = order - 1; k < count; k++) {
		if (!(knots[k + 1] > knots[k]))
			continue;
		for (size_t s = 0; s < steps; s++)
			values[made++] = knots[k] + (knots[k + 1] - knots[k]) * ((double)s / (double)steps);
	}
	values[made++] = knots[count];
	*out = values;
	*out_count = made;
	return BATTEN_OK;
}

static batten_status sample(batten_context *context, const batten_surface *surface, size_t steps,
                            struct samples *out)
{
	const batten_surface_net net = batten_surface_describe(surface);
	batten_status status = sample_direction(context, net.knots_u, net.order_u, net.count_u, steps,
	                                        &out->u, &out->count_u);
	if (status == BATTEN_OK)
		status = sample_direction(context, net.knots_v, net.order_v, net.count_v, steps, &out->v,
		                          &out->count_v);
	if (status != BATTEN_OK)
		return status;
	out->points_m = batten_allocate(context, out->count_u * out->count_v, 3 * sizeof(double));
	if (!out->points_m)
		return BATTEN_MEMORY;
	for (size_t j = 0; j < out->count_v && status == BATTEN_OK; j++)
		for (size_t i = 0; i < out->count_u && status == BATTEN_OK; i++) {
			batten_surface_point point;
			status = batten_surface_evaluate(surface, out->u[i], out->v[j], &point);
			if (status == BATTEN_OK)
				memcpy(out->points_m + 3 * (j * out->count_u + i), point.derivative[0][0],
				       3 * sizeof(double));
		}
	return status;
}

/* A triangle that is more than a line and not in the centreplane, where its image would lie on it; returns
 * whether it was written. */
static bool put_triangle(FILE *stream, const double *a, const double *b, const double *c,
                         bool mirror)
{
	const double side = mirror ? -1.0 : 1.0;
	const double *corners[3] = { a, mirror ? c : b, mirror ? b : c };
	if ((float)a[1] == 0 && (float)b[1] == 0 && (float)c[1] == 0)
		return false;
	double edge[2][3];
	for (size_t d = 0; d < 3; d++) {
		const double sign = d == 1 ? side : 1.0;
		edge[0][d] = sign * (corners[1][d] - corners[0][d]);
		edge[1][d] = sign * (corners[2][d] - corners[0][d]);
	}
	double normal[3] = { edge[0][1] * edge[1][2] - edge[0][2] * edge[1][1],
		                 edge[0][2] * edge[1][0] - edge[0][0] * edge[1][2],
		                 edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0] };
	const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] +
	                           normal[2] * normal[2]);
	if (!(length > 1e-12))
		return false;
	float record[12];
	for (size_t d = 0; d < 3; d++) {
		record[d] = (float)(normal[d] / length);
		for (size_t k = 0; k < 3; k++)
			record[3 + 3 * k + d] = (float)((d == 1 ? side : 1.0) * corners[k][d]);
	}
	char bytes[RECORD_SIZE] = { 0 };
	memcpy(bytes, record, sizeof record);
	(void)fwrite(bytes, 1, sizeof bytes, stream);
	return true;
}

/* u runs forward and v up, so that by_v x by_u points to the water (batten.h). */
static uint32_t put_half(FILE *stream, const struct samples *samples, bool mirror)
{
	uint32_t written = 0;
	for (size_t j = 0; j + 1 < samples->count_v; j++)
		for (size_t i = 0; i + 1 < samples->count_u; i++) {
			const double *p = samples->points_m + 3 * (j * samples->count_u + i);
			const double *forward = p + 3;
			const double *up = p + 3 * samples->count_u;
			const double *across = up + 3;
			written += put_triangle(stream, p, up, forward, mirror);
			written += put_triangle(stream, forward, up, across, mirror);
		}
	return written;
}

static batten_status write_samples(batten_context *context, const struct samples *samples,
                                   const char *path)
{
	batten_file file;
	const batten_status status = batten_file_open(context, path, &file);
	if (status != BATTEN_OK)
		return status;
	char header[HEADER_SIZE + sizeof(uint32_t)] = "batten, metres, frame ap-fwd";
	(void)fwrite(header, 1, sizeof header, file.stream);
	const uint32_t count = put_half(file.stream, samples, false) +
	                       put_half(file.stream, samples, true);
	if (fseek(file.stream, HEADER_SIZE, SEEK_SET) == 0)
		(void)fwrite(&count, 1, sizeof count, file.stream);
	return batten_file_commit(context, &file);
}

batten_status batten_surface_write_stl(batten_context *context, const batten_surface *surface,
                                       size_t steps, const char *path)
{
	if (steps < 1 || steps > STEPS_MOST)
		return batten_fail(context, BATTEN_USAGE, "%zu steps a span, expected 1 to %d", steps,
		                   STEPS_MOST);
	struct samples samples = { 0 };
	batten_status status = sample(context, surface, steps, &samples);
	if (status == BATTEN_OK)
		status = write_samples(context, &samples, path);
	batten_release(context, samples.u);
	batten_release(context, samples.v);
	batten_release(context, samples.points_m);
	return status;
}
