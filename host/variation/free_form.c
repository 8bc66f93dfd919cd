/* Free-form deformation: a lattice of B-splines displaced (Letcher 7, equation 46). */
#include "variation/variation.h"

static void move(const void *user, const double place_m[3], double moved_m[3])
{
	batten_lattice_shift(user, place_m, moved_m);
	for (size_t c = 0; c < 3; c++)
		moved_m[c] += place_m[c];
}

batten_status variation_free_form(batten_context *context, const batten_hull *parent,
                                  const batten_vary_options *options, batten_hull **out,
                                  batten_vary_outcome *outcome)
{
	const variation_map map = { move, options->lattice };
	return variation_deform(context, parent, &map, out, outcome);
}
