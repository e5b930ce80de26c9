// SPDX-License-Identifier: MIT
#include "engine/lightmap/lightmap_pages.h"

#include "engine/lightmap/atlas.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include <glm/common.hpp>
#include <stb/stb_rect_pack.h>

namespace limn {

namespace {

/// Share of a page that charts of consecutive instances may cover before packing is tried.
constexpr double kFill = 0.9;

/// The texels that lookups in a chart read, on one side of an instance, in texels of the layout.
struct ChartBox {
    std::uint32_t instance, side, chart;
    glm::uvec2 lower, size;
};

glm::vec2 sizeOf(const LightmapLayout& layout) {
    return {float(layout.width), float(layout.height)};
}

/// The coordinates of an instance's vertices on that side.
std::vector<glm::vec2> uvOf(const LightmapLayout& layout, std::uint32_t instance,
                            std::uint32_t side) {
    std::vector<glm::vec2> uv = layout.instances[instance].uv;
    if (side == 1)
        for (glm::vec2& p : uv)
            p.y += backOffset(layout, instance);
    return uv;
}

std::uint32_t sidesOf(const InstanceLightmap& place) {
    return place.uv.empty() ? 0 : place.backRows > 0 ? 2 : 1;
}

/// The boxes of all charts, in the order of instances.
std::vector<ChartBox> chartBoxes(const Scene& scene, const LightmapLayout& layout) {
    std::vector<ChartBox> boxes;
    const glm::vec2 size = sizeOf(layout);
    for (std::uint32_t i = 0; i < layout.instances.size(); ++i) {
        const MeshCharts& charts = layout.meshes[scene.instances[i].mesh];
        for (std::uint32_t side = 0; side < sidesOf(layout.instances[i]); ++side) {
            constexpr float kFar = std::numeric_limits<float>::max();
            std::vector<glm::vec2> lower(charts.chartSize.size(), glm::vec2(kFar)),
                upper(charts.chartSize.size(), glm::vec2(-kFar));
            const std::vector<glm::vec2> uv = uvOf(layout, i, side);
            for (std::size_t k = 0; k < charts.indices.size(); ++k) {
                const std::uint32_t chart = charts.chartOfTriangle[k / 3];
                const glm::vec2 p = uv[charts.indices[k]] * size - 0.5f;
                lower[chart] = glm::min(lower[chart], p);
                upper[chart] = glm::max(upper[chart], p);
            }
            for (std::uint32_t c = 0; c < lower.size(); ++c) {
                if (lower[c].x > upper[c].x)
                    continue; // it has no triangle
                // Borders lie on centres of texels, up to rounding.
                constexpr float kRounding = 0.01f;
                const glm::vec2 first = glm::max(glm::floor(lower[c] + kRounding), glm::vec2(0));
                const glm::vec2 last =
                    glm::clamp(glm::ceil(upper[c] - kRounding), first, size - 1.f);
                boxes.push_back({i, side, c, glm::uvec2(first), glm::uvec2(last - first) + 1U});
            }
        }
    }
    return boxes;
}

std::uint64_t areaOf(const ChartBox& box) {
    return std::uint64_t(box.size.x) * box.size.y;
}

/// Packs boxes into a square of `side` texels and writes the places of those that fit. The others
/// keep page kNoPage.
constexpr std::uint32_t kNoPage = ~0U;
struct Place {
    glm::uvec2 position{0};
    std::uint32_t page = kNoPage;
};

void packPage(const std::vector<ChartBox>& boxes, std::span<const std::uint32_t> which,
              std::uint32_t side, std::uint32_t page, std::vector<Place>& places) {
    std::vector<stbrp_rect> rects;
    for (const std::uint32_t k : which)
        rects.push_back({int(k), int(boxes[k].size.x), int(boxes[k].size.y), 0, 0, 0});
    std::vector<stbrp_node> nodes(side);
    stbrp_context context;
    stbrp_init_target(&context, int(side), int(side), nodes.data(), int(nodes.size()));
    stbrp_pack_rects(&context, rects.data(), int(rects.size()));
    for (const stbrp_rect& r : rects)
        if (r.was_packed)
            places[std::size_t(r.id)] = {{std::uint32_t(r.x), std::uint32_t(r.y)}, page};
}

/// A place on a page of `side` texels for every box.
std::vector<Place> placesOf(const std::vector<ChartBox>& boxes, std::uint32_t side) {
    std::vector<Place> places(boxes.size());
    std::vector<std::uint32_t> waiting(boxes.size());
    for (std::uint32_t k = 0; k < waiting.size(); ++k)
        waiting[k] = k;
    const auto budget = std::uint64_t(kFill * double(side) * side);
    for (std::uint32_t page = 0; !waiting.empty(); ++page) {
        std::uint64_t area = 0;
        std::size_t tried = 0;
        for (; tried < waiting.size(); ++tried) {
            area += areaOf(boxes[waiting[tried]]);
            if (tried > 0 && area > budget)
                break;
        }
        packPage(boxes, std::span(waiting).first(tried), side, page, places);
        std::erase_if(waiting, [&](std::uint32_t k) { return places[k].page == page; });
    }
    return places;
}

} // namespace

LightmapPages onePage(const Scene& scene, const LightmapLayout& layout, std::uint32_t factor) {
    LightmapPages pages{
        .factor = factor, .width = layout.width * factor, .height = layout.height * factor};
    pages.copies = {{.size = {pages.width, pages.height}}};
    pages.instances.resize(layout.instances.size());
    for (std::uint32_t i = 0; i < layout.instances.size(); ++i)
        for (std::uint32_t side = 0; side < sidesOf(layout.instances[i]); ++side)
            pages.instances[i][side] = {
                uvOf(layout, i, side),
                std::vector<std::uint32_t>(layout.meshes[scene.instances[i].mesh].chartSize.size(),
                                           0)};
    return pages;
}

LightmapPages lightmapPages(const Scene& scene, const LightmapLayout& layout, std::uint32_t factor,
                            std::uint32_t maxSide) {
    LightmapPages pages = onePage(scene, layout, factor);
    if (std::max(pages.width, pages.height) <= maxSide)
        return pages;
    const std::vector<ChartBox> boxes = chartBoxes(scene, layout);
    const std::vector<Place> places = placesOf(boxes, maxSide / factor);
    glm::uvec2 used(1);
    pages.count = 1;
    pages.copies.clear();
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        const ChartBox& box = boxes[k];
        assert(places[k].page != kNoPage);
        used = glm::max(used, places[k].position + box.size);
        pages.count = std::max(pages.count, places[k].page + 1);
        pages.copies.push_back(
            {box.lower * factor, box.size * factor, places[k].position * factor, places[k].page});
        pages.instances[box.instance][box.side].page[box.chart] = places[k].page;
    }
    pages.width = used.x * factor;
    pages.height = used.y * factor;
    std::vector<glm::vec2> shift;
    std::size_t k = 0;
    for (std::uint32_t i = 0; i < pages.instances.size(); ++i) {
        const MeshCharts& charts = layout.meshes[scene.instances[i].mesh];
        for (std::uint32_t side = 0; side < 2; ++side) {
            std::vector<glm::vec2>& uv = pages.instances[i][side].uv;
            if (uv.empty())
                continue;
            shift.assign(charts.chartSize.size(), glm::vec2(0));
            for (; k < boxes.size() && boxes[k].instance == i && boxes[k].side == side; ++k)
                shift[boxes[k].chart] = glm::vec2(places[k].position) - glm::vec2(boxes[k].lower);
            const std::vector<glm::vec2> whole = uv;
            for (std::size_t j = 0; j < charts.indices.size(); ++j) {
                const std::uint32_t vertex = charts.indices[j];
                uv[vertex] =
                    (whole[vertex] * sizeOf(layout) + shift[charts.chartOfTriangle[j / 3]]) /
                    glm::vec2(used);
            }
        }
    }
    return pages;
}

