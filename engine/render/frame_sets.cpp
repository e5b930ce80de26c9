// SPDX-License-Identifier: MIT
#include "engine/render/frame_sets.h"

#include "engine/gpu/uploader.h"
#include "engine/scene/surface/reflection_lobe.h"

#include <algorithm>
#include <span>

namespace limn::render {

// A technique's own pass binds up to five beside them.
static_assert(std::ranges::count(kFrameTypes, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) + 5 ==
              gpu::kStorageBuffers);

static gpu::Image uploadReflectionTable(gpu::Device& device) {
    gpu::Image image(device, {.width = kReflectionNodes,
                              .height = kReflectionNodes,
                              .layers = kReflectionLayers,
                              .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                              .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                              .array = true,
                              .name = "reflection table"});
    gpu::Uploader(device).image(image, std::as_bytes(reflectionTable()));
    return image;
}

FrameSets::FrameSets(gpu::Device& device)
    : m_device(device), m_layout(gpu::createSetLayout(device, kFrameTypes)),
      m_pool(gpu::createDescriptorPool(device, kFrameSlots, kFrameTypes)),
      m_reflections(uploadReflectionTable(device)),
      m_smooth(gpu::createSampler(device, {.mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                           .wrapU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                           .wrapV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE})),
      m_texels(gpu::createSampler(
          device, {.filter = VK_FILTER_NEAREST, .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST})) {
    for (VkDescriptorSet& set : m_sets)
        set = gpu::allocateSet(device, m_pool, m_layout);
}

void FrameSets::write(std::uint32_t slot, const gpu::Buffer& frame, const LightTable& lights,
                      const ShadowMaps& shadows, const SurfaceImages& surfaces,
                      const gpu::Buffer& lookupSnaps) {
    const VkDescriptorSet set = m_sets[slot];
    const auto buffer = [&](std::uint32_t binding, const gpu::Buffer& bound) {
        gpu::writeBuffer(m_device, set, binding, kFrameTypes[binding], bound.handle);
    };
    const auto image = [&](std::uint32_t binding, const gpu::Image& bound) {
        gpu::writeTexture(m_device, set, binding, bound.view, m_texels.handle);
    };
    buffer(FRAME_BLOCK, frame);
    buffer(FRAME_LIGHTS, lights.lights);
    buffer(FRAME_SHADOW_VIEWS, lights.shadowViews);
    gpu::writeTexture(m_device, set, FRAME_SHADOW_ATLAS, shadows.atlasView(), shadows.sampler());
    image(FRAME_SURFACE, surfaces.surface);
    image(FRAME_DEPTH, surfaces.depth);
    image(FRAME_EMITTED, surfaces.emitted);
    image(FRAME_RECEIVER, surfaces.receiver);
    gpu::writeTexture(m_device, set, FRAME_REFLECTIONS, m_reflections.view, m_smooth.handle);
    buffer(FRAME_LOOKUP_SNAPS,
           lookupSnaps ? lookupSnaps : lights.lights); // without, it is not read
}

} // namespace limn::render
