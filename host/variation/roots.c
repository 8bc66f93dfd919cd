#include "variation/roots.h"

#include <math.h>
#include <string.h>

enum { MOST = ROOTS_NUMBERS_MOST, SAMPLES = 32, CLOSINGS = 100, STEPS = 40, HALVINGS = 16 };
enum { TOUCH_STEPS = 60, SPREAD = 8 };

/* Steps of the derivatives and places that are one, in parts of the box. A function may jump where the
 * search begins (a hull that is not moved at all keeps cells that the least move takes from it), so
 * that a step that leads nowhere is taken again by wider differences. */
#define DIFFERENCE 1e-6
#define SAME_PART 1e-6
static const double differences[] = { DIFFERENCE, 1e-3, 0.03 };
enum { DIFFERENCES = sizeof differences / sizeof differences[0] };

struct search {
	const struct roots_task *task;
	struct roots *out;
};

/* Largest value at a place, infinite where there is none; remembers the best place. */
static batten_status value_at(const struct search *search, const double *at, double *values,
                              double *largest)
{
	const struct roots_task *task = search->task;
	*largest = INFINITY;
	const batten_status status = task->function(task->user, at, values);
	if (status != BATTEN_OK)
		return status == BATTEN_INPUT ? BATTEN_OK : status;
	double most = 0;
	for (size_t i = 0; i < task->count; i++)
		most = isfinite(values[i]) ? fmax(most, fabs(values[i])) : INFINITY;
	*largest = most;
	if (most < search->out->off) {
		search->out->off = most;
		memcpy(search->out->nearest, at, task->count * sizeof *at);
	}
	return BATTEN_OK;
}

static double distance(const struct roots_task *task, const double *a, const double *b)
{
	double most = 0;
	for (size_t i = 0; i < task->count; i++)
		most = fmax(most, fabs(a[i] - b[i]) / (task->most[i] - task->least[i]));
	return most;
}

/* Puts a root in its place by distance from the start, unless it is known. */
static void keep(const struct search *search, const double *at)
{
	const struct roots_task *task = search->task;
	struct roots *out = search->out;
	for (size_t i = 0; i < out->count; i++)
		if (distance(task, out->at[i], at) <= SAME_PART)
			return;
	size_t place = out->count < ROOTS_MOST ? out->count++ : ROOTS_MOST - 1;
	const double far = distance(task, at, task->start);
	while (place > 0 && distance(task, out->at[place - 1], task->start) > far) {
		memcpy(out->at[place], out->at[place - 1], sizeof out->at[place]);
		place--;
	}
	memcpy(out->at[place], at, task->count * sizeof *at);
}

/* ------------------------------------------------------------------------------------------------
 * One number
 * --------------------------------------------------------------------------------------------- */

struct sample {
	double at, value;
	bool good;
};

static batten_status sample_at(const struct search *search, double at, struct sample *out)
{
	double largest = 0;
	*out = (struct sample){ .at = at };
	const batten_status status = value_at(search, &at, &out->value, &largest);
	out->good = isfinite(largest);
	return status;
}

/* The next place within a bracket: Newton's, or halfway where that leads out of it. */
static batten_status next_place(const struct search *search, const struct sample *here, double from,
                                double to, double *out)
{
	const struct roots_task *task = search->task;
	const double range = task->most[0] - task->least[0];
	const double beside = here->at + (here->at < 0.5 * (from + to) ? 1 : -1) * DIFFERENCE * range;
	struct sample other;
	const batten_status status = sample_at(search, beside, &other);
	*out = here->at - here->value * (beside - here->at) / (other.value - here->value);
	if (!other.good || !(*out > from && *out < to))
		*out = 0.5 * (from + to);
	return status;
}

static batten_status close_bracket(const struct search *search, struct sample low,
                                   struct sample high)
{
	const double smallest = 1e-15 * (search->task->most[0] - search->task->least[0]);
	struct sample here = fabs(low.value) < fabs(high.value) ? low : high;
	double width = high.at - low.at;
	batten_status status = BATTEN_OK;
	for (int k = 0; k < CLOSINGS && high.at - low.at > smallest; k++) {
		if (fabs(here.value) <= search->task->tolerance)
			break;
		double next = 0.5 * (low.at + high.at);
		/* a bracket that hardly shrinks under Newton's steps is halved */
		if (k % 3 != 2 || high.at - low.at <= 0.5 * width)
			status = next_place(search, &here, low.at, high.at, &next);
		if (k % 3 == 2)
			width = high.at - low.at;
		if (status == BATTEN_OK)
			status = sample_at(search, next, &here);
		if (status != BATTEN_OK || !here.good)
			return status;
		*((here.value < 0) == (low.value < 0) ? &low : &high) = here;
	}
	if (fabs(here.value) <= search->task->tolerance)
		keep(search, &here.at);
	return status;
}

