/*
 * batten: fairs ship hulls in bulk.
 *
 * The whole public interface. Frame inside: origin at the aft perpendicular on the baseline,
 * x forward, y to port, z up; metres; a hull is stored as its half, y >= 0. Other frames and units
 * are converted where a file is read or written, never inside.
 *
 * Rules that hold for every declaration below
 *   - A function that can fail returns batten_status and leaves its outputs untouched (pointers
 *     NULL) when it does; batten_context_error() then gives one line that says what was wrong.
 *   - Input arrays are borrowed for the call only. What a function creates, the caller destroys;
 *     destroying NULL is allowed.
 *   - Option structs are filled by their _default() function first, then changed.
 *   - One context is used by one thread at a time; different contexts are independent.
 *
 * Sources: "thesis" is E. Narli, Computer Aided Fairing of Ship Hull Forms (ITU 1999); "Letcher" is
 * J. S. Letcher, The Geometry of Ships (SNAME 2009).
 */
#ifndef BATTEN_H
#define BATTEN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define BATTEN_API __attribute__((visibility("default")))
#else
#define BATTEN_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Status
 * --------------------------------------------------------------------------------------------- */

/* Every status, its number and the exit code of the program that goes with it. */
#define BATTEN_STATUS_LIST(X)                                                                      \
	X(OK, 0, 0, "done")                                                                            \
	X(INCOMPLETE, 1, 1, "done, but some hulls failed or did not converge")                         \
	X(USAGE, 2, 2, "an argument is out of its range")                                              \
	X(INPUT, 3, 3, "the input is invalid")                                                         \
	X(DEVICE, 4, 4, "the device asked for is absent or lost")                                      \
	X(KERNEL, 5, 5, "a kernel did not build or failed its self-test")                              \
	X(IO, 6, 6, "input/output error")                                                              \
	X(MISSING, 7, 6, "a required package is missing")                                              \
	X(INTERNAL, 70, 70, "internal error")                                                          \
	X(MEMORY, 71, 70, "out of memory")                                                             \
	X(INTERRUPTED, 75, 75, "interrupted")

typedef enum batten_status {
#define BATTEN_STATUS_ENTRY(name, number, exit_code, text) BATTEN_##name = (number),
	BATTEN_STATUS_LIST(BATTEN_STATUS_ENTRY)
#undef BATTEN_STATUS_ENTRY
} batten_status;

/* One line of English for a status; never NULL. */
BATTEN_API const char *batten_status_text(batten_status status);

/* The exit code a program should end with for a status. */
BATTEN_API int batten_status_exit_code(batten_status status);

/* "MAJOR.MINOR.PATCH" of the library that is linked in. */
BATTEN_API const char *batten_version(void);

/* ------------------------------------------------------------------------------------------------
 * Context: allocator, log, last error, threads
 * --------------------------------------------------------------------------------------------- */

typedef struct batten_context batten_context;

typedef enum batten_log_level {
	BATTEN_LOG_ERROR,
	BATTEN_LOG_WARNING,
	BATTEN_LOG_INFORMATION,
} batten_log_level;

typedef struct batten_context_options {
	size_t struct_size; /* set by batten_context_options_default() */
	/* Memory; NULL takes malloc and free. allocate may return NULL. Called from any thread. */
	void *(*allocate)(size_t size, void *user);
	void (*release)(void *memory, void *user);
	void *allocate_user;
	/* Talk: called with one line without a newline; NULL is silent. */
	void (*log)(batten_log_level level, const char *line, void *user);
	void *log_user;
	/* Threads of the plain C path and of CPU devices; 0 takes the affinity mask of the process, or
	 * SLURM_CPUS_PER_TASK where that is set. Range 0..4096. */
	unsigned threads;
	/* Most bytes of one allocation on the host; larger ones fail, batches are cut to fit. 0 sets no
	 * limit. */
	size_t max_memory;
	/* Folder for compiled kernels; NULL takes $XDG_CACHE_HOME/batten or ~/.cache/batten. When it
	 * cannot be written, a private folder under $TMPDIR is used. */
	const char *cache_directory;
} batten_context_options;

BATTEN_API void batten_context_options_default(batten_context_options *options);

/* options may be NULL. Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_context_create(const batten_context_options *options,
                                               batten_context **out);
BATTEN_API void batten_context_destroy(batten_context *context);

/* The message of the last failure in this context: one line, "" before the first. Valid until the
 * next failure. */
BATTEN_API const char *batten_context_error(const batten_context *context);

/* ------------------------------------------------------------------------------------------------
 * Hulls: an offset table over stations (x) and waterlines (z)
 * --------------------------------------------------------------------------------------------- */

typedef struct batten_hull batten_hull;

/* What a node of the table is. */
typedef enum batten_node {
	BATTEN_NODE_OUTSIDE = 0, /* not on the hull: an empty cell */
	BATTEN_NODE_GIVEN = 1,   /* a half-breadth; 0 is a profile point (keel, stem, stern) */
	BATTEN_NODE_UNKNOWN = 2, /* on the hull, half-breadth not given: a cell '?'. Filled by a natural
	                            cubic spline along its waterline (along its section where the
	                            waterline has fewer than two given points), written as '?' again */
} batten_node;

/* Reads an offsets file (data/README.md describes the format). Errors: IO, INPUT (naming file, line,
 * column, what was found and what was expected), MEMORY. */
BATTEN_API batten_status batten_hull_read(batten_context *context, const char *path,
                                          batten_hull **out);

/* Same, from memory; name stands for the file in messages. */
BATTEN_API batten_status batten_hull_parse(batten_context *context, const char *name,
                                           const char *text, size_t length, batten_hull **out);

/* Makes a hull from arrays, in the frame ap-fwd and metres. x, z ascending and finite, 2..4096 each;
 * y and nodes are waterline-major: index waterline * station_count + station; y >= 0 and finite where
 * given, read nowhere else. nodes may be NULL: all given. lbp, draft > 0.
 * Errors: USAGE, MEMORY. */
typedef struct batten_hull_table {
	const char *name;
	double lbp_m, draft_m;
	size_t station_count, waterline_count;
	const double *x_m, *z_m, *y_m;
	const uint8_t *nodes;
} batten_hull_table;
BATTEN_API batten_status batten_hull_create(batten_context *context, const batten_hull_table *table,
                                            batten_hull **out);

/* Writes the hull in the layout, frame and unit it was read in. The file is replaced at once or not
 * at all. Errors: IO, MEMORY. */
BATTEN_API batten_status batten_hull_write(batten_context *context, const batten_hull *hull,
                                           const char *path);

BATTEN_API batten_status batten_hull_clone(batten_context *context, const batten_hull *hull,
                                           batten_hull **out);
BATTEN_API void batten_hull_destroy(batten_hull *hull);

/* Borrowed views, valid while the hull lives and is not written to. */
BATTEN_API const char *batten_hull_name(const batten_hull *hull);
BATTEN_API const char *batten_hull_source(const batten_hull *hull); /* "" when the file has none */
BATTEN_API const char *batten_hull_unit(const batten_hull *hull);   /* "m", "mm" or "ft" */
BATTEN_API const char *batten_hull_frame(const batten_hull *hull);  /* "ap-fwd", ... */
BATTEN_API const char *batten_hull_layout(const batten_hull *hull); /* "grid" or "long" */
BATTEN_API double batten_hull_lbp_m(const batten_hull *hull);
BATTEN_API double batten_hull_draft_m(const batten_hull *hull);
BATTEN_API size_t batten_hull_station_count(const batten_hull *hull);
BATTEN_API size_t batten_hull_waterline_count(const batten_hull *hull);
BATTEN_API const double *batten_hull_x_m(const batten_hull *hull);    /* [stations] */
BATTEN_API const double *batten_hull_z_m(const batten_hull *hull);    /* [waterlines] */
BATTEN_API const double *batten_hull_y_m(const batten_hull *hull);    /* [waterlines][stations] */
BATTEN_API const uint8_t *batten_hull_nodes(const batten_hull *hull); /* batten_node, as y */

/* Largest half-breadth of the table, line ends included (m): the h of all dimensionless figures. */
BATTEN_API double batten_hull_half_beam_m(const batten_hull *hull);

/* A place given in the frame and unit of the hull's file, as x and z inside. */
BATTEN_API void batten_hull_place(const batten_hull *hull, double file_x, double file_z,
                                  double *x_m, double *z_m);

/* Replaces the half-breadths of all nodes that are not outside. y_m as batten_hull_y_m().
 * Errors: USAGE (a negative or non-finite half-breadth). */
BATTEN_API batten_status batten_hull_set_y(batten_context *context, batten_hull *hull,
                                           const double *y_m);

/* ------------------------------------------------------------------------------------------------
 * Measures
 * --------------------------------------------------------------------------------------------- */

typedef enum batten_quadrature {
	BATTEN_QUADRATURE_SPLINE,    /* not-a-knot spline in z, natural spline in x */
	BATTEN_QUADRATURE_SIMPSON,   /* even number of equal intervals in both directions, else INPUT */
	BATTEN_QUADRATURE_TRAPEZOID, /* sums of trapezoids */
} batten_quadrature;

typedef struct batten_measure_options {
	size_t struct_size;
	double draft_m; /* 0 takes the hull's own */
	batten_quadrature quadrature;
	double density_t_per_m3; /* 1.025 */
} batten_measure_options;
BATTEN_API void batten_measure_options_default(batten_measure_options *options);

/* Every measure: its name, which carries unit and sign, and what it is. A measure that does not exist
 * for a hull is NaN (null in JSON). L of the coefficients is lbp_m, B is beam_wl_m.
 * Definitions: Letcher 9-11; fairness: thesis 4.4, 5 and 7. First what is known of a hull at a
 * draft, then what is known of it at any. */
#define BATTEN_FORM_LIST(X)                                                                        \
	X(lbp_m, "length between perpendiculars")                                                      \
	X(lwl_m, "length of the waterline at the draft")                                               \
	X(beam_wl_m, "largest breadth of the waterline at the draft")                                  \
	X(beam_max_m, "largest breadth of the table")                                                  \
	X(draft_m, "draft")                                                                            \
	X(half_beam_m, "largest half-breadth of the table, h")                                         \
	X(volume_m3, "moulded volume up to the draft")                                                 \
	X(displacement_t, "mass of the displaced water")                                               \
	X(wetted_surface_m2, "wetted surface, both sides, transom left out")                           \
	X(waterplane_area_m2, "area of the waterplane")                                                \
	X(midship_area_m2, "immersed section area amidships")                                          \
	X(max_section_area_m2, "largest immersed section area of the stations")                        \
	X(cb, "block coefficient, volume / (L B T)")                                                   \
	X(cp, "prismatic coefficient, volume / (L midship area)")                                      \
	X(cm, "midship coefficient, midship area / (B T)")                                             \
	X(cwp, "waterplane coefficient, waterplane area / (L B)")                                      \
	X(cv, "volumetric coefficient, 1000 volume / L^3")                                             \
	X(cws, "wetted surface / sqrt(volume L)")                                                      \
	X(lcb_pct_lbp_fwd, "centre of buoyancy from amidships, percent of LBP, + forward")             \
	X(xcb_from_ap_m, "centre of buoyancy from the aft perpendicular, + forward")                   \
	X(lcf_pct_lbp_fwd, "centre of flotation from amidships, percent of LBP, + forward")            \
	X(xcf_from_ap_m, "centre of flotation from the aft perpendicular, + forward")                  \
	X(kb_m, "centre of buoyancy above the baseline")                                               \
	X(bmt_m, "transverse metacentric radius")                                                      \
	X(bml_m, "longitudinal metacentric radius")                                                    \
	X(kmt_m, "transverse metacentre above the baseline")                                           \
	X(kml_m, "longitudinal metacentre above the baseline")                                         \
	X(i_t_m4, "transverse second moment of the waterplane")                                        \
	X(i_l_m4, "longitudinal second moment of the waterplane about its centre")                     \
	X(tpc_t_per_cm, "tonnes per centimetre immersion")

