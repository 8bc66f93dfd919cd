#include "fairing/pass_system.h"

#include <math.h>
#include <string.h>

#define PIVOT_PART 1e-14

batten_status pass_system_create(batten_context *context, size_t count, const size_t *first,
                                 pass_system *out)
{
	pass_system s = { .context = context, .count = count };
	s.first = batten_allocate(context, count, sizeof *s.first);
	s.start = batten_allocate(context, count + 1, sizeof *s.start);
	if (!s.first || !s.start) {
		pass_system_release(&s);
		return BATTEN_MEMORY;
	}
	for (size_t i = 0; i < count; i++) {
		s.first[i] = first[i];
		s.start[i + 1] = s.start[i] + (i - first[i] + 1);
	}
	s.values = batten_allocate(context, s.start[count], sizeof *s.values);
	if (!s.values) {
		pass_system_release(&s);
		return BATTEN_MEMORY;
	}
	*out = s;
	return BATTEN_OK;
}

void pass_system_release(pass_system *system)
{
	if (system->context) {
		batten_release(system->context, system->first);
		batten_release(system->context, system->start);
		batten_release(system->context, system->values);
	}
	*system = (pass_system){ 0 };
}

static double *place(const pass_system *s, size_t i, size_t j)
{
	return &s->values[s->start[i] + j - s->first[i]];
}

void pass_system_add(pass_system *system, size_t i, size_t j, double value)
{
	*place(system, i > j ? i : j, i > j ? j : i) += value;
}

bool pass_system_factor(pass_system *system)
{
	for (size_t i = 0; i < system->count; i++)
		for (size_t j = system->first[i]; j <= i; j++) {
			const size_t begin = system->first[j] > system->first[i] ? system->first[j]
			                                                         : system->first[i];
			const double given = *place(system, i, j);
			double sum = given;
			for (size_t q = begin; q < j; q++)
				sum -= *place(system, i, q) * *place(system, j, q);
			if (j < i)
				*place(system, i, j) = sum / *place(system, j, j);
			else if (sum > PIVOT_PART * given)
				*place(system, i, i) = sqrt(sum);
			else
				return false;
		}
	return true;
}

/* For each column the last row that reaches back to it. */
static size_t *last_rows(const pass_system *s)
{
	size_t *last = batten_allocate(s->context, s->count, sizeof *last);
	for (size_t i = 0; last && i < s->count; i++)
		for (size_t j = s->first[i]; j <= i; j++)
			last[j] = i;
	return last;
}

void pass_system_write(const pass_system *system, pass_writer *writer, const size_t *right)
{
	size_t *last = last_rows(system);
	if (!last) {
		writer->status = BATTEN_MEMORY;
		return;
	}
	pass_operation(writer, PASS_ROWS_IN_ORDER);
	for (size_t i = 0; i < system->count; i++) {
		const double scale = 1.0 / *place(system, i, i);
		pass_term(writer, right[i], scale);
		for (size_t j = system->first[i]; j < i; j++)
			if (*place(system, i, j) != 0.0)
				pass_term(writer, right[j], -*place(system, i, j) * scale);
		pass_row(writer, right[i]);
	}
	for (size_t i = system->count; i-- > 0;) {
		const double scale = 1.0 / *place(system, i, i);
		pass_term(writer, right[i], scale);
		for (size_t j = i + 1; j <= last[i]; j++)
			if (system->first[j] <= i && *place(system, j, i) != 0.0)
				pass_term(writer, right[j], -*place(system, j, i) * scale);
		pass_row(writer, right[i]);
	}
	batten_release(system->context, last);
}
