// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

namespace limn::render {

/// The lights that reach the scene, with rectangles split into their parts between walls. The split
/// is recomputed only when a light or the scene has moved.
class PartedLights {
public:
    /// `sceneVersion` must change whenever the shadow casters may have changed.
    void set(const Scene& scene, std::uint64_t sceneVersion);

    std::vector<Light> lights;
    std::uint32_t lightsOff = 0; ///< lights of the scene that do not shine or do not reach it

private:
    struct Known {
        Light shape; ///< without name, colour and strength, which do not affect the parts
        std::vector<Light> parts;
    };
    const std::vector<Light>& partsOf(const Light& light, const Scene& scene);

    std::vector<Known> m_known, m_before; ///< from the latest call of set() and from the one before
    std::uint64_t m_sceneVersion = ~0ull;
};

} // namespace limn::render
