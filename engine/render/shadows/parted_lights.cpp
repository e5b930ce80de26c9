// SPDX-License-Identifier: MIT
#include "engine/render/shadows/parted_lights.h"

#include "engine/scene/light/light_parts.h"
#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <utility>

namespace limn::render {

void PartedLights::set(const Scene& scene, std::uint64_t sceneVersion) {
    m_before = std::move(m_known);
    m_known.clear();
    if (std::exchange(m_sceneVersion, sceneVersion) != sceneVersion)
        m_before.clear();
    lights.clear();
    lightsOff = 0;
    for (const Light& light : scene.lights) {
        if (!shines(light) || !reaches(light, scene.bounds)) {
            ++lightsOff;
        } else if (light.kind != LightKind::Rectangle) {
            lights.push_back(light);
        } else {
            for (const Light& part : partsOf(light, scene)) {
                lights.push_back(part);
                lights.back().color = light.color;
                lights.back().strength = light.strength;
            }
        }
    }
}

const std::vector<Light>& PartedLights::partsOf(const Light& light, const Scene& scene) {
    const Light shape = unitLight(light);
    const auto known = std::ranges::find(m_before, shape, &Known::shape);
    m_known.push_back(
        {shape, known != m_before.end() ? known->parts : partsBetweenWalls(shape, scene)});
    return m_known.back().parts;
}

} // namespace limn::render
