// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/surfel_spacing.h"

#include "engine/core/parallel.h"
#include "engine/math/nearest_point.h"

#include <cmath>
#include <span>

#include <glm/geometric.hpp>

namespace limn {

/// Fills ratio[begin, end) for the surfels of one instance; < 0 where there is no neighbour.
static void fillRatios(const Surfels& s, std::size_t begin, std::size_t end,
                       std::vector<float>& ratio) {
    const std::span<const glm::vec3> points(s.position.data() + begin, end - begin),
        normals(s.normal.data() + begin, end - begin);
    double area = 0;
    for (std::size_t i = begin; i < end; ++i)
        area += s.area[i];
    const NearestPoint nearest(points, normals, float(std::sqrt(area / double(end - begin))));
    parallelRanges(end - begin, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t other = nearest.findOther(std::uint32_t(i));
            if (other != ~0U && glm::dot(normals[other], normals[i]) > 0)
                ratio[begin + i] =
                    glm::length(points[other] - points[i]) / hexagonalSpacing(s.area[begin + i]);
        }
    });
}

SurfelSpacing surfelSpacing(const Surfels& surfels) {
    std::vector<float> ratio(surfels.size(), -1.f);
    for (std::size_t begin = 0, end = 0; begin < surfels.size(); begin = end) {
        while (end < surfels.size() && surfels.instance[end] == surfels.instance[begin])
            ++end;
        fillRatios(surfels, begin, end, ratio);
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
