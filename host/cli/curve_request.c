/* The representations of batten curve --as. */
#include "curve_request.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
	const char *word;
	batten_curve_form form;
} forms[] = {
#define FORM_ENTRY(name, word, text) { word, BATTEN_CURVE_##name },
	BATTEN_CURVE_FORM_LIST(FORM_ENTRY)
#undef FORM_ENTRY
};
enum { FORM_COUNT = sizeof forms / sizeof forms[0] };

static batten_status refuse(const char *label, const char *expected)
{
	return cli_usage("curve", "--as: found '%s', expected %s", label, expected);
}

/* A whole number up to 4096 at *text, which moves behind it. */
static bool read_size(const char **text, size_t *out)
{
	size_t digits = 0;
	*out = 0;
	for (; **text >= '0' && **text <= '9' && digits < 5; (*text)++, digits++)
		*out = 10 * *out + (size_t)(**text - '0');
	return digits > 0 && *out <= 4096;
}

/* One number, or up to three with ':' between them. */
static bool read_numbers(const char *text, double out[3], size_t *count)
{
	for (*count = 0; *count < 3;) {
		char *end = NULL;
		out[*count] = strtod(text, &end);
		if (end == text || !isfinite(out[*count]))
			return false;
		(*count)++;
		if (*end == '\0')
			return true;
		if (*end != ':')
			return false;
		text = end + 1;
	}
	return false;
}

/* natural, not-a-knot, clamped, clamped=SLOPE, clamped=X:Y:Z, curvature=K. */
static bool read_end(const char *text, batten_curve_end *end)
{
	double numbers[3] = { 0 };
	size_t count = 0;
	*end = (batten_curve_end){ .kind = BATTEN_END_NATURAL };
	if (strcmp(text, "natural") == 0)
		return true;
	end->kind = BATTEN_END_NOT_A_KNOT;
	if (strcmp(text, "not-a-knot") == 0)
		return true;
	end->kind = BATTEN_END_CLAMPED;
	if (strcmp(text, "clamped") == 0)
		return true;
	if (strncmp(text, "clamped=", 8) == 0 && read_numbers(text + 8, numbers, &count)) {
		/* A slope: dy/dx of a line that runs with x. */
		if (count == 1) {
			numbers[1] = numbers[0];
			numbers[0] = 1;
		}
		memcpy(end->tangent, numbers, sizeof numbers);
		return numbers[0] != 0 || numbers[1] != 0 || numbers[2] != 0;
	}
	end->kind = BATTEN_END_CURVATURE;
	if (strncmp(text, "curvature=", 10) != 0 || !read_numbers(text + 10, numbers, &count))
		return false;
	memcpy(end->curvature_per_m, numbers, sizeof numbers);
	return true;
}

/* FIRST/LAST, or one condition for both ends. */
static batten_status read_ends(curve_choice *choice, const char *text)
{
	static const char expected[] = "spline:END or spline:FIRST/LAST, each natural, not-a-knot, "
								   "clamped, clamped=SLOPE or curvature=K";
	char copy[LABEL_SIZE];
	(void)snprintf(copy, sizeof copy, "%s", text);
	char *slash = strchr(copy, '/');
	if (slash)
		*slash = '\0';
	batten_curve_end *ends = choice->options.ends;
	if (!read_end(copy, &ends[0]) || !read_end(slash ? slash + 1 : copy, &ends[1]))
		return refuse(choice->label, expected);
	return BATTEN_OK;
}

/* What follows the form's word: ends, a degree, an order, or an order and a number of poles. */
static batten_status read_argument(curve_choice *choice, const char *text)
{
	batten_curve_options *options = &choice->options;
	if (options->form == BATTEN_CURVE_SPLINE)
		return read_ends(choice, text);
	if (options->form != BATTEN_CURVE_LEAST_SQUARES && options->form != BATTEN_CURVE_BSPLINE &&
	    options->form != BATTEN_CURVE_BSPLINE_FIT)
		return refuse(choice->label, "nothing after this form");
	if (!read_size(&text, &options->order))
		return refuse(choice->label,
		              "least-squares:DEGREE, bspline:ORDER, bspline-fit:ORDER:POLES");
	if (options->form == BATTEN_CURVE_LEAST_SQUARES)
		options->order++;
	if (options->form == BATTEN_CURVE_BSPLINE_FIT && *text == ':') {
		text++;
		if (!read_size(&text, &options->pole_count))
			return refuse(choice->label, "a number of poles");
	}
	return *text == '\0' ? BATTEN_OK : refuse(choice->label, "nothing more");
}

static batten_status read_choice(const curve_request *request, curve_choice *choice)
{
	size_t length = strcspn(choice->label, ":");
	size_t i = 0;
	while (i < FORM_COUNT &&
	       (strlen(forms[i].word) != length || strncmp(forms[i].word, choice->label, length) != 0))
		i++;
	if (i == FORM_COUNT)
		return refuse(choice->label, "monomial, lagrange, newton, hermite, least-squares:DEGREE, "
		                             "spline:ENDS, bezier, bspline:ORDER, bspline-fit:ORDER:POLES");
	batten_curve_options_default(&choice->options);
	choice->options.form = forms[i].form;
	choice->options.parameter = request->by;
	choice->options.label = choice->label;
	if (request->order > 0)
		choice->options.order = request->order;
	return choice->label[length] == ':' ? read_argument(choice, choice->label + length + 1)
	                                    : BATTEN_OK;
}

batten_status curve_read_request(curve_request *request)
{
	static const char *const parameters[] = { "chord", "uniform", "x" };
	size_t by = 0;
	while (by < 3 && strcmp(request->parameter, parameters[by]) != 0)
		by++;
	if (by == 3)
		return cli_usage("curve", "--parameter: found '%s', expected chord, uniform or x",
		                 request->parameter);
	request->by = (batten_curve_parameter)by;
	batten_status status = BATTEN_OK;
	for (const char *word = request->as; status == BATTEN_OK;) {
		size_t length = strcspn(word, ",");
		if (request->count == CURVES_MOST || length == 0 || length >= LABEL_SIZE)
			return cli_usage("curve", "--as: found '%s', expected up to %d forms, comma-separated",
			                 request->as, (int)CURVES_MOST);
		curve_choice *choice = &request->choices[request->count++];
		memcpy(choice->label, word, length);
		status = read_choice(request, choice);
		if (word[length] == '\0')
			break;
		word += length + 1;
	}
	return status;
}
