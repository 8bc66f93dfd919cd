#include "picture/vulkan_device.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char validation_layer[] = "VK_LAYER_KHRONOS_validation";

enum { LIST_LIMIT = 64 }; /* layers, devices, queue families looked at */

static const char *result_text(VkResult result)
{
	switch (result) {
	case VK_ERROR_OUT_OF_HOST_MEMORY:
		return "out of host memory";
	case VK_ERROR_OUT_OF_DEVICE_MEMORY:
		return "out of device memory";
	case VK_ERROR_INITIALIZATION_FAILED:
		return "initialization failed";
	case VK_ERROR_DEVICE_LOST:
		return "the device was lost";
	case VK_ERROR_INCOMPATIBLE_DRIVER:
		return "no Vulkan driver is installed";
	case VK_ERROR_LAYER_NOT_PRESENT:
		return "a layer is missing";
	case VK_ERROR_EXTENSION_NOT_PRESENT:
		return "an extension is missing";
	case VK_TIMEOUT:
		return "timed out";
	default:
		return "failed";
	}
}

batten_status vulkan_fail(const vulkan_device *vulkan, const char *what, VkResult result)
{
	bool memory = result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
	return batten_fail(vulkan->context, memory ? BATTEN_MEMORY : BATTEN_DEVICE,
	                   "Vulkan: %s: %s (%d)", what, result_text(result), (int)result);
}

/* dlsym and vkGet*ProcAddr give what is not the function's own type; memcpy carries it over without
 * a cast that ISO C forbids. */
static bool store_call(void *call, const void *found)
{
	memcpy(call, found, sizeof(PFN_vkVoidFunction));
	PFN_vkVoidFunction loaded;
	memcpy(&loaded, found, sizeof loaded);
	return loaded != NULL;
}

static bool load_instance_call(vulkan_device *vulkan, const char *name, void *call)
{
	PFN_vkVoidFunction found = vulkan->GetInstanceProcAddr(vulkan->instance, name);
	return store_call(call, &found);
}

static bool load_device_call(vulkan_device *vulkan, const char *name, void *call)
{
	PFN_vkVoidFunction found = vulkan->GetDeviceProcAddr(vulkan->device, name);
	return store_call(call, &found);
}

static batten_status open_loader(vulkan_device *vulkan)
{
	/* Drivers start threads and keep static data: the library stays mapped once opened. */
	vulkan->library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
	if (!vulkan->library)
		return batten_fail(vulkan->context, BATTEN_DEVICE,
		                   "no Vulkan: libvulkan.so.1 cannot be opened");
	void *symbol = dlsym(vulkan->library, "vkGetInstanceProcAddr");
	bool good = store_call(&vulkan->GetInstanceProcAddr, &symbol);
#define VULKAN_LOAD(name) good = good && load_instance_call(vulkan, "vk" #name, &vulkan->name);
	VULKAN_LOADER_CALLS(VULKAN_LOAD)
#undef VULKAN_LOAD
	if (!good)
		return batten_fail(vulkan->context, BATTEN_DEVICE, "no Vulkan: libvulkan.so.1 lacks calls");
	return BATTEN_OK;
}

static bool layer_is_present(const vulkan_device *vulkan)
{
	VkLayerProperties layers[LIST_LIMIT];
	uint32_t count = LIST_LIMIT;
	VkResult result = vulkan->EnumerateInstanceLayerProperties(&count, layers);
	if (result != VK_SUCCESS && result != VK_INCOMPLETE)
		return false;
	for (uint32_t i = 0; i < count; i++)
		if (strcmp(layers[i].layerName, validation_layer) == 0)
			return true;
	return false;
}

