/* What the options of batten fair ask for. */
#include "fair_job.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One of the words that this version knows. */
static batten_status check_word(const char *option, const char *found, const char *const *known)
{
	char list[128] = "";
	for (; *known; known++) {
		if (strcmp(found, *known) == 0)
			return BATTEN_OK;
		const size_t used = strlen(list);
		(void)snprintf(list + used, sizeof list - used, "%s%s", used ? " or " : "", *known);
	}
	return cli_usage("fair", "--%s: found '%s', expected %s", option, found, list);
}

static batten_status check_words(const fair_request *request)
{
	static const char *const searches[] = { "auto", "textbook", "multilevel", "block", NULL };
	static const char *const variables[] = { "offsets", "net", NULL };
	batten_status status = check_word("search", request->search, searches);
	if (status == BATTEN_OK)
		status = check_word("variables", request->variables, variables);
	return status;
}

/* "1%" of the half-beam, or a length with its unit: 0.5mm, 0.002m, 0.01ft. */
static batten_status read_distance(const char *text, batten_fair_options *options)
{
	static const struct {
		const char *unit;
		double metres;
	} units[] = { { "mm", 1e-3 }, { "m", 1.0 }, { "ft", 0.3048 } };
	char *end = NULL;
	const double value = strtod(text, &end);
	if (end != text && isfinite(value) && value >= 0.0) {
		if (strcmp(end, "%") == 0) {
			options->max_distance_part = value / 100.0;
			return BATTEN_OK;
		}
		for (size_t u = 0; u < sizeof units / sizeof units[0]; u++)
			if (strcmp(end, units[u].unit) == 0) {
				options->max_distance_m = value * units[u].metres;
				return BATTEN_OK;
			}
	}
	return cli_usage(
		"fair", "--max-distance: found '%s', expected e.g. 1%% (of the half-beam) or 0.5mm", text);
}

static batten_status bad_lock(const char *text, size_t length)
{
	return cli_usage(
		"fair",
		"--lock: found '%.*s', expected station:X, waterline:Z or point:X@Z in the unit "
		"and frame of the file, or, of a net, row:K, column:K, pole:I@J or edge:NAME",
		(int)length, text);
}

/* One lock: text[0..length). */
static batten_status read_lock(const char *text, size_t length, const batten_hull *hull,
                               batten_lock *lock)
{
	static const char *const kinds[] = { "station:", "waterline:", "point:" };
	char copy[128];
	if (length >= sizeof copy)
		return bad_lock(text, length);
	memcpy(copy, text, length);
	copy[length] = '\0';
	for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; kind++) {
		const size_t prefix = strlen(kinds[kind]);
		if (strncmp(copy, kinds[kind], prefix) != 0)
			continue;
		char *end = NULL;
		double place[2] = { strtod(copy + prefix, &end), 0.0 };
		bool good = end != copy + prefix && isfinite(place[0]);
		if (good && kind == BATTEN_LOCK_POINT) {
			const char *second = end + 1;
			good = *end == '@';
			if (good) {
				place[1] = strtod(second, &end);
				good = end != second && isfinite(place[1]);
			}
		}
		if (!good || *end != '\0')
			break;
		lock->kind = (batten_lock_kind)kind;
		const bool only_z = lock->kind == BATTEN_LOCK_WATERLINE;
		batten_hull_place(hull, only_z ? 0.0 : place[0], only_z ? place[0] : place[1], &lock->x_m,
		                  &lock->z_m);
		return BATTEN_OK;
	}
	return bad_lock(text, length);
}

static batten_status read_locks(const char *text, const batten_hull *hull,
                                batten_fair_options *options, fair_locks *locks)
{
	while (*text) {
		const size_t length = strcspn(text, ",");
		bool of_net = false;
		batten_status status = fair_net_lock_read(text, length, options, locks, &of_net);
		if (status == BATTEN_OK && !of_net) {
			if (options->lock_count == FAIR_LOCK_LIMIT)
				return cli_usage("fair", "--lock: at most %d locks are expected", FAIR_LOCK_LIMIT);
			status = read_lock(text, length, hull, &locks->places[options->lock_count++]);
		}
		if (status != BATTEN_OK)
			return status;
		text += length;
		text += *text == ',';
	}
	return BATTEN_OK;
}

