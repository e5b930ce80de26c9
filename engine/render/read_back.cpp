// SPDX-License-Identifier: MIT
#include "engine/render/read_back.h"

#include "engine/render/passes/geometry_passes.h"

#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace limn::render {

constexpr VkImageLayout kLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

ImageF readLinearImage(gpu::Device& device, const gpu::Image& image, std::uint32_t width,
                       std::uint32_t height) {
    std::vector<glm::vec4> texels(std::size_t(width) * height);
    gpu::readImage(device, image, kLayout, width, height,
                   std::as_writable_bytes(std::span(texels)));
    return {width, height, std::vector<glm::vec3>(texels.begin(), texels.end())};
}

ImageF readSampledImage(gpu::Device& device, const gpu::Image& image, std::uint32_t width,
                        std::uint32_t height, gpu::Image& sampled) {
    constexpr std::uint32_t kWidth = 64, kHeight = 36;
    if (!sampled) {
        gpu::ImageDesc desc =
            gpu::ImageDesc::renderTarget(kWidth, kHeight, kLinearFormat, "metering");
        desc.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        sampled = gpu::Image(device, desc);
    }
    gpu::sampleImage(device, image, width, height, sampled,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    return readLinearImage(device, sampled, kWidth, kHeight);
}

Image readColorImage(gpu::Device& device, const gpu::Image& image, std::uint32_t width,
                     std::uint32_t height) {
    Image out;
    out.width = width;
    out.height = height;
    out.rgba.resize(std::size_t(width) * height * 4);
    gpu::readImage(device, image, kLayout, width, height,
                   std::as_writable_bytes(std::span(out.rgba)));
    return out;
}

} // namespace limn::render
