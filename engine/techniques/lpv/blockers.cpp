// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/blockers.h"

#include "engine/lattice/cell_lobes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// A part of a triangle: corners in the world and their barycentrics.
struct Part {
    std::array<glm::vec3, 3> corner;
    std::array<glm::vec2, 3> uv;
};

/// Splits the triangle along its longest edge until that is short enough, and calls
/// add(middle, barycentrics, area) for each part.
template <class Add>
void split(const Part& part, float longest, int depth, const Add& add) {
    int edge = 0;
    float maxLength = 0;
    for (int i = 0; i < 3; ++i) {
        const float length =
            glm::distance(part.corner[std::size_t(i)], part.corner[std::size_t((i + 1) % 3)]);
        if (length > maxLength) {
            maxLength = length;
            edge = i;
        }
    }
    const auto a = std::size_t(edge), b = std::size_t((edge + 1) % 3);
    if (maxLength <= longest || depth == 0) {
        const auto& [p, q, r] = part.corner;
        add((p + q + r) / 3.f, (part.uv[0] + part.uv[1] + part.uv[2]) / 3.f,
            glm::length(glm::cross(q - p, r - p)) / 2);
        return;
    }
    const glm::vec3 middle = (part.corner[a] + part.corner[b]) * 0.5f;
    const glm::vec2 uv = (part.uv[a] + part.uv[b]) * 0.5f;
    for (const std::size_t replaced : {a, b}) {
        Part half = part;
        half.corner[replaced] = middle;
        half.uv[replaced] = uv;
        split(half, longest, depth - 1, add);
    }
}

} // namespace

void addPieces(const Scene& scene, std::uint32_t index, float longest,
               std::vector<SurfacePiece>& pieces) {
    constexpr int kMaxDepth = 18;
    const Instance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshOf(instance);
    const Material& material = scene.materialOf(instance);
    const bool twoSided = isTwoSided(material), holes = isCutout(material);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        const std::array<std::uint32_t, 3> k = mesh.triangle(t);
        const glm::vec3 p = mesh.positions[k[0]], q = mesh.positions[k[1]],
                        r = mesh.positions[k[2]];
        const glm::vec3 across = instance.normalToWorld * glm::cross(q - p, r - p);
        const float length = glm::length(across);
        if (!(length > 0) || !std::isfinite(length))
            continue;
        const auto placed = [&](glm::vec3 x) {
            return glm::vec3(instance.toWorld * glm::vec4(x, 1));
        };
        split({{placed(p), placed(q), placed(r)}, {glm::vec2(0), glm::vec2(1, 0), glm::vec2(0, 1)}},
              longest, kMaxDepth, [&](glm::vec3 middle, glm::vec2 uv, float area) {
                  if (!holes || surfaceAlpha(scene, instance, t, uv.x, uv.y) > 0)
                      pieces.push_back({index, t, uv, middle, across / length, area, twoSided});
              });
    }
}

std::vector<SurfacePiece> surfacePieces(const Scene& scene, float longest) {
    std::vector<SurfacePiece> pieces;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        addPieces(scene, i, longest, pieces);
    return pieces;
}

FaceBlockers blockersOf(std::span<const SurfacePiece> pieces, const Lattice& lattice) {
    const Lattice corners = cornersOf(lattice);
    std::vector<LobeSample> samples;
    samples.reserve(pieces.size());
    for (const SurfacePiece& piece : pieces) {
        const std::uint32_t corner = corners.index(corners.at(piece.position));
        const glm::vec3 share(piece.area / (lattice.cell * lattice.cell));
        samples.push_back({corner, piece.normal, share});
        if (piece.twoSided)
            samples.push_back({corner, -piece.normal, share});
    }
    FaceBlockers blockers(lattice.size);
    for (const CellLobe& sum : sumByCell(samples, corners.cells())) {
        const glm::ivec3 corner(corners.place(sum.cell)); // the lower one of the cell of this place
        for (int axis = 0; axis < 3; ++axis)
            for (int k = 0; k < 4; ++k) {
                glm::ivec3 cell = corner; // one of the four whose lower face has this corner
                cell[(axis + 1) % 3] -= k & 1;
                cell[(axis + 2) % 3] -= k >> 1;
                for (std::size_t i = 0; i < sum.lobe.size(); ++i)
                    blockers.axis[std::size_t(axis)][i][blockers.cells.at(cell)] +=
                        sum.lobe[i].x / 4;
            }
    }
    return blockers;
}

} // namespace limn
