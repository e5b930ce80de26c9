// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.h"
#include "engine/scene/image.h"

#include <cstdint>

namespace limn::render {

// Upper left parts of images in SHADER_READ_ONLY_OPTIMAL. Each waits for the GPU.

/// RGB of an RGBA32F image.
ImageF readLinearImage(gpu::Device& device, const gpu::Image& image, std::uint32_t width,
                       std::uint32_t height);
/// RGB of 64 x 36 points of an RGBA32F image. `sampled` is made when it is empty.
ImageF readSampledImage(gpu::Device& device, const gpu::Image& image, std::uint32_t width,
                        std::uint32_t height, gpu::Image& sampled);
/// An RGBA8 image.
Image readColorImage(gpu::Device& device, const gpu::Image& image, std::uint32_t width,
                     std::uint32_t height);

} // namespace limn::render
