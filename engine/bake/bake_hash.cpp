// SPDX-License-Identifier: MIT
#include "engine/bake/bake.h"
#include "engine/core/hash.h"

namespace limn {

namespace {

std::uint64_t hashLayout(const LightmapLayout& layout, std::uint64_t h) {
    h = hashValue(layout.width, hashValue(layout.height, h));
    for (const MeshCharts& m : layout.meshes) {
        h = hashVector(m.sourceVertex, hashVector(m.indices, h));
        h = hashVector(m.chartOfTriangle, hashVector(m.chartUv, hashVector(m.chartSize, h)));
    }
    for (const InstanceLightmap& i : layout.instances)
        h = hashVector(i.uv, h);
    return h;
}

std::uint64_t hashSettings(const BakeSettings& s, std::uint64_t h) {
    for (const std::uint32_t v :
         {s.surfels, s.links, s.bands, s.rays, s.lightmapCaches, s.grid.x, s.grid.y, s.grid.z})
        h = hashValue(v, h);
    h = hashValue(s.clustering, hashValue(s.clusterNormalWeight, h));
    h = hashValue(s.clusterBalanceWeight, h);
    return hashValue(s.texelsPerMetre, h);
}

std::uint64_t hashTexture(const Assets& assets, const TextureRef& t, std::uint64_t h) {
    h = hashValue(t.image, hashValue(t.texCoord, h));
    for (const float v : {t.offset.x, t.offset.y, t.scale.x, t.scale.y, t.rotation})
        h = hashValue(v, h);
    h = hashValue(
        std::uint32_t(t.wrapU) << 16 | std::uint32_t(t.wrapV) << 8 | std::uint32_t(t.nearest), h);
    if (t.image >= 0)
        h = hashVector(assets.images[std::size_t(t.image)].rgba, h);
    return h;
}

} // namespace

std::uint64_t Bake::hash() const {
    std::uint64_t h = hashSettings(settings, hashValue(sceneHash, 1));
    h = hashLayout(lightmap, h);
    const Surfels& s = surfels;
    h = hashVector(s.position, hashVector(s.normal, hashVector(s.area, hashVector(s.instance, h))));
    h = hashVector(s.triangle,
                   hashVector(s.barycentric, hashVector(s.cache, hashVector(s.cacheWeight, h))));
    const ClusterTree& t = tree;
    h = hashVector(t.left, hashVector(t.right, hashVector(t.leftWeight, hashVector(t.parent, h))));
    h = hashVector(t.skyDirection, hashValue(t.surfels, h));
    const Caches& c = caches;
    h = hashVector(c.kind, hashVector(c.position, hashVector(c.normal, hashVector(c.texel, h))));
    h = hashVector(c.linkBegin, hashVector(c.links, hashValue(c.lightmapCount, h)));
    return hashVector(c.fillBegin, hashVector(c.fillSource, hashVector(c.fillWeight, h)));
}

std::uint64_t bakeInputHash(const Scene& scene) {
    std::uint64_t h = hashSettings(scene.bake, 2);
    for (const Instance& i : scene.instances) {
        h = hashValue(i.mesh, hashValue(std::uint32_t(i.dynamic), h));
        h = hashBytes(&i.toWorld, sizeof i.toWorld, h);
        const Material& m = scene.materialOf(i);
        // Whether it emits guides the sampling; how much does not.
        const bool emits = m.emission.x > 0 || m.emission.y > 0 || m.emission.z > 0;
        h = hashValue(std::uint32_t(emits) << 16 | std::uint32_t(m.doubleSided) << 8 |
                          std::uint32_t(m.alphaMode),
                      h);
        if (m.alphaMode == AlphaMode::Mask) {
            h = hashValue(m.alphaCutoff, hashValue(m.baseColor.w, h));
            h = hashTexture(*scene.assets, m.baseColorTexture, h);
        }
    }
    if (scene.assets)
        for (const Mesh& m : scene.assets->meshes) {
            h = hashVector(m.positions, hashVector(m.indices, h));
            h = hashVector(m.uv0, hashVector(m.uv1, h));
        }
    return h;
}

} // namespace limn
