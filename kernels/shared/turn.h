/* Squares of numbers whose rows and lanes change places: what belongs to one hull comes to lie side by
 * side. OpenCL only. The includer has dialect.h. */
#ifndef BATTEN_SHARED_TURN_H
#define BATTEN_SHARED_TURN_H

/* The first halves of two vectors taken in turns, and the second halves. */
#if defined(TURNS_LOW)
#elif BATTEN_LANES == 2
#define TURNS_LOW(a, b) (real)(a.s0, b.s0)
#define TURNS_HIGH(a, b) (real)(a.s1, b.s1)
#elif BATTEN_LANES == 4
#define TURNS_LOW(a, b) (real)(a.s0, b.s0, a.s1, b.s1)
#define TURNS_HIGH(a, b) (real)(a.s2, b.s2, a.s3, b.s3)
#elif BATTEN_LANES == 8
#define TURNS_LOW(a, b) (real)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3)
#define TURNS_HIGH(a, b) (real)(a.s4, b.s4, a.s5, b.s5, a.s6, b.s6, a.s7, b.s7)
#elif BATTEN_LANES == 16
#define TURNS_LOW(a, b)                                                                            \
	(real)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3, a.s4, b.s4, a.s5, b.s5, a.s6, b.s6,     \
	       a.s7, b.s7)
#define TURNS_HIGH(a, b)                                                                           \
	(real)(a.s8, b.s8, a.s9, b.s9, a.sa, b.sa, a.sb, b.sb, a.sc, b.sc, a.sd, b.sd, a.se, b.se,     \
	       a.sf, b.sf)
#endif

/* Rows become columns: to take turns moves the first bit of a number's place (row, lane) to its end;
 * done as often as a row has bits, rows and lanes have changed places. */
#if BATTEN_LANES == 1
#define turn(square)
#else
static inline void turn(real square[BATTEN_LANES])
{
	UNROLLED
	for (int done = 1; done < BATTEN_LANES; done *= 2) {
		real next[BATTEN_LANES];
		UNROLLED
		for (int i = 0; i < BATTEN_LANES / 2; i++) {
			const real a = square[i];
			const real b = square[i + BATTEN_LANES / 2];
			next[2 * i] = TURNS_LOW(a, b);
			next[2 * i + 1] = TURNS_HIGH(a, b);
		}
		UNROLLED
		for (int i = 0; i < BATTEN_LANES; i++)
			square[i] = next[i];
	}
}
#endif

#endif
