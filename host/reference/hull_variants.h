/* Many hulls on one table in plain C, one at a time: what kernels/hull_variants.cl does, equal to it bit
 * for bit. Layout is the kernel's (shared/variants_layout.h), with one lane. */
#ifndef BATTEN_REFERENCE_HULL_VARIANTS_H
#define BATTEN_REFERENCE_HULL_VARIANTS_H

#include <stdint.h>

/* asked [VARIANTS_ASK_COUNT], y [N], out [VARIANTS_OUT_COUNT + drafts * VARIANTS_FORM_COUNT]; room:
 * VARIANTS_ROOM and VARIANTS_ITEM_ROOM numbers. */
void reference_hull_variants(const int32_t *shape, const int32_t *lists, const double *tables,
                             const double *asked, double *y, double *out, double *room);

#endif
