/* batten.h, one part of it: the pattern search over offsets, many at a time. */
#ifndef BATTEN_SEARCH_H
#define BATTEN_SEARCH_H

#include "base.h"
#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * The pattern search, many at a time
 * --------------------------------------------------------------------------------------------- */

/* What a surface is to be low in (thesis 7.1; Letcher 4.5), integrated over its area. With h the
 * half-beam all are made free of dimension: a ratio w2/w1 means the same on every hull. */
typedef enum batten_fairness {
	BATTEN_FAIRNESS_BENDING,   /* k1^2 + k2^2 */
	BATTEN_FAIRNESS_MEAN,      /* ((k1 + k2) / 2)^2 */
	BATTEN_FAIRNESS_GAUSS,     /* |k1 k2|, as sqrt(K^2 + e^2) with e = 0.001 / h^2 */
	BATTEN_FAIRNESS_VARIATION, /* h^2 times (dk1/ds1)^2 + (dk2/ds2)^2 along their own lines */
} batten_fairness;
/* "bending", "mean", "gauss", "mvc". */
BATTEN_API const char *batten_fairness_text(batten_fairness fairness);

/* The grid all searches of a batch share: coordinates ascending, 3..4096 each. */
typedef struct batten_grid {
	size_t station_count, waterline_count;
	const double *x_m, *z_m;
} batten_grid;

/* One search. All arrays are [waterlines][stations]; a node outside the hull is left alone and no
 * stencil crosses it. Minimises
 *     F(y) = w1 * sum of fairness dS + w2 * sum (y - target)^2 dx dz / h^4
 * (thesis 7.1-7.2; the first sum over the nodes whose eight neighbours are on the hull) over
 * lower <= y <= upper; a node with lower == upper is fixed. */
typedef struct batten_search_problem {
	const uint8_t *nodes;  /* batten_node; NULL: all on the hull */
	const double *start_m; /* finite; clamped into the box */
	const double *target_m;
	const double *lower_m, *upper_m; /* lower <= upper, finite */
	const double *closeness_weight;  /* factor of each node's closeness term, >= 0; NULL: 1 */
	double w1, w2;                   /* dimensionless, 0 or 1e-100 .. 1e100, not both 0 */
	double half_beam_m;              /* h, > 0 */
} batten_search_problem;

/* How a search looks for the minimum (kernels/README.md). */
typedef enum batten_search_algorithm {
	BATTEN_ALGORITHM_AUTO,       /* BLOCK where it applies, else MULTILEVEL */
	BATTEN_ALGORITHM_TEXTBOOK,   /* Hooke and Jeeves as published (thesis 7.2): to compare with */
	BATTEN_ALGORITHM_MULTILEVEL, /* probes along hats of several widths: any objective */
	BATTEN_ALGORITHM_BLOCK, /* whole lines, or all poles, at once, from probes of the integrand: plain
	                                bending of offset grids, bending and mean of nets; bench/README.md says
	                                how much faster */
} batten_search_algorithm;
/* "auto", "textbook", "multilevel", "block". */
BATTEN_API const char *batten_search_algorithm_text(batten_search_algorithm algorithm);

