// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/light_sink.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

/// A sink that adds up the light of each part that is gathered at a point. Of all lights it samples
/// one. Unless `rays` is null, it adds to it each ray and the light that the ray brings.
struct PartSink {
    const TraceScene& trace;
    std::vector<RayLight>* rays = nullptr;
    std::array<glm::vec3, kGatherParts> sums{};
    RayLight* ray = nullptr; ///< the last of `rays` while it is followed

    static constexpr bool reflects(std::uint32_t /*instance*/) { return true; }

    void rayBegins(const EmittedLightSample& sample) {
        if (rays && sample.weight > 0)
            ray = &rays->emplace_back(RayLight{sample.direction, sample.samples[2].pdf, 0});
    }
    void rayEnds() { ray = nullptr; }
    void add(glm::vec3 light, GatherPart part) {
        sums[part] += light;
        if (ray)
            ray->light += channelSum(light);
    }
    void fieldIrradiance(const FieldPoint& point, glm::vec3 weight, GatherPart part) {
        add(weight * sampleIrradiance(point), part);
    }
    void gatheredDirectLight(const SurfacePoint& p, const LightNumbers& numbers, glm::vec3 weight,
                             std::uint32_t /*via*/) {
        std::uint64_t shadowRays = 0;
        add(weight *
                sampleDirectLight(trace, p, numbers.pick, numbers.onLight, shadowRays).irradiance,
            Bounced);
    }
    void gatheredEmission(const IncidentLightSample& /*sample*/, glm::vec3 light, GatherPart part,
                          std::uint32_t /*via*/) {
        add(light, part);
    }
};

} // namespace limn
