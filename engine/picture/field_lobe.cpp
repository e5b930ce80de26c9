// SPDX-License-Identifier: MIT
#include "engine/picture/field_lobe.h"

#include "engine/math/lobe.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/scene/surface/reflection_lobe.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

FieldPoint fieldPoint(const IndirectField& field, const LightmapLayout& layout, const Scene& scene,
                      const Hit& hit, const SurfacePoint& p) {
    return {field, layout,     scene,    hit.instance,   hit.triangle,     hit.u,
            hit.v, p.position, p.normal, !hit.frontFace, p.geometricNormal};
}

static ReflectionLobe lobeOf(const GlossyPoint& g) {
    return reflectionLobe(g.gloss.roughness,
                          glm::clamp(glm::dot(g.surface.normal, g.toEye), 0.f, 1.f));
}

static glm::vec3 axisOf(const ReflectionLobe& lobe, const GlossyPoint& g) {
    return lobeAxis(lobe, g.surface.normal, glm::reflect(-g.toEye, g.surface.normal));
}

FieldLobe fieldLobe(const FieldPoint& point, const GlossyPoint& g, int bands, bool windowed) {
    const ReflectionLobe lobe = lobeOf(g);
    FieldLobe found{.axis = axisOf(lobe, g),
                    .bands = bands,
                    .factors = windowed ? windowedFactors(lobe.factors, bands) : lobe.factors,
                    .weight = g.gloss.F0 * lobe.share.x + lobe.share.y};
    const bool hemisphere = point.instance < point.layout.instances.size() &&
                            !point.layout.instances[point.instance].uv.empty();
    if (hemisphere)
        found.weight /=
            hemisphereSeen(found.factors, bands, glm::dot(found.axis, g.surface.geometricNormal));
    return found;
}

std::vector<bool> glossyReceivers(const Scene& scene) {
    std::vector<bool> glossy;
    for (const Material& m : scene.materials)
        glossy.push_back(receiverBands(*scene.assets, m, kMaxBands) > kIrradianceBands);
    return glossy;
}

FieldReflection fieldReflection(const TraceScene& trace, const GlossyPoint& g) {
    const ReflectionLobe lobe = lobeOf(g);
    // Half of the microfacets seen along the normal are tilted by less than atan(alpha).
    const float alpha = g.gloss.roughness * g.gloss.roughness;
    return {.lobe = {.origin = rayOrigin(trace, g.surface),
                     .axis = axisOf(lobe, g),
                     .spread = 2 * std::atan(alpha)},
            .weight = g.gloss.F0 * lobe.share.x + lobe.share.y};
}

std::vector<int> reflectedBands(const Scene& scene, const IndirectField& field) {
    std::vector<int> bands;
    for (const Material& m : scene.materials)
        bands.push_back(receiverBands(*scene.assets, m, int(field.bands)));
    return bands;
}

} // namespace limn
