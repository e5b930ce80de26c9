// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/lamp_patches.h"

#include "engine/math/sampling.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/senders/owned_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Bounds of LampPatches::each, and the number of points of all patches between these.
constexpr std::uint32_t kMinPoints = 16, kMaxPoints = 256, kPointsOfAll = 65536;

/// Mean squared distance of a triangle's area from its centroid [m^2, world].
double secondMoment(const Scene& scene, const Instance& instance, std::uint32_t triangle) {
    const Mesh& mesh = scene.meshOf(instance);
    const std::array<std::uint32_t, 3> corner = mesh.triangle(triangle);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 edge = mesh.positions[corner[(k + 1) % 3]] - mesh.positions[corner[k]];
        const glm::vec3 placed = glm::mat3(instance.toWorld) * edge;
        sum += double(glm::dot(placed, placed));
    }
    return sum / 36;
}

/// Point k of a patch, somewhere in a cell: a Halton point, shifted by a hash of `seed`. Of a cell
/// that the triangle cuts, other shifts are tried until the point lies in the triangle.
WorldPoint pointIn(const Scene& scene, const Instance& instance, const OwnedCell& cell,
                   std::uint32_t seed, std::uint32_t k) {
    constexpr int kTries = 16;
    // Steps between shifts that spread evenly. Roberts. The Unreasonable Effectiveness of
    // Quasirandom Sequences. 2018
    constexpr glm::vec2 kStep(0.754877666f, 0.569840291f);
    const glm::vec2 shift(unitFloat(mixBits(2 * seed)), unitFloat(mixBits(2 * seed + 1))),
        halton(radicalInverse(k, 2), radicalInverse(k, 3));
    glm::vec2 place = cell.middle;
    for (int i = 0; i < kTries; ++i) {
        const glm::vec2 in = glm::fract(shift + halton + float(i) * kStep),
                        uv = cell.origin + in.x * cell.across + in.y * cell.up;
        if (isInTriangle(uv)) {
            place = uv;
            break;
        }
    }
    return worldPoint(scene, instance, {cell.triangle, place}, cell.back);
}

/// What the cells of a patch sum up to.
struct PatchSums {
    double area = 0;
    double squared = 0; ///< area times squared distance from the surfel
    double passed = 0;  ///< area of the cells from which points were taken so far
    std::uint32_t taken = 0;
};

void addCells(const Scene& scene, const SurfelSet& set, const OwnerTables& owners,
              std::uint32_t instance, std::vector<PatchSums>& sums) {
    const Instance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshOf(placed);
    forOwnedCells(scene, owners, instance, [&](const OwnedCell& cell) {
        const glm::vec3 away =
            glm::vec3(placed.toWorld *
                      glm::vec4(trianglePoint(mesh, cell.triangle, cell.middle), 1)) -
            set.surfels.position[cell.surfel];
        const double whole = double(triangleWorldArea(scene, placed, cell.triangle)),
                     share = whole > 0 ? cell.area / whole : 0;
        PatchSums& sum = sums[cell.surfel - set.instanceBegin[instance]];
        sum.area += cell.area;
        sum.squared += cell.area * (double(glm::dot(away, away)) +
                                    share * secondMoment(scene, placed, cell.triangle));
    });
}

/// Takes point k of a patch where the cells' area, summed in their order, reaches (k + shift) /
/// each of the whole.
void takePoints(const Scene& scene, const SurfelSet& set, const OwnerTables& owners,
                std::uint32_t instance, std::vector<PatchSums>& sums, LampPatches& lamps) {
    const std::uint32_t first = set.instanceBegin[instance];
    forOwnedCells(scene, owners, instance, [&](const OwnedCell& cell) {
        const std::uint32_t seed = cell.surfel - first;
        const auto shift = double(unitFloat(mixBits(~seed)));
        PatchSums& sum = sums[seed];
        sum.passed += cell.area;
        while (sum.taken < lamps.each && (sum.taken + shift) * sum.area < sum.passed * lamps.each) {
            lamps.points[lamps.begin[cell.surfel] + sum.taken] =
                pointIn(scene, scene.instances[instance], cell, seed, sum.taken);
            ++sum.taken;
        }
    });
}

} // namespace

LampPatches findLampPatches(const Scene& scene, const SurfelSet& set, const OwnerTables& owners) {
    LampPatches lamps;
    lamps.extent.resize(set.surfels.size());
    lamps.begin.assign(set.surfels.size(), ~0U);
    std::vector<std::vector<PatchSums>> sums(scene.instances.size());
    const auto emitting = [&](std::uint32_t i) {
        return emits(scene.materialOf(scene.instances[i]));
    };
    forSenders(scene, set, [&](std::uint32_t i) {
        if (!emitting(i))
            return;
        sums[i].resize(set.instanceBegin[i + 1] - set.instanceBegin[i]);
        addCells(scene, set, owners, i, sums[i]);
    });
    std::uint32_t patches = 0;
    for (std::size_t i = 0; i < sums.size(); ++i)
        for (std::size_t s = 0; s < sums[i].size(); ++s)
            if (const PatchSums& sum = sums[i][s]; sum.area > 0) {
                const std::size_t surfel = set.instanceBegin[i] + s;
                lamps.extent[surfel] = float(std::sqrt(sum.squared / sum.area));
                lamps.begin[surfel] = patches++;
            }
    lamps.each = std::clamp(kPointsOfAll / std::max(patches, 1U), kMinPoints, kMaxPoints);
    for (std::uint32_t& begin : lamps.begin)
        begin = begin == ~0U ? begin : begin * lamps.each;
    lamps.points.resize(std::size_t(patches) * lamps.each);
    forSenders(scene, set, [&](std::uint32_t i) {
        if (!sums[i].empty())
            takePoints(scene, set, owners, i, sums[i], lamps);
    });
    lamps.normals.resize(patches);
    for (std::uint32_t k = 0; k < patches; ++k) {
        const auto points =
            std::span(lamps.points).subspan(std::size_t(k) * lamps.each, lamps.each);
        glm::vec3 sum(0);
        for (const WorldPoint& p : points)
            sum += p.normal;
        const float length = glm::length(sum);
        lamps.normals[k] = length > 0 ? sum / length : points[0].normal;
    }
    return lamps;
}

} // namespace limn
