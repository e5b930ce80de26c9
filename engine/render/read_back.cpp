// SPDX-License-Identifier: MIT
#include "engine/render/read_back.h"

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
