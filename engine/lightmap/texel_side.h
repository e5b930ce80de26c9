// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/lightmap/texel_points.h"
#include "engine/trace/trace_scene.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace limn {

inline constexpr std::uint32_t kMixedCharts = ~0U; ///< texels of several charts

/// What a few rays from a point meet.
struct Outlook {
    std::uint32_t open = 0; ///< number of directions that count as open
    float distances = 0;    ///< sum over all directions [m]
};

/// A point raised above its surface, from which rays along the surface start.
struct LiftedPoint {
    glm::vec3 position{0};
    std::uint32_t instance = 0, chart = kMixedCharts;
};

/// Chart of all points of a texel, or kMixedCharts. `charts` are those of its mesh.
std::uint32_t chartOfTexel(const MeshCharts& charts, const AtlasTexel& texel);

/// Properties of a texel besides its points.
struct TexelSide {
    std::uint32_t chart = kMixedCharts;
    bool open = false;   ///< some point is
    bool split = false;  ///< an open point was on another side
    float clearance = 0; ///< mean distance to what the points kept see [m]
    std::uint32_t count = 0;
    std::array<LiftedPoint, AtlasTexel::kMaxPoints> points; ///< those kept, each once
};

/// Computes sides of texels, and counts the rays. Keeps references.
struct SideFinder {
    const TraceScene& trace;
    const Atlas& atlas;
    std::atomic<std::uint64_t>& rays;

    /// Chart of a triangle.
    std::uint32_t chartOf(std::uint32_t instance, std::uint32_t triangle) const {
        const std::uint32_t mesh = trace.scene().instances[instance].mesh;
        return atlas.layout.meshes[mesh].chartOfTriangle[triangle];
    }
    std::uint32_t chartOf(const AtlasTexel& texel) const;

    /// Traces a few rays. A direction is open if there is no surface within `reach` [m] and no back
    /// of a one-sided surface at any distance. The sky counts as a thousand times `reach` away.
    Outlook look(const WorldPoint& point, float reach, std::uint32_t seed) const;

    /// Raises a point by a quarter of `reach` [m], or half way to the next surface above.
    LiftedPoint lift(const WorldPoint& point, float reach, std::uint32_t instance,
                     std::uint32_t chart) const;
    LiftedPoint lift(const MeshPoint& point, const AtlasTexel& texel, std::uint32_t chart) const;

    /// Whether nothing lies between two points except their own chart, which curves by less than a
    /// wall.
    bool sees(const LiftedPoint& a, const LiftedPoint& b) const;

    /// Reduces a texel's points to those that findTexelSides() keeps.
    TexelSide choose(AtlasTexel& texel) const;
};

} // namespace limn
