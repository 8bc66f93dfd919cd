#include "cli.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_LIMIT = 48, HELP_WIDTH = 34 };

batten_status cli_usage(const char *command, const char *format, ...)
{
	char line[1024];
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(line, sizeof line, format, arguments);
	va_end(arguments);
	cli_clean(line);
	(void)fprintf(stderr, "batten %s: %s (batten %s --help)\n", command, line, command);
	return BATTEN_USAGE;
}

void cli_clean(char *line)
{
	for (; *line; line++)
		if ((unsigned char)*line < 0x20 || *line == 0x7f)
			*line = '?';
}

batten_status cli_failure(const char *command, const batten_context *context, batten_status status)
{
	(void)fprintf(stderr, "batten %s: %s\n", command, batten_context_error(context));
	return status;
}

static void talk(batten_log_level level, const char *line, void *user)
{
	(void)user;
	static const char *const words[] = { "error: ", "warning: ", "" };
	(void)fprintf(stderr, "%s%s\n", words[level], line);
}

batten_status cli_context_create(const char *command, const cli_common *common,
                                 batten_context **out)
{
	batten_context_options options;
	batten_context_options_default(&options);
	options.threads = common->threads;
	options.max_memory = common->max_memory;
	if (!common->quiet)
		options.log = talk;
	const batten_status status = batten_context_create(&options, out);
	if (status == BATTEN_USAGE)
		return cli_usage(command, "--threads: found %u, 1 to 4096 was expected", common->threads);
	if (status != BATTEN_OK)
		(void)fprintf(stderr, "batten %s: %s\n", command, batten_status_text(status));
	return status;
}

/* A finite number that takes up the whole text. */
static bool read_number(const char *text, double *out)
{
	char *end = NULL;
	const double value = strtod(text, &end);
	if (end == text || *end != '\0' || !isfinite(value))
		return false;
	*out = value;
	return true;
}

static bool read_count(const char *text, unsigned *out)
{
	char *end = NULL;
	errno = 0;
	const unsigned long value = strtoul(text, &end, 10);
	if (end == text || *end != '\0' || errno != 0 || value > 1000000 || strchr(text, '-'))
		return false;
	*out = (unsigned)value;
	return true;
}

static bool read_size(const char *text, size_t *out)
{
	char *end = NULL;
	errno = 0;
	const unsigned long long value = strtoull(text, &end, 10);
	if (end == text || errno != 0 || strchr(text, '-'))
		return false;
	static const char letters[] = "KMGT";
	size_t factor = 1;
	const char *letter = *end ? strchr(letters, *end) : NULL;
	if (letter) {
		factor = (size_t)1 << (10 * (letter - letters + 1));
		end++;
	}
	if (*end != '\0' || value > SIZE_MAX / factor)
		return false;
	*out = (size_t)value * factor;
	return true;
}

static bool read_device(const char *text, int *out)
{
	unsigned index = 0;
	if (strcmp(text, "auto") == 0)
		*out = BATTEN_DEVICE_AUTO;
	else if (strcmp(text, "reference") == 0)
		*out = BATTEN_DEVICE_REFERENCE;
	else if (read_count(text, &index))
		*out = (int)index;
	else
		return false;
	return true;
}

static bool read_precision(const char *text, batten_precision *out)
{
	if (strcmp(text, "f64") == 0)
		*out = BATTEN_F64;
	else if (strcmp(text, "f32") == 0)
		*out = BATTEN_F32;
	else
		return false;
	return true;
}

/* Stores one option's value; the return is what was expected where it does not fit, else NULL. */
static const char *store(const cli_option *option, const char *text)
{
	switch (option->kind) {
	case CLI_FLAG:
		*(bool *)option->target = true;
		return NULL;
	case CLI_TEXT:
		*(const char **)option->target = text;
		return NULL;
	case CLI_NUMBER:
		return read_number(text, option->target) ? NULL : "a number";
	case CLI_COUNT:
		return read_count(text, option->target) ? NULL : "a whole number up to 1000000";
	case CLI_SIZE:
		return read_size(text, option->target) ? NULL : "a size such as 512M or 4G";
	case CLI_DEVICE:
		return read_device(text, option->target) ? NULL : "auto, reference or an index";
	case CLI_PRECISION:
		return read_precision(text, option->target) ? NULL : "f64 or f32";
	}
	return "an option";
}

