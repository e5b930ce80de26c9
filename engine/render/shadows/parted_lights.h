// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

namespace limn::render {

/// The lights that shine on anything, rectangles in their parts between walls. Walls are looked for
/// only when a light or the scene has moved.
class PartedLights {
public:
    /// `sceneVersion` is another whenever something else may cast shadows.
    void set(const Scene& scene, std::uint64_t sceneVersion);

    std::vector<Light> lights;
    std::uint32_t lightsOff = 0; ///< of the scene, that have no part in them

private:
    struct Known {
        Light shape; ///< without what moves no part
        std::vector<Light> parts;
    };
    const std::vector<Light>& partsOf(const Light& light, const Scene& scene);

    std::vector<Known> m_known, m_before; ///< of this call of set() and of the last one
    std::uint64_t m_sceneVersion = ~0ull;
};

} // namespace limn::render