#define BATTEN_MEASURE_LIST(X)                                                                     \
	BATTEN_FORM_LIST(X)                                                                            \
	X(fn_per_m2, "fairness number: sum of squared second derivatives over all waterlines")         \
	X(fn_sections_per_m2, "the same over all sections")                                            \
	X(energy_bending, "sum of (k1^2 + k2^2) dS over the nodes inside the hull")                    \
	X(energy_mean, "sum of H^2 dS")                                                                \
	X(energy_gauss, "sum of |K| dS")                                                               \
	X(energy_mvc_per_m2, "sum of ((dk1/de1)^2 + (dk2/de2)^2) dS, each along its own direction")    \
	X(noise_m, "robust estimate of the noise of the offsets")                                      \
	X(inflections, "sign changes of the second derivative over all waterlines and sections")

typedef struct batten_measures {
#define BATTEN_MEASURE_FIELD(name, text) double name;
	BATTEN_MEASURE_LIST(BATTEN_MEASURE_FIELD)
#undef BATTEN_MEASURE_FIELD
} batten_measures;

enum { BATTEN_MEASURE_COUNT = (int)(sizeof(batten_measures) / sizeof(double)) };

/* Name and meaning of measure number i (0..BATTEN_MEASURE_COUNT-1, the order of the struct); NULL
 * beyond. */
BATTEN_API const char *batten_measure_name(size_t i);
BATTEN_API const char *batten_measure_text(size_t i);

/* options may be NULL. Errors: USAGE (a draft asked for outside the table), INPUT (the hull's own draft
 * outside its table, a rule whose conditions do not hold), MEMORY. */
BATTEN_API batten_status batten_hull_measure(batten_context *context, const batten_hull *hull,
                                             const batten_measure_options *options,
                                             batten_measures *out);

/* How one hull differs from the one it was faired from, both on the same table; '?' cells do not
 * count. */
typedef struct batten_closeness {
	double cn_pct;       /* 100 max |y - y0| / h, h of the reference */
	double cn_max_m;     /* max |y - y0| */
	double cn_rms_m;     /* root of the mean of (y - y0)^2 over the nodes given and > 0 in either */
	double closeness_m4; /* sum of (y - y0)^2 dx dz */
} batten_closeness;
BATTEN_API batten_status batten_hull_closeness(batten_context *context, const batten_hull *hull,
                                               const batten_hull *reference, batten_closeness *out);

/* One line of a hull and how fair it is. */
typedef enum batten_line_kind {
	BATTEN_LINE_STATION,   /* y against z at one x */
	BATTEN_LINE_WATERLINE, /* y against x at one z */
	BATTEN_LINE_BUTTOCK,   /* z against x at one y */
	BATTEN_LINE_DIAGONAL,  /* distance along a 45-degree plane against x; the coordinate is the
	                          height where the plane meets the centreplane */
} batten_line_kind;
typedef struct batten_line {
	batten_line_kind kind;
	double coordinate_m;
	size_t point_count;
	double fn_per_m2; /* NaN below three points */
	size_t inflections;
	double change_max_m; /* against the reference; 0 without one */
} batten_line;

/* All stations, waterlines, and for each waterline height up to the half-beam one buttock at
 * y = that fraction of h, and one diagonal. lines is the caller's, capacity entries long; *count gets
 * the number there are (call with capacity 0 to ask). reference may be NULL. Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_hull_lines(batten_context *context, const batten_hull *hull,
                                           const batten_hull *reference, batten_line *lines,
                                           size_t capacity, size_t *count);

/* ------------------------------------------------------------------------------------------------
 * Devices
 * --------------------------------------------------------------------------------------------- */

#define BATTEN_DEVICE_AUTO (-1)      /* every device that equals the C path bit for bit, else C */
#define BATTEN_DEVICE_REFERENCE (-2) /* the plain C path */

typedef enum batten_precision { BATTEN_F64, BATTEN_F32 } batten_precision;

typedef struct batten_device {
	char name[128], platform[128], driver[64], version[64];
	bool is_cpu, has_f64, has_correct_f32; /* correctly rounded division and square root */
	unsigned compute_units;
	uint64_t global_memory_bytes, local_memory_bytes, max_allocation_bytes;
	unsigned max_work_group;
} batten_device;

/* Number of OpenCL devices; 0 without any OpenCL (never an error: *reason then says why, valid as
 * batten_context_error() is; reason may be NULL). */
BATTEN_API size_t batten_device_count(batten_context *context, const char **reason);

/* Errors: DEVICE (no such index). */
BATTEN_API batten_status batten_device_describe(batten_context *context, size_t index,
                                                batten_device *out);

typedef enum batten_selftest_result {
	BATTEN_SELFTEST_EQUAL,     /* bit for bit as the C path */
	BATTEN_SELFTEST_DIFFERENT, /* runs, with other last bits */
	BATTEN_SELFTEST_FAILED,    /* wrong, or does not build or run */
	BATTEN_SELFTEST_ABSENT,    /* the device has no such precision */
} batten_selftest_result;

typedef struct batten_selftest {
	char kernel[32];
	batten_precision precision;
	batten_selftest_result result;
	size_t compared,
		different; /* numbers compared with the C path, and how many differ in any bit */
	double build_s, run_s;
	char message[256]; /* one line when it failed */
} batten_selftest;

/* Runs every kernel on a small known problem against the C path. results is the caller's, capacity
 * entries long; *count gets the number of tests. Errors: DEVICE, MEMORY. */
BATTEN_API batten_status batten_device_selftest(batten_context *context, size_t index,
                                                batten_selftest *results, size_t capacity,
                                                size_t *count);

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
	BATTEN_ALGORITHM_AUTO,       /* BLOCK where it applies and one mean spacing is twice the other
	                                or more, else MULTILEVEL */
	BATTEN_ALGORITHM_TEXTBOOK,   /* Hooke and Jeeves as published (thesis 7.2): to compare with */
	BATTEN_ALGORITHM_MULTILEVEL, /* probes along hats of several widths: any objective */
	BATTEN_ALGORITHM_BLOCK,      /* whole lines at once, from probes of the integrand: plain bending
	                                of offset grids; bench/README.md says how much faster */
} batten_search_algorithm;
/* "auto", "textbook", "multilevel", "block". */
BATTEN_API const char *batten_search_algorithm_text(batten_search_algorithm algorithm);

