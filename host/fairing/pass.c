/* batten_pass: one iteration of forward or inverse fairing, made ready for a topology. */
#include "fairing/pass.h"

#include "batch/pass_batch.h"
#include "fairing/pass_forward.h"

#include <math.h>
#include <string.h>

enum { VERTICES_OF_FIT = 8 }; /* no order is above */

struct batten_pass {
	batten_context *context;
	batten_pass_options options;
	pass_program_numbers program;
	batten_pass_facts facts;
};

static const struct {
	const char *word, *text;
} methods[] = {
#define METHOD_ENTRY(name, word, text) { word, text },
	BATTEN_FAIR_METHOD_LIST(METHOD_ENTRY)
#undef METHOD_ENTRY
};

const char *batten_fair_method_text(size_t method)
{
	return method < BATTEN_FAIR_METHOD_COUNT ? methods[method].word : NULL;
}

const char *batten_fair_method_meaning(size_t method)
{
	return method < BATTEN_FAIR_METHOD_COUNT ? methods[method].text : NULL;
}

void batten_pass_options_default(batten_pass_options *options)
{
	*options = (batten_pass_options){ .struct_size = sizeof *options,
		                              .method = BATTEN_METHOD_FORWARD_APPROXIMATION,
		                              .order = 3,
		                              .device = BATTEN_DEVICE_AUTO,
		                              .precision = BATTEN_F64 };
}

/* Fills in what options leave open. */
static batten_status check_options(batten_context *context, batten_pass_options *o)
{
	if (o->struct_size != sizeof *o)
		return batten_fail(context, BATTEN_USAGE, "pass options of another version of batten");
	if ((int)o->method < BATTEN_METHOD_FORWARD_APPROXIMATION ||
	    (int)o->method > BATTEN_METHOD_INVERSE)
		return batten_fail(context, BATTEN_USAGE,
		                   "method %d: forward-approximation, forward-fit or inverse is expected",
		                   (int)o->method);
	if (o->order_sections == 0)
		o->order_sections = o->order;
	const unsigned orders[] = { o->order, o->order_sections };
	for (size_t d = 0; d < 2; d++)
		if (orders[d] < PASS_ORDER_LEAST || orders[d] > PASS_ORDER_MOST)
			return batten_fail(context, BATTEN_USAGE, "found order %u%s, expected %d to %d",
			                   orders[d], d == 0 ? "" : " of sections", PASS_ORDER_LEAST,
			                   PASS_ORDER_MOST);
	if (o->method == BATTEN_METHOD_FORWARD_APPROXIMATION && o->vertices > 0)
		return batten_fail(context, BATTEN_USAGE,
		                   "found %u vertices: the approximation takes the points as polygon, "
		                   "forward-fit and inverse take vertices",
		                   o->vertices);
	if (o->method == BATTEN_METHOD_FORWARD_FIT && o->vertices == 0)
		o->vertices = VERTICES_OF_FIT;
	const unsigned most = o->method == BATTEN_METHOD_INVERSE && o->order_sections > o->order
	                          ? o->order_sections
	                          : o->order;
	if (o->vertices > 0 && (o->vertices < most || o->vertices > HULL_LINES_MOST))
		return batten_fail(context, BATTEN_USAGE,
		                   "found %u vertices, expected at least the order %u and at most %d",
		                   o->vertices, most, HULL_LINES_MOST);
	return BATTEN_OK;
}

static size_t longest(const pass_lines *lines)
{
	size_t most = 0;
	for (size_t n = 0; n < lines->piece_count; n++)
		if (lines->pieces[n].count > most)
			most = lines->pieces[n].count;
	return most;
}

/* A direction without any line that has points enough is a mistake; single lines that have not are
 * passed over. */
static batten_status check_points(const batten_pass *pass, const pass_lines *lines,
                                  const pass_representation *r, const char *what)
{
	const bool inverse = pass->options.method == BATTEN_METHOD_INVERSE;
	const size_t points = longest(lines);
	const size_t least = pass_least_points(r) + (inverse ? 2 : 0);
	if (points >= least)
		return BATTEN_OK;
	if (points < 3)
		return batten_fail(pass->context, BATTEN_INPUT, "%s has %zu points, expected 3 or more",
		                   what, points);
	if (r->vertices > r->order)
		return batten_fail(pass->context, BATTEN_USAGE,
		                   "order %zu with %zu vertices needs %zu points, %s has %zu", r->order,
		                   r->vertices, least, what, points);
	return batten_fail(pass->context, BATTEN_USAGE, "order %zu needs %zu points, %s has %zu",
	                   r->order, least, what, points);
}