std::uint32_t expectedPages(const Scene& scene, const LightmapLayout& layout, std::uint32_t factor,
                            std::uint32_t maxSide) {
    if (std::uint64_t(std::max(layout.width, layout.height)) * factor <= maxSide)
        return 1;
    std::uint64_t area = 0;
    for (const ChartBox& box : chartBoxes(scene, layout))
        area += areaOf(box);
    const double page = std::pow(double(maxSide / factor), 2) * kFill;
    return std::uint32_t(std::ceil(std::max(double(area) / page, 1.)));
}

LargestChart largestChart(const Scene& scene, const LightmapLayout& layout) {
    LargestChart largest;
    for (const ChartBox& box : chartBoxes(scene, layout))
        if (const std::uint32_t side = std::max(box.size.x, box.size.y); side > largest.side)
            largest = {side, box.instance};
    return largest;
}

std::vector<std::uint32_t> pageTexels(const PlainLightmap& plain, const LightmapPages& pages,
                                      std::uint32_t page) {
    const glm::uvec2 size(pages.width, pages.height);
    std::vector<std::uint32_t> texelAt(std::size_t(size.x) * size.y, kNoTexel);
    for (const LightmapPages::Copy& copy : pages.copies) {
        if (copy.page != page)
            continue;
        for (std::uint32_t y = 0; y < copy.size.y; ++y) {
            const auto from = plain.texelAt.begin() +
                              (std::ptrdiff_t(copy.from.y + y) * plain.width + copy.from.x);
            std::copy(from, from + copy.size.x,
                      texelAt.begin() + (std::ptrdiff_t(copy.to.y + y) * size.x + copy.to.x));
        }
    }
    repeatNearest(texelAt, size);
    return texelAt;
}

} // namespace limn
