// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/relight_buffers.h"

#include "engine/gpu/storage_maker.h"
#include "engine/math/packing.h"
#include "engine/techniques/illuminance/gpu/tree_levels.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include <glm/glm.hpp>

namespace limn {

using shared::GpuCache;
using shared::GpuFill;
using shared::GpuSurfel;

static std::vector<GpuSurfel> packSurfels(const Bake& bake) {
    const Surfels& surfels = bake.surfels;
    const std::vector<float> share = seenShares(bake.tree);
    std::vector<GpuSurfel> out(surfels.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = {surfels.position[i], share[i],         surfels.normal[i],
                  surfels.area[i],     surfels.cache[i], surfels.cacheWeight[i]};
    return out;
}

static std::vector<glm::uvec4> packLightPoints(const Surfels& surfels) {
    const std::vector<glm::vec3>&positions = surfels.litAt(), &normals = surfels.litNormals();
    std::vector<glm::uvec4> out;
    out.reserve(positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k)
        out.emplace_back(glm::floatBitsToUint(positions[k]), packOctWord(normals[k]));
    return out;
}

std::vector<GpuCache> packCaches(const Caches& caches, LinkEnds ends) {
    std::vector<GpuCache> out(caches.size());
    for (std::size_t c = 0; c < out.size(); ++c)
        out[c] = {caches.linkBegin[c], ends[c],          std::ldexp(1.f, -caches.linkExponent[c]),
                  caches.texel[c],     caches.normal[c], 0};
    return out;
}

/// Packs links of LinkStorage::Sh: a node, then its halfs in pairs.
static std::vector<std::uint32_t> packHarmonics(const Caches& caches, std::size_t coefficients) {
    const std::size_t words = 1 + (coefficients + 1) / 2;
    std::vector<std::uint32_t> out(caches.shNode.size() * words);
    for (std::size_t k = 0; k < caches.shNode.size(); ++k) {
        out[k * words] = caches.shNode[k];
        std::memcpy(&out[k * words + 1], &caches.shCoefficients[k * coefficients],
                    coefficients * sizeof(std::uint16_t));
    }
    return out;
}

static gpu::Buffer uploadLinks(gpu::StorageMaker& make, const Caches& caches,
                               std::size_t coefficients) {
    static_assert(sizeof(Link) == RELIGHT_CONE_WORDS * 4);
    return caches.shNode.empty() ? make.filled(caches.links, "links")
                                 : make.filled(packHarmonics(caches, coefficients), "links");
}

static void uploadFills(gpu::StorageMaker& make, const Caches& caches, RelightBuffers& out) {
    std::vector<GpuFill> fills;
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        if (caches.fillBegin[c] == caches.fillBegin[c + 1])
            continue;
        fills.push_back({c, caches.fillBegin[c], caches.fillBegin[c + 1], 0});
        out.lightmapFills += c < caches.lightmapCount;
    }
    std::vector<glm::uvec2> sources(caches.fillSource.size());
    for (std::size_t k = 0; k < sources.size(); ++k)
        sources[k] = {caches.fillSource[k], std::bit_cast<std::uint32_t>(caches.fillWeight[k])};
    out.fillCount = std::uint32_t(fills.size());
    out.fills = make.filled(fills, "invalid caches");
    out.fillSources = make.filled(sources, "sources of invalid caches");
}

std::vector<const gpu::Buffer*> RelightBuffers::inBindingOrder() const {
    return {&surfels, &direct,      &albedo,      &emitted, &indirect, &radiosity,
            &change,  &innerNodes,  &levels,      &caches,  &links,    &sh,
            &fills,   &fillSources, &field->grid, &order};
}

Result<RelightBuffers> createRelightBuffers(gpu::Device& device, const Bake& bake,
                                            std::uint32_t lanes) {
    const std::size_t surfels = bake.surfels.size(), color = sizeof(glm::vec4);
    const std::size_t coefficients = std::size_t(bake.settings.bands) * bake.settings.bands;
    const TreeLevels levels = treeLevels(bake.tree);
    RelightBuffers out;
    std::string error;
    {
        gpu::StorageMaker make(device, "bake fewer links, caches or bands");
        out.surfels = make.filled(packSurfels(bake), "surfels");
        out.lightPoints = make.filled(packLightPoints(bake.surfels), "light points");
        out.innerNodes = make.filled(levels.nodes, "inner nodes");
        out.levels = make.filled(levels.begin, "tree levels");
        out.caches = make.filled(packCaches(bake.caches, allLinks(bake.caches)), "caches");
        out.links = uploadLinks(make, bake.caches, coefficients);
        uploadFills(make, bake.caches, out);
        out.direct = make.empty(surfels, color, "direct irradiance");
        out.albedo = make.empty(surfels, color, "albedo");
        out.emitted = make.empty(surfels, color, "emitted radiosity");
        out.indirect = make.empty(surfels, color, "indirect irradiance");
        out.radiosity = make.empty(bake.tree.size(), color, "radiosity");
        out.sh = make.empty(bake.caches.size() * coefficients, color, "cache harmonics");
        out.change = make.empty(RelightBuffers::kBounces * ((surfels + lanes - 1) / lanes),
                                sizeof(glm::vec4), "change", gpu::MemoryKind::Readback);
        std::vector<std::uint32_t> order;
        for (std::uint32_t c = bake.caches.lightmapCount; c < bake.caches.size(); ++c)
            order.push_back(c);
        order.resize(order.size() + RelightBuffers::kCacheLists * bake.caches.lightmapCount);
        out.order = make.filled(order, "lists of caches");
        if (!bake.gridDepth.empty())
            out.gridDepth =
                std::make_shared<const gpu::Buffer>(make.filled(bake.gridDepth, "grid depths"));
        error = make.error;
    }
    if (!error.empty())
        return fail(error);
    out.levelBegin = levels.begin;
    gpu::clearBuffers(device, {out.indirect.handle, out.radiosity.handle});
    return out;
}

void makeRelitField(gpu::Device& device, const Bake& bake, std::uint32_t bands,
                    std::uint32_t chroma, RelightBuffers& buffers) {
    assert(bands <= bake.settings.bands && chroma <= bands);
    // Every cell is a cache, so the grid is no larger than the buffer of harmonics, which fits.
    buffers.field = createWrittenField(device, {.lightmapWidth = bake.lightmap.width,
                                                .lightmapHeight = bake.lightmap.height,
                                                .bands = bands,
                                                .chroma = chroma,
                                                .gridSize = bake.gridSize,
                                                .gridBounds = bake.gridBounds,
                                                .gridDepth = buffers.gridDepth,
                                                .continues = true});
    gpu::clearBuffers(device, {buffers.sh.handle});
}

} // namespace limn
