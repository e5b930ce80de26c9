// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/field_render.h"
#include "engine/picture/light_sink.h"

#include <cstdint>

namespace limn {

/// A sink that adds up the terms of walkPixel(), which draws a picture. Of all lights it samples
/// one.
struct ValueSink {
    const TraceScene& trace;
    ReflectionCounts* counts = nullptr; ///< counts are added to it; null: nothing is counted
    glm::vec3 sum{0};

    static constexpr bool reflects(std::uint32_t /*instance*/) { return true; }
    static void meets(std::uint32_t /*instance*/) {}

    template <class Body>
    void scaled(glm::vec3 factor, const Body& body) {
        const glm::vec3 before = sum;
        sum = glm::vec3(0);
        body();
        sum = before + factor * sum;
    }

    void background(glm::vec3 radiance) { sum += radiance; }
    void emission(glm::vec3 radiance) { sum += radiance; }

    template <class Response>
    void directLight(const SurfacePoint& p, const LightNumbers& numbers, const Response& response) {
        std::uint64_t rays = 0;
        sum += response(sampleDirectLight(trace, p, numbers.pick, numbers.onLight, rays));
    }
    void nearDirectLight(const SurfacePoint& p, const LightNumbers& numbers,
                         std::uint32_t /*via*/) {
        directLight(p, numbers, irradianceOf);
    }

    void fieldIrradiance(const FieldPoint& point, glm::vec3 weight, GatherPart /*part*/) {
        sum += weight * sampleIrradiance(point);
    }
    void fieldRadiance(const FieldPoint& point, glm::vec3 direction, glm::vec3 weight) {
        sum += weight * sampleRadiance(point, direction);
    }
    void fieldLobe(const FieldPoint& point, const FieldLobe& lobe) {
        sum += lobe.weight * sampleLobe(point, lobe.axis, lobe.bands, lobe.factors);
    }
    void fieldReflection(const FieldPart& part, const FieldReflection& reflection) {
        const SampledReflection sampled = sampleReflection(part, reflection.lobe);
        if (counts) {
            ++counts->all;
            counts->unknown += sampled.known ? 0 : 1;
        }
        sum += reflection.weight * sampled.radiance;
    }
};

} // namespace limn
