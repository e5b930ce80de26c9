// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/area_lights.h"

#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

RsmLevelTexel sumOf(const RsmLevelTexel& a, const RsmLevelTexel& b) {
    return {a.flux + b.flux,         a.normal + b.normal,   a.area + b.area,
            a.distance + b.distance, a.squares + b.squares, a.count + b.count};
}

/// The level with half the side, or, where that is 1, the same.
RsmLevel halved(const RsmLevel& fine) {
    RsmLevel level{.side = fine.side / 2};
    level.texels.resize(std::size_t(level.side) * level.side);
    for (std::uint32_t y = 0; y < level.side; ++y)
        for (std::uint32_t x = 0; x < level.side; ++x) {
            const RsmLevelTexel* lower = &fine.texels[std::size_t(2 * y) * fine.side + 2 * x];
            const RsmLevelTexel* upper = lower + fine.side;
            level.texels[std::size_t(y) * level.side + x] =
                sumOf(sumOf(lower[0], lower[1]), sumOf(upper[0], upper[1]));
        }
    return level;
}

/// The point at `distance` that texel (x, y) of `side` along each side of the view looks at.
glm::vec3 placeOf(const RsmView& view, std::uint32_t side, glm::uvec2 texel, float distance) {
    const glm::vec2 ndc = (glm::vec2(texel) + 0.5f) * (2 / float(side)) - 1.f;
    const glm::vec3 across = ndc.x * view.right + ndc.y * view.up;
    if (view.parallel)
        return view.origin + across + distance * view.forward;
    return view.origin + distance * glm::normalize(view.forward + across);
}

/// Standard deviation of the distances, and their mean.
std::pair<float, float> deviationAndMean(const RsmLevelTexel& t) {
    const double mean = double(t.distance) / double(t.count);
    const double variance = double(t.squares) / double(t.count) - mean * mean;
    return {float(std::sqrt(std::max(variance, 0.))), float(mean)};
}

/// Adds the area lights of a view that lie in block `b`, and the block.
void addBlock(const RsmView& view, const RsmLevel& read, const RsmLevel& blocks, glm::uvec2 b,
              AreaLights& lights, std::vector<std::uint32_t>& number) {
    const RsmLevelTexel& whole = blocks.texels[std::size_t(b.y) * blocks.side + b.x];
    if (!(whole.count > 0))
        return;
    AreaLightBlock block{.begin = std::uint32_t(lights.count()), .parallel = view.parallel};
    const std::uint32_t side = read.side / blocks.side;
    glm::dvec3 sum(0);
    double weight = 0;
    for (std::uint32_t y = b.y * side; y < (b.y + 1) * side; ++y)
        for (std::uint32_t x = b.x * side; x < (b.x + 1) * side; ++x) {
            const RsmLevelTexel& t = read.texels[std::size_t(y) * read.side + x];
            const float length = glm::length(t.normal);
            if (!(t.count > 0) || !(length > 0))
                continue;
            const glm::vec3 p = placeOf(view, read.side, {x, y}, t.distance / t.count);
            const glm::vec3 n = t.normal / length;
            number[std::size_t(y) * read.side + x] = std::uint32_t(lights.count());
            lights.x.push_back(p.x), lights.y.push_back(p.y), lights.z.push_back(p.z);
            lights.nx.push_back(n.x), lights.ny.push_back(n.y), lights.nz.push_back(n.z);
            lights.disc.push_back(t.area * std::numbers::inv_pi_v<float>);
            lights.flux.push_back(t.flux);
            sum += glm::dvec3(p) * double(t.count);
            weight += double(t.count);
        }
    block.end = std::uint32_t(lights.count());
    if (block.begin == block.end)
        return;
    block.place = glm::vec3(sum / weight);
    if (const float length = glm::length(whole.normal); length > 0)
        block.normal = whole.normal / length;
    const auto [deviation, mean] = deviationAndMean(whole);
    const float width = std::sqrt(view.area()) / float(blocks.side);
    block.width = std::max(width, 2 * deviation / (view.parallel ? 1 : mean));
    lights.blocks.push_back(block);
}

