// SPDX-License-Identifier: MIT
#include "engine/rsm/rsm_inputs.h"

#include "engine/scene/light/unit_light.h"
#include "engine/scene/mesh/input_hash.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace limn {

/// The material with everything reset that does not affect its diffuse reflection.
static Material diffusePart(Material m) {
    const Material plain;
    m.name.clear();
    m.roughness = plain.roughness;
    m.emission = plain.emission;
    m.normalScale = plain.normalScale;
    m.normalTexture = plain.normalTexture;
    m.emissiveTexture = plain.emissiveTexture;
    m.emissiveFlipbook = plain.emissiveFlipbook;
    return m;
}

RsmSurfaces rsmSurfacesOf(const Scene& scene) {
    RsmSurfaces s{scene.assets, {}, {}, scene.bounds};
    for (const Instance& i : scene.instances)
        s.instances.push_back({i.mesh, i.material, i.toWorld});
    std::ranges::transform(scene.materials, std::back_inserter(s.materials), diffusePart);
    return s;
}

std::vector<RsmSource> rsmSourcesOf(const Scene& scene) {
    std::vector<RsmSource> sources;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i)
        if (const Light& light = scene.lights[i]; shines(light))
            sources.push_back({i, unitLight(light), light.color * light.strength});
    return sources;
}

static bool shines(const Sky& sky) {
    const auto lit = [](glm::vec3 radiance) { return radiance != glm::vec3(0); };
    switch (sky.kind) {
    case SkyKind::Color:
        return lit(sky.radiance);
    case SkyKind::Gradient:
        return lit(sky.radiance) || lit(sky.horizon) || lit(sky.ground);
    case SkyKind::Image:
        return sky.strength > 0;
    }
    return false;
}

const char* sourcesLeftOut(const Scene& scene, const OtherSources& taken) {
    const bool sky = !taken.sky && shines(scene.sky);
    const bool emitters =
        !taken.emitters && std::ranges::any_of(scene.instances, [&](const Instance& instance) {
            return emits(scene.materialOf(instance));
        });
    const bool profiles = !taken.profiles && std::ranges::any_of(scene.lights, [](const Light& l) {
        return shines(l) && profileOf(l);
    });
    static constexpr std::array<const char*, 8> kLacks = {
        nullptr,
        "this technique leaves out the light of the sky",
        "this technique leaves out the light of emissive surfaces",
        "this technique leaves out the light of the sky and of emissive surfaces",
        "on this device, this technique spreads the light of IES profiles evenly",
        "this technique leaves out the light of the sky and spreads that of IES profiles evenly",
        "this technique leaves out the light of emissive surfaces and spreads that of IES profiles "
        "evenly",
        "this technique leaves out the light of the sky and of emissive surfaces, and spreads that "
        "of IES profiles evenly"};
    return kLacks[std::size_t(sky) + 2 * std::size_t(emitters) + 4 * std::size_t(profiles)];
}

} // namespace limn
