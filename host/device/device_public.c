#include "device/device.h"

size_t batten_device_count(batten_context *context, const char **reason)
{
	if (!context) {
		if (reason)
			*reason = "no context";
		return 0;
	}
	return device_count(context, reason);
}

batten_status batten_device_describe(batten_context *context, size_t index, batten_device *out)
{
	if (!context)
		return BATTEN_USAGE;
	if (!out)
		return batten_fail(context, BATTEN_USAGE, "batten_device_describe: out is NULL");
	return device_describe(context, index, out);
}
