// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/lightmap/plain_lightmap.h"
#include "engine/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// A PlainLightmap divided over textures of one size, its pages. A page holds copies of the charts'
/// texels, so that a lookup on a page reads what the same lookup in the whole lightmap does.
struct LightmapPages {
    /// Texels of the lightmap that are copied to a page.
    struct Copy {
        glm::uvec2 from{0}, size{0}, to{0}; ///< [texels]
        std::uint32_t page = 0;
    };
    /// One side of an instance; both are empty where it has no lightmap or no such side.
    struct Side {
        std::vector<glm::vec2> uv;       ///< per vertex of MeshCharts, normalised within its page
        std::vector<std::uint32_t> page; ///< per chart of MeshCharts
    };

    std::uint32_t factor = 1; ///< of the PlainLightmap
    std::uint32_t count = 1;
    std::uint32_t width = 0, height = 0;        ///< of every page [texels]
    std::vector<std::array<Side, 2>> instances; ///< as Scene::instances: front and back
    std::vector<Copy> copies;
};

/// The lightmap as a single page, with the layout's own coordinates.
LightmapPages onePage(const Scene& scene, const LightmapLayout& layout, std::uint32_t factor);

/// The same in as many pages of at most `maxSide` texels a side as its charts need; one page if it
/// fits as it is. Charts are placed in the order of instances, so few instances are spread over
/// several pages.
/// Precondition: largestChart() times the factor is at most `maxSide`.
LightmapPages lightmapPages(const Scene& scene, const LightmapLayout& layout, std::uint32_t factor,
                            std::uint32_t maxSide);

/// About the number of those pages, without placing any chart.
std::uint32_t expectedPages(const Scene& scene, const LightmapLayout& layout, std::uint32_t factor,
                            std::uint32_t maxSide);

/// The longest side of a chart in texels of the layout, and the instance that has it.
struct LargestChart {
    std::uint32_t side = 0, instance = 0;
};
LargestChart largestChart(const Scene& scene, const LightmapLayout& layout);

/// PlainLightmap::texelAt of a page. Texels outside charts repeat their nearest neighbour.
std::vector<std::uint32_t> pageTexels(const PlainLightmap& plain, const LightmapPages& pages,
                                      std::uint32_t page);

} // namespace limn
