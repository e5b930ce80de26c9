// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/hash.h"
#include "engine/scene/scene.h"

#include <cstdint>

namespace limn {

/// Hash of the places and meshes of the dynamic instances, or of the others.
inline std::uint64_t hashOccluders(const Scene& scene, bool dynamic) {
    std::uint64_t h = 3;
    for (const Instance& i : scene.instances)
        if (i.dynamic == dynamic)
            h = hashBytes(&i.toWorld, sizeof i.toWorld, hashValue(i.mesh, h));
    return h;
}

} // namespace limn
