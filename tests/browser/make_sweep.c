/* A sweep of many designs for the browser: make_sweep PATH HULL COUNT KEPT */
#include "support/sweep_file.h"

#include <stdlib.h>

int main(int argc, char **argv)
{
	batten_context *context = NULL;
	if (argc != 5 || batten_context_create(NULL, &context) != BATTEN_OK)
		return 2;
	const sweep_file file = {
		.path = argv[1],
		.hull = argv[2],
		.count = strtoul(argv[3], NULL, 10),
		.kept = strtoul(argv[4], NULL, 10),
		.name = "<b>Wigley</b>, wider and finer </script><script>document.title = 'no'</script>",
	};
	sweep_file_make(context, &file);
	batten_context_destroy(context);
	return 0;
}
