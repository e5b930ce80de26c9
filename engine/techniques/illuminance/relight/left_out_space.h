// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/dark_backs.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <optional>
#include <vector>

namespace limn {

/// The dark space whose surfaces a bake left out.
class LeftOutSpace {
public:
    /// Says what the bake's light lacks in a scene of the same inputs, a clause for people: the
    /// light of what has come into space that was left out. Null: nothing. `baked` is the scene
    /// that the bake was made from. The first call finds the space; others that find the same
    /// lights, sky and places of dynamic objects as the last answer at once.
    const char* lackOf(const Bake& bake, const Scene& baked, const Scene& scene);

private:
    std::optional<std::vector<PlacedSurface>> m_surfaces;
    std::vector<Light> m_lights; ///< of the last call, as what follows
    Sky m_sky;
    std::vector<glm::mat4> m_moving;
    bool m_lit = false;
};

} // namespace limn
