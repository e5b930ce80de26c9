// SPDX-License-Identifier: MIT
#include "engine/render/passes/sky_pass.h"

#include "engine/core/log.h"
#include "engine/gpu/uploader.h"
#include "engine/math/packing.h"
#include "engine/render/passes/fullscreen.h"
#include "engine/render/passes/geometry_passes.h"
#include "shaders/shared/gpu_sky.h"
#include "shaders/viewport/sky.frag.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

namespace limn::render {

using shared::GpuSky;

static gpu::Image uploadPanorama(gpu::Device& device, const ImageF& pixels) {
    std::vector<std::uint32_t> packed(pixels.rgb.size());
    std::ranges::transform(pixels.rgb, packed.begin(), packRgb9e5);
    gpu::Image image(device, {.width = pixels.width,
                              .height = pixels.height,
                              .format = VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
                              .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                              .name = "sky"});
    gpu::Uploader(device).image(image, std::as_bytes(std::span(packed)));
    return image;
}

SkyPass::SkyPass(gpu::Device& device, VkDescriptorSetLayout frameLayout)
    : m_device(device), m_texture(device) {
    const std::array layouts = {frameLayout, m_texture.layout()};
    m_layout = gpu::createPipelineLayout(device, layouts, sizeof(GpuSky), "sky");
    m_pipeline = gpu::createGraphicsPipeline(
        device, fullscreenDesc(kSkyFrag, m_layout.handle, kLinearFormat, "sky"));
    m_panorama = uploadPanorama(device, {1, 1, {glm::vec3(0)}});
}

void SkyPass::set(const Sky& sky) {
    m_sky = sky;
    if (!sky.showsImage() || sky.panorama == m_uploaded)
        return;
    m_uploaded = sky.panorama;
    const ImageF& pixels = sky.panorama->pixels;
    const std::uint32_t maxSize = m_device.properties.limits.maxImageDimension2D;
    if (pixels.width <= maxSize && pixels.height <= maxSize) {
        m_panorama = uploadPanorama(m_device, pixels);
        return;
    }
    logWarning(fmt::format("{}: {} x {} pixels are more than the device can show ({}): no sky is "
                           "seen, though it lights",
                           sky.image, pixels.width, pixels.height, maxSize));
    m_panorama = uploadPanorama(m_device, {1, 1, {glm::vec3(0)}});
}

bool SkyPass::active() const {
    return m_sky.kind == SkyKind::Gradient || m_sky.showsImage();
}

void SkyPass::record(VkCommandBuffer cmd, VkDescriptorSet frameSet, std::uint32_t slot) {
    const std::array sets = {frameSet, m_texture.set(slot)};
    const GpuSky push{.zenith = m_sky.radiance,
                      .strength = m_sky.strength,
                      .horizon = m_sky.horizon,
                      .turn = m_sky.rotation / (2 * std::numbers::pi_v<float>),
                      .ground = m_sky.ground,
                      .image = m_sky.showsImage()};
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0,
                            std::uint32_t(sets.size()), sets.data(), 0, nullptr);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof push, &push);
    drawFullscreen(cmd, m_pipeline.handle);
}

} // namespace limn::render
