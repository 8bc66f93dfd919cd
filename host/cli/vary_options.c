#include "vary_options.h"
#include "vary_values.h"

#include <math.h>
#include <string.h>

static const cli_command command = {
	.name = "vary",
	.usage = "HULL.csv --method METHOD [--rows ROWS.csv] --out FILE.csv [OPTION ...]",
	.summary = "makes a variant of a parent hull",
	.example =
		"  batten vary data/hulls/bsra_trawler.csv --method lackenby --dcp 5 --dlcb 2 \\\n"
		"    --out fuller.csv\n"
		"  batten vary data/hulls/wigley.csv --method affine --lbd 1.2,0.9,1.1 --out long.csv\n"
		"  batten vary data/hulls/bsra_trawler.csv --method three-body --middle 12.192,18.288 \\\n"
		"    --targets volume_m3=260,cp=0.6 --out longer.csv\n"
		"  batten vary data/hulls/wigley.csv --method stretch --move 0:0,0.5:0.55,1:1 --out s.csv\n"
		"  batten vary data/hulls/bsra_trawler.csv --method nonlinear --preset rise-of-floor \\\n"
		"    --amount 0.1 --out risen.csv\n"
		"  batten vary data/hulls/bsra_trawler.csv --method free-form \\\n"
		"    --lattice data/lattices/trawler_shoulder.json --out shoulder.csv\n"
		"  batten vary data/hulls/bsra_trawler.csv --method lackenby --rows data/examples/trawler-rows.csv \\\n"
		"    --drafts 2.515,2,1.5 --out variants.csv\n"
		"  batten vary data/hulls/bsra_trawler.csv --solve volume_m3=255,lcb_pct_lbp_fwd=-1,cb=0.53 \\\n"
		"    --by lackenby.dcp,lackenby.dlcb,affine.y --out solved.csv\n",
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
		"  nonlinear            --preset --amount\n"
		"  free-form            --lattice\n"
		"dcp, dcb and dcwp are percent of the parent's value, dlcb and dlcf percent of LBP, + forward,\n"
		"dp percent of the half length. What is asked for is met by iteration unless --first-pass.\n"
		"The first four move whole sections along the ship and keep the parent's table.\n"
		"Presets: bilge-radius (what it loses at most, part of the half-beam), rise-of-floor (at the\n"
		"half-beam, part of the draft), u-ness (middle of the sections lowered, part of the draft),\n"
		"v-ness (narrower towards the keel) and flare (wider to the fore and upwards), both parts of\n"
		"the half-breadth. A lattice is JSON (data/README.md).\n"
		"--rows makes a variant a row and writes one table: row, status, reason, what was asked and got,\n"
		"hydrostatics at every draft. ROWS.csv begins with names: id (text, if first), and numbers of\n"
		"the method as above; affine takes x, y, z, three-body the targets, average weight (weight1, ...),\n"
		"stretch the points as names (0, 0.5, 1) and where they go, free-form lattice (a file). Other\n"
		"options hold for all rows; an empty cell takes them too. Rows that fail say why and stop no\n"
		"other; the exit code is then 1.\n"
		"--solve meets measures of form (volume_m3, cb, cp, cm, cwp, lcb_pct_lbp_fwd, lcf_pct_lbp_fwd,\n"
		"beam_wl_m, draft_m, lbp_m, ...) by as many parameters of methods: swing.dlcb,\n"
		"one-minus-prismatic.dcp .dlcb, lackenby.dcp .dlcb .dp-fore .dp-aft, moor.dcb .dlcb .dcwp .dlcf,\n"
		"affine.x .y .z, nonlinear.PRESET; ranges as lackenby.dcp=-10:10.\n",
};

struct owned {
	const char *name;
	bool given;
	unsigned takers;
};

