#include "picture/renderer.h"

#include "picture/pipeline.h"
#include "picture/vulkan_memory.h"

#include <string.h>

/* A picture that takes longer than this hangs. */
static const uint64_t patience_ns = 120U * UINT64_C(1000000000);

struct picture_renderer {
	vulkan_device *vulkan;
	picture_pipeline pipeline;
	vulkan_buffer colours;
	VkDescriptorPool descriptors;
	VkDescriptorSet set;
	VkCommandPool commands;
	VkCommandBuffer command;
	VkFence done;
};

/* What one picture needs. */
typedef struct draw_canvas {
	vulkan_image images[ATTACHMENT_COUNT];
	VkFramebuffer framebuffer;
	vulkan_buffer vertices, indices, pixels;
} draw_canvas;

static VkResult create_descriptors(picture_renderer *renderer)
{
	vulkan_device *vulkan = renderer->vulkan;
	VkDescriptorPoolSize size = { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1 };
	VkDescriptorPoolCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
		.maxSets = 1,
		.poolSizeCount = 1,
		.pPoolSizes = &size,
	};
	VkResult result = vulkan->CreateDescriptorPool(vulkan->device, &create, NULL,
	                                               &renderer->descriptors);
	if (result != VK_SUCCESS) {
		renderer->descriptors = VK_NULL_HANDLE;
		return result;
	}
	VkDescriptorSetAllocateInfo allocate = {
		.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
		.descriptorPool = renderer->descriptors,
		.descriptorSetCount = 1,
		.pSetLayouts = &renderer->pipeline.set_layout,
	};
	result = vulkan->AllocateDescriptorSets(vulkan->device, &allocate, &renderer->set);
	if (result != VK_SUCCESS)
		return result;
	VkDescriptorBufferInfo colours = { renderer->colours.buffer, 0, VK_WHOLE_SIZE };
	VkWriteDescriptorSet write = {
		.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
		.dstSet = renderer->set,
		.descriptorCount = 1,
		.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
		.pBufferInfo = &colours,
	};
	vulkan->UpdateDescriptorSets(vulkan->device, 1, &write, 0, NULL);
	return VK_SUCCESS;
}

static VkResult create_commands(picture_renderer *renderer)
{
	vulkan_device *vulkan = renderer->vulkan;
	VkCommandPoolCreateInfo pool = {
		.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
		.queueFamilyIndex = vulkan->queue_family,
	};
	VkResult result = vulkan->CreateCommandPool(vulkan->device, &pool, NULL, &renderer->commands);
	if (result != VK_SUCCESS) {
		renderer->commands = VK_NULL_HANDLE;
		return result;
	}
	VkCommandBufferAllocateInfo allocate = {
		.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
		.commandPool = renderer->commands,
		.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
		.commandBufferCount = 1,
	};
	result = vulkan->AllocateCommandBuffers(vulkan->device, &allocate, &renderer->command);
	if (result != VK_SUCCESS)
		return result;
	VkFenceCreateInfo fence = { .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO };
	result = vulkan->CreateFence(vulkan->device, &fence, NULL, &renderer->done);
	if (result != VK_SUCCESS)
		renderer->done = VK_NULL_HANDLE;
	return result;
}

static batten_status prepare(picture_renderer *renderer)
{
	vulkan_device *vulkan = renderer->vulkan;
	batten_status status = picture_pipeline_create(vulkan, &renderer->pipeline);
	if (status == BATTEN_OK)
		status = vulkan_buffer_create(vulkan, sizeof(picture_colour_map),
		                              VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, false,
		                              &renderer->colours);
	if (status != BATTEN_OK)
		return status;
	VkResult result = create_descriptors(renderer);
	if (result == VK_SUCCESS)
		result = create_commands(renderer);
	return result == VK_SUCCESS ? BATTEN_OK : vulkan_fail(vulkan, "preparing to draw", result);
}

batten_status picture_renderer_create(batten_context *context, picture_renderer **out)
{
	picture_renderer *renderer = batten_allocate(context, 1, sizeof *renderer);
	if (!renderer)
		return BATTEN_MEMORY;
	batten_status status = vulkan_device_open(context, &renderer->vulkan);
	if (status != BATTEN_OK) {
		batten_release(context, renderer);
		return status;
	}
	status = prepare(renderer);
	if (status != BATTEN_OK) {
		picture_renderer_destroy(renderer);
		return status;
	}
	*out = renderer;
	return BATTEN_OK;
}