typedef struct batten_search_options {
	size_t struct_size;
	int device; /* an index of batten_device_count(), or AUTO, REFERENCE */
	batten_precision precision;
	batten_search_algorithm algorithm; /* BATTEN_ALGORITHM_AUTO */
	double first_step;                 /* of h: 0.02 */
	double last_step;                  /* of h: 2e-7 in f64, 2e-6 in f32; 0 takes these */
	unsigned iteration_limit;          /* 400 */
	unsigned lanes;      /* searches a work-item runs side by side: 1, 2, 4, 8, 16; 0 chooses */
	unsigned work_group; /* work-items a search is shared by; 0 chooses */
	/* The rest is of searches over offset grids only. */
	batten_fairness fairness; /* BATTEN_FAIRNESS_BENDING; VARIATION is for nets only */
	/* Weights of the squared normal curvature along the tangent of the waterline, k11, and square to
	 * it in the surface, k22 (Letcher 4.5: the former counts more). With a and b their roots the
	 * entries of the shape operator in this frame become a k11, sqrt(a b) k12, b k22 in every
	 * fairness: bending is a^2 k11^2 + 2 a b k12^2 + b^2 k22^2. 0 or 1e-6 .. 1e6, not both 0; 1, 1. */
	double longitudinal_weight, transverse_weight;
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

/* Runs count pattern searches (kernels/README.md). y_m is the caller's,
 * [count][waterlines][stations]; results [count]; run may be NULL. The result of a search does not
 * depend on the others, on their order or number, nor (when strict) on what ran it.
 * Returns INCOMPLETE when a search was refused or met its limit. Errors: USAGE (among them an
 * algorithm that this version lacks), DEVICE, KERNEL, MEMORY. */
BATTEN_API batten_status batten_search_batch(batten_context *context, const batten_grid *grid,
                                             size_t count, const batten_search_problem *problems,
                                             const batten_search_options *options, double *y_m,
                                             batten_search_result *results, batten_run *run);

/* What the end of a search is worth, by the exact derivatives of its objective in double, whatever
 * probed it: free are the offsets that are not fixed, nor held at a bound by the gradient. The
 * objective is not convex, so all of it is local: it knows nothing of other minima. */
typedef struct batten_certificate {
	double objective;      /* F at y, in double */
	double fairness;       /* the sum of fairness dS, without w1; NaN where w1 is 0 */
	double gradient_per_m; /* norm of the projected gradient: dF/dy over the free offsets */
	/* The Newton decrement over the free offsets, 1/2 g^T H^-1 g, relative to F: how far F lies above
	 * the minimum of its parabola, bounds left aside (high, by up to 10 times, where offsets are still
	 * on their way to one). An offset that f32 has left rounding away from the bound that holds it adds
	 * what its slope gains on that way. NaN where H is not positive definite over the free offsets, that
	 * is, where no minimum is near, and where the grid is too large (2^26 numbers of its band). */
	double gap_estimate;
	size_t free_count;
	unsigned steps;   /* that batten_search_polish_batch took */
	char message[96]; /* why there is no estimate; else "" */
} batten_certificate;

/* Judges the ends of count searches (thesis 7.2 stops by the step alone). Problems and y_m as given to
 * and by batten_search_batch, of any algorithm; of the options fairness, weights and precision count.
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
 * falls. So it finishes what f32 has screened. Certificates are of the new ends; one whose Hessian is
 * not positive definite, or where no step gains, stays above gap. Else as batten_search_certify_batch. */
BATTEN_API batten_status batten_search_polish_batch(batten_context *context,
                                                    const batten_grid *grid, size_t count,
                                                    const batten_search_problem *problems,
                                                    const batten_search_options *options,
                                                    double gap, double *y_m,
                                                    batten_certificate *certificates);

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

/* ------------------------------------------------------------------------------------------------
 * Surfaces: a hull as one tensor-product B-spline surface
 * --------------------------------------------------------------------------------------------- */

/* Poles, knots and weights of the half hull y >= 0 (thesis 3.2.3.2, Letcher 4.9-4.10). u runs along
 * the hull with x, v along the girth from keel to deck; the other way round the surface is the
 * same, but its normal, by_v x by_u, points inward. */
typedef struct batten_surface batten_surface;

/* What a surface is made of. Orders (degree + 1) 2..8; at least as many poles as the order and at
 * most 4096 in each direction. Knots do not decrease; count + order of them; u runs over
 * [knots_u[order_u - 1], knots_u[count_u]], v likewise. Inside it a knot that occurs order - 1
 * times is a knuckle; more is refused. */
typedef struct batten_surface_net {
	const char *name; /* NULL: "" */
	size_t order_u, order_v, count_u, count_v;
	const double *knots_u, *knots_v; /* NULL: uniform over 0..1, its ends repeated order times */
	const double *poles_m;           /* [count_v][count_u][3]: x, y, z */
	const double *weights;           /* [count_v][count_u], > 0; NULL: all 1 */
} batten_surface_net;

/* Copies the arrays. Errors: USAGE (one line says what is wrong with the net), MEMORY. */
BATTEN_API batten_status batten_surface_create(batten_context *context,
                                               const batten_surface_net *net, batten_surface **out);
BATTEN_API batten_status batten_surface_clone(batten_context *context,
                                              const batten_surface *surface, batten_surface **out);
BATTEN_API void batten_surface_destroy(batten_surface *surface);

/* Borrowed views, valid while the surface lives and is not changed. */
BATTEN_API batten_surface_net batten_surface_describe(const batten_surface *surface);

/* A direction of the net. */
typedef enum batten_direction {
	BATTEN_DIRECTION_U,
	BATTEN_DIRECTION_V,
} batten_direction;

/* The range of the parameter along a direction. */
BATTEN_API void batten_surface_range(const batten_surface *surface, batten_direction direction,
                                     double *first, double *last);

/* A point of a surface. derivative[i][j] is the derivative i times by u and j times by v, for
 * i + j <= 3 (the others are 0): x, y, z; derivative[0][0] is the point. */
typedef struct batten_surface_point {
	double derivative[4][4][3];
} batten_surface_point;

/* Beyond its range a surface goes on with its first or last polynomials. Errors: USAGE (u or v is
 * not finite). */
BATTEN_API batten_status batten_surface_evaluate(const batten_surface *surface, double u, double v,
                                                 batten_surface_point *out);

/* Changes in place. A surface is left untouched when one fails; errors are recorded in the context
 * it was created in. */

/* Replaces the poles, as batten_surface_net has them. Errors: USAGE (not finite, beyond 1e9 m). */
BATTEN_API batten_status batten_surface_set_poles(batten_surface *surface, const double *poles_m);

/* Inserts the knot t times times; every point stays where it is. Errors: USAGE (t is not inside the
 * range, or would occur more than order - 1 times), MEMORY. */
BATTEN_API batten_status batten_surface_insert_knot(batten_surface *surface,
                                                    batten_direction direction, double t,
                                                    size_t times);

/* Raises the order by times; every point stays where it is. Errors: USAGE (beyond order 8 or 4096
 * poles), MEMORY. */
BATTEN_API batten_status batten_surface_elevate(batten_surface *surface, batten_direction direction,
                                                size_t times);

/* Runs one direction the other way over the same range; the normal turns round. */
BATTEN_API void batten_surface_reverse(batten_surface *surface, batten_direction direction);

/* p -> matrix p + shift for every point p; matrix by rows. Errors: USAGE (a pole would not be
 * finite, or beyond 1e9 m). */
BATTEN_API batten_status batten_surface_map(batten_surface *surface, const double matrix[9],
                                            const double shift_m[3]);

/* The image in the centreplane y = 0: starboard from port. u then runs the other way, so that the
 * normal keeps its side. */
BATTEN_API void batten_surface_mirror(batten_surface *surface);

/* ------------------------------------------------------------------------------------------------
 * A surface through the offsets of a hull
 * --------------------------------------------------------------------------------------------- */

/* Edges of the surface that leave the centreplane square to it, so that the mirrored half goes on
 * with the same curvature (Letcher 3.12, 4.13). */
#define BATTEN_ROUNDED_KEEL 1u
#define BATTEN_ROUNDED_STERN 2u
#define BATTEN_ROUNDED_STEM 4u

typedef struct batten_fit_options {
	size_t struct_size;
	size_t order_u, order_v;   /* degree + 1, 2..8: 4, 4 */
	size_t count_u, count_v;   /* poles along the hull and from keel to deck; no default */
	bool hold_centreplane;     /* edges whose points all have y = 0 keep y = 0 throughout; true */
	unsigned rounded;          /* BATTEN_ROUNDED_...; such an edge must lie in the centreplane; 0 */
	unsigned correction_limit; /* rounds of better parameters for the points; 20 */
	double stiffness; /* how much straightness of the net counts against the points: 1e-12..1; 1e-6.
	                     More keeps poles that few points determine from running away */
} batten_fit_options;
BATTEN_API void batten_fit_options_default(batten_fit_options *options);

/* How far a surface is from the offsets it was fitted to: distances of the points from the surface,
 * nearest point each. */
typedef struct batten_fit_deviation {
	size_t point_count; /* offsets given, profile points and line ends included */
	double rms_m, max_m;
	double rms_pct, max_pct; /* of the half-beam */
	double x_m, y_m, z_m;    /* the point that is farthest off */
	unsigned corrections;    /* rounds made */
} batten_fit_deviation;

/* Fits a surface to the points of a hull by least squares; a net of as many poles as points, on a
 * full table, goes through them. The edges of the surface follow keel, stem, stern and the highest
 * points of the sections; where a section does not reach the keel, its keel point is put on the
 * line through the profile points beside it. Knuckles of the sections join to lines along the hull,
 * those of the waterlines to lines up the girth; each becomes a knot repeated order - 1 times, where
 * the surface keeps its crease (Letcher 4.4). deviation may be NULL. Errors: USAGE (orders, counts, a
 * rounded edge that is not in the centreplane), INPUT (fewer points than poles, too few along one
 * direction or where a pole is; knuckles that do not join to lines, or more lines than the poles can
 * hold), MEMORY. */
BATTEN_API batten_status batten_hull_fit(batten_context *context, const batten_hull *hull,
                                         const batten_fit_options *options, batten_surface **out,
                                         batten_fit_deviation *deviation);

/* surface.json (data/schema/surface.schema.json): metres, frame ap-fwd, every number as it reads
 * back. Errors: IO, INPUT (one line: what is wrong and where), MEMORY. */
BATTEN_API batten_status batten_surface_read(batten_context *context, const char *path,
                                             batten_surface **out);
/* Same, from memory; name stands for the file in messages. */
BATTEN_API batten_status batten_surface_parse(batten_context *context, const char *name,
                                              const char *text, size_t length,
                                              batten_surface **out);
/* Errors: IO, MEMORY. */
BATTEN_API batten_status batten_surface_write(batten_context *context,
                                              const batten_surface *surface, const char *path);

/* The surfaces of a file, and what was left out of it. */
typedef struct batten_surfaces batten_surfaces;

/* Reads surfaces by the ending of path: .json (one surface), .igs or .iges (IGES, entity 128), .stp or
 * .step (STEP, B-spline surfaces with knots). IGES and STEP are read by OpenCASCADE, an optional
 * package, in a child process that ends with the call. Any unit becomes metres; axes are taken as
 * they are. Poles, knots and weights are the numbers of the file times its unit. A face is taken where
 * it is the whole of its surface; trimmed ones, other entities, periodic surfaces and those beyond the
 * limits of batten_surface_net are left out, each kind with a warning, in the log too. Errors: USAGE
 * (another ending), MISSING (batten was built without OpenCASCADE), IO, INPUT (damaged, an assembly,
 * or no surface to be had), MEMORY. */
BATTEN_API batten_status batten_surfaces_read(batten_context *context, const char *path,
                                              batten_surfaces **out);
BATTEN_API void batten_surfaces_destroy(batten_surfaces *surfaces);

/* Borrowed, in the order of the file; NULL beyond the count. */
BATTEN_API size_t batten_surfaces_count(const batten_surfaces *surfaces);
BATTEN_API const batten_surface *batten_surfaces_at(const batten_surfaces *surfaces, size_t i);

/* What was left out, a line each (1000 at most). */
BATTEN_API size_t batten_surfaces_warning_count(const batten_surfaces *surfaces);
BATTEN_API const char *batten_surfaces_warning(const batten_surfaces *surfaces, size_t i);

/* Writes count >= 1 surfaces in the format of the ending, as above: metres, frame ap-fwd, names, 17
 * digits, so that every number reads back as it was, but those below 1e-99, which are written as 0.
 * Errors: USAGE (another ending, several surfaces to .json, a weight below 1e-6 or knots spanning less
 * than 1e-80 to the others), MISSING, IO, MEMORY, INTERNAL. */
BATTEN_API batten_status batten_surfaces_write(batten_context *context, size_t count,
                                               const batten_surface *const *surfaces,
                                               const char *path);

/* ------------------------------------------------------------------------------------------------
 * Surfaces on a grid, many at a time
 * --------------------------------------------------------------------------------------------- */

/* What is known of a surface at one (u, v). The normal is by_v x by_u made a unit, outward for a
 * hull whose u runs forward and whose v runs up; a curvature is positive where the surface bends
 * towards it, so a convex hull's are negative (Letcher 4.2-4.3).
 *
 * Principal directions lie square to each other in the tangent plane; either sense of one is right.
 * They are 0 at umbilics: where half of k1 - k2 is not larger than 1e-10 (f32: 1e-5) times
 * sqrt((|by_uu| G)^2 + |by_uv|^2 E G + (|by_vv| E)^2) / area^2, the curvature that the second
 * derivatives could make. along_x and across_x are curvatures of the surface (of its normal sections),
 * not of the section line, and add up to 2 H; both are 0 where the x axis and the normal are the same
 * within 1e-10 (f32: 1e-5) radians, as on a flat transom: there is no direction then. Isophotes are
 * lines along which normal times light is constant (Letcher 4.5). */
#define BATTEN_SURFACE_VALUE_LIST(X)                                                               \
	X(x, "position")                                                                               \
	X(y, "position")                                                                               \
	X(z, "position")                                                                               \
	X(x_u, "first derivative along u")                                                             \
	X(y_u, "first derivative along u")                                                             \
	X(z_u, "first derivative along u")                                                             \
	X(x_v, "first derivative along v")                                                             \
	X(y_v, "first derivative along v")                                                             \
	X(z_v, "first derivative along v")                                                             \
	X(x_uu, "second derivative along u")                                                           \
	X(y_uu, "second derivative along u")                                                           \
	X(z_uu, "second derivative along u")                                                           \
	X(x_uv, "mixed derivative")                                                                    \
	X(y_uv, "mixed derivative")                                                                    \
	X(z_uv, "mixed derivative")                                                                    \
	X(x_vv, "second derivative along v")                                                           \
	X(y_vv, "second derivative along v")                                                           \
	X(z_vv, "second derivative along v")                                                           \
	X(first_uu, "first fundamental form, E")                                                       \
	X(first_uv, "first fundamental form, F")                                                       \
	X(first_vv, "first fundamental form, G")                                                       \
	X(area, "area element |by_v x by_u|")                                                          \
	X(normal_x, "unit normal")                                                                     \
	X(normal_y, "unit normal")                                                                     \
	X(normal_z, "unit normal")                                                                     \
	X(second_uu, "second fundamental form, e")                                                     \
	X(second_uv, "second fundamental form, f")                                                     \
	X(second_vv, "second fundamental form, g")                                                     \
	X(gauss, "Gaussian curvature, K")                                                              \
	X(mean, "mean curvature, H")                                                                   \
	X(k1, "greater principal curvature")                                                           \
	X(k2, "smaller principal curvature")                                                           \
	X(bending, "k1^2 + k2^2")                                                                      \
	X(direction1_x, "unit tangent in whose direction the surface bends by k1")                     \
	X(direction1_y, "unit tangent in whose direction the surface bends by k1")                     \
	X(direction1_z, "unit tangent in whose direction the surface bends by k1")                     \
	X(direction2_x, "unit tangent in whose direction the surface bends by k2")                     \
	X(direction2_y, "unit tangent in whose direction the surface bends by k2")                     \
	X(direction2_z, "unit tangent in whose direction the surface bends by k2")                     \
	X(along_x, "normal curvature along the x axis projected on the tangent plane")                 \
	X(across_x, "normal curvature square to it, along the section x = constant")                   \
	X(isophote, "normal times the direction of the light")

typedef enum batten_surface_value {
#define BATTEN_SURFACE_VALUE_ENTRY(name, text) BATTEN_SURFACE_VALUE_##name,
	BATTEN_SURFACE_VALUE_LIST(BATTEN_SURFACE_VALUE_ENTRY)
#undef BATTEN_SURFACE_VALUE_ENTRY
		BATTEN_SURFACE_VALUE_COUNT,
} batten_surface_value;

/* Which of them a batch keeps. */
typedef enum batten_surface_output {
	BATTEN_SURFACE_POSITION,   /* x, y, z */
	BATTEN_SURFACE_CURVATURE,  /* gauss, mean */
	BATTEN_SURFACE_EVERYTHING, /* all, in the order of the list */
} batten_surface_output;

/* Values a point has: 3, 2 or BATTEN_SURFACE_VALUE_COUNT; 0 for no such output. */
BATTEN_API size_t batten_surface_output_count(batten_surface_output output);

/* The parameters at which every surface of a batch is sampled: 1..65536 each way, within the range
 * of the knots, in any order. */
typedef struct batten_surface_samples {
	size_t u_count, v_count;
	const double *u, *v;
} batten_surface_samples;

typedef struct batten_surface_batch_options {
	size_t struct_size;
	int device; /* an index of batten_device_count(), or AUTO, REFERENCE */
	batten_precision precision;
	batten_surface_output output; /* of batten_surface_grid_batch(); BATTEN_SURFACE_CURVATURE */
	/* Towards the light of isophotes: of any length, finite and not 0; (0, 1, 0), from port. */
	double light[3];
	unsigned gauss_points; /* of batten_surface_energy_batch(), a knot span and direction,
	                                 1..16; 0 takes the order of the direction + 1 */
	bool variation;        /* of batten_surface_energy_batch(): the variation of curvature too, at
	                                 two to three times the work; false */
	unsigned lanes;        /* surfaces a work-item works side by side: 1, 2, 4, 8, 16;
	                                 0 chooses */
	unsigned work_group;   /* work-items that share a line of samples; 0 chooses */
} batten_surface_batch_options;
BATTEN_API void batten_surface_batch_options_default(batten_surface_batch_options *options);

/* Evaluates count surfaces of one topology (equal orders, counts and knots, all rational or none)
 * at the samples. values is the caller's, [count][values of the output][v_count][u_count]; singular
 * [count][v_count][u_count] may be NULL. Where the normal does not exist (a pole of the sphere,
 * both derivatives parallel) singular is 1 and everything that needs the normal is 0; nothing is ever
 * NaN. options and run may be NULL. The result of a surface does not depend on the others, on their
 * order or number, nor (when run->strict) on what ran it. Errors: USAGE, DEVICE, KERNEL, MEMORY. */
BATTEN_API batten_status batten_surface_grid_batch(batten_context *context, size_t count,
                                                   const batten_surface *const *surfaces,
                                                   const batten_surface_samples *samples,
                                                   const batten_surface_batch_options *options,
                                                   double *values, uint8_t *singular,
                                                   batten_run *run);

/* The same with the values as the floats they are computed in, without what widening and writing twice
 * as much costs; each is what batten_surface_grid_batch() gives. options->precision is to be f32. */
BATTEN_API batten_status batten_surface_grid_batch_float(
	batten_context *context, size_t count, const batten_surface *const *surfaces,
	const batten_surface_samples *samples, const batten_surface_batch_options *options,
	float *values, uint8_t *singular, batten_run *run);

/* Integrals over a whole surface (thesis 4.4, Letcher 4.5; Moreton and Sequin 1992); points where the
 * normal does not exist count nothing. Principal directions, and so the variation of curvature along
 * them, exist where |k1 - k2| is more than 1e-6 (f32: 1e-3) of sqrt(k1^2 + k2^2). */
typedef struct batten_surface_energies {
	double bending;  /* of (k1^2 + k2^2) dA */
	double mean;     /* of H^2 dA */
	double gauss;    /* of |K| dA */
	double area_m2;  /* of dA */
	size_t singular; /* points left out */
	/* With options->variation, else 0. */
	double variation_per_m2;   /* of ((dk1/de1)^2 + (dk2/de2)^2) dA */
	size_t variation_left_out; /* points that add nothing to it, singular ones among them */
} batten_surface_energies;

/* Gauss quadrature over every knot span of count surfaces of one topology; energies is the
 * caller's, [count]. As batten_surface_grid_batch() otherwise. */
BATTEN_API batten_status batten_surface_energy_batch(batten_context *context, size_t count,
                                                     const batten_surface *const *surfaces,
                                                     const batten_surface_batch_options *options,
                                                     batten_surface_energies *energies,
                                                     batten_run *run);

/* The same of any number of surfaces of one topology in bounded memory: as many at a time as suit the
 * devices, so that memory follows from the samples, not from how many surfaces there are.
 *
 * The source is asked for surface 0, 1, 2 ... and gives each to batten, which destroys it; NULL ends
 * the stream. The sinks get the results in the same order, values as the batch has them for one
 * surface, valid during the call. What they return other than OK ends the stream and is its status;
 * nothing is asked for or handed over afterwards, and what was taken is destroyed. Source and sink are
 * called by the thread that called, one at a time. */
typedef batten_status (*batten_surface_source)(void *user, size_t index, batten_surface **out);
typedef batten_status (*batten_surface_grid_sink)(void *user, size_t index, const double *values,
                                                  const uint8_t *singular);
typedef batten_status (*batten_surface_energy_sink)(void *user, size_t index,
                                                    const batten_surface_energies *energies);

/* count, run: may be NULL; count gets how many surfaces the sink was given, also on failure. run as of
 * the batches together: strict when all were, the first warning. A stream without any surface is OK.
 * Errors: as the batch, a surface unlike surface 0 among them; those of source and sink. */
BATTEN_API batten_status batten_surface_grid_stream(batten_context *context,
                                                    batten_surface_source source,
                                                    batten_surface_grid_sink sink, void *user,
                                                    const batten_surface_samples *samples,
                                                    const batten_surface_batch_options *options,
                                                    size_t *count, batten_run *run);
BATTEN_API batten_status batten_surface_energy_stream(batten_context *context,
                                                      batten_surface_source source,
                                                      batten_surface_energy_sink sink, void *user,
                                                      const batten_surface_batch_options *options,
                                                      size_t *count, batten_run *run);

/* ------------------------------------------------------------------------------------------------
 * Curves: one line, represented in several ways
 * --------------------------------------------------------------------------------------------- */

/* The points of one line in their order: in the plane (x, y) or in space (x, y, z). */
typedef struct batten_points batten_points;

/* Reads a line file (data/README.md describes the format). Errors: IO, INPUT (naming file, line,
 * column, what was found and what was expected), MEMORY. */
BATTEN_API batten_status batten_points_read(batten_context *context, const char *path,
                                            batten_points **out);
/* Same, from memory; name stands for the file in messages. */
BATTEN_API batten_status batten_points_parse(batten_context *context, const char *name,
                                             const char *text, size_t length, batten_points **out);

/* Copies count points [count][dimension], dimension 2 or 3, count 2..4096, within 1e6 m, each at
 * least 1e-9 m from the one before. name may be NULL: "". Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_points_create(batten_context *context, const char *name,
                                              size_t dimension, size_t count,
                                              const double *points_m, batten_points **out);
BATTEN_API void batten_points_destroy(batten_points *points);

/* Borrowed views, valid while the points live. */
BATTEN_API const char *batten_points_name(const batten_points *points);
BATTEN_API const char *batten_points_source(const batten_points *points); /* "" when not given */
BATTEN_API const char *batten_points_unit(const batten_points *points);   /* "m", "mm" or "ft" */
BATTEN_API size_t batten_points_dimension(const batten_points *points);
BATTEN_API size_t batten_points_count(const batten_points *points);
BATTEN_API const double *batten_points_m(const batten_points *points); /* [count][dimension] */

/* How a curve is made from points (thesis 3.1, 3.2), and whether it goes through them. */
#define BATTEN_CURVE_FORM_LIST(X)                                                                  \
	X(MONOMIAL, "monomial", "one polynomial in powers, by Vandermonde's system")                   \
	X(LAGRANGE, "lagrange", "one polynomial from Lagrange's basis")                                \
	X(NEWTON, "newton", "one polynomial from divided differences")                                 \
	X(HERMITE, "hermite", "piecewise cubic by points and slopes")                                  \
	X(LEAST_SQUARES, "least-squares", "one polynomial of given degree, near the points")           \
	X(SPLINE, "spline", "cubic spline")                                                            \
	X(BEZIER, "bezier", "Bezier curve, the points its polygon")                                    \
	X(BSPLINE, "bspline", "B-spline, the points its polygon (thesis 5.2)")                         \
	X(BSPLINE_FIT, "bspline-fit", "B-spline near the points by least squares, ends held")

typedef enum batten_curve_form {
#define BATTEN_CURVE_FORM_ENTRY(name, word, text) BATTEN_CURVE_##name,
	BATTEN_CURVE_FORM_LIST(BATTEN_CURVE_FORM_ENTRY)
#undef BATTEN_CURVE_FORM_ENTRY
} batten_curve_form;

/* The parameter of the points (Letcher 3.5). The curves of a polygon (BEZIER, BSPLINE) have their
 * own, 0 .. count - order + 1. */
typedef enum batten_curve_parameter {
	BATTEN_PARAMETER_CHORD,   /* cumulative length of the chords, in metres */
	BATTEN_PARAMETER_UNIFORM, /* 0, 1, 2 ... */
	BATTEN_PARAMETER_X,       /* x itself, which must ascend: y(x) and z(x) */
	BATTEN_PARAMETER_GIVEN,   /* by the caller */
} batten_curve_parameter;

/* What holds at an end of a spline (Letcher 3.5). */
typedef enum batten_curve_end_kind {
	BATTEN_END_NATURAL,    /* second derivative 0 */
	BATTEN_END_NOT_A_KNOT, /* third derivative continuous at the point next to it */
	BATTEN_END_CLAMPED,    /* tangent given */
	BATTEN_END_CURVATURE,  /* curvature given, found by iteration */
} batten_curve_end_kind;
typedef struct batten_curve_end {
	batten_curve_end_kind kind;
	/* CLAMPED: direction of the tangent along the curve, of any length; all 0 takes that of the
	 * parabola through the three points at the end. */
	double tangent[3];
	/* CURVATURE: in the plane [0] is the curvature, positive to the left; in space the vector that
	 * points to the centre, of which the part across the tangent counts. */
	double curvature_per_m[3];
} batten_curve_end;

typedef struct batten_curve_options {
	size_t struct_size;
	batten_curve_form form;           /* SPLINE */
	batten_curve_parameter parameter; /* CHORD */
	const double *parameters;         /* GIVEN: [count], ascending; borrowed for the call */
	size_t order;      /* degree + 1 of LEAST_SQUARES (1..32), BSPLINE, BSPLINE_FIT (2..8); 4 */
	size_t pole_count; /* BSPLINE_FIT: order..count; 0: as many as points, through them */
	batten_curve_end ends[2]; /* SPLINE, first and last: NATURAL */
	const double *slopes; /* HERMITE: derivatives by the parameter, [count][dimension]; NULL takes
	                             those of the parabolas through three points */
	const char *label;    /* NULL takes the form's word */
} batten_curve_options;
BATTEN_API void batten_curve_options_default(batten_curve_options *options);

typedef struct batten_curve batten_curve;

/* The points are copied; options may be NULL. One polynomial takes at most 64 points. Errors: USAGE
 * (orders, parameters, x that does not ascend, too many points), INPUT (equations that cannot be
 * told from dependent ones, an end curvature that no spline has), MEMORY. */
BATTEN_API batten_status batten_curve_create(batten_context *context, const batten_points *points,
                                             const batten_curve_options *options,
                                             batten_curve **out);
BATTEN_API void batten_curve_destroy(batten_curve *curve);

/* Borrowed views, valid while the curve lives. */
BATTEN_API const char *batten_curve_label(const batten_curve *curve);
BATTEN_API size_t batten_curve_dimension(const batten_curve *curve);
/* The range of its parameter, and the places between which it is one polynomial, both ends
 * included (a single polynomial: those of its points). */
BATTEN_API void batten_curve_range(const batten_curve *curve, double *first, double *last);
BATTEN_API size_t batten_curve_break_count(const batten_curve *curve);
BATTEN_API const double *batten_curve_breaks(const batten_curve *curve);

/* A place on a curve (Letcher 3.2, geometry by Frenet). At a break the piece that begins there. */
typedef struct batten_curve_point {
	double t;
	double derivative[4][3]; /* by t: x, y, z; [0] is the point */
	bool regular;            /* the tangent exists; else all below is 0 */
	double tangent[3],
		normal[3];          /* units; in the plane the normal points to the left; in space to */
	double binormal[3];     /* the centre of curvature, 0 where there is none */
	double speed;           /* metres by t */
	double curvature_per_m; /* in the plane positive to the left, in space >= 0 */
	double curvature_rate_per_m2; /* its derivative by the arc length */
	double torsion_per_m;         /* 0 in the plane and where the curvature is 0 */
} batten_curve_point;

/* Beyond its range a curve goes on as its first or last piece. Errors: USAGE (t is not finite). */
BATTEN_API batten_status batten_curve_evaluate(const batten_curve *curve, double t,
                                               batten_curve_point *out);

/* Arc length between two parameters (b < a: the negative). Errors: USAGE. */
BATTEN_API batten_status batten_curve_length(const batten_curve *curve, double a, double b,
                                             double *length_m);

/* The given points and how the curve keeps to them. */
typedef struct batten_curve_datum {
	batten_curve_point at; /* the curve at the point's parameter; polygon forms: nearest to it */
	double deviation_m;    /* from the given point */
} batten_curve_datum;
/* data is the caller's, one entry a point. */
BATTEN_API void batten_curve_data(const batten_curve *curve, batten_curve_datum *data);

/* Measures of a curve (thesis 4.4); what does not exist is NaN (null in JSON). */
#define BATTEN_CURVE_MEASURE_LIST(X)                                                               \
	X(deviation_max_m, "largest distance of a given point from the curve")                         \
	X(deviation_rms_m, "root mean square of these distances")                                      \
	X(length_m, "arc length")                                                                      \
	X(curvature_max_per_m, "largest |curvature|")                                                  \
	X(inflections, "sign changes of the curvature; not in space")                                  \
	X(monotone_pieces, "pieces on which the curvature is monotone (Farin and Sapidis 1989)")       \
	X(curvature_rate_max_per_m2, "largest |dk/ds| (Birkhoff 1933)")                                \
	X(energy_bending_per_m, "integral of k^2 ds (Roulier and Rando 1994)")                         \
	X(energy_mvc_per_m3, "integral of (dk/ds)^2 ds; not where the curvature jumps")                \
	X(curvature_jump_per_m, "largest jump of the curvature")                                       \
	X(kink_max_deg, "largest angle between the tangents at a break")                               \
	X(torsion_max_per_m, "largest |torsion|; in space")

typedef struct batten_curve_measures {
#define BATTEN_CURVE_MEASURE_FIELD(name, text) double name;
	BATTEN_CURVE_MEASURE_LIST(BATTEN_CURVE_MEASURE_FIELD)
#undef BATTEN_CURVE_MEASURE_FIELD
} batten_curve_measures;

enum { BATTEN_CURVE_MEASURE_COUNT = (int)(sizeof(batten_curve_measures) / sizeof(double)) };

/* Name and meaning of measure number i, as batten_measure_name(). */
BATTEN_API const char *batten_curve_measure_name(size_t i);
BATTEN_API const char *batten_curve_measure_text(size_t i);

/* Integrals by adaptive Gauss quadrature to 1e-10 of themselves; extremes by 32 samples a piece, then
 * by search about the largest. Errors: MEMORY. */
BATTEN_API batten_status batten_curve_measure(batten_context *context, const batten_curve *curve,
                                              batten_curve_measures *out);

/* Points of the curve at count (2..1000000) parameters evenly spread over its range, as a line file
 * in metres. Errors: USAGE, IO, MEMORY. */
BATTEN_API batten_status batten_curve_write(batten_context *context, const batten_curve *curve,
                                            size_t count, const char *path);

/* ------------------------------------------------------------------------------------------------
 * Hydrostatics over drafts, from offsets, surfaces and triangle meshes
 * --------------------------------------------------------------------------------------------- */

/* Upright, zero trim, moulded, both sides, at one draft. NaN where a quantity does not exist: no
 * waterplane, no volume, no height of the centre of gravity. Definitions: Letcher 9-11. */
#define BATTEN_HYDROSTATICS_LIST(X)                                                                \
	BATTEN_FORM_LIST(X)                                                                            \
	X(transom_area_m2, "immersed area of full end sections, left out of the wetted surface")       \
	X(gmt_m, "transverse metacentric height, + stable")                                            \
	X(gml_m, "longitudinal metacentric height, + stable")                                          \
	X(mt1cm_t_m_per_cm, "moment to change trim by one centimetre over LBP")                        \
	X(volume_mismatch_pct, "largest difference of the x- and z-forms of the volume from the y-form")

typedef struct batten_hydrostatics {
#define BATTEN_HYDROSTATICS_FIELD(name, text) double name;
	BATTEN_HYDROSTATICS_LIST(BATTEN_HYDROSTATICS_FIELD)
#undef BATTEN_HYDROSTATICS_FIELD
} batten_hydrostatics;

enum { BATTEN_HYDROSTATICS_COUNT = (int)(sizeof(batten_hydrostatics) / sizeof(double)) };

/* Name and meaning of quantity number i, in the order of the struct; NULL beyond. */
BATTEN_API const char *batten_hydrostatics_name(size_t i);
BATTEN_API const char *batten_hydrostatics_text(size_t i);

typedef struct batten_hydrostatics_options {
	size_t struct_size;
	batten_quadrature quadrature; /* of offsets; surfaces are integrated by Gauss points, meshes
	                                 triangle by triangle */
	double density_t_per_m3;      /* 1.025 */
	double kg_m;                  /* centre of gravity above the baseline; NaN: not known */
	double lbp_m;          /* of surfaces and meshes; 0 takes x of their foremost point, which
	                                 must lie before the aft perpendicular, x = 0 */
	unsigned gauss_points; /* of surfaces, a knot span and direction, 1..16; 0 takes twice the
	                                 larger degree, 12 at least: exact for polynomial patches that
	                                 the waterline does not cut */
} batten_hydrostatics_options;
BATTEN_API void batten_hydrostatics_options_default(batten_hydrostatics_options *options);

/* At count drafts (m above the baseline, in any order); out is the caller's, [count]. options may be
 * NULL. Errors: USAGE (a draft that is not finite or not within the table, an option out of its range),
 * INPUT (a rule whose conditions do not hold), MEMORY. */
BATTEN_API batten_status batten_hull_hydrostatics(batten_context *context, const batten_hull *hull,
                                                  const batten_hydrostatics_options *options,
                                                  size_t count, const double *drafts_m,
                                                  batten_hydrostatics *out);

/* The draft at which a hull displaces that many tonnes, by Newton's method with the waterplane as
 * the derivative, kept between bounds (Letcher 9.5). Errors: USAGE (also a displacement the hull does
 * not reach; the message names the range), INPUT, MEMORY. */
BATTEN_API batten_status batten_hull_draft_at(batten_context *context, const batten_hull *hull,
                                              const batten_hydrostatics_options *options,
                                              double displacement_t, double *draft_m);

/* Bonjean's curves: the area of every section of the table up to each of count heights, both sides;
 * areas_m2 is the caller's, [count][stations]. Errors: as batten_hull_hydrostatics(). */
BATTEN_API batten_status batten_hull_section_areas(batten_context *context, const batten_hull *hull,
                                                   const batten_hydrostatics_options *options,
                                                   size_t count, const double *heights_m,
                                                   double *areas_m2);

/* The curve of section areas at one draft, with its ends beyond the stations. x_m and area_m2 are the
 * caller's, stations + 2 each; *count gets the number of points. Errors: as
 * batten_hull_hydrostatics(). */
BATTEN_API batten_status batten_hull_area_curve(batten_context *context, const batten_hull *hull,
                                                const batten_hydrostatics_options *options,
                                                double draft_m, double *x_m, double *area_m2,
                                                size_t *count);

/* The same of a half hull as a B-spline surface, by the divergence theorem (Letcher 9.4): Gauss points
 * in every knot span, cut at the waterline. Either sense of the normal will do. Ends that do not reach
 * the centreplane are transoms; a keel that does not, and a deck below the draft, leave the hull open:
 * its volume counts, but the three forms of it (by x, y and z) differ, volume_mismatch_pct says by how
 * much. Errors: USAGE (as above; a draft not within the surface; no volume below it), MEMORY. */
BATTEN_API batten_status batten_surface_hydrostatics(batten_context *context,
                                                     const batten_surface *surface,
                                                     const batten_hydrostatics_options *options,
                                                     size_t count, const double *drafts_m,
                                                     batten_hydrostatics *out);
BATTEN_API batten_status batten_surface_draft_at(batten_context *context,
                                                 const batten_surface *surface,
                                                 const batten_hydrostatics_options *options,
                                                 double displacement_t, double *draft_m);

/* Areas of the sections at section_count places x_m; areas_m2 [height_count][section_count]. */
BATTEN_API batten_status batten_surface_section_areas(batten_context *context,
                                                      const batten_surface *surface,
                                                      const batten_hydrostatics_options *options,
                                                      size_t section_count, const double *x_m,
                                                      size_t height_count, const double *heights_m,
                                                      double *areas_m2);

/* Every measure of a surface: its hydrostatics at a draft, and the energies over the whole of it
 * (batten_surface_energy_batch() on the plain C path). What belongs to tables is NaN. */
BATTEN_API batten_status batten_surface_measure(batten_context *context,
                                                const batten_surface *surface,
                                                const batten_hydrostatics_options *options,
                                                double draft_m, batten_measures *out);

/* A hull as triangles, counter-clockwise seen from the water. */
typedef struct batten_mesh batten_mesh;
typedef struct batten_mesh_table {
	size_t vertex_count, triangle_count; /* 3 at least, 1 at least */
	const double *vertices_m;            /* [vertices][3]: x, y, z; finite, within 1e6 m */
	const uint32_t *triangles;           /* [triangles][3]: numbers of vertices */
	bool half;                           /* the half hull y >= 0: its image in y = 0 is added */
} batten_mesh_table;

/* Copies and checks. Errors: INPUT (one line that names the triangle: a vertex that is not there or
 * occurs twice in it, an edge of more than two triangles, one that runs against its neighbour, all
 * of them inside out), USAGE (nothing given), MEMORY. */
BATTEN_API batten_status batten_mesh_create(batten_context *context, const batten_mesh_table *table,
                                            batten_mesh **out);
BATTEN_API void batten_mesh_destroy(batten_mesh *mesh);

typedef struct batten_mesh_facts {
	size_t vertex_count, triangle_count, edge_count;
	size_t open_edge_count; /* of one triangle only; not counted: those of a half hull in y = 0 */
	size_t first_open_triangle;          /* with such an edge; triangle_count without one */
	double area_m2, lowest_m, highest_m; /* area of all triangles, both sides of a half hull */
} batten_mesh_facts;
BATTEN_API batten_mesh_facts batten_mesh_describe(const batten_mesh *mesh);

/* As for surfaces. The waterplane needs no triangles, nor does a vertical transom; holes below the
 * draft show in volume_mismatch_pct. */
BATTEN_API batten_status batten_mesh_hydrostatics(batten_context *context, const batten_mesh *mesh,
                                                  const batten_hydrostatics_options *options,
                                                  size_t count, const double *drafts_m,
                                                  batten_hydrostatics *out);
BATTEN_API batten_status batten_mesh_draft_at(batten_context *context, const batten_mesh *mesh,
                                              const batten_hydrostatics_options *options,
                                              double displacement_t, double *draft_m);
BATTEN_API batten_status batten_mesh_section_areas(batten_context *context, const batten_mesh *mesh,
                                                   const batten_hydrostatics_options *options,
                                                   size_t section_count, const double *x_m,
                                                   size_t height_count, const double *heights_m,
                                                   double *areas_m2);

/* Something about a hull worth a second look: a quantity outside the range of usual ships (Letcher
 * 10-11), or a surface or mesh that is not closed. Never an error. */
typedef struct batten_warning {
	char name[32]; /* of the quantity */
	char text[160];
} batten_warning;

/* A volume_mismatch_pct above this is warned of. */
#define BATTEN_MISMATCH_LARGEST_PCT 0.01

/* warnings is the caller's, capacity entries long; returns the number there are. */
BATTEN_API size_t batten_hydrostatics_warnings(const batten_hydrostatics *hydrostatics,
                                               batten_warning *warnings, size_t capacity);

/* Numbers in named columns, as files take them, after columns of text where there are any. */
typedef struct batten_table {
	const char *name, *quadrature; /* of the hull and of the rule, NULL where there is none */
	size_t column_count, row_count;
	const char *const *columns; /* names with units */
	const double *values;       /* [rows][columns]; NaN is an empty cell, null in JSON */
	size_t text_count;
	const char *const *text_columns;
	const char *const *texts; /* [rows][text columns], UTF-8; NULL likewise */
} batten_table;

/* Writes the table as CSV or JSON, as path ends in .csv or .json; the file is replaced at once or not
 * at all. Errors: USAGE (another ending), IO, MEMORY. */
BATTEN_API batten_status batten_table_write(batten_context *context, const batten_table *table,
                                            const char *path);

/* The same piece by piece, in bounded memory: open writes names and rows of the first piece, add those
 * of others with the same columns; commit replaces the file, abandon leaves everything as it was. Both
 * end the handle; abandon takes NULL. */
typedef struct batten_table_file batten_table_file;
BATTEN_API batten_status batten_table_open(batten_context *context, const batten_table *table,
                                           const char *path, batten_table_file **file);
BATTEN_API batten_status batten_table_add(batten_table_file *file, const batten_table *table);
BATTEN_API batten_status batten_table_commit(batten_table_file *file);
BATTEN_API void batten_table_abandon(batten_table_file *file);

/* ------------------------------------------------------------------------------------------------
 * Many hulls of one table
 * --------------------------------------------------------------------------------------------- */

/* Where a batch of hulls runs. In f64. */
typedef struct batten_batch_options {
	size_t struct_size;
	int device;          /* an index of batten_device_count(), or AUTO, REFERENCE */
	unsigned lanes;      /* hulls a work-item runs side by side: 1, 2, 4, 8, 16; 0 chooses */
	unsigned work_group; /* work-items a hull is shared by; 0 chooses */
} batten_batch_options;
BATTEN_API void batten_batch_options_default(batten_batch_options *options);

/* batten_hull_hydrostatics() of count hulls that differ in half-breadths only: table gives stations,
 * waterlines, lbp and points off the grid. y_m [count][waterlines][stations], nodes likewise or NULL:
 * those of the table; a '?' counts with the half-breadth given. out is the caller's,
 * [count][draft_count]. The result of a hull does not depend on the others nor (when strict) on what ran
 * it, and is that of batten_hull_hydrostatics() within rounding. Hulls whose lines have gaps, tables with
 * knuckles or points inside the grid, and other rules than the spline are taken one by one, on the host.
 * options, batch and run may be NULL. Errors: as batten_hull_hydrostatics(), USAGE (a half-breadth
 * below 0 or not finite), DEVICE, KERNEL; out is then not to be used. */
BATTEN_API batten_status batten_hull_hydrostatics_batch(
	batten_context *context, const batten_hull *table, const batten_hydrostatics_options *options,
	const batten_batch_options *batch, size_t count, const double *y_m, const uint8_t *nodes,
	size_t draft_count, const double *drafts_m, batten_hydrostatics *out, batten_run *run);

/* What differs from row to row, as in batten_vary_options. */
typedef struct batten_vary_row {
	double dcp_pct, dlcb_pct, dp_fore_pct, dp_aft_pct;
} batten_vary_row;

/* What became of a row. */
typedef struct batten_vary_result {
	batten_status status;       /* OK: there is a variant */
	char reason[120];           /* one line when there is none */
	unsigned passes;            /* how many times the variant was made */
	double cp, lcb_pct_lbp_fwd; /* of the variant, at the parent's draft */
} batten_vary_result;

/* batten_hull_vary() of many rows and the hydrostatics of every variant, in one go: count variants of
 * one parent. Either rows [count] of swing, one-minus-prismatic, lackenby or moor; options give the
 * method and what all rows have in common (its dcp, dlcb, dp_fore, dp_aft are not read). Or row_options
 * [count], each all that is asked of its row, of any methods; options is then not read. results [count].
 * The rest is the caller's, each may be NULL: y_m and nodes, both [count][waterlines][stations] on the
 * parent's table, of the four methods above only; out [count][draft_count], drafts_m NULL (draft_count
 * 1) taking each variant's own draft; outcomes [count], as of batten_hull_vary(), the formulas'
 * parameters and what can be reached of rows worked one by one only; hulls [count], to be destroyed. Of
 * a row that failed numbers are NaN, nodes OUTSIDE and the hull NULL; it stops no other.
 * Agrees with batten_hull_vary() and batten_hull_hydrostatics() within 1e-9 of each value; bit for bit
 * alike whatever the lanes, the batch, the order, the threads and (when strict) the device. Methods that
 * move no sections bodily, thesis, other rules than the spline, layouts with points off the grid, row
 * options that differ in more than these four numbers, and rows whose lines get gaps are worked one by
 * one on the host, shared out to its threads, by the functions named above: the same bits.
 * hydrostatics, batch and run may be NULL. Returns INCOMPLETE when a row failed. Errors: USAGE, INPUT (a
 * parent the method cannot take), DEVICE, KERNEL, MEMORY. */
typedef struct batten_variants {
	size_t count;
	const batten_vary_row *rows;
	size_t draft_count;
	const double *drafts_m;
	batten_vary_result *results;
	double *y_m;
	uint8_t *nodes;
	batten_hydrostatics *out;
	const batten_vary_options *row_options;
	batten_vary_outcome *outcomes;
	batten_hull **hulls;
} batten_variants;
BATTEN_API batten_status batten_hull_vary_measure(batten_context *context,
                                                  const batten_hull *parent,
                                                  const batten_vary_options *options,
                                                  const batten_hydrostatics_options *hydrostatics,
                                                  const batten_batch_options *batch,
                                                  const batten_variants *variants, batten_run *run);

/* ------------------------------------------------------------------------------------------------
 * The pattern search over the control net of a surface, many at a time
 * --------------------------------------------------------------------------------------------- */

/* One search: the y of the poles of a surface. Minimises
 *     F = w1 * integral of fairness dA + w2 * integral of (y - target)^2 |x_u z_v - x_v z_u| du dv / h^4
 * by Gauss quadrature over every knot span, lower <= y <= upper; a pole with lower == upper is
 * fixed. x, z and the knots stay. Points where the start has no normal count nothing in the first
 * integral, whatever the search does. Arrays are [count_v][count_u], as in batten_surface_net. */
typedef struct batten_net_problem {
	const batten_surface *start; /* without weights; y is clamped into the box */
	const double *target_y_m;    /* poles of the surface to stay close to; NULL: those of start */
	const double *lower_y_m, *upper_y_m; /* lower <= upper, finite, within 1e9 m */
	double w1, w2;                       /* dimensionless, as in batten_search_problem */
	double half_beam_m;                  /* h, > 0 */
} batten_net_problem;

typedef struct batten_net_options {
	size_t struct_size;
	/* first_step 0.01, else as its own default; nets know MULTILEVEL only, which is what AUTO takes */
	batten_search_options search;
	batten_fairness fairness; /* BATTEN_FAIRNESS_BENDING */
	unsigned gauss_points;    /* a knot span and direction, 1..16; 0 takes the order */
	/* [count_v][count_u], the same for the whole batch: index (row * count_u + column) of the pole
	 * that a pole moves with, both by the same distance, which stays in the boxes of both; its own
	 * index: the pole is free or leads. NULL: all are free. An edge keeps its tangents when the row
	 * beside it moves with it. */
	const size_t *leader;
} batten_net_options;
BATTEN_API void batten_net_options_default(batten_net_options *options);

/* Runs count searches over surfaces of one topology (orders, counts and knots; without weights; at
 * most 65536 poles) by the multilevel Hooke-Jeeves method (kernels/README.md). y_m is the caller's,
 * [count][count_v][count_u]; results [count]; options and run may be NULL. The result of a search
 * does not depend on the others, on their order or number, nor (when strict) on what ran it.
 * Returns INCOMPLETE when a search was refused (then its y_m is not written) or met its limit.
 * Errors: USAGE (options, a leader that is out of range or follows another, surfaces of different
 * topology or with weights), DEVICE, KERNEL, MEMORY. */
BATTEN_API batten_status batten_net_search_batch(batten_context *context, size_t count,
                                                 const batten_net_problem *problems,
                                                 const batten_net_options *options, double *y_m,
                                                 batten_search_result *results, batten_run *run);

/* ------------------------------------------------------------------------------------------------
 * Forward and inverse fairing, many hulls at a time
 * --------------------------------------------------------------------------------------------- */

/* How a hull is faired. "Order" is degree + 1; knots are the thesis's open uniform ones; ends of lines,
 * and points where a knuckle breaks them, stay. Words: batten_fair_method_text(). */
#define BATTEN_FAIR_METHOD_LIST(X)                                                                 \
	X(SEARCH, "search", "pattern search for the least fairness and closeness (thesis 7)")          \
	X(SMOOTH, "smooth", "gross errors of single offsets replaced, nothing else (thesis 4.5)")      \
	X(FORWARD_APPROXIMATION, "forward-approximation",                                              \
	  "offsets as B-spline polygons, waterlines then sections, again and again (thesis 5.2)")      \
	X(FORWARD_FIT, "forward-fit",                                                                  \
	  "sections so, then waterlines by least squares of few vertices (thesis 5.3)")                \
	X(INVERSE, "inverse",                                                                          \
	  "second derivatives represented by B-splines, offsets from them (thesis 6)")

typedef enum batten_fair_method {
#define BATTEN_FAIR_METHOD_ENTRY(name, word, text) BATTEN_METHOD_##name,
	BATTEN_FAIR_METHOD_LIST(BATTEN_FAIR_METHOD_ENTRY)
#undef BATTEN_FAIR_METHOD_ENTRY
} batten_fair_method;

enum { BATTEN_FAIR_METHOD_COUNT = BATTEN_METHOD_INVERSE + 1 };

/* "search" and what it is; NULL beyond the last. */
BATTEN_API const char *batten_fair_method_text(size_t method);
BATTEN_API const char *batten_fair_method_meaning(size_t method);

enum { BATTEN_ITERATIONS_MOST = 10000 }; /* of a pass */

typedef struct batten_pass_options {
	size_t struct_size;
	batten_fair_method method; /* one of the last three; FORWARD_APPROXIMATION */
	unsigned order;            /* along waterlines, 2..8; 3 */
	unsigned order_sections;   /* along sections; 0 (default): as order */
	/* FORWARD_FIT: polygon vertices of each waterline; 0 (default) takes 8. INVERSE: those of each
	 * line of a field; 0 takes the field's own points as polygon. At least the order. */
	unsigned vertices;
	int device; /* BATTEN_DEVICE_AUTO */
	batten_precision precision;
	unsigned lanes, work_group; /* as in batten_search_options */
} batten_pass_options;
BATTEN_API void batten_pass_options_default(batten_pass_options *options);

/* One iteration of a method, made ready for all hulls of a topology: the same table, nodes, line
 * ends, profile points and knuckles.
 *
 * FORWARD_APPROXIMATION: the points of a line are the polygon of its curve, the new y those at the
 * parameters t where x(t) is the old x. t depends on x alone, so that an iteration is one linear map.
 * FORWARD_FIT: parameters by chord length depend on y; every line of every hull is solved for itself,
 * and one whose points do not determine its vertices stays as it is.
 * INVERSE: the second differences along waterlines and along sections, at the inner points of lines,
 * are two fields; each becomes a tensor-product B-spline of `order` along x and `order_sections` along
 * z. The new offsets are those whose second differences come closest to these, sum of ((difference -
 * asked) a b)^2, a and b being the steps beside the point: residuals are lengths, and both directions
 * count alike. Every end of a line stays. Orders of 2 represent a field exactly: nothing changes.
 *
 * A line of fewer points than the method needs is passed over: the order or the vertices, 3 at least;
 * with INVERSE its inner points. '?' cells are no points and keep their numbers. */
typedef struct batten_pass batten_pass;

/* Errors: USAGE (an option out of its range, an order or vertices that no line has points for), INPUT
 * (a profile point behind the end of its line, a table too large), MEMORY. */
BATTEN_API batten_status batten_pass_create(batten_context *context, const batten_hull *hull,
                                            const batten_pass_options *options, batten_pass **out);

/* The same for a single line y(x): count 3..4096, x ascending. y may have any sign. Errors: USAGE,
 * INPUT (coincident points), MEMORY. */
BATTEN_API batten_status batten_pass_create_line(batten_context *context, size_t count,
                                                 const double *x_m,
                                                 const batten_pass_options *options,
                                                 batten_pass **out);
BATTEN_API void batten_pass_destroy(batten_pass *pass);

typedef struct batten_pass_facts {
	size_t value_count;  /* numbers a hull: nodes as in batten_hull_y_m(), then line ends off the
	                       table; of a line its points */
	size_t line_count;   /* pieces of lines that are faired */
	size_t passed_count; /* pieces passed over: too short */
	size_t term_count;   /* products of an iteration, those of fits left out */
	unsigned order, order_sections, vertices; /* as used */
} batten_pass_facts;
BATTEN_API batten_pass_facts batten_pass_describe(const batten_pass *pass);

/* The numbers of a hull of the topology, [value_count]. */
BATTEN_API void batten_pass_values(const batten_pass *pass, const batten_hull *hull, double *y_m);

/* Works iterations (1..10000) of the pass on count hulls. y_m and out_m are two arrays of the caller,
 * [count][value_count]; no half-breadth becomes less than 0. run may be NULL. The result of a hull
 * does not depend on the others, on their order or number, nor (when strict) on what ran it. Errors:
 * USAGE (also numbers that are not finite or beyond 1e6 m; out_m is then of no use), DEVICE, KERNEL,
 * MEMORY. */
BATTEN_API batten_status batten_pass_batch(batten_context *context, const batten_pass *pass,
                                           size_t count, unsigned iterations, const double *y_m,
                                           double *out_m, batten_run *run);

/* A single line y(x) faired by a method of hulls but SMOOTH; its ends stay. SEARCH (thesis 7.3) lowers
 * F = w1 FN + w2 CN by Hooke and Jeeves' search as published, FN = sum of squared second differences
 * (1/m2), CN = sum of (y - given)^2 (m2). */
typedef struct batten_line_options {
	size_t struct_size;
	batten_fair_method method; /* FORWARD_APPROXIMATION */
	batten_pass_options pass;  /* its method is the one above */
	unsigned iterations;       /* of the last three methods, 1..10000; 1 */
	double w1, w2;             /* of SEARCH, >= 0, not both 0; 1 and 1 */
	double last_step;          /* of SEARCH, in parts of the range of y; 1e-9 */
} batten_line_options;
BATTEN_API void batten_line_options_default(batten_line_options *options);

typedef struct batten_line_facts {
	double fn_before_per_m2, fn_after_per_m2;
	double change_max_m, closeness_m2;
	double objective; /* of SEARCH, else NaN */
} batten_line_facts;

/* y_m is the caller's, [points]; options and facts may be NULL. Returns INCOMPLETE when a search met
 * its limit of a million sweeps. Errors: USAGE (options, a space curve, fewer than three points), INPUT
 * (x does not grow), as batten_pass_create_line, MEMORY. */
BATTEN_API batten_status batten_line_fair(batten_context *context, const batten_points *points,
                                          const batten_line_options *options, double *y_m,
                                          batten_line_facts *facts);

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

/* A measure of the hull at its draft, in the order of batten_hydrostatics, that the search over offsets
 * keeps where it is on the smoothed hull. */
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
	/* Measures to keep, borrowed for the call; of OFFSETS, w2 above 0. The weight is chosen without
	 * them. */
	const batten_keep *keep;
	size_t keep_count; /* at most BATTEN_KEEP_LIMIT */
	double
		polish_gap; /* batten_search_polish_batch() to this; 0 (default): not; of OFFSETS, without
	                      measures to keep */
	batten_variables variables; /* BATTEN_VARIABLES_OFFSETS */
	batten_fairness fairness;   /* of both, in place of search.fairness; no VARIATION with
	                                     OFFSETS, no weights of directions with NET */
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
/* Of a search over OFFSETS; NULL of everything else. */
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
	size_t quantity;          /* in the order of batten_hydrostatics */
	double wanted, tolerance; /* of the smoothed hull; in the unit of the measure */
	double value;             /* of the faired hull */
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
	double ratio;               /* w2/w1 */
	double fairness;            /* the sum of fairness dS of the faired hull */
	batten_closeness closeness; /* to the smoothed hull */
	double gap_estimate;        /* of the search, as in batten_certificate */
	bool dominated; /* another point is no worse in fairness and closeness_m4, better in one */
	batten_search_result result;
} batten_front_point;

