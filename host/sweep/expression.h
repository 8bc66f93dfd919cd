/* Formulas over named numbers, as the constraints of a plan have them: + - * /, brackets, sqrt(), abs(),
 * min(,) and max(,). By arithmetic that is the same on every machine. */
#ifndef BATTEN_SWEEP_EXPRESSION_H
#define BATTEN_SWEEP_EXPRESSION_H

#include "core/context.h"

enum { EXPRESSION_STEPS_MOST = 256, EXPRESSION_TEXT_MOST = 1000 };

typedef enum expression_operation {
	EXPRESSION_NUMBER, /* pushes value */
	EXPRESSION_NAMED,  /* pushes the number of that index */
	EXPRESSION_ADD,
	EXPRESSION_SUBTRACT,
	EXPRESSION_MULTIPLY,
	EXPRESSION_DIVIDE,
	EXPRESSION_NEGATE,
	EXPRESSION_ROOT,
	EXPRESSION_ABSOLUTE,
	EXPRESSION_LEAST,
	EXPRESSION_MOST,
} expression_operation;

typedef struct expression_step {
	expression_operation operation;
	double value;
	size_t index;
} expression_step;

/* Steps of a stack machine, in the order they are done. */
typedef struct sweep_expression {
	size_t step_count;
	expression_step steps[EXPRESSION_STEPS_MOST];
} sweep_expression;

/* Index of a name of length bytes, or SIZE_MAX. */
typedef size_t (*expression_lookup)(const char *name, size_t length, const void *user);

/* Why a text is no expression: where, and what was expected. */
typedef struct expression_fault {
	size_t at; /* byte of the text, from 0 */
	const char *expected;
} expression_fault;

/* False, with the fault, for what is no expression. */
bool expression_parse(const char *text, expression_lookup lookup, const void *user,
                      sweep_expression *out, expression_fault *fault);

/* Its value with these numbers; NaN where one of those it takes is NaN, a division by 0 as IEEE has it. */
double expression_value(const sweep_expression *expression, const double *numbers);

#endif
