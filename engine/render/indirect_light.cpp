// SPDX-License-Identifier: MIT
#include "engine/render/indirect_light.h"

#include "engine/core/log.h"
#include "engine/gpu/uploader.h"

#include <array>
#include <cassert>

#include <fmt/format.h>

namespace limn::render {

static gpu::Image lightmapImage(gpu::Device& device, std::uint32_t width, std::uint32_t height) {
    return {device,
            {.width = width,
             .height = height,
             .layers = IndirectField::kCoefficients,
             .format = VK_FORMAT_R32G32B32A32_SFLOAT,
             .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
             .array = true,
             .name = "lightmap"}};
}

static std::span<const std::byte> bytesOf(std::span<const glm::vec4> v) {
    return std::as_bytes(v);
}

IndirectLight createIndirectLight(gpu::Device& device) {
    IndirectLight out;
    const std::array<glm::vec4, IndirectField::kCoefficients> black{};
    gpu::Uploader uploader(device);
    out.lightmap = lightmapImage(device, 1, 1);
    uploader.image(out.lightmap, bytesOf(black));
    out.grid = uploader.buffer(bytesOf(black), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "no grid");
    return out;
}

static void updateLightmap(gpu::Device& device, gpu::Uploader& uploader, IndirectLight& target,
                           const IndirectField& field) {
    const std::uint32_t w = field.lightmapWidth, h = field.lightmapHeight;
    target.hasLightmap = w > 0 && h > 0;
    if (!target.hasLightmap)
        return;
    assert(field.lightmap.size() == std::size_t(w) * h * IndirectField::kCoefficients);
    // A frame in flight may still sample the old one, so the new one is another image.
    target.lightmap = lightmapImage(device, w, h);
    uploader.image(target.lightmap, bytesOf(field.lightmap));
}

bool updateIndirectLight(gpu::Device& device, IndirectLight& target, const IndirectField& field) {
    if (field.version == target.version)
        return false;
    target.version = field.version;
    gpu::Uploader uploader(device);
    updateLightmap(device, uploader, target, field);
    target.gridBounds = field.gridBounds;
    target.gridSize = field.gridSize;
    const std::size_t bytes = field.grid.size() * sizeof(glm::vec4);
    if (bytes > device.properties.limits.maxStorageBufferRange) {
        logWarning(
            fmt::format("the grid of {} MiB is larger than this device can bind: no indirect "
                        "light without lightmap",
                        bytes >> 20));
        target.gridSize = glm::uvec3(0);
    }
    if (bytes == 0)
        target.gridSize = glm::uvec3(0);
    if (target.gridSize.x > 0)
        target.grid =
            uploader.buffer(bytesOf(field.grid), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "grid");
    return true;
}

void describeGrid(const IndirectLight& light, shared::GpuFrame& frame) {
    if (!light.hasGrid())
        return;
    const glm::vec3 size = glm::max(light.gridBounds.size(), glm::vec3(1e-20f));
    frame.gridLower = light.gridBounds.lower;
    frame.gridSize = light.gridSize;
    frame.gridScale = glm::vec3(light.gridSize) / size;
    frame.gridCells = light.gridSize.x * light.gridSize.y * light.gridSize.z;
}

} // namespace limn::render
