/* batten.h, one part of it: a hull faired from beginning to end. */
#ifndef BATTEN_FAIRING_H
#define BATTEN_FAIRING_H

#include "base.h"
#include "hull.h"
#include "pass.h"
#include "search.h"
#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Fairing a hull
 * --------------------------------------------------------------------------------------------- */

/* One gross input error found and replaced (thesis 4.5). */
typedef struct batten_replacement {
	size_t station, waterline;
	double x_m, z_m, old_m, new_m;
} batten_replacement;

/* A point or a line where fairing may not change any offset; a '?' cell has none. */
typedef enum batten_lock_kind {
	BATTEN_LOCK_STATION,   /* all of the station at x_m */
	BATTEN_LOCK_WATERLINE, /* all of the waterline at z_m */
	BATTEN_LOCK_POINT,     /* the offset at (x_m, z_m) */
} batten_lock_kind;
typedef struct batten_lock {
	batten_lock_kind kind;
	double x_m, z_m;
} batten_lock;

/* What the search moves.
 *
 * NET: a surface is fitted to the smoothed hull and y of its poles is searched; x, z and the knots
 * stay, so every place keeps its u and v. Poles stay within the distance limit of where the fit put
 * them, and so, by the convex hull of the net, does the whole surface: the limit is against the
 * fitted surface, which itself lies off the offsets by the deviation of the fit. y of a pole stays
 * between 0 and 1.2 h; one that the fit put beyond goes no further. Edges in the centreplane stay
 * there: poles of keel, stern and stem that the fit put within 0.01 h of it are not moved. The
 * discrepancy principle compares the faired surface with the fitted one, at the offsets, and allows
 * 0.75 of the noise that is left after least squares: that of the offsets times sqrt(poles /
 * points).
 *
 * The faired hull has the half-breadths of the faired surface at the stations and waterlines of the
 * table and at line ends off it. Kept as they are: profile zeros, '?' cells (filled anew), locked
 * offsets (below), and offsets that lie off the surface, seen along y, by more than the largest
 * deviation of the fit. One beyond an edge, but no further than that, takes the surface as it goes
 * on there and the movement of the edge. */
typedef enum batten_variables {
	BATTEN_VARIABLES_OFFSETS, /* the half-breadths of the table */
	BATTEN_VARIABLES_NET,     /* y of the poles of a surface */
} batten_variables;

/* Poles that fairing may not move, counted from 0. With NET a batten_lock holds all poles that have a
 * part in the surface there; the surface stays where the fit put it, and the offset of the table
 * keeps its number. */
typedef enum batten_net_lock_kind {
	BATTEN_NET_LOCK_ROW,    /* along the hull: row 0 is the keel */
	BATTEN_NET_LOCK_COLUMN, /* along the girth: column 0 is the stern */
	BATTEN_NET_LOCK_POLE,
} batten_net_lock_kind;
typedef struct batten_net_lock {
	batten_net_lock_kind kind;
	size_t column, row; /* the one that the kind does not name is not looked at */
} batten_net_lock;

/* Edges of a surface. An edge whose poles move with those beside them, by the same distance, keeps
 * its tangents; where it is held, locked or in the centreplane, those beside it are held too. */
#define BATTEN_EDGE_KEEL 1u  /* row 0 */
#define BATTEN_EDGE_STERN 2u /* column 0 */
#define BATTEN_EDGE_STEM 4u  /* the last column */
#define BATTEN_EDGE_DECK 8u  /* the last row */

/* What a forward or inverse method is to bring back when it is done (thesis 5.2): by scaling all
 * half-breadths, or by Lackenby's method (batten_hull_vary). */
typedef enum batten_restore {
	BATTEN_RESTORE_NONE,
	BATTEN_RESTORE_BEAM,
	BATTEN_RESTORE_VOLUME,
	BATTEN_RESTORE_CP_LCB,
} batten_restore;

/* A measure of the hull at its draft, in the order of batten_hydrostatics, that a search keeps where it is on
 * the smoothed hull; with NET of the surface, by batten_surface_hydrostatics() at the draft and over the length
 * of the hull, where it is on the fitted one. */
typedef struct batten_keep {
	size_t quantity;  /* below BATTEN_HYDROSTATICS_COUNT */
	double tolerance; /* either way, above 0, in the unit of the measure */
	bool is_part;     /* tolerance is a part of the measure instead */
} batten_keep;
enum { BATTEN_KEEP_LIMIT = 8 };

