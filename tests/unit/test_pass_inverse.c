/* Inverse fairing of a hull (thesis 6.2) against the oracle: long double, splines by de Boor, places on
 * them by halving, all offsets at once by Gauss. */
#include "oracle/oracle_bspline.h"
#include "unit/pass_fixture.h"

enum { NX = 9, NZ = 7, INNER_X = NX - 2, INNER_Z = NZ - 2, UNKNOWNS = INNER_X * INNER_Z };
enum { KNOTS_MOST = NX + ORACLE_ORDER_MOST };

typedef struct table {
	double x[NX], z[NZ], y[NZ][NX];
} table;

/* Uneven steps, and a chine: second differences of which one in each section is far above the others. */
static table make_table(void)
{
	table t;
	for (int i = 0; i < NX; i++)
		t.x[i] = i + 0.04 * i * i;
	for (int k = 0; k < NZ; k++)
		t.z[k] = 0.3 * k + 0.02 * k * k;
	for (int k = 0; k < NZ; k++)
		for (int i = 0; i < NX; i++) {
			const double chine = 0.7 + 0.02 * i;
			const double above = t.z[k] > chine ? t.z[k] - chine : 0;
			t.y[k][i] = 0.4 + 0.05 * t.x[i] * (13 - t.x[i]) + 2 * (t.z[k] - above) + 0.1 * above +
			            0.01 * ((i * 7919 + k * 104729) % 13);
		}
	return t;
}

/* values[i * step] become those of the curve of order `order` with vertices (along[i], values[i * step]),
 * where its first coordinate is along[i]; the ends stay. */
static void smooth(size_t order, size_t count, const double *along, long double *values,
                   size_t step)
{
	double knots[KNOTS_MOST] = { 0 }, poles[2 * NX];
	const size_t last = count - order + 1;
	for (size_t k = 0; k < count + order; k++)
		knots[k] = k < order ? 0 : k - order + 1 < last ? (double)(k - order + 1) : (double)last;
	/* Long double as the sum of two doubles: the curve is linear in its vertices. */
	long double smoothed[NX] = { 0 };
	for (int part = 0; part < 2; part++) {
		for (size_t i = 0; i < count; i++) {
			const double whole = (double)values[i * step];
			poles[2 * i] = along[i];
			poles[2 * i + 1] = part == 0 ? whole : (double)(values[i * step] - whole);
		}
		const oracle_curve curve = { order, count, 2, knots, poles, NULL };
		for (size_t i = 1; i + 1 < count; i++) {
			long double low = 0, high = knots[count], derivative[ORACLE_ORDERS][3];
			for (int turn = 0; turn < 80; turn++) {
				assert_true(oracle_curve_at(&curve, (low + high) / 2, derivative));
				*(derivative[0][0] < along[i] ? &low : &high) = (low + high) / 2;
			}
			smoothed[i] += derivative[0][1];
		}
	}
	for (size_t i = 1; i + 1 < count; i++)
		values[i * step] = smoothed[i];
}

/* Factors of the second difference at an inner point. */
static void difference(const double *along, long double factors[3])
{
	const long double a = (long double)along[0] - along[-1];
	const long double b = (long double)along[1] - along[0];
	factors[0] = 2 / (a * (a + b));
	factors[2] = 2 / (b * (a + b));
	factors[1] = -factors[0] - factors[2];
}

/* How the field of second differences along x (or z) changes when it is represented; 0 at its ends. */
static void change_of_field(const table *t, bool along_x, const size_t orders[2],
                            long double change[NZ][NX])
{
	const int fx = along_x ? 1 : 0; /* the first number of the field, from either end */
	const int fz = 1 - fx;
	long double given[NZ][NX] = { { 0 } };
	for (int k = fz; k < NZ - fz; k++)
		for (int i = fx; i < NX - fx; i++) {
			long double factors[3];
			difference(along_x ? t->x + i : t->z + k, factors);
			for (int j = -1; j <= 1; j++)
				given[k][i] += factors[j + 1] * t->y[along_x ? k : k + j][along_x ? i + j : i];
		}
	memcpy(change, given, sizeof given);
	for (int turn = 0; turn < 2; turn++) {
		const bool x_now = (turn == 0) == along_x;
		for (int k = fz; x_now && k < NZ - fz; k++)
			smooth(orders[0], (size_t)(NX - 2 * fx), t->x + fx, &change[k][fx], 1);
		for (int i = fx; !x_now && i < NX - fx; i++)
			smooth(orders[1], (size_t)(NZ - 2 * fz), t->z + fz, &change[fz][i], NX);
	}
	for (int k = 0; k < NZ; k++)
		for (int i = 0; i < NX; i++)
			change[k][i] -= given[k][i];
}

