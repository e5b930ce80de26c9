// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <memory>
#include <string>

namespace limn {

/// A scene of extreme cases for stress tests, small enough to be baked and lit in milliseconds.
struct HostileScene {
    Document document;
    std::shared_ptr<const Assets> assets; ///< meshes satisfy the importer's guarantees
    std::string description;              ///< what was drawn, for people
};

/// The scene of a seed. Random choices are: a size of 1e-4 to 1e4 m, sometimes up to 1e6 sizes away
/// from the origin; a closed room, an open room or none; up to ten objects, rarely 5000: solids,
/// also inside walls and each other, needles, coplanar triangles, walls without thickness; from one
/// to rarely a million triangles; materials of any albedo, emission and side; dynamic objects;
/// lights of every kind, 1e-6 to 1e6 strong, also inside walls and on surfaces; the sky; and cheap
/// values of every bake setting.
HostileScene hostileScene(std::uint64_t seed);

} // namespace limn
