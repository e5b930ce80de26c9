// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/cache_grids.h"

#include <algorithm>
#include <cmath>

namespace limn {

namespace {

/// A decision box ends so many cells before its grid's edge, which snapping may move by half a one.
constexpr float kDecisionMargin = 1.5f;
/// Corners with less weight than this in all count as missing.
constexpr float kMinWeight = 1e-6f;

float longestSide(const Bounds& bounds) {
    const glm::vec3 size = bounds.size();
    return std::max({size.x, size.y, size.z});
}

bool contains(const Bounds& box, glm::vec3 p) {
    return glm::clamp(p, box.lower, box.upper) == p;
}

/// Adds the caches about a point in one grid, their weights summing to `share`. Returns false if
/// there are none.
bool addCorners(const CacheGrid& grid, std::span<const std::uint32_t> address, glm::vec3 p,
                float share, CacheLookup& found) {
    const glm::uvec3 cell = grid.cellAt(p);
    const glm::vec3 f = glm::clamp((p - grid.place(cell)) / grid.cell, glm::vec3(0), glm::vec3(1));
    const std::size_t first = found.count;
    float sum = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const glm::uvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const std::uint32_t cache = address[grid.index(cell + step)];
        const glm::vec3 w = glm::mix(1.f - f, f, glm::vec3(step));
        const float weight = w.x * w.y * w.z;
        if (cache == kNoCache || !(weight > 0))
            continue;
        found.cache[found.count] = cache;
        found.weight[found.count++] = weight;
        sum += weight;
    }
    if (sum < kMinWeight) {
        found.count = first;
        return false;
    }
    for (std::size_t k = first; k < found.count; ++k)
        found.weight[k] *= share / sum;
    return true;
}

} // namespace

std::size_t CacheGrids::nodes() const {
    return firstNode(grids.size());
}

std::size_t CacheGrids::firstNode(std::size_t grid) const {
    std::size_t sum = 0;
    for (std::size_t g = 0; g < grid; ++g)
        sum += grids[g].count();
    return sum;
}

CacheGrids cascadesAbout(glm::vec3 eye, const Bounds& bounds, std::uint32_t cascades,
                         std::uint32_t nodes, float transition) {
    CacheGrids all{.transition = transition};
    const float scene = longestSide(bounds);
    if (!(scene > 0))
        return all;
    const glm::vec3 centre = glm::clamp(eye, bounds.lower, bounds.upper);
    for (std::uint32_t c = cascades; c-- > 0;) { // the finest first
        const float edge = 2 * scene / float(1U << c);
        CacheGrid grid{.cell = edge / float(nodes - 2), .nodes = glm::uvec3(nodes)};
        const glm::vec3 snapped =
            glm::round((centre - bounds.lower) / grid.cell - float(nodes - 1) / 2);
        grid.lower = bounds.lower + snapped * grid.cell;
        const float half = edge / 2 - kDecisionMargin * grid.cell;
        grid.decision = {centre - half, centre + half};
        all.grids.push_back(grid);
    }
    return all;
}

CacheGrids gridOver(const Bounds& bounds, std::uint32_t cells) {
    const float scene = longestSide(bounds);
    if (!(scene > 0))
        return {};
    CacheGrid grid{.lower = bounds.lower, .cell = scene / float(cells), .decision = bounds};
    for (int axis = 0; axis < 3; ++axis) {
        // Rounding must not add a cell to a side of a whole number of cells.
        const float whole = std::ceil(bounds.size()[axis] / grid.cell - 1e-3f);
        grid.nodes[axis] = std::uint32_t(std::clamp(whole, 1.f, float(cells))) + 1;
    }
    return {.grids = {grid}};
}

GridShares gridShares(const CacheGrids& grids, glm::vec3 p) {
    GridShares shares;
    const std::size_t count = grids.grids.size();
    if (count == 0)
        return shares;
    std::size_t g = 0;
    while (g + 1 < count && !contains(grids.grids[g].decision, p))
        ++g;
    float weight = 1;
    if (g + 1 < count && grids.transition > 0) {
        const Bounds& box = grids.grids[g].decision;
        const glm::vec3 inside = glm::min(p - box.lower, box.upper - p);
        const float nearest = std::min({inside.x, inside.y, inside.z});
        weight = std::clamp(nearest / (grids.transition * grids.grids[g].cell), 0.f, 1.f);
    }
    if (weight > 0)
        shares.share[shares.count++] = {std::uint32_t(g), weight};
    if (weight < 1)
        shares.share[shares.count++] = {std::uint32_t(g + 1), 1 - weight};
    return shares;
}

CacheLookup lookUpCaches(const CacheGrids& grids, std::span<const std::uint32_t> address,
                         glm::vec3 p) {
    CacheLookup found;
    const GridShares shares = gridShares(grids, p);
    float sum = 0;
    std::size_t from = 0; // a grid that takes another's place is not asked twice
    for (std::size_t k = 0; k < shares.count; ++k)
        for (std::size_t g = std::max(std::size_t(shares.share[k].grid), from);
             g < grids.grids.size(); ++g) {
            const CacheGrid& grid = grids.grids[g];
            from = g + 1;
            if (addCorners(grid, address.subspan(grids.firstNode(g), grid.count()), p,
                           shares.share[k].weight, found)) {
                sum += shares.share[k].weight;
                break;
            }
        }
    for (std::size_t k = 0; k < found.count; ++k)
        found.weight[k] /= sum;
    return found;
}

CacheLookup lookUpCaches(const CacheGrids& grids, std::span<const std::uint32_t> address,
                         glm::vec3 p, glm::vec3 normal) {
    if (grids.grids.empty())
        return {};
    return lookUpCaches(grids, address, aboveSurface(grids, p, normal));
}

} // namespace limn
