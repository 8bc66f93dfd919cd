#include "fairing/kept_state.h"

#include <math.h>
#include <string.h>

/* The part of a tolerance that is aimed at, and the least that is taken, where a measure lies at the end of
 * it. */
#define AIM 0.95
#define AT_END 0.9

bool kept_judge(kept_state *t)
{
	bool good = true;
	for (size_t i = 0; i < t->count; i++) {
		if (t->side[i] == 0 && fabs(t->value[i]) > 1.0)
			t->side[i] = t->value[i] > 0.0 ? 1 : -1;
		const double held = t->side[i] * t->value[i];
		good = good && (t->side[i] == 0 ? fabs(t->value[i]) <= 1.0 : held >= AT_END && held <= 1.0);
	}
	return good;
}

/* Solves for the held measures by elimination with the largest pivots; false: they hang together. */
static bool solve(const kept_state *t, double *change)
{
	matrix m = t->response;
	double right[BATTEN_KEEP_LIMIT];
	size_t rows[BATTEN_KEEP_LIMIT], count = 0;
	for (size_t i = 0; i < t->count; i++) {
		change[i] = 0.0;
		right[i] = t->value[i] - AIM * t->side[i];
		if (t->side[i] != 0)
			rows[count++] = i;
	}
	size_t columns[BATTEN_KEEP_LIMIT];
	memcpy(columns, rows, sizeof columns);
	for (size_t p = 0; p < count; p++) {
		size_t best = p;
		for (size_t r = p; r < count; r++)
			if (fabs(m.a[rows[r]][columns[p]]) > fabs(m.a[rows[best]][columns[p]]))
				best = r;
		const size_t row = rows[best];
		rows[best] = rows[p];
		rows[p] = row;
		const double pivot = m.a[row][columns[p]];
		if (!(fabs(pivot) > 1e-12 * fabs(t->response.a[row][row])))
			return false;
		for (size_t r = p + 1; r < count; r++) {
			const double part = m.a[rows[r]][columns[p]] / pivot;
			for (size_t c = p; c < count; c++)
				m.a[rows[r]][columns[c]] -= part * m.a[row][columns[c]];
			right[rows[r]] -= part * right[row];
		}
	}
	for (size_t p = count; p-- > 0;) {
		double sum = right[rows[p]];
		for (size_t c = p + 1; c < count; c++)
			sum -= m.a[rows[p]][columns[c]] * change[columns[c]];
		change[columns[p]] = sum / m.a[rows[p]][columns[p]];
	}
	return true;
}

bool kept_choose(kept_state *t, double *change)
{
	for (size_t tries = 0; tries <= t->count; tries++) {
		bool all = true;
		if (!solve(t, change))
			return false;
		for (size_t i = 0; i < t->count; i++)
			if (t->side[i] != 0 && t->side[i] * (t->multiplier[i] + change[i]) < 0.0) {
				t->side[i] = 0;
				all = false;
			}
		for (size_t i = 0; i < t->count; i++)
			if (t->side[i] == 0)
				change[i] = -t->multiplier[i];
		if (all)
			return true;
	}
	return true;
}

void kept_learn(kept_state *t, const double *before, const double *change)
{
	double square = 0.0;
	for (size_t j = 0; j < t->count; j++)
		square += change[j] * change[j] * t->response.a[j][j] * t->response.a[j][j];
	if (!(square > 0.0))
		return;
	for (size_t i = 0; i < t->count; i++) {
		double fell = before[i] - t->value[i];
		for (size_t j = 0; j < t->count; j++)
			fell -= t->response.a[i][j] * change[j];
		for (size_t j = 0; j < t->count; j++)
			t->response.a[i][j] += fell * change[j] * t->response.a[j][j] * t->response.a[j][j] /
			                       square;
	}
}

double kept_rise(const kept_state *t, const double *change)
{
	double sum = 0.0;
	for (size_t i = 0; i < t->count; i++)
		sum += change[i] * (t->value[i] - AIM * t->side[i]);
	return sum;
}

double kept_distance(const kept_state *t, const double *value)
{
	double square = 0.0;
	for (size_t i = 0; i < t->count; i++)
		if (t->side[i] != 0)
			square += (value[i] - AIM * t->side[i]) * (value[i] - AIM * t->side[i]);
	return sqrt(square);
}
