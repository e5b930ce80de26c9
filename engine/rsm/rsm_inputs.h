// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>

namespace limn {

/// Surfaces of a scene as far as the diffuse light that they reflect depends on them. Equal ones
/// have equal reflective shadow maps.
struct RsmSurfaces {
    struct Placed {
        std::uint32_t mesh, material;
        glm::mat4 toWorld;
        bool operator==(const Placed&) const = default;
    };
    std::shared_ptr<const Assets> assets;
    std::vector<Placed> instances;
    std::vector<Material> materials; ///< as far as they affect diffuse reflection
    Bounds bounds;
    bool operator==(const RsmSurfaces&) const = default;
};

RsmSurfaces rsmSurfacesOf(const Scene& scene);

/// A light that shines.
struct RsmSource {
    std::uint32_t index; ///< of Scene::lights
    Light shape;         ///< unitLight()
    glm::vec3 colour;    ///< colour times strength
    bool operator==(const RsmSource&) const = default;
};

/// The scene's lights that shine, in their order.
std::vector<RsmSource> rsmSourcesOf(const Scene& scene);

/// What else than its lights a technique takes light from.
struct OtherSources {
    bool emitters = false, sky = false;
    bool profiles = true; ///< of lights; otherwise their flux is spread evenly
};

/// LightingReport::lacks of a technique that takes light from `taken`: which sources of the scene's
/// light it leaves out. Null: none.
const char* sourcesLeftOut(const Scene& scene, const OtherSources& taken);

} // namespace limn
