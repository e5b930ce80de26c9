// SPDX-License-Identifier: MIT
#include "engine/render/gpu_field.h"

#include "engine/field/indirect_field.h"

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

} // namespace limn
