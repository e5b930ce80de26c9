// SPDX-License-Identifier: MIT
#include "engine/lightmap/layout/layout_rules.h"

#include "engine/core/hash.h"

#include <algorithm>

namespace limn {

bool isPointOf(const Mesh& mesh, const MeshPoint& point) {
    constexpr float kRounding = 1e-4f;
    const glm::vec2 uv = point.barycentric;
    return point.triangle < mesh.triangleCount() && uv.x >= -kRounding && uv.y >= -kRounding &&
           uv.x + uv.y <= 1 + kRounding;
}

bool isAtlasSize(std::uint64_t width, std::uint64_t height, std::uint64_t used) {
    constexpr std::uint64_t kMaxSide = 1 << 20, kEmpty = 4096;
    return width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide &&
           width * height < kFineLookup && width * height <= (used + 16) * kEmpty;
}

const char* snapDefect(const std::vector<std::uint32_t>& snaps, std::uint32_t width,
                       std::uint32_t height) {
    const std::uint64_t texels = std::uint64_t(width) * height;
    const auto outside = [&](std::uint32_t lookup) {
        if (lookup == 0)
            return false;
        if (!(lookup & kFineLookup))
            return lookup < texels || std::uint64_t(lookup) + kSnapCells > snaps.size();
        const std::uint32_t first = lookup & ~kFineLookup;
        return std::uint64_t(first % width) + kFineCells >= width ||
               std::uint64_t(first / width) + kFineCells >= height;
    };
    if (snaps.empty())
        return nullptr;
    if (snaps.size() < texels)
        return "do not cover the texels";
    for (std::uint64_t t = 0; t < texels; ++t)
        if (outside(snaps[t]))
            return "out of range";
    for (std::size_t row = texels; row < snaps.size(); ++row)
        for (std::uint32_t cell = 0; cell < kSnapCells; ++cell)
            if ((snaps[row] >> 4 * cell & 15) >= kSnaps)
                return "unknown snap";
    return nullptr;
}

bool chartsHoldVertices(const MeshCharts& c) {
    constexpr float kRounding = 1 + 1e-4f;
    for (std::size_t i = 0; i < c.indices.size(); ++i) {
        const glm::vec2 size = c.chartSize[c.chartOfTriangle[i / 3]] * kRounding,
                        uv = c.chartUv[c.indices[i]];
        if (!(uv.x <= size.x && uv.y <= size.y))
            return false;
    }
    return true;
}

std::uint64_t hashLayout(const LightmapLayout& layout, std::uint64_t h) {
    h = hashValue(layout.width, hashValue(layout.height, h));
    for (const MeshCharts& m : layout.meshes) {
        h = hashVector(m.sourceVertex, hashVector(m.indices, h));
        h = hashVector(m.chartOfTriangle, hashVector(m.chartUv, hashVector(m.chartSize, h)));
    }
    for (const InstanceLightmap& i : layout.instances)
        h = hashValue(i.backRows, hashVector(i.uv, h));
    return hashVector(layout.snaps, h);
}

} // namespace limn
