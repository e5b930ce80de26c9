// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/lpv_overlay.h"

#include "engine/math/luminance.h"
#include "engine/math/sh.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/scene/origin.h"
#include "engine/techniques/lpv/arrival_overlay.h"
#include "engine/techniques/lpv/lpv.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using Style = OverlayLine::Style;

constexpr std::uint32_t kMaxLobes = 1000; // when no cell is picked
constexpr float kMinFlux = 0.05f;         // of the mean; darker lobes would only hide brighter ones
constexpr std::uint32_t kDots = 128, kPickedDots = 768; // of a lobe
constexpr float kPickedScale = 3;                       // a picked lobe may reach into others
constexpr float kFaceScale = 0.4f;                      // half a mark's side over a cell's
constexpr float kTexelScale = 0.15f;                    // a mark's radius over a cell's side
// Faces beside a wall, across it, block an eighth of what moves along the wall; drawn, they would
// hide the wall's own.
constexpr float kMinShownShare = 0.2f;
constexpr float kBackToBack = -0.7f;      // cosine of the normals of a wall's two sides, at most
constexpr std::size_t kMaxCompared = 256; // texels of a cell with each other
constexpr float kRingScale = 0.5f;        // a ring's radius over a cell's side

const glm::vec3 kBothSidesColor(0.9f, 0.45f, 0);

/// Mean of the positive luminances; 1 if there are none.
class Mean {
public:
    void add(glm::vec3 light) {
        if (const float y = luminance(light); y > 0)
            m_sum += double(y), ++m_count;
    }
    float value() const { return m_count > 0 ? float(m_sum / double(m_count)) : 1; }

private:
    double m_sum = 0;
    std::uint64_t m_count = 0;
};

/// The brightest cell of each block of step^3 cells, if its flux is above `minFlux`, in the order
/// of the blocks.
std::vector<std::uint32_t> brightestCells(const Lattice& lattice, std::span<const float> flux,
                                          float minFlux, std::uint32_t step) {
    const glm::uvec3 blocks = (lattice.size + step - 1U) / step;
    std::vector<std::uint32_t> brightest(std::size_t(blocks.x) * blocks.y * blocks.z, ~0U);
    for (std::uint32_t c = 0; c < lattice.cells(); ++c) {
        const glm::uvec3 block = lattice.place(c) / step;
        std::uint32_t& best = brightest[(block.z * blocks.y + block.y) * blocks.x + block.x];
        if (flux[c] > minFlux && (best == ~0U || flux[c] > flux[best]))
            best = c;
    }
    std::erase(brightest, ~0U);
    return brightest;
}

/// Lobes of some cells, or of the picked one. lobeOf(cell) is its intensity.
template <class LobeOf>
OverlayData lobeOverlay(const Lattice& lattice, std::uint32_t picked, const char* what,
                        const LobeOf& lobeOf) {
    const bool one = picked < lattice.cells();
    Mean mean;
    double total = 0;
    std::vector<float> flux(lattice.cells());
    for (std::uint32_t c = 0; c < lattice.cells(); ++c) {
        mean.add(fluxOf(lobeOf(c)));
        flux[c] = luminance(fluxOf(lobeOf(c)));
        total += double(flux[c]);
    }
    const float minFlux = kMinFlux * mean.value();
    const auto lit = std::ranges::count_if(flux, [](float f) { return f > 0; });
    std::uint32_t step = 1;
    std::vector<std::uint32_t> cells = brightestCells(lattice, flux, minFlux, step);
    while (cells.size() > kMaxLobes)
        cells = brightestCells(lattice, flux, minFlux, ++step);
    if (one)
        cells = {picked};
    const DirectionSet directions(one ? kPickedDots : kDots, true, 0);
    const float reach = 0.5f * lattice.cell * (one ? kPickedScale : float(step));
    OverlayData out;
    std::vector<float> intensity(directions.count);
    std::vector<glm::vec3> color(directions.count);
    for (const std::uint32_t c : cells) {
        const Lobe lobe = lobeOf(c);
        const glm::vec3 shown = lightColor(glm::max(fluxOf(lobe), 0.f), mean.value());
        for (std::uint32_t k = 0; k < directions.count; ++k) {
            float y[4];
            shBasis(2, directions[k], y);
            float sum = 0;
            for (std::size_t i = 0; i < lobe.size(); ++i)
                sum += luminance(lobe[i]) * y[i];
            intensity[k] = sum;
            color[k] = sum < 0 ? kNegativeLight : shown;
        }
        addLobe({lattice.centre(lattice.place(c)), reach}, directions, intensity, color, out.marks);
    }
    out.legend.title = one ? fmt::format("{} in cell {}", what, picked) : what;
    out.legend.entries = lightColorEntries(mean.value(), "W");
    out.legend.entries.push_back({packColor(kNegativeLight), "less than none in that direction"});
    out.legend.notes = {
        one ? "The longest ray of the lobe is the brightest direction"
            : fmt::format(
                  "{} of {} lit cells, each the brightest of {} x {} x {}, none below {:.2g} "
                  "W; lobes have the same length, their colour is the cell's flux; pick a "
                  "cell to see it alone",
                  cells.size(), lit, step, step, step, minFlux),
        fmt::format("Flux of lit cells, {:.3g} W on average; {:.4g} W in all", mean.value(),
                    total)};
    return out;
}

