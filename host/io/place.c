#include "io/offsets_frame.h"

void batten_hull_place(const batten_hull *hull, double file_x, double file_z, double *x_m,
                       double *z_m)
{
	*x_m = offsets_x_in(hull, file_x);
	*z_m = offsets_z_in(hull, file_z);
}
