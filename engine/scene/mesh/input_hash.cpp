// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/input_hash.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"

namespace limn {

static std::uint64_t hashTexture(const Assets& assets, const TextureRef& t, std::uint64_t h) {
    h = hashValue(t.image, hashValue(t.texCoord, h));
    for (const float v : {t.offset.x, t.offset.y, t.scale.x, t.scale.y, t.rotation})
        h = hashValue(v, h);
    h = hashValue(
        std::uint32_t(t.wrapU) << 16 | std::uint32_t(t.wrapV) << 8 | std::uint32_t(t.nearest), h);
    if (t.image >= 0)
        h = hashVector(assets.images[std::size_t(t.image)].rgba, h);
    return h;
}

std::uint64_t hashMesh(const Mesh& mesh) {
    std::uint64_t h = hashVector(mesh.positions, hashVector(mesh.indices, 5));
    for (const std::vector<glm::vec2>& uv : mesh.furtherUv)
        h = hashVector(uv, h);
    return hashVector(mesh.normals, hashVector(mesh.uv0, hashVector(mesh.uv1, h)));
}

std::vector<std::uint64_t> hashMeshes(const Scene& scene) {
    std::vector<std::uint64_t> hashes(scene.assets ? scene.assets->meshes.size() : 0);
    parallelRanges(hashes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m)
            hashes[m] = hashMesh(scene.assets->meshes[m]);
    });
    return hashes;
}

std::uint64_t hashSurface(const Scene& scene, const Material& m, std::uint64_t seed) {
    std::uint64_t h =
        hashValue(std::uint32_t(m.doubleSided) << 8 | std::uint32_t(m.alphaMode), seed);
    if (isCutout(m)) {
        h = hashValue(m.alphaCutoff, hashValue(m.baseColor.w, h));
        h = hashTexture(*scene.assets, m.baseColorTexture, h);
    }
    if (isGlassSheet(m))
        h = hashValue(std::uint32_t(1), h);
    return h;
}

std::uint64_t hashStatic(const Scene& scene, std::uint64_t h) {
    for (const Instance& i : scene.instances) {
        h = hashValue(i.mesh, hashValue(std::uint32_t(i.dynamic), hashValue(i.node, h)));
        if (i.dynamic)
            continue; // its place and its material do not affect a bake
        h = hashBytes(&i.toWorld, sizeof i.toWorld, h);
        if (i.texelDensity != 1)
            h = hashValue(i.texelDensity, h);
        // Whether a material emits guides the sampling; how much it emits does not.
        const Material& m = scene.materialOf(i);
        h = hashSurface(scene, m, hashValue(std::uint32_t(emits(m)), h));
    }
    return hashVector(hashMeshes(scene), h);
}

bool emits(const Material& m) {
    return m.emission.x > 0 || m.emission.y > 0 || m.emission.z > 0;
}

} // namespace limn
