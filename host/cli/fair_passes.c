/* The iterations of a forward or inverse method: the rows of the thesis's tables 5.1 to 5.5. */
#include "fair_passes.h"

#include "json_out.h"

static const char *const stops[] = { "iterations", "max-cn", "least-gain" };

static const struct {
	const char *name;
	size_t offset;
} columns[] = {
	{ "beam_m", offsetof(batten_fairing_row, beam_m) },
	{ "cwp", offsetof(batten_fairing_row, cwp) },
	{ "cb", offsetof(batten_fairing_row, cb) },
	{ "cm", offsetof(batten_fairing_row, cm) },
	{ "lcb_pct_lbp_fwd", offsetof(batten_fairing_row, lcb_pct_lbp_fwd) },
	{ "volume_m3", offsetof(batten_fairing_row, volume_m3) },
	{ "fn_per_m2", offsetof(batten_fairing_row, fn_per_m2) },
	{ "cn_pct", offsetof(batten_fairing_row, cn_pct) },
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

static double cell(const batten_fairing_row *row, size_t column)
{
	return *(const double *)((const char *)row + columns[column].offset);
}

void fair_passes_print(const batten_fairing *fairing, FILE *stream)
{
	enum { SHOWN_MOST = 40 };
	const batten_fairing_row *rows = batten_fairing_rows(fairing);
	const size_t count = batten_fairing_row_count(fairing);
	const batten_fairing_pass pass = batten_fairing_describe_pass(fairing);
	(void)fprintf(stream, "\n%-9s", "iteration");
	for (size_t c = 0; c < COLUMN_COUNT; c++)
		(void)fprintf(stream, " %*s", c == 4 ? 15 : 11, columns[c].name);
	for (size_t r = 0; r < count; r++) {
		/* Of a long series its beginning and its end; report.json has all. */
		if (r == SHOWN_MOST / 2 && count > SHOWN_MOST) {
			(void)fprintf(stream, "\n      ...");
			r = count - SHOWN_MOST / 2;
		}
		(void)fprintf(stream, rows[r].restored ? "\nrestored " : "\n%9u", rows[r].iteration);
		for (size_t c = 0; c < COLUMN_COUNT; c++)
			(void)fprintf(stream, " %*.6g", c == 4 ? 15 : 11, cell(&rows[r], c));
	}
	(void)fprintf(stream,
	              "\n\n%zu lines faired, %zu passed over; ended by %s; %.2f ms CPU on %s; cn_pct "
	              "against the hull of row 0\n",
	              pass.facts.line_count, pass.facts.passed_count, stops[pass.stop],
	              1e3 * pass.cpu_seconds, batten_fairing_run(fairing)->device);
}

json_t *fair_passes_json(const fair_job *job)
{
	if (!fair_is_pass(&job->options))
		return json_null();
	const batten_fairing_row *rows = batten_fairing_rows(job->fairing);
	const batten_fairing_pass pass = batten_fairing_describe_pass(job->fairing);
	const batten_run *run = batten_fairing_run(job->fairing);
	json_t *list = json_array();
	for (size_t r = 0; r < batten_fairing_row_count(job->fairing); r++) {
		json_t *row = json_object();
		(void)json_object_set_new(row, "iteration", json_integer((json_int_t)rows[r].iteration));
		(void)json_object_set_new(row, "restored", json_boolean(rows[r].restored));
		for (size_t c = 0; c < COLUMN_COUNT; c++)
			(void)json_object_set_new(row, columns[c].name, cli_json_number(cell(&rows[r], c)));
		(void)json_array_append_new(list, row);
	}
	json_t *object = json_object();
	(void)json_object_set_new(object, "rows", list);
	(void)json_object_set_new(object, "ended_by", json_string(stops[pass.stop]));
	(void)json_object_set_new(object, "lines_faired",
	                          json_integer((json_int_t)pass.facts.line_count));
	(void)json_object_set_new(object, "lines_passed_over",
	                          json_integer((json_int_t)pass.facts.passed_count));
	(void)json_object_set_new(object, "device", json_string(run->device));
	(void)json_object_set_new(object, "strict", json_boolean(run->strict));
	(void)json_object_set_new(object, "precision",
	                          json_string(job->request->precision == BATTEN_F64 ? "f64" : "f32"));
	(void)json_object_set_new(object, "cpu_seconds", cli_json_number(pass.cpu_seconds));
	return object;
}
