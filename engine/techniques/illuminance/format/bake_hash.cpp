// SPDX-License-Identifier: MIT
#include "engine/core/hash.h"
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/format/bake.h"

namespace limn {

namespace {

std::uint64_t hashSettings(const BakeSettings& s, std::uint64_t h) {
    for (const std::uint32_t v :
         {s.surfels, s.links, s.bands, s.rays, s.lightmapCaches, s.grid.x, s.grid.y, s.grid.z})
        h = hashValue(v, h);
    h = hashValue(s.placement, hashValue(s.linker, hashValue(s.cut, h)));
    h = hashValue(s.clustering, hashValue(s.clusterNormalWeight, h));
    h = hashValue(s.clusterBalanceWeight, h);
    h = hashValue(s.storage, hashValue(s.chromaBands, h));
    return hashValue(s.texelsPerMetre, h);
}

} // namespace

std::uint64_t Bake::hash() const {
    std::uint64_t h = hashSettings(settings, hashValue(sceneHash, 1));
    h = hashLayout(lightmap, h);
    const Surfels& s = surfels;
    h = hashVector(s.position, hashVector(s.normal, hashVector(s.area, hashVector(s.instance, h))));
    h = hashVector(s.lightPoints, hashVector(s.lightNormals, h));
    h = hashVector(s.triangle,
                   hashVector(s.barycentric, hashVector(s.cache, hashVector(s.cacheWeight, h))));
    const ClusterTree& t = tree;
    h = hashVector(t.left, hashVector(t.right, hashVector(t.leftWeight, hashVector(t.parent, h))));
    h = hashVector(t.skyDirection, hashValue(t.surfels, h));
    const Caches& c = caches;
    h = hashVector(c.kind, hashVector(c.position, hashVector(c.normal, hashVector(c.texel, h))));
    h = hashVector(c.linkBegin, hashVector(c.links, hashValue(c.lightmapCount, h)));
    h = hashVector(c.linkExponent, hashVector(c.shNode, hashVector(c.shCoefficients, h)));
    h = hashVector(gridDepth, h);
    return hashVector(c.fillBegin, hashVector(c.fillSource, hashVector(c.fillWeight, h)));
}

std::uint64_t bakeInputHash(const Scene& scene) {
    return hashStatic(scene, hashSettings(scene.bake, 2));
}

} // namespace limn
