/* Points of a curve as a line file. */
#include "core/file.h"
#include "core/number.h"
#include "geometry/curve.h"

static void write_point(const batten_curve *curve, double t, FILE *stream)
{
	double values[4][3];
	curve_derivatives(curve, t, values);
	for (size_t c = 0; c < curve->dimension; c++) {
		char number[BATTEN_NUMBER_SIZE];
		(void)fprintf(stream, "%s%s", c > 0 ? "," : "", batten_number_write(number, values[0][c]));
	}
	(void)fputc('\n', stream);
}

batten_status batten_curve_write(batten_context *context, const batten_curve *curve, size_t count,
                                 const char *path)
{
	enum { COUNT_MOST = 1000000 };
	batten_file file = { 0 };
	if (count < 2 || count > COUNT_MOST)
		return batten_fail(context, BATTEN_USAGE, "%zu points of a curve, expected 2..%d", count,
		                   COUNT_MOST);
	batten_status status = batten_file_open(context, path, &file);
	if (status != BATTEN_OK)
		return status;
	double first = 0, last = 0;
	batten_curve_range(curve, &first, &last);
	(void)fprintf(file.stream, "# name: %s\n# unit: m\n%s\n", curve->label,
	              curve->dimension == 3 ? "x,y,z" : "x,y");
	for (size_t i = 0; i < count; i++) {
		double part = (double)i / (double)(count - 1);
		write_point(curve, i + 1 == count ? last : first + part * (last - first), file.stream);
	}
	return batten_file_commit(context, &file);
}
