/* Soeding's method: coordinates moved by products of polynomials (thesis 2.3.2; Soeding 1967). */
#include "variation/variation.h"

#include <math.h>

static const char *const preset_names[] = {
#define PRESET_NAME(symbol, name, text) name,
	BATTEN_VARY_PRESET_LIST(PRESET_NAME)
#undef PRESET_NAME
};
static const char *const preset_texts[] = {
#define PRESET_TEXT(symbol, name, text) text,
	BATTEN_VARY_PRESET_LIST(PRESET_TEXT)
#undef PRESET_TEXT
};

const char *batten_vary_preset_name(size_t preset)
{
	return preset < BATTEN_VARY_PRESET_COUNT ? preset_names[preset] : NULL;
}

const char *batten_vary_preset_text(size_t preset)
{
	return preset < BATTEN_VARY_PRESET_COUNT ? preset_texts[preset] : NULL;
}

/* With t in parts of LBP, half-beam, draft, one row of factors each; all others are 0. */
#define ONE                                                                                        \
	{                                                                                              \
		.coefficients = { 1 }                                                                      \
	}
#define MIDDLE_BODY /* 4 t (1 - t) */                                                              \
	{                                                                                              \
		.coefficients = { 4 }, .guard_first = 1, .guard_last = 1                                   \
	}

static const struct {
	size_t moved;
	batten_vary_factor by[3];
} presets[] = {
	/* y: - 4 x (1 - x) y^2 z (1 - z)^4 / 0.08192, which is its largest value, at z = 0.2 */
	[BATTEN_VARY_BILGE_RADIUS] = { 1,
	                               { MIDDLE_BODY,
	                                 { .coefficients = { 0, 0, -1 } },
	                                 { .coefficients = { 1 / 0.08192 },
	                                   .guard_first = 1,
	                                   .guard_last = 4 } } },
	/* z: 4 x (1 - x) y (1 - z)^2 */
	[BATTEN_VARY_RISE_OF_FLOOR] = { 2,
	                                { MIDDLE_BODY,
	                                  { .coefficients = { 0, 1 } },
	                                  { .coefficients = { 1 }, .guard_last = 2 } } },
	/* z: - z (1 - z)^2 27 / 4, whose largest value is 1, at z = 1 / 3 */
	[BATTEN_VARY_U_NESS] = { 2,
	                         { ONE,
	                           ONE,
	                           { .coefficients = { -6.75 }, .guard_first = 1, .guard_last = 2 } } },
	/* y: - y (1 - z)^2 */
	[BATTEN_VARY_V_NESS] = { 1,
	                         { ONE,
	                           { .coefficients = { 0, -1 } },
	                           { .coefficients = { 1 }, .guard_last = 2 } } },
	/* y: x^4 y z^2 */
	[BATTEN_VARY_FLARE] = { 1,
	                        { { .coefficients = { 0, 0, 0, 0, 1 } },
	                          { .coefficients = { 0, 1 } },
	                          { .coefficients = { 0, 0, 1 } } } },
};

void batten_vary_preset_factors(batten_vary_preset preset, double amount, batten_vary_factors *out)
{
	*out = (batten_vary_factors){ 0 };
	if ((int)preset < 0 || preset >= BATTEN_VARY_PRESET_COUNT)
		return;
	batten_vary_factor *row = out->moves[presets[preset].moved];
	for (size_t c = 0; c < 3; c++)
		row[c] = presets[preset].by[c];
	for (size_t k = 0; k < BATTEN_VARY_COEFFICIENTS; k++)
		row[2].coefficients[k] *= amount;
}

/* ------------------------------------------------------------------------------------------------
 * The map
 * --------------------------------------------------------------------------------------------- */

struct nonlinear {
	const batten_vary_factors *factors;
	double unit_m[3];
};

static double value_of(const batten_vary_factor *factor, double t)
{
	if ((factor->guard_first > 0 && t <= 0) || (factor->guard_last > 0 && t >= 1))
		return 0;
	double value = 0;
	for (size_t k = BATTEN_VARY_COEFFICIENTS; k-- > 0;)
		value = value * t + factor->coefficients[k];
	for (unsigned k = 0; k < factor->guard_first; k++)
		value *= t;
	for (unsigned k = 0; k < factor->guard_last; k++)
		value *= 1 - t;
	return value;
}

static void move(const void *user, const double place_m[3], double moved_m[3])
{
	const struct nonlinear *map = user;
	for (size_t c = 0; c < 3; c++) {
		double part = 1;
		for (size_t by = 0; by < 3; by++)
			part *= value_of(&map->factors->moves[c][by], place_m[by] / map->unit_m[by]);
		moved_m[c] = place_m[c] + map->unit_m[c] * part;
	}
}

batten_status variation_nonlinear(batten_context *context, const batten_hull *parent,
                                  const batten_vary_options *options, batten_hull **out,
                                  batten_vary_outcome *outcome)
{
	batten_vary_factors factors;
	batten_vary_preset_factors(options->preset, options->amount, &factors);
	const struct nonlinear nonlinear = {
		.factors = options->factors ? options->factors : &factors,
		.unit_m = { parent->lbp_m, batten_hull_half_beam_m(parent), parent->draft_m },
	};
	const variation_map map = { move, &nonlinear };
	return variation_deform(context, parent, &map, out, outcome);
}
