// SPDX-License-Identifier: MIT
#include "engine/picture/near_light.h"

#include "engine/lightmap/near_reach.h"
#include "engine/picture/value_sink.h"

#include <glm/geometric.hpp>

namespace limn {

static constexpr std::uint32_t kDirection = 0; ///< dimension of the sampler

NearLight nearLight(const TraceScene& trace, const IndirectField& field,
                    const LightmapLayout& layout, std::uint32_t rays) {
    return {trace, field, layout,
            rays > 0 ? nearReaches(trace.scene(), layout) : std::vector<float>(), rays};
}

std::vector<NearSurface> findNearSurfaces(const NearLight& near, const Hit& hit,
                                          const SurfacePoint& p, const Sampler& sampler) {
    std::vector<NearSurface> found;
    const float meshReach = near.rays > 0 ? near.reach[hit.instance] : 0;
    if (!(meshReach > 0))
        return found;
    const float reach = nearReachAt(near.layout, meshReach, hit.instance,
                                    near.trace.scene().instances[hit.instance].mesh, hit.triangle,
                                    hit.u, hit.v, !hit.frontFace);
    const glm::vec3 origin = rayOrigin(near.trace, p);
    for (std::uint32_t k = 0; k < near.rays; ++k) {
        const Sampler raySampler{sampler.seed, sampler.index * near.rays + k};
        const glm::vec3 direction = sampleCosineHemisphere(p.normal, raySampler.pair(kDirection));
        if (!(glm::dot(direction, p.geometricNormal) > 0))
            continue;
        const Hit met = near.trace.closestHit({origin, direction, 0, reach}, TraceMask::Static);
        if (!met || !(near.reach[met.instance] > 0))
            continue;
        const std::optional<SurfacePoint> point = surfacePoint(near.trace, met);
        if (point && point->emission != glm::vec3(0))
            continue;
        const float weight = glm::pi<float>() / float(near.rays) * nearWeight(met.t, reach);
        found.push_back({met, point, direction, weight, raySampler});
    }
    return found;
}

glm::vec3 nearCorrection(const NearLight& near, const Hit& hit, const SurfacePoint& p,
                         const Sampler& sampler) {
    ValueSink value{near.trace};
    walkNearLight(near, hit, p, sampler, value);
    return value.sum;
}

} // namespace limn
