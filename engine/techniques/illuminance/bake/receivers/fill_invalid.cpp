// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/receivers/fill_invalid.h"

#include "engine/core/parallel.h"
#include "engine/math/nearest_point.h"

#include <algorithm>
#include <array>

namespace limn {

namespace {

struct Sources {
    std::array<NearestPoint::Near, 4> nearest; ///< .point: a cache
    std::size_t count = 0;
};

bool isValid(const Caches& caches, std::size_t c) {
    return caches.linkBegin[c] < caches.linkBegin[c + 1];
}

/// Finds sources for the invalid caches of [begin, end) among the valid ones.
void findSources(const Caches& caches, std::size_t begin, std::size_t end, float spacing,
                 std::vector<Sources>& sources) {
    std::vector<std::uint32_t> valid;
    std::vector<glm::vec3> points, normals;
    for (std::size_t c = begin; c < end; ++c)
        if (isValid(caches, c)) {
            valid.push_back(std::uint32_t(c));
            points.push_back(caches.position[c]);
            normals.push_back(caches.normal[c]);
        }
    const NearestPoint nearest(points, normals, spacing);
    parallelRanges(end - begin, 64, [&](std::size_t from, std::size_t to) {
        for (std::size_t c = begin + from; c < begin + to; ++c) {
            if (isValid(caches, c))
                continue;
            Sources& s = sources[c];
            s.count = nearest.findSome(caches.position[c], caches.normal[c], s.nearest);
            for (std::size_t i = 0; i < s.count; ++i)
                s.nearest[i].point = valid[s.nearest[i].point];
        }
    });
}

void append(const Sources& s, Caches& caches) {
    double sum = 0;
    std::array<double, 4> weight;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double minCost = std::max(double(s.nearest[0].cost), 1e-30);
        sum += weight[i] = minCost / std::max(double(s.nearest[i].cost), minCost);
    }
    for (std::size_t i = 0; i < s.count; ++i) {
        caches.fillSource.push_back(s.nearest[i].point);
        caches.fillWeight.push_back(float(weight[i] / sum));
    }
}

} // namespace

std::uint32_t fillInvalid(Caches& caches, float spacing) {
    std::vector<Sources> sources(caches.size());
    findSources(caches, 0, caches.lightmapCount, spacing, sources);
    findSources(caches, caches.lightmapCount, caches.size(), 0, sources);
    std::uint32_t invalid = 0;
    caches.fillBegin = {0};
    caches.fillSource.clear();
    caches.fillWeight.clear();
    for (std::size_t c = 0; c < caches.size(); ++c) {
        invalid += isValid(caches, c) ? 0 : 1;
        append(sources[c], caches);
        caches.fillBegin.push_back(std::uint32_t(caches.fillSource.size()));
    }
    return invalid;
}

} // namespace limn
