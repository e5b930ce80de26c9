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

/// The ray from one point to another, where it ends. It meets nothing where both coincide.
Ray rayBetween(glm::vec3 from, glm::vec3 to);

struct RayPacket;

/// Closest surface along a ray. Rays pass through alpha-masked texels.
struct SurfaceHit {
    std::uint32_t instance = ~0u; ///< index into Scene::instances; ~0: nothing was hit
    std::uint32_t triangle = 0;
    float u = 0, v = 0;    ///< barycentrics, weights (1-u-v, u, v)
    float t = 0;           ///< [m]
    bool frontFace = true; ///< the ray met the front

    explicit operator bool() const { return instance != ~0u; }
};

/// The same, with its place in the world.
struct Hit : SurfaceHit {
    glm::vec3 position{0};
    glm::vec3 geometricNormal{0}; ///< unit, of the counter-clockwise front; not turned to the ray
};

/// Which surfaces a query considers. Sheets of glass (isGlassSheet()) are apart, whether static or
/// dynamic: light passes through them, but who looks sees them.
enum class TraceMask : std::uint32_t { Static = 1, Dynamic = 2, All = 3, Sheets = 4, Seen = 7 };

/// Embree's acceleration structure over a Scene: one tree of static triangles, in which frequently
/// repeated meshes are instanced, and another tree of dynamic objects. Immutable; queries are
/// thread-safe. Holds a copy of the instance table and shares the assets; the Scene may change or
/// be destroyed meanwhile.
class TraceScene {
public:
    /// Builds the structure. O(triangles); uses oneTBB.
    explicit TraceScene(const Scene& scene);

    /// Same with only those instances that are `present`; each is hit exactly as in the whole
    /// scene.
    TraceScene(const Scene& scene, const std::vector<bool>& present);

    /// Reuses the static structure of `before` for a scene that differs in its dynamic instances
    /// only: static instances must have the same positions, numbers, assets and holes. O(dynamic
    /// instances).
    TraceScene(const Scene& scene, const TraceScene& before);

    ~TraceScene();
    TraceScene(const TraceScene&) = delete;
    TraceScene& operator=(const TraceScene&) = delete;

    /// Closest hit. For a ray with a NaN or too large number, returns no hit and counts it in
    /// badRays().
    Hit closestHit(const Ray& ray, TraceMask mask = TraceMask::All) const;

    /// The same without its place in the world, which takes less time. Whether a ray that runs
    /// along a triangle meets its front is subject to rounding, and may differ between both.
    SurfaceHit closestSurface(const Ray& ray, TraceMask mask = TraceMask::All) const;

    /// Whether anything opaque lies in (tNear, tFar). Bad rays are handled as by closestHit().
    bool occluded(const Ray& ray, TraceMask mask = TraceMask::All) const;

    /// Which of the first `count` rays of a packet are occluded(): bit k for ray k. Faster than one
    /// after another where they run alike. A ray that grazes an edge may get another answer than
    /// alone.
    std::uint32_t occludedTogether(RayPacket& rays, std::size_t count,
                                   TraceMask mask = TraceMask::All) const;

    /// Whether anything opaque lies between two points, both clear of their own surfaces.
    bool blocked(glm::vec3 from, glm::vec3 to, TraceMask mask = TraceMask::All) const;

    /// Moves a point of a surface off it along `normal` (unit, or 0 in the air), so that rays from
    /// or to it miss the surface itself.
    glm::vec3 clearOf(glm::vec3 p, glm::vec3 normal) const { return p + normal * epsilonAt(p); }

    /// Offset at `p` that exceeds float rounding errors of surface positions [m]. It grows with |p|
    /// and, in powers of two, with the size of the static scene.
    float epsilonAt(glm::vec3 p) const;

    /// Number of rays that were not traced because they would trip Embree's assertions and end the
    /// process.
    std::uint64_t badRays() const;

    const Scene& scene() const;

private:
    struct Trees;
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace limn
