#include "batch/newton.h"

#include "core/band.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Numbers of the largest band that is factored: half a gigabyte. */
#define BAND_LIMIT ((size_t)1 << 26)

/* What a Hessian that is not positive definite is raised by, as a part of the largest number of its diagonal. */
#define LEAST_RAISE 1e-4
#define MORE_RAISE 8.0
enum { RAISES = 10 };

static void say(batten_certificate *out, const char *message)
{
	(void)snprintf(out->message, sizeof out->message, "%s", message);
}

batten_certificate newton_refused(const char *fault)
{
	batten_certificate refused = { .objective = NAN,
		                           .fairness = NAN,
		                           .closeness_m4 = NAN,
		                           .gradient_per_m = NAN,
		                           .gap_estimate = NAN };
	say(&refused, fault);
	return refused;
}

bool newton_holds(double below, double above, double near, double slope, double *step, double *last)
{
	const bool down = below <= near && slope >= 0.0;
	const bool up = above <= near && slope <= 0.0;
	if (!down && !up)
		return false;
	*step = down ? below : -above;
	*last += slope * *step;
	return true;
}

size_t newton_reach(size_t count, const size_t *places, const size_t *number)
{
	size_t least = NEWTON_HELD;
	size_t most = 0;
	for (size_t n = 0; n < count; n++) {
		const size_t unknown = number[places[n]];
		if (unknown == NEWTON_HELD)
			continue;
		least = unknown < least ? unknown : least;
		most = unknown > most ? unknown : most;
	}
	return least == NEWTON_HELD ? 0 : most - least;
}

/* S w of a term: what each of its second derivatives meets at a place. */
static void meet(const newton_term *term, size_t n, double by[JET_VARIABLES_MOST])
{
	for (int i = 0, at = 0; i < term->derivatives->variables; i++) {
		by[i] = 0.0;
		for (int j = 0; j <= i; j++, at++) {
			const double second = term->derivatives->second[at];
			by[j] += term->weight[(size_t)i * term->stride + n] * second;
			if (i != j)
				by[i] += term->weight[(size_t)j * term->stride + n] * second;
		}
	}
}

void newton_add_term(const newton_term *term, const size_t *number, size_t width, double *band)
{
	for (size_t n = 0; n < term->count; n++) {
		const size_t row = number[term->places[n]];
		double by[JET_VARIABLES_MOST];
		if (row == NEWTON_HELD)
			continue;
		meet(term, n, by);
		for (size_t m = 0; m < term->count; m++) {
			const size_t column = number[term->places[m]];
			if (column == NEWTON_HELD || column > row)
				continue;
			double sum = 0.0;
			for (int v = 0; v < term->derivatives->variables; v++)
				sum += by[v] * term->weight[(size_t)v * term->stride + m];
			band[row * (width + 1) + width - (row - column)] += sum;
		}
	}
}

void newton_answer(const newton_factor *factor, const double *slopes, double *ways)
{
	const size_t *number = factor->number;
	for (size_t u = 0; u < factor->count; u++)
		factor->right[u] = 0.0;
	for (size_t n = 0; n < factor->places; n++)
		if (number[n] != NEWTON_HELD)
			factor->right[number[n]] += slopes[n];
	band_solve(factor->count, factor->width, factor->band, factor->right);
	for (size_t n = 0; n < factor->places; n++)
		ways[n] = number[n] == NEWTON_HELD ? 0.0 : factor->right[number[n]];
}

static void raise_diagonal(size_t count, size_t width, double part, double *band)
{
	double most = 0.0;
	for (size_t n = 0; n < count; n++)
		most = fmax(most, fabs(band[n * (width + 1) + width]));
	for (size_t n = 0; n < count; n++)
		band[n * (width + 1) + width] += part * most;
}

/* Factors H. Where it is not positive definite its diagonal is raised until it is: a step is then downhill, and the
 * shorter the more it is raised (Levenberg's method). Returns how often that was, RAISES where it did not do. */
static int factor_raised(const newton_system *system, size_t width, double *band)
{
	double part = LEAST_RAISE / MORE_RAISE;
	for (int raised = 0; raised < RAISES; raised++) {
		memset(band, 0, system->count * (width + 1) * sizeof *band);
		system->assemble(system->of, width, band);
		if (raised > 0)
			raise_diagonal(system->count, width, part, band);
		if (band_factor(system->count, width, band) == system->count)
			return raised;
		part *= MORE_RAISE;
	}
	return RAISES;
}