static batten_status write_program(batten_pass *pass, pass_writer *writer, pass_task *task,
                                   bool single)
{
	const batten_pass_options *o = &pass->options;
	task->along = (pass_representation){ .order = o->order, .vertices = o->vertices };
	task->across = (pass_representation){ .order = o->order_sections };
	if (o->method == BATTEN_METHOD_INVERSE)
		task->across.vertices = o->vertices;
	batten_status status = check_points(pass, task->waterlines, &task->along,
	                                    single ? "the line" : "the longest waterline");
	if (status == BATTEN_OK && !single)
		status = check_points(pass, task->sections, &task->across, "the longest section");
	if (status != BATTEN_OK)
		return status;
	if (o->method == BATTEN_METHOD_FORWARD_APPROXIMATION)
		pass_write_approximation(writer, task);
	else if (o->method == BATTEN_METHOD_FORWARD_FIT)
		pass_write_fit(writer, task);
	else
		pass_write_inverse(writer, task);
	return pass_writer_end(writer);
}

/* Takes the program over from the writer. */
static void keep(batten_pass *pass, const pass_writer *writer, const pass_task *task)
{
	pass->program = writer->numbers;
	pass->facts = (batten_pass_facts){ .value_count = task->values,
		                               .line_count = task->faired_count,
		                               .passed_count = task->passed_count,
		                               .term_count = writer->product_count,
		                               .order = pass->options.order,
		                               .order_sections = pass->options.order_sections,
		                               .vertices = pass->options.vertices };
}

static batten_status begin(batten_context *context, const batten_pass_options *options,
                           batten_pass **out)
{
	batten_pass *pass = batten_allocate(context, 1, sizeof *pass);
	if (!pass)
		return BATTEN_MEMORY;
	pass->context = context;
	batten_pass_options_default(&pass->options);
	if (options)
		pass->options = *options;
	const batten_status status = check_options(context, &pass->options);
	if (status != BATTEN_OK)
		batten_pass_destroy(pass);
	else
		*out = pass;
	return status;
}

static batten_status write_hull(batten_pass *pass, const batten_hull *hull)
{
	pass_lines waterlines = { 0 };
	pass_lines sections = { 0 };
	pass_writer writer;
	size_t constants = 0;
	pass_task task = { .waterlines = &waterlines,
		               .sections = &sections,
		               .floored = true,
		               .values = pass_value_count(hull) };
	pass_writer_begin(&writer, pass->context, task.values, pass_constant_count(hull));
	batten_status status = writer.status;
	if (status == BATTEN_OK)
		status = pass_lines_collect(hull, true, writer.numbers.constants, &constants, &waterlines);
	if (status == BATTEN_OK)
		status = pass_lines_collect(hull, false, writer.numbers.constants, &constants, &sections);
	if (status == BATTEN_OK)
		status = write_program(pass, &writer, &task, false);
	pass_lines_release(&waterlines);
	pass_lines_release(&sections);
	keep(pass, &writer, &task);
	return status;
}

batten_status batten_pass_create(batten_context *context, const batten_hull *hull,
                                 const batten_pass_options *options, batten_pass **out)
{
	batten_pass *pass = NULL;
	batten_status status = begin(context, options, &pass);
	if (status != BATTEN_OK)
		return status;
	status = write_hull(pass, hull);
	if (status != BATTEN_OK)
		batten_pass_destroy(pass);
	else
		*out = pass;
	return status;
}

static batten_status check_line(batten_context *context, size_t count, const double *x_m)
{
	if (count < 3 || count > HULL_LINES_MOST)
		return batten_fail(context, BATTEN_USAGE, "a line of %zu points, expected 3 to %d", count,
		                   HULL_LINES_MOST);
	for (size_t i = 0; i < count; i++) {
		if (!(fabs(x_m[i]) <= HULL_LARGEST_M))
			return batten_fail(context, BATTEN_INPUT,
			                   "point %zu: x is %g, expected a length of at most %g m", i + 1,
			                   x_m[i], HULL_LARGEST_M);
		if (i > 0 && !(x_m[i] - x_m[i - 1] >= HULL_SMALLEST_STEP_M))
			return batten_fail(context, BATTEN_INPUT,
			                   "points %zu and %zu: x goes from %g to %g m, expected x to grow: a "
			                   "line is faired as y(x)",
			                   i, i + 1, x_m[i - 1], x_m[i]);
	}
	return BATTEN_OK;
}

