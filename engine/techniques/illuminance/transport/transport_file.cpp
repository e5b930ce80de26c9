// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/transport/transport_file.h"

#include "engine/scene/light/light_parts.h"
#include "engine/scene/light/photometry.h"
#include "engine/techniques/illuminance/format/bake_defect.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"
#include "engine/techniques/illuminance/transport/occluder_tree.h"
#include "engine/techniques/illuminance/transport/rounded_links.h"
#include "engine/techniques/illuminance/transport/transport_meta.h"
#include "engine/techniques/illuminance/transport/transport_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::uint32_t kNoCache = ~0U;

/// The lightmap's texels as weighted caches, one row after the other.
struct LightmapParts {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> begin = {0}; ///< per texel (+1)
    std::vector<std::uint32_t> cache;
    std::vector<std::uint16_t> weight; ///< unorm; a texel's sum to 65535
};

/// Weights of sum 1 as whole 65535ths of that sum: those with the largest remainders are rounded
/// up.
std::array<std::uint16_t, 4> wholeWeights(const glm::vec4& weight) {
    constexpr int kWhole = 65535;
    std::array<std::uint16_t, 4> whole{};
    std::array<float, 4> rest{};
    int missing = kWhole;
    for (int k = 0; k < 4; ++k) {
        const float exact = weight[k] * kWhole;
        whole[std::size_t(k)] = std::uint16_t(std::min(int(exact), missing));
        rest[std::size_t(k)] = weight[k] > 0 ? exact - std::floor(exact) : -1;
        missing -= whole[std::size_t(k)];
    }
    for (; missing > 0; --missing) {
        const auto largest = std::size_t(std::ranges::max_element(rest) - rest.begin());
        ++whole[largest];
        rest[largest] -= 1;
    }
    return whole;
}

/// The cache of each texel of the bake's lightmap.
std::vector<std::uint32_t> cachesOfTexels(const Bake& bake) {
    std::vector<std::uint32_t> caches(std::size_t(bake.lightmap.width) * bake.lightmap.height,
                                      kNoCache);
    for (std::uint32_t c = 0; c < bake.caches.lightmapCount; ++c)
        caches[bake.caches.texel[c]] = c;
    return caches;
}

LightmapParts ownLightmap(const Bake& bake) {
    LightmapParts parts{bake.lightmap.width, bake.lightmap.height};
    for (const std::uint32_t cache : cachesOfTexels(bake)) {
        if (cache != kNoCache) {
            parts.cache.push_back(cache);
            parts.weight.push_back(65535);
        }
        parts.begin.push_back(std::uint32_t(parts.cache.size()));
    }
    return parts;
}

std::string shapeDefect(const TransportLightmap& map) {
    constexpr std::uint32_t kMaxSide = 1U << 16;
    const std::uint64_t texels = std::uint64_t(map.width) * map.height;
    if (map.width > kMaxSide || map.height > kMaxSide)
        return "is too large";
    return map.texel.size() != texels || map.weight.size() != texels
               ? "has another number of texels than its size says"
               : "";
}

Result<LightmapParts> partsOf(const Bake& bake, const TransportLightmap& map) {
    if (const std::string defect = shapeDefect(map); !defect.empty())
        return fail("the lightmap " + defect);
    const std::vector<std::uint32_t> caches = cachesOfTexels(bake);
    LightmapParts parts{map.width, map.height};
    for (std::size_t t = 0; t < map.texel.size(); ++t) {
        const glm::vec4 w = map.weight[t];
        const float sum = w.x + w.y + w.z + w.w;
        if (!(std::min({w.x, w.y, w.z, w.w}) >= 0) || !(sum == 0 || std::abs(sum - 1) < 1e-3f))
            return fail(fmt::format("the lightmap's texel {} has weights that do not sum to 1", t));
        const std::array<std::uint16_t, 4> whole =
            sum > 0 ? wholeWeights(w / sum) : std::array<std::uint16_t, 4>{};
        for (int k = 0; k < 4; ++k) {
            if (whole[std::size_t(k)] == 0)
                continue;
            const std::uint32_t texel = map.texel[t][k];
            if (texel >= caches.size() || caches[texel] == kNoCache)
                return fail(fmt::format("the lightmap's texel {} names one without cache", t));
            parts.cache.push_back(caches[texel]);
            parts.weight.push_back(whole[std::size_t(k)]);
        }
        parts.begin.push_back(std::uint32_t(parts.cache.size()));
    }
    return parts;
}

