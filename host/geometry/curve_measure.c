/* How fair a curve is: the definitions of thesis 4.4 that can be computed, Letcher 3.3. */
#include "geometry/curve.h"
#include "geometry/gauss.h"

#include <math.h>
#include <string.h>

enum {
	PIECE_SAMPLES = 33, /* both ends of a piece included */
	GAUSS_POINTS = 8,
	EVALUATION_BUDGET = 400000, /* of the integrals, beyond two rounds a piece */
};

static const double left_part = 1e-9;      /* of a piece: so far before its end its end is taken */
static const double integral_part = 1e-10; /* accuracy of the integrals */
static const double straight_part = 1e-9;  /* curvature times size that counts as none */
static const double sign_part = 1e-9;      /* of the largest curvature that has a sign */
static const double monotone_part = 1e-6;  /* of the curvature's range that breaks monotony */
static const double jump_part = 1e-5;      /* of the largest curvature that counts as a jump */
static const double kink_deg = 1e-3;       /* an angle that counts as a kink */

static const char *const names[] = {
#define BATTEN_CURVE_MEASURE_NAME(name, text) #name,
	BATTEN_CURVE_MEASURE_LIST(BATTEN_CURVE_MEASURE_NAME)
#undef BATTEN_CURVE_MEASURE_NAME
};
static const char *const texts[] = {
#define BATTEN_CURVE_MEASURE_TEXT(name, text) text,
	BATTEN_CURVE_MEASURE_LIST(BATTEN_CURVE_MEASURE_TEXT)
#undef BATTEN_CURVE_MEASURE_TEXT
};

const char *batten_curve_measure_name(size_t i)
{
	return i < BATTEN_CURVE_MEASURE_COUNT ? names[i] : NULL;
}

const char *batten_curve_measure_text(size_t i)
{
	return i < BATTEN_CURVE_MEASURE_COUNT ? texts[i] : NULL;
}

static void evaluate(const batten_curve *curve, double t, batten_curve_point *point)
{
	*point = (batten_curve_point){ .t = t };
	curve_derivatives(curve, t, point->derivative);
	curve_frame(curve, point);
}

/* ------------------------------------------------------------------------------------------------
 * Integrals by the arc length
 * --------------------------------------------------------------------------------------------- */

enum integral { LENGTH, BENDING, VARIATION, INTEGRAL_COUNT };

struct integrals {
	const batten_curve *curve;
	size_t count; /* of the integrals wanted */
	double nodes[GAUSS_POINTS], weights[GAUSS_POINTS];
	double least[INTEGRAL_COUNT]; /* differences that do not matter */
	double sum[INTEGRAL_COUNT];
	size_t budget;
};

static void gauss_sum(const struct integrals *work, double a, double b, double sum[INTEGRAL_COUNT])
{
	double half = 0.5 * (b - a);
	memset(sum, 0, INTEGRAL_COUNT * sizeof *sum);
	for (size_t n = 0; n < GAUSS_POINTS; n++) {
		batten_curve_point point;
		evaluate(work->curve, a + half * (1 + work->nodes[n]), &point);
		double weight = half * work->weights[n] * point.speed;
		sum[LENGTH] += weight;
		sum[BENDING] += weight * point.curvature_per_m * point.curvature_per_m;
		sum[VARIATION] += weight * point.curvature_rate_per_m2 * point.curvature_rate_per_m2;
	}
}

/* Halves [a, b] until both halves add up to what the whole gave. */
static void refine(struct integrals *work, double a, double b, const double whole[INTEGRAL_COUNT],
                   int depth)
{
	double middle = 0.5 * (a + b);
	double left[INTEGRAL_COUNT], right[INTEGRAL_COUNT];
	gauss_sum(work, a, middle, left);
	gauss_sum(work, middle, b, right);
	bool good = true;
	for (size_t k = 0; k < work->count; k++)
		good = good && fabs(left[k] + right[k] - whole[k]) <=
		                   fmax(integral_part * (left[k] + right[k]), work->least[k]);
	if (good || depth == 0 || work->budget < 4 * GAUSS_POINTS) {
		for (size_t k = 0; k < work->count; k++)
			work->sum[k] += left[k] + right[k];
		return;
	}
	work->budget -= 4 * GAUSS_POINTS;
	refine(work, a, middle, left, depth - 1);
	refine(work, middle, b, right, depth - 1);
}

/* Over [a, b], piece by piece; beyond the ends the end pieces go on. */
static void integrate(struct integrals *work, double a, double b)
{
	enum { DEPTH_MOST = 40 };
	const batten_curve *curve = work->curve;
	size_t pieces = curve->break_count - 1;
	double whole[INTEGRAL_COUNT];
	for (int round = 0; round < 2; round++)
		for (size_t i = 0; i < pieces; i++) {
			double from = i == 0 ? a : fmax(a, curve->breaks[i]);
			double to = i + 1 == pieces ? b : fmin(b, curve->breaks[i + 1]);
			if (!(from < to))
				continue;
			gauss_sum(work, from, to, whole);
			/* The first round tells how large they are. */
			for (size_t k = 0; k < work->count && round == 0; k++)
				work->least[k] += 0.01 * integral_part * whole[k];
			if (round == 1)
				refine(work, from, to, whole, DEPTH_MOST);
		}
}

