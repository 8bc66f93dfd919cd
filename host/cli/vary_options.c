#include "vary_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const cli_command command = {
	.name = "vary",
	.usage = "HULL.csv --method METHOD --out FILE.csv [OPTION ...]",
	.summary = "makes a variant of a parent hull",
	.example =
		"  batten vary data/hulls/bsra_trawler.csv --method lackenby --dcp 5 --dlcb 2 \\\n"
		"    --out fuller.csv\n"
		"  batten vary data/hulls/wigley.csv --method affine --lbd 1.2,0.9,1.1 --out long.csv\n"
		"  batten vary data/hulls/bsra_trawler.csv --method three-body --middle 12.192,18.288 \\\n"
		"    --targets volume_m3=260,cp=0.6 --out longer.csv\n"
		"  batten vary data/hulls/wigley.csv --method stretch --move 0:0,0.5:0.55,1:1 --out s.csv\n",
	.notes =
		"Methods and the options they take:\n"
		"  swing                --dlcb\n"
		"  one-minus-prismatic  --dcp --dlcb\n"
		"  lackenby             --dcp --dlcb --dp-fore --dp-aft\n"
		"  moor                 --dcb --dlcb --dcwp --dlcf\n"
		"  average              --with --weight\n"
		"  affine               --lbd\n"
		"  three-body           --targets --middle\n"
		"  stretch              --move\n"
		"dcp, dcb and dcwp are percent of the parent's value, dlcb and dlcf percent of LBP, + forward,\n"
		"dp percent of the half length. What is asked for is met by iteration unless --first-pass.\n"
		"The first four move whole sections along the ship and keep the parent's table.\n",
};

/* Which methods take an option, a bit each. */
#define TAKES(symbol) (1u << BATTEN_VARY_##symbol)

struct owned {
	const char *name;
	bool given;
	unsigned takers;
};

static batten_status check_owned(const vary_request *request)
{
	const unsigned halves = TAKES(ONE_MINUS_PRISMATIC) | TAKES(LACKENBY);
	const unsigned moved = halves | TAKES(SWING) | TAKES(MOOR);
	const struct owned options[] = {
		{ "dcp", !isnan(request->dcp), halves },
		{ "dcb", !isnan(request->dcb), TAKES(MOOR) },
		{ "dlcb", !isnan(request->dlcb), moved },
		{ "dcwp", !isnan(request->dcwp), TAKES(MOOR) },
		{ "dlcf", !isnan(request->dlcf), TAKES(MOOR) },
		{ "dp-fore", !isnan(request->dp_fore), TAKES(LACKENBY) },
		{ "dp-aft", !isnan(request->dp_aft), TAKES(LACKENBY) },
		{ "lcb-used", !isnan(request->lcb_used), halves | TAKES(MOOR) },
		{ "lcf-used", !isnan(request->lcf_used), TAKES(MOOR) },
		{ "with", request->with, TAKES(AVERAGE) },
		{ "weight", request->weight, TAKES(AVERAGE) },
		{ "lbd", request->lbd, TAKES(AFFINE) },
		{ "targets", request->targets, TAKES(THREE_BODY) },
		{ "middle", request->middle, TAKES(THREE_BODY) },
		{ "move", request->move, TAKES(STRETCH) },
		{ "thesis", request->thesis, moved },
		{ "first-pass", request->first_pass, moved | TAKES(THREE_BODY) },
	};
	for (size_t i = 0; i < sizeof options / sizeof options[0]; i++)
		if (options[i].given && !(options[i].takers & (1u << request->options.method)))
			return cli_usage("vary", "--%s: method %s takes no such option", options[i].name,
			                 request->method);
	return BATTEN_OK;
}

static batten_status read_method(vary_request *request)
{
	if (!request->method)
		return cli_usage("vary", "--method was expected");
	for (size_t i = 0; i < BATTEN_VARY_METHOD_COUNT; i++)
		if (strcmp(request->method, batten_vary_method_name(i)) == 0) {
			request->options.method = (batten_vary_method)i;
			return BATTEN_OK;
		}
	return cli_usage("vary",
	                 "--method: found '%s', expected swing, one-minus-prismatic, lackenby, moor, "
	                 "average, affine, three-body or stretch",
	                 request->method);
}

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