/// A light as section LGHT has it.
struct LightRecord {
    std::uint32_t kind, flags;
    glm::vec3 position, direction, color;
    float strength, range, innerAngle, outerAngle, width, height, roll;
    std::uint32_t source, reserved;
};
static_assert(sizeof(LightRecord) == 80);

/// All lights, rectangles divided where surfaces cut through them.
std::vector<LightRecord> lightRecords(const Scene& scene) {
    std::vector<LightRecord> records;
    for (std::uint32_t k = 0; k < scene.lights.size(); ++k) {
        const Light whole = withoutProfile(scene.lights[k]);
        std::vector<Light> parts = {whole};
        if (whole.kind == LightKind::Rectangle)
            parts = partsBetweenWalls(whole, scene);
        for (const Light& l : parts)
            records.push_back({std::uint32_t(l.kind), l.enabled ? 0U : 1U, l.position, l.direction,
                               l.color, l.strength, l.range, l.innerAngle, l.outerAngle, l.size.x,
                               l.size.y, l.roll, k, 0});
    }
    return records;
}

/// The power of two above the largest coordinate of the static surfaces, as TraceScene has it.
float magnitudeOf(const Scene& scene) {
    const bool anyStatic =
        std::ranges::any_of(scene.instances, [](const Instance& i) { return !i.dynamic; });
    const Bounds b = anyStatic ? staticBounds(scene) : scene.bounds;
    const glm::vec3 magnitudes = glm::max(glm::abs(b.lower), glm::abs(b.upper));
    const float largest = std::max({magnitudes.x, magnitudes.y, magnitudes.z});
    return largest > 0 ? std::exp2(std::ceil(std::log2(largest))) : 0;
}

std::string materialNames(const Scene& scene) {
    std::string names;
    for (const Material& m : scene.materials)
        names += std::string(m.name.c_str()) + '\0'; // a name ends at its first 0
    return names;
}

void addSenders(const TransportInput& in, TransportSections& out) {
    const Surfels& s = in.bake.surfels;
    const ClusterTree& tree = in.bake.tree;
    constexpr float kPerRadiance = 1 / std::numbers::pi_v<float>;
    std::vector<glm::vec3> albedo, emission, sky = skyRadiosity(tree, in.scene.sky);
    surfelMaterials(s, in.scene, albedo, emission);
    for (glm::vec3& e : emission)
        e = glm::min(e * kPerRadiance, kMaxLight);
    for (glm::vec3& radiance : sky)
        radiance = glm::min(radiance * kPerRadiance, kMaxLight);
    std::vector<std::uint32_t> material(s.size());
    for (std::size_t k = 0; k < s.size(); ++k)
        material[k] = in.scene.instances[s.instance[k]].material;
    std::vector<glm::uvec2> children(tree.left.size());
    for (std::size_t k = 0; k < children.size(); ++k)
        children[k] = {tree.left[k], tree.right[k]};
    std::vector<glm::vec4> weight = s.cacheWeight;
    for (std::size_t k = 0; k < weight.size(); ++k)
        for (int j = 0; j < 4; ++j)
            if (s.cache[k][j] == kNoCache)
                weight[k][j] = 0;
    out.add("SPOS", s.position);
    out.add("SLPT", s.lightPoints);
    out.add("SLNM", s.lightNormals);
    out.add("SNRM", s.normal);
    out.add("SALB", albedo);
    out.add("SEMI", emission);
    out.add("SARE", s.area);
    out.add("SMAT", material);
    out.add("SINS", s.instance);
    out.add("SCAC", s.cache);
    out.add("SCWT", weight);
    out.add("TCHI", children);
    out.add("TWGT", tree.leftWeight);
    out.add("SKYD", tree.skyDirection);
    out.add("SKYL", sky);
}

