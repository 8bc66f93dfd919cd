#include "geometry/least_squares.h"

#include <math.h>
#include <string.h>

/* A diagonal below this part of its column's numbers is nothing but rounding. */
static const double rank_part = 1e-15;

batten_status least_squares_create(batten_context *context, size_t columns, size_t width,
                                   size_t sides, struct least_squares *out)
{
	struct least_squares system = {
		.context = context, .columns = columns, .width = width, .sides = sides
	};
	system.triangle = batten_allocate(context, columns, width * sizeof *system.triangle);
	system.right = batten_allocate(context, columns, sides * sizeof *system.right);
	system.row = batten_allocate(context, columns + width, sizeof *system.row);
	system.largest = batten_allocate(context, columns, sizeof *system.largest);
	*out = system;
	if (system.triangle && system.right && system.row && system.largest)
		return BATTEN_OK;
	least_squares_destroy(out);
	return BATTEN_MEMORY;
}

void least_squares_destroy(struct least_squares *system)
{
	if (system->context) {
		batten_release(system->context, system->triangle);
		batten_release(system->context, system->right);
		batten_release(system->context, system->row);
		batten_release(system->context, system->largest);
	}
	*system = (struct least_squares){ 0 };
}

/* Turns (a, b) by the angle with this cosine and sine. */
static void turn(double cosine, double sine, double *a, double *b)
{
	double old = *a;
	*a = cosine * old + sine * *b;
	*b = cosine * *b - sine * old;
}

/* Rotates the row at work against the triangle's row for column; its number there becomes 0. */
static void rotate(struct least_squares *system, size_t column, double *right)
{
	double *triangle = system->triangle + column * system->width;
	double *row = system->row + column;
	double length = hypot(triangle[0], row[0]);
	double cosine = triangle[0] / length;
	double sine = row[0] / length;
	for (size_t j = 0; j < system->width; j++)
		turn(cosine, sine, &triangle[j], &row[j]);
	for (size_t s = 0; s < system->sides; s++)
		turn(cosine, sine, &system->right[column * system->sides + s], &right[s]);
}

void least_squares_add(struct least_squares *system, size_t first, size_t count, const double *row,
                       const double *right)
{
	double at_work[LEAST_SQUARES_SIDES_MOST];
	memset(system->row, 0, (system->columns + system->width) * sizeof *system->row);
	memcpy(system->row + first, row, count * sizeof *row);
	memcpy(at_work, right, system->sides * sizeof *right);
	for (size_t j = 0; j < count; j++)
		system->largest[first + j] = fmax(system->largest[first + j], fabs(row[j]));
	for (size_t column = first; column < system->columns; column++)
		if (system->row[column] != 0)
			rotate(system, column, at_work);
}

bool least_squares_solve(const struct least_squares *system, double *solution)
{
	size_t sides = system->sides;
	for (size_t i = system->columns; i-- > 0;) {
		const double *triangle = system->triangle + i * system->width;
		if (!(fabs(triangle[0]) > rank_part * system->largest[i]))
			return false;
		for (size_t s = 0; s < sides; s++) {
			double sum = system->right[i * sides + s];
			for (size_t j = 1; j < system->width && i + j < system->columns; j++)
				sum -= triangle[j] * solution[(i + j) * sides + s];
			solution[i * sides + s] = sum / triangle[0];
		}
	}
	return true;
}
