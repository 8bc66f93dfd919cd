/* batten.h, one part of it: variants of a parent hull. */
#ifndef BATTEN_VARY_H
#define BATTEN_VARY_H

#include "base.h"
#include "hull.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Varying a parent hull
 * --------------------------------------------------------------------------------------------- */

/* What is moved, and which options count beside first_pass and thesis. Methods that move sections
 * along the ship give the variant on the parent's table; sections stay as they are, the ends of the
 * table stay where they are. */
#define BATTEN_VARY_METHOD_LIST(X)                                                                 \
	X(SWING, "swing", "swings the sectional area curve: dlcb (thesis 2.3.1)")                      \
	X(ONE_MINUS_PRISMATIC, "one-minus-prismatic", "dcp, dlcb (thesis 2.3.2)")                      \
	X(LACKENBY, "lackenby", "dcp, dlcb, dp_fore, dp_aft (thesis 2.3.3; Lackenby 1950)")            \
	X(MOOR, "moor", "sectional areas and load waterline: dcp, dlcb, dcwp, dlcf (thesis 2.3.4)")    \
	X(AVERAGE, "average", "weighted mean with other hulls (thesis 2.3.6)")                         \
	X(AFFINE, "affine", "scale_x, scale_y, scale_z (Letcher 10.1)")                                \
	X(THREE_BODY, "three-body",                                                                    \
	  "fore, middle and after body stretched: volume, lcb, cp (Letcher 10.4)")                     \
	X(STRETCH, "stretch", "x' = f(x) by a monotone spline (Letcher 10.3)")                         \
	X(NONLINEAR, "nonlinear", "products of polynomials of x, y and z (Soeding; thesis 2.3.2)")     \
	X(FREE_FORM, "free-form", "a lattice of B-splines displaced (Letcher 7)")

typedef enum batten_vary_method {
#define BATTEN_VARY_METHOD_ENTRY(symbol, name, text) BATTEN_VARY_##symbol,
	BATTEN_VARY_METHOD_LIST(BATTEN_VARY_METHOD_ENTRY)
#undef BATTEN_VARY_METHOD_ENTRY
		BATTEN_VARY_METHOD_COUNT,
} batten_vary_method;

/* "swing", ...; NULL beyond the last. */
BATTEN_API const char *batten_vary_method_name(size_t method);
BATTEN_API const char *batten_vary_method_text(size_t method);

/* The nonlinear method (Soeding 1967, thesis 2.3.2). x moves by LBP, y by the half-beam, z by the draft,
 * each times a product of three functions, of t = x / LBP, y / half-beam and z / draft:
 *   F(t) = (c0 + c1 t + c2 t^2 + ...) t^guard_first (1 - t)^guard_last.
 * A guard holds the end of the range 0..1 it stands for, and everything beyond. Guards of one leave a
 * knuckle at the end, higher ones none. Coefficients within +-1e6, guards up to 4. A coordinate
 * with a function of 0 stays. What lies in the centreplane stays in it. */
enum { BATTEN_VARY_COEFFICIENTS = 6, BATTEN_VARY_GUARD_MOST = 4 };
typedef struct batten_vary_factor {
	double coefficients[BATTEN_VARY_COEFFICIENTS];
	unsigned guard_first, guard_last;
} batten_vary_factor;
typedef struct batten_vary_factors {
	batten_vary_factor moves[3][3]; /* [of x, y, z][by x, y, z]: F1..F9 of the thesis by rows */
} batten_vary_factors;

/* Factors that are ready, each times an amount (host/variation/README.md has the formulas). */
#define BATTEN_VARY_PRESET_LIST(X)                                                                 \
	X(BILGE_RADIUS, "bilge-radius",                                                                \
	  "rounds the bilge off: what it loses at most, of the half-beam")                             \
	X(RISE_OF_FLOOR, "rise-of-floor", "raises the floor: at the half-beam, of the draft")          \
	X(U_NESS, "u-ness", "lowers every section's middle: at most, of the draft")                    \
	X(V_NESS, "v-ness", "narrows sections towards the keel: there, of their half-breadth")         \
	X(FLARE, "flare", "widens the fore body upwards: at the fore perpendicular and draft, likewise")
typedef enum batten_vary_preset {
#define BATTEN_VARY_PRESET_ENTRY(symbol, name, text) BATTEN_VARY_##symbol,
	BATTEN_VARY_PRESET_LIST(BATTEN_VARY_PRESET_ENTRY)
#undef BATTEN_VARY_PRESET_ENTRY
		BATTEN_VARY_PRESET_COUNT,
} batten_vary_preset;
/* "bilge-radius", ...; NULL beyond the last. */
BATTEN_API const char *batten_vary_preset_name(size_t preset);
BATTEN_API const char *batten_vary_preset_text(size_t preset);
/* The factors of a preset, all 0 beyond the last. */
BATTEN_API void batten_vary_preset_factors(batten_vary_preset preset, double amount,
                                           batten_vary_factors *out);

