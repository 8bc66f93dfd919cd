/* The kernel of surface grids compiled by the C compiler. A module of its own, so that only it needs
 * AVX-512. */
#ifndef BATTEN_BENCH_C_VECTORS_PEER_H
#define BATTEN_BENCH_C_VECTORS_PEER_H

#include "batten.h"

/* K and H of count bicubic nets without weights, of one topology, at the samples, made ready: tables of
 * the bases, nets lane by lane. count is a multiple of the lanes, 16. NULL: short of memory, or the
 * processor has no AVX-512. */
typedef struct c_vectors c_vectors;
typedef c_vectors *c_vectors_open_function(size_t count, const batten_surface_net *nets,
                                           const batten_surface_samples *samples);
/* Works all of it into values [count][2][v][u], doubles (f32: floats). */
typedef void c_vectors_run_function(c_vectors *work, void *values);
typedef void c_vectors_close_function(c_vectors *work);

#define C_VECTORS_EXPORT __attribute__((visibility("default")))
C_VECTORS_EXPORT c_vectors_open_function c_vectors_open_f64, c_vectors_open_f32;
C_VECTORS_EXPORT c_vectors_run_function c_vectors_run_f64, c_vectors_run_f32;
C_VECTORS_EXPORT c_vectors_close_function c_vectors_close_f64, c_vectors_close_f32;

#endif