static VKAPI_ATTR VkBool32 VKAPI_CALL
count_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT type,
              const VkDebugUtilsMessengerCallbackDataEXT *data, void *user)
{
	(void)severity;
	vulkan_device *vulkan = user;
	if (type == VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT)
		return VK_FALSE; /* the loader's talk about drivers it skipped */
	if (vulkan->validation_messages++ == 0) {
		char *line = vulkan->first_message;
		(void)snprintf(line, sizeof vulkan->first_message, "%s",
		               data->pMessage ? data->pMessage : "");
		for (; *line; line++)
			if (*line == '\n')
				*line = ' ';
	}
	return VK_FALSE;
}

/* Vulkan 1.1 and no extension is all the pictures need. */
static batten_status create_instance(vulkan_device *vulkan, bool validation)
{
	VkDebugUtilsMessengerCreateInfoEXT messenger = {
		.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
		.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
		                   VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
		.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
		               VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
		               VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
		.pfnUserCallback = count_message,
		.pUserData = vulkan,
	};
	VkApplicationInfo application = {
		.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
		.pApplicationName = "batten",
		.apiVersion = VK_API_VERSION_1_1,
	};
	const char *layers[] = { validation_layer };
	const char *extensions[] = { VK_EXT_DEBUG_UTILS_EXTENSION_NAME };
	VkInstanceCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
		.pNext = validation ? &messenger : NULL,
		.pApplicationInfo = &application,
		.enabledLayerCount = validation ? 1 : 0,
		.ppEnabledLayerNames = layers,
		.enabledExtensionCount = validation ? 1 : 0,
		.ppEnabledExtensionNames = extensions,
	};
	VkResult result = vulkan->CreateInstance(&create, NULL, &vulkan->instance);
	if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
		return batten_fail(vulkan->context, BATTEN_DEVICE, "no Vulkan driver is installed");
	if (result != VK_SUCCESS) {
		vulkan->instance = VK_NULL_HANDLE;
		return vulkan_fail(vulkan, "vkCreateInstance", result);
	}
	bool good = true;
#define VULKAN_LOAD(name) good = good && load_instance_call(vulkan, "vk" #name, &vulkan->name);
	VULKAN_INSTANCE_CALLS(VULKAN_LOAD)
#undef VULKAN_LOAD
	if (!good)
		return batten_fail(vulkan->context, BATTEN_DEVICE, "Vulkan: the instance lacks calls");
	if (validation &&
	    load_instance_call(vulkan, "vkCreateDebugUtilsMessengerEXT",
	                       &vulkan->CreateDebugUtilsMessenger) &&
	    load_instance_call(vulkan, "vkDestroyDebugUtilsMessengerEXT",
	                       &vulkan->DestroyDebugUtilsMessenger))
		(void)vulkan->CreateDebugUtilsMessenger(vulkan->instance, &messenger, NULL,
		                                        &vulkan->messenger);
	return BATTEN_OK;
}

/* A queue family that draws, or UINT32_MAX. */
static uint32_t drawing_family(const vulkan_device *vulkan, VkPhysicalDevice physical)
{
	VkQueueFamilyProperties families[LIST_LIMIT];
	uint32_t count = LIST_LIMIT;
	vulkan->GetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
	for (uint32_t i = 0; i < count; i++)
		if (families[i].queueCount > 0 && (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT))
			return i;
	return UINT32_MAX;
}

/* 0 is best. */
static int rank_of(VkPhysicalDeviceType type)
{
	switch (type) {
	case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
		return 0;
	case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
		return 1;
	case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
		return 2;
	case VK_PHYSICAL_DEVICE_TYPE_CPU:
		return 3;
	default:
		return 4;
	}
}

static VkResult create_device(vulkan_device *vulkan, VkPhysicalDevice physical, uint32_t family)
{
	float priority = 1.0F;
	VkDeviceQueueCreateInfo queue = {
		.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
		.queueFamilyIndex = family,
		.queueCount = 1,
		.pQueuePriorities = &priority,
	};
	VkDeviceCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
		.queueCreateInfoCount = 1,
		.pQueueCreateInfos = &queue,
	};
	VkResult result = vulkan->CreateDevice(physical, &create, NULL, &vulkan->device);
	if (result != VK_SUCCESS) {
		vulkan->device = VK_NULL_HANDLE;
		return result;
	}
	vulkan->physical = physical;
	vulkan->queue_family = family;
	vulkan->GetPhysicalDeviceProperties(physical, &vulkan->properties);
	vulkan->GetPhysicalDeviceMemoryProperties(physical, &vulkan->memory);
	return VK_SUCCESS;
}

