#include "core/context.h"

#include <math.h>

/* Letcher (11): cos I + sin [a]x + (1 - cos) a a^T, a the axis at length 1; the second row of the printed
 * equation has u_y for u_z, the third u_x for u_y. */
batten_status batten_rotation(batten_context *context, const double axis[3], double angle_rad,
                              double out[9])
{
	const double length = hypot(axis[0], hypot(axis[1], axis[2]));
	if (!(length > 0.0) || !isfinite(length) || !isfinite(angle_rad))
		return batten_fail(
			context, BATTEN_USAGE,
			"a rotation by %g about (%g, %g, %g): a finite angle and an axis that is "
			"not 0 were expected",
			angle_rad, axis[0], axis[1], axis[2]);
	const double a[] = { axis[0] / length, axis[1] / length, axis[2] / length };
	const double across[] = { 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0 };
	const double c = cos(angle_rad);
	const double s = sin(angle_rad);
	for (size_t n = 0; n < 9; n++)
		out[n] = (n % 4 == 0 ? c : 0.0) + s * across[n] + (1.0 - c) * a[n / 3] * a[n % 3];
	return BATTEN_OK;
}
