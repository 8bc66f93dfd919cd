/* How fair the lines of a hull are: divided differences, fairness number, inflections (thesis 4.4).
 *
 * For n points (a_i, v_i), any spacing,
 *     d1_i = (v_{i+1} - v_i) / (a_{i+1} - a_i)
 *     d2_i = (d1_i - d1_{i-1}) / ((a_{i+1} - a_{i-1}) / 2)      at the interior point i,
 * twice Newton's divided difference: this is what the thesis prints in its appendices A and B.6. */
#ifndef BATTEN_FAIRING_LINES_H
#define BATTEN_FAIRING_LINES_H

#include "hull/hull.h"

/* d1 has count - 1 entries. */
void lines_first_differences(size_t count, const double *along_m, const double *value_m,
                             double *d1);
/* d2_per_m has count - 2 entries; entry i belongs to point i + 1. */
void lines_second_differences(size_t count, const double *along_m, const double *value_m,
                              double *d2_per_m);

/* Sum of d2^2; NaN below three points. */
double lines_fairness(size_t count, const double *along_m, const double *value_m);

/* Sign changes of d2 from one point to the next. A d2 no larger than what rounding of the points
 * may give it, 8 eps (max |v| + max |d1| max |a|) (1 / left step + 1 / right step) / half span,
 * has no sign: it is passed over, so a straight piece is not an inflection by itself. */
size_t lines_inflections(size_t count, const double *along_m, const double *value_m);

/* Fairness number and inflections of a line of a hull, broken at its knuckles and where a cell is
 * empty: no difference reaches across. */
typedef struct lines_sum {
	double fn_per_m2; /* 0 without an interior point */
	size_t interior_count, inflections;
} lines_sum;
lines_sum lines_of_points(const batten_hull *hull, bool waterline, size_t line,
                          const hull_line *points);

/* The same over all waterlines, or all sections, of a hull; '?' cells are no points. fn is NaN
 * where no line has an interior point. */
batten_status lines_of_hull(const batten_hull *hull, bool waterlines, lines_sum *out);

/* Whether all points of the hull's lines are nodes of its grid and only empty cells break them. */
bool lines_are_of_grid(const batten_hull *hull);

/* Last point of the piece of a line that begins at point first, and where the next piece begins:
 * the same point where a knuckle is a point of the line, the next one where it, or an empty cell,
 * lies between two. Pieces end at count - 1. */
size_t lines_piece_end(const batten_hull *hull, bool waterline, size_t line,
                       const hull_line *points, size_t first, size_t *next);

#endif
