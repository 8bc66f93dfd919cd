#include "sweep/expression.h"
#include "core/number.h"

#include <math.h>
#include <string.h>

enum { DEPTH_MOST = 64 };

struct parser {
	const char *text;
	size_t at;
	unsigned depth;
	expression_lookup lookup;
	const void *user;
	sweep_expression *out;
	expression_fault *fault;
};

static bool parse_sum(struct parser *parser);

static bool fail(struct parser *parser, const char *expected)
{
	*parser->fault = (expression_fault){ parser->at, expected };
	return false;
}

static char peek(struct parser *parser)
{
	while (parser->text[parser->at] == ' ' || parser->text[parser->at] == '\t')
		parser->at++;
	return parser->text[parser->at];
}

static bool take(struct parser *parser, char c)
{
	if (peek(parser) != c)
		return false;
	parser->at++;
	return true;
}

static bool push(struct parser *parser, expression_step step)
{
	if (parser->out->step_count == EXPRESSION_STEPS_MOST)
		return fail(parser, "a shorter expression");
	parser->out->steps[parser->out->step_count++] = step;
	return true;
}

static bool push_operation(struct parser *parser, expression_operation operation)
{
	return push(parser, (expression_step){ .operation = operation });
}

static bool is_letter(char c)
{
	return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
	return c >= '0' && c <= '9';
}

/* f(a) or f(a, b), the name read and the bracket open. */
static bool parse_call(struct parser *parser, const char *name, size_t length)
{
	static const struct {
		const char *name;
		expression_operation operation;
		unsigned arguments;
	} functions[] = {
		{ "sqrt", EXPRESSION_ROOT, 1 },
		{ "abs", EXPRESSION_ABSOLUTE, 1 },
		{ "min", EXPRESSION_LEAST, 2 },
		{ "max", EXPRESSION_MOST, 2 },
	};
	for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
		if (strlen(functions[f].name) != length || memcmp(functions[f].name, name, length) != 0)
			continue;
		for (unsigned a = 0; a < functions[f].arguments; a++) {
			if (a > 0 && !take(parser, ','))
				return fail(parser, "a comma and a second argument");
			if (!parse_sum(parser))
				return false;
		}
		return take(parser, ')') ? push_operation(parser, functions[f].operation)
		                         : fail(parser, "a closing bracket");
	}
	parser->at = (size_t)(name - parser->text);
	return fail(parser, "sqrt, abs, min or max");
}

static bool parse_name(struct parser *parser)
{
	const size_t start = parser->at;
	const char *name = parser->text + start;
	size_t length = 0;
	while (is_letter(name[length]) || is_digit(name[length]))
		length++;
	parser->at += length;
	if (take(parser, '('))
		return parse_call(parser, name, length);
	const size_t index = parser->lookup(name, length, parser->user);
	if (index == SIZE_MAX) {
		parser->at = start;
		return fail(parser, "the name of a measure or a parameter");
	}
	return push(parser, (expression_step){ .operation = EXPRESSION_NAMED, .index = index });
}

static bool parse_number(struct parser *parser)
{
	const char *text = parser->text + parser->at;
	size_t length = 0;
	while (is_digit(text[length]) || text[length] == '.')
		length++;
	if (text[length] == 'e' || text[length] == 'E') {
		length++;
		if (text[length] == '+' || text[length] == '-')
			length++;
		while (is_digit(text[length]))
			length++;
	}
	double value = 0.0;
	if (!batten_number_read(text, length, &value))
		return fail(parser, "a number");
	parser->at += length;
	return push(parser, (expression_step){ .operation = EXPRESSION_NUMBER, .value = value });
}

/* One bracket or sign deeper. */
static bool parse_factor(struct parser *parser)
{
	if (++parser->depth > DEPTH_MOST)
		return fail(parser, "fewer brackets and signs, one in the other");
	bool good = false;
	const char c = peek(parser);
	if (take(parser, '-'))
		good = parse_factor(parser) && push_operation(parser, EXPRESSION_NEGATE);
	else if (take(parser, '('))
		good = parse_sum(parser) && (take(parser, ')') || fail(parser, "a closing bracket"));
	else if (is_letter(c))
		good = parse_name(parser);
	else if (is_digit(c) || c == '.')
		good = parse_number(parser);
	else
		good = fail(parser, "a number, a name or a bracket");
	parser->depth--;
	return good;
}

static bool parse_product(struct parser *parser)
{
	if (!parse_factor(parser))
		return false;
	for (;;) {
		const bool times = take(parser, '*');
		if (!times && !take(parser, '/'))
			return true;
		if (!parse_factor(parser) ||
		    !push_operation(parser, times ? EXPRESSION_MULTIPLY : EXPRESSION_DIVIDE))
			return false;
	}
}

static bool parse_sum(struct parser *parser)
{
	if (!parse_product(parser))
		return false;
	for (;;) {
		const bool plus = take(parser, '+');
		if (!plus && !take(parser, '-'))
			return true;
		if (!parse_product(parser) ||
		    !push_operation(parser, plus ? EXPRESSION_ADD : EXPRESSION_SUBTRACT))
			return false;
	}
}

bool expression_parse(const char *text, expression_lookup lookup, const void *user,
                      sweep_expression *out, expression_fault *fault)
{
	out->step_count = 0;
	struct parser parser = {
		.text = text, .lookup = lookup, .user = user, .out = out, .fault = fault
	};
	if (!parse_sum(&parser))
		return false;
	return peek(&parser) == '\0' || fail(&parser, "the end, or an operator");
}

static double joined(expression_operation operation, double a, double b)
{
	switch (operation) {
	case EXPRESSION_ADD:
		return a + b;
	case EXPRESSION_SUBTRACT:
		return a - b;
	case EXPRESSION_MULTIPLY:
		return a * b;
	case EXPRESSION_DIVIDE:
		return a / b;
	case EXPRESSION_LEAST:
		return isnan(a) || a < b ? a : b;
	default:
		return isnan(a) || a > b ? a : b;
	}
}

double expression_value(const sweep_expression *expression, const double *numbers)
{
	double stack[EXPRESSION_STEPS_MOST] = { 0.0 };
	size_t top = 0; /* numbers on the stack; the parser saw to it that there are enough */
	for (size_t s = 0; s < expression->step_count; s++) {
		const expression_step *step = &expression->steps[s];
		switch (step->operation) {
		case EXPRESSION_NUMBER:
			stack[top++] = step->value;
			break;
		case EXPRESSION_NAMED:
			stack[top++] = numbers[step->index];
			break;
		case EXPRESSION_NEGATE:
			stack[top - 1] = -stack[top - 1];
			break;
		case EXPRESSION_ROOT:
			stack[top - 1] = sqrt(stack[top - 1]);
			break;
		case EXPRESSION_ABSOLUTE:
			stack[top - 1] = fabs(stack[top - 1]);
			break;
		default:
			top--;
			stack[top - 1] = joined(step->operation, stack[top - 1], stack[top]);
		}
	}
	return stack[0];
}