void picture_renderer_destroy(picture_renderer *renderer)
{
	if (!renderer)
		return;
	vulkan_device *vulkan = renderer->vulkan;
	batten_context *context = vulkan->context;
	(void)vulkan->DeviceWaitIdle(vulkan->device);
	if (renderer->done)
		vulkan->DestroyFence(vulkan->device, renderer->done, NULL);
	if (renderer->commands)
		vulkan->DestroyCommandPool(vulkan->device, renderer->commands, NULL);
	if (renderer->descriptors)
		vulkan->DestroyDescriptorPool(vulkan->device, renderer->descriptors, NULL);
	vulkan_buffer_destroy(vulkan, &renderer->colours);
	picture_pipeline_destroy(vulkan, &renderer->pipeline);
	vulkan_device_close(vulkan);
	batten_release(context, renderer);
}

const char *picture_renderer_name(const picture_renderer *renderer)
{
	return renderer->vulkan->properties.deviceName;
}

static batten_status create_images(const picture_renderer *renderer, const picture_scene *scene,
                                   draw_canvas *canvas)
{
	const vulkan_image_kind kinds[ATTACHMENT_COUNT] = {
		[ATTACHMENT_COLOUR] = { scene->width, scene->height, PICTURE_COLOUR_FORMAT, PICTURE_SAMPLES,
		                        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT },
		[ATTACHMENT_DEPTH] = { scene->width, scene->height, renderer->pipeline.depth_format,
		                       PICTURE_SAMPLES, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
		                       VK_IMAGE_ASPECT_DEPTH_BIT },
		[ATTACHMENT_RESOLVED] = { scene->width, scene->height, PICTURE_COLOUR_FORMAT,
		                          VK_SAMPLE_COUNT_1_BIT,
		                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
		                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
		                          VK_IMAGE_ASPECT_COLOR_BIT },
	};
	batten_status status = BATTEN_OK;
	for (size_t i = 0; status == BATTEN_OK && i < ATTACHMENT_COUNT; i++)
		status = vulkan_image_create(renderer->vulkan, &kinds[i], &canvas->images[i]);
	return status;
}

static batten_status create_framebuffer(const picture_renderer *renderer,
                                        const picture_scene *scene, draw_canvas *canvas)
{
	VkImageView views[ATTACHMENT_COUNT];
	for (size_t i = 0; i < ATTACHMENT_COUNT; i++)
		views[i] = canvas->images[i].view;
	VkFramebufferCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
		.renderPass = renderer->pipeline.pass,
		.attachmentCount = ATTACHMENT_COUNT,
		.pAttachments = views,
		.width = scene->width,
		.height = scene->height,
		.layers = 1,
	};
	const vulkan_device *vulkan = renderer->vulkan;
	VkResult result = vulkan->CreateFramebuffer(vulkan->device, &create, NULL,
	                                            &canvas->framebuffer);
	if (result == VK_SUCCESS)
		return BATTEN_OK;
	canvas->framebuffer = VK_NULL_HANDLE;
	return vulkan_fail(vulkan, "vkCreateFramebuffer", result);
}

