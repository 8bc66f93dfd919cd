/* Surfaces for the tests of batches: seeded random nets of one topology, and batches run whole. */
#ifndef BATTEN_TESTS_SURFACE_CASE_H
#define BATTEN_TESTS_SURFACE_CASE_H

#include "batten.h"

enum { SURFACE_CASE_COUNT = 19 }; /* two groups of eight lanes and some */

typedef struct surface_case {
	batten_context *context;
	size_t count;
	batten_surface *surfaces[SURFACE_CASE_COUNT];
	batten_surface_samples samples; /* both ends and every knot among them */
	double u[32], v[32];
} surface_case;

/* Hull-like nets with noise, uneven knots, one of them repeated. In the fourth all poles of a side lie
 * in one point. */
surface_case surface_case_open(size_t order_u, size_t order_v, bool rational);
void surface_case_close(surface_case *c);

/* Numbers the whole case gives with an output, and samples of a surface. */
size_t surface_case_values(const surface_case *c, batten_surface_output output);
size_t surface_case_samples(const surface_case *c);

batten_surface_batch_options surface_case_options(int device, batten_precision precision,
                                                  batten_surface_output output);

/* Runs the case in every output and the energies on both and fails the test on the first bit that
 * differs. */
void surface_case_compare(const surface_case *c, const batten_surface_batch_options *options);

/* The same of the two kernels that do most: everything of a grid, all energies. */
void surface_case_compare_most(const surface_case *c, const batten_surface_batch_options *options);

#endif
