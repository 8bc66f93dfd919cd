/* What of a renderer does not change from picture to picture: render pass, shaders, pipeline. */
#ifndef BATTEN_PICTURE_PIPELINE_H
#define BATTEN_PICTURE_PIPELINE_H

#include "picture/vulkan_device.h"

/* Every Vulkan device draws this colour format with 1 and 4 samples (Vulkan 1.1, 36.1, 33.3). */
#define PICTURE_COLOUR_FORMAT VK_FORMAT_R8G8B8A8_UNORM
#define PICTURE_SAMPLES VK_SAMPLE_COUNT_4_BIT

/* Attachments of the render pass in this order. */
enum { ATTACHMENT_COLOUR, ATTACHMENT_DEPTH, ATTACHMENT_RESOLVED, ATTACHMENT_COUNT };

/* Push constants of shaders/curvature.* */
typedef struct draw_constants {
	float clip_from_hull[16];
	float light_side[4];
	float scale_lines[4];
	float thin;
} draw_constants;

typedef struct picture_pipeline {
	VkFormat depth_format;
	VkRenderPass pass;
	VkDescriptorSetLayout set_layout;
	VkPipelineLayout layout;
	VkPipeline pipeline;
} picture_pipeline;

/* On failure *pipeline holds what was made; destroy it all the same. Errors: DEVICE, MEMORY. */
batten_status picture_pipeline_create(const vulkan_device *vulkan, picture_pipeline *pipeline);
void picture_pipeline_destroy(const vulkan_device *vulkan, picture_pipeline *pipeline);

#endif
