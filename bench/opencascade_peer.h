/* K and H of a B-spline surface by OpenCASCADE, as one writes it with that library: the rival of
 * surface.curvature_grid. In a module of its own (batten_opencascade_peer.so), which is built where the
 * library is found and opened by the benchmark. */
#ifndef BATTEN_BENCH_OPENCASCADE_PEER_H
#define BATTEN_BENCH_OPENCASCADE_PEER_H

#include "batten.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One thread, GeomAdaptor_Surface::D2 at each point. values: [2][v_count][u_count], K then H, signs as
 * batten has them. False where the surface cannot be made, or a library call fails. */
BATTEN_API bool opencascade_peer_grid(const batten_surface_net *net,
                                      const batten_surface_samples *samples, double *values);

#ifdef __cplusplus
}
#endif

#endif