OverlayData blockerOverlay(const LitLattice& lit) {
    const Lattice& lattice = lit.lattice;
    OverlayData out;
    std::uint32_t faces = 0, over = 0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::uvec3 size = lattice.size;
        ++size[axis];
        for (std::uint32_t i = 0; i < size.x * size.y * size.z; ++i) {
            const glm::ivec3 c(i % size.x, i / size.x % size.y, i / size.x / size.y);
            const float share = blockedShare(lit.blockers, axis, c);
            if (share < kMinShownShare)
                continue;
            ++faces;
            over += share > 1 ? 1 : 0;
            OverlayMark mark;
            glm::vec3 place = glm::vec3(c) + 0.5f;
            place[axis] -= 0.5f;
            mark.position = lattice.lower + place * lattice.cell;
            mark.radius = kFaceScale * lattice.cell;
            mark.shape = MarkShape::Square;
            mark.color = packColor(viridis(share));
            for (const float side : {1.f, -1.f}) {
                mark.normal = glm::vec3(0);
                mark.normal[axis] = side;
                out.marks.push_back(mark);
            }
        }
    }
    out.legend.title = "Light that surfaces block between cells";
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back(
            {packColor(viridis(float(k) / 4)),
             k == 4 ? "100 % or more, straight through the face" : fmt::format("{} %", 25 * k)});
    out.legend.notes = {
        fmt::format(
            "{} faces block at least {:.0f} %, and {} of them all light; others are not drawn",
            faces, 100 * kMinShownShare, over),
        fmt::format("Cells of {:.3g} m; a face that lies behind a surface is hidden by it",
                    lattice.cell)};
    return out;
}

/// Whether two texels lie on the two sides of a wall, and not on walls that face each other.
bool backToBack(const ShownTexel& a, const ShownTexel& b) {
    return glm::dot(a.normal, b.normal) < kBackToBack &&
           glm::dot(a.position - b.position, a.normal) >= 0;
}

/// Cells into which texels of both sides of a wall inject, so that each side lights the other.
std::vector<std::uint32_t> cellsOfBothSides(const LitLattice& lit) {
    const Lattice& lattice = lit.lattice;
    std::map<std::uint32_t, std::vector<const ShownTexel*>> texels; // per cell
    for (const InjectedTexel& texel : lit.texels)
        if (luminance(texel.flux) > 0)
            texels[lattice.index(lattice.at(texel.surface.position +
                                            texel.surface.normal * (0.5f * lattice.cell)))]
                .push_back(&texel.surface);
    std::vector<std::uint32_t> found;
    for (const auto& [cell, in] : texels) {
        const std::size_t step = (in.size() + kMaxCompared - 1) / kMaxCompared;
        bool both = false;
        for (std::size_t a = 0; a < in.size() && !both; a += step)
            for (std::size_t b = 0; b < a && !both; b += step)
                both = backToBack(*in[a], *in[b]);
        if (both)
            found.push_back(cell);
    }
    return found;
}

OverlayData texelOverlay(const LitLattice& lit) {
    OverlayData out;
    Mean mean;
    for (const InjectedTexel& texel : lit.texels)
        mean.add(texel.flux);
    for (const InjectedTexel& texel : lit.texels)
        out.marks.push_back({.position = texel.surface.position,
                             .radius = kTexelScale * lit.lattice.cell,
                             .normal = texel.surface.normal,
                             .color = packColor(lightColor(texel.flux, mean.value()))});
    const std::vector<std::uint32_t> both = cellsOfBothSides(lit);
    for (const std::uint32_t cell : both)
        out.marks.push_back({.position = lit.lattice.centre(lit.lattice.place(cell)),
                             .radius = kRingScale * lit.lattice.cell,
                             .color = packColor(kBothSidesColor),
                             .shape = MarkShape::Ring});
    out.legend.title = "Texels of reflective shadow maps";
    out.legend.entries = lightColorEntries(mean.value(), "W");
    out.legend.entries.push_back(
        {packColor(kBothSidesColor),
         fmt::format("ring: {} cells lit from both sides of a wall", both.size())});
    out.legend.notes = {fmt::format("Flux that a texel sends into the cell half a cell off its "
                                    "surface; {} of {} texels",
                                    lit.texels.size(), lit.allTexels)};
    return out;
}

