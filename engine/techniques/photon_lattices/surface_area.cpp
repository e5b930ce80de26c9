// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/surface_area.h"

#include "engine/core/parallel.h"
#include "engine/lattice/cell_lobes.h"
#include "engine/techniques/photon_lattices/clip_to_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// A triangle of an instance in the world.
struct WorldTriangle {
    std::array<glm::vec3, 3> corner;
    glm::vec3 normal{0}; ///< unit, of the front; 0 where the triangle has no area
};

WorldTriangle worldTriangle(const Scene& scene, const Instance& instance, std::uint32_t t) {
    const Mesh& mesh = scene.meshOf(instance);
    const std::array<std::uint32_t, 3> k = mesh.triangle(t);
    WorldTriangle world;
    for (std::size_t i = 0; i < 3; ++i)
        world.corner[i] = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[k[i]], 1));
    const glm::vec3 across =
        instance.normalToWorld * glm::cross(mesh.positions[k[1]] - mesh.positions[k[0]],
                                            mesh.positions[k[2]] - mesh.positions[k[0]]);
    if (const float length = glm::length(across); length > 0 && std::isfinite(length))
        world.normal = across / length;
    return world;
}

/// Barycentrics (u, v) of a point of the triangle.
glm::vec2 barycentrics(const WorldTriangle& triangle, glm::vec3 p) {
    const glm::vec3 a = triangle.corner[1] - triangle.corner[0],
                    b = triangle.corner[2] - triangle.corner[0], c = p - triangle.corner[0];
    const float aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), ca = glm::dot(c, a),
                cb = glm::dot(c, b), scale = aa * bb - ab * ab;
    if (!(scale > 0))
        return glm::vec2(1 / 3.f);
    return {(bb * ca - ab * cb) / scale, (aa * cb - ab * ca) / scale};
}

/// Adds the pieces of a triangle's sides.
void addSides(const Scene& scene, const Instance& instance, std::uint32_t t, const Lattice& lattice,
              std::vector<LobeSample>& samples) {
    const WorldTriangle world = worldTriangle(scene, instance, t);
    const Material& material = scene.materialOf(instance);
    if (world.normal == glm::vec3(0))
        return;
    for (const float side : {1.f, -1.f}) {
        if (side < 0 && !isTwoSided(material))
            continue;
        const glm::vec3 n = side * world.normal, lift = n * (kLatticeLift * lattice.cell);
        const auto& [a, b, c] = world.corner;
        clipToCells(lattice, {a + lift, b + lift, c + lift},
                    [&](std::uint32_t cell, glm::vec3 middle, float area) {
                        if (isCutout(material)) {
                            const glm::vec2 uv = barycentrics(world, middle - lift);
                            if (!(surfaceAlpha(scene, instance, t, uv.x, uv.y) > 0))
                                return;
                        }
                        samples.push_back({cell, n, glm::vec3(area, 0, 0)});
                    });
    }
}

/// The sum of two lists in the order of their cells.
std::vector<CellArea> sumOf(const std::vector<CellArea>& a, const std::vector<CellArea>& b) {
    std::vector<CellArea> sum;
    sum.reserve(a.size() + b.size());
    std::size_t j = 0;
    for (const CellArea& cell : a) {
        for (; j < b.size() && b[j].cell < cell.cell; ++j)
            sum.push_back(b[j]);
        sum.push_back(cell);
        if (j < b.size() && b[j].cell == cell.cell) {
            for (std::size_t i = 0; i < 4; ++i)
                sum.back().harmonics[i] += b[j].harmonics[i];
            ++j;
        }
    }
    sum.insert(sum.end(), b.begin() + std::ptrdiff_t(j), b.end());
    return sum;
}

} // namespace

bool storesPhotons(const Material& material) {
    const bool isMetal = material.metallic >= 1 && material.metallicRoughnessTexture.image < 0;
    return !isMetal && material.transmission < 1 && glm::vec3(material.baseColor) != glm::vec3(0);
}

