/* What the options of batten fair ask of forward and inverse fairing. */
#include "fair_job.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static batten_status read_method(const char *text, batten_fair_options *options)
{
	char list[160] = "";
	for (size_t m = 0; m < BATTEN_FAIR_METHOD_COUNT; m++) {
		const char *word = batten_fair_method_text(m);
		if (strcmp(text, word) == 0) {
			options->method = (batten_fair_method)m;
			return BATTEN_OK;
		}
		const size_t used = strlen(list);
		(void)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", word);
	}
	return cli_usage("fair", "--method: found '%s', expected %s or all", text, list);
}

const char *fair_restore_text(batten_restore restore)
{
	static const char *const words[] = { NULL, "beam", "volume", "cp,lcb" };
	return words[restore];
}

static batten_status read_restore(const char *text, batten_restore *out)
{
	for (int what = BATTEN_RESTORE_BEAM; what <= BATTEN_RESTORE_CP_LCB; what++)
		if (strcmp(text, fair_restore_text((batten_restore)what)) == 0) {
			*out = (batten_restore)what;
			return BATTEN_OK;
		}
	return cli_usage("fair", "--restore: found '%s', expected beam, volume or cp,lcb", text);
}

/* An order: the whole number that --order holds, as --order-sections does. */
static batten_status read_order(const char *text, unsigned *out)
{
	char *end = NULL;
	const unsigned long value = strtoul(text, &end, 10);
	if (end == text || *end != '\0' || text[0] < '0' || text[0] > '9' || value > 1000000)
		return cli_usage("fair", "--order: found '%s', expected K, as 3, with this method", text);
	*out = (unsigned)value;
	return BATTEN_OK;
}

/* Options of forward and inverse methods with a method that has none. */
static batten_status check_others(const fair_request *request, const batten_fair_options *options)
{
	const struct {
		const char *name;
		bool given;
	} list[] = { { "order-sections", request->order_sections != UINT_MAX },
		         { "vertices", request->vertices != UINT_MAX },
		         { "max-cn", !isnan(request->max_cn) },
		         { "least-gain", !isnan(request->least_gain) },
		         { "restore", request->restore != NULL },
		         { "smooth", request->smooth_first } };
	for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
		if (list[i].given)
			return cli_usage("fair",
			                 "--%s is about forward and inverse fairing, found it with --method %s",
			                 list[i].name, batten_fair_method_text((size_t)options->method));
	if (options->method == BATTEN_METHOD_SMOOTH && request->no_smooth)
		return cli_usage("fair", "--no-smooth leaves nothing to do for --method smooth");
	return BATTEN_OK;
}

/* Options of the search with another method. */
static batten_status check_search(const fair_request *request, const batten_fair_options *options)
{
	const struct {
		const char *name;
		bool given;
	} list[] = { { "front", request->front != NULL },
		         { "w1", !isnan(request->w1) },
		         { "w2", !isnan(request->w2) },
		         { "lock", request->lock != NULL },
		         { "keep", request->keep != NULL },
		         { "polish", !isnan(request->polish) },
		         { "interior-penalty", request->interior_penalty },
		         { "lower", request->lower_path != NULL },
		         { "upper", request->upper_path != NULL },
		         { "max-distance", request->max_distance != NULL },
		         { "net", request->net != NULL },
		         { "variables", strcmp(request->variables, "offsets") != 0 },
		         { "fairness", strcmp(request->fairness, "bending") != 0 } };
	for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
		if (list[i].given)
			return cli_usage("fair", "--%s is about the search, found it with --method %s",
			                 list[i].name, batten_fair_method_text((size_t)options->method));
	return BATTEN_OK;
}

static batten_status read_pass(const fair_request *request, batten_fair_options *options)
{
	batten_status status = BATTEN_OK;
	/* As printed by the thesis: gross errors are replaced first where that is asked for. */
	options->smooth = request->smooth_first;
	if (request->smooth_first && request->no_smooth)
		return cli_usage("fair", "--smooth and --no-smooth exclude each other");
	if (request->order)
		status = read_order(request->order, &options->pass.order);
	if (status == BATTEN_OK && request->restore)
		status = read_restore(request->restore, &options->restore);
	if (request->order_sections != UINT_MAX)
		options->pass.order_sections = request->order_sections;
	if (status == BATTEN_OK && request->order_sections == 0)
		return cli_usage("fair", "--order-sections: found 0, expected 2 to 8");
	if (status == BATTEN_OK && request->vertices == 0)
		return cli_usage("fair", "--vertices: found 0, expected the order at least");
	if (request->vertices != UINT_MAX)
		options->pass.vertices = request->vertices;
	if (request->iterations != UINT_MAX)
		options->iterations = request->iterations;
	else if (options->method == BATTEN_METHOD_INVERSE)
		options->iterations = 1;
	if (!isnan(request->max_cn))
		options->max_cn_pct = request->max_cn;
	if (!isnan(request->least_gain))
		options->least_gain_pct = request->least_gain;
	return status;
}

batten_status fair_pass_options_read(const fair_request *request, batten_fair_options *options)
{
	batten_status status = read_method(request->method, options);
	if (status != BATTEN_OK)
		return status;
	const bool is_pass = fair_is_pass(options);
	if (options->method != BATTEN_METHOD_SEARCH)
		status = check_search(request, options);
	if (status == BATTEN_OK && !is_pass)
		return check_others(request, options);
	return status == BATTEN_OK ? read_pass(request, options) : status;
}

bool fair_is_pass(const batten_fair_options *options)
{
	return (int)options->method >= BATTEN_METHOD_FORWARD_APPROXIMATION;
}
