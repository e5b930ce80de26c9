// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/lattice_part.h"

#include "engine/core/parallel.h"
#include "engine/field/sample_field.h"
#include "engine/math/sh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

/// A cell of a lookup.
struct Near {
    std::uint32_t entry = kNoEntry;
    float weight = 0;
};

/// The cell of a point, or the eight cells around it, without those that have no entry.
std::size_t nearCells(const LitCells& cells, glm::vec3 p, bool trilinear,
                      std::array<Near, 8>& near) {
    const Lattice& lattice = cells.lattice;
    if (!trilinear) {
        near[0] = {cells.entryAt(lattice.index(lattice.at(p))), 1};
        return near[0].entry == kNoEntry ? 0 : 1;
    }
    const glm::vec3 last(glm::vec3(lattice.size) - 1.f);
    const glm::vec3 x = glm::clamp((p - lattice.lower) / lattice.cell - 0.5f, glm::vec3(0), last);
    const glm::uvec3 lower(glm::min(glm::floor(x), glm::max(last - 1.f, 0.f)));
    const glm::vec3 t = x - glm::vec3(lower);
    std::size_t count = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const glm::uvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        float weight = 1;
        for (int axis = 0; axis < 3; ++axis)
            weight *= step[axis] == 1 ? t[axis] : 1 - t[axis];
        const std::uint32_t entry =
            cells.entryAt(lattice.index(glm::min(lower + step, lattice.size - 1U)));
        if (weight > 0 && entry != kNoEntry)
            near[count++] = {entry, weight};
    }
    return count;
}

/// Adds the taps of `scale` times the irradiance.
void addTaps(const PhotonLatticePart& part, const FieldPoint& point, float scale, FieldTaps& taps) {
    const LitCells& cells = part.cells();
    if (cells.cells.empty())
        return;
    const glm::vec3 lifted =
        point.position + point.surfaceNormal() * (kLatticeLift * cells.lattice.cell);
    std::array<Near, 8> near;
    const std::size_t count = nearCells(cells, lifted, part.trilinear(), near);
    float y[4];
    shBasis(2, point.normal, y);
    float area = 0;
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < 4; ++i)
            area += near[k].weight * cells.cells[near[k].entry].area[i] * y[i];
    const float factor =
        scale * (part.incident() ? 4 * glm::pi<float>() / 3 : 1) / std::max(area, part.minArea());
    for (std::size_t k = 0; k < count; ++k)
        for (std::uint32_t i = 0; i < 4; ++i)
            taps.push_back({4 * near[k].entry + i, near[k].weight * factor * y[i]});
}

/// 1 for each cell that holds light or touches one that does.
std::vector<std::uint8_t> cellsAround(const Lattice& lattice, std::span<const CellLobe> light) {
    std::vector<std::uint8_t> near(lattice.cells());
    const glm::ivec3 last(lattice.size - 1U);
    for (const CellLobe& cell : light) {
        const glm::ivec3 middle(lattice.place(cell.cell));
        const glm::ivec3 lower = glm::max(middle - 1, 0), upper = glm::min(middle + 1, last);
        for (int z = lower.z; z <= upper.z; ++z)
            for (int y = lower.y; y <= upper.y; ++y)
                for (int x = lower.x; x <= upper.x; ++x)
                    near[lattice.index(glm::uvec3(x, y, z))] = 1;
    }
    return near;
}

/// Adds a cell's light and area, times a weight.
void addCell(const PhotonCell& cell, float weight, PhotonCell& sum) {
    for (std::size_t i = 0; i < 4; ++i) {
        sum.light[i] += weight * cell.light[i];
        sum.area[i] += weight * cell.area[i];
    }
}

} // namespace

std::uint32_t LitCells::entryAt(std::uint32_t cell) const {
    if (!entryOf.empty())
        return entryOf[cell];
    const auto it = std::ranges::lower_bound(cellOf, cell);
    return it != cellOf.end() && *it == cell ? std::uint32_t(it - cellOf.begin()) : kNoEntry;
}

