#include "nlopt_net_peer.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

enum { MEMORY = 10, EVALUATIONS = 20000, ATTEMPTS = 30 };
enum {
	COLUMNS = WIGLEY_NET_COLUMNS,
	ROWS = WIGLEY_NET_ROWS,
	POLES = WIGLEY_NET_POLES,
	ORDER = WIGLEY_NET_DEGREE + 1,
	POINTS = WIGLEY_NET_GAUSS,
	LENGTH = POINTS * (COLUMNS - WIGLEY_NET_DEGREE), /* samples along u */
	LINES = POINTS * (ROWS - WIGLEY_NET_DEGREE)      /* samples along v */
};

/* The basis at a sample along one direction, with two derivatives, and its weight in an integral. */
typedef struct place {
	int first; /* of the poles it sees */
	double basis[3][ORDER];
	double weight;
} place;

/* What no pole's y changes at a sample: derivatives of x and z by u, v, uu, uv, vv, the weights of both
 * integrals. */
typedef struct sample {
	double x[5], z[5], fair, close;
} sample;

typedef struct peer {
	place u[LENGTH], v[LINES];
	sample samples[LINES][LENGTH];
	double target[POLES];
	int free[POLES]; /* poles with room */
	unsigned free_count;
	double best_value;
	double y[POLES];
	double *best;
} peer;

/* Values of the basis functions of a degree at t, in the span that begins at knot `span`. */
static void find_basis(int poles, int span, int degree, double t, double values[ORDER])
{
	values[0] = 1.0;
	for (int d = 1; d <= degree; d++) {
		double carried = 0.0;
		for (int r = 0; r < d; r++) {
			const double right = wigley_net_knot(span + r + 1, poles);
			const double left = wigley_net_knot(span + 1 - d + r, poles);
			const double part = values[r] / (right - left);
			values[r] = carried + (right - t) * part;
			carried = (t - left) * part;
		}
		values[d] = carried;
	}
}

/* From the basis of a degree below, whose functions are those of the span, their derivatives `times` more. */
static void raise(int poles, int span, int degree, double values[ORDER])
{
	for (int r = degree; r >= 0; r--) {
		const int i = span - degree + r;
		const double before = r > 0 ? values[r - 1] / (wigley_net_knot(i + degree, poles) -
		                                               wigley_net_knot(i, poles))
		                            : 0.0;
		const double after = r < degree ? values[r] / (wigley_net_knot(i + degree + 1, poles) -
		                                               wigley_net_knot(i + 1, poles))
		                                : 0.0;
		values[r] = degree * (before - after);
	}
}

static void find_places(int poles, place *places)
{
	static const double nodes[POINTS] = { -0.86113631159405258, -0.33998104358485626,
		                                  0.33998104358485626, 0.86113631159405258 };
	static const double weights[POINTS] = { 0.34785484513745386, 0.65214515486254614,
		                                    0.65214515486254614, 0.34785484513745386 };
	for (int span = WIGLEY_NET_DEGREE; span < poles; span++)
		for (int g = 0; g < POINTS; g++) {
			place *at = places++;
			const double begin = wigley_net_knot(span, poles);
			const double half = 0.5 * (wigley_net_knot(span + 1, poles) - begin);
			const double t = begin + half * (1.0 + nodes[g]);
			at->first = span - WIGLEY_NET_DEGREE;
			at->weight = half * weights[g];
			for (int d = 0; d < 3; d++) {
				find_basis(poles, span, WIGLEY_NET_DEGREE - d, t, at->basis[d]);
				for (int degree = WIGLEY_NET_DEGREE - d + 1; degree <= WIGLEY_NET_DEGREE; degree++)
					raise(poles, span, degree, at->basis[d]);
			}
		}
}

/* By u, v, uu, uv, vv of one coordinate of the poles. */
static void differentiate(const place *u, const place *v, const double *poles, double out[5])
{
	static const int by[5][2] = { { 1, 0 }, { 0, 1 }, { 2, 0 }, { 1, 1 }, { 0, 2 } };
	for (int d = 0; d < 5; d++) {
		out[d] = 0.0;
		for (int k = 0; k < ORDER; k++)
			for (int i = 0; i < ORDER; i++)
				out[d] += v->basis[by[d][1]][k] * u->basis[by[d][0]][i] *
				          poles[3 * ((v->first + k) * COLUMNS + u->first + i)];
	}
}

