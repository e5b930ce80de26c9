// SPDX-License-Identifier: MIT
#include "engine/export/grid_texture.h"

#include "engine/core/percent_encoding.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/vector_json.h"
#include "engine/files/ktx2.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limn {

namespace {

constexpr std::uint32_t kGroups = 7;

} // namespace

Result<void> checkGrid(const IndirectField& field) {
    if (field.grid.empty() || field.cells() == 0)
        return fail("the light has no grid: bake one, with --grid 8x8x8 or the bake settings");
    return {};
}

Sh3 gridCell(const IndirectField& field, std::size_t cell) {
    const std::size_t cells = field.cells(), count = std::min(field.coefficients(), 9U);
    Sh3 c{};
    for (std::size_t i = 0; i < count; ++i)
        c[i] = glm::vec3(field.grid[i * cells + cell]);
    return c;
}

Sh3 meanProbe(const IndirectField& field) {
    const std::size_t cells = field.cells();
    std::array<glm::dvec3, 9> sum{};
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const Sh3 c = gridCell(field, cell);
        for (std::size_t i = 0; i < 9; ++i)
            sum[i] += glm::dvec3(c[i]);
    }
    Sh3 mean;
    for (std::size_t i = 0; i < 9; ++i)
        mean[i] = glm::vec3(sum[i] / double(cells));
    return mean;
}

Result<std::string> gridKtx2(const IndirectField& field, bool zstd) {
    const glm::uvec3 n = field.gridSize;
    const std::size_t cells = field.cells(), plane = std::size_t(n.x) * n.y;
    if (const Result<void> exists = checkGrid(field); !exists)
        return tl::make_unexpected(exists.error());
    Ktx2Shape shape{.width = n.x, .height = n.y, .depth = kGroups * (n.z + 2), .zstd = zstd};
    std::vector<glm::vec4> texels(shape.texels());
    float maximum = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const auto groups = threeGridCell(gridCell(field, cell));
        for (std::size_t t = 0; t < kGroups; ++t) {
            const std::size_t slice = t * (n.z + 2) + 1 + cell / plane;
            texels[slice * plane + cell % plane] = groups[t];
            for (int k = 0; k < 4; ++k)
                maximum = std::max(maximum, std::abs(groups[t][k]));
        }
    }
    const auto slice = [&](std::size_t z) { return texels.begin() + std::ptrdiff_t(z * plane); };
    for (std::size_t t = 0; t < kGroups; ++t) {
        const std::size_t first = t * (n.z + 2);
        std::copy(slice(first + 1), slice(first + 2), slice(first));
        std::copy(slice(first + n.z), slice(first + n.z + 1), slice(first + n.z + 1));
    }
    if (maximum > 65504 || (maximum > 0 && maximum < 0x1p-9f))
        shape.format = Ktx2Format::Rgba32f;
    return encodeKtx2(shape, texels);
}

std::uint64_t gridKtx2Bytes(const IndirectField& field) {
    const glm::uvec3 n = field.gridSize;
    return std::uint64_t(n.x) * n.y * kGroups * (n.z + 2) * 8 + 256;
}

Json shJson(const Sh3& c) {
    Json list = Json::array();
    for (const glm::vec3& v : c)
        list.push_back(vectorJson(v));
    return list;
}

Json gridJson(const ExportScene& scene, const std::string& texture) {
    const IndirectField& field = scene.field;
    return {{"format", "limn-grid"},
            {"version", 1},
            {"texture", percentEncoded(texture)},
            {"bounds",
             {{"lower", vectorJson(field.gridBounds.lower)},
              {"upper", vectorJson(field.gridBounds.upper)}}},
            {"origin", vectorJson(scene.document.origin)},
            {"size", vectorJson(field.gridSize)},
            {"bands", 3},
            {"unit", "W m^-2 sr^-1"},
            {"colors", "linear Rec. 709"},
            {"axes", "metres, right-handed, +Y up; bounds are relative to origin"},
            {"cells", "centre = lower + (index + 0.5) / size * (upper - lower)"},
            {"layout",
             "number k of a cell, k = 3 i + channel, is component k % 4 of texel (x, y, (k / 4) "
             "(size.z + 2) + 1 + z); i = l (l + 1) + m"},
            {"harmonics", "radiance, real, orthonormal, without Condon-Shortley sign"},
            {"irradiance", "E(n) = max(0, sum over i of A_l c_i Y_i(n)), A = pi, 2 pi / 3, pi / 4"},
            {"outgoingRadiance", "L = albedo / pi * E"},
            {"mean", shJson(meanProbe(field))}};
}

} // namespace limn
