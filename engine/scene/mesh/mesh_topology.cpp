// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/mesh_topology.h"

#include "engine/math/sampling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>
#include <utility>

namespace limn {

namespace {

using WeldKey = std::array<std::uint32_t, 5>;

struct WeldHash {
    std::size_t operator()(const WeldKey& key) const {
        std::size_t h = 0;
        for (const std::uint32_t v : key)
            h = (h ^ mixBits(v)) * std::size_t(0x9e3779b97f4a7c15ULL);
        return h;
    }
};

std::uint32_t floatKey(float f) {
    return std::bit_cast<std::uint32_t>(f + 0.f);
} // -0 joins 0

} // namespace

std::vector<std::uint32_t> weldVertices(const Mesh& mesh, bool byUv1, const Progress& progress) {
    std::unordered_map<WeldKey, std::uint32_t, WeldHash> numbers;
    numbers.reserve(mesh.positions.size());
    std::vector<std::uint32_t> result(mesh.positions.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (i % 4096 == 0 && progress.cancelled())
            break;
        const glm::vec3 p = mesh.positions[i];
        const glm::vec2 uv = byUv1 ? mesh.uv1[i] : glm::vec2(0);
        const WeldKey key = {floatKey(p.x), floatKey(p.y), floatKey(p.z), floatKey(uv.x),
                             floatKey(uv.y)};
        result[i] = numbers.try_emplace(key, std::uint32_t(numbers.size())).first->second;
    }
    return result;
}

std::vector<std::uint32_t> edgePartners(const Mesh& mesh, const Progress& progress) {
    const std::vector<std::uint32_t> point = weldVertices(mesh, false, progress);
    const auto from = [&](std::uint32_t edge) { return point[mesh.indices[edge]]; };
    const auto to = [&](std::uint32_t edge) {
        return point[mesh.indices[edge % 3 == 2 ? edge - 2 : edge + 1]];
    };
    const auto count = std::uint32_t(3 * mesh.triangleCount());
    std::vector<std::pair<std::uint64_t, std::uint32_t>> byEnds(count);
    for (std::uint32_t e = 0; e < count; ++e) {
        const std::uint64_t a = from(e), b = to(e);
        byEnds[e] = {std::min(a, b) << 32 | std::max(a, b), e};
    }
    std::vector<std::uint32_t> partner(count, kNoEdge);
    if (progress.cancelled())
        return partner;
    std::sort(byEnds.begin(), byEnds.end());
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && byEnds[end].first == byEnds[begin].first)
            ++end;
        const std::uint32_t e = byEnds[begin].second, f = byEnds[end - 1].second;
        if (end - begin == 2 && from(e) == to(f) && from(e) != to(e)) {
            partner[e] = f;
            partner[f] = e;
        }
    }
    return partner;
}

MeshPoint pointOfEdge(std::uint32_t e, float s) {
    glm::vec3 weights(0);
    weights[int(e % 3)] = 1 - s;
    weights[int((e + 1) % 3)] = s;
    return {e / 3, {weights.y, weights.z}};
}

} // namespace limn