typedef struct batten_search_options {
	size_t struct_size;
	int device; /* an index of batten_device_count(), or AUTO, REFERENCE */
	batten_precision precision;
	batten_search_algorithm algorithm; /* BATTEN_ALGORITHM_AUTO */
	double first_step;                 /* of h: 0.02 */
	double last_step;                  /* of h; 0 takes 2e-7 in f64, 2e-6 in f32, ten times that for
	                                      MULTILEVEL without variation of curvature and interior penalty */
	unsigned iteration_limit;          /* 400 */
	unsigned lanes; /* searches a group runs side by side: 1, 2, 4, 8, 16; 0 chooses */
	/* Work-items of a group, at most 1024; 0 chooses. Where they are a multiple of more lanes than one, which may
	 * then be any power of two, each works one of the lanes, as on a GPU. */
	unsigned work_group;
	/* The rest is of searches over offset grids only. */
	batten_fairness fairness; /* BATTEN_FAIRNESS_BENDING; VARIATION takes both weights 1 */
	/* Weights of the squared normal curvature along the tangent of the waterline, k11, and square to
	 * it in the surface, k22 (Letcher 4.5: the former counts more). With a and b their roots the
	 * entries of the shape operator in this frame become a k11, sqrt(a b) k12, b k22 in every
	 * fairness: bending is a^2 k11^2 + 2 a b k12^2 + b^2 k22^2. 0 or 1e-6 .. 1e6, not both 0; 1, 1. */
	double longitudinal_weight, transverse_weight;
	/* MULTILEVEL, which AUTO then takes: the box is kept by an interior penalty (thesis 7.1; Fiacco and
	 * McCormick), not by moves that end at it; false. Searched is F + r sum (1/g + 1/g'), g and g' being the
	 * ways of an offset to its bounds as parts of the box's width, from a start at least a thousandth of the
	 * width inside, then again with r a hundredth of that, until r's part is below 1e-10 of F (f32: 1e-5).
	 * Every y that can move ends strictly inside its box. Iterations and probes are those of all rounds,
	 * iteration_limit is that of each; objectives are F alone. bench/README.md has what it costs. */
	bool interior_penalty;
	/* BLOCK: slopes of the integrand by their formulas, not by probes of it; false. */
	bool analytic_slopes;
} batten_search_options;
BATTEN_API void batten_search_options_default(batten_search_options *options);

typedef enum batten_search_end {
	BATTEN_SEARCH_CONVERGED = 0,  /* the step fell below last_step */
	BATTEN_SEARCH_LIMIT = 1,      /* the iteration limit came first */
	BATTEN_SEARCH_STATIONARY = 2, /* no probe of any size improved the start */
	BATTEN_SEARCH_REFUSED = 3,    /* invalid problem; y is not written, message says why */
} batten_search_end;
BATTEN_API const char *batten_search_end_text(batten_search_end end);

typedef struct batten_search_result {
	batten_search_end end;
	batten_search_algorithm algorithm; /* the one that ran */
	unsigned iterations;
	uint64_t probes; /* trial values: of a direction, or (BLOCK) of the integrand at a node */
	double objective_start, objective_end;
	double last_step_m;
	char message[96]; /* for REFUSED */
} batten_search_result;

/* What ran a batch. */
typedef struct batten_run {
	char device[128];  /* "reference" for the C path; several joined by " + " */
	bool strict;       /* every device equals the C path bit for bit */
	double seconds;    /* wall time of the searches, without building kernels */
	double lane_use;   /* part of the lanes' turns that were of use to a search; 0: not known */
	char warning[256]; /* one line, "" when nothing is to be said */
} batten_run;

/* Runs count pattern searches (kernels/README.md). y_m is the caller's, apart from the problems,
 * [count][waterlines][stations]; results [count]; run may be NULL. The result of a search does not
 * depend on the others, on their order or number, nor (when strict) on what ran it.
 * Returns INCOMPLETE when a search was refused or met its limit. Errors: USAGE (among them an
 * algorithm that this version lacks), DEVICE, KERNEL, MEMORY. */
BATTEN_API batten_status batten_search_batch(batten_context *context, const batten_grid *grid,
                                             size_t count, const batten_search_problem *problems,
                                             const batten_search_options *options, double *y_m,
                                             batten_search_result *results, batten_run *run);

/* Searches of one grid as a source gives them, in bounded memory: they run as batches of up to 1024, of 16
 * MiB at most where they are more than one, whatever their number.
 *
 * The source is asked for search 0, 1, 2 ... and fills the problem, which comes zeroed; start_m left NULL
 * ends the stream. Its arrays are read before the source is asked again, so that one set of them will do.
 * The sink gets the results in the same order, y_m [waterlines][stations], valid during the call. What
 * either returns other than OK ends the stream and is its status; nothing is asked for or handed over
 * afterwards. Both are called by the thread that called, one at a time. */
