/* How many of many cases that go one way through the code, with other numbers. */
#ifndef BATTEN_TESTS_CASES_H
#define BATTEN_TESTS_CASES_H

/* Sanitizers look at code, not at numbers, and are slow: they take the first `few`. */
#ifdef BATTEN_SANITIZED
#define CASES(all, few) (few)
#else
#define CASES(all, few) (all)
#endif

#endif