static struct integrals integrals_begin(const batten_curve *curve, size_t count)
{
	struct integrals work = { .curve = curve, .count = count, .budget = EVALUATION_BUDGET };
	gauss_points(GAUSS_POINTS, work.nodes, work.weights);
	for (size_t k = 0; k < INTEGRAL_COUNT; k++)
		work.least[k] = 1e-14 * pow(curve->size, 1.0 - 2.0 * (double)k);
	return work;
}

batten_status batten_curve_length(const batten_curve *curve, double a, double b, double *length_m)
{
	if (!isfinite(a) || !isfinite(b))
		return batten_fail(curve->context, BATTEN_USAGE, "the parameter of a curve is not finite");
	struct integrals work = integrals_begin(curve, 1);
	integrate(&work, fmin(a, b), fmax(a, b));
	*length_m = b < a ? -work.sum[LENGTH] : work.sum[LENGTH];
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Samples
 * --------------------------------------------------------------------------------------------- */

static double curvature_size(const batten_curve *curve, double t, const void *data)
{
	batten_curve_point point;
	(void)data;
	evaluate(curve, t, &point);
	return fabs(point.curvature_per_m);
}

static double curvature_rate_size(const batten_curve *curve, double t, const void *data)
{
	batten_curve_point point;
	(void)data;
	evaluate(curve, t, &point);
	return fabs(point.curvature_rate_per_m2);
}

static double torsion_size(const batten_curve *curve, double t, const void *data)
{
	batten_curve_point point;
	(void)data;
	evaluate(curve, t, &point);
	return fabs(point.torsion_per_m);
}

static double sample_place(const batten_curve *curve, size_t piece, size_t k)
{
	double a = curve->breaks[piece];
	double b = curve->breaks[piece + 1];
	if (k + 1 == PIECE_SAMPLES)
		return piece + 2 == curve->break_count ? b : b - left_part * (b - a);
	return a + (b - a) * ((double)k / (PIECE_SAMPLES - 1));
}

/* Largest value over all samples, then about the largest of them. */
static double largest_of(const batten_curve *curve, curve_value_at *value)
{
	double best = -1;
	size_t piece = 0;
	size_t k = 0;
	for (size_t i = 0; i + 1 < curve->break_count; i++)
		for (size_t j = 0; j < PIECE_SAMPLES; j++) {
			double here = value(curve, sample_place(curve, i, j), NULL);
			if (here > best) {
				best = here;
				piece = i;
				k = j;
			}
		}
	double low = sample_place(curve, piece, k > 0 ? k - 1 : k);
	double high = sample_place(curve, piece, k + 1 < PIECE_SAMPLES ? k + 1 : k);
	double t = curve_find_largest(curve, low, high, value, NULL);
	return fmax(best, value(curve, t, NULL));
}

/* Sign changes of values above the noise. */
static size_t count_inflections(size_t count, const double *curvature, double largest)
{
	int sign = 0;
	size_t changes = 0;
	for (size_t i = 0; i < count; i++) {
		if (!(fabs(curvature[i]) > sign_part * largest))
			continue;
		int here = curvature[i] > 0 ? 1 : -1;
		changes += sign != 0 && here != sign;
		sign = here;
	}
	return changes;
}

/* Runs of values that rise or fall but for small steps back; one for a constant. */
static size_t count_monotone(size_t count, const double *curvature)
{
	double low = curvature[0], high = curvature[0];
	for (size_t i = 1; i < count; i++) {
		low = fmin(low, curvature[i]);
		high = fmax(high, curvature[i]);
	}
	double step = monotone_part * (high - low);
	size_t pieces = 1;
	int direction = 0;
	low = high = curvature[0];
	for (size_t i = 1; i < count && step > 0; i++) {
		low = fmin(low, curvature[i]);
		high = fmax(high, curvature[i]);
		if (direction <= 0 && curvature[i] > low + step) {
			pieces += direction < 0;
			direction = 1;
			high = curvature[i];
		} else if (direction >= 0 && curvature[i] < high - step) {
			pieces += direction > 0;
			direction = -1;
			low = curvature[i];
		}
	}
	return pieces;
}

/* ------------------------------------------------------------------------------------------------
 * The measures
 * --------------------------------------------------------------------------------------------- */

/* Angle between the tangents and jump of the curvature vector at the inner breaks. */
static void measure_breaks(const batten_curve *curve, batten_curve_measures *out)
{
	const double degrees = 180 / acos(-1.0);
	out->kink_max_deg = out->curvature_jump_per_m = 0;
	for (size_t i = 1; i + 1 < curve->break_count; i++) {
		batten_curve_point before, after;
		double jump = 0, square = 0, cosine = 0;
		evaluate(curve, sample_place(curve, i - 1, PIECE_SAMPLES - 1), &before);
		evaluate(curve, curve->breaks[i], &after);
		for (size_t c = 0; c < 3; c++) {
			double step = after.curvature_per_m * after.normal[c] -
			              before.curvature_per_m * before.normal[c];
			double turn = after.tangent[c] - before.tangent[c];
			jump += step * step;
			square += turn * turn;
			cosine += after.tangent[c] * before.tangent[c];
		}
		if (!before.regular || !after.regular)
			continue;
		/* By the chord of the unit circle: exact for small angles. */
		double chord = fmin(1, 0.5 * sqrt(square));
		double angle = cosine < -0.5 ? acos(fmax(-1, cosine)) : 2 * asin(chord);
		out->kink_max_deg = fmax(out->kink_max_deg, degrees * angle);
		out->curvature_jump_per_m = fmax(out->curvature_jump_per_m, sqrt(jump));
	}
}

static batten_status measure_samples(batten_context *context, const batten_curve *curve,
                                     batten_curve_measures *out)
{
	size_t pieces = curve->break_count - 1;
	double *curvature = batten_allocate(context, pieces, PIECE_SAMPLES * sizeof *curvature);
	if (!curvature)
		return BATTEN_MEMORY;
	size_t count = 0;
	bool regular = true;
	for (size_t i = 0; i < pieces; i++)
		for (size_t k = 0; k < PIECE_SAMPLES; k++) {
			batten_curve_point point;
			evaluate(curve, sample_place(curve, i, k), &point);
			curvature[count++] = point.curvature_per_m;
			regular = regular && point.regular;
		}
	out->curvature_max_per_m = largest_of(curve, curvature_size);
	out->curvature_rate_max_per_m2 = largest_of(curve, curvature_rate_size);
	out->torsion_max_per_m = curve->dimension == 3 ? largest_of(curve, torsion_size) : NAN;
	bool straight = !(out->curvature_max_per_m * curve->size > straight_part);
	out->inflections = curve->dimension == 3 ? NAN
	                   : straight
	                       ? 0
	                       : (double)count_inflections(count, curvature, out->curvature_max_per_m);
	out->monotone_pieces = straight ? 1 : (double)count_monotone(count, curvature);
	if (!regular)
		out->curvature_max_per_m = out->inflections = out->monotone_pieces = NAN;
	batten_release(context, curvature);
	return BATTEN_OK;
}

/* What kinks, jumps and places without a tangent leave undefined. */
static void leave_out_undefined(const batten_curve *curve, batten_curve_measures *out)
{
	double curved = fmax(out->curvature_max_per_m, straight_part / curve->size);
	bool kinked = out->kink_max_deg > kink_deg;
	if (kinked)
		out->curvature_max_per_m = out->curvature_jump_per_m = out->inflections =
			out->monotone_pieces = NAN;
	if (kinked || isnan(out->curvature_max_per_m))
		out->energy_bending_per_m = out->curvature_rate_max_per_m2 = out->torsion_max_per_m = NAN;
	if (isnan(out->energy_bending_per_m) || out->curvature_jump_per_m > jump_part * curved)
		out->energy_mvc_per_m3 = NAN;
}

static batten_status measure_deviation(batten_context *context, const batten_curve *curve,
                                       batten_curve_measures *out)
{
	batten_curve_datum *data = batten_allocate(context, curve->count, sizeof *data);
	if (!data)
		return BATTEN_MEMORY;
	double square = 0;
	batten_curve_data(curve, data);
	for (size_t i = 0; i < curve->count; i++) {
		out->deviation_max_m = fmax(out->deviation_max_m, data[i].deviation_m);
		square += data[i].deviation_m * data[i].deviation_m;
	}
	out->deviation_rms_m = sqrt(square / (double)curve->count);
	batten_release(context, data);
	return BATTEN_OK;
}

batten_status batten_curve_measure(batten_context *context, const batten_curve *curve,
                                   batten_curve_measures *out)
{
	batten_curve_measures measures = { 0 };
	batten_status status = measure_deviation(context, curve, &measures);
	if (status == BATTEN_OK)
		status = measure_samples(context, curve, &measures);
	if (status != BATTEN_OK)
		return status;
	measure_breaks(curve, &measures);
	struct integrals work = integrals_begin(curve, INTEGRAL_COUNT);
	integrate(&work, curve->breaks[0], curve->breaks[curve->break_count - 1]);
	measures.length_m = work.sum[LENGTH];
	measures.energy_bending_per_m = work.sum[BENDING];
	measures.energy_mvc_per_m3 = work.sum[VARIATION];
	leave_out_undefined(curve, &measures);
	*out = measures;
	return BATTEN_OK;
}