typedef batten_status (*batten_fair_source)(void *user, size_t index,
                                            batten_search_problem *problem);
typedef batten_status (*batten_fair_sink)(void *user, size_t index,
                                          const batten_search_result *result, const double *y_m);

/* count, run: may be NULL; count gets how many results the sink was given, also on failure. run as of the
 * batches together: strict when all were, the first warning. A stream without any search is OK. Each
 * result is that of batten_search_batch(). Returns INCOMPLETE when a search was refused or met its limit.
 * Errors: as batten_search_batch(); USAGE (a start without target or bounds); those of source and sink. */
BATTEN_API batten_status batten_fair_stream(batten_context *context, const batten_grid *grid,
                                            batten_fair_source source, batten_fair_sink sink,
                                            void *user, const batten_search_options *options,
                                            size_t *count, batten_run *run);

/* What the end of a search is worth, by the exact derivatives of its objective in double, whatever
 * probed it: free are the offsets that are not fixed, nor held at a bound by the gradient. The
 * objective is not convex, so all of it is local: it knows nothing of other minima. */
typedef struct batten_certificate {
	double objective;    /* F at y, in double */
	double fairness;     /* the sum of fairness dS, without w1; NaN where w1 is 0 */
	double closeness_m4; /* the sum of (y - target)^2 dx dz, without w2 / h^4; NaN where w2 is 0 */
	double gradient_per_m; /* norm of the projected gradient: dF/dy over the free offsets */
	/* The Newton decrement over the free offsets, 1/2 g^T H^-1 g, relative to F: how far F lies above
	 * the minimum of its parabola, bounds left aside (high, by up to 10 times, where offsets are still
	 * on their way to one). An offset that f32 has left rounding away from the bound that holds it, or
	 * an interior penalty inside it, adds what its slope gains on that way. NaN where H is not positive definite over
	 * the free offsets, and where the grid is too large (2^26 numbers of its band). The first says that no minimum is
	 * near: the search ended on its way past a place where the objective bends downward, as its gains faded there
	 * below what ends a search (f32: 1e-5 of the objective), or by its limit. */
	double gap_estimate;
	size_t free_count;
	unsigned steps;   /* that batten_search_polish_batch took */
	char message[96]; /* why there is no estimate; else "" */
} batten_certificate;

/* Judges the ends of count searches (thesis 7.2 stops by the step alone). Problems and y_m as given to
 * and by batten_search_batch, of any algorithm; of the options fairness, weights, precision and interior
 * penalty count.
 * A search costs about as much as 20 of its objectives and a Cholesky factor of bandwidth 2 lines.
 * Returns INCOMPLETE when a problem is invalid or y not finite (its numbers are NaN, message says why).
 * Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_search_certify_batch(batten_context *context,
                                                     const batten_grid *grid, size_t count,
                                                     const batten_search_problem *problems,
                                                     const batten_search_options *options,
                                                     const double *y_m,
                                                     batten_certificate *certificates);

/* Goes on from the ends y_m of count searches, in double, until the gap estimate of each is at most `gap`
 * (above 0): steps of Newton's method over the free offsets, kept in the box, halved until the objective
 * falls; where the Hessian is not positive definite, its diagonal is raised until it is. So it finishes what f32
 * has screened. Certificates are of the new ends; one where no step gains, or 100 do not do, stays above gap or
 * without an estimate. Not of searches with an interior penalty.
 * Else as batten_search_certify_batch. */
BATTEN_API batten_status batten_search_polish_batch(batten_context *context,
                                                    const batten_grid *grid, size_t count,
                                                    const batten_search_problem *problems,
                                                    const batten_search_options *options,
                                                    double gap, double *y_m,
                                                    batten_certificate *certificates);

#ifdef __cplusplus
}
#endif

#endif