/* Sweeps w2/w1 from ratio_low to ratio_high, equal factors apart, in one batch of searches over the
 * offsets: the fairness-closeness front of a hull. points: the caller's, count of them, ratios
 * ascending. options as for batten_hull_fair, with OFFSETS and without weights; NULL: the default.
 * 0 < ratio_low < ratio_high, both 1e-100 .. 1e100; count 2 .. 4096. Returns INCOMPLETE when a search
 * met its iteration limit. Errors: those of batten_hull_fair. */
BATTEN_API batten_status batten_hull_front(batten_context *context, const batten_hull *hull,
                                           const batten_fair_options *options, double ratio_low,
                                           double ratio_high, size_t count,
                                           batten_front_point *points);

/* ------------------------------------------------------------------------------------------------
 * Sweeps: a plan of many designs, run into a database
 * --------------------------------------------------------------------------------------------- */

/* Where SQLite keeps what is not yet in the database file. */
typedef enum batten_sweep_journal {
	BATTEN_SWEEP_JOURNAL_AUTO,     /* WAL, but a rollback journal on network file systems */
	BATTEN_SWEEP_JOURNAL_WAL,      /* a write-ahead log beside it: fewer waits for the disk */
	BATTEN_SWEEP_JOURNAL_ROLLBACK, /* a file that is emptied after every block */
} batten_sweep_journal;

