#include "picture/vulkan_memory.h"

/* The first memory type of those allowed that has all properties, or UINT32_MAX. */
static uint32_t find_type(const vulkan_device *vulkan, uint32_t allowed,
                          VkMemoryPropertyFlags properties)
{
	for (uint32_t i = 0; i < vulkan->memory.memoryTypeCount; i++)
		if ((allowed >> i & 1U) &&
		    (vulkan->memory.memoryTypes[i].propertyFlags & properties) == properties)
			return i;
	return UINT32_MAX;
}

static VkResult allocate(const vulkan_device *vulkan, const VkMemoryRequirements *need,
                         VkMemoryPropertyFlags wished, VkMemoryPropertyFlags least,
                         VkDeviceMemory *memory)
{
	uint32_t type = find_type(vulkan, need->memoryTypeBits, wished);
	if (type == UINT32_MAX)
		type = find_type(vulkan, need->memoryTypeBits, least);
	if (type == UINT32_MAX)
		return VK_ERROR_OUT_OF_DEVICE_MEMORY;
	VkMemoryAllocateInfo create = {
		.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
		.allocationSize = need->size,
		.memoryTypeIndex = type,
	};
	VkResult result = vulkan->AllocateMemory(vulkan->device, &create, NULL, memory);
	if (result != VK_SUCCESS)
		*memory = VK_NULL_HANDLE;
	return result;
}

batten_status vulkan_buffer_create(const vulkan_device *vulkan, VkDeviceSize size,
                                   VkBufferUsageFlags usage, bool to_read, vulkan_buffer *out)
{
	vulkan_buffer buffer = { .size = size ? size : 1 };
	VkBufferCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
		.size = buffer.size,
		.usage = usage,
		.sharingMode = VK_SHARING_MODE_EXCLUSIVE,
	};
	/* Every device has a type with these two (Vulkan 1.1, 10.2); cached memory reads faster. */
	VkMemoryPropertyFlags least = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
	                              VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
	VkMemoryPropertyFlags wished = least | (to_read ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT : 0U);
	VkResult result = vulkan->CreateBuffer(vulkan->device, &create, NULL, &buffer.buffer);
	if (result == VK_SUCCESS) {
		VkMemoryRequirements need;
		vulkan->GetBufferMemoryRequirements(vulkan->device, buffer.buffer, &need);
		result = allocate(vulkan, &need, wished, least, &buffer.memory);
	} else {
		buffer.buffer = VK_NULL_HANDLE; /* undefined after a failure */
	}
	if (result == VK_SUCCESS)
		result = vulkan->BindBufferMemory(vulkan->device, buffer.buffer, buffer.memory, 0);
	void *mapped = NULL;
	if (result == VK_SUCCESS)
		result = vulkan->MapMemory(vulkan->device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &mapped);
	buffer.mapped = result == VK_SUCCESS ? mapped : NULL;
	if (result != VK_SUCCESS) {
		vulkan_buffer_destroy(vulkan, &buffer);
		return vulkan_fail(vulkan, "a buffer", result);
	}
	*out = buffer;
	return BATTEN_OK;
}

void vulkan_buffer_destroy(const vulkan_device *vulkan, vulkan_buffer *buffer)
{
	if (buffer->mapped)
		vulkan->UnmapMemory(vulkan->device, buffer->memory);
	if (buffer->buffer)
		vulkan->DestroyBuffer(vulkan->device, buffer->buffer, NULL);
	if (buffer->memory)
		vulkan->FreeMemory(vulkan->device, buffer->memory, NULL);
	*buffer = (vulkan_buffer){ 0 };
}

static VkResult create_view(const vulkan_device *vulkan, const vulkan_image_kind *kind,
                            vulkan_image *image)
{
	VkImageViewCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
		.image = image->image,
		.viewType = VK_IMAGE_VIEW_TYPE_2D,
		.format = kind->format,
		.subresourceRange = { .aspectMask = kind->aspect, .levelCount = 1, .layerCount = 1 },
	};
	VkResult result = vulkan->CreateImageView(vulkan->device, &create, NULL, &image->view);
	if (result != VK_SUCCESS)
		image->view = VK_NULL_HANDLE;
	return result;
}

batten_status vulkan_image_create(const vulkan_device *vulkan, const vulkan_image_kind *kind,
                                  vulkan_image *out)
{
	vulkan_image image = { 0 };
	VkImageCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
		.imageType = VK_IMAGE_TYPE_2D,
		.format = kind->format,
		.extent = { kind->width, kind->height, 1 },
		.mipLevels = 1,
		.arrayLayers = 1,
		.samples = kind->samples,
		.tiling = VK_IMAGE_TILING_OPTIMAL,
		.usage = kind->usage,
		.sharingMode = VK_SHARING_MODE_EXCLUSIVE,
		.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
	};
	VkResult result = vulkan->CreateImage(vulkan->device, &create, NULL, &image.image);
	if (result == VK_SUCCESS) {
		VkMemoryRequirements need;
		vulkan->GetImageMemoryRequirements(vulkan->device, image.image, &need);
		result = allocate(vulkan, &need, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, &image.memory);
	} else {
		image.image = VK_NULL_HANDLE;
	}
	if (result == VK_SUCCESS)
		result = vulkan->BindImageMemory(vulkan->device, image.image, image.memory, 0);
	if (result == VK_SUCCESS)
		result = create_view(vulkan, kind, &image);
	if (result != VK_SUCCESS) {
		vulkan_image_destroy(vulkan, &image);
		return vulkan_fail(vulkan, "an image", result);
	}
	*out = image;
	return BATTEN_OK;
}

void vulkan_image_destroy(const vulkan_device *vulkan, vulkan_image *image)
{
	if (image->view)
		vulkan->DestroyImageView(vulkan->device, image->view, NULL);
	if (image->image)
		vulkan->DestroyImage(vulkan->device, image->image, NULL);
	if (image->memory)
		vulkan->FreeMemory(vulkan->device, image->memory, NULL);
	*image = (vulkan_image){ 0 };
}
