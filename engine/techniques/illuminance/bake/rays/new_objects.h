// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/rays/gather.h"

#include <cstdint>
#include <vector>

namespace limn {

struct BoundingSphere {
    glm::vec3 centre;
    float radius;
};

/// Bounding sphere of a mesh placed by `toWorld`, enlarged slightly for rays that start or end
/// clear of surfaces.
BoundingSphere sphereAround(const TraceScene& trace, const Mesh& mesh, const glm::mat4& toWorld);

/// Finds the rays that meet objects which are new at their place.
class NewObjects {
public:
    /// `instances`: indices into the instances of `trace`'s scene, which must outlive the object.
    NewObjects(const TraceScene& trace, const std::vector<std::uint32_t>& instances);

    /// Sets met[r] for each ray of the cache that, extended to infinity, meets one of the objects,
    /// and leaves the other entries unchanged. Returns the number of rays traced against the
    /// objects: those within the cone of an object's bounding sphere.
    std::uint32_t mark(const RayGatherer& gatherer, const CachePoints& points, std::uint32_t cache,
                       std::vector<std::uint8_t>& met) const;

private:
    void markInCone(const CacheRays& rays, std::uint32_t k, glm::vec3 from,
                    const BoundingSphere& sphere, std::vector<std::uint8_t>& candidate) const;

    TraceScene m_objects; ///< the objects alone
    std::vector<BoundingSphere> m_spheres;
};

} // namespace limn
