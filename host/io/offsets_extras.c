/* The rows after the table: profile points and knuckles. */
#include "io/offsets_frame.h"
#include "io/offsets_parts.h"

#include <math.h>

static const char *const profile_names[] = {
	[HULL_PROFILE_STEM] = "stem",
	[HULL_PROFILE_STERN] = "stern",
	[HULL_PROFILE_KEEL] = "keel",
	[HULL_PROFILE_DECK] = "deck",
};

const char *offsets_profile_text(hull_profile_kind kind)
{
	return profile_names[kind];
}

bool offsets_is_extra(const struct offsets_scan *scan)
{
	struct offsets_scan row = *scan;
	struct offsets_cell cell;
	row.place = 0;
	return offsets_next_cell(&row, &cell) &&
	       (offsets_cell_is(&cell, "profile") || offsets_cell_is(&cell, "knuckle"));
}

/* The next cell, or INPUT at the end of the row. */
static batten_status take_cell(struct offsets_scan *scan, const char *form,
                               struct offsets_cell *cell)
{
	if (!offsets_next_cell(scan, cell))
		return offsets_fail_at(scan, scan->line, scan->row_length + 1,
		                       "found the end of the row, expected '%s'", form);
	return BATTEN_OK;
}

static batten_status take_coordinate(struct offsets_scan *scan, const char *form,
                                     const batten_hull *hull, bool along_x,
                                     struct offsets_cell *cell, double *out_m)
{
	struct offsets_coordinate read = { 0 };
	batten_status status = take_cell(scan, form, cell);
	if (status == BATTEN_OK)
		status = offsets_read_coordinate(scan, cell, hull, along_x, NULL, &read);
	if (status == BATTEN_OK)
		*out_m = read.metres;
	return status;
}

static batten_status read_profile(struct offsets_scan *scan, const batten_hull *hull,
                                  hull_profile_point *out)
{
	static const char form[] = "profile,stem|stern|keel|deck,x,y,z";
	struct offsets_cell cell;
	batten_status status = take_cell(scan, form, &cell);
	if (status != BATTEN_OK)
		return status;
	int kind = HULL_PROFILE_STEM;
	while (kind <= HULL_PROFILE_DECK && !offsets_cell_is(&cell, profile_names[kind]))
		kind++;
	if (kind > HULL_PROFILE_DECK)
		return offsets_fail(scan, &cell, "stem, stern, keel or deck");
	out->kind = (hull_profile_kind)kind;
	status = take_coordinate(scan, form, hull, true, &cell, &out->x_m);
	if (status == BATTEN_OK)
		status = take_cell(scan, form, &cell);
	if (status == BATTEN_OK)
		status = offsets_read_half_breadth(scan, &cell, hull, &out->y_m);
	if (status == BATTEN_OK)
		status = take_coordinate(scan, form, hull, false, &cell, &out->z_m);
	return status == BATTEN_OK ? offsets_expect_no_more(scan) : status;
}

static batten_status read_knuckle(struct offsets_scan *scan, const batten_hull *hull,
                                  hull_knuckle *out)
{
	static const char form[] = "knuckle,station|waterline,x,z";
	struct offsets_cell cell, x, z;
	batten_status status = take_cell(scan, form, &cell);
	if (status != BATTEN_OK)
		return status;
	out->on_waterline = offsets_cell_is(&cell, "waterline");
	if (!out->on_waterline && !offsets_cell_is(&cell, "station"))
		return offsets_fail(scan, &cell, "station or waterline");
	status = take_coordinate(scan, form, hull, true, &x, &out->x_m);
	if (status == BATTEN_OK)
		status = take_coordinate(scan, form, hull, false, &z, &out->z_m);
	if (status == BATTEN_OK && !hull_knuckle_snap(hull, out))
		return offsets_fail(scan, out->on_waterline ? &z : &x, "%s of the table",
		                    out->on_waterline ? "a waterline" : "a station");
	return status == BATTEN_OK ? offsets_expect_no_more(scan) : status;
}

/* Counted first: memory for what there is, not for what there could be. */
static batten_status count_extras(const struct offsets_scan *first, size_t *profile_count,
                                  size_t *knuckle_count)
{
	struct offsets_scan scan = *first;
	struct offsets_cell cell;
	do {
		scan.place = 0;
		(void)offsets_next_cell(&scan, &cell);
		bool profile = offsets_cell_is(&cell, "profile");
		if (!profile && !offsets_cell_is(&cell, "knuckle"))
			return offsets_fail(&scan, &cell, "profile or knuckle, the table being at its end");
		size_t *count = profile ? profile_count : knuckle_count;
		if (++*count > HULL_LINES_MOST)
			return offsets_fail(&scan, &cell, "at most %d such rows", HULL_LINES_MOST);
	} while (offsets_next_row(&scan));
	return BATTEN_OK;
}

batten_status offsets_read_extras(struct offsets_scan *scan, batten_hull *hull)
{
	size_t profile_count = 0;
	size_t knuckle_count = 0;
	batten_status status = count_extras(scan, &profile_count, &knuckle_count);
	if (status != BATTEN_OK)
		return status;
	hull->profile = batten_allocate(scan->context, profile_count, sizeof *hull->profile);
	hull->knuckles = batten_allocate(scan->context, knuckle_count, sizeof *hull->knuckles);
	if (!hull->profile || !hull->knuckles)
		return BATTEN_MEMORY;
	do {
		struct offsets_cell cell;
		scan->place = 0;
		(void)offsets_next_cell(scan, &cell);
		if (offsets_cell_is(&cell, "profile"))
			status = read_profile(scan, hull, &hull->profile[hull->profile_count++]);
		else
			status = read_knuckle(scan, hull, &hull->knuckles[hull->knuckle_count++]);
		if (status != BATTEN_OK)
			return status;
	} while (offsets_next_row(scan));
	hull_knuckle_sort(hull);
	return BATTEN_OK;
}
