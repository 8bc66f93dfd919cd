/* Lists and names on the command line of batten vary. */
#include "vary_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A finite number at the start of a text; *end gets what follows it. */
static bool read_number(const char *text, double *out, const char **end)
{
	char *stop = NULL;
	*out = strtod(text, &stop);
	*end = stop;
	return stop != text && isfinite(*out);
}

/* Numbers with commas between them, as many as there is room for. 0: no such list. */
static size_t read_numbers(const char *text, double *out, size_t most)
{
	for (size_t count = 0; count < most; text++) {
		if (!read_number(text, &out[count], &text))
			return 0;
		count++;
		if (*text == '\0')
			return count;
		if (*text != ',')
			return 0;
	}
	return 0;
}

batten_status vary_read_lbd(vary_request *request)
{
	double factors[3];
	if (!request->lbd && request->rows)
		return BATTEN_OK;
	if (!request->lbd || read_numbers(request->lbd, factors, 3) != 3)
		return cli_usage("vary",
		                 "--lbd: found '%s', expected three factors of length, breadth, "
		                 "depth, as 1.2,0.9,1.1",
		                 request->lbd ? request->lbd : "");
	request->options.scale_x = factors[0];
	request->options.scale_y = factors[1];
	request->options.scale_z = factors[2];
	return BATTEN_OK;
}

batten_status vary_read_average(vary_request *request)
{
	if (!request->with || (!request->weight && !request->rows))
		return cli_usage("vary", "average expects --with FILE[,FILE ...] and --weight W[,W ...]");
	const size_t length = strlen(request->with);
	if (length >= sizeof request->paths)
		return cli_usage("vary", "--with: the list is too long");
	memcpy(request->paths, request->with, length + 1);
	for (char *path = request->paths; path && request->other_count < VARY_LIST_MOST;) {
		request->other_paths[request->other_count++] = path;
		path = strchr(path, ',');
		if (path)
			*path++ = '\0';
	}
	const size_t weights = request->weight
	                           ? read_numbers(request->weight, request->weights, VARY_LIST_MOST)
	                           : request->other_count;
	if (weights != request->other_count)
		return cli_usage("vary", "--weight: found '%s', expected %zu number%s, one for each hull",
		                 request->weight, request->other_count,
		                 request->other_count == 1 ? "" : "s");
	request->options.other_count = request->other_count;
	request->options.weights = request->weights;
	return BATTEN_OK;
}

batten_status vary_read_targets(vary_request *request)
{
	batten_vary_options *options = &request->options;
	const struct {
		const char *name;
		double *value;
	} known[] = {
		{ "volume_m3=", &options->volume_m3 },
		{ "lcb_pct_lbp_fwd=", &options->lcb_pct_lbp_fwd },
		{ "cp=", &options->cp },
	};
	for (const char *text = request->targets ? request->targets : ""; *text;) {
		size_t i = 0;
		while (i < 3 && strncmp(text, known[i].name, strlen(known[i].name)) != 0)
			i++;
		if (i == 3 || !isnan(*known[i].value) ||
		    !read_number(text + strlen(known[i].name), known[i].value, &text) ||
		    (*text != ',' && *text != '\0') || (*text == ',' && text[1] == '\0'))
			return cli_usage("vary",
			                 "--targets: found '%s', expected volume_m3=V,lcb_pct_lbp_fwd=X,cp=C, "
			                 "each at most once",
			                 request->targets);
		text += *text == ',';
	}
	if (request->middle && read_numbers(request->middle, request->middle_file, 2) != 2)
		return cli_usage("vary", "--middle: found '%s', expected two x of the file, as 12,18",
		                 request->middle);
	return BATTEN_OK;
}

batten_status vary_read_move(vary_request *request)
{
	size_t count = 0;
	if (!request->move && request->rows)
		return BATTEN_OK;
	const char *text = request->move ? request->move : "";
	bool good = *text != '\0';
	for (; good && *text && count < VARY_LIST_MOST; count++) {
		good = read_number(text, &request->from[count], &text) && *text == ':';
		good = good && read_number(text + 1, &request->to[count], &text) &&
		       (*text == '\0' || (*text == ',' && text[1] != '\0'));
		text += good && *text == ',';
	}
	if (!good || *text || count < 2)
		return cli_usage("vary",
		                 "--move: found '%s', expected parts of LBP from the AP and where "
		                 "they go, as 0:0,0.5:0.55,1:1",
		                 request->move ? request->move : "");
	request->options.point_count = count;
	request->options.from_part = request->from;
	request->options.to_part = request->to;
	return BATTEN_OK;
}

