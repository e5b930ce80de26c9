// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A part of a scene's light whose colour and strength are taken out of it. Light transport is
/// linear: the light of a scene is the sum of that of its sources, each times its weight.
struct LightSource {
    enum class Kind : std::uint8_t { Lamp, Emission, Sky };

    Kind kind = Kind::Lamp;
    Light lamp;                 ///< of unit strength, as unitLight()
    std::uint32_t material = 0; ///< Emission: the material whose surfaces shine with 1 nit
    Sky sky;                    ///< of unit strength
    glm::vec3 color{1};         ///< times the colours above

    bool operator==(const LightSource&) const = default;
};

struct WeightedSource {
    LightSource source;
    glm::vec3 weight{0}; ///< per colour

    bool operator==(const WeightedSource&) const = default;
};

/// The sources of a scene with their weights: every light, on or off, every material that shines,
/// and the sky, of which a gradient is three. `apart`: colours do not mix, so that sources are
/// white and weights have their colour. Otherwise, sources keep their colour.
std::vector<WeightedSource> lightSources(const Scene& scene, bool apart);

/// `scene` with no light but that of `source`, at unit weight.
Scene litByOne(const Scene& scene, const LightSource& source);

/// What the light of a single source depends on besides the source and what bakes depend on: what
/// surfaces reflect, what occludes, and how light is relit.
struct SourceTransport {
    std::vector<Material> materials; ///< without emission
    std::uint64_t moving = 0;        ///< hash of the dynamic instances
    RelightSettings relight;
};
SourceTransport sourceTransport(const Scene& scene);

/// Whether `transport` is that of `scene`.
bool isTransportOf(const SourceTransport& transport, const Scene& scene);

} // namespace limn
