// SPDX-License-Identifier: MIT
#include "engine/picture/reading_sink.h"

#include <algorithm>

namespace limn {

PixelParts::PixelParts(const Scene& scene)
    : byLight(scene.lights.size(), glm::vec3(0)), nearByLight(byLight),
      nearBySurface(scene.instances.size(), glm::vec3(0)), emitted{.bySurface = nearBySurface,
                                                                   .byLight = {}},
      bounced{.bySurface = nearBySurface, .byLight = byLight}, bouncedVia(nearBySurface) {}

bool ReadingSink::reflects(std::uint32_t instance) const {
    return std::ranges::count(m_black, instance) == 0;
}

void ReadingSink::meets(std::uint32_t instance) {
    if (std::ranges::count(parts.seen, instance) == 0)
        parts.seen.push_back(instance);
}

void ReadingSink::nearDirectLight(const SurfacePoint& p, const LightNumbers& numbers,
                                  std::uint32_t via) {
    forEachLight(p, numbers, [&](std::size_t light, const DirectSample& sample) {
        parts.nearByLight[light] += m_factor * sample.irradiance;
        parts.nearBySurface[via] += m_factor * sample.irradiance;
    });
}

FieldReading& ReadingSink::readingOf(const FieldPoint& point) {
    return &point.field == &m_lit.field() ? parts.reading : parts.emittedReading;
}

void ReadingSink::fieldIrradiance(const FieldPoint& point, glm::vec3 weight, GatherPart /*part*/) {
    addIrradiance(point, m_factor * weight, readingOf(point));
}

void ReadingSink::fieldRadiance(const FieldPoint& point, glm::vec3 direction, glm::vec3 weight) {
    addRadiance(point, direction, m_factor * weight, readingOf(point));
}

void ReadingSink::fieldLobe(const FieldPoint& point, const FieldLobe& lobe) {
    addLobe(point, lobe.axis, lobe.bands, lobe.factors, m_factor * lobe.weight, readingOf(point));
}

void ReadingSink::fieldReflection(const FieldPart& /*part*/, const FieldReflection& reflection) {
    addReflection(m_lit.field(), reflection.lobe, m_factor * reflection.weight, parts.reading);
}

void ReadingSink::gatheredDirectLight(const SurfacePoint& p, const LightNumbers& numbers,
                                      glm::vec3 weight, std::uint32_t via) {
    forEachLight(p, numbers, [&](std::size_t light, const DirectSample& sample) {
        parts.bounced.byLight[light] += m_factor * weight * sample.irradiance;
        parts.bouncedVia[via] += m_factor * weight * sample.irradiance;
    });
}

void ReadingSink::gatheredEmission(const IncidentLightSample& sample, glm::vec3 light,
                                   GatherPart part, std::uint32_t via) {
    PixelParts::Gathered& gathered = part == Emitted ? parts.emitted : parts.bounced;
    (sample.instance == ~0U ? gathered.sky : gathered.bySurface[sample.instance]) +=
        m_factor * light;
    if (part == Bounced)
        parts.bouncedVia[via] += m_factor * light;
}

} // namespace limn