/* How far a sweep is. Counts are of the shard's designs that are stored, earlier runs included. */
typedef struct batten_sweep_progress {
	uint64_t first, end; /* the shard's designs have the numbers first to end - 1 */
	uint64_t stored, not_converged, rejected, failed;
	uint64_t stored_before; /* by earlier runs */
	uint64_t begun;         /* designs from first to begun - 1 are stored or under way */
	double seconds;         /* wall time of this run */
	double vary_s, fair_s, measure_s, store_s; /* in each stage; they go on beside each other */
	char device[128];                          /* what searched, "" before the first block */
} batten_sweep_progress;

typedef struct batten_sweep_options {
	size_t struct_size;
	int device; /* as in batten_search_options; AUTO */
	/* Part number `shard` of shard_count, from 1: 1 of 1. A design is the same in any part. */
	uint64_t shard, shard_count;
	bool resume; /* go on with a database that is there; without one, begin */
	bool large;  /* more than BATTEN_SWEEP_LARGE designs are meant */
	batten_sweep_journal journal;
	/* Designs under way at a time, 1..65536, computed and stored in parts: what a kill repeats at most.
	 * 0 chooses. */
	size_t block;
	bool stages_take_turns; /* nothing runs beside anything else: each stage is timed alone */
	/* Called from the thread of the call before a part is begun and when one is stored; either may be
	 * NULL. stop returning true ends the sweep when what is under way is stored. */
	void (*progress)(const batten_sweep_progress *progress, void *user);
	bool (*stop)(void *user);
	void *user;
} batten_sweep_options;
BATTEN_API void batten_sweep_options_default(batten_sweep_options *options);

