/* Writes the two Wigley hulls of data/hulls to standard output:
 *
 *     generate_wigley exact > hulls/wigley.csv
 *     generate_wigley noisy > hulls/wigley_noisy.csv
 *
 * y = B/2 (1 - (2x'/L)^2) (1 - (1-z)^2), x' from amidships, z up from the keel to the deck at 1
 * (Letcher 9; thesis table B.2). The noisy hull adds 0.01 (2u - 1) to every positive half-breadth,
 * u from Philox4x32-10 (Random123), so that it is the same on every machine. */
#include <Random123/philox.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LENGTH 16.0
#define BREADTH 1.6
#define NOISE 0.01

enum { WATERLINES = 20, SEED = 777 };

static double half_breadth(double x, double z)
{
	double along = 2 * (x - LENGTH / 2) / LENGTH;
	double down = 1 - z;
	return BREADTH / 2 * (1 - along * along) * (1 - down * down);
}

/* Uniform in [0, 1): the upper 53 bits of the first two words of block number node. */
static double uniform(uint32_t node)
{
	philox4x32_ctr_t counter = { { node, 0, 0, 0 } };
	philox4x32_key_t key = { { SEED, 0 } };
	philox4x32_ctr_t words = philox4x32(counter, key);
	uint64_t bits = (uint64_t)words.v[1] << 32 | words.v[0];
	return (double)(bits >> 11) * 0x1p-53;
}

/* The shortest decimal that reads back exactly. The program never leaves the C locale. */
static void print_number(double value)
{
	char text[32];
	for (int digits = 1; digits <= 17; digits++) {
		(void)snprintf(text, sizeof text, "%.*g", digits, value);
		if (strtod(text, NULL) == value)
			break;
	}
	(void)fputs(text, stdout);
}

static void print_header(const char *name, const char *comment)
{
	(void)printf(
		"# batten-offsets: 1\n# name: %s\n# unit: m\n# frame: ap-fwd\n# lbp: 16\n# draft: 1\n"
		"# depth: 1\n# layout: grid\n# source: data/generate_wigley.c\n#\n%s",
		name, comment);
}

static void print_table(const double *stations, int station_count, int noisy)
{
	(void)fputs("z\\x", stdout);
	for (int s = 0; s < station_count; s++) {
		(void)putchar(',');
		print_number(stations[s] * LENGTH / 10);
	}
	(void)putchar('\n');
	for (int w = 0; w < WATERLINES; w++) {
		double z = w / (WATERLINES - 1.0);
		print_number(z);
		for (int s = 0; s < station_count; s++) {
			double y = half_breadth(stations[s] * LENGTH / 10, z);
			if (noisy && y > 0) {
				y += NOISE * (2 * uniform((uint32_t)(w * station_count + s)) - 1);
				y = y > 0 ? y : 0;
			}
			(void)putchar(',');
			print_number(y);
		}
		(void)putchar('\n');
	}
}

int main(int argc, char **argv)
{
	static const double printed[] = { 0, 0.5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9.5, 10 };
	double even[21];
	for (int s = 0; s < 21; s++)
		even[s] = s / 2.0;
	if (argc == 2 && strcmp(argv[1], "exact") == 0) {
		print_header("Wigley hull", "# Exact half-breadths at the stations and waterlines of "
		                            "thesis table B.2: station n at\n"
		                            "# x = 1.6 n, waterline j at z = j/19. Keel row and end "
		                            "stations are profile points.\n");
		print_table(printed, (int)(sizeof printed / sizeof *printed), 0);
	} else if (argc == 2 && strcmp(argv[1], "noisy") == 0) {
		print_header("Wigley hull with noise",
		             "# The exact form at x = 0.8 i, z = j/19, plus 0.01 (2u - 1) m where it is "
		             "positive, never\n"
		             "# below 0; u in [0, 1) from Philox4x32-10, key 777, counter 21 j + i.\n");
		print_table(even, 21, 1);
	} else {
		(void)fprintf(stderr, "usage: generate_wigley exact|noisy > FILE\n");
		return 2;
	}
	return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 1;
}