batten_status vary_read_preset(vary_request *request)
{
	size_t i = 0;
	while (i < BATTEN_VARY_PRESET_COUNT &&
	       (!request->preset || strcmp(request->preset, batten_vary_preset_name(i)) != 0))
		i++;
	if (i == BATTEN_VARY_PRESET_COUNT)
		return cli_usage(
			"vary",
			"--preset: found '%s', expected bilge-radius, rise-of-floor, u-ness, v-ness "
			"or flare",
			request->preset ? request->preset : "");
	if (isnan(request->amount) && !request->rows)
		return cli_usage("vary", "--amount was expected");
	request->options.preset = (batten_vary_preset)i;
	request->options.amount = isnan(request->amount) ? 0 : request->amount;
	return BATTEN_OK;
}

batten_status vary_read_drafts(vary_request *request)
{
	request->draft_count = read_numbers(request->drafts, request->drafts_m, VARY_DRAFTS_MOST);
	for (size_t i = 0; i < request->draft_count; i++)
		if (!(request->drafts_m[i] > 0))
			request->draft_count = 0;
	return request->draft_count > 0
	           ? BATTEN_OK
	           : cli_usage("vary", "--drafts: found '%s', expected 1 to %d drafts above 0",
	                       request->drafts, VARY_DRAFTS_MOST);
}

/* Cuts a copy of a list at its commas. The number of parts, 0 where one is empty or there are too many. */
static size_t cut_list(const char *list, char *copy, size_t size, char **parts, size_t most)
{
	const size_t length = strlen(list);
	if (length == 0 || length >= size)
		return 0;
	memcpy(copy, list, length + 1);
	size_t count = 0;
	for (char *part = copy; part; count++) {
		char *comma = strchr(part, ',');
		if (comma)
			*comma++ = '\0';
		if (count == most || *part == '\0')
			return 0;
		parts[count] = part;
		part = comma;
	}
	return count;
}

/* NAME=VALUE */
static bool read_target(char *part, batten_solve_target *out)
{
	char *equals = strchr(part, '=');
	const char *end = NULL;
	if (!equals || !read_number(equals + 1, &out->value, &end) || *end)
		return false;
	*equals = '\0';
	out->measure = part;
	return true;
}

/* NAME or NAME=LEAST:MOST */
static bool read_parameter(char *part, batten_solve_parameter *out)
{
	char *equals = strchr(part, '=');
	const char *end = NULL;
	*out = (batten_solve_parameter){ part, NAN, NAN };
	if (!equals)
		return true;
	*equals = '\0';
	return read_number(equals + 1, &out->least, &end) && *end == ':' &&
	       read_number(end + 1, &out->most, &end) && *end == '\0';
}

batten_status vary_read_solve(vary_request *request)
{
	enum { MOST = BATTEN_VARY_TARGETS_MOST };
	char *parts[MOST];
	if (request->method || !request->solve || !request->by)
		return cli_usage("vary", "--solve NAME=VALUE,... and --by PARAMETER,... were expected, "
		                         "without --method");
	if (!request->out)
		return cli_usage("vary", "--out FILE.csv was expected");
	size_t count = cut_list(request->solve, request->names[0], sizeof request->names[0], parts,
	                        MOST);
	bool good = count > 0;
	for (size_t i = 0; i < count && good; i++)
		good = read_target(parts[i], &request->solve_targets[i]);
	if (!good)
		return cli_usage("vary",
		                 "--solve: found '%s', expected measures and values, as "
		                 "volume_m3=250,lcb_pct_lbp_fwd=-1, %d at most",
		                 request->solve, MOST);
	request->solve_count = count;
	count = cut_list(request->by, request->names[1], sizeof request->names[1], parts, MOST);
	good = count == request->solve_count;
	for (size_t i = 0; i < count && good; i++)
		good = read_parameter(parts[i], &request->solve_parameters[i]);
	if (!good)
		return cli_usage("vary",
		                 "--by: found '%s', expected %zu parameter%s, as lackenby.dcp or "
		                 "affine.y=0.9:1.2",
		                 request->by, request->solve_count, request->solve_count == 1 ? "" : "s");
	return BATTEN_OK;
}
