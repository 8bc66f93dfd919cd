#include "picture/pipeline.h"

#include "picture/mesh.h"

#include <stddef.h>

#include "shaders/curvature.frag.h"
#include "shaders/curvature.vert.h"

/* The finest depth format the device draws to; the last is always there. */
static VkFormat choose_depth_format(const vulkan_device *vulkan)
{
	static const VkFormat formats[] = { VK_FORMAT_D32_SFLOAT, VK_FORMAT_X8_D24_UNORM_PACK32 };
	for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
		VkFormatProperties properties;
		vulkan->GetPhysicalDeviceFormatProperties(vulkan->physical, formats[i], &properties);
		if (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
			return formats[i];
	}
	return VK_FORMAT_D16_UNORM;
}

static VkAttachmentDescription attachment(VkFormat format, VkSampleCountFlagBits samples,
                                          VkAttachmentLoadOp load, VkAttachmentStoreOp store,
                                          VkImageLayout last)
{
	return (VkAttachmentDescription){
		.format = format,
		.samples = samples,
		.loadOp = load,
		.storeOp = store,
		.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
		.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
		.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
		.finalLayout = last,
	};
}

/* Draws with four samples a pixel and leaves the averaged picture ready to be copied. */
static VkResult create_pass(const vulkan_device *vulkan, picture_pipeline *pipeline)
{
	VkAttachmentDescription attachments[ATTACHMENT_COUNT] = {
		[ATTACHMENT_COLOUR] = attachment(
			PICTURE_COLOUR_FORMAT, PICTURE_SAMPLES, VK_ATTACHMENT_LOAD_OP_CLEAR,
			VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL),
		[ATTACHMENT_DEPTH] = attachment(
			pipeline->depth_format, PICTURE_SAMPLES, VK_ATTACHMENT_LOAD_OP_CLEAR,
			VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
		[ATTACHMENT_RESOLVED] = attachment(
			PICTURE_COLOUR_FORMAT, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
			VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
	};
	VkAttachmentReference colour = { ATTACHMENT_COLOUR, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL };
	VkAttachmentReference depth = { ATTACHMENT_DEPTH,
		                            VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL };
	VkAttachmentReference resolved = { ATTACHMENT_RESOLVED,
		                               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL };
	VkSubpassDescription subpass = {
		.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
		.colorAttachmentCount = 1,
		.pColorAttachments = &colour,
		.pResolveAttachments = &resolved,
		.pDepthStencilAttachment = &depth,
	};
	VkSubpassDependency copied = {
		.srcSubpass = 0,
		.dstSubpass = VK_SUBPASS_EXTERNAL,
		.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
		.dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
		.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
		.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT,
	};
	VkRenderPassCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
		.attachmentCount = ATTACHMENT_COUNT,
		.pAttachments = attachments,
		.subpassCount = 1,
		.pSubpasses = &subpass,
		.dependencyCount = 1,
		.pDependencies = &copied,
	};
	return vulkan->CreateRenderPass(vulkan->device, &create, NULL, &pipeline->pass);
}

/* One uniform buffer with the colours, one block of push constants for both stages. */
static VkResult create_layouts(const vulkan_device *vulkan, picture_pipeline *pipeline)
{
	VkDescriptorSetLayoutBinding colours = {
		.binding = 0,
		.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
		.descriptorCount = 1,
		.stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT,
	};
	VkDescriptorSetLayoutCreateInfo set = {
		.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
		.bindingCount = 1,
		.pBindings = &colours,
	};
	VkResult result = vulkan->CreateDescriptorSetLayout(vulkan->device, &set, NULL,
	                                                    &pipeline->set_layout);
	if (result != VK_SUCCESS) {
		pipeline->set_layout = VK_NULL_HANDLE;
		return result;
	}
	VkPushConstantRange constants = {
		.stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
		.size = sizeof(draw_constants),
	};
	VkPipelineLayoutCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
		.setLayoutCount = 1,
		.pSetLayouts = &pipeline->set_layout,
		.pushConstantRangeCount = 1,
		.pPushConstantRanges = &constants,
	};
	return vulkan->CreatePipelineLayout(vulkan->device, &create, NULL, &pipeline->layout);
}

static VkResult create_module(const vulkan_device *vulkan, const uint32_t *words, size_t size,
                              VkShaderModule *out)
{
	VkShaderModuleCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
		.codeSize = size,
		.pCode = words,
	};
	VkResult result = vulkan->CreateShaderModule(vulkan->device, &create, NULL, out);
	if (result != VK_SUCCESS)
		*out = VK_NULL_HANDLE;
	return result;
}

static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits kind, VkShaderModule module)
{
	return (VkPipelineShaderStageCreateInfo){
		.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
		.stage = kind,
		.module = module,
		.pName = "main",
	};
}

/* Everything but shaders and vertices: triangles, both faces, nearest wins, viewport at draw
 * time. */
