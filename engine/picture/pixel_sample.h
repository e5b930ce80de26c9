// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/light_sink.h"
#include "engine/shading/pixel_rays.h"
#include "engine/shading/sampler.h"

#include <cstdint>

namespace limn {

/// Sample s of a pixel of a picture that is drawn on the CPU from a field.
struct PixelSample {
    Ray ray;
    LightNumbers light;          ///< for direct light
    Sampler near;                ///< for walkNearLight()
    Sampler gather;              ///< for FinalGather
    Sampler passing;             ///< for passRay(), two dimensions a crossing
    std::uint32_t crossings = 0; ///< transmissive surfaces between the eye and `ray`

    /// These seeds make the numbers of those rays independent of others.
    static constexpr std::uint32_t kNearSeed = 0x6e656172, kGatherSeed = 0x67617468,
                                   kPassingSeed = 0x70617373;

    /// Makes sample s of the pixel whose number is y * width + x.
    PixelSample(const PixelRays& rays, std::uint32_t seed, std::uint32_t pixel, std::uint32_t s) {
        const Sampler sampler{mixBits(seed, pixel), s};
        const auto width = std::uint32_t(rays.size.x);
        const glm::vec2 corner(float(pixel % width), float(pixel / width));
        ray = rays.through(corner + sampler.pair(0));
        light = {sampler.pair(1).x, sampler.pair(kOnLightDimension)};
        near = {mixBits(sampler.seed, kNearSeed), s};
        gather = {mixBits(sampler.seed, kGatherSeed), s};
        passing = {mixBits(sampler.seed, kPassingSeed), s};
    }

    /// The sample as it goes on behind a transmissive surface.
    PixelSample behind(const Ray& passed) const {
        PixelSample sample = *this;
        sample.ray = passed;
        ++sample.crossings;
        return sample;
    }
};

} // namespace limn
