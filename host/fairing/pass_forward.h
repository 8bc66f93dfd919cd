/* The programs of forward and of inverse fairing (thesis 5.2, 5.3, 6). */
#ifndef BATTEN_FAIRING_PASS_FORWARD_H
#define BATTEN_FAIRING_PASS_FORWARD_H

#include "fairing/pass_lines.h"
#include "fairing/pass_spline.h"

/* What is to be written. sections may have no pieces. */
typedef struct pass_task {
	const pass_lines *waterlines, *sections;
	pass_representation along, across; /* of waterlines, of sections */
	bool floored;                      /* half-breadths: nothing goes below 0 */
	size_t values;
	/* Told by what is written: pieces faired, pieces too short. */
	size_t faired_count, passed_count;
} pass_task;

/* Waterlines by approximation, then sections. */
void pass_write_approximation(pass_writer *writer, pass_task *task);
/* Sections by approximation, then waterlines by least squares; along.vertices > 0. */
void pass_write_fit(pass_writer *writer, pass_task *task);
/* The fields of second derivatives smoothed, offsets by least squares. */
void pass_write_inverse(pass_writer *writer, pass_task *task);

#endif