/* A lattice of B-splines over a box, to displace what lies in it (Letcher 7, equation 46): poles in
 * equal parts between clamped knots, at the Greville places, so that poles moved by an affine map
 * move everything by it. Beyond the box everything moves as the nearest point of the box does: where
 * nothing shall move, its outer poles rest. */
typedef struct batten_lattice batten_lattice;
typedef struct batten_lattice_net {
	double from_m[3], to_m[3]; /* x, y, z; from < to, frame ap-fwd */
	size_t count[3], order[3]; /* 2 <= order <= 8, order <= count <= 64 */
	const double *shift_m;     /* [count z][count y][count x][3], each within +-1e6; borrowed */
} batten_lattice_net;
/* Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_lattice_create(batten_context *context,
                                               const batten_lattice_net *net, batten_lattice **out);
BATTEN_API void batten_lattice_destroy(batten_lattice *lattice);
/* A lattice as JSON, data/schema/lattice.schema.json. Errors: IO, INPUT, MEMORY. */
BATTEN_API batten_status batten_lattice_read(batten_context *context, const char *path,
                                             batten_lattice **out);
/* How far a place moves. */
BATTEN_API void batten_lattice_shift(const batten_lattice *lattice, const double place_m[3],
                                     double shift_m[3]);

typedef struct batten_vary_options {
	size_t struct_size;
	batten_vary_method method;
	bool first_pass; /* stop after one pass of the formulas; default: iterate until the measures of
	                    the variant (batten_hull_measure()) are what was asked for */
	bool thesis;     /* the thesis's procedure: 21 sections by natural splines, areas from six
	                    waterlines; for the methods that move sections */

	/* swing, one-minus-prismatic, lackenby, moor. dcp and dcwp in percent of the parent's value
	 * (moor keeps the section amidships, so that its dcp is that of the block coefficient); dlcb
	 * and dlcf in percent of LBP, + forward; 0 keeps the value. */
	double dcp_pct, dlcb_pct, dcwp_pct, dlcf_pct;
	double dp_fore_pct, dp_aft_pct;    /* parallel body added to each half, percent of the half */
	double lcb_used_pct, lcf_used_pct; /* enter the split between the halves in place of the
	                                      parent's own, percent of LBP, + forward; NaN: own */

	/* average: (1 - sum of weights) parent + sum of weight * other; weights may lie outside 0..1 */
	size_t other_count;
	const batten_hull *const *others; /* borrowed for the call */
	const double *weights;

	double scale_x, scale_y, scale_z; /* affine: > 0; 1 */

	/* three-body: NaN keeps the parent's value. The middle body, from the aft perpendicular; NaN
	 * takes the parallel body that is found. */
	double volume_m3, lcb_pct_lbp_fwd, cp;
	double middle_aft_m, middle_fore_m;

	/* stretch: x from the AP in parts of LBP and where it goes; 2..64 points, ascending both. */
	size_t point_count;
	const double *from_part, *to_part;

	/* nonlinear: a preset and how much of it, or factors where there are some; the table's stations
	 * and waterlines move where each moves as one, else they stay and are taken anew */
	batten_vary_preset preset;          /* BATTEN_VARY_PRESET_COUNT: none */
	double amount;                      /* -10..10 */
	const batten_vary_factors *factors; /* borrowed; NULL */

	/* free-form: LBP, draft and baseline stay; the table as of nonlinear */
	const batten_lattice *lattice; /* borrowed */
} batten_vary_options;
BATTEN_API void batten_vary_options_default(batten_vary_options *options);

enum { BATTEN_VARY_TARGETS_MOST = 8, BATTEN_VARY_PARAMETERS_MOST = 8 };

/* What became of one row. */
typedef struct batten_vary_outcome {
	batten_status status; /* OK: there is a variant */
	char reason[384];     /* one line when there is none */
	char warning[384];    /* one line, "" when nothing is to be said */
	unsigned passes;      /* how many times the variant was made */
	size_t target_count;
	struct batten_vary_target {
		const char *name; /* of a measure */
		double parent, asked, got;
	} targets[BATTEN_VARY_TARGETS_MOST];
	size_t parameter_count; /* of the formulas, as used in the end */
	struct batten_vary_parameter {
		const char *name;
		double value;
	} parameters[BATTEN_VARY_PARAMETERS_MOST];
} batten_vary_outcome;