/* Turns a step that is the gradient into H^-1 times it. Returns 1/2 g^T H^-1 g; NaN where H is not positive
 * definite: then the step is that of the raised H, or nothing. */
static double decrement(const newton_system *system, size_t width, double *band,
                        const double *gradient, double *step)
{
	const int raised = factor_raised(system, width, band);
	double sum = 0.0;
	if (raised < RAISES)
		band_solve(system->count, width, band, step);
	else
		memset(step, 0, system->count * sizeof *step);
	for (size_t n = 0; n < system->count; n++)
		sum += gradient[n] * step[n];
	return raised == 0 ? 0.5 * sum : NAN;
}

/* gradient, step: by unknown; step is the gradient before. */
static batten_status estimate(const newton_system *system, const double *gradient, double *step,
                              batten_certificate *out)
{
	batten_context *context = system->context;
	const size_t count = system->count;
	/* An objective of 0 cannot fall. */
	const double scale = out->objective > 0.0 ? 1.0 / out->objective : 0.0;
	if (count == 0) {
		out->gap_estimate = system->last * scale;
		return BATTEN_OK;
	}
	const size_t width = system->width(system->of);
	if (width + 1 > BAND_LIMIT / count) {
		memset(step, 0, count * sizeof *step);
		say(out, "the factor of the Hessian would be too large");
		return BATTEN_OK;
	}
	double *band = batten_allocate(context, count, (width + 1) * sizeof *band);
	if (!band)
		return BATTEN_MEMORY;
	out->gap_estimate = (decrement(system, width, band, gradient, step) + system->last) * scale;
	if (isnan(out->gap_estimate))
		say(out, "the Hessian is not positive definite over what is free");
	batten_release(context, band);
	return BATTEN_OK;
}

/* The norm of the gradient over the unknowns, which stand in `gradient` then, then the gap. */
static batten_status judge(const newton_system *system, double *gradient, double *step,
                           batten_certificate *out)
{
	double square = 0.0;
	for (size_t n = 0; n < system->places; n++)
		if (system->number[n] != NEWTON_HELD)
			gradient[system->number[n]] = step[system->number[n]] = system->gradient[n];
	for (size_t n = 0; n < system->count; n++)
		square += gradient[n] * gradient[n];
	out->free_count = system->count;
	out->gradient_per_m = sqrt(square);
	if (!isfinite(out->objective) || !isfinite(square)) {
		say(out, "the objective is not finite");
		return BATTEN_OK;
	}
	const batten_status status = estimate(system, gradient, step, out);
	for (size_t n = 0; n < system->places; n++)
		if (system->number[n] != NEWTON_HELD)
			system->step[n] = step[system->number[n]];
	return status;
}

batten_status newton_judge(const newton_system *system, batten_certificate *out)
{
	batten_context *context = system->context;
	double *gradient = batten_allocate(context, system->count, sizeof *gradient);
	double *step = batten_allocate(context, system->count, sizeof *step);
	const batten_status status = gradient && step ? judge(system, gradient, step, out)
	                                              : BATTEN_MEMORY;
	batten_release(context, gradient);
	batten_release(context, step);
	return status;
}

batten_status newton_polish(const newton_way *way, double gap, double *y, batten_certificate *out)
{
	enum { STEPS = 100, HALVINGS = 30 };
	double *before = batten_allocate(way->context, way->count, sizeof *before);
	batten_status status = before ? way->judge(way->of, y, out) : BATTEN_MEMORY;
	for (unsigned step = 1; step <= STEPS && status == BATTEN_OK && !(out->gap_estimate <= gap);
	     step++) {
		double part = 1.0;
		int halvings = 0;
		memcpy(before, y, way->count * sizeof *before);
		while (halvings < HALVINGS && !(way->go(way->of, before, part, y) < out->objective)) {
			part *= 0.5;
			halvings++;
		}
		if (halvings == HALVINGS) {
			memcpy(y, before, way->count * sizeof *before);
			break;
		}
		status = way->judge(way->of, y, out);
		out->steps = step;
	}
	batten_release(way->context, before);
	return status;
}
