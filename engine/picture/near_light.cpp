// SPDX-License-Identifier: MIT
#include "engine/picture/near_light.h"

#include "engine/field/sample_field.h"
#include "engine/lightmap/near_reach.h"
#include "engine/picture/field_lobe.h"
#include "engine/shading/direct_light.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

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
    const float most = near.rays > 0 ? near.reach[hit.instance] : 0;
    if (!(most > 0))
        return found;
    const float reach = nearReachAt(near.layout, most, hit.instance,
                                    near.trace.scene().instances[hit.instance].mesh, hit.triangle,
                                    hit.u, hit.v, !hit.frontFace);
    const glm::vec3 origin = rayOrigin(near.trace, p);
    for (std::uint32_t k = 0; k < near.rays; ++k) {
        const Sampler own{sampler.seed, sampler.index * near.rays + k};
        const glm::vec3 direction = sampleCosineHemisphere(p.normal, own.pair(kDirection));
        if (!(glm::dot(direction, p.geometricNormal) > 0))
            continue;
        const Hit met = near.trace.closestHit({origin, direction, 0, reach}, TraceMask::Static);
        if (!met || !(near.reach[met.instance] > 0))
            continue;
        const std::optional<SurfacePoint> point = surfacePoint(near.trace, met);
        if (point && point->emission != glm::vec3(0))
            continue;
        const float weight = glm::pi<float>() / float(near.rays) * nearWeight(met.t, reach);
        found.push_back({met, point, direction, weight, own});
    }
    return found;
}

/// Radiance towards the point that found it.
static glm::vec3 radianceOf(const NearLight& near, const NearSurface& s) {
    if (!s.point)
        return glm::vec3(0);
    std::uint64_t rays = 0;
    const glm::vec3 direct = sampleDirectLight(near.trace, *s.point, s.sampler.pair(kNearPick).x,
                                               s.sampler.pair(kNearOnLight), rays)
                                 .irradiance;
    const glm::vec3 bounced =
        sampleIrradiance(fieldPoint(near.field, near.layout, near.trace.scene(), s.hit, *s.point));
    return s.point->albedo / glm::pi<float>() * (direct + bounced);
}

glm::vec3 nearCorrection(const NearLight& near, const Hit& hit, const SurfacePoint& p,
                         const Sampler& sampler) {
    const FieldPoint at = fieldPoint(near.field, near.layout, near.trace.scene(), hit, p);
    glm::vec3 sum(0);
    for (const NearSurface& s : findNearSurfaces(near, hit, p, sampler))
        sum += s.weight * (radianceOf(near, s) - sampleRadiance(at, s.direction));
    return sum;
}

} // namespace limn
