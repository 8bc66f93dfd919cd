/* Buffers and images of a Vulkan device, each with its own memory. */
#ifndef BATTEN_PICTURE_VULKAN_MEMORY_H
#define BATTEN_PICTURE_VULKAN_MEMORY_H

#include "picture/vulkan_device.h"

typedef struct vulkan_buffer {
	VkBuffer buffer;
	VkDeviceMemory memory;
	void *mapped; /* stays mapped, coherent with the host */
	VkDeviceSize size;
} vulkan_buffer;

typedef struct vulkan_image {
	VkImage image;
	VkDeviceMemory memory;
	VkImageView view;
} vulkan_image;

/* A buffer the host sees; size 0 is taken as 1. to_read: the host reads it. Errors: DEVICE,
 * MEMORY. */
batten_status vulkan_buffer_create(const vulkan_device *vulkan, VkDeviceSize size,
                                   VkBufferUsageFlags usage, bool to_read, vulkan_buffer *out);
void vulkan_buffer_destroy(const vulkan_device *vulkan, vulkan_buffer *buffer);

typedef struct vulkan_image_kind {
	uint32_t width, height;
	VkFormat format;
	VkSampleCountFlagBits samples;
	VkImageUsageFlags usage;
	VkImageAspectFlags aspect;
} vulkan_image_kind;
batten_status vulkan_image_create(const vulkan_device *vulkan, const vulkan_image_kind *kind,
                                  vulkan_image *out);
void vulkan_image_destroy(const vulkan_device *vulkan, vulkan_image *image);

#endif
