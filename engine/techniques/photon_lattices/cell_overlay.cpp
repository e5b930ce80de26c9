// SPDX-License-Identifier: MIT
#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/techniques/photon_lattices/lattice_part.h"
#include "engine/techniques/photon_lattices/photon_overlay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxLobes = 600;   // of a lattice, the brightest
constexpr std::uint32_t kLobeDots = 128; // of a lobe
constexpr std::size_t kMaxCells = 8192;  // marks of a lattice
constexpr float kCellShare = 0.2f;       // a mark's half side over a cell's
const glm::vec3 kBelowColor(1, 0.15f, 0.1f);

const PhotonLatticePart& partOf(const LitPhotons& lit, std::size_t k) {
    return static_cast<const PhotonLatticePart&>(*lit.field.parts[k]);
}

/// Largest of a lattice function a(n) over all n.
float largest(const std::array<float, 4>& a) {
    const float slope = std::sqrt(a[1] * a[1] + a[2] * a[2] + a[3] * a[3]);
    const float pi = glm::pi<float>();
    return a[0] * std::sqrt(1 / (4 * pi)) + slope * std::sqrt(3 / (4 * pi));
}

/// Irradiance of a cell's surface that faces n.
glm::vec3 irradianceOf(const PhotonLatticePart& part, const PhotonCell& cell, glm::vec3 n) {
    float y[4];
    shBasis(2, n, y);
    float area = 0;
    glm::vec3 light(0);
    for (std::size_t i = 0; i < 4; ++i) {
        area += cell.area[i] * y[i];
        light += cell.light[i] * y[i];
    }
    const float factor = part.incident() ? 4 * glm::pi<float>() / 3 : 1;
    return light * (factor / std::max(area, part.minArea()));
}

/// The brightest entries of a lattice by the mean of their light, at most kMaxLobes.
std::vector<std::uint32_t> brightest(const LitCells& lit) {
    std::vector<std::uint32_t> entries;
    for (std::uint32_t e = 0; e < lit.cells.size(); ++e)
        if (luminance(lit.cells[e].light[0]) > 0)
            entries.push_back(e);
    std::ranges::stable_sort(entries, std::ranges::greater{},
                             [&](std::uint32_t e) { return luminance(lit.cells[e].light[0]); });
    if (entries.size() > kMaxLobes)
        entries.resize(kMaxLobes);
    return entries;
}

} // namespace

OverlayData cellLobeOverlay(const LitPhotons& lit) {
    OverlayData out;
    out.legend.title = "Light of cells by direction";
    const DirectionSet directions(kLobeDots, true, 0);
    std::vector<float> value(directions.count);
    std::vector<glm::vec3> color(directions.count);
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        const PhotonLatticePart& part = partOf(lit, k);
        const Lattice& lattice = part.cells().lattice;
        const std::vector<std::uint32_t> entries = brightest(part.cells());
        for (const std::uint32_t e : entries) {
            const PhotonCell& cell = part.cells().cells[e];
            for (std::uint32_t d = 0; d < directions.count; ++d) {
                value[d] = luminance(irradianceOf(part, cell, directions[d]));
                color[d] = value[d] < 0 ? kNegativeLight : lightHue(cell.light[0]);
            }
            addLobe({lattice.centre(lattice.place(part.cells().cellOf[e])), 0.5f * lattice.cell},
                    directions, value, color, out.marks);
        }
        if (!entries.empty())
            out.legend.notes.push_back(fmt::format("{} x {} x {} cells: {} of {} with entries",
                                                   lattice.size.x, lattice.size.y, lattice.size.z,
                                                   entries.size(), part.cells().cells.size()));
    }
    out.legend.entries = {{packColor({0.8f, 0.8f, 0.8f}),
                           "irradiance of a surface that faces the dot's direction, by length"},
                          {packColor(kNegativeLight), "less than none"}};
    return out;
}

OverlayData cellCountOverlay(const LitPhotons& lit) {
    OverlayData out;
    out.legend.title = "Photons in cells";
    float maximum = 1;
    std::array<std::vector<std::uint32_t>, kPhotonLattices> counts;
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        counts[k].resize(lit.lattices[k].cells());
        for (const LitPhotons::Source& source : lit.sources)
            for (std::size_t i = 0; i < source.injected->places.size(); ++i)
                if (const Photon& p = source.injected->map->photons[i];
                    source.injected->places[i] == k)
                    ++counts[k][cellOf(lit.lattices[k], p.position, p.normal)];
        for (const std::uint32_t count : counts[k])
            maximum = std::max(maximum, float(count));
    }
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        const Lattice& lattice = lit.lattices[k];
        const auto shining = std::size_t(
            std::ranges::count_if(counts[k], [](std::uint32_t count) { return count > 0; }));
        const std::size_t step = shining / kMaxCells + 1;
        std::size_t number = 0;
        for (std::uint32_t c = 0; c < counts[k].size(); ++c)
            if (counts[k][c] > 0 && number++ % step == 0)
                out.marks.push_back({.position = lattice.centre(lattice.place(c)),
                                     .radius = kCellShare * lattice.cell,
                                     .color = packColor(viridis(std::log(1 + float(counts[k][c])) /
                                                                std::log(1 + maximum))),
                                     .shape = MarkShape::Square});
    }
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back(
            {packColor(viridis(float(k) / 4)),
             fmt::format("{:.0f}", std::pow(1 + maximum, float(k) / 4) - 1)});
    out.legend.notes = {"The size of a mark is that of its cell"};
    return out;
}

OverlayData cellAreaOverlay(const LitPhotons& lit) {
    OverlayData out;
    out.legend.title = "Area of surface in cells with light, over that of a cell's face";
    std::size_t below = 0, all = 0;
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        const PhotonLatticePart& part = partOf(lit, k);
        const LitCells& cells = part.cells();
        const float face = cells.lattice.cell * cells.lattice.cell;
        const std::size_t step = cells.cells.size() / kMaxCells + 1;
        for (std::size_t e = 0; e < cells.cells.size(); ++e) {
            if (cells.cells[e].light[0] == glm::vec3(0))
                continue;
            const float area = largest(cells.cells[e].area);
            ++all;
            below += area < part.minArea() ? 1 : 0;
            if (e % step == 0 || area < part.minArea())
                out.marks.push_back(
                    {.position = cells.lattice.centre(cells.lattice.place(cells.cellOf[e])),
                     .radius = kCellShare * cells.lattice.cell,
                     .color = packColor(area < part.minArea() ? kBelowColor : viridis(area / face)),
                     .shape = MarkShape::Square});
        }
    }
    for (int k = 4; k >= 1; --k)
        out.legend.entries.push_back(
            {packColor(viridis(float(k) / 4)),
             k == 4 ? std::string("100 % or more") : fmt::format("{} %", 25 * k)});
    out.legend.entries.push_back(
        {packColor(kBelowColor), "less than 5 %: darker than it should be"});
    out.legend.notes = {fmt::format("{} of {} cells have less than 5 %", below, all)};
    return out;
}

} // namespace limn