/* A measure's name and how far it may go: "volume_m3=0.1%" or "lcb_pct_lbp_fwd=0.05". */
static batten_status read_keep(const char *text, size_t length, batten_keep *keep)
{
	const char *equals = memchr(text, '=', length);
	const size_t name = equals ? (size_t)(equals - text) : length;
	size_t q = 0;
	while (q < BATTEN_HYDROSTATICS_COUNT && (strlen(batten_hydrostatics_name(q)) != name ||
	                                         strncmp(text, batten_hydrostatics_name(q), name) != 0))
		q++;
	char *end = NULL;
	const double value = equals ? strtod(equals + 1, &end) : NAN;
	const bool is_part = equals && *end == '%';
	if (q == BATTEN_HYDROSTATICS_COUNT || !equals || end == equals + 1 ||
	    end + is_part != text + length || !(value > 0.0) || !isfinite(value))
		return cli_usage("fair",
		                 "--keep: found '%.*s', expected a measure's name and a tolerance above 0, "
		                 "e.g. volume_m3=0.1%% or lcb_pct_lbp_fwd=0.05",
		                 (int)length, text);
	*keep = (batten_keep){ q, is_part ? value / 100.0 : value, is_part };
	return BATTEN_OK;
}

static batten_status read_keeps(const char *text, batten_fair_options *options, fair_locks *locks)
{
	while (*text) {
		const size_t length = strcspn(text, ",");
		if (options->keep_count == BATTEN_KEEP_LIMIT)
			return cli_usage("fair", "--keep: at most %d measures are expected", BATTEN_KEEP_LIMIT);
		const batten_status status = read_keep(text, length, &locks->keep[options->keep_count++]);
		if (status != BATTEN_OK)
			return status;
		text += length;
		text += *text == ',';
	}
	options->keep = locks->keep;
	return BATTEN_OK;
}

/* The textbook search takes hundreds to thousands of sweeps. */
enum { TEXTBOOK_ITERATIONS = 20000 };

static batten_status read_search(const fair_request *request, batten_search_options *options)
{
	for (int a = BATTEN_ALGORITHM_AUTO; a <= BATTEN_ALGORITHM_BLOCK; a++)
		if (strcmp(request->search, batten_search_algorithm_text((batten_search_algorithm)a)) == 0)
			options->algorithm = (batten_search_algorithm)a;
	if (strcmp(request->variables, "net") == 0 && options->algorithm == BATTEN_ALGORITHM_TEXTBOOK)
		return cli_usage(
			"fair", "--search: found '%s', expected auto, block or multilevel with --variables net",
			request->search);
	options->interior_penalty = request->interior_penalty;
	if (request->interior_penalty && options->algorithm != BATTEN_ALGORITHM_AUTO &&
	    options->algorithm != BATTEN_ALGORITHM_MULTILEVEL)
		return cli_usage(
			"fair", "--search: found '%s', expected auto or multilevel with --interior-penalty",
			request->search);
	if (options->algorithm == BATTEN_ALGORITHM_TEXTBOOK)
		options->iteration_limit = TEXTBOOK_ITERATIONS;
	return BATTEN_OK;
}

batten_status fair_options_read(const fair_request *request, const batten_hull *hull,
                                batten_fair_options *options, fair_locks *locks)
{
	batten_fair_options_default(options);
	options->smooth = !request->no_smooth;
	options->search.device = request->device;
	options->search.precision = request->precision;
	batten_status status = check_words(request);
	if (status == BATTEN_OK)
		status = fair_pass_options_read(request, options);
	if (status != BATTEN_OK || options->method != BATTEN_METHOD_SEARCH)
		return status;
	status = fair_net_options_read(request, options);
	if (status != BATTEN_OK)
		return status;
	options->weights_given = !isnan(request->w1);
	if (options->weights_given == isnan(request->w2))
		return cli_usage("fair", "--w1 and --w2 go together");
	if (request->w1 < 0.0 || request->w2 < 0.0)
		return cli_usage("fair", "--w1 %g --w2 %g: expected two weights, not negative", request->w1,
		                 request->w2);
	if (request->iterations == 0)
		return cli_usage("fair", "--iterations: found 0, expected 1 to 1000000");
	options->w1 = request->w1;
	options->w2 = request->w2;
	if (!isnan(request->longitudinal))
		options->search.longitudinal_weight = request->longitudinal;
	if (!isnan(request->transverse))
		options->search.transverse_weight = request->transverse;
	status = read_search(request, &options->search);
	if (request->iterations != UINT_MAX)
		options->search.iteration_limit = request->iterations;
	if (status == BATTEN_OK && request->max_distance)
		status = read_distance(request->max_distance, options);
	if (status == BATTEN_OK && request->lock)
		status = read_locks(request->lock, hull, options, locks);
	if (!isnan(request->polish) && !(request->polish > 0.0))
		return cli_usage("fair", "--polish %g: expected a gap above 0, e.g. 1e-9", request->polish);
	if (!isnan(request->polish) && request->interior_penalty)
		return cli_usage("fair", "--polish and --interior-penalty exclude each other: steps of the "
		                         "first end at bounds");
	if (!isnan(request->polish) && request->keep)
		return cli_usage("fair", "--polish and --keep exclude each other");
	if (!isnan(request->polish))
		options->polish_gap = request->polish;
	if (status == BATTEN_OK && request->keep)
		status = read_keeps(request->keep, options, locks);
	options->locks = locks->places;
	options->net_locks = locks->poles;
	return status;
}