/// Splits the flux of a view's area lights by instance. `number`: of the area light of each texel
/// of the level that was read.
void addShares(const RsmView& view, std::uint32_t side, std::span<const RsmTexel> texels,
               const std::vector<std::uint32_t>& number, AreaLights& lights) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, glm::vec3> shares;
    const std::uint32_t step = view.size / side;
    for (const RsmTexel& t : texels) {
        const glm::uvec2 place = t.place / step;
        const std::uint32_t light = number[std::size_t(place.y) * side + place.x];
        if (light != ~0U)
            shares[{light, t.instance}] += t.albedo * t.incident;
    }
    for (const auto& [key, flux] : shares)
        lights.shares.push_back({key.first, key.second, flux});
}

} // namespace

std::size_t AreaLights::bytes() const {
    return count() * (7 * sizeof(float) + sizeof(glm::vec3)) +
           blocks.size() * sizeof(AreaLightBlock) + shares.size() * sizeof(Share);
}

std::vector<RsmLevel> rsmLevels(const RsmView& view, std::span<const RsmTexel> texels) {
    RsmLevel full{.side = view.size};
    full.texels.resize(std::size_t(full.side) * full.side);
    for (const RsmTexel& t : texels) {
        const glm::vec3 way = t.position - view.origin;
        const float d = view.parallel ? glm::dot(way, view.forward) : glm::length(way);
        full.texels[std::size_t(t.place.y) * full.side + t.place.x] = {.flux =
                                                                           t.albedo * t.incident,
                                                                       .normal = t.normal,
                                                                       .area = t.area,
                                                                       .distance = d,
                                                                       .squares = d * d,
                                                                       .count = 1};
    }
    std::vector<RsmLevel> levels = {std::move(full)};
    while (levels.back().side > 1)
        levels.push_back(halved(levels.back()));
    return levels;
}

std::uint32_t sideRead(std::uint32_t read, std::size_t views, std::uint32_t side) {
    const double nearest = std::log2(double(read)) - std::log2(double(views)) / 2;
    return std::min(std::uint32_t(std::exp2(std::max(std::round(nearest), 0.))), side);
}

AreaLights areaLightsOf(const TraceScene& trace, const Scene& scene, const Light& light,
                        const AreaLightOptions& options, const Progress& progress) {
    AreaLights lights{.shape = unitLight(light)};
    const ReflectiveShadowMap map = castRsm(trace, scene, light, options.map, progress);
    lights.rays = map.rays;
    const std::vector<RsmView> views =
        rsmViews(lights.shape, scene.bounds, options.map,
                 [&](glm::vec3 p, glm::vec3 normal) { return trace.clearOf(p, normal); });
    auto next = map.texels.begin();
    for (std::uint32_t v = 0; v < views.size(); ++v) {
        const RsmView& view = views[v];
        const auto first = next;
        next =
            std::find_if(first, map.texels.end(), [&](const RsmTexel& t) { return t.view != v; });
        if (first == next)
            continue;
        const std::span<const RsmTexel> texels(first, next);
        const std::vector<RsmLevel> levels = rsmLevels(view, texels);
        const std::uint32_t side = sideRead(options.read, views.size(), view.size);
        const auto k = std::size_t(std::countr_zero(view.size) - std::countr_zero(side));
        const RsmLevel& read = levels[k];
        const RsmLevel& blocks = levels[std::min(k + options.level, levels.size() - 1)];
        std::vector<std::uint32_t> number(read.texels.size(), ~0U);
        for (std::uint32_t y = 0; y < blocks.side; ++y)
            for (std::uint32_t x = 0; x < blocks.side; ++x)
                addBlock(view, read, blocks, {x, y}, lights, number);
        addShares(view, side, texels, number, lights);
    }
    return lights;
}

} // namespace limn
