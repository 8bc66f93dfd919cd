#include "batch/newton.h"

#include "core/band.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Numbers of the largest band that is factored: half a gigabyte. */
#define BAND_LIMIT ((size_t)1 << 26)

static void say(batten_certificate *out, const char *message)
{
	(void)snprintf(out->message, sizeof out->message, "%s", message);
}

batten_certificate newton_refused(const char *fault)
{
	batten_certificate refused = {
		.objective = NAN, .fairness = NAN, .gradient_per_m = NAN, .gap_estimate = NAN
	};
	say(&refused, fault);
	return refused;
}

/* 1/2 g^T H^-1 g; NaN where H is not positive definite. */
static double decrement(const newton_system *system, double *band, const double *gradient,
                        double *step)
{
	double sum = 0.0;
	if (band_factor(system->count, system->width, band) < system->count)
		return NAN;
	memcpy(step, gradient, system->count * sizeof *step);
	band_solve(system->count, system->width, band, step);
	for (size_t n = 0; n < system->count; n++)
		sum += gradient[n] * step[n];
	return 0.5 * sum;
}

batten_status newton_estimate(const newton_system *system, double *step, batten_certificate *out)
{
	batten_context *context = system->context;
	/* An objective of 0 cannot fall. */
	const double scale = out->objective > 0.0 ? 1.0 / out->objective : 0.0;
	if (system->count == 0) {
		out->gap_estimate = system->last * scale;
		return BATTEN_OK;
	}
	if (system->width + 1 > BAND_LIMIT / system->count) {
		say(out, "the factor of the Hessian would be too large");
		return BATTEN_OK;
	}
	double *band = batten_allocate(context, system->count, (system->width + 1) * sizeof *band);
	double *gradient = batten_allocate(context, system->count, sizeof *gradient);
	const batten_status status = band && gradient ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		memcpy(gradient, step, system->count * sizeof *gradient);
		system->assemble(system->of, system->width, band);
		out->gap_estimate = (decrement(system, band, gradient, step) + system->last) * scale;
		if (isnan(out->gap_estimate))
			say(out, "the Hessian is not positive definite over what is free");
	}
	batten_release(context, band);
	batten_release(context, gradient);
	return status;
}

batten_status newton_polish(const newton_way *way, double gap, double *y, batten_certificate *out)
{
	enum { STEPS = 100, HALVINGS = 30 };
	double *before = batten_allocate(way->context, way->count, sizeof *before);
	batten_status status = before ? way->judge(way->of, y, out) : BATTEN_MEMORY;
	for (unsigned step = 1; step <= STEPS && status == BATTEN_OK && out->gap_estimate > gap;
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