typedef struct batten_fair_options {
	size_t struct_size;
	batten_fair_method method; /* BATTEN_METHOD_SEARCH */
	bool smooth;               /* replace gross errors first; true */
	/* Of the last three methods only; device and precision are those of search. */
	batten_pass_options pass; /* its method is the one above */
	unsigned iterations;      /* at most, 1..10000; 5 */
	double max_cn_pct;        /* stop before cn_pct, against the hull that is faired, passes this; 0
	                             (default) sets no limit */
	double least_gain_pct;    /* stop when an iteration lowers fn_per_m2 by less, in percent; 0 */
	batten_restore restore;   /* BATTEN_RESTORE_NONE */
	/* The rest is of SEARCH only. */
	batten_search_options search;
	bool weights_given;       /* false: by the discrepancy principle */
	double w1, w2;            /* used when given */
	double max_distance_m;    /* |y - smoothed y|; < 0 takes max_distance_part; 0 moves nothing */
	double max_distance_part; /* of h; 0.01 */
	const batten_lock *locks; /* borrowed for the call */
	size_t lock_count;
	const batten_hull *lower, *upper; /* bounds on the same table, or NULL; of OFFSETS only */
	/* Measures to keep, borrowed for the call; w2 above 0, by searches in f64 after one in the precision of
	 * `search`. The weight is chosen without them. */
	const batten_keep *keep;
	size_t keep_count; /* at most BATTEN_KEEP_LIMIT */
	double polish_gap; /* batten_search_polish_batch(), or that of nets, to this; 0 (default): not;
	                      without measures to keep */
	batten_variables variables; /* BATTEN_VARIABLES_OFFSETS */
	batten_fairness fairness;   /* of both, in place of search.fairness; no weights of directions
	                                     with NET or VARIATION */
	/* The rest is of NET only. */
	batten_fit_options fit;           /* counts 0: chosen from the table; stiffness 1e-3 */
	const batten_net_lock *net_locks; /* borrowed for the call */
	size_t net_lock_count;
	unsigned locked_edges;   /* BATTEN_EDGE_...: their poles stay */
	unsigned fixed_tangents; /* BATTEN_EDGE_...: their poles move with those beside them */
} batten_fair_options;
BATTEN_API void batten_fair_options_default(batten_fair_options *options);

typedef struct batten_fairing batten_fairing;

/* Fairs one hull: gross errors, then by its method; SEARCH: noise, weight, search; with NET the fit
 * before the search. The hull is not changed. With AUTO as device the iterations of a forward or
 * inverse method run on the C path: a single hull is done there before a kernel is found. Returns
 * INCOMPLETE when the search met its iteration limit. Errors: USAGE (a lock or bound that is not on the
 * table or the net, options of other methods or variables), INPUT (nothing to fair, no surface to fit,
 * measures that cannot be kept, also as batten_pass_create), DEVICE, KERNEL, MEMORY. */
BATTEN_API batten_status batten_hull_fair(batten_context *context, const batten_hull *hull,
                                          const batten_fair_options *options, batten_fairing **out);
BATTEN_API void batten_fairing_destroy(batten_fairing *fairing);

/* The parts of a fairing; borrowed, valid while it lives. */
BATTEN_API const batten_hull *batten_fairing_input(const batten_fairing *fairing);
BATTEN_API const batten_hull *batten_fairing_smoothed(const batten_fairing *fairing);
BATTEN_API const batten_hull *batten_fairing_faired(const batten_fairing *fairing);
BATTEN_API size_t batten_fairing_replacement_count(const batten_fairing *fairing);
BATTEN_API const batten_replacement *batten_fairing_replacements(const batten_fairing *fairing);
BATTEN_API const batten_search_result *batten_fairing_result(const batten_fairing *fairing);
/* Of a search; NULL of everything else. */
BATTEN_API const batten_certificate *batten_fairing_certificate(const batten_fairing *fairing);
BATTEN_API const batten_run *batten_fairing_run(const batten_fairing *fairing);

/* What a forward or inverse method came to; none with the others. */
typedef struct batten_fairing_row {
	unsigned iteration; /* 0: the hull that is faired */
	bool restored;      /* after the last iteration: what restore made of it */
	double beam_m, cwp, cb, cm, lcb_pct_lbp_fwd, volume_m3, fn_per_m2;
	double cn_pct; /* against the hull that is faired */
} batten_fairing_row;
BATTEN_API size_t batten_fairing_row_count(const batten_fairing *fairing);
BATTEN_API const batten_fairing_row *batten_fairing_rows(const batten_fairing *fairing);

