#include "picture/view.h"

#include <math.h>

static const double radians = 3.14159265358979323846 / 180.0;

static void normalise(double v[3])
{
	double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
	for (int i = 0; i < 3; i++)
		v[i] /= length;
}

static void cross(const double a[3], const double b[3], double out[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static picture_view empty_view(const picture_rectangle *rectangle)
{
	return (picture_view){
		.left = (uint32_t)lround(rectangle->left),
		.top = (uint32_t)lround(rectangle->top),
		.width = (uint32_t)fmax(1.0, floor(rectangle->width)),
		.height = (uint32_t)fmax(1.0, floor(rectangle->height)),
	};
}

static void set_light(picture_view *view, double x, double y, double z)
{
	double light[3] = { x, y, z };
	normalise(light);
	for (int i = 0; i < 3; i++)
		view->light[i] = (float)light[i];
}

profile_scale picture_profile_fit(const picture_mesh *mesh, const picture_rectangle *rectangle)
{
	double length = fmax(mesh->high[0] - mesh->low[0], 1e-12);
	double height = fmax(mesh->high[2] - mesh->low[2], 1e-12);
	profile_scale scale = { .exaggeration = 1.0 };
	scale.pixels_per_m = fmin(rectangle->width / length, rectangle->height / height);
	double room = rectangle->height / (height * scale.pixels_per_m);
	scale.exaggeration = fmax(1.0, fmin(4.0, floor(room)));
	double middle_x = 0.5 * (mesh->low[0] + mesh->high[0]);
	double middle_z = 0.5 * (mesh->low[2] + mesh->high[2]);
	scale.x_left = rectangle->left + 0.5 * rectangle->width - middle_x * scale.pixels_per_m;
	scale.z_top = rectangle->top + 0.5 * rectangle->height +
	              middle_z * scale.pixels_per_m * scale.exaggeration;
	return scale;
}

picture_view picture_profile_view(const picture_mesh *mesh, const picture_rectangle *rectangle,
                                  const profile_scale *scale)
{
	picture_view view = empty_view(rectangle);
	double across = 2.0 / view.width;
	double down = 2.0 / view.height;
	double breadth = fmax(fmax(fabs(mesh->high[1]), fabs(mesh->low[1])), 1e-12);
	float *m = view.clip_from_hull;
	m[0] = (float)(scale->pixels_per_m * across);
	m[12] = (float)((scale->x_left - view.left) * across - 1.0);
	m[9] = (float)(-scale->pixels_per_m * scale->exaggeration * down);
	m[13] = (float)((scale->z_top - view.top) * down - 1.0);
	m[6] = (float)(0.4 / breadth); /* starboard is near */
	m[14] = 0.5F;
	m[15] = 1.0F;
	set_light(&view, 0.25, -1.0, 0.6);
	return view;
}

/* The eye and its axes. */
typedef struct camera_axes {
	double eye[3], right[3], up[3], forward[3];
} camera_axes;

static camera_axes place_camera(const picture_mesh *mesh, double azimuth, double elevation)
{
	double length = mesh->high[0] - mesh->low[0];
	double distance = 2.2 * fmax(length, 2.0 * mesh->high[1]);
	camera_axes camera;
	double to_eye[3] = {
		cos(azimuth * radians) * cos(elevation * radians),
		-sin(azimuth * radians) * cos(elevation * radians),
		sin(elevation * radians),
	};
	double middle[3] = { 0.5 * (mesh->low[0] + mesh->high[0]), 0.0,
		                 0.5 * (mesh->low[2] + mesh->high[2]) };
	for (int i = 0; i < 3; i++) {
		camera.eye[i] = middle[i] + fmax(distance, 1e-9) * to_eye[i];
		camera.forward[i] = -to_eye[i];
	}
	double vertical[3] = { 0.0, 0.0, 1.0 };
	cross(camera.forward, vertical, camera.right);
	normalise(camera.right);
	cross(camera.right, camera.forward, camera.up);
	return camera;
}

/* What the hull covers on a plane one unit before the eye, and its depths. */
typedef struct seen_extent {
	double low[3], high[3];
} seen_extent;

static seen_extent measure_extent(const picture_mesh *mesh, const camera_axes *camera)
{
	seen_extent extent = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
	for (size_t i = 0; i < 2 * mesh->vertex_count; i++) {
		const float *p = mesh->vertices[i / 2].position;
		double side = i % 2 ? -1.0 : 1.0;
		double from_eye[3] = { (double)p[0] - camera->eye[0], side * (double)p[1] - camera->eye[1],
			                   (double)p[2] - camera->eye[2] };
		double depth = dot(from_eye, camera->forward);
		double seen[3] = { dot(from_eye, camera->right) / depth, dot(from_eye, camera->up) / depth,
			               depth };
		for (int axis = 0; axis < 3; axis++) {
			extent.low[axis] = fmin(extent.low[axis], seen[axis]);
			extent.high[axis] = fmax(extent.high[axis], seen[axis]);
		}
	}
	return extent;
}

/* Sets one row of the matrix: factor times an axis of the camera plus share times the depth. */
static void set_row(picture_view *view, int row, const camera_axes *camera, const double axis[3],
                    double factor, double share)
{
	double fourth = 0.0;
	for (int i = 0; i < 3; i++) {
		double entry = factor * axis[i] + share * camera->forward[i];
		view->clip_from_hull[4 * i + row] = (float)entry;
		fourth -= entry * camera->eye[i];
	}
	view->clip_from_hull[12 + row] = (float)fourth;
}

picture_view picture_perspective_view(const picture_mesh *mesh, const picture_rectangle *rectangle,
                                      double azimuth, double elevation)
{
	picture_view view = empty_view(rectangle);
	camera_axes camera = place_camera(mesh, azimuth, elevation);
	seen_extent extent = measure_extent(mesh, &camera);
	double wide = fmax(extent.high[0] - extent.low[0], 1e-12);
	double tall = fmax(extent.high[1] - extent.low[1], 1e-12);
	double pixels = fmin(view.width / wide, view.height / tall);
	double across = 2.0 * pixels / view.width;
	double down = -2.0 * pixels / view.height;
	set_row(&view, 0, &camera, camera.right, across,
	        -0.5 * across * (extent.low[0] + extent.high[0]));
	set_row(&view, 1, &camera, camera.up, down, -0.5 * down * (extent.low[1] + extent.high[1]));
	set_row(&view, 3, &camera, camera.forward, 1.0, 0.0);
	/* Depth 0 a little before the nearest point, 1 a little behind the farthest. */
	double near = 0.9 * extent.low[2];
	double far = 1.1 * extent.high[2];
	set_row(&view, 2, &camera, camera.forward, far / (far - near), 0.0);
	view.clip_from_hull[14] -= (float)(far * near / (far - near));
	double light[3];
	for (int i = 0; i < 3; i++)
		light[i] = 0.5 * camera.up[i] - camera.forward[i] + 0.3 * camera.right[i];
	set_light(&view, light[0], light[1], light[2]);
	return view;
}
