#include "sweep/stored_plan.h"
#include "sweep/store.h"

static batten_status read_meta(batten_context *context, void *user, const char *role,
                               const char *name, char **text, size_t *length)
{
	(void)context;
	(void)name;
	return store_meta(user, role, text, length);
}

batten_status stored_plan_read(const sweep_database *database, sweep_plan **out)
{
	char *text = NULL;
	size_t length = 0;
	batten_status status = store_check_kind(database);
	if (status == BATTEN_OK)
		status = store_meta(database, "plan", &text, &length);
	const plan_source source = { read_meta, (void *)database };
	if (status == BATTEN_OK)
		status = sweep_plan_parse(database->context, database->path, text, length, &source, out);
	batten_release(database->context, text);
	return status;
}
