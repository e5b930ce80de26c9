// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/left_out_space.h"

#include <algorithm>
#include <utility>

namespace limn {

namespace {

/// Whether the bake gives light to one side only of an instance that has two.
bool hasDarkBacks(const Bake& bake, const Scene& baked, std::uint32_t instance) {
    const InstanceLightmap& map = bake.lightmap.instances[instance];
    return !map.uv.empty() && map.backRows == 0 &&
           isTwoSided(baked.materialOf(baked.instances[instance]));
}

std::vector<PlacedSurface> leftOutSurfaces(const Bake& bake, const Scene& baked) {
    std::vector<bool> dark(baked.instances.size());
    for (std::uint32_t i = 0; i < dark.size(); ++i)
        dark[i] = hasDarkBacks(bake, baked, i);
    if (std::ranges::find(dark, true) == dark.end())
        return {};
    std::vector<PlacedSurface> surfaces = findClosedSurfaces(baked);
    std::erase_if(surfaces, [&](const PlacedSurface& placed) {
        return std::ranges::none_of(placed.surface.shell, [&](const ShellTriangle& t) {
            return dark[placed.instances[t.mesh]];
        });
    });
    return surfaces;
}

std::vector<glm::mat4> movingPlaces(const Scene& scene) {
    std::vector<glm::mat4> places;
    for (const Instance& i : scene.instances)
        if (i.dynamic)
            places.push_back(i.toWorld);
    return places;
}

/// Whether anything shines in the space, or may show light there.
bool isLit(Scene scene, const std::vector<PlacedSurface>& surfaces) {
    std::erase_if(scene.lights, [](const Light& light) { return !shines(light); });
    return std::ranges::any_of(
        surfaces, [&](const PlacedSurface& placed) { return isLitBehind(scene, placed); });
}

} // namespace

const char* LeftOutSpace::lackOf(const Bake& bake, const Scene& baked, const Scene& scene) {
    const bool first = !m_surfaces;
    if (first)
        m_surfaces = leftOutSurfaces(bake, baked);
    if (m_surfaces->empty())
        return nullptr;
    std::vector<glm::mat4> moving = movingPlaces(scene);
    if (first || scene.lights != m_lights || scene.sky != m_sky || moving != m_moving) {
        m_lights = scene.lights;
        m_sky = scene.sky;
        m_moving = std::move(moving);
        m_lit = isLit(scene, *m_surfaces);
    }
    return m_lit ? "the bake left out closed space that has light in it now: bake again" : nullptr;
}

} // namespace limn