#define BATTEN_SWEEP_LARGE 10000000u

/* Runs the plan of a JSON file (data/schema/plan.schema.json) into an SQLite database
 * (host/sweep/README.md): vary, fair, measure, store, beside each other. The plan is checked before
 * anything is made. Design i depends on the plan, its seed and i only: a database that was cut short at any moment
 * and resumed holds the same rows as one that was not, and so do the shards of a sweep together. At
 * most one block is computed again. out may be NULL.
 * Returns INCOMPLETE when a design failed or did not converge, INTERRUPTED when stop said so. Errors:
 * USAGE (options, a database that is there, more than BATTEN_SWEEP_LARGE designs without `large`), INPUT
 * (the plan, its files; resume: a database of another plan, shard, schema or version), IO, DEVICE,
 * KERNEL, MEMORY. */
BATTEN_API batten_status batten_sweep_run(batten_context *context, const char *plan_path,
                                          const char *database_path,
                                          const batten_sweep_options *options,
                                          batten_sweep_progress *out);

/* Puts the databases of all shards of one sweep, in any order, together into one that equals, row for
 * row, that of a sweep in one part; out_path is replaced at once or not at all. designs, how many it
 * has, may be NULL. Errors: USAGE (no database, out_path among them), INPUT (another plan, a shard that is
 * missing, given twice or not complete), IO, MEMORY. */
