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

std::vector<CellArea> surfaceAreas(const Scene& scene, std::uint32_t index,
                                   const Lattice& lattice) {
    constexpr std::size_t kBatch = 256; // triangles
    const Instance& instance = scene.instances[index];
    if (!storesPhotons(scene.materialOf(instance)))
        return {};
    const std::size_t count = scene.meshOf(instance).triangleCount();
    std::vector<std::vector<LobeSample>> batches((count + kBatch - 1) / kBatch);
    parallelRanges(batches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
            for (std::size_t t = b * kBatch; t < std::min((b + 1) * kBatch, count); ++t)
                addSides(scene, instance, std::uint32_t(t), lattice, batches[b]);
    });
    std::vector<LobeSample> samples;
    for (const std::vector<LobeSample>& batch : batches)
        samples.insert(samples.end(), batch.begin(), batch.end());
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
                  .dynamic = instance.dynamic,
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

/// Takes over the areas of instances that are as before. Returns the others.
std::vector<std::uint32_t> PhotonAreas::keep(const Scene& scene, bool& staticChanged) {
    std::vector<Kept> before = std::move(m_instances);
    m_instances.clear();
    std::vector<std::uint32_t> others;
    staticChanged = before.size() != scene.instances.size();
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        m_instances.push_back({placedOf(scene, i), {}});
        Kept& now = m_instances.back();
        auto same = before.begin() + std::ptrdiff_t(std::min<std::size_t>(i, before.size()));
        if (same == before.end() || same->placed != now.placed) {
            staticChanged |= !now.placed.dynamic || same == before.end() || !same->placed.dynamic;
            same = std::ranges::find(before, now.placed, &Kept::placed);
        }
        if (same == before.end())
            others.push_back(i);
        else
            now.areas = same->areas;
    }
    return others;
}

/// Adds the instances' areas up.
void PhotonAreas::sum(bool staticChanged) {
    parallelRanges(kPhotonLattices, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            if (staticChanged)
                m_static[k].clear();
            m_sums[k].clear();
            std::vector<CellArea> all;
            for (const Kept& kept : m_instances)
                if (staticChanged && !kept.placed.dynamic)
                    all.insert(all.end(), (*kept.areas)[k].begin(), (*kept.areas)[k].end());
            std::ranges::stable_sort(all, {}, &CellArea::cell);
            for (const CellArea& cell : all) {
                if (m_static[k].empty() || m_static[k].back().cell != cell.cell)
                    m_static[k].push_back({.cell = cell.cell});
                for (std::size_t i = 0; i < 4; ++i)
                    m_static[k].back().harmonics[i] += cell.harmonics[i];
            }
            if (!m_dynamic)
                continue;
            m_sums[k] = m_static[k];
            for (const Kept& kept : m_instances)
                if (kept.placed.dynamic)
                    m_sums[k] = sumOf(m_sums[k], (*kept.areas)[k]);
        }
    });
}

bool PhotonAreas::follow(const Scene& scene, const PhotonLattices& lattices) {
    const bool anew = m_assets != scene.assets || m_lattices != lattices;
    if (anew)
        m_instances.clear();
    m_assets = scene.assets;
    m_lattices = lattices;
    const std::size_t before = m_instances.size();
    bool staticChanged = false;
    const std::vector<std::uint32_t> others = keep(scene, staticChanged);
    m_clipped = std::uint32_t(others.size());
    if (others.empty() && !staticChanged && !anew && before == m_instances.size())
        return false;
    parallelRanges(others.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) {
            Areas areas;
            for (std::size_t k = 0; k < kPhotonLattices; ++k)
                areas[k] = surfaceAreas(scene, others[j], lattices[k]);
            m_instances[others[j]].areas = std::make_shared<const Areas>(std::move(areas));
        }
    });
    m_dynamic = std::ranges::any_of(m_instances, [](const Kept& k) { return k.placed.dynamic; });
    sum(staticChanged || anew);
    return true;
}

std::uint64_t PhotonAreas::bytes() const {
    std::uint64_t cells = 0;
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        cells += m_sums[k].size() + m_static[k].size();
        for (const Kept& kept : m_instances)
            cells += (*kept.areas)[k].size();
    }
    return cells * sizeof(CellArea);
}

} // namespace limn
