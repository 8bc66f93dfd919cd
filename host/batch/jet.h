/* Numbers that carry their first and second derivatives by five variables: differentiates a formula
 * exactly as it is worked (forward mode). */
#ifndef BATTEN_BATCH_JET_H
#define BATTEN_BATCH_JET_H

enum { JET_VARIABLES = 5, JET_SECONDS = JET_VARIABLES * (JET_VARIABLES + 1) / 2 };

typedef struct jet {
	double value, first[JET_VARIABLES];
	double second[JET_SECONDS]; /* of i and j <= i: number i (i + 1) / 2 + j */
} jet;

jet jet_constant(double value);
jet jet_variable(double value, int variable);
jet jet_add(jet a, jet b);
jet jet_subtract(jet a, jet b);
jet jet_multiply(jet a, jet b);
jet jet_scale(jet a, double factor);
jet jet_inverse(jet a);
jet jet_root(jet a);

#endif