typedef enum batten_fairing_stop {
	BATTEN_STOP_ITERATIONS, /* all that were asked for */
	BATTEN_STOP_MAX_CN,     /* the next one would have passed max_cn_pct, or did not begin */
	BATTEN_STOP_GAIN,       /* the last one gained less than least_gain_pct */
} batten_fairing_stop;
typedef struct batten_fairing_pass {
	batten_fairing_stop stop;
	batten_pass_facts facts;
	double cpu_seconds; /* of the iterations and their rows */
	char warning[256];  /* of what restore did; "" when nothing is to be said */
} batten_fairing_pass;
BATTEN_API batten_fairing_pass batten_fairing_describe_pass(const batten_fairing *fairing);

typedef struct batten_fairing_facts {
	double noise_m;        /* of the smoothed hull */
	double w1, w2;         /* as used */
	bool weights_by_noise; /* chosen by the discrepancy principle */
	double max_distance_m;
	size_t variable_count; /* offsets, or poles, the search may move */
	size_t at_limit_count; /* of these, at a bound in the end */
	double rms_change_m;   /* OFFSETS: over the variables, against the smoothed hull; NET: over the
	                          offsets on the surface, faired against fitted surface */
	size_t filled_count;   /* '?' cells */
} batten_fairing_facts;
BATTEN_API batten_fairing_facts batten_fairing_describe(const batten_fairing *fairing);

/* What became of a measure to keep. */
typedef struct batten_kept {
	size_t quantity; /* in the order of batten_hydrostatics */
	double wanted,
		tolerance;     /* of the smoothed hull or the fitted surface; in the unit of the measure */
	double value;      /* of the faired hull or surface */
	double multiplier; /* what a unit of it costs, in the unit of the objective; 0: nothing had to
	                             be done for it */
} batten_kept;
/* In the order of the options. rounds (may be NULL) gets how many searches came after the first. */
BATTEN_API const batten_kept *batten_fairing_kept(const batten_fairing *fairing, size_t *count,
                                                  unsigned *rounds);

/* The surface before and after; NULL with OFFSETS. */
BATTEN_API const batten_surface *batten_fairing_fitted_surface(const batten_fairing *fairing);
BATTEN_API const batten_surface *batten_fairing_faired_surface(const batten_fairing *fairing);

/* What NET did; all 0 with OFFSETS. */
typedef struct batten_fairing_net {
	batten_fit_deviation deviation; /* of the fitted surface from the smoothed hull */
	batten_surface_energies before, after;
	size_t pole_count, locked_count; /* of the poles, those that may not move */
	size_t on_count;                 /* offsets that lie on the surface, seen along y */
	size_t beyond_count;             /* of these, beyond its edge within the deviation of the fit */
	size_t kept_count;               /* positive offsets that kept their number */
} batten_fairing_net;
BATTEN_API batten_fairing_net batten_fairing_describe_net(const batten_fairing *fairing);

/* One way to weigh fairness against closeness, and what it gives (thesis, conclusions: decisions by
 * several objectives). */
typedef struct batten_front_point {
	double ratio;    /* w2/w1 */
	double fairness; /* the sum of fairness dS of the faired hull or surface, as searched:
	                               NET: at as many Gauss points a span as the order */
	batten_closeness closeness; /* OFFSETS: to the smoothed hull; NET: of the faired surface to the
	                               fitted one, closeness_m4 all over it, the rest at the offsets that
	                               take their half-breadths from it */
	double gap_estimate;        /* of the search, as in batten_certificate */
	bool dominated; /* another point is no worse in fairness and closeness_m4, better in one */
	batten_search_result result;
	batten_kept kept[BATTEN_KEEP_LIMIT]; /* as batten_fairing_kept(): keep_count of the options */
	batten_surface *surface;             /* NET: faired, the caller's to destroy; OFFSETS: NULL */
} batten_front_point;

/* Sweeps w2/w1 from ratio_low to ratio_high, equal factors apart, in one batch of searches over the
 * offsets, or over the poles of one fitted surface, then keeps what is to be kept and polishes, point by point: the
 * fairness-closeness front of a hull. points: the caller's, count of them, ratios ascending; each is what
 * batten_hull_fair() comes to with its weights. options as for that, without weights; NULL: the default.
 * 0 < ratio_low < ratio_high, both 1e-100 .. 1e100; count 2 .. 4096. run (may be NULL) gets how the last of the
 * searches ran. Returns INCOMPLETE when a search met its iteration limit. Errors: those of batten_hull_fair(); no
 * surface is made then. */
BATTEN_API batten_status batten_hull_front(batten_context *context, const batten_hull *hull,
                                           const batten_fair_options *options, double ratio_low,
                                           double ratio_high, size_t count,
                                           batten_front_point *points, batten_run *run);

#ifdef __cplusplus
}
#endif

#endif