/* Tries the devices in the order of their rank, as listed within one rank. */
static batten_status open_best_device(vulkan_device *vulkan)
{
	VkPhysicalDevice list[LIST_LIMIT];
	uint32_t count = LIST_LIMIT;
	VkResult result = vulkan->EnumeratePhysicalDevices(vulkan->instance, &count, list);
	if (result != VK_SUCCESS && result != VK_INCOMPLETE)
		return vulkan_fail(vulkan, "vkEnumeratePhysicalDevices", result);
	result = VK_ERROR_INCOMPATIBLE_DRIVER;
	for (int rank = 0; rank <= 4 && !vulkan->device; rank++)
		for (uint32_t i = 0; i < count && !vulkan->device; i++) {
			VkPhysicalDeviceProperties properties;
			vulkan->GetPhysicalDeviceProperties(list[i], &properties);
			uint32_t family = drawing_family(vulkan, list[i]);
			if (rank_of(properties.deviceType) == rank && family != UINT32_MAX)
				result = create_device(vulkan, list[i], family);
		}
	if (!vulkan->device)
		return vulkan_fail(vulkan, "no device that can draw", result);
	bool good = true;
#define VULKAN_LOAD(name) good = good && load_device_call(vulkan, "vk" #name, &vulkan->name);
	VULKAN_DEVICE_CALLS(VULKAN_LOAD)
#undef VULKAN_LOAD
	if (!good)
		return batten_fail(vulkan->context, BATTEN_DEVICE, "Vulkan: the device lacks calls");
	vulkan->GetDeviceQueue(vulkan->device, vulkan->queue_family, 0, &vulkan->queue);
	return BATTEN_OK;
}

batten_status vulkan_device_open(batten_context *context, vulkan_device **out)
{
	vulkan_device *vulkan = batten_allocate(context, 1, sizeof *vulkan);
	if (!vulkan)
		return BATTEN_MEMORY;
	vulkan->context = context;
	const char *wish = getenv("BATTEN_VULKAN_VALIDATION");
	bool validation = wish && strcmp(wish, "1") == 0;
	batten_status status = open_loader(vulkan);
	if (status == BATTEN_OK && validation && !layer_is_present(vulkan))
		status = batten_fail(context, BATTEN_MISSING,
		                     "BATTEN_VULKAN_VALIDATION=1: %s is not installed", validation_layer);
	if (status == BATTEN_OK)
		status = create_instance(vulkan, validation);
	if (status == BATTEN_OK)
		status = open_best_device(vulkan);
	if (status != BATTEN_OK) {
		vulkan_device_close(vulkan);
		return status;
	}
	*out = vulkan;
	return BATTEN_OK;
}

batten_status vulkan_device_check(vulkan_device *vulkan)
{
	if (vulkan->validation_messages == 0)
		return BATTEN_OK;
	return batten_fail(vulkan->context, BATTEN_INTERNAL,
	                   "Vulkan validation: %u messages, first: %s", vulkan->validation_messages,
	                   vulkan->first_message);
}

void vulkan_device_close(vulkan_device *vulkan)
{
	if (!vulkan)
		return;
	if (vulkan->device && vulkan->DestroyDevice)
		vulkan->DestroyDevice(vulkan->device, NULL);
	if (vulkan->messenger)
		vulkan->DestroyDebugUtilsMessenger(vulkan->instance, vulkan->messenger, NULL);
	if (vulkan->instance && vulkan->DestroyInstance)
		vulkan->DestroyInstance(vulkan->instance, NULL);
	if (vulkan->library)
		(void)dlclose(vulkan->library);
	batten_release(vulkan->context, vulkan);
}