BATTEN_API batten_status batten_sweep_merge(batten_context *context, const char *out_path,
                                            size_t count, const char *const *paths,
                                            uint64_t *designs);

/* Design number id of a sweep as a hull: varied again from the plan that the database keeps, with the
 * offsets that are kept there, or faired again where they are not. Errors: USAGE (no such design), INPUT
 * (no database of a sweep; a design that failed), IO, MEMORY. */
BATTEN_API batten_status batten_sweep_design(batten_context *context, const char *database_path,
                                             uint64_t id, batten_hull **out);

/* A surface fitted to a hull, its net as large as the offsets and their noise ask for. deviation may
 * be NULL. Errors: as batten_hull_fit(). */
BATTEN_API batten_status batten_hull_fit_chosen(batten_context *context, const batten_hull *hull,
                                                batten_surface **out,
                                                batten_fit_deviation *deviation);

/* Writes both halves of a hull as triangles between samples of its surface, 1..64 steps a knot span, as
 * binary STL (metres, normals outward); the file is replaced at once or not at all. Errors: USAGE, IO,
 * MEMORY. */
BATTEN_API batten_status batten_surface_write_stl(batten_context *context,
                                                  const batten_surface *surface, size_t steps,
                                                  const char *path);

/* ------------------------------------------------------------------------------------------------
 * Pictures
 * --------------------------------------------------------------------------------------------- */

