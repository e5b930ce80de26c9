// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/emitted_field.h"

#include "engine/core/flush_denormals.h"
#include "engine/field/grid_placement.h"
#include "engine/math/sh.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"
#include "engine/techniques/illuminance/relight/occlusion/link_occlusion.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"

#include <algorithm>

namespace limn {

/// Radiosity of the tree's nodes where surfaces reflect nothing, as withLuma [W m^-2].
static std::vector<glm::vec4> emittedRadiosity(const Bake& bake, const Scene& scene) {
    std::vector<glm::vec3> albedo, emitted;
    surfelMaterials(bake.surfels, scene, albedo, emitted);
    std::vector<glm::vec4> radiosity(bake.tree.size(), glm::vec4(0));
    std::ranges::transform(emitted, radiosity.begin(), withLuma);
    std::ranges::transform(skyRadiosity(bake.tree, scene.sky),
                           radiosity.begin() + bake.tree.surfels, withLuma);
    pullRadiosity(bake.tree, radiosity);
    return radiosity;
}

IndirectField emittedField(const std::shared_ptr<const Bake>& bake, const Scene& scene) {
    const FlushDenormals flush;
    const Caches& caches = bake->caches;
    const int bands = std::min(int(bake->settings.bands), kIrradianceBands);
    const auto coefficients = std::size_t(bands * bands);
    const bool grid = caches.size() > caches.lightmapCount && needsGrid(scene, bake->lightmap);
    const std::uint32_t count = grid ? std::uint32_t(caches.size()) : caches.lightmapCount;

    std::vector<std::uint16_t> halfs;
    if (bands < int(bake->settings.bands))
        halfs = firstHalfs(caches, bands);
    LinkOcclusion occlusion;
    OccludedLinks open;
    if (updateLinkOcclusion(*bake, scene, occlusion))
        occludeLinks(*bake, occlusion, halfs, open);
    const LightBands lit = bounceBands(bake->settings, bands);
    const CacheRuns runs = runsOf(0, count);
    std::vector<glm::vec3> sh(count * coefficients);
    lightCaches(open.cones.links.empty() ? caches : open.cones, allLinks(caches),
                emittedRadiosity(*bake, scene), lit, runs, sh,
                open.halfs.empty() ? halfs : open.halfs);
    continueCaches(caches, bands, runs, sh);
    fillInvalidCaches(caches, bands, runs, sh);
    dropChroma(finalBands(bake->settings, bands), runs, sh);

    IndirectField field;
    field.bands = std::uint32_t(bands);
    field.chromaBands = std::uint32_t(finalBands(bake->settings, bands).chroma);
    field.lightmapWidth = bake->lightmap.width;
    field.lightmapHeight = bake->lightmap.height;
    field.continues = true;
    const std::size_t texels = std::size_t(field.lightmapWidth) * field.lightmapHeight;
    field.lightmap.assign(texels * coefficients, glm::vec4(0));
    for (std::size_t c = 0; c < caches.lightmapCount; ++c)
        placeCache(caches, sh, c, coefficients, texels, field.lightmap);
    field.gridBounds = bake->gridBounds;
    if (grid) {
        field.gridSize = bake->gridSize;
        field.gridDepth = {bake, &bake->gridDepth};
        field.grid.assign(field.cells() * coefficients, glm::vec4(0));
        for (std::size_t c = caches.lightmapCount; c < caches.size(); ++c)
            placeCache(caches, sh, c, coefficients, field.cells(), field.grid);
    }
    return field;
}

} // namespace limn
