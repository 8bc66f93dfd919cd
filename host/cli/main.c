/* The program: picks the subcommand. */
#include "cli.h"

#include <malloc.h>
#include <signal.h>
#include <string.h>

typedef struct subcommand {
	const char *name;
	batten_status (*run)(int argc, char **argv);
	const char *summary;
} subcommand;

static const subcommand subcommands[] = {
	{ "fair", cli_fair, "fair a hull: faired offsets, report, pictures" },
	{ "measure", cli_measure, "fairness numbers, form coefficients and hydrostatics of a hull" },
	{ "curve", cli_curve, "represent one line and measure how fair it is" },
	{ "vary", cli_vary, "make a variant of a parent hull" },
	{ "sweep", cli_sweep, "run a plan of many designs into a database" },
	{ "merge", cli_merge, "put the shards of a sweep together" },
	{ "export", cli_export, "one design of a sweep as offsets, IGES, STEP or STL" },
	{ "surface", cli_surface, "fit a B-spline surface to a hull" },
	{ "convert", cli_convert, "surfaces from one of JSON, IGES and STEP to another" },
	{ "report", cli_report, "the result of a sweep as one page to look at in a browser" },
	{ "devices", cli_devices, "list the OpenCL devices of this machine" },
	{ "selftest", cli_selftest, "run every kernel against the plain C path" },
	{ "bench", cli_bench, "time the engine against a named reference" },
};

static void print_help(FILE *stream)
{
	(void)fprintf(stream,
	              "batten %s: fairs ship hulls in bulk\n\nusage: batten COMMAND [OPTION ...]\n\n",
	              batten_version());
	for (size_t i = 0; i < sizeof subcommands / sizeof subcommands[0]; i++)
		(void)fprintf(stream, "  %-10s %s\n", subcommands[i].name, subcommands[i].summary);
	(void)fputs(
		"\n'batten COMMAND --help' tells more, each with an example:\n"
		"  batten fair data/hulls/npl_parent.csv --out demo\n"
		"\nexit codes: 0 done; 1 done, but not all converged; 2 usage; 3 input invalid;\n"
		"4 device absent or lost; 5 kernel build or self-test failed; 6 input/output error or\n"
		"a package missing; 70 internal error or out of memory; 75 interrupted, can go on\n",
		stream);
}

/* What was printed must have arrived: a full disk behind stdout is an error too. */
static int finish(batten_status status)
{
	if ((fflush(stdout) != 0 || ferror(stdout)) && status == BATTEN_OK) {
		(void)fputs("batten: standard output cannot be written\n", stderr);
		status = BATTEN_IO;
	}
	return batten_status_exit_code(status);
}

/* What a batch gives back the next one takes again: without this the system takes the pages and zeroes
 * them anew each time, a tenth of a sweep's CPU time. */
static void keep_memory(void)
{
#ifdef __GLIBC__
	(void)mallopt(M_MMAP_THRESHOLD, 32 << 20);
	(void)mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

int main(int argc, char **argv)
{
	/* A file that grows past its limit is a write that fails, and is reported as one. */
	(void)signal(SIGXFSZ, SIG_IGN);
	keep_memory();
	if (argc < 2) {
		print_help(stderr);
		return batten_status_exit_code(BATTEN_USAGE);
	}
	if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
	    strcmp(argv[1], "help") == 0) {
		print_help(stdout);
		return finish(BATTEN_OK);
	}
	if (strcmp(argv[1], "--version") == 0) {
		(void)printf("batten %s\n", batten_version());
		return finish(BATTEN_OK);
	}
	for (size_t i = 0; i < sizeof subcommands / sizeof subcommands[0]; i++)
		if (strcmp(argv[1], subcommands[i].name) == 0)
			return finish(subcommands[i].run(argc - 1, argv + 1));
	char found[128];
	(void)snprintf(found, sizeof found, "%s", argv[1]);
	cli_clean(found);
	(void)fprintf(
		stderr,
		"batten: found '%s', a command was expected: fair, measure, curve, vary, sweep, merge, export, "
		"surface, convert, report, devices, selftest, bench\n",
		found);
	return batten_status_exit_code(BATTEN_USAGE);
}