typedef struct batten_picture_options {
	size_t struct_size;
	unsigned width, height; /* pixels, 64..8192; 1600 x 900 */
	const char *title;      /* NULL takes the hull's name */
	double scale_per_m; /* curvature at the ends of the colour scale; 0 takes it from the hull */
} batten_picture_options;
BATTEN_API void batten_picture_options_default(batten_picture_options *options);

/* The curvature at the ends of the colour scale that suits a hull (1/m). */
BATTEN_API batten_status batten_picture_scale(batten_context *context, const batten_hull *hull,
                                              double *scale_per_m);

/* Curvature map of the whole hull as PNG, drawn by Vulkan. driver (128 bytes) gets the name of what
 * drew it and may be NULL. Errors: DEVICE (no Vulkan driver), USAGE (an option out of its range), INPUT
 * (nothing to draw), IO, MEMORY, INTERNAL. */
BATTEN_API batten_status batten_picture_curvature(batten_context *context, const batten_hull *hull,
                                                  const batten_picture_options *options,
                                                  const char *path, char *driver);

/* Body plan and waterlines before (may be NULL) and after as SVG. Errors: INPUT (nothing to draw), IO,
 * MEMORY. */
BATTEN_API batten_status batten_picture_lines(batten_context *context, const batten_hull *before,
                                              const batten_hull *after, const char *path);

/* Hulls side by side. Arrays borrowed for the call. */
typedef struct batten_comparison {
	const char *title;
	size_t hull_count;               /* 1..8 */
	const batten_hull *const *hulls; /* the first lies pale under the lines of the others */
	const char *const *labels;
	size_t row_count; /* 0..40 */
	const char *const *row_names;
	const double *values; /* [row_count][hull_count]; NaN is a dash */
} batten_comparison;

/* One sheet as SVG: of each hull its body plan, its waterlines and a flat map of its mean curvature, on
 * one scale, and under them a table. Errors: USAGE (counts), INPUT (nothing to draw), IO, MEMORY. */
BATTEN_API batten_status batten_picture_comparison(batten_context *context,
                                                   const batten_comparison *comparison,
                                                   const char *path);

/* Curves through or near the same points, with their porcupines, and the curvature of each over its
 * arc length, as SVG (Letcher 3.3). count 1..8, all of one dimension. Errors: USAGE, IO, MEMORY. */
BATTEN_API batten_status batten_picture_curves(batten_context *context, const batten_points *points,
                                               size_t count, const batten_curve *const *curves,
                                               const char *path);

/* A front: fairness over the root mean square change, as SVG. count 2 or more. Errors: USAGE, IO,
 * MEMORY. */
BATTEN_API batten_status batten_picture_front(batten_context *context, const char *name,
                                              size_t count, const batten_front_point *points,
                                              const char *path);

/* Curves of form: draft upwards, every quantity on one scale of 0 to 10 by a power of ten that the
 * legend states (Letcher 11.1). count >= 2 rows of ascending draft. Errors: USAGE, IO, MEMORY. */
BATTEN_API batten_status batten_picture_curves_of_form(batten_context *context, const char *name,
                                                       size_t count,
                                                       const batten_hydrostatics *rows,
                                                       const char *path);

/* Bonjean's curves on the profile: at each section its area up to each height, to the right of it.
 * areas_m2 [height_count][section_count], both counts >= 2, x and heights ascending. */
BATTEN_API batten_status batten_picture_bonjean(batten_context *context, const char *name,
                                                size_t section_count, const double *x_m,
                                                size_t height_count, const double *heights_m,
                                                const double *areas_m2, const char *path);

/* Section area curves at curve_count drafts: counts[curve] points each, one after the other in x_m
 * and area_m2. */
BATTEN_API batten_status batten_picture_section_areas(batten_context *context, const char *name,
                                                      size_t curve_count, const double *drafts_m,
                                                      const size_t *counts, const double *x_m,
                                                      const double *area_m2, const char *path);

/* ------------------------------------------------------------------------------------------------
 * Report of a sweep
 * --------------------------------------------------------------------------------------------- */

enum { BATTEN_REPORT_HULLS_MOST = 100000 };

typedef struct batten_report_options {
	size_t struct_size;
	size_t
		hull_count;   /* hulls whose geometry goes into the report, the best kept ones of the sweep,
	                      0..BATTEN_REPORT_HULLS_MOST; 0 takes the plan's number, else 1000 */
	const char *page; /* the page the data are put into; NULL takes the one of this build */
} batten_report_options;
BATTEN_API void batten_report_options_default(batten_report_options *options);

typedef struct batten_report_facts {
	size_t design_count,
		shown_count;    /* above 200000 designs not all are shown: the front, the hulls
	                                     and every n-th of the rest */
	size_t front_count; /* designs that no other one is better than in every objective */
	size_t hull_count;  /* hulls that can be looked at */
	uint64_t bytes;     /* length of the file */
} batten_report_facts;

/* One HTML file that shows the result of a sweep, the database, in a browser and needs nothing else, no
 * network either. The file is replaced at once or not at all. options and facts may be NULL. Errors:
 * MISSING (batten was built without the page), IO (also a database that is being written), INPUT (no
 * database of a sweep, or one that is not as it should be), USAGE, MEMORY. */
BATTEN_API batten_status batten_report_write(batten_context *context, const char *database,
                                             const batten_report_options *options, const char *path,
                                             batten_report_facts *facts);

#ifdef __cplusplus
}
#endif

#endif