std::vector<CellArea> surfaceAreas(const Scene& scene, std::span<const std::uint32_t> instances,
                                   const Lattice& lattice) {
    constexpr std::uint32_t kBatch = 256; // triangles
    struct Batch {
        std::uint32_t instance, first, end;
        std::vector<LobeSample> samples;
    };
    std::vector<Batch> batches;
    for (const std::uint32_t i : instances) {
        const Instance& instance = scene.instances[i];
        if (!storesPhotons(scene.materialOf(instance)))
            continue;
        const auto count = std::uint32_t(scene.meshOf(instance).triangleCount());
        for (std::uint32_t first = 0; first < count; first += kBatch)
            batches.push_back({i, first, std::min(first + kBatch, count), {}});
    }
    parallelRanges(batches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
            for (std::uint32_t t = batches[b].first; t < batches[b].end; ++t)
                addSides(scene, scene.instances[batches[b].instance], t, lattice,
                         batches[b].samples);
    });
    std::vector<LobeSample> samples;
    for (const Batch& batch : batches)
        samples.insert(samples.end(), batch.samples.begin(), batch.samples.end());
    if (samples.empty())
        return {};
    // The harmonics of a clamped cosine, whose first band is half of that of facingHarmonics().
    std::vector<CellArea> areas;
    for (const CellLobe& cell : sumByCell(samples, lattice.cells())) {
        areas.push_back({.cell = cell.cell});
        for (std::size_t i = 0; i < 4; ++i)
            areas.back().harmonics[i] = cell.lobe[i].x * (i == 0 ? 2.f : 1.f);
    }
    return areas;
}

PhotonAreas::Placed PhotonAreas::placedOf(const Scene& scene, std::uint32_t i) {
    const Instance& instance = scene.instances[i];
    const Material& m = scene.materialOf(instance);
    Placed placed{.mesh = instance.mesh,
                  .stores = storesPhotons(m),
                  .twoSided = isTwoSided(m),
                  .alpha = 1,
                  .cutoff = alphaCutoff(m),
                  .texture = {},
                  .toWorld = instance.toWorld};
    if (isCutout(m)) {
        placed.alpha = m.baseColor.w;
        placed.texture = m.baseColorTexture;
    }
    return placed;
}

bool PhotonAreas::follow(const Scene& scene, const PhotonLattices& lattices) {
    m_clipped = 0;
    std::vector<Part> before;
    if (m_assets == scene.assets && m_lattices == lattices)
        before = std::move(m_parts);
    m_assets = scene.assets;
    m_lattices = lattices;
    m_parts.assign(1, {});
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        if (scene.instances[i].dynamic)
            m_parts.emplace_back();
        Part& part = scene.instances[i].dynamic ? m_parts.back() : m_parts[0];
        part.instances.push_back(i);
        part.placed.push_back(placedOf(scene, i));
    }
    bool changed = before.size() != m_parts.size();
    for (std::size_t p = 0; p < m_parts.size(); ++p) {
        Part& part = m_parts[p];
        if (p < before.size() && before[p].placed == part.placed) {
            part.areas = std::move(before[p].areas);
            continue;
        }
        changed = true;
        ++m_clipped;
        for (std::size_t k = 0; k < kPhotonLattices; ++k)
            part.areas[k] = surfaceAreas(scene, part.instances, lattices[k]);
    }
    if (!changed)
        return false;
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        m_sums[k].clear();
        if (m_parts.size() == 1)
            continue;
        for (const Part& part : m_parts)
            m_sums[k] = m_sums[k].empty() ? part.areas[k] : sumOf(m_sums[k], part.areas[k]);
    }
    return true;
}

std::uint64_t PhotonAreas::bytes() const {
    std::uint64_t cells = 0;
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        cells += m_sums[k].size();
        for (const Part& part : m_parts)
            cells += part.areas[k].size();
    }
    return cells * sizeof(CellArea);
}

} // namespace limn
