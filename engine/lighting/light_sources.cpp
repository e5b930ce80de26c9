// SPDX-License-Identifier: MIT
#include "engine/lighting/light_sources.h"

#include "engine/lighting/occluder_hash.h"
#include "engine/math/luminance.h"
#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <utility>

namespace limn {

/// Splits `light` into a colour of the source and a weight.
static WeightedSource weighted(LightSource source, glm::vec3 light, bool apart) {
    const float peak = largestChannel(light);
    if (!apart && peak > 0)
        source.color = light / peak;
    return {std::move(source), apart ? light : glm::vec3(peak)};
}

static LightSource skySource(Sky sky) {
    return {.kind = LightSource::Kind::Sky, .lamp = {}, .sky = std::move(sky)};
}

static void addSky(const Sky& sky, bool apart, std::vector<WeightedSource>& sources) {
    if (sky.showsImage()) {
        Sky unit = sky;
        unit.strength = 1;
        sources.push_back({skySource(std::move(unit)), glm::vec3(sky.strength)});
        return;
    }
    const auto add = [&](glm::vec3 Sky::*color) {
        Sky unit;
        unit.kind = sky.kind == SkyKind::Gradient ? SkyKind::Gradient : SkyKind::Color;
        unit.*color = glm::vec3(1);
        sources.push_back(weighted(skySource(std::move(unit)), sky.*color, apart));
    };
    add(&Sky::radiance);
    if (sky.kind != SkyKind::Gradient)
        return;
    add(&Sky::horizon);
    add(&Sky::ground);
}

std::vector<WeightedSource> lightSources(const Scene& scene, bool apart) {
    std::vector<WeightedSource> sources;
    sources.reserve(scene.lights.size() + 3);
    for (const Light& light : scene.lights)
        sources.push_back(weighted({.lamp = unitLight(light)},
                                   shines(light) ? light.color * light.strength : glm::vec3(0),
                                   apart));
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
        if (scene.materials[m].emission != glm::vec3(0))
            sources.push_back(weighted({.kind = LightSource::Kind::Emission, .material = m},
                                       scene.materials[m].emission, apart));
    addSky(scene.sky, apart, sources);
    return sources;
}

Scene litByOne(const Scene& scene, const LightSource& source) {
    Scene lit = scene;
    lit.lights.clear();
    for (Material& material : lit.materials)
        material.emission = glm::vec3(0);
    lit.sky = {};
    switch (source.kind) {
    case LightSource::Kind::Lamp:
        lit.lights.push_back(source.lamp);
        lit.lights.back().color = source.color;
        break;
    case LightSource::Kind::Emission:
        lit.materials[source.material].emission = source.color;
        break;
    case LightSource::Kind::Sky:
        lit.sky = source.sky;
        for (glm::vec3 Sky::*color : {&Sky::radiance, &Sky::horizon, &Sky::ground})
            lit.sky.*color *= source.color;
        break;
    }
    return lit;
}

SourceTransport sourceTransport(const Scene& scene) {
    SourceTransport transport{.materials = scene.materials,
                              .moving = hashOccluders(scene, true),
                              .relight = scene.relight};
    for (Material& material : transport.materials)
        material.emission = glm::vec3(0);
    return transport;
}

bool isTransportOf(const SourceTransport& transport, const Scene& scene) {
    const auto reflectsAlike = [](const Material& dark, const Material& m) {
        if (m.emission == glm::vec3(0))
            return dark == m;
        Material without = m;
        without.emission = glm::vec3(0);
        return dark == without;
    };
    return transport.relight == scene.relight &&
           std::ranges::equal(transport.materials, scene.materials, reflectsAlike) &&
           transport.moving == hashOccluders(scene, true);
}

} // namespace limn