static batten_status read_lbd(vary_request *request)
{
	double factors[3];
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

static batten_status read_average(vary_request *request)
{
	if (!request->with || !request->weight)
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
	const size_t weights = read_numbers(request->weight, request->weights, VARY_LIST_MOST);
	if (weights != request->other_count)
		return cli_usage("vary", "--weight: found '%s', expected %zu number%s, one for each hull",
		                 request->weight, request->other_count,
		                 request->other_count == 1 ? "" : "s");
	request->options.other_count = request->other_count;
	request->options.weights = request->weights;
	return BATTEN_OK;
}

static batten_status read_targets(vary_request *request)
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

static batten_status read_move(vary_request *request)
{
	size_t count = 0;
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

static void take_number(double given, double *option)
{
	if (!isnan(given))
		*option = given;
}

static batten_status read_values(vary_request *request)
{
	batten_vary_options *options = &request->options;
	options->first_pass = request->first_pass;
	options->thesis = request->thesis;
	take_number(request->dcp, &options->dcp_pct);
	take_number(request->dcb, &options->dcp_pct);
	take_number(request->dlcb, &options->dlcb_pct);
	take_number(request->dcwp, &options->dcwp_pct);
	take_number(request->dlcf, &options->dlcf_pct);
	take_number(request->dp_fore, &options->dp_fore_pct);
	take_number(request->dp_aft, &options->dp_aft_pct);
	take_number(request->lcb_used, &options->lcb_used_pct);
	take_number(request->lcf_used, &options->lcf_used_pct);
	switch (options->method) {
	case BATTEN_VARY_AVERAGE:
		return read_average(request);
	case BATTEN_VARY_AFFINE:
		return read_lbd(request);
	case BATTEN_VARY_THREE_BODY:
		return read_targets(request);
	case BATTEN_VARY_STRETCH:
		return read_move(request);
	default:
		return BATTEN_OK;
	}
}

void vary_request_place(vary_request *request, const batten_hull *hull)
{
	if (!request->middle)
		return;
	double a = 0, b = 0, z = 0;
	batten_hull_place(hull, request->middle_file[0], 0, &a, &z);
	batten_hull_place(hull, request->middle_file[1], 0, &b, &z);
	request->options.middle_aft_m = fmin(a, b);
	request->options.middle_fore_m = fmax(a, b);
}

static batten_status parse(int argc, char **argv, vary_request *request, size_t *count, bool *done)
{
	const cli_option options[] = {
		{ "method", CLI_TEXT, &request->method, "METHOD", "how, see below" },
		{ "out", CLI_TEXT, &request->out, "FILE.csv", "where the variant goes" },
		{ "dcp", CLI_NUMBER, &request->dcp, "PCT", "change of C_P, percent of its value" },
		{ "dcb", CLI_NUMBER, &request->dcb, "PCT", "change of C_B, percent of its value" },
		{ "dlcb", CLI_NUMBER, &request->dlcb, "PCT", "move of LCB, percent of LBP, + forward" },
		{ "dcwp", CLI_NUMBER, &request->dcwp, "PCT", "change of C_WP, percent of its value" },
		{ "dlcf", CLI_NUMBER, &request->dlcf, "PCT", "move of LCF, percent of LBP, + forward" },
		{ "dp-fore", CLI_NUMBER, &request->dp_fore, "PCT", "parallel body added to the fore half" },
		{ "dp-aft", CLI_NUMBER, &request->dp_aft, "PCT", "parallel body added to the after half" },
		{ "lcb-used", CLI_NUMBER, &request->lcb_used, "PCT",
		  "LCB that enters the split of the halves (the parent's)" },
		{ "lcf-used", CLI_NUMBER, &request->lcf_used, "PCT", "the same for LCF" },
		{ "with", CLI_TEXT, &request->with, "FILES", "other hulls, commas between them" },
		{ "weight", CLI_TEXT, &request->weight, "W,...", "their weights; the parent has the rest" },
		{ "lbd", CLI_TEXT, &request->lbd, "X,Y,Z", "factors of length, breadth and depth" },
		{ "targets", CLI_TEXT, &request->targets, "NAME=VALUE,...",
		  "volume_m3, lcb_pct_lbp_fwd, cp (others as the parent)" },
		{ "middle", CLI_TEXT, &request->middle, "X,X",
		  "ends of the middle body, x of the file (the parallel body)" },
		{ "move", CLI_TEXT, &request->move, "FROM:TO,...", "parts of LBP from the AP" },
		{ "first-pass", CLI_FLAG, &request->first_pass, NULL, "one pass, no iteration" },
		{ "thesis", CLI_FLAG, &request->thesis, NULL,
		  "the thesis's procedure: 21 sections, areas from six waterlines" },
		{ 0 },
	};
	return cli_parse(&command, argc, argv, options, &request->common, &request->hull_path, 1, count,
	                 done);
}

batten_status vary_request_read(int argc, char **argv, vary_request *request, bool *done)
{
	*request = (vary_request){ .dcp = NAN,
		                       .dcb = NAN,
		                       .dlcb = NAN,
		                       .dcwp = NAN,
		                       .dlcf = NAN,
		                       .dp_fore = NAN,
		                       .dp_aft = NAN,
		                       .lcb_used = NAN,
		                       .lcf_used = NAN };
	batten_vary_options_default(&request->options);
	size_t count = 0;
	batten_status status = parse(argc, argv, request, &count, done);
	if (status != BATTEN_OK || *done)
		return status;
	if (count != 1)
		return cli_usage("vary", "an offsets file was expected");
	status = read_method(request);
	if (status == BATTEN_OK && !request->out)
		status = cli_usage("vary", "--out FILE.csv was expected");
	if (status == BATTEN_OK)
		status = check_owned(request);
	return status == BATTEN_OK ? read_values(request) : status;
}