static void open_peer(const wigley_net *w, size_t hull, peer *c)
{
	const batten_net_problem *problem = &w->problems[hull];
	const double *poles = w->poles + hull * 3 * POLES;
	const double h2 = problem->half_beam_m * problem->half_beam_m;
	find_places(COLUMNS, c->u);
	find_places(ROWS, c->v);
	for (int line = 0; line < LINES; line++)
		for (int i = 0; i < LENGTH; i++) {
			sample *s = &c->samples[line][i];
			const double weight = c->u[i].weight * c->v[line].weight;
			differentiate(&c->u[i], &c->v[line], poles, s->x);
			differentiate(&c->u[i], &c->v[line], poles + 2, s->z);
			s->fair = problem->w1 * weight;
			s->close = problem->w2 * weight * fabs(s->x[0] * s->z[1] - s->x[1] * s->z[0]) /
			           (h2 * h2);
		}
	c->free_count = 0;
	for (int n = 0; n < POLES; n++) {
		c->target[n] = c->y[n] = poles[3 * n + 1];
		if (w->lower[n] < w->upper[n])
			c->free[c->free_count++] = n;
	}
}

/* y and its derivatives by u, v, uu, uv, vv at a sample; slopes of an objective by these. */
typedef struct jet {
	double y, d[5];
} jet;

/* Bending energy per du dv, (4 H^2 - 2 K) W, and its slopes: M^2 / W^5 - 2 D / W^3, with l, m, n the second form
 * times W, M = E n - 2 F m + G l, D = l n - m^2. */
static double density_of(const sample *s, const double y[5], double slope[5])
{
	const double *x = s->x;
	const double *z = s->z;
	const double across = x[1] * z[0] - x[0] * z[1];
	const double nx = y[0] * z[1] - y[1] * z[0];
	const double nz = x[0] * y[1] - x[1] * y[0];
	const double e = x[0] * x[0] + y[0] * y[0] + z[0] * z[0];
	const double f = x[0] * x[1] + y[0] * y[1] + z[0] * z[1];
	const double g = x[1] * x[1] + y[1] * y[1] + z[1] * z[1];
	const double l = nx * x[2] + across * y[2] + nz * z[2];
	const double m = nx * x[3] + across * y[3] + nz * z[3];
	const double n = nx * x[4] + across * y[4] + nz * z[4];
	const double inverse = 1.0 / (nx * nx + across * across + nz * nz);
	const double three = inverse * sqrt(inverse);
	const double five = three * inverse;
	const double mean = e * n - 2.0 * f * m + g * l;
	const double gauss = l * n - m * m;
	const double by_mean = 2.0 * mean * five;
	const double by_gauss = -2.0 * three;
	const double by_normal = 2.0 * (3.0 * gauss - 2.5 * mean * mean * inverse) * five;
	const double by_l = by_mean * g + by_gauss * n;
	const double by_m = -2.0 * (by_mean * f + by_gauss * m);
	const double by_n = by_mean * e + by_gauss * l;
	const double by_nx = by_normal * nx + by_l * x[2] + by_m * x[3] + by_n * x[4];
	const double by_nz = by_normal * nz + by_l * z[2] + by_m * z[3] + by_n * z[4];
	slope[0] = z[1] * by_nx - x[1] * by_nz + 2.0 * by_mean * (n * y[0] - m * y[1]);
	slope[1] = x[0] * by_nz - z[0] * by_nx + 2.0 * by_mean * (l * y[1] - m * y[0]);
	slope[2] = by_l * across;
	slope[3] = by_m * across;
	slope[4] = by_n * across;
	return mean * mean * five - 2.0 * gauss * three;
}

/* y less target, and y, with their derivatives along v, of every column of a line. */
typedef struct column {
	double off, d[3];
} column;

static jet jet_at(const place *u, const column *columns)
{
	jet at = { 0 };
	for (int i = 0; i < ORDER; i++) {
		const column *c = &columns[u->first + i];
		at.y += u->basis[0][i] * c->off;
		at.d[0] += u->basis[1][i] * c->d[0];
		at.d[1] += u->basis[0][i] * c->d[1];
		at.d[2] += u->basis[2][i] * c->d[0];
		at.d[3] += u->basis[1][i] * c->d[1];
		at.d[4] += u->basis[0][i] * c->d[2];
	}
	return at;
}