static batten_status check_owned(const vary_request *request)
{
	const unsigned halves = VARY_HALVES, moved = VARY_MOVED;
	const struct owned options[] = {
		{ "dcp", !isnan(request->dcp), halves },
		{ "dcb", !isnan(request->dcb), VARY_TAKES(MOOR) },
		{ "dlcb", !isnan(request->dlcb), moved },
		{ "dcwp", !isnan(request->dcwp), VARY_TAKES(MOOR) },
		{ "dlcf", !isnan(request->dlcf), VARY_TAKES(MOOR) },
		{ "dp-fore", !isnan(request->dp_fore), VARY_TAKES(LACKENBY) },
		{ "dp-aft", !isnan(request->dp_aft), VARY_TAKES(LACKENBY) },
		{ "lcb-used", !isnan(request->lcb_used), halves | VARY_TAKES(MOOR) },
		{ "lcf-used", !isnan(request->lcf_used), VARY_TAKES(MOOR) },
		{ "with", request->with, VARY_TAKES(AVERAGE) },
		{ "weight", request->weight, VARY_TAKES(AVERAGE) },
		{ "lbd", request->lbd, VARY_TAKES(AFFINE) },
		{ "targets", request->targets, VARY_TAKES(THREE_BODY) },
		{ "middle", request->middle, VARY_TAKES(THREE_BODY) },
		{ "move", request->move, VARY_TAKES(STRETCH) },
		{ "preset", request->preset, VARY_TAKES(NONLINEAR) },
		{ "amount", !isnan(request->amount), VARY_TAKES(NONLINEAR) },
		{ "lattice", request->lattice, VARY_TAKES(FREE_FORM) },
		{ "thesis", request->thesis, moved },
		{ "first-pass", request->first_pass, moved | VARY_TAKES(THREE_BODY) },
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
	                 "average, affine, three-body, stretch, nonlinear or free-form",
	                 request->method);
}

/* What belongs to rows. */
static batten_status check_rows(const vary_request *request)
{
	const struct {
		const char *name;
		bool given;
	} options[] = {
		{ "drafts", request->drafts },
		{ "hulls", request->hulls },
		{ "device", request->device != BATTEN_DEVICE_AUTO },
	};
	for (size_t i = 0; i < sizeof options / sizeof options[0] && !request->rows; i++)
		if (options[i].given)
			return cli_usage("vary", "--%s: of --rows only", options[i].name);
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
		return vary_read_average(request);
	case BATTEN_VARY_AFFINE:
		return vary_read_lbd(request);
	case BATTEN_VARY_THREE_BODY:
		return vary_read_targets(request);
	case BATTEN_VARY_STRETCH:
		return vary_read_move(request);
	case BATTEN_VARY_NONLINEAR:
		return vary_read_preset(request);
	case BATTEN_VARY_FREE_FORM:
		return request->lattice || request->rows ? BATTEN_OK
		                                         : cli_usage("vary", "--lattice FILE was expected");
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
		{ "preset", CLI_TEXT, &request->preset, "NAME", "a shape the nonlinear method knows" },
		{ "amount", CLI_NUMBER, &request->amount, "A", "how much of it" },
		{ "lattice", CLI_TEXT, &request->lattice, "FILE.json", "poles of a lattice that move" },
		{ "solve", CLI_TEXT, &request->solve, "NAME=VALUE,...",
		  "measures to be met, in place of --method" },
		{ "by", CLI_TEXT, &request->by, "PARAMETER,...", "what may change, as many" },
		{ "rows", CLI_TEXT, &request->rows, "ROWS.csv",
		  "many variants, a row each; --out is a table" },
		{ "drafts", CLI_TEXT, &request->drafts, "T[,T...]",
		  "of the table, in metres (each variant's own)" },
		{ "hulls", CLI_TEXT, &request->hulls, "DIR", "each variant too, as DIR/ROW.csv" },
		{ "device", CLI_DEVICE, &request->device, "D",
		  "of --rows: auto (default), reference, index" },
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
		                       .lcf_used = NAN,
		                       .amount = NAN,
		                       .device = BATTEN_DEVICE_AUTO };
	batten_vary_options_default(&request->options);
	size_t count = 0;
	batten_status status = parse(argc, argv, request, &count, done);
	if (status != BATTEN_OK || *done)
		return status;
	if (count != 1)
		return cli_usage("vary", "an offsets file was expected");
	status = check_rows(request);
	if (status == BATTEN_OK && (request->solve || request->by))
		return vary_read_solve(request);
	if (status == BATTEN_OK)
		status = read_method(request);
	if (status == BATTEN_OK && !request->out)
		status = cli_usage("vary", "--out FILE.csv was expected");
	if (status == BATTEN_OK)
		status = check_owned(request);
	if (status == BATTEN_OK && request->drafts)
		status = vary_read_drafts(request);
	return status == BATTEN_OK ? read_values(request) : status;
}