static batten_status fill_canvas(const picture_renderer *renderer, const picture_scene *scene,
                                 draw_canvas *canvas)
{
	const vulkan_device *vulkan = renderer->vulkan;
	const VkPhysicalDeviceLimits *limits = &vulkan->properties.limits;
	uint32_t largest = scene->width > scene->height ? scene->width : scene->height;
	if (largest > limits->maxImageDimension2D || largest > limits->maxFramebufferWidth ||
	    largest > limits->maxFramebufferHeight)
		return batten_fail(vulkan->context, BATTEN_DEVICE,
		                   "%s draws no picture of %u x %u pixels, at most %u",
		                   vulkan->properties.deviceName, scene->width, scene->height,
		                   limits->maxImageDimension2D);
	const picture_mesh *mesh = scene->mesh;
	if (mesh->vertex_count > limits->maxDrawIndexedIndexValue)
		return batten_fail(vulkan->context, BATTEN_DEVICE, "%s draws at most %u vertices",
		                   vulkan->properties.deviceName, limits->maxDrawIndexedIndexValue);
	VkDeviceSize vertices = (VkDeviceSize)mesh->vertex_count * sizeof *mesh->vertices;
	VkDeviceSize indices = (VkDeviceSize)mesh->index_count * sizeof *mesh->indices;
	batten_status status = create_images(renderer, scene, canvas);
	if (status == BATTEN_OK)
		status = create_framebuffer(renderer, scene, canvas);
	if (status == BATTEN_OK)
		status = vulkan_buffer_create(vulkan, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, false,
		                              &canvas->vertices);
	if (status == BATTEN_OK)
		status = vulkan_buffer_create(vulkan, indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, false,
		                              &canvas->indices);
	if (status == BATTEN_OK)
		status = vulkan_buffer_create(vulkan, (VkDeviceSize)scene->width * scene->height * 4,
		                              VK_BUFFER_USAGE_TRANSFER_DST_BIT, true, &canvas->pixels);
	if (status != BATTEN_OK)
		return status;
	memcpy(canvas->vertices.mapped, mesh->vertices, (size_t)vertices);
	memcpy(canvas->indices.mapped, mesh->indices, (size_t)indices);
	memcpy(renderer->colours.mapped, scene->colours, sizeof *scene->colours);
	return BATTEN_OK;
}

static void destroy_canvas(const picture_renderer *renderer, draw_canvas *canvas)
{
	const vulkan_device *vulkan = renderer->vulkan;
	if (canvas->framebuffer)
		vulkan->DestroyFramebuffer(vulkan->device, canvas->framebuffer, NULL);
	for (size_t i = 0; i < ATTACHMENT_COUNT; i++)
		vulkan_image_destroy(vulkan, &canvas->images[i]);
	vulkan_buffer_destroy(vulkan, &canvas->vertices);
	vulkan_buffer_destroy(vulkan, &canvas->indices);
	vulkan_buffer_destroy(vulkan, &canvas->pixels);
}

/* Both sides of the hull in one view. */
static void record_view(const picture_renderer *renderer, const picture_scene *scene,
                        const picture_view *view)
{
	const vulkan_device *vulkan = renderer->vulkan;
	VkCommandBuffer command = renderer->command;
	VkViewport viewport = {
		.x = (float)view->left,
		.y = (float)view->top,
		.width = (float)view->width,
		.height = (float)view->height,
		.maxDepth = 1.0F,
	};
	VkRect2D scissor = { { (int32_t)view->left, (int32_t)view->top },
		                 { view->width, view->height } };
	vulkan->CmdSetViewport(command, 0, 1, &viewport);
	vulkan->CmdSetScissor(command, 0, 1, &scissor);
	draw_constants constants = {
		.light_side = { view->light[0], view->light[1], view->light[2], 1.0F },
		.scale_lines = { (float)(1.0 / scene->scale_per_m), scene->line_strength,
		                 scene->line_width_px, scene->shading },
		.thin = (float)(1e-4 * scene->mesh->high[1]),
	};
	memcpy(constants.clip_from_hull, view->clip_from_hull, sizeof constants.clip_from_hull);
	for (int side = 0; side < 2; side++) {
		constants.light_side[3] = side == 0 ? 1.0F : -1.0F;
		vulkan->CmdPushConstants(command, renderer->pipeline.layout,
		                         VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
		                         sizeof constants, &constants);
		vulkan->CmdDrawIndexed(command, (uint32_t)scene->mesh->index_count, 1, 0, 0, 0);
	}
}