static VkResult build(const vulkan_device *vulkan, picture_pipeline *pipeline,
                      const VkPipelineShaderStageCreateInfo *stages,
                      const VkPipelineVertexInputStateCreateInfo *vertices)
{
	VkPipelineInputAssemblyStateCreateInfo assembly = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
		.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
	};
	VkPipelineViewportStateCreateInfo viewport = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
		.viewportCount = 1,
		.scissorCount = 1,
	};
	VkPipelineRasterizationStateCreateInfo raster = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
		.polygonMode = VK_POLYGON_MODE_FILL,
		.cullMode = VK_CULL_MODE_NONE,
		.frontFace = VK_FRONT_FACE_CLOCKWISE,
		.lineWidth = 1.0F,
	};
	VkPipelineMultisampleStateCreateInfo samples = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
		.rasterizationSamples = PICTURE_SAMPLES,
	};
	VkPipelineDepthStencilStateCreateInfo depth = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
		.depthTestEnable = VK_TRUE,
		.depthWriteEnable = VK_TRUE,
		.depthCompareOp = VK_COMPARE_OP_LESS,
	};
	VkPipelineColorBlendAttachmentState opaque = { .colorWriteMask = 0xF };
	VkPipelineColorBlendStateCreateInfo blend = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
		.attachmentCount = 1,
		.pAttachments = &opaque,
	};
	VkDynamicState states[] = { VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR };
	VkPipelineDynamicStateCreateInfo dynamic = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
		.dynamicStateCount = 2,
		.pDynamicStates = states,
	};
	VkGraphicsPipelineCreateInfo create = {
		.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
		.stageCount = 2,
		.pStages = stages,
		.pVertexInputState = vertices,
		.pInputAssemblyState = &assembly,
		.pViewportState = &viewport,
		.pRasterizationState = &raster,
		.pMultisampleState = &samples,
		.pDepthStencilState = &depth,
		.pColorBlendState = &blend,
		.pDynamicState = &dynamic,
		.layout = pipeline->layout,
		.renderPass = pipeline->pass,
	};
	return vulkan->CreateGraphicsPipelines(vulkan->device, VK_NULL_HANDLE, 1, &create, NULL,
	                                       &pipeline->pipeline);
}

static VkResult create_pipeline(const vulkan_device *vulkan, picture_pipeline *pipeline)
{
	VkVertexInputBindingDescription binding = { .stride = sizeof(picture_vertex) };
	VkVertexInputAttributeDescription attributes[] = {
		{ 0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(picture_vertex, position) },
		{ 1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(picture_vertex, normal) },
		{ 2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(picture_vertex, value) }, /* and known */
		{ 3, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(picture_vertex, grid) },
	};
	VkPipelineVertexInputStateCreateInfo vertices = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
		.vertexBindingDescriptionCount = 1,
		.pVertexBindingDescriptions = &binding,
		.vertexAttributeDescriptionCount = 4,
		.pVertexAttributeDescriptions = attributes,
	};
	VkShaderModule modules[2] = { VK_NULL_HANDLE, VK_NULL_HANDLE };
	VkResult result = create_module(vulkan, shader_curvature_vert, sizeof shader_curvature_vert,
	                                &modules[0]);
	if (result == VK_SUCCESS)
		result = create_module(vulkan, shader_curvature_frag, sizeof shader_curvature_frag,
		                       &modules[1]);
	if (result == VK_SUCCESS) {
		VkPipelineShaderStageCreateInfo stages[] = {
			stage(VK_SHADER_STAGE_VERTEX_BIT, modules[0]),
			stage(VK_SHADER_STAGE_FRAGMENT_BIT, modules[1]),
		};
		result = build(vulkan, pipeline, stages, &vertices);
		if (result != VK_SUCCESS)
			pipeline->pipeline = VK_NULL_HANDLE;
	}
	for (int i = 0; i < 2; i++)
		if (modules[i])
			vulkan->DestroyShaderModule(vulkan->device, modules[i], NULL);
	return result;
}

batten_status picture_pipeline_create(const vulkan_device *vulkan, picture_pipeline *pipeline)
{
	*pipeline = (picture_pipeline){ .depth_format = choose_depth_format(vulkan) };
	VkResult result = create_pass(vulkan, pipeline);
	if (result != VK_SUCCESS) {
		pipeline->pass = VK_NULL_HANDLE;
		return vulkan_fail(vulkan, "vkCreateRenderPass", result);
	}
	result = create_layouts(vulkan, pipeline);
	if (result != VK_SUCCESS) {
		pipeline->layout = VK_NULL_HANDLE;
		return vulkan_fail(vulkan, "the layout of the pipeline", result);
	}
	result = create_pipeline(vulkan, pipeline);
	if (result != VK_SUCCESS)
		return vulkan_fail(vulkan, "the pipeline", result);
	return BATTEN_OK;
}

void picture_pipeline_destroy(const vulkan_device *vulkan, picture_pipeline *pipeline)
{
	if (pipeline->pipeline)
		vulkan->DestroyPipeline(vulkan->device, pipeline->pipeline, NULL);
	if (pipeline->layout)
		vulkan->DestroyPipelineLayout(vulkan->device, pipeline->layout, NULL);
	if (pipeline->set_layout)
		vulkan->DestroyDescriptorSetLayout(vulkan->device, pipeline->set_layout, NULL);
	if (pipeline->pass)
		vulkan->DestroyRenderPass(vulkan->device, pipeline->pass, NULL);
	*pipeline = (picture_pipeline){ 0 };
}
