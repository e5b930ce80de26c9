// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/transport/gather.h"

#include <cstdint>
#include <vector>

namespace limn {

struct BoundingSphere {
    glm::vec3 centre;
    float radius;
};

/// Of a mesh at a place, wider by a little for rays that start or end clear of surfaces.
BoundingSphere sphereAround(const TraceScene& trace, const Mesh& mesh, const glm::mat4& toWorld);

/// Objects that are new at their place, to find the rays that meet them there.
class ArrivedObjects {
public:
    /// `instances`: of the scene of `trace`, which must outlive this.
    ArrivedObjects(const TraceScene& trace, const std::vector<std::uint32_t>& instances);

    /// Sets met[r] for each ray of the cache whose way without end meets one of the objects;
    /// leaves the others. Returns the number of rays traced against the objects: those within the
    /// cone of an object's bounding sphere.
    std::uint32_t mark(const RayGatherer& gatherer, const CachePoints& points, std::uint32_t cache,
                       std::vector<std::uint8_t>& met) const;

private:
    void markInCone(const CacheRays& rays, std::uint32_t k, glm::vec3 from,
                    const BoundingSphere& sphere, std::vector<std::uint8_t>& candidate) const;

    TraceScene m_objects; ///< only they
    std::vector<BoundingSphere> m_spheres;
};

} // namespace limn
