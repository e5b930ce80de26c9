// SPDX-License-Identifier: MIT
#include "engine/render/gpu_field.h"

#include "engine/field/field_packing.h"
#include "engine/gpu/barrier.h"
#include "engine/gpu/storage_maker.h"

#include <algorithm>

namespace limn {

gpu::Image createFieldLightmap(gpu::Device& device, std::uint32_t width, std::uint32_t height,
                               std::uint32_t layers, VkImageUsageFlags written) {
    return {device,
            {.width = std::max(width, 1U),
             .height = std::max(height, 1U),
             .layers = layers,
             .format = VK_FORMAT_R16G16B16A16_SFLOAT,
             .usage = VK_IMAGE_USAGE_SAMPLED_BIT | written,
             .array = true,
             .name = "lightmap"}};
}

static void clear(gpu::Device& device, const gpu::Image& lightmap) {
    const VkCommandBuffer cmd = device.begin("clear lightmap");
    const VkImage image = lightmap.handle;
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kUndefined, gpu::kTransferWrite);
    const VkClearColorValue black{};
    const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0,
                                        VK_REMAINING_ARRAY_LAYERS};
    vkCmdClearColorImage(cmd, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &whole);
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kTransferWrite,
                      gpu::kFragmentRead);
    device.submit(cmd);
}

std::shared_ptr<GpuField> createWrittenField(gpu::Device& device, const WrittenFieldDesc& desc) {
    const std::uint32_t layers = fieldLayers(desc.bands, desc.chroma);
    auto field = std::make_shared<GpuField>();
    field->bands = desc.bands;
    field->chroma = desc.chroma;
    field->lightmap =
        createFieldLightmap(device, desc.lightmapWidth, desc.lightmapHeight, layers,
                            VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    field->gridSize = desc.gridSize;
    field->gridBounds = desc.gridBounds;
    const VkDeviceSize cells =
        VkDeviceSize(desc.gridSize.x) * desc.gridSize.y * desc.gridSize.z * layers;
    field->grid = {device,
                   {.size = std::max<VkDeviceSize>(cells, 1) * sizeof(glm::u16vec4),
                    .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                    .name = "grid cells"}};
    field->gridDepth = desc.gridDepth;
    field->continues = desc.continues;
    gpu::clearBuffers(device, {field->grid.handle});
    clear(device, field->lightmap);
    return field;
}

void beginFieldWrite(VkCommandBuffer cmd, const GpuField& field) {
    gpu::imageBarrier(cmd, field.lightmap.handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kFragmentRead,
                      gpu::kComputeWrite);
    gpu::memoryBarrier(cmd, gpu::kAllReads, gpu::kComputeWrite); // of the grid
}

void endFieldWrite(VkCommandBuffer cmd, const GpuField& field) {
    gpu::imageBarrier(cmd, field.lightmap.handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kComputeWrite,
                      gpu::kFragmentRead);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
}

IndirectField readField(gpu::Device& device, const GpuField& field) {
    IndirectField out;
    out.bands = field.bands;
    out.chromaBands = field.chroma;
    out.lightmapWidth = field.lightmap.width;
    out.lightmapHeight = field.lightmap.height;
    out.continues = field.continues;
    out.gridSize = field.gridSize;
    out.gridBounds = field.gridBounds;
    const std::uint32_t layers = fieldLayers(field.bands, field.chroma);
    std::vector<glm::u16vec4> packed(std::size_t(out.lightmapWidth) * out.lightmapHeight * layers);
    gpu::readImage(device, field.lightmap, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                   out.lightmapWidth, out.lightmapHeight, std::as_writable_bytes(std::span(packed)),
                   layers);
    out.lightmap = unpackField(packed, field.bands, field.chroma, field.scale);
    packed.resize(out.cells() * layers);
    if (!packed.empty())
        gpu::readBuffer(device, field.grid, std::as_writable_bytes(std::span(packed)));
    out.grid = unpackField(packed, field.bands, field.chroma, field.scale);
    return out;
}

} // namespace limn
