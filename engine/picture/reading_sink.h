// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_reading.h"
#include "engine/lighting/converged_light.h"
#include "engine/picture/light_sink.h"

#include <cstdint>
#include <vector>

namespace limn {

/// The light of a pixel, split by where it comes from.
struct PixelParts {
    glm::vec3 sky{0};               ///< radiance of the sky, seen itself
    glm::vec3 emission{0};          ///< emission of the surfaces that are seen
    std::vector<glm::vec3> byLight; ///< direct light of each of Scene::lights
    /// Direct light of each of them that near surfaces reflect, which the field is too coarse for.
    std::vector<glm::vec3> nearByLight;
    std::vector<glm::vec3> nearBySurface; ///< the same by each of Scene::instances that reflects it
    /// Gathered light by the sky, by each of Scene::instances that emits it, and by light.
    struct Gathered {
        glm::vec3 sky{0};
        std::vector<glm::vec3> bySurface, byLight;
    };
    Gathered emitted, bounced;         ///< light without and with bounces
    std::vector<glm::vec3> bouncedVia; ///< `bounced` by the instance that sends it here
    FieldReading reading;              ///< reading of the field: all other light
    FieldReading emittedReading;       ///< reading of the emitted light of the field
    std::vector<std::uint32_t> seen;   ///< instances that the pixel shows, each once

    explicit PixelParts(const Scene& scene);
};

/// A sink that splits the terms of walkPixel() and FinalGather::walk() by where their light comes
/// from, which explains a pixel. It samples every light.
class ReadingSink {
public:
    PixelParts parts;

    /// Instances in `black` reflect no diffuse light. The arguments outlive the object.
    ReadingSink(const ConvergedLight& lit, const std::vector<std::uint32_t>& black)
        : parts(lit.trace->scene()), m_lit(lit), m_black(black) {}

    bool reflects(std::uint32_t instance) const;
    void meets(std::uint32_t instance);

    template <class Body>
    void scaled(glm::vec3 factor, const Body& body) {
        const glm::vec3 before = m_factor;
        m_factor *= factor;
        body();
        m_factor = before;
    }

    void background(glm::vec3 radiance) { parts.sky += m_factor * radiance; }
    void emission(glm::vec3 radiance) { parts.emission += m_factor * radiance; }

    template <class Response>
    void directLight(const SurfacePoint& p, const LightNumbers& numbers, const Response& response) {
        forEachLight(p, numbers, [&](std::size_t light, const DirectSample& sample) {
            parts.byLight[light] += m_factor * response(sample);
        });
    }
    void nearDirectLight(const SurfacePoint& p, const LightNumbers& numbers, std::uint32_t via);

    void fieldIrradiance(const FieldPoint& point, glm::vec3 weight, GatherPart part);
    void fieldRadiance(const FieldPoint& point, glm::vec3 direction, glm::vec3 weight);
    void fieldLobe(const FieldPoint& point, const FieldLobe& lobe);
    void fieldReflection(const FieldPart& part, const FieldReflection& reflection);

    // Only guides learn from single rays.
    static void rayBegins(const EmittedLightSample& /*ray*/) {}
    static void rayEnds() {}
    void gatheredDirectLight(const SurfacePoint& p, const LightNumbers& numbers, glm::vec3 weight,
                             std::uint32_t via);
    void gatheredEmission(const IncidentLightSample& sample, glm::vec3 light, GatherPart part,
                          std::uint32_t via);

private:
    /// Calls add(index, sample) for each of Scene::lights.
    template <class Add>
    void forEachLight(const SurfacePoint& p, const LightNumbers& numbers, const Add& add) const {
        std::uint64_t rays = 0;
        const std::vector<Light>& lights = m_lit.trace->scene().lights;
        for (std::size_t l = 0; l < lights.size(); ++l)
            add(l, sampleDirectLightFrom(*m_lit.trace, p, lights[l], numbers.onLight, rays));
    }
    FieldReading& readingOf(const FieldPoint& point);

    const ConvergedLight& m_lit;
    const std::vector<std::uint32_t>& m_black;
    glm::vec3 m_factor{1}; ///< product of the factors of scaled()
};

} // namespace limn
