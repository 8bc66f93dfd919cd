/* What the options of batten fair ask of the net. */
#include "fair_job.h"

#include <math.h>
#include <string.h>

static batten_status read_fairness(const char *text, batten_fair_options *options)
{
	for (int f = BATTEN_FAIRNESS_BENDING; f <= BATTEN_FAIRNESS_VARIATION; f++)
		if (strcmp(text, batten_fairness_text((batten_fairness)f)) == 0) {
			options->fairness = (batten_fairness)f;
			return BATTEN_OK;
		}
	return cli_usage("fair", "--fairness: found '%s', expected bending, mean, gauss or mvc", text);
}

static batten_status read_size(const fair_request *request, batten_fit_options *fit)
{
	if (request->net && !cli_read_pair(request->net, &fit->count_u, &fit->count_v))
		return cli_usage("fair", "--net: found '%s', expected MxN, as 12x10", request->net);
	if (request->net && (fit->count_u == 0 || fit->count_v == 0))
		return cli_usage("fair", "--net: found '%s', expected at least one pole each way",
		                 request->net);
	if (request->order && !cli_read_pair(request->order, &fit->order_u, &fit->order_v))
		return cli_usage("fair", "--order: found '%s', expected KxL, as 4x4", request->order);
	return BATTEN_OK;
}

/* Options of the net without the net. */
static batten_status check_offsets(const fair_request *request, const batten_fair_options *options)
{
	const struct {
		const char *name, *text;
	} given[] = { { "net", request->net },
		          { "order", request->order },
		          { "fix-tangent", request->tangents },
		          { "round", request->rounded } };
	for (size_t i = 0; i < sizeof given / sizeof given[0]; i++)
		if (given[i].text)
			return cli_usage("fair", "--%s is about a net: --variables net was expected with it",
			                 given[i].name);
	if (options->fairness == BATTEN_FAIRNESS_VARIATION &&
	    (!isnan(request->longitudinal) || !isnan(request->transverse)))
		return cli_usage("fair",
		                 "--fairness mvc goes along the principal directions, both alike: no "
		                 "--longitudinal or --transverse was expected with it");
	return BATTEN_OK;
}

batten_status fair_net_options_read(const fair_request *request, batten_fair_options *options)
{
	batten_status status = read_fairness(request->fairness, options);
	if (status != BATTEN_OK)
		return status;
	if (strcmp(request->variables, "net") != 0)
		return check_offsets(request, options);
	options->variables = BATTEN_VARIABLES_NET;
	if (!isnan(request->longitudinal) || !isnan(request->transverse))
		return cli_usage(
			"fair", "--longitudinal and --transverse are about offsets: --variables offsets was "
					"expected with them");
	if (request->interior_penalty)
		return cli_usage(
			"fair",
			"--interior-penalty is about offsets: --variables offsets was expected with it");
	if (request->lower_path || request->upper_path)
		return cli_usage("fair",
		                 "--%s bounds the offsets of a table, not the poles of a net: --variables "
		                 "offsets was expected with it",
		                 request->lower_path ? "lower" : "upper");
	status = read_size(request, &options->fit);
	if (status == BATTEN_OK && request->tangents)
		status = cli_read_edges("fair", "fix-tangent", request->tangents, true,
		                        &options->fixed_tangents);
	if (status == BATTEN_OK && request->rounded)
		status = cli_read_edges("fair", "round", request->rounded, false, &options->fit.rounded);
	return status;
}

/* A whole number below 10000 at the beginning of a text; NULL where there is none, else what
 * follows it. */
static const char *read_number(const char *text, size_t *out)
{
	size_t digits = 0;
	for (*out = 0; *text >= '0' && *text <= '9' && digits < 4; text++, digits++)
		*out = 10 * *out + (size_t)(*text - '0');
	return digits > 0 ? text : NULL;
}

/* The numbers of a lock; false where they are not what its kind has. */
static bool read_pole(const char *text, batten_net_lock *lock)
{
	size_t first = 0;
	const char *end = read_number(text, &first);
	lock->row = first;
	lock->column = first;
	if (end && lock->kind == BATTEN_NET_LOCK_POLE)
		end = *end == '@' ? read_number(end + 1, &lock->row) : NULL;
	return end && *end == '\0';
}

batten_status fair_net_lock_read(const char *text, size_t length, batten_fair_options *options,
                                 fair_locks *locks, bool *found)
{
	static const char *const kinds[] = { "row:", "column:", "pole:", "edge:" };
	enum { EDGE = 3 };
	char copy[32];
	size_t kind = 0;
	while (kind <= EDGE && strncmp(text, kinds[kind], strlen(kinds[kind])) != 0)
		kind++;
	*found = kind <= EDGE;
	if (!*found)
		return BATTEN_OK;
	(void)snprintf(copy, sizeof copy, "%.*s", (int)length, text);
	const char *rest = copy + strlen(kinds[kind]);
	if (options->variables != BATTEN_VARIABLES_NET)
		return cli_usage("fair", "--lock: %s is about a net: --variables net was expected with it",
		                 copy);
	if (kind == EDGE)
		return cli_read_edges("fair", "lock edge", rest, true, &options->locked_edges);
	if (options->net_lock_count == FAIR_LOCK_LIMIT)
		return cli_usage("fair", "--lock: at most %d locks are expected", FAIR_LOCK_LIMIT);
	batten_net_lock *lock = &locks->poles[options->net_lock_count++];
	lock->kind = (batten_net_lock_kind)kind;
	if (length >= sizeof copy || !read_pole(rest, lock))
		return cli_usage("fair", "--lock: found '%.*s', expected row:K, column:K or pole:I@J",
		                 (int)length, text);
	return BATTEN_OK;
}