static void print_option(const cli_option *option)
{
	char left[64];
	(void)snprintf(left, sizeof left, "--%s%s%s", option->name, option->argument ? " " : "",
	               option->argument ? option->argument : "");
	(void)printf("  %-*s %s\n", HELP_WIDTH, left, option->help);
}

static void print_help(const cli_command *command, const cli_option *options, size_t count)
{
	(void)printf("batten %s: %s\n\nusage: batten %s %s\n\n", command->name, command->summary,
	             command->name, command->usage);
	for (size_t i = 0; i < count; i++)
		print_option(&options[i]);
	(void)printf("  %-*s %s\n", HELP_WIDTH, "--help", "this text");
	if (command->notes)
		(void)printf("\n%s", command->notes);
	(void)printf("\nexample:\n%s", command->example);
}

/* The subcommand's options, then the common ones. */
static size_t join(const cli_option *options, cli_common *common, cli_option *all)
{
	const cli_option shared[] = {
		{ "threads", CLI_COUNT, &common->threads, "N",
		  "CPU threads (default: the affinity mask, or SLURM_CPUS_PER_TASK)" },
		{ "max-memory", CLI_SIZE, &common->max_memory, "SIZE",
		  "refuse allocations above, e.g. 4G" },
		{ "json", CLI_FLAG, &common->json, NULL, "JSON on standard output" },
		{ "quiet", CLI_FLAG, &common->quiet, NULL, "no talk on standard error" },
	};
	size_t count = 0;
	for (; options && options->name && count < OPTION_LIMIT - 5; options++)
		all[count++] = *options;
	for (size_t i = 0; i < sizeof shared / sizeof shared[0]; i++)
		all[count++] = shared[i];
	return count;
}

static batten_status take(const cli_command *command, const cli_option *option, const char *text)
{
	const char *expected = store(option, text);
	if (expected)
		return cli_usage(command->name, "--%s: found '%s', expected %s", option->name, text,
		                 expected);
	return BATTEN_OK;
}

/* The word getopt stumbled over: within a cluster of letters it has not moved on yet. */
static const char *unknown_option(int argc, char **argv)
{
	const char *here = optind < argc ? argv[optind] : "";
	const bool in_cluster = optopt != 0 && here[0] == '-' && here[1] != '-' && strchr(here, optopt);
	return in_cluster ? here : argv[optind - 1];
}

batten_status cli_parse(const cli_command *command, int argc, char **argv,
                        const cli_option *options, cli_common *common, const char **positional,
                        size_t most, size_t *count, bool *done)
{
	cli_option all[OPTION_LIMIT];
	struct option long_options[OPTION_LIMIT + 1] = { 0 };
	const size_t known = join(options, common, all);
	for (size_t i = 0; i < known; i++)
		long_options[i] = (struct option){ all[i].name,
			                               all[i].kind == CLI_FLAG ? no_argument
			                                                       : required_argument,
			                               NULL, (int)i + 256 };
	long_options[known] = (struct option){ "help", no_argument, NULL, 'h' };
	*done = false;
	*count = 0;
	opterr = 0;
	optind = 1;
	int found = 0;
	bool seen[OPTION_LIMIT] = { false };
	while ((found = getopt_long(argc, argv, ":h", long_options, NULL)) != -1) {
		if (found == 'h') {
			print_help(command, all, known);
			*done = true;
			return BATTEN_OK;
		}
		if (found == '?')
			return cli_usage(command->name, "found '%s', an option of this command was expected",
			                 unknown_option(argc, argv));
		if (found == ':')
			return cli_usage(command->name, "%s needs a value", argv[optind - 1]);
		const size_t index = (size_t)(found - 256);
		if (seen[index])
			return cli_usage(command->name, "--%s is given twice, once was expected",
			                 all[index].name);
		seen[index] = true;
		const batten_status status = take(command, &all[index], optarg);
		if (status != BATTEN_OK)
			return status;
	}
	for (; optind < argc; optind++) {
		if (*count == most)
			return cli_usage(command->name,
			                 "found '%s' after %zu argument%s, none more was expected",
			                 argv[optind], most, most == 1 ? "" : "s");
		positional[(*count)++] = argv[optind];
	}
	return BATTEN_OK;
}