std::string fluxText(const char* what, glm::vec3 flux) {
    return fmt::format("{} {:.3g} {:.3g} {:.3g} W", what, flux.x, flux.y, flux.z);
}

} // namespace

glm::vec3 fluxOf(const Lobe& lobe) {
    return lobe[0] * (2 * std::sqrt(std::numbers::pi_v<float>));
}

float blockedShare(const FaceBlockers& blockers, int axis, glm::ivec3 c) {
    const auto& face = blockers.axis[std::size_t(axis)];
    const std::size_t index = blockers.cells.at(c);
    float maximum = 0;
    for (const float side : {1.f, -1.f}) {
        glm::vec3 d(0);
        d[axis] = side;
        float y[4];
        shBasis(2, d, y);
        float share = 0;
        for (std::size_t i = 0; i < face.size(); ++i)
            share += face[i][index] * y[i];
        maximum = std::max(maximum, share);
    }
    return maximum;
}

const Technique& LpvSnapshot::technique() const {
    return kLpvTechnique;
}

OverlayData LpvSnapshot::overlay(const OverlayRequest& request, const Scene& scene,
                                 const LightSnapshot* /*light*/) const {
    if (!request.kind)
        return {};
    const Lattice& lattice = m_lit.lattice;
    switch (request.kind - kLpvOverlays.data()) {
    case 0:
        return lobeOverlay(lattice, request.pick, "Light that leaves cells",
                           [&](std::uint32_t c) { return m_lit.sum[c]; });
    case 1:
        return lobeOverlay(lattice, request.pick, "Injected light", [&](std::uint32_t c) {
            return m_lit.injected.lobe(glm::ivec3(lattice.place(c)));
        });
    case 2:
        return blockerOverlay(m_lit);
    case 3:
        return texelOverlay(m_lit);
    case 4:
        return arrivalOverlay(m_lit, scene);
    default:
        return {};
    }
}

std::optional<std::uint32_t> LpvSnapshot::pickAt(const Scene& /*scene*/, const Hit& hit) const {
    const glm::vec3 n = hit.geometricNormal * (hit.frontFace ? 1.f : -1.f);
    return m_lit.lattice.index(m_lit.lattice.at(hit.position + n * (m_lit.lattice.cell * 0.5f)));
}

std::optional<std::uint32_t> LpvSnapshot::nearestPick(const OverlaySource& other,
                                                      std::uint32_t pick) const {
    const Lattice& before = static_cast<const LpvSnapshot&>(other).m_lit.lattice;
    return m_lit.lattice.index(m_lit.lattice.at(before.centre(before.place(pick))));
}

std::vector<OverlayLine> LpvSnapshot::describePick(const Scene& scene, std::uint32_t pick) const {
    const Lattice& lattice = m_lit.lattice;
    const glm::ivec3 c(lattice.place(pick));
    const Lobe& sum = m_lit.sum[pick];
    std::vector<OverlayLine> lines = {
        {Style::Plain, fmt::format("Cell {}, {}, {} of {} x {} x {}", c.x, c.y, c.z, lattice.size.x,
                                   lattice.size.y, lattice.size.z)},
        {Style::Plain, placeText(scene.origin, lattice.centre(lattice.place(pick)))},
        {Style::Plain, fluxText("Flux", fluxOf(sum)),
         "Red, green and blue flux that leaves the cell, summed over all rounds"},
        {Style::Plain, fluxText("Injected", fluxOf(m_lit.injected.lobe(c))),
         "The part of it that lit surfaces and emitters send, before the first round"}};
    // The harmonics of the first band are y, z, x.
    const glm::vec3 along(luminance(sum[3]), luminance(sum[1]), luminance(sum[2]));
    if (const float length = glm::length(along); length > 0) {
        const glm::vec3 d = along / length;
        lines.push_back({Style::Plain,
                         fmt::format("Brightest towards {:.2f}, {:.2f}, {:.2f}", d.x, d.y, d.z),
                         "Unit direction in which most of the light travels"});
    }
    lines.push_back({Style::Separator, ""});
    lines.push_back({Style::Heading, "Blocked at its faces"});
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 upper = c;
        ++upper[axis];
        lines.push_back({Style::Plain,
                         fmt::format("-{0} {1:.0f} %, +{0} {2:.0f} %", "XYZ"[axis],
                                     100 * blockedShare(m_lit.blockers, axis, c),
                                     100 * blockedShare(m_lit.blockers, axis, upper)),
                         "Share of the light straight through the face that surfaces block; 100 % "
                         "and more block all"});
    }
    return lines;
}

} // namespace limn