LitCells litCells(const Lattice& lattice, std::span<const CellLobe> light,
                  std::span<const CellArea> areas, CellsKept kept) {
    LitCells lit{.lattice = lattice, .entryOf = {}, .cellOf = {}, .cells = {}};
    if (light.empty())
        return lit;
    const std::vector<std::uint8_t> near =
        kept == CellsKept::Around ? cellsAround(lattice, light) : std::vector<std::uint8_t>();
    const auto entry = [&](std::uint32_t cell) -> PhotonCell& { // cells come in their order
        if (lit.cellOf.empty() || lit.cellOf.back() != cell) {
            lit.cellOf.push_back(cell);
            lit.cells.emplace_back();
        }
        return lit.cells.back();
    };
    std::size_t next = 0;
    for (const CellArea& cell : areas) {
        for (; next < light.size() && light[next].cell < cell.cell; ++next)
            entry(light[next].cell).light = light[next].lobe;
        const bool isLit = next < light.size() && light[next].cell == cell.cell;
        if (!isLit && (kept == CellsKept::Lit || (!near.empty() && near[cell.cell] == 0)))
            continue;
        entry(cell.cell).area = cell.harmonics;
        if (isLit)
            entry(cell.cell).light = light[next++].lobe;
    }
    for (; next < light.size(); ++next)
        entry(light[next].cell).light = light[next].lobe;
    if (kept == CellsKept::All) {
        lit.entryOf.assign(lattice.cells(), kNoEntry);
        for (std::uint32_t e = 0; e < lit.cellOf.size(); ++e)
            lit.entryOf[lit.cellOf[e]] = e;
    }
    return lit;
}

std::vector<WeightedCell> blurWeights(PhotonBlur blur) {
    const bool wide = blur == PhotonBlur::Weighted5 || blur == PhotonBlur::Uniform5;
    const int reach = blur == PhotonBlur::None ? 0 : wide ? 2 : 1;
    constexpr std::array<float, 2> kThree = {2, 1};
    constexpr std::array<float, 3> kFive = {6, 4, 1};
    std::vector<WeightedCell> weights;
    float sum = 0;
    for (int z = -reach; z <= reach; ++z)
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const glm::ivec3 offset(x, y, z);
                const auto product = [&](const auto& row) {
                    return row[std::size_t(std::abs(x))] * row[std::size_t(std::abs(y))] *
                           row[std::size_t(std::abs(z))];
                };
                float weight = 1;
                if (blur == PhotonBlur::Weighted3)
                    weight = product(kThree);
                else if (blur == PhotonBlur::Weighted5)
                    weight = product(kFive);
                else if (blur == PhotonBlur::SixNeighbours)
                    weight = std::abs(x) + std::abs(y) + std::abs(z) <= 1 ? 1 : 0;
                if (weight > 0)
                    weights.push_back({offset, weight});
                sum += weight;
            }
    for (WeightedCell& cell : weights)
        cell.weight /= sum;
    return weights;
}

LitCells blurred(const LitCells& cells, PhotonBlur blur) {
    if (blur == PhotonBlur::None || cells.cells.empty())
        return cells;
    const Lattice& lattice = cells.lattice;
    const std::vector<WeightedCell> weights = blurWeights(blur);
    LitCells all{.lattice = lattice, .entryOf = {}, .cellOf = {}, .cells = {}};
    const std::size_t count = lattice.cells();
    all.cells.resize(count);
    parallelRanges(count, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            for (const WeightedCell& w : weights) {
                const glm::ivec3 p = glm::ivec3(lattice.place(std::uint32_t(c))) + w.offset;
                if (glm::clamp(p, glm::ivec3(0), glm::ivec3(lattice.size) - 1) != p)
                    continue;
                const std::uint32_t entry = cells.entryAt(lattice.index(glm::uvec3(p)));
                if (entry != kNoEntry)
                    addCell(cells.cells[entry], w.weight, all.cells[c]);
            }
    });
    for (std::uint32_t c = 0; c < count; ++c) {
        all.entryOf.push_back(c);
        all.cellOf.push_back(c);
    }
    return all;
}

void PhotonLatticePart::irradianceTaps(const FieldPoint& point, FieldTaps& taps) const {
    addTaps(*this, point, 1, taps);
}

void PhotonLatticePart::radianceTaps(const FieldPoint& point, glm::vec3 /*direction*/,
                                     FieldTaps& taps) const {
    addTaps(*this, point, 1 / glm::pi<float>(), taps);
}

void PhotonLatticePart::lobeTaps(const FieldPoint& point, glm::vec3 /*direction*/, int /*bands*/,
                                 const std::array<float, kMaxBands>& /*factors*/,
                                 FieldTaps& taps) const {
    addTaps(*this, point, 1 / glm::pi<float>(), taps);
}

glm::vec3 PhotonLatticePart::sum(std::span<const FieldTap> taps) const {
    glm::vec3 sum(0);
    for (const FieldTap& tap : taps)
        sum += tap.weight * m_cells.cells[tap.index / 4].light[tap.index % 4];
    return sum;
}

bool PhotonLatticePart::equals(const FieldPart& other) const {
    const auto* part = dynamic_cast<const PhotonLatticePart*>(&other);
    return part && part->m_cells == m_cells && part->m_incident == m_incident &&
           part->m_trilinear == m_trilinear;
}

} // namespace limn