batten_status batten_pass_create_line(batten_context *context, size_t count, const double *x_m,
                                      const batten_pass_options *options, batten_pass **out)
{
	batten_pass *pass = NULL;
	batten_status status = check_line(context, count, x_m);
	if (status == BATTEN_OK)
		status = begin(context, options, &pass);
	if (status != BATTEN_OK)
		return status;
	pass_lines line = { 0 };
	pass_lines none = { 0 };
	pass_writer writer;
	pass_task task = { .waterlines = &line, .sections = &none, .values = count };
	pass_writer_begin(&writer, context, count, 0);
	status = writer.status;
	if (status == BATTEN_OK)
		status = pass_lines_single(context, count, x_m, &line);
	if (status == BATTEN_OK)
		status = write_program(pass, &writer, &task, true);
	pass_lines_release(&line);
	keep(pass, &writer, &task);
	if (status != BATTEN_OK)
		batten_pass_destroy(pass);
	else
		*out = pass;
	return status;
}

void batten_pass_destroy(batten_pass *pass)
{
	if (!pass)
		return;
	pass_numbers_release(pass->context, &pass->program);
	batten_release(pass->context, pass);
}

batten_pass_facts batten_pass_describe(const batten_pass *pass)
{
	return pass->facts;
}

void batten_pass_values(const batten_pass *pass, const batten_hull *hull, double *y_m)
{
	(void)pass;
	const size_t nodes = hull_node_count(hull);
	memcpy(y_m, hull->y_m, nodes * sizeof *y_m);
	for (size_t e = 0; e < hull->end_count; e++)
		y_m[nodes + e] = hull->ends[e].y_m;
}

void pass_put_values(const double *y_m, batten_hull *hull)
{
	const size_t nodes = hull_node_count(hull);
	for (size_t n = 0; n < nodes; n++)
		if (hull->nodes[n] == BATTEN_NODE_GIVEN)
			hull->y_m[n] = y_m[n];
	for (size_t e = 0; e < hull->end_count; e++)
		hull->ends[e].y_m = y_m[nodes + e];
}

/* Names the first number that is no length, if any hull has one. */
static batten_status check_numbers(const pass_plan *plan)
{
	const size_t values = pass_plan_values(plan);
	for (size_t h = 0; h < plan->count; h++)
		for (size_t n = 0; plan->refused[h] && n < values; n++)
			if (!(fabs(plan->y_m[h * values + n]) <= HULL_LARGEST_M))
				return batten_fail(plan->context, BATTEN_USAGE,
				                   "number %zu of hull %zu is %g, expected at most %g m", n, h,
				                   plan->y_m[h * values + n], HULL_LARGEST_M);
	return BATTEN_OK;
}

batten_status batten_pass_batch(batten_context *context, const batten_pass *pass, size_t count,
                                unsigned iterations, const double *y_m, double *out_m,
                                batten_run *run)
{
	if (iterations < 1 || iterations > BATTEN_ITERATIONS_MOST)
		return batten_fail(context, BATTEN_USAGE, "found %u iterations, expected 1 to %d",
		                   iterations, BATTEN_ITERATIONS_MOST);
	int32_t *refused = batten_allocate(context, count, sizeof *refused);
	if (!refused)
		return BATTEN_MEMORY;
	const pass_plan plan = { .context = context,
		                     .program = &pass->program,
		                     .iterations = iterations,
		                     .device = pass->options.device,
		                     .precision = pass->options.precision,
		                     .lanes = pass->options.lanes,
		                     .work_group = pass->options.work_group,
		                     .count = count,
		                     .y_m = y_m,
		                     .out_m = out_m,
		                     .refused = refused };
	batten_status status = pass_batch_run(&plan, run);
	if (status == BATTEN_OK)
		status = check_numbers(&plan);
	batten_release(context, refused);
	return status;
}
