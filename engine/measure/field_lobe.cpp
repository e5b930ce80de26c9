// SPDX-License-Identifier: MIT
#include "engine/measure/field_lobe.h"

#include "engine/math/lobe.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/scene/surface/reflection_lobe.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

FieldPoint fieldPoint(const IndirectField& field, const LightmapLayout& layout, const Scene& scene,
                      const Hit& hit, const SurfacePoint& p) {
    return {field, layout, scene,      hit.instance, hit.triangle,
            hit.u, hit.v,  p.position, p.normal,     !hit.frontFace};
}

FieldLobe fieldLobe(const FieldPoint& at, const GlossyPoint& g, int bands, bool windowed) {
    const glm::vec3 n = g.surface.normal;
    const ReflectionLobe lobe =
        reflectionLobe(g.gloss.roughness, glm::clamp(glm::dot(n, g.toEye), 0.f, 1.f));
    FieldLobe found{.axis = lobeAxis(lobe, n, glm::reflect(-g.toEye, n)),
                    .bands = bands,
                    .factors = windowed ? windowedFactors(lobe.factors, bands) : lobe.factors,
                    .weight = g.gloss.F0 * lobe.share.x + lobe.share.y};
    const bool hemisphere =
        at.instance < at.layout.instances.size() && !at.layout.instances[at.instance].uv.empty();
    if (hemisphere)
        found.weight /=
            hemisphereSeen(found.factors, bands, glm::dot(found.axis, g.surface.geometricNormal));
    return found;
}

std::vector<int> reflectedBands(const Scene& scene, const IndirectField& field) {
    std::vector<int> bands;
    for (const Material& m : scene.materials)
        bands.push_back(receiverBands(*scene.assets, m, int(field.bands)));
    return bands;
}

} // namespace limn