static void add_slopes(const place *u, const jet *by, column *columns)
{
	for (int i = 0; i < ORDER; i++) {
		column *c = &columns[u->first + i];
		c->off += u->basis[0][i] * by->y;
		c->d[0] += u->basis[1][i] * by->d[0] + u->basis[2][i] * by->d[2];
		c->d[1] += u->basis[0][i] * by->d[1] + u->basis[1][i] * by->d[3];
		c->d[2] += u->basis[0][i] * by->d[4];
	}
}

/* One line of samples: sums along v are taken once a column, those along u once a sample. */
static double add_line(const peer *c, int line, const double *y, double *gradient)
{
	column columns[COLUMNS] = { 0 };
	column slopes[COLUMNS] = { 0 };
	const place *v = &c->v[line];
	double sum = 0.0;
	for (int k = 0; k < ORDER; k++)
		for (int i = 0; i < COLUMNS; i++) {
			const int n = (v->first + k) * COLUMNS + i;
			columns[i].off += v->basis[0][k] * (y[n] - c->target[n]);
			for (int d = 0; d < 3; d++)
				columns[i].d[d] += v->basis[d][k] * y[n];
		}
	for (int i = 0; i < LENGTH; i++) {
		const sample *s = &c->samples[line][i];
		const jet at = jet_at(&c->u[i], columns);
		jet by = { .y = 2.0 * s->close * at.y };
		sum += s->close * at.y * at.y + s->fair * density_of(s, at.d, by.d);
		for (int d = 0; d < 5; d++)
			by.d[d] *= s->fair;
		add_slopes(&c->u[i], &by, slopes);
	}
	for (int k = 0; k < ORDER; k++)
		for (int i = 0; i < COLUMNS; i++) {
			const column *by = &slopes[i];
			gradient[(v->first + k) * COLUMNS + i] += v->basis[0][k] * (by->off + by->d[0]) +
			                                          v->basis[1][k] * by->d[1] +
			                                          v->basis[2][k] * by->d[2];
		}
	return sum;
}

static double whole(const peer *c, const double *y, double gradient[POLES])
{
	double sum = 0.0;
	memset(gradient, 0, POLES * sizeof *gradient);
	for (int line = 0; line < LINES; line++)
		sum += add_line(c, line, y, gradient);
	return sum;
}

double nlopt_net_objective(const wigley_net *w, size_t hull, const double *y, double *gradient)
{
	peer c;
	open_peer(w, hull, &c);
	return whole(&c, y, gradient);
}

static double objective_of(unsigned count, const double *point, double *gradient, void *user)
{
	peer *c = user;
	double slopes[POLES];
	for (unsigned n = 0; n < count; n++)
		c->y[c->free[n]] = point[n];
	const double sum = whole(c, c->y, slopes);
	for (unsigned n = 0; gradient && n < count; n++)
		gradient[n] = slopes[c->free[n]];
	if (sum < c->best_value) {
		c->best_value = sum;
		memcpy(c->best, c->y, sizeof c->y);
	}
	return sum;
}

double nlopt_net_search(const wigley_net *w, size_t hull, double stop, double *y)
{
	peer c = { .best_value = HUGE_VAL, .best = y };
	double point[POLES], lower[POLES], upper[POLES];
	open_peer(w, hull, &c);
	for (unsigned n = 0; n < c.free_count; n++) {
		lower[n] = w->lower[c.free[n]];
		upper[n] = w->upper[c.free[n]];
		point[n] = c.y[c.free[n]];
	}
	nlopt_opt search = nlopt_create(NLOPT_LD_LBFGS, c.free_count);
	const bool ok = search && nlopt_set_min_objective(search, objective_of, &c) > 0 &&
	                nlopt_set_lower_bounds(search, lower) > 0 &&
	                nlopt_set_upper_bounds(search, upper) > 0 &&
	                nlopt_set_vector_storage(search, MEMORY) > 0 &&
	                nlopt_set_maxeval(search, EVALUATIONS) > 0 &&
	                nlopt_set_stopval(search, stop) > 0;
	for (int attempt = 0; attempt < ATTEMPTS && ok && !(c.best_value <= stop); attempt++) {
		const double before = c.best_value;
		double value = 0.0;
		/* The best point is kept, whatever its ending. */
		(void)nlopt_optimize(search, point, &value);
		for (unsigned n = 0; n < c.free_count; n++)
			point[n] = y[c.free[n]];
		if (!(c.best_value < before * (1.0 - 1e-14)))
			break;
	}
	nlopt_destroy(search);
	return ok ? c.best_value : (double)NAN;
}
