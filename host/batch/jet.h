/* Numbers that carry their first and second derivatives by a few variables: differentiates a formula
 * exactly as it is worked (forward mode). */
#ifndef BATTEN_BATCH_JET_H
#define BATTEN_BATCH_JET_H

enum {
	JET_VARIABLES_MOST = 9,
	JET_SECONDS_MOST = JET_VARIABLES_MOST * (JET_VARIABLES_MOST + 1) / 2
};

typedef struct jet {
	int variables; /* it depends on the first so many; 0: a constant */
	double value, first[JET_VARIABLES_MOST];
	double second[JET_SECONDS_MOST]; /* of i and j <= i: number i (i + 1) / 2 + j */
} jet;

jet jet_constant(double value);
jet jet_variable(double value, int variable, int variables);
jet jet_add(jet a, jet b);
jet jet_subtract(jet a, jet b);
jet jet_multiply(jet a, jet b);
jet jet_scale(jet a, double factor);
jet jet_square(jet a);
jet jet_inverse(jet a);
jet jet_root(jet a);

#endif