/* Between three places of one sign the middle one is nearest to 0: does the curve touch it? */
static batten_status look_for_touch(const struct search *search, double from, double to)
{
	const double golden = 0.5 * (sqrt(5) - 1);
	struct sample a, b = { .good = false };
	batten_status status = sample_at(search, to - golden * (to - from), &a);
	if (status == BATTEN_OK)
		status = sample_at(search, from + golden * (to - from), &b);
	for (int k = 0; k < TOUCH_STEPS && status == BATTEN_OK && a.good && b.good; k++) {
		if ((a.value < 0) != (b.value < 0)) /* two roots after all */
			return close_bracket(search, a, b);
		if (fabs(a.value) < fabs(b.value)) {
			to = b.at;
			b = a;
			status = sample_at(search, to - golden * (to - from), &a);
		} else {
			from = a.at;
			a = b;
			status = sample_at(search, from + golden * (to - from), &b);
		}
	}
	const struct sample *best = fabs(a.value) < fabs(b.value) ? &a : &b;
	if (status == BATTEN_OK && best->good && fabs(best->value) <= search->task->tolerance)
		keep(search, &best->at);
	return status;
}

static batten_status find_one(const struct search *search)
{
	const struct roots_task *task = search->task;
	struct sample samples[SAMPLES + 2];
	batten_status status = BATTEN_OK;
	size_t count = 0;
	bool started = false;
	for (size_t i = 0; i <= SAMPLES && status == BATTEN_OK; i++) {
		const double part = (double)i / SAMPLES;
		const double at = (1 - part) * task->least[0] + part * task->most[0];
		if (!started && at >= task->start[0]) {
			started = true;
			status = sample_at(search, task->start[0], &samples[count++]);
			if (!(at > task->start[0]))
				continue;
		}
		if (status == BATTEN_OK)
			status = sample_at(search, at, &samples[count++]);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		const struct sample *here = &samples[i], *next = here + 1;
		if (!here->good)
			continue;
		if (fabs(here->value) <= task->tolerance)
			keep(search, &here->at);
		else if (i + 1 < count && next->good && fabs(next->value) > task->tolerance &&
		         (here->value < 0) != (next->value < 0))
			status = close_bracket(search, *here, *next);
		else if (i > 0 && i + 1 < count && next->good && (here - 1)->good &&
		         fabs(here->value) <= fabs(next->value) &&
		         fabs(here->value) <= fabs((here - 1)->value) &&
		         (here->value < 0) == (next->value < 0) &&
		         (here->value < 0) == ((here - 1)->value < 0))
			status = look_for_touch(search, (here - 1)->at, next->at);
	}
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Several numbers
 * --------------------------------------------------------------------------------------------- */

/* Solves by elimination with pivoting, in place; false where the matrix is singular. */
static bool eliminate(size_t n, double matrix[MOST][MOST], double right[MOST])
{
	for (size_t c = 0; c < n; c++) {
		size_t pivot = c;
		for (size_t r = c + 1; r < n; r++)
			if (fabs(matrix[r][c]) > fabs(matrix[pivot][c]))
				pivot = r;
		if (!(fabs(matrix[pivot][c]) > 1e-12))
			return false;
		for (size_t k = 0; k < n; k++) {
			const double kept = matrix[c][k];
			matrix[c][k] = matrix[pivot][k];
			matrix[pivot][k] = kept;
		}
		const double kept = right[c];
		right[c] = right[pivot];
		right[pivot] = kept;
		for (size_t r = c + 1; r < n; r++) {
			const double factor = matrix[r][c] / matrix[c][c];
			for (size_t k = c; k < n; k++)
				matrix[r][k] -= factor * matrix[c][k];
			right[r] -= factor * right[c];
		}
	}
	for (size_t c = n; c-- > 0;) {
		for (size_t k = c + 1; k < n; k++)
			right[c] -= matrix[c][k] * right[k];
		right[c] /= matrix[c][c];
	}
	return true;
}

/* Derivatives by parts of the box, each towards the side that has room; *good false without. */
static batten_status differentiate(const struct search *search, const double *at,
                                   const double *values, double difference,
                                   double matrix[MOST][MOST], bool *good)
{
	const struct roots_task *task = search->task;
	*good = true;
	for (size_t c = 0; c < task->count && *good; c++) {
		double beside[MOST], other[MOST] = { 0 }, largest = INFINITY;
		const double range = task->most[c] - task->least[c];
		const double inward = at[c] - task->least[c] < 0.5 * range ? difference : -difference;
		for (int side = 0; side < 2 && !isfinite(largest); side++) {
			const double part = side == 0 ? inward : -inward;
			memcpy(beside, at, task->count * sizeof *beside);
			beside[c] += part * range;
			const batten_status status = value_at(search, beside, other, &largest);
			if (status != BATTEN_OK)
				return status;
			for (size_t r = 0; r < task->count; r++)
				matrix[r][c] = (other[r] - values[r]) / part;
		}
		*good = isfinite(largest);
	}
	return BATTEN_OK;
}

static double squares(size_t n, const double *values)
{
	double sum = 0;
	for (size_t i = 0; i < n; i++)
		sum += values[i] * values[i];
	return sum;
}

/* Along a step, by parts of the box, halved until the values fall; *moved false where they do not. */
static batten_status advance(const struct search *search, const double *step, double *at,
                             double *values, double *largest, bool *moved)
{
	const struct roots_task *task = search->task;
	const double before = squares(task->count, values);
	*moved = false;
	for (int k = 0; k < HALVINGS && !*moved; k++) {
		const double part = ldexp(1, -k);
		double next[MOST], found[MOST] = { 0 }, size = INFINITY;
		for (size_t i = 0; i < task->count; i++)
			next[i] = fmin(
				fmax(at[i] - part * step[i] * (task->most[i] - task->least[i]), task->least[i]),
				task->most[i]);
		const batten_status status = value_at(search, next, found, &size);
		if (status != BATTEN_OK)
			return status;
		if (!isfinite(size) || !(squares(task->count, found) < before))
			continue;
		memcpy(at, next, task->count * sizeof *at);
		memcpy(values, found, task->count * sizeof *values);
		*largest = size;
		*moved = true;
	}
	return BATTEN_OK;
}

/* One step by derivatives of one width; *moved false where it leads nowhere. */
static batten_status step_by(const struct search *search, double difference, double *at,
                             double *values, double *largest, bool *moved)
{
	double matrix[MOST][MOST] = { { 0 } }, step[MOST] = { 0 };
	memcpy(step, values, search->task->count * sizeof *step);
	batten_status status = differentiate(search, at, values, difference, matrix, moved);
	if (status == BATTEN_OK && *moved)
		*moved = eliminate(search->task->count, matrix, step);
	if (status == BATTEN_OK && *moved)
		status = advance(search, step, at, values, largest, moved);
	return status;
}

static batten_status descend(const struct search *search, const double *from)
{
	const struct roots_task *task = search->task;
	double at[MOST], values[MOST] = { 0 }, largest = INFINITY;
	memcpy(at, from, task->count * sizeof *at);
	batten_status status = value_at(search, at, values, &largest);
	bool moved = isfinite(largest);
	for (int k = 0; k < STEPS && status == BATTEN_OK && moved && largest > task->tolerance; k++) {
		moved = false;
		for (size_t i = 0; i < DIFFERENCES && status == BATTEN_OK && !moved; i++)
			status = step_by(search, differences[i], at, values, &largest, &moved);
	}
	if (status == BATTEN_OK && largest <= task->tolerance)
		keep(search, at);
	return status;
}

/* Number i of a sequence that fills 0..1 evenly (J. H. Halton, Numer. Math. 2, 1960). */
static double spread(unsigned i, unsigned base)
{
	double value = 0, part = 1;
	for (; i > 0; i /= base) {
		part /= base;
		value += part * (i % base);
	}
	return value;
}

static batten_status find_several(const struct search *search)
{
	static const unsigned primes[MOST] = { 2, 3, 5, 7, 11, 13, 17, 19 };
	const struct roots_task *task = search->task;
	batten_status status = descend(search, task->start);
	double from[MOST];
	for (size_t i = 0; i < 2 * task->count && status == BATTEN_OK; i++) {
		memcpy(from, task->start, task->count * sizeof *from);
		const size_t c = i / 2;
		from[c] = 0.5 * (from[c] + (i % 2 ? task->most[c] : task->least[c]));
		status = descend(search, from);
	}
	for (unsigned i = 1; i <= SPREAD && status == BATTEN_OK; i++) {
		for (size_t c = 0; c < task->count; c++)
			from[c] = task->least[c] + spread(i, primes[c]) * (task->most[c] - task->least[c]);
		status = descend(search, from);
	}
	return status;
}

batten_status roots_find(const struct roots_task *task, struct roots *out)
{
	*out = (struct roots){ .off = INFINITY };
	const struct search search = { task, out };
	return task->count == 1 ? find_one(&search) : find_several(&search);
}
