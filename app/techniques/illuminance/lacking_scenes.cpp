// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/lacking_scenes.h"

#include "app/bench/moving_lights.h"

#include "engine/field/grid_placement.h"

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kLampsOff = 8;
/// Reach of the only lamp of a scene that is lit in part, as a share of the scene's diagonal.
constexpr float kReach = 0.2f;

std::vector<Light> lampsIn(const Scene& scene, const Bake& bake, std::uint32_t count) {
    return pointsOver(scene, bake.surfels.position, bake.surfels.normal, count);
}

Scene withoutGloss(Scene scene) {
    for (Material& material : scene.materials) {
        material.metallic = 0;
        material.roughness = 1;
        material.metallicRoughnessTexture = {};
    }
    return scene;
}

Scene withEmission(Scene scene, float radiance) {
    for (Material& material : scene.materials)
        material.emission = glm::vec3(radiance);
    return scene;
}

Scene withSky(Scene scene, float radiance) {
    scene.sky = {};
    scene.sky.radiance = glm::vec3(radiance);
    return scene;
}

Scene withMoreLamps(Scene scene, std::vector<Light> lamps, bool on) {
    for (Light& lamp : lamps) {
        lamp.enabled = on;
        lamp.color = glm::vec3(kFaintLight);
        scene.lights.push_back(lamp);
    }
    return scene;
}

/// Lit by one lamp alone, which reaches a part of the scene, by light that is reflected once.
Scene litInPart(const Scene& scene, const Bake& bake) {
    Scene lit = withSky(withEmission(scene, 0), 0);
    lit.lights = lampsIn(scene, bake, 1);
    lit.lights[0].range = kReach * glm::length(scene.bounds.size());
    lit.relight.maxBounces = 1;
    return lit;
}

} // namespace

std::vector<LackingScene> lackingScenes(const Scene& original, const Bake& bake) {
    Scene scene = original;
    if (scene.lights.empty())
        scene.lights = lampsIn(scene, bake, 1);
    std::vector<LackingScene> all;
    const Scene dull = withoutGloss(scene);
    all.push_back({.lacks = "gloss",
                   .counter = "bands skipped",
                   .count = [](const RelightStats& s,
                               const RelightStats&) { return std::uint64_t(s.bandsSkipped); },
                   .scene = dull,
                   .whole = dull,
                   .allBands = true});
    if (!needsGrid(scene, bake.lightmap))
        all.push_back(
            {.lacks = "dynamic objects",
             .counter = "grid caches skipped",
             .count = [](const RelightStats& s,
                         const RelightStats&) { return std::uint64_t(s.gridCachesSkipped); },
             .scene = scene,
             .whole = scene,
             .unreadGrid = true});
    all.push_back(
        {.lacks = "sky",
         .counter = "links to the sky skipped",
         .count = [](const RelightStats& s,
                     const RelightStats& whole) { return s.linksSkipped - whole.linksSkipped; },
         .scene = withSky(scene, 0),
         .whole = withSky(scene, kFaintLight),
         .faint = true,
         .unreadLinks = true});
    all.push_back(
        {.lacks = "emissive surfaces",
         .counter = "links skipped",
         .count = [](const RelightStats& s,
                     const RelightStats& whole) { return s.linksSkipped - whole.linksSkipped; },
         .scene = withEmission(scene, 0),
         .whole = withEmission(scene, kFaintLight),
         .faint = true});
    const std::vector<Light> lamps = lampsIn(scene, bake, kLampsOff);
    all.push_back({.lacks = "light from 8 lamps",
                   .counter = "lights off",
                   .count = [](const RelightStats& s,
                               const RelightStats&) { return std::uint64_t(s.lightsOff); },
                   .scene = withMoreLamps(scene, lamps, false),
                   .whole = withMoreLamps(scene, lamps, true),
                   .faint = true});
    all.push_back({.lacks = "motion",
                   .counter = "updates skipped",
                   .count = [](const RelightStats& s,
                               const RelightStats&) { return std::uint64_t(s.skipped); },
                   .scene = scene,
                   .whole = scene,
                   .still = true});
    const Scene part = litInPart(scene, bake);
    all.push_back(
        {.lacks = "light in most places",
         .counter = "links skipped",
         .count = [](const RelightStats& s,
                     const RelightStats& whole) { return s.linksSkipped - whole.linksSkipped; },
         .scene = part,
         .whole = withEmission(part, kFaintLight),
         .faint = true});
    all.push_back({.lacks = "nine tenths of the view",
                   .counter = "caches unseen",
                   .count = [](const RelightStats& s,
                               const RelightStats&) { return std::uint64_t(s.cachesUnseen); },
                   .scene = scene,
                   .whole = scene,
                   .looksAtTenth = true});
    return all;
}

} // namespace limn
