/* What the subcommands share: options, talk, exit codes. Stands on batten.h alone. */
#ifndef BATTEN_CLI_CLI_H
#define BATTEN_CLI_CLI_H

#include "batten.h"

#include <stdio.h>

/* One option of a subcommand. */
typedef enum cli_kind {
	CLI_FLAG,      /* bool *: --name */
	CLI_TEXT,      /* const char **: --name TEXT */
	CLI_NUMBER,    /* double *: --name NUMBER */
	CLI_COUNT,     /* unsigned *: --name N, 0..1000000 */
	CLI_SIZE,      /* size_t *: bytes with an optional K, M, G, T */
	CLI_DEVICE,    /* int *: auto, reference or an index */
	CLI_PRECISION, /* batten_precision *: f64 or f32 */
} cli_kind;

typedef struct cli_option {
	const char *name; /* without dashes; NULL ends a table */
	cli_kind kind;
	void *target;
	const char *argument; /* its name in the help, NULL for a flag */
	const char *help;
} cli_option;

/* A subcommand as its help shows it. */
typedef struct cli_command {
	const char *name, *usage, *summary, *example, *notes;
} cli_command;

/* Options every subcommand has. */
typedef struct cli_common {
	unsigned threads;
	size_t max_memory;
	bool json, quiet;
} cli_common;

/* Parses argv into the options and common ones; positional arguments go to positional (most of
 * them at most), their number to *count. Prints help and sets *done where --help is given.
 * Returns OK or USAGE (message printed). */
batten_status cli_parse(const cli_command *command, int argc, char **argv,
                        const cli_option *options, cli_common *common, const char **positional,
                        size_t most, size_t *count, bool *done);

/* A usage error: one line on stderr. */
batten_status cli_usage(const char *command, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

/* The context for a subcommand: talk goes to stderr unless quiet. */
batten_status cli_context_create(const char *command, const cli_common *common,
                                 batten_context **out);

/* Prints the context's last error, preceded by the subcommand's name; returns status. */
batten_status cli_failure(const char *command, const batten_context *context, batten_status status);

/* "MxN", both whole numbers below 10000; false for anything else. */
bool cli_read_pair(const char *text, size_t *first, size_t *second);

/* "keel,stern,stem", "deck" too where that is an edge here, as bits BATTEN_EDGE_...; an error is
 * printed. */
batten_status cli_read_edges(const char *command, const char *option, const char *text,
                             bool with_deck, unsigned *out);

/* Makes one line of a text: control characters, as a path may have them, become '?'. */
void cli_clean(char *line);

/* Whether a path ends as a file of surfaces does, with a name before it. */
bool cli_is_surface_file(const char *path);

batten_status cli_fair(int argc, char **argv);
batten_status cli_measure(int argc, char **argv);
batten_status cli_curve(int argc, char **argv);
batten_status cli_surface(int argc, char **argv);
batten_status cli_convert(int argc, char **argv);
batten_status cli_vary(int argc, char **argv);
batten_status cli_sweep(int argc, char **argv);
batten_status cli_report(int argc, char **argv);
batten_status cli_merge(int argc, char **argv);
batten_status cli_export(int argc, char **argv);
batten_status cli_devices(int argc, char **argv);
batten_status cli_selftest(int argc, char **argv);
batten_status cli_bench(int argc, char **argv);

#endif
