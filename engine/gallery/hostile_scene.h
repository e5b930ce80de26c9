// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <memory>
#include <string>

namespace limn {

/// A scene that nobody would build, small enough to be baked and lit in milliseconds.
struct HostileScene {
    Document document;
    std::shared_ptr<const Assets> assets; ///< meshes keep what the importer guarantees
    std::string description;              ///< what was drawn, for people
};

/// The scene of a seed. Drawn are: a size of 1e-4 to 1e4 m, now and then up to 1e6 sizes away from
/// the origin; a room, closed or not, or none; up to ten objects, rarely 5000: solids, also within
/// walls and each other, needles, triangles that lie on others, walls without thickness; from one
/// to rarely a million triangles; materials of any albedo, emission and side; dynamic objects;
/// lights of every kind, 1e-6 to 1e6 strong, also within walls and on surfaces; the sky; and every
/// setting of the bake, of cheap ones.
HostileScene hostileScene(std::uint64_t seed);

} // namespace limn
