// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>

namespace limn {

/// What of a mesh keeps bounced light off: its triangles; alpha is not asked.
struct BlockerShape {
    glm::mat3 toBox{1}; ///< turns object space to the axes of `box`; those of a box, however turned
    Bounds box;         ///< about the mesh
    std::unique_ptr<const TraceScene> triangles; ///< null: the mesh is its box
};
BlockerShape blockerShape(const Scene& scene, std::uint32_t mesh);

/// A dynamic instance as it blocks light.
struct Blocker {
    std::shared_ptr<const BlockerShape> shape;
    glm::mat3 toBox{1};  ///< of directions, from the world to the shape's axes
    glm::vec3 origin{0}; ///< world, of the object's space
    glm::vec3 centre{0}; ///< world, of a sphere about the box
    float radius = 0;    ///< [m]
    Bounds bounds;       ///< world, about the box
};

/// By mesh; kept between calls.
using BlockerShapes = std::map<std::uint32_t, std::shared_ptr<const BlockerShape>>;

/// Of the dynamic instances of `scene`; without those whose matrix has no inverse, which block
/// nothing. Adds to `shapes` those that are missing.
std::vector<Blocker> sceneBlockers(const Scene& scene, BlockerShapes& shapes);

/// Hash of all that sceneBlockers depends on but the meshes themselves. 0: there are none.
std::uint64_t hashBlockers(const Scene& scene);

/// Directions that stand for a cone of light.
struct ConeSamples {
    static constexpr std::size_t kMost = 16;
    std::size_t count = 0;              ///< a multiple of 4
    float x[kMost], y[kMost], z[kMost]; ///< unit, world
    float tMost[kMost];                 ///< how far the light comes from along each [m]
    float farthest = 0;                 ///< no tMost is more
    bool blocked[kMost];
};

/// Sets `blocked` where the blocker begins before tMost along the way from `from`. From within all
/// is blocked, so a surface that a box stands on gets no light there.
void block(const Blocker& blocker, glm::vec3 from, ConeSamples& samples);

} // namespace limn