static void record_pass(const picture_renderer *renderer, const picture_scene *scene,
                        const draw_canvas *canvas)
{
	const vulkan_device *vulkan = renderer->vulkan;
	VkCommandBuffer command = renderer->command;
	const float *back = scene->background;
	VkClearValue clear[ATTACHMENT_COUNT] = {
		[ATTACHMENT_COLOUR] = { .color = { .float32 = { back[0], back[1], back[2], 1.0F } } },
		[ATTACHMENT_DEPTH] = { .depthStencil = { .depth = 1.0F } },
	};
	VkRenderPassBeginInfo begin = {
		.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
		.renderPass = renderer->pipeline.pass,
		.framebuffer = canvas->framebuffer,
		.renderArea = { .extent = { scene->width, scene->height } },
		.clearValueCount = ATTACHMENT_COUNT,
		.pClearValues = clear,
	};
	VkDeviceSize offset = 0;
	vulkan->CmdBeginRenderPass(command, &begin, VK_SUBPASS_CONTENTS_INLINE);
	vulkan->CmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, renderer->pipeline.pipeline);
	vulkan->CmdBindDescriptorSets(command, VK_PIPELINE_BIND_POINT_GRAPHICS,
	                              renderer->pipeline.layout, 0, 1, &renderer->set, 0, NULL);
	vulkan->CmdBindVertexBuffers(command, 0, 1, &canvas->vertices.buffer, &offset);
	vulkan->CmdBindIndexBuffer(command, canvas->indices.buffer, 0, VK_INDEX_TYPE_UINT32);
	for (size_t i = 0; i < scene->view_count; i++)
		record_view(renderer, scene, &scene->views[i]);
	vulkan->CmdEndRenderPass(command);
}

/* The resolved picture goes to a buffer the host reads. */
static void record_copy(const picture_renderer *renderer, const picture_scene *scene,
                        const draw_canvas *canvas)
{
	const vulkan_device *vulkan = renderer->vulkan;
	VkBufferImageCopy copy = {
		.imageSubresource = { .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1 },
		.imageExtent = { scene->width, scene->height, 1 },
	};
	vulkan->CmdCopyImageToBuffer(renderer->command, canvas->images[ATTACHMENT_RESOLVED].image,
	                             VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, canvas->pixels.buffer, 1,
	                             &copy);
	VkBufferMemoryBarrier to_host = {
		.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
		.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
		.dstAccessMask = VK_ACCESS_HOST_READ_BIT,
		.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
		.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
		.buffer = canvas->pixels.buffer,
		.size = VK_WHOLE_SIZE,
	};
	vulkan->CmdPipelineBarrier(renderer->command, VK_PIPELINE_STAGE_TRANSFER_BIT,
	                           VK_PIPELINE_STAGE_HOST_BIT, 0, 0, NULL, 1, &to_host, 0, NULL);
}

static VkResult draw(const picture_renderer *renderer, const picture_scene *scene,
                     const draw_canvas *canvas)
{
	const vulkan_device *vulkan = renderer->vulkan;
	VkCommandBufferBeginInfo begin = {
		.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
		.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
	};
	VkResult result = vulkan->ResetCommandPool(vulkan->device, renderer->commands, 0);
	if (result == VK_SUCCESS)
		result = vulkan->ResetFences(vulkan->device, 1, &renderer->done);
	if (result == VK_SUCCESS)
		result = vulkan->BeginCommandBuffer(renderer->command, &begin);
	if (result != VK_SUCCESS)
		return result;
	record_pass(renderer, scene, canvas);
	record_copy(renderer, scene, canvas);
	result = vulkan->EndCommandBuffer(renderer->command);
	VkSubmitInfo submit = {
		.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
		.commandBufferCount = 1,
		.pCommandBuffers = &renderer->command,
	};
	if (result == VK_SUCCESS)
		result = vulkan->QueueSubmit(vulkan->queue, 1, &submit, renderer->done);
	if (result == VK_SUCCESS)
		result = vulkan->WaitForFences(vulkan->device, 1, &renderer->done, VK_TRUE, patience_ns);
	return result;
}

batten_status picture_renderer_draw(picture_renderer *renderer, const picture_scene *scene,
                                    uint8_t *rgba)
{
	vulkan_device *vulkan = renderer->vulkan;
	draw_canvas canvas = { 0 };
	batten_status status = fill_canvas(renderer, scene, &canvas);
	if (status == BATTEN_OK) {
		VkResult result = draw(renderer, scene, &canvas);
		if (result != VK_SUCCESS) {
			(void)vulkan->DeviceWaitIdle(vulkan->device);
			status = vulkan_fail(vulkan, "drawing", result);
		}
	}
	if (status == BATTEN_OK && canvas.pixels.mapped)
		memcpy(rgba, canvas.pixels.mapped, (size_t)canvas.pixels.size);
	destroy_canvas(renderer, &canvas);
	return status == BATTEN_OK ? vulkan_device_check(vulkan) : status;
}
