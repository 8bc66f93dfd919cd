/* Vulkan, opened at run time: the loader, an instance, the best device and its calls. */
#ifndef BATTEN_PICTURE_VULKAN_DEVICE_H
#define BATTEN_PICTURE_VULKAN_DEVICE_H

#include "core/context.h"

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

/* Calls that need no instance, those of the instance, those of the device. */
#define VULKAN_LOADER_CALLS(X)                                                                     \
	X(CreateInstance)                                                                              \
	X(EnumerateInstanceExtensionProperties)                                                        \
	X(EnumerateInstanceLayerProperties)
#define VULKAN_INSTANCE_CALLS(X)                                                                   \
	X(DestroyInstance)                                                                             \
	X(EnumeratePhysicalDevices)                                                                    \
	X(GetPhysicalDeviceProperties)                                                                 \
	X(GetPhysicalDeviceQueueFamilyProperties)                                                      \
	X(GetPhysicalDeviceMemoryProperties)                                                           \
	X(GetPhysicalDeviceFormatProperties)                                                           \
	X(CreateDevice)                                                                                \
	X(GetDeviceProcAddr)
#define VULKAN_DEVICE_CALLS(X)                                                                     \
	X(DestroyDevice)                                                                               \
	X(GetDeviceQueue)                                                                              \
	X(DeviceWaitIdle)                                                                              \
	X(QueueSubmit)                                                                                 \
	X(AllocateMemory)                                                                              \
	X(FreeMemory)                                                                                  \
	X(MapMemory)                                                                                   \
	X(UnmapMemory)                                                                                 \
	X(CreateBuffer)                                                                                \
	X(DestroyBuffer)                                                                               \
	X(GetBufferMemoryRequirements)                                                                 \
	X(BindBufferMemory)                                                                            \
	X(CreateImage)                                                                                 \
	X(DestroyImage)                                                                                \
	X(GetImageMemoryRequirements)                                                                  \
	X(BindImageMemory)                                                                             \
	X(CreateImageView)                                                                             \
	X(DestroyImageView)                                                                            \
	X(CreateRenderPass)                                                                            \
	X(DestroyRenderPass)                                                                           \
	X(CreateFramebuffer)                                                                           \
	X(DestroyFramebuffer)                                                                          \
	X(CreateShaderModule)                                                                          \
	X(DestroyShaderModule)                                                                         \
	X(CreateDescriptorSetLayout)                                                                   \
	X(DestroyDescriptorSetLayout)                                                                  \
	X(CreateDescriptorPool)                                                                        \
	X(DestroyDescriptorPool)                                                                       \
	X(AllocateDescriptorSets)                                                                      \
	X(UpdateDescriptorSets)                                                                        \
	X(CreatePipelineLayout)                                                                        \
	X(DestroyPipelineLayout)                                                                       \
	X(CreateGraphicsPipelines)                                                                     \
	X(DestroyPipeline)                                                                             \
	X(CreateCommandPool)                                                                           \
	X(DestroyCommandPool)                                                                          \
	X(ResetCommandPool)                                                                            \
	X(AllocateCommandBuffers)                                                                      \
	X(BeginCommandBuffer)                                                                          \
	X(EndCommandBuffer)                                                                            \
	X(CmdBeginRenderPass)                                                                          \
	X(CmdEndRenderPass)                                                                            \
	X(CmdBindPipeline)                                                                             \
	X(CmdBindDescriptorSets)                                                                       \
	X(CmdBindVertexBuffers)                                                                        \
	X(CmdBindIndexBuffer)                                                                          \
	X(CmdSetViewport)                                                                              \
	X(CmdSetScissor)                                                                               \
	X(CmdPushConstants)                                                                            \
	X(CmdDrawIndexed)                                                                              \
	X(CmdPipelineBarrier)                                                                          \
	X(CmdCopyImageToBuffer)                                                                        \
	X(CreateFence)                                                                                 \
	X(DestroyFence)                                                                                \
	X(ResetFences)                                                                                 \
	X(WaitForFences)

typedef struct vulkan_device {
	batten_context *context;
	void *library;
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr;
#define VULKAN_MEMBER(name) PFN_vk##name name;
	VULKAN_LOADER_CALLS(VULKAN_MEMBER)
	VULKAN_INSTANCE_CALLS(VULKAN_MEMBER)
	VULKAN_DEVICE_CALLS(VULKAN_MEMBER)
#undef VULKAN_MEMBER
	PFN_vkCreateDebugUtilsMessengerEXT CreateDebugUtilsMessenger;
	PFN_vkDestroyDebugUtilsMessengerEXT DestroyDebugUtilsMessenger;
	VkInstance instance;
	VkDebugUtilsMessengerEXT messenger;
	unsigned validation_messages; /* with BATTEN_VULKAN_VALIDATION=1 */
	char first_message[512];
	VkPhysicalDevice physical;
	VkPhysicalDeviceProperties properties;
	VkPhysicalDeviceMemoryProperties memory;
	uint32_t queue_family;
	VkDevice device;
	VkQueue queue;
} vulkan_device;

/* Opens the best device that can draw: discrete before integrated before virtual before CPU. With
 * BATTEN_VULKAN_VALIDATION=1 in the environment the Khronos validation layer watches every call.
 * Errors: DEVICE (no loader, no driver, no device), MISSING (validation asked for but no layer),
 * MEMORY. */
batten_status vulkan_device_open(batten_context *context, vulkan_device **out);
/* INTERNAL when the validation layer complained, else OK. */
batten_status vulkan_device_check(vulkan_device *vulkan);
void vulkan_device_close(vulkan_device *vulkan);

/* Records "what: the Vulkan code" and gives DEVICE, or MEMORY where memory ran out. */
batten_status vulkan_fail(const vulkan_device *vulkan, const char *what, VkResult result);

#endif
