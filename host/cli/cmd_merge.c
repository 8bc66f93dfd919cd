/* batten merge: the shards of a sweep as one database. */
#include "cli.h"

#include "json_out.h"

enum { SHARDS_MOST = 4096 };

static const cli_command command = {
	.name = "merge",
	.usage = "OUT.db SHARD.db ...",
	.summary = "puts the databases of all shards of a sweep together",
	.example = "  batten sweep plan.json --out part1.db --shard 1/2\n"
			   "  batten sweep plan.json --out part2.db --shard 2/2\n"
			   "  batten merge whole.db part1.db part2.db\n",
	.notes =
		"OUT.db equals, row for row, that of the sweep in one part, and is written at once or not\n"
		"at all. Every shard must be there and complete.\n",
};

batten_status cli_merge(int argc, char **argv)
{
	static const char *paths[SHARDS_MOST + 1];
	cli_common common = { 0 };
	size_t count = 0;
	bool done = false;
	uint64_t designs = 0;
	batten_context *context = NULL;
	batten_status status = cli_parse(&command, argc, argv, NULL, &common, paths, SHARDS_MOST + 1,
	                                 &count, &done);
	if (status != BATTEN_OK || done)
		return status;
	if (count < 2)
		return cli_usage("merge", "OUT.db and the databases of the shards were expected");
	status = cli_context_create("merge", &common, &context);
	if (status != BATTEN_OK)
		return status;
	status = batten_sweep_merge(context, paths[0], count - 1, paths + 1, &designs);
	if (status != BATTEN_OK)
		(void)cli_failure("merge", context, status);
	else if (common.json)
		status = cli_json_print("merge",
		                        json_pack("{s:s, s:I, s:I}", "database", paths[0], "shards",
		                                  (json_int_t)(count - 1), "designs", (json_int_t)designs));
	else
		(void)printf("%s: %llu designs of %zu shards\n", paths[0], (unsigned long long)designs,
		             count - 1);
	batten_context_destroy(context);
	return status;
}
