/* Surfaces afloat in plain C, one at a time: what kernels/surface_hydrostatics.cl does, equal to it bit
 * for bit. Layout is the kernel's (shared/afloat_layout.h), with one lane. */
#ifndef BATTEN_REFERENCE_SURFACE_HYDROSTATICS_H
#define BATTEN_REFERENCE_SURFACE_HYDROSTATICS_H

#include <stdint.h>

/* poles [v][u][dimension], out [AFLOAT_OUTCOME], room: AFLOAT_ROOM numbers. */
void reference_surface_hydrostatics(const int32_t *shape, const int32_t *lists,
                                    const double *tables, const double *poles, double *out,
                                    double *room);

#endif
