// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/surfel_spacing.h"

#include "engine/core/parallel.h"
#include "engine/math/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

/// Fills the ratios of the surfels of one instance; they stay < 0 where there is no neighbour.
static void fillRatios(const Surfels& s, std::span<const std::uint32_t> surfels,
                       std::vector<float>& ratio) {
    std::vector<glm::vec3> points, normals;
    double area = 0;
    for (const std::uint32_t surfel : surfels) {
        points.push_back(s.position[surfel]);
        normals.push_back(s.normal[surfel]);
        area += s.area[surfel];
    }
    const NearestPoint nearest(points, normals, float(std::sqrt(area / double(surfels.size()))));
    parallelRanges(surfels.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t other = nearest.findOther(std::uint32_t(i));
            if (other != ~0U && s.area[surfels[i]] > kLeastSurfelArea &&
                glm::dot(normals[other], normals[i]) > 0)
                ratio[surfels[i]] =
                    glm::length(points[other] - points[i]) / hexagonalSpacing(s.area[surfels[i]]);
        }
    });
}

SurfelSpacing surfelSpacing(const Surfels& surfels) {
    std::vector<float> ratio(surfels.size(), -1.f);
    std::vector<std::uint32_t> order(surfels.size()); // by instance
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t s) { return surfels.instance[s]; });
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && surfels.instance[order[end]] == surfels.instance[order[begin]])
            ++end;
        fillRatios(surfels, std::span(order).subspan(begin, end - begin), ratio);
    }
    SurfelSpacing result;
    double sum = 0, squares = 0;
    for (const float r : ratio)
        if (r >= 0) {
            ++result.count;
            sum += double(r);
            squares += double(r) * double(r);
        }
    if (result.count == 0)
        return result;
    const double n = double(result.count);
    result.mean = sum / n;
    result.spread =
        result.mean > 0
            ? std::sqrt(std::max(squares / n - result.mean * result.mean, 0.0)) / result.mean
            : 0;
    return result;
}

} // namespace limn