static int unknown_at(int k, int i)
{
	const bool inner = k > 0 && k < NZ - 1 && i > 0 && i < NX - 1;
	return inner ? (k - 1) * INNER_X + i - 1 : -1;
}

static void add_equations(const table *t, bool along_x, const long double change[NZ][NX],
                          long double a[UNKNOWNS][UNKNOWNS + 1])
{
	for (int k = 1; k < NZ - 1; k++)
		for (int i = 1; i < NX - 1; i++) {
			const double *along = along_x ? t->x + i : t->z + k;
			const long double scale = ((long double)along[0] - along[-1]) *
			                          ((long double)along[1] - along[0]);
			long double factors[3];
			int at[3];
			difference(along, factors);
			for (int j = 0; j < 3; j++)
				at[j] = along_x ? unknown_at(k, i + j - 1) : unknown_at(k + j - 1, i);
			for (int p = 0; p < 3; p++) {
				for (int q = 0; q < 3 && at[p] >= 0; q++)
					if (at[q] >= 0)
						a[at[p]][at[q]] += scale * factors[p] * scale * factors[q];
				if (at[p] >= 0)
					a[at[p]][UNKNOWNS] += scale * factors[p] * scale * change[k][i];
			}
		}
}

static void solve(long double a[UNKNOWNS][UNKNOWNS + 1], long double *out)
{
	for (int v = 0; v < UNKNOWNS; v++)
		for (int r = 0; r < UNKNOWNS; r++)
			for (int w = UNKNOWNS; r != v && w >= v; w--)
				a[r][w] -= a[r][v] / a[v][v] * a[v][w];
	for (int v = 0; v < UNKNOWNS; v++)
		out[v] = a[v][UNKNOWNS] / a[v][v];
}

static void check(batten_context *context, const table *t, const size_t orders[2])
{
	static long double a[UNKNOWNS][UNKNOWNS + 1];
	long double change[NZ][NX] = { { 0 } }, moved[UNKNOWNS];
	double found[NZ][NX];
	memset(a, 0, sizeof a);
	for (int along_x = 0; along_x < 2; along_x++) {
		change_of_field(t, along_x, orders, change);
		add_equations(t, along_x, change, a);
	}
	solve(a, moved);
	const batten_hull_table hull_table = { "chine", 10, 2, NX, NZ, t->x, t->z, t->y[0], NULL };
	batten_hull *hull = NULL;
	batten_pass *pass = NULL;
	batten_pass_options options;
	batten_pass_options_default(&options);
	options.method = BATTEN_METHOD_INVERSE;
	options.order = (unsigned)orders[0];
	options.order_sections = (unsigned)orders[1];
	options.device = BATTEN_DEVICE_REFERENCE;
	assert_int_equal(batten_hull_create(context, &hull_table, &hull), BATTEN_OK);
	assert_int_equal(batten_pass_create(context, hull, &options, &pass), BATTEN_OK);
	assert_int_equal(batten_pass_batch(context, pass, 1, 1, t->y[0], found[0], NULL), BATTEN_OK);
	double most = 0;
	for (int k = 0; k < NZ; k++)
		for (int i = 0; i < NX; i++) {
			const int n = unknown_at(k, i);
			const double expected = n < 0 ? t->y[k][i] : (double)(t->y[k][i] + moved[n]);
			assert_near(found[k][i], expected, 1e-11, "offset");
			most = fmax(most, fabs(expected - t->y[k][i]));
		}
	assert_true(most > 0.01);
	batten_pass_destroy(pass);
	batten_hull_destroy(hull);
}

static void test_against_oracle(void **state)
{
	const table t = make_table();
	static const size_t orders[][2] = { { 3, 3 }, { 4, 4 }, { 4, 3 }, { 2, 4 }, { 5, 2 } };
	for (size_t n = 0; n < sizeof orders / sizeof orders[0]; n++)
		check(*state, &t, orders[n]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_against_oracle, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