void addReceivers(const TransportInput& in, const LightmapParts& parts, TransportSections& out) {
    const Bake& bake = in.bake;
    const Caches& c = bake.caches;
    out.add("CPOS", c.position);
    out.add("CNRM", c.normal);
    out.add("LBEG", c.linkBegin);
    out.add("LEXP", c.linkExponent);
    if (in.roundedLinks)
        out.add("LINK", roundLinks(c.links));
    else
        out.add("LINK", c.links);
    out.add("FBEG", c.fillBegin);
    out.add("FSRC", c.fillSource);
    out.add("FWGT", c.fillWeight);
    out.add("LMBG", parts.begin);
    out.add("LMSR", parts.cache);
    out.add("LMWT", parts.weight);
    using Map = std::array<std::uint16_t, 256>;
    out.add("GDEP", std::span(reinterpret_cast<const Map*>(bake.gridDepth.data()),
                              bake.gridDepth.size() / std::tuple_size_v<Map>));
}

std::string inputDefect(const TransportInput& in) {
    if (in.bake.settings.storage != LinkStorage::Rtp)
        return "links are stored as harmonics, and a transport file holds cones: bake with "
               "--storage rtp";
    Scene scene = in.scene;
    scene.bake = in.bake.settings;
    if (in.bake.sceneHash != bakeInputHash(scene))
        return "the bake is one of another scene";
    if (in.bake.caches.linkCount() > 0xfffffff0U)
        return "too many links";
    return bakeDefect(in.bake, &scene);
}

} // namespace

Result<std::string> transportFile(const TransportInput& in) {
    if (const std::string defect = inputDefect(in); !defect.empty())
        return fail(defect);
    const Result<LightmapParts> parts =
        in.lightmap ? partsOf(in.bake, *in.lightmap) : Result<LightmapParts>(ownLightmap(in.bake));
    if (!parts)
        return tl::make_unexpected(parts.error());
    const OccluderTree occluders = occluderTree(in.scene);
    const std::vector<LightRecord> lights = lightRecords(in.scene);
    const Bake& b = in.bake;
    const auto count = [](const auto& v) { return std::uint32_t(v.size()); };
    const bool cells = count(b.caches.position) > b.caches.lightmapCount;
    const glm::uvec3 grid = cells ? b.gridSize : glm::uvec3(0);
    const std::vector<std::uint32_t> dims = {count(b.surfels.position),
                                             b.tree.skyCells,
                                             count(b.tree.left),
                                             count(b.caches.position),
                                             b.caches.lightmapCount,
                                             count(b.caches.links),
                                             count(b.caches.fillSource),
                                             b.settings.bands,
                                             chromaBandsOf(b.settings),
                                             count(in.scene.materials),
                                             count(lights),
                                             parts->width,
                                             parts->height,
                                             count(parts->cache),
                                             grid.x,
                                             grid.y,
                                             grid.z,
                                             count(occluders.triangles),
                                             count(occluders.boxes),
                                             count(occluders.cutouts.triangles),
                                             count(occluders.cutouts.masks),
                                             b.surfels.lightPoints.empty() ? 0 : kLightPoints,
                                             0,
                                             0};
    const Bounds& g = b.gridBounds;
    const std::array<float, 8> space = {
        g.lower.x, g.lower.y, g.lower.z, g.upper.x, g.upper.y, g.upper.z, magnitudeOf(in.scene), 0};
    TransportSections out;
    out.addBytes("META", 1, transportMeta(in, occluders, parts->width, parts->height));
    out.add("DIMS", dims);
    out.add("SPAC", std::span(&space, 1));
    out.addBytes("MNAM", 1, materialNames(in.scene));
    out.add("LGHT", lights);
    addSenders(in, out);
    addReceivers(in, *parts, out);
    out.add("CTRI", occluders.cutouts.triangles);
    out.add("CMSK", occluders.cutouts.masks);
    out.add("CTEX", occluders.cutouts.texels);
    out.add("OCUT", occluders.cutout);
    out.add("OBOX", occluders.boxes);
    out.add("OTRI", occluders.triangles);
    return out.file();
}

} // namespace limn
