// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace limn {

struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0}; ///< unit
    float tNear = 0;        ///< [m]
    float tFar = std::numeric_limits<float>::infinity();
};

/// Closest surface along a ray. Alpha-masked texels are passed through.
struct Hit {
    std::uint32_t instance = ~0u; ///< index into Scene::instances; ~0: nothing was hit
    std::uint32_t triangle = 0;
    float u = 0, v = 0; ///< barycentrics, weights (1-u-v, u, v)
    float t = 0;        ///< [m]
    glm::vec3 position{0};
    glm::vec3 geometricNormal{
        0};                ///< unit, world, of the counter-clockwise front; not turned to the ray
    bool frontFace = true; ///< the ray met the front

    explicit operator bool() const { return instance != ~0u; }
};

/// Which surfaces a query may meet.
enum class TraceMask : std::uint32_t { Static = 1, Dynamic = 2, All = 3 };

/// Embree's acceleration structure over a Scene: static triangles in one tree, often repeated
/// meshes as instances of their own; what moves in another tree. Immutable, thread-safe to
/// query. Holds a copy of the instance table and shares the assets; the Scene may die or change
/// meanwhile.
class TraceScene {
public:
    /// Builds it. O(triangles); uses oneTBB.
    explicit TraceScene(const Scene& scene);

    /// The same with only those `present` of its instances, each met exactly as in the whole scene.
    TraceScene(const Scene& scene, const std::vector<bool>& present);

    /// Of `before` with its dynamic instances elsewhere: static ones are as they were there, with
    /// the same numbers, assets and holes, and their structure is shared. O(dynamic instances).
    TraceScene(const Scene& scene, const TraceScene& before);

    ~TraceScene();
    TraceScene(const TraceScene&) = delete;
    TraceScene& operator=(const TraceScene&) = delete;

    /// Nothing, and one more of badRays(), for a ray with a number that is none or too large.
    Hit closestHit(const Ray& ray, TraceMask mask = TraceMask::All) const;

    /// True if anything opaque lies in (tNear, tFar); of bad rays as closestHit().
    bool occluded(const Ray& ray, TraceMask mask = TraceMask::All) const;

    /// True if anything opaque lies between two points, both clear of their own surfaces.
    bool blocked(glm::vec3 from, glm::vec3 to, TraceMask mask = TraceMask::All) const;

    /// A point of a surface moved off it along `normal` (unit, or 0 in the air), so that rays from
    /// or to it miss the surface itself.
    glm::vec3 clearOf(glm::vec3 p, glm::vec3 normal) const { return p + normal * epsilonAt(p); }

    /// Offset that clears a surface at `p` of float rounding [m]; grows with |p| and in powers of
    /// two with the static scene.
    float epsilonAt(glm::vec3 p) const;

    /// Rays so far that were not traced, because Embree's assertions would end the process.
    std::uint64_t badRays() const;

    const Scene& scene() const;

private:
    struct Trees;
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace limn