/* Makes one variant; the parent is not changed. Unless first_pass, every target is hit within 1e-5
 * of its printed unit. outcome may be NULL. A map that would fold the hull and a target out of reach
 * are INPUT; the reason then names the range that can be reached in the proportion asked for.
 * Errors: USAGE (an option out of its range), INPUT (also a parent the method cannot take), MEMORY. */
BATTEN_API batten_status batten_hull_vary(batten_context *context, const batten_hull *parent,
                                          const batten_vary_options *options, batten_hull **out,
                                          batten_vary_outcome *outcome);

/* Targets met by the parameters of one or several methods: form-parameter design (Letcher 10.4). The
 * methods are applied once each, in the order their first parameter is named in, one to the result of
 * the other. */
#define BATTEN_SOLVE_PARAMETER_LIST(X)                                                             \
	X(SWING, dlcb_pct, "swing.dlcb", 0, -10, 10)                                                   \
	X(ONE_MINUS_PRISMATIC, dcp_pct, "one-minus-prismatic.dcp", 0, -30, 30)                         \
	X(ONE_MINUS_PRISMATIC, dlcb_pct, "one-minus-prismatic.dlcb", 0, -10, 10)                       \
	X(LACKENBY, dcp_pct, "lackenby.dcp", 0, -30, 30)                                               \
	X(LACKENBY, dlcb_pct, "lackenby.dlcb", 0, -10, 10)                                             \
	X(LACKENBY, dp_fore_pct, "lackenby.dp-fore", 0, 0, 50)                                         \
	X(LACKENBY, dp_aft_pct, "lackenby.dp-aft", 0, 0, 50)                                           \
	X(MOOR, dcp_pct, "moor.dcb", 0, -30, 30)                                                       \
	X(MOOR, dlcb_pct, "moor.dlcb", 0, -10, 10)                                                     \
	X(MOOR, dcwp_pct, "moor.dcwp", 0, -30, 30)                                                     \
	X(MOOR, dlcf_pct, "moor.dlcf", 0, -10, 10)                                                     \
	X(AFFINE, scale_x, "affine.x", 1, 0.25, 4)                                                     \
	X(AFFINE, scale_y, "affine.y", 1, 0.25, 4)                                                     \
	X(AFFINE, scale_z, "affine.z", 1, 0.25, 4)                                                     \
	X(NONLINEAR, amount, "nonlinear.bilge-radius", 0, -0.4, 0.4)                                   \
	X(NONLINEAR, amount, "nonlinear.rise-of-floor", 0, 0, 0.4)                                     \
	X(NONLINEAR, amount, "nonlinear.u-ness", 0, -0.14, 0.14)                                       \
	X(NONLINEAR, amount, "nonlinear.v-ness", 0, -1, 0.9)                                           \
	X(NONLINEAR, amount, "nonlinear.flare", 0, -0.9, 4)

/* "swing.dlcb", ..., its range where none is given and the value that changes nothing; NULL beyond the
 * last. */
BATTEN_API const char *batten_solve_parameter_name(size_t parameter, double *least, double *most,
                                                   double *none);

typedef struct batten_solve_target {
	const char *measure; /* one of BATTEN_FORM_LIST, as "lcb_pct_lbp_fwd" */
	double value;
} batten_solve_target;
typedef struct batten_solve_parameter {
	const char *name;
	double least, most; /* NaN: the range of the name */
} batten_solve_parameter;

/* As many parameters as targets, 1..BATTEN_VARY_TARGETS_MOST of them. One parameter: its range is
 * searched through, every bracket is closed by Newton's method. Several: Newton's method with steps
 * kept within the ranges, from the parent and from other places of the ranges, so that other
 * solutions are found. The one nearest to the parent is taken; others are told in the warning. No
 * solution is INPUT, and the reason says what comes nearest. outcome (may be NULL) has all of it;
 * passes counts variants made. Errors: USAGE, INPUT, MEMORY. */
BATTEN_API batten_status batten_hull_solve(batten_context *context, const batten_hull *parent,
                                           size_t count, const batten_solve_target *targets,
                                           const batten_solve_parameter *parameters,
                                           batten_hull **out, batten_vary_outcome *outcome);

/* count rows from one parent. variants (caller's, [count]) gets a hull or NULL each, outcomes [count]
 * what became of it; a row that fails stops no other, and the result of a row does not depend on the
 * others. Returns INCOMPLETE when a row failed. */
BATTEN_API batten_status batten_hull_vary_batch(batten_context *context, const batten_hull *parent,
                                                size_t count, const batten_vary_options *options,
                                                batten_hull **variants,
                                                batten_vary_outcome *outcomes);

#ifdef __cplusplus
}
#endif

#endif
